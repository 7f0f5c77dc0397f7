"""Has the parts of scripts/studies/translations: random materials, what is in use, pictures and errors, search,
pages."""

"""These modules are the parts of scripts/studies/translations: random materials, translations in use, pictures and
errors, search, pages."""

"""New files, which nobody who may write into the same folder can know before they are there."""

import contextlib
import os
import secrets


def create_new(path):
    """Makes an empty file. A file or a link with that name is an error: it may be somebody else's."""
    os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0), 0o666))


@contextlib.contextmanager
def replacing(path):
    """Gives the name of a new file in the same folder. It becomes ``path`` at the end, or is removed after a failure."""
    unfinished = os.path.join(os.path.dirname(path), f".unfinished-{secrets.token_hex(8)}{os.path.splitext(path)[1]}")
    create_new(unfinished)
    try:
        yield unfinished
        os.replace(unfinished, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.remove(unfinished)
        raise

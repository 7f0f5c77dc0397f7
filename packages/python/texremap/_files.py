"""Creates files whose names nobody with access to the same folder can predict."""

import contextlib
import os
import secrets


def create_new(path):
    """Creates an empty file. Fails if a file or a link with that name exists, because it may belong to
    somebody else."""
    os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0), 0o666))


@contextlib.contextmanager
def replacing(path):
    """Yields the name of a new file in the same folder. At the end the file becomes ``path``. After a failure
    it is removed."""
    unfinished = os.path.join(os.path.dirname(path), f".unfinished-{secrets.token_hex(8)}{os.path.splitext(path)[1]}")
    create_new(unfinished)
    try:
        yield unfinished
        os.replace(unfinished, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.remove(unfinished)
        raise

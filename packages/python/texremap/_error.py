class Error(ValueError):
    """An error with a message of one line: the place, what is wrong, and what to do.

    ``kind`` is ``"usage"`` (names or arguments that do not exist or do not fit together), ``"input"`` (a file or value
    that cannot be used), ``"output"`` (a result that cannot be written), ``"numeric"`` (a converter that fails its
    self-test) or ``"interrupted"``.
    """

    def __init__(self, message: str, kind: str = "usage") -> None:
        super().__init__(message)
        self.kind = kind

    def __reduce__(self):
        return Error, (str(self), self.kind)

"""The exceptions of foldwing: few, and each message names what, value, limit and remedy."""


class FoldwingError(Exception):
    """Base class of every error that foldwing raises on purpose."""


class InputError(FoldwingError, ValueError):
    """What the user gave cannot be used.

    Parameters
    ----------
    field : str
        Where the value stands, for example ``wing.segment[2].span`` or ``--speeds``.
    value : object
        The value as it was given; None when it is missing.
    limit : str
        What the field accepts, for example ``must be greater than 0 m``.
    remedy : str
        What to do about it.
    """

    def __init__(self, field: str, value: object, limit: str, remedy: str) -> None:
        self.field = field
        self.value = value
        self.limit = limit
        self.remedy = remedy
        given = "missing" if value is None else f"got {value!r}"
        super().__init__(f"{field}: {given}; {limit}. {remedy}")


class OutputError(FoldwingError):
    """A result cannot be written: the folder is not writable or already holds a result."""


class ComputationError(FoldwingError):
    """A computation failed and there is no partial result to return."""

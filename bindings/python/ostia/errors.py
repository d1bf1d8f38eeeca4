"""What Ostia's functions raise. Each class knows the exit code that the programs end with for it."""


class Error(Exception):
    """Base of all that Ostia raises on purpose."""

    exit_code = 6


class UsageError(Error, TypeError):
    """A call that makes no sense: an option that is not there, or of another type."""

    exit_code = 2


class InvalidInput(Error, ValueError):
    """An input (an array, a file's content, a parameter) that cannot be taken; the same call will fail again."""

    exit_code = 3


class IoError(Error, OSError):
    """A file or folder that cannot be read or written."""

    exit_code = 3


class GeometryError(Error, ValueError):
    """Geometry that an algorithm cannot work on: open where closed is needed, self-intersecting, unreachable."""

    exit_code = 3


class NumericalError(Error, ArithmeticError):
    """A computation that did not converge or lost its precision."""

    exit_code = 6


class ResourceError(Error, MemoryError):
    """Out of memory, disk or time; the same call may succeed with more of it."""

    exit_code = 5


class Cancelled(Error):
    """The work was cancelled; nothing half-written is left behind."""

    exit_code = 130


def of_exit_code(code: int, message: str) -> Error:
    """The error that a program ended with."""
    kinds = {2: UsageError, 3: InvalidInput, 5: ResourceError, 130: Cancelled}
    return kinds.get(code, Error)(message)

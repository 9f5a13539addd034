"""What can go wrong, in the words of the library and its command.

Every exception is an :class:`Error`, and the built-in one that says the same in general: code that knows nothing of Selvedge
catches it too.
"""

from ._answers import Crossings, Untangled


class Error(Exception):
    """Of Selvedge's own."""


class InputError(Error, ValueError):
    """A value cannot be taken: a shape, a count, an index, a coordinate that is not finite, a length that is negative."""


class DataTypeError(Error, TypeError):
    """Something is no array of numbers, or of numbers that would have to be rounded."""


class SceneError(InputError):
    """A scene says what cannot be; the text names file, line and field."""


class TangledError(SceneError):
    """A scene starts with surfaces that pass through each other, and does not want that, or untangling has left something of it."""

    crossings: Crossings
    """All places."""
    untangled: Untangled | None
    """What untangling did, if the scene asks for that."""

    def __init__(self, text: str, crossings: Crossings, untangled: Untangled | None) -> None:
        super().__init__(text)
        self.crossings, self.untangled = crossings, untangled


class CheckpointError(InputError):
    """A checkpoint is of another scene, another version, or damaged."""


class BusyError(Error, RuntimeError):
    """Another thread is using the object. Nothing has changed."""


class ForkedError(Error, RuntimeError):
    """The object's threads stayed behind in a parent process: make one in the child, or start children by ``spawn``."""


class CancelledError(Error, RuntimeError):
    """Another thread has called ``cancel``. The object answers as ever."""


class TooManyPairsError(Error, RuntimeError):
    """More pairs are near each other than ``set_pair_limit`` allows to look at."""


class BlockedError(Error, RuntimeError):
    """A step of a simulation could not be certified, and the scene says to stop then."""


class CommandError(Error, RuntimeError):
    """The ``selvedge`` command, which studies need, is missing, of another version, or did not end well."""


class ThreadsError(Error, OSError):
    """The operating system refuses threads, or there are more of them than any machine has use for."""


class BrokenError(Error, RuntimeError):
    """A fault of Selvedge's own, please report it. The object cannot be used any more."""


__all__ = [
    "BlockedError",
    "BrokenError",
    "BusyError",
    "CancelledError",
    "CheckpointError",
    "CommandError",
    "DataTypeError",
    "Error",
    "ForkedError",
    "InputError",
    "SceneError",
    "TangledError",
    "ThreadsError",
    "TooManyPairsError",
]

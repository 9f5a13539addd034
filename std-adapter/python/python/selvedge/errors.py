"""The exceptions of the package.

Every exception is an :class:`Error` and also the matching built-in exception, so that general code can catch it.
"""

from ._answers import Crossings, Untangled


class Error(Exception):
    """The base class of all exceptions."""


class InputError(Error, ValueError):
    """An argument is invalid: its shape, a count, an index, a coordinate that is not finite, or a negative length."""


class DataTypeError(Error, TypeError):
    """An argument is not an array of numbers, or its numbers would have to be rounded."""


class SceneError(InputError):
    """A scene is invalid. The message names file, line and field."""


class TangledError(SceneError):
    """A scene starts with surfaces that pass through each other and does not tolerate that, or untangling did not remove all of it."""

    crossings: Crossings
    """All crossings."""
    untangled: Untangled | None
    """The result of untangling, if the scene requests it."""

    def __init__(self, text: str, crossings: Crossings, untangled: Untangled | None) -> None:
        super().__init__(text)
        self.crossings, self.untangled = crossings, untangled


class CheckpointError(InputError):
    """A checkpoint is damaged, or it belongs to another scene or version."""


class BusyError(Error, RuntimeError):
    """Another thread is using the object. Nothing has changed."""


class ForkedError(Error, RuntimeError):
    """The object's threads are in the parent process. Create the object in the child, or start children by ``spawn``."""


class CancelledError(Error, RuntimeError):
    """Another thread has called ``cancel``. The object remains usable."""


class TooManyPairsError(Error, RuntimeError):
    """There are more candidate pairs than ``set_pair_limit`` allows."""


class TooMuchMemoryError(Error, MemoryError):
    """The pairs and contacts of a question take more memory than ``set_memory_limit`` allows."""


class BlockedError(Error, RuntimeError):
    """A step of a simulation could not be certified, and the scene stops then."""


class CommandError(Error, RuntimeError):
    """The ``selvedge`` command, which studies need, is missing, has another version, or failed."""


class ThreadsError(Error, OSError):
    """The threads could not be started, or their number is too large."""


class BrokenError(Error, RuntimeError):
    """The library has a bug; please report it. The object can no longer be used."""


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
    "TooMuchMemoryError",
]

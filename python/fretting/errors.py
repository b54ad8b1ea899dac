"""Exceptions of the library."""

import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypedDict

if TYPE_CHECKING:
    from fretting.history import History


class Mistake(NamedTuple):
    """One error in a case."""

    line: int | None
    """Line in the case text, from 1; ``None`` when the error has no single place."""
    column: int | None
    """Column in that line, from 1."""
    message: str
    """What was found, and what is allowed."""
    help: str | None
    """What to do about it, when that can be said."""


class FrettingError(Exception):
    """Base of all exceptions of the library."""

    __module__ = "fretting"


class CaseError(FrettingError, ValueError):
    """A case was refused.

    Attributes
    ----------
    mistakes : list of Mistake
        All errors found, each ``(line, column, message, help)``, in the order of the text. Line and column of a
        case given as a dict count in its TOML form, which the message shows.
    """

    __module__ = "fretting"

    mistakes: list[Mistake]

    def __init__(self, message: str, mistakes: Sequence[tuple[int | None, int | None, str, str | None]] = ()) -> None:
        super().__init__(message)
        self.mistakes = [Mistake(*mistake) for mistake in mistakes]


class UnreadableError(FrettingError, OSError):
    """A file or folder that was named cannot be read, or does not hold what was expected.

    Attributes
    ----------
    path : str
        Which one.
    """

    __module__ = "fretting"

    path: str

    def __init__(self, message: str, path: str = "") -> None:
        super().__init__(message)
        self.path = path


class MissingFileError(UnreadableError, FileNotFoundError):
    """A file or folder that was named is not there."""

    __module__ = "fretting"


class FrettingWarning(UserWarning):
    """A fact about a run that may mislead: see ``History.warnings``.

    ``warnings.simplefilter`` silences or raises it.
    """

    __module__ = "fretting"


class RunError(FrettingError, RuntimeError):
    """Raised when an increment did not converge, or the run ended before its last increment.

    No unconverged field is returned.

    Attributes
    ----------
    increment : int
        Number of the increment that could not be solved, from 0 over the whole history.
    history : History or None
        What was solved before it: a history whose ``status`` is ``"failed"``, to be looked at and to start from
        (``fretting.run(other_case, start=error.history)``).
    """

    __module__ = "fretting"

    increment: int
    history: "History | None"

    def __init__(self, message: str, increment: int = -1) -> None:
        super().__init__(message)
        self.increment = increment
        self.history = None


@dataclass(frozen=True)
class Evaluation:
    """A case that was run on the way to a design."""

    numbers: dict[str, float]
    """Its numbers, by path."""
    results: dict[str, float]
    """Its results."""
    derivatives: dict[str, dict[str, float]]
    """Their derivatives by the numbers."""


class DesignError(FrettingError, RuntimeError):
    """Raised when a design is not found: no optimum reached, limits that cannot be met, a case without an answer.

    Attributes
    ----------
    evaluations : list of Evaluation
        All cases that were run, in their order, with numbers, results and derivatives.
    """

    __module__ = "fretting"

    evaluations: list[Evaluation]

    def __init__(self, message: str, evaluations: Iterable[Evaluation] = ()) -> None:
        super().__init__(message)
        self.evaluations = list(evaluations)


class OutOfMemoryError(RunError, MemoryError):
    """A run or its threads need more memory than the machine, a container, a batch job or ``ulimit -v`` leaves.

    Nothing was begun that could not be ended.
    """

    __module__ = "fretting"


class RunInterrupted(KeyboardInterrupt):
    """Ctrl-C ended a run. ``except KeyboardInterrupt`` catches it as any other.

    Attributes
    ----------
    increment : int
        Number of the increment that was not finished, from 0 over the whole history.
    history : History
        What was solved before it: a history whose ``status`` is ``"interrupted"``, to be looked at and to start from.
    """

    __module__ = "fretting"

    increment: int
    history: "History"

    def __init__(self, message: str, history: "History") -> None:
        super().__init__(message)
        self.increment = len(history)
        self.history = history

    def __reduce__(self) -> tuple[type["RunInterrupted"], tuple[str, "History"]]:
        """Pickled with its history."""
        return type(self), (str(self), self.history)


class Fact(TypedDict):
    """A plausibility warning about a case or its result."""

    name: str
    """Stable name, such as ``"few_cells"``."""
    value: float
    """The number."""
    bound: float
    """The bound it has crossed."""
    stage: str | None
    """Name of the stage it was met in; None where it follows from the case alone."""
    message: str
    """In words."""
    help: str
    """A way out."""


def warn(facts: Iterable[Fact], stacklevel: int) -> None:
    """Pass facts on to Python's own warnings, as :class:`FrettingWarning`."""
    for fact in facts:
        warnings.warn(f"{fact['message']}; {fact['help']}", FrettingWarning, stacklevel=stacklevel + 1)

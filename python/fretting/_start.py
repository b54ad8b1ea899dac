"""The solved state from which a history starts."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, Union

from fretting import _arguments as arguments
from fretting import _core
from fretting.errors import MissingFileError

if TYPE_CHECKING:
    from fretting.history import History

_Source = Union[str, os.PathLike[str], "History"]
StartLike: TypeAlias = _Source | tuple[_Source, int]
"""A solved state: the last one of the results in a folder, or of a history.

Of another increment as a pair of either and the increment's number, from 0 (negative from the end of a history), or as
``"folder:19"``.
"""


def read(start: StartLike | _core.Start | None) -> _core.Start | None:
    """Find a state to start from.

    Raises
    ------
    UnreadableError
        When a folder does not hold it; ``MissingFileError`` when there is no such folder.
    ValueError
        When a history does not hold it.
    """
    if start is None or isinstance(start, _core.Start):
        return start
    if isinstance(start, tuple) and len(start) != 2:
        raise TypeError(f"start: expected a pair of a folder or a History and an increment, found {len(start)} things")
    source, increment = start if isinstance(start, tuple) else (start, None)
    if increment is not None:
        increment = arguments.whole("start, the number of an increment", increment)
    if not isinstance(source, str | os.PathLike):
        return _of_history(source, increment)
    folder = Path(arguments.path("start", source))
    if increment is None and isinstance(source, str) and not folder.exists():
        named, colon, number = source.rpartition(":")
        if colon and number.isdecimal():
            folder, increment = Path(named), int(number)
    if not folder.is_dir():
        what = "a file, not a folder" if folder.exists() else "no such folder"
        way = "start = the folder that `fret run` wrote, or a history"
        raise MissingFileError(f"error: {folder}: {what}\n  = help: {way}", str(folder))
    if increment is not None and increment < 0:
        raise ValueError(f"start: increment {increment} of a folder: numbers count from 0")
    return _core.Start.from_folder(folder, increment)


def _of_history(history: "History", increment: int | None) -> _core.Start:
    if not hasattr(history, "increments"):
        raise TypeError(f"start: expected a folder or a History, found {type(history).__name__}")
    count = len(history)
    if not count:
        raise ValueError("start: a history without any solved increment")
    number = count - 1 if increment is None else increment
    if not -count <= number < count:
        raise IndexError(f"start: increment {number}: the history has {count} increments")
    if history._folder is not None:
        return _core.Start.from_folder(history._folder, number % count)
    if not isinstance(history._kept, _core.History):
        raise ValueError(
            "start: a history that went through another process or a file holds no states; start from its folder"
        )
    return _core.Start.from_history(history._kept, number % count)

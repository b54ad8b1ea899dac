"""Reading a case from whatever it is given as."""

import json
import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np

from fretting import _core
from fretting.errors import CaseError

CaseLike: TypeAlias = str | os.PathLike[str] | Mapping[str, object]
"""A case: path of a TOML file, TOML text, or a mapping of the same structure."""

Json: TypeAlias = bool | int | float | str | list["Json"] | dict[str, "Json"] | None


def read(case: CaseLike) -> _core.Case:
    """Read and check a case.

    Parameters
    ----------
    case : path, str or mapping
        A ``str`` is a path when it ends with ``.toml`` or names an existing file, otherwise TOML text.

    Raises
    ------
    CaseError
        With all mistakes of the case.
    OSError
        When the file cannot be read.
    """
    if isinstance(case, Mapping):
        text = json.dumps(_plain(case, ""), allow_nan=False)
        return _core.Case.from_json(text, "case", _Beside(Path()))
    if isinstance(case, str) and not _is_path(case):
        return _core.Case.from_toml(case, "case", _Beside(Path()))
    if isinstance(case, str | os.PathLike):
        path = Path(case)
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError as error:
            raise _refusal(str(path), f"not readable as UTF-8 text: {error.reason} at byte {error.start}") from None
        return _core.Case.from_toml(text, str(path), _Beside(path.parent))
    raise TypeError(f"case: expected a path, TOML text or a dict, found {type(case).__name__}")


class _Beside:
    """Reads the files a case names: relative to the case file, or to the working folder when there is none."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def __call__(self, name: str) -> bytes:
        """Return the content of a file; an error's words become part of the refusal."""
        try:
            return (self._folder / name).read_bytes()
        except OSError as error:
            raise OSError(error.strerror or str(error)) from None


def _is_path(text: str) -> bool:
    if "\n" in text:
        return False
    if text.endswith(".toml"):
        return True
    try:
        return Path(text).is_file()
    except (OSError, ValueError):  # too long, or with a null character: no name of a file
        return False


def _plain(value: object, place: str) -> Json:
    """Turn a value of a case into what JSON can say; NumPy scalars and arrays become numbers and lists."""
    if isinstance(value, np.generic | np.ndarray):
        return _plain(value.tolist(), place)
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        if not math.isfinite(value):
            raise _refusal("case", f"{place} = {value}: must be finite")
        return value
    if isinstance(value, os.PathLike):
        return str(Path(value))
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise _refusal("case", f"{place or 'the case'} has the key {key!r}: keys are words")
        return {key: _plain(item, f"{place}.{key}" if place else key) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, bytes | bytearray):
        return [_plain(item, f"{place}[{index}]") for index, item in enumerate(value)]
    raise _refusal("case", f"{place}: {type(value).__name__} is not a number, a word, a list or a table")


def _refusal(name: str, message: str) -> CaseError:
    return CaseError(f"error: {name}: {message}", [(None, None, message, None)])

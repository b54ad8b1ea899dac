"""Reading a case from whatever it is given as."""

import copy
import json
import math
import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from fretting import _arguments as arguments
from fretting import _core
from fretting._arrays import Reals, room_for
from fretting.errors import CaseError, MissingFileError, UnreadableError

CaseLike: TypeAlias = str | os.PathLike[str] | Mapping[str, object]
"""A case: path of a TOML file, TOML text, or a mapping of the same structure.

A ``str`` with a line break is TOML text, any other a path. In a mapping, NumPy arrays stand where heights or
coefficients of friction are wanted for every cell: ``{"heights": {"values": array}}``,
``{"friction": {"map": array}}``, and ``friction`` of a stage. Relative names of files start at the folder of the case
file; at the current folder for a text or a mapping. ``None`` in a mapping stands for an absent key.
"""

Json: TypeAlias = bool | int | float | str | list["Json"] | dict[str, "Json"] | None


def read(case: CaseLike, start: _core.Start | None = None) -> _core.Case:
    """Read and check a case, whose history starts from bodies apart or from a solved state.

    Parameters
    ----------
    case : path, str or mapping
        A ``str`` with a line break is TOML text, any other a path.

    Raises
    ------
    CaseError
        With all errors of the case.
    UnreadableError
        When the file cannot be read; ``MissingFileError`` when there is none.
    """
    if isinstance(case, Mapping):
        arrays: list[Reals] = []
        text = json.dumps(plain(case, "", arrays), allow_nan=False)
        return _core.Case.from_json(text, "case", Path(), arrays, start)
    return _core.Case.from_toml(*text_of(case), start)


def table_of(case: CaseLike) -> dict[str, Any]:
    """Return a case that was read as a dict of its own: what a history keeps."""
    if isinstance(case, Mapping):
        return copy.deepcopy({**case})
    return tomllib.loads(text_of(case)[0])


def table_from_anywhere(case: CaseLike) -> dict[str, Any]:
    """Return a case as a dict of its own, which can be changed and read again: names of files keep their folder."""
    if isinstance(case, Mapping):
        return {key: _own(value, key) for key, value in case.items()}
    text, name, folder = text_of(case)
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        _core.Case.from_toml(text, name, folder)  # the core says it with the place
        raise
    return {key: _moved(value, key, folder) for key, value in table.items()}


_OF_ALL_CELLS = ("values", "map", "friction", "max_shear")
"""Keys of a case whose arrays have a number for every cell."""


def _own(value: Any, key: str, depth: int = 1) -> Any:
    """Return a value of a case with tables and lists of its own, in whatever kinds they are given."""
    if depth > _DEEPEST:
        raise _too_deep()
    if isinstance(value, Mapping):
        return {name: _own(item, name, depth + 1) for name, item in value.items()}
    if isinstance(value, np.ndarray) and value.ndim > 0 and key not in _OF_ALL_CELLS:
        return value.tolist()
    if isinstance(value, list | tuple):
        return [_own(item, key, depth + 1) for item in value]
    return copy.deepcopy(value)


NAMES_A_FILE = ("file", "map", "friction", "max_shear", "table")
"""Keys of a case whose words are names of files."""


def _moved(value: Any, key: str, folder: Path) -> Any:
    if isinstance(value, dict):
        return {name: _moved(item, name, folder) for name, item in value.items()}
    if isinstance(value, list):
        return [_moved(item, key, folder) for item in value]
    return str((folder / value).resolve()) if isinstance(value, str) and key in NAMES_A_FILE else value


def text_of(case: str | os.PathLike[str]) -> tuple[str, str, Path]:
    """Return the TOML text of a case that is no mapping, its name in messages, and the folder of its files."""
    if isinstance(case, str) and "\n" in case:
        return case, "case", Path()
    if isinstance(case, str | os.PathLike):
        path = Path(arguments.path("case", case))
        try:
            return path.read_text(encoding="utf-8"), str(path), path.parent
        except OSError as error:
            raise _unreadable(path, error) from None
        except UnicodeDecodeError as error:
            raise _refusal(str(path), f"not readable as UTF-8 text: {error.reason} at byte {error.start}") from None
    raise TypeError(f"case: expected a path, TOML text or a dict, found {type(case).__name__}")


_DEEPEST = 16
"""Tables and lists deeper than this are no case, as in a file."""


def plain(value: object, place: str, arrays: list[Reals] | None = None, depth: int = 0) -> Json:
    """Turn a value of a case into what JSON can say.

    NumPy scalars and arrays become numbers and lists; with a list `arrays`, those for every cell are put aside into
    it, and their number stands in their place.
    """
    if (
        arrays is not None
        and isinstance(value, np.ndarray)
        and place.endswith(tuple(f".{key}" for key in _OF_ALL_CELLS))
        and value.ndim > 0
    ):
        arrays.append(_field(value, place))
        return {"array": len(arrays) - 1}
    if value is np.ma.masked or isinstance(value, np.datetime64 | np.timedelta64):
        raise _refusal("case", f"{place}: {value!r} is not a number, a word, a list or a table")
    if isinstance(value, np.floating):
        return plain(float(value), place, arrays, depth)
    if isinstance(value, np.generic | np.ndarray):
        return plain(value.tolist(), place, arrays, depth)
    if isinstance(value, int) and not -(2**63) <= value < 2**64:
        raise _refusal("case", f"{place}: a whole number of more than 64 bits: not a number of a case")
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        if not math.isfinite(value):
            raise _refusal("case", f"{place} = {value}: must be finite")
        return value
    if isinstance(value, os.PathLike):
        return str(Path(value))
    if depth > _DEEPEST:
        raise _too_deep()
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise _refusal("case", f"{place or 'the case'} has the key {key!r}: keys are words")
        return {key: plain(item, f"{place}.{key}" if place else key, arrays, depth + 1) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, bytes | bytearray):
        missing = next((index for index, item in enumerate(value) if item is None), None)
        if missing is not None:
            raise _refusal("case", f"{place}[{missing}]: nothing stands there, or a value under a mask")
        return [plain(item, f"{place}[{index}]", arrays, depth + 1) for index, item in enumerate(value)]
    raise _refusal("case", f"{place}: {type(value).__name__} is not a number, a word, a list or a table")


_HOLES = "every cell needs a number"


def _field(values: npt.NDArray[Any], place: str) -> Reals:
    """Turn an array with a number for every cell into doubles; whether they are of use is the core's to say."""
    if place.endswith(".heights.values") and values.dtype.kind == "f" and np.ma.is_masked(values):
        values = np.ma.filled(values, np.nan)  # holes, which the core refuses, or fills if the case asks for it
    if np.ma.is_masked(values):
        count = int(np.count_nonzero(np.ma.getmaskarray(values)))
        raise _refusal("case", f"{place}: {count} masked values: {_HOLES}")
    if values.dtype.kind not in "fiu":
        raise _refusal("case", f"{place}: an array of {values.dtype}: must be real numbers")
    if values.ndim not in (1, 2):
        raise _refusal("case", f"{place}: an array of shape {values.shape}: must have one or two dimensions")
    room_for(f"{place} of shape {values.shape}", values.size)
    numbers = np.ascontiguousarray(np.ma.getdata(values), dtype=np.float64)
    return numbers.reshape(-1, 1) if values.ndim == 1 else numbers


def _unreadable(path: Path, error: OSError) -> UnreadableError:
    if isinstance(error, FileNotFoundError) or not path.exists():
        way = f"relative names start at the current folder, {Path.cwd()}; a case may also be TOML text or a dict"
        return MissingFileError(f"error: {path}: no such file\n  = help: {way}", str(path))
    if path.is_dir():
        way = "give the TOML file of a case; fretting.open_results(folder) opens the results of a run"
        return UnreadableError(f"error: {path}: a folder, not a file\n  = help: {way}", str(path))
    return UnreadableError(f"error: {path}: cannot be read: {error.strerror or error}", str(path))


def _too_deep() -> CaseError:
    return _refusal("case", f"tables and lists nested deeper than {_DEEPEST}, or one inside itself: not a case")


def _refusal(name: str, message: str) -> CaseError:
    return CaseError(f"error: {name}: {message}", [(None, None, message, None)])

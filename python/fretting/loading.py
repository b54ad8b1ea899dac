"""Opening what ``fret run`` or ``History.save`` has written."""

import csv
import json
import os
import tomllib
from collections import Counter
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import numpy.typing as npt

from fretting._arguments import checked
from fretting._meaning import FIELD_NAMES, STEP_KINDS
from fretting.cycles import MEANING as CYCLE_COLUMNS
from fretting.cycles import columns
from fretting.errors import MissingFileError, UnreadableError
from fretting.history import History, Table


@checked
def open_results(folder: str | os.PathLike[str]) -> History:
    """Open the folder of a run as a history; of one that is not finished what there is.

    Parameters
    ----------
    folder : path
        What ``fret run CASE --out FOLDER`` has written (``results/CASE`` where no ``--out`` was given), :func:`run`
        with ``folder=``, or :meth:`History.save`.

    Returns
    -------
    History
        As :func:`run` returns it, to the bit: numbers are stored exactly. Fields are read when they are asked for, so
        the folder has to stay where it is; a pickled history holds them itself. Of a run that was interrupted, failed
        or still goes it holds the increments solved so far; ``history.finished`` is False, ``history.status`` and
        ``history.message`` say why.

    Raises
    ------
    MissingFileError
        When there is no such folder.
    UnreadableError
        When it holds no results, or a damaged file.

    Examples
    --------
    >>> import fretting
    >>> history = fretting.open_results("results/coated_sphere")  # doctest: +SKIP
    >>> history.plot_loop()  # doctest: +SKIP
    """
    path = Path(folder)
    if not path.is_dir():
        what = "a file, not a folder" if path.exists() else "no such folder"
        _refuse(path, what, "give the folder that `fret run CASE --out FOLDER` wrote", missing=not path.exists())
    record = _record(path)
    plan = record["plan"]
    stages = [stage["name"] for stage in plan["case"]["stages"]]
    finished = record["status"] == "solved"
    steps = _steps(path / "history.csv", whole=finished)
    done = record["totals"]["increments"] if finished else len(steps["increment"])
    if len(steps["increment"]) != done or not np.array_equal(steps["increment"], np.arange(done)):
        _refuse(path / "history.csv", f"does not hold the {done} increments of the run")
    history = History.__new__(History)
    history.increments = steps
    store = _Stored(path / "fields.zarr", plan["grid"]["cells"], done, whole=finished)
    history._folder = path.resolve()
    history.status, history.message = record["status"], record.get("message")
    history._kept = store
    history.x, history.y = store.coordinate("x"), store.coordinate("y")
    history.stages = stages
    courses = [stage["course"] for stage in plan["case"]["stages"]]
    is_cyclic = any(isinstance(course, dict) and course["cycles"] is not None for course in courses)
    records = _cycles(path / "cycles.csv", whole=finished) if is_cyclic else []
    history.case = _case(path)
    history.plan, history.version = plan, record["version"]
    history.error_bars = _error_bars(path)
    history.cycles = Table(columns([cycle for cycle in records if cycle["last_increment"] < done]))
    history.running_conditions = [_running_condition(history.cycles, stage) for stage in range(len(stages))]
    history.worn_through = record.get("worn_through")
    history.worn_by_layer = record.get("worn_by_layer")
    history.warnings = record.get("warnings", [])
    history._bodies = json.dumps(plan["case"]["bodies"])
    history._residual_stress = json.dumps(plan["case"].get("residual_stress", [{"layers": []}, {"layers": []}]))
    dx, dy = plan["grid"]["spacing"]
    history._spacing = (dx, dy)
    history._periodic = bool(plan["case"]["periodic"])
    return history


def _case(path: Path) -> dict[str, Any]:
    place = path / "case.toml"
    try:
        return tomllib.loads(_read(place).decode("utf-8"))
    except ValueError as error:
        _refuse(place, f"not the text of a case: {error}")


def _error_bars(path: Path) -> dict[str, Any] | None:
    place = path / "error_bars.json"
    if not place.is_file():
        return None
    try:
        return dict(json.loads(_read(place)))
    except (ValueError, TypeError) as error:
        _refuse(place, f"not what a run writes: {error}")


class _Stored:
    """Fields in a run's store: little-endian numbers, one file per increment."""

    def __init__(self, path: Path, cells: list[int], increments: int, whole: bool) -> None:
        self._path = path
        self._cells = (cells[0], cells[1])
        self._steps = [int(step) for step in self._numbers(path / "increment" / "c" / "0", "<i8")]
        if not whole:  # those that the run will keep stand there from its start
            self._steps = [step for step in self._steps if step < increments]
        if self._steps != sorted(set(self._steps)) or not set(self._steps) <= set(range(increments)):
            _refuse(path / "increment", "does not hold numbers of increments")
        self._names = [name for name in FIELD_NAMES if (path / name / "zarr.json").is_file()]

    def coordinate(self, name: str) -> npt.NDArray[np.float64]:
        if name == "y" and self._cells[1] == 1:  # a line contact, the same all along y
            return np.zeros(1)
        centres = self._numbers(self._path / name / "c" / "0", "<f8").astype(np.float64)
        if len(centres) != self._cells["xy".index(name)] or not np.isfinite(centres).all():
            _refuse(self._path / name, "does not hold the centres of the grid's cells")
        return centres

    def kept_increments(self) -> list[int]:
        return list(self._steps) if self._names else []

    def kept_fields(self, increment: int) -> list[str]:
        return list(self._names) if increment in self._steps else []

    def field(self, name: str, increment: int) -> npt.NDArray[Any]:
        place = self._path / name / "c" / str(self._steps.index(increment)) / "0"
        if self._cells[1] > 1:
            place /= "0"
        zone = name == "zone"
        values = self._numbers(place, "|u1" if zone else "<f8")
        if values.size != self._cells[0] * self._cells[1]:
            _refuse(place, f"holds {values.size} numbers, not those of {self._cells[0]} x {self._cells[1]} cells")
        if (zone and values.max(initial=0) > 2) or (not zone and not np.isfinite(values).all()):
            _refuse(place, "holds values that are none of a field")
        return values.reshape(self._cells).astype(np.uint8 if zone else np.float64)

    @staticmethod
    def _numbers(path: Path, kind: str) -> npt.NDArray[Any]:
        content = _read(path)
        if len(content) % np.dtype(kind).itemsize:
            _refuse(path, "does not hold whole numbers of bytes")
        return np.frombuffer(content, dtype=kind)


def _record(path: Path) -> dict[str, Any]:
    """Return ``run.json`` of a run, with what is needed of it."""
    place = path / "run.json"
    way = "give the folder that `fret run CASE --out FOLDER` wrote"
    if not place.is_file():
        _refuse(path, "not a folder of results: it has no run.json", way)
    try:
        record = json.loads(_read(place))
        if record["program"] != "fretting" or record["format"] != 1:
            _refuse(path, "results of another program, or of another version of the format", way)
        case, grid = record["plan"]["case"], record["plan"]["grid"]
        _ = case["bodies"], case["periodic"], record["version"]
        if record["status"] == "solved":
            _ = record["totals"]["increments"]
        _ = [(stage["name"], stage["course"]) for stage in case["stages"]]
        if [len(grid["cells"]), len(grid["spacing"])] != [2, 2]:
            raise ValueError("a grid has two sides")
    except (ValueError, KeyError, TypeError) as error:
        _refuse(place, f"not what a run writes: {type(error).__name__}: {error}")
    return dict(record)


def _steps(path: Path, whole: bool) -> Table:
    """Return the columns of ``history.csv``."""
    rows = list(csv.reader(_lines(path, whole)))
    head, body = [_name(cell) for cell in rows[0]], rows[1:]
    wanted = [name for name in head if name in STEP_KINDS]
    if lost := [name for name in STEP_KINDS if name not in head]:
        _refuse(path, f"has no column {lost[0]}; it may be of an earlier version: run the case again")
    try:
        return Table((name, _column(name, [row[head.index(name)] for row in body])) for name in wanted)
    except (ValueError, IndexError) as error:
        _refuse(path, f"not the table of a run: {error}")


def _name(heading: str) -> str:
    """Return the name of a column, whose head has its unit in brackets where the case declares units."""
    return heading.partition(" [")[0]


def _column(name: str, cells: list[str]) -> npt.NDArray[Any]:
    return np.array(cells, dtype={int: np.int64, float: np.float64, str: np.str_}[STEP_KINDS[name]])


def _cycles(path: Path, whole: bool) -> list[dict[str, Any]]:
    """Return the lines of ``cycles.csv``."""
    rows = csv.DictReader(_lines(path, whole))
    try:
        named = [{_name(head): cell for head, cell in row.items()} for row in rows]
        return [{name: _value(row[name]) for name in CYCLE_COLUMNS} for row in named]
    except (AttributeError, KeyError, TypeError) as error:
        _refuse(path, f"not the table of a run's cycles: {error}")


def _value(cell: str) -> object:
    if cell in ("", "true", "false"):
        return {"": None, "true": True, "false": False}[cell]
    for kind in (int, float):
        try:
            return kind(cell)
        except ValueError:
            pass
    return cell


def _running_condition(cycles: dict[str, npt.NDArray[Any]], stage: int) -> str | None:
    """Return the fretting regime of a stage: gross if all cycles slide, partial if none slides or is mixed."""
    regimes = Counter(str(regime) for regime in cycles["regime"][cycles["stage"] == stage] if regime)
    if not regimes:
        return None
    if set(regimes) == {"gross_slip"}:
        return "gross"
    return "mixed" if {"gross_slip", "mixed"} & set(regimes) else "partial"


def _lines(path: Path, whole: bool) -> list[str]:
    """Return the lines of a table.

    Of one that is not whole the last may be torn, by a kill or since it is being written.
    """
    text = _read(path).decode("utf-8", "replace")
    if not text.endswith("\n"):
        if whole or "\n" not in text:
            _refuse(path, "ends in the middle of a line")
        text = text[: text.rindex("\n") + 1]
    return text.splitlines()


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        _refuse(path, "is missing", "run the case again", missing=True)
    except OSError as error:
        _refuse(path, f"cannot be read: {error.strerror or error}")


def _refuse(path: Path, what: str, way: str = "run the case again", missing: bool = False) -> NoReturn:
    kind = MissingFileError if missing else UnreadableError
    raise kind(f"error: {path}: {what}\n  = help: {way}", str(path)) from None

"""Opening what ``fret run`` or ``History.save`` has written."""

import json
import os
import tomllib
from pathlib import Path
from typing import Any, NoReturn

from fretting import _core
from fretting._arguments import checked
from fretting.errors import MissingFileError, UnreadableError
from fretting.history import History


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
    if not path.exists():
        _refuse(path, "no such folder", "give the folder that `fret run CASE --out FOLDER` wrote", missing=True)
    stored = _core.StoredRun(path.absolute())  # fields are read later, when the current folder may be another
    record = json.loads(stored.record())
    history = History.__new__(History)
    history._take(stored, record)
    history._folder = path.resolve()
    history._continues = record.get("start") is not None
    history.case = _case(path)
    history.error_bars = _error_bars(path)
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

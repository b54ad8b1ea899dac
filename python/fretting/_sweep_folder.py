"""Where a sweep keeps its finished points, so that an interrupted sweep can be resumed."""

import hashlib
import json
import math
import os
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from fretting._case import NAMES_A_FILE
from fretting._core import __version__
from fretting._paths import Table
from fretting.errors import UnreadableError

FORMAT = 1
"""Version of the folder's format."""


class OccupiedError(UnreadableError, FileExistsError):
    """A folder for a sweep holds something else."""

    __module__ = "fretting"


class SweepFolder:
    """A folder: ``sweep.json`` says what was swept, ``points/HASH.json`` is a finished point.

    A point is known by the hash of its whole case, of the files the case names, of what is kept of it, and of the
    version of the library: whatever changes, changes the name, and the point is solved anew.
    """

    def __init__(self, path: str | os.PathLike[str], base: Table, settings: dict[str, Any]) -> None:
        self.path = Path(path)
        self._settings = {"version": __version__, **settings}
        record = self.path / "sweep.json"
        if self.path.exists() and not self.path.is_dir():
            raise OccupiedError(f"{self.path}: a file, not a folder for a sweep", str(self.path))
        if not record.exists() and self.path.is_dir() and any(self.path.iterdir()):
            what = "holds files that are no sweep; choose another folder"
            raise OccupiedError(f"{self.path}: {what}", str(self.path))
        fingerprint = _hash([base, _contents(base)])
        before = _read(record)
        if before and before.get("base") not in (None, fingerprint):
            warnings.warn(f"{self.path}: the base case has changed since the last sweep", UserWarning, stacklevel=4)
        try:
            (self.path / "points").mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UnreadableError(f"error: {self.path}: {error.strerror or error}", str(self.path)) from None
        write_whole(record, {"format": FORMAT, "program": "fretting", "base": fingerprint, **self._settings})

    def finished(self, case: Table) -> Table | None:
        """Return the result of a finished point; a file that cannot be read is no result."""
        answer = _read(self._place(case))
        if not answer or answer.get("format") != FORMAT or "status" not in answer:
            return None
        return _with_measured(answer, _READ)

    def keep(self, case: Table, answer: Table) -> None:
        """Write a finished point down: whole or not at all."""
        write_whole(self._place(case), {"format": FORMAT, "case": case, **_with_measured(answer, _WRITTEN)})

    def _place(self, case: Table) -> Path:
        return self.path / "points" / f"{_hash([case, _contents(case), self._settings])}.json"


_WRITTEN: dict[object, object] = {math.inf: "inf", -math.inf: "-inf"}
"""What stands in a file for numbers without bound, which JSON does not have."""

_READ: dict[object, object] = {word: value for value, word in _WRITTEN.items()}


def _with_measured(answer: Table, words: dict[object, object]) -> Table:
    """Return an answer with others for some of the values of `measure`, an endless life among them."""
    if not answer.get("measured"):
        return answer

    def replaced(value: object) -> object:
        if isinstance(value, list):
            return [replaced(inner) for inner in value]
        return words.get(value, value)

    return {**answer, "measured": {name: replaced(value) for name, value in answer["measured"].items()}}


def write_whole(path: Path, content: Table) -> None:
    """Write a file so that a kill at any moment leaves the old content or the new one."""
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        with part.open("w", encoding="utf-8") as file:
            json.dump(content, file, allow_nan=False)
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def _read(path: Path) -> Table | None:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return content if isinstance(content, dict) else None


def _hash(content: object) -> str:
    text = json.dumps(content, sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _contents(case: Table) -> dict[str, str]:
    """Hashes of the files that a case names."""
    found = {}
    for name in _file_names(case):
        try:
            found[name] = hashlib.sha256(Path(name).read_bytes()).hexdigest()
        except (OSError, ValueError):
            continue  # not there: the judgement of the case will say so
    return found


def _file_names(value: object, key: str = "") -> Iterator[str]:
    if isinstance(value, dict):
        for name, item in value.items():
            yield from _file_names(item, name)
    elif isinstance(value, list):
        for item in value:
            yield from _file_names(item, key)
    elif isinstance(value, str) and key in NAMES_A_FILE:
        yield value

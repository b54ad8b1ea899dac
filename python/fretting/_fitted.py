"""What every fit to a measured log answers."""

import json
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from fretting._arguments import checked, mapping, of_kind, text
from fretting._arrays import Reals
from fretting.errors import UnreadableError


def named(name: str, given: Any, numbered: bool = False) -> list[tuple[str, str]]:
    """Return what stands by the names of columns; numbers, which count from 1, as words, where they may stand there."""
    found = []
    for role, entry in mapping(name, {} if given is None else given).items():
        number = numbered and isinstance(entry, int | np.integer) and not isinstance(entry, bool)
        found.append((text(name, role), str(entry) if number else text(f"{name}[{role!r}]", entry)))
    return found


class Fitted:
    """The record of a fit and its page, as the command writes them."""

    def __init__(self, answer: Mapping[str, Any], page: str, function: str, key: str) -> None:
        """Take what ``function`` gives; its record has a ``key`` that those of other fits have not."""
        if not isinstance(answer, Mapping) or key not in answer:
            raise TypeError(f"answer: expected what a fit gives (fretting.{function}), found {type(answer).__name__}")
        self._answer, self._page = answer, of_kind("page", page, str)
        self.noise: float = answer["noise"]
        self.notes: list[str] = list(answer["notes"])
        self.measured: dict[str, Reals] = {name: np.array(values) for name, values in answer["measured"].items()}
        self.computed: dict[str, Reals] = {name: np.array(values) for name, values in answer["computed"].items()}

    def to_json(self) -> str:
        """Return all of it as ``fret identify`` writes it into ``identified.json``."""
        return json.dumps(self._answer, indent=2)

    @checked
    def save(self, folder: str | PathLike[str]) -> None:
        """Write ``identified.json`` and the page ``identified.html`` with its pictures into a folder."""
        place = Path(folder)
        try:
            place.mkdir(parents=True, exist_ok=True)
            (place / "identified.json").write_text(self.to_json() + "\n", encoding="utf-8")
            (place / "identified.html").write_text(self._page, encoding="utf-8")
        except OSError as error:
            raise UnreadableError(f"error: {place}: {error.strerror or error}", str(place)) from None

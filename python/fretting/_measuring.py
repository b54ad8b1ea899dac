"""What `measure` of a sweep gives at every point: numbers, words and arrays, of the same shapes everywhere."""

import warnings
from typing import Any

import numpy as np

from fretting._meaning import MEANING
from fretting._paths import Table
from fretting._points import RESERVED, Point
from fretting.errors import FrettingWarning

UNMEASURED = "measure: "
"""What the message of a point begins with that is solved, but not measured."""


class Measuring:
    """What `measure` gives, point by point: it must work at the first, and give everywhere what it gave there."""

    def __init__(self, taken: set[str]) -> None:
        self._taken = taken
        self._shapes: dict[str, tuple[int, ...]] | None = None
        self._failed: list[str] = []

    def judge(self, point: Point, answer: Table, failure: Exception | None) -> Table:
        """Return the answer of a point, without what is measured where that is of no use."""
        if answer["status"] != "solved":
            return answer
        shapes = {name: np.shape(value) for name, value in answer["measured"].items()}
        if failure is None:
            for name in self._taken & set(shapes):
                failure = ValueError(f"measure: the name {name!r} is taken by a parameter")
            known = self._shapes or {}
            for name in shapes:
                if known.get(name, shapes[name]) != shapes[name]:
                    before = f"{known[name]} at another point"
                    failure = ValueError(f"measure: {name} has the shape {shapes[name]} here and {before}")
        if failure is None:
            self._shapes = {**shapes, **(self._shapes or {})}
            return answer
        if self._shapes is None:
            failure.add_note(f"measure, at the first point that is solved: {point.name}")
            raise failure
        self._failed.append(f"{point.name}: {type(failure).__name__}: {failure}")
        return {**answer, "measured": {}, "error": f"{UNMEASURED}{type(failure).__name__}: {failure}"}

    def warn(self, count: int) -> None:
        """Say where nothing was measured."""
        if self._failed:
            warnings.warn(
                f"measure failed at {len(self._failed)} of {count} points, which keep their other numbers; the first: "
                f"{self._failed[0]}",
                FrettingWarning,
                stacklevel=3,
            )


def all_measured(given: object) -> Table:
    """Return all that `measure` gave as a file can hold it."""
    try:
        found = dict(given)  # type: ignore[call-overload]
    except (TypeError, ValueError):
        raise TypeError(
            "measure: must return a mapping from names to numbers, words or arrays, such as {'peak': 1e9}; "
            f"it returned {type(given).__name__}"
        ) from None
    return {name: _measured(name, value) for name, value in found.items()}


def _measured(name: object, value: object) -> Any:
    """Return what is measured as a file can hold it; refuse what no variable can be made of."""
    if not isinstance(name, str):
        raise TypeError(f"measure: a name is a str, and {name!r} is {type(name).__name__}")
    if name in MEANING or name.startswith("cycle_") or name in RESERVED:
        raise ValueError(f"measure: the name {name!r} is taken")
    array = np.asarray(value)
    if array.dtype.kind == "U":
        return array.tolist()
    if array.dtype.kind not in "fiub":
        raise TypeError(f"measure: {name} is no number, no text and no array of them, but {type(value).__name__}")
    if np.isnan(array).any():
        raise ValueError(f"measure: {name} is not a number everywhere")
    return array.astype(np.float64).tolist()


def measured_variable(
    name: str, names: tuple[str, ...], shape: tuple[int, ...], answers: dict[tuple[int, ...], Table]
) -> Any:
    """Return dimensions and values of what is measured: missing where there is nothing."""
    values = {place: np.asarray(a["measured"][name]) for place, a in answers.items() if name in a["measured"]}
    inner = next(iter(values.values())).shape
    are_texts = any(value.dtype.kind == "U" for value in values.values())
    table = np.full((*shape, *inner), "" if are_texts else np.nan, dtype=object if are_texts else np.float64)
    for place, value in values.items():
        table[place] = value
    table = table.astype(str) if are_texts else table
    return (*names, *(f"{name}_{number}" for number in range(len(inner)))), table

"""A history to look through in a notebook: loop and field of one increment, with a slider over those that are kept.

Nothing is solved again; the numbers are those of the history.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import anywidget
import numpy as np
import numpy.typing as npt
import traitlets

from fretting import plot
from fretting._arguments import matplotlib
from fretting._meaning import VECTORS, in_units, label, unit
from fretting._style import BLUE, VERMILION

if TYPE_CHECKING:
    from fretting.history import History

TOLD = ("normal_force", "approach", "max_pressure", "contact_area", "dissipated_energy")
"""Columns that are told of each increment, beside those of the loop."""


class Explorer(anywidget.AnyWidget):
    """Loop and field of a history.

    Attributes
    ----------
    place : int
        Where the slider is: a number of ``history.kept_increments``, from 0.
    field : str
        Name of the field that is shown.
    seen : dict
        What is shown: increment, numbers, colours of the cells.
    """

    _esm = Path(__file__).parent / "_explorer.js"
    setting = traitlets.Dict().tag(sync=True)
    place = traitlets.Int(0).tag(sync=True)
    field = traitlets.Unicode().tag(sync=True)
    seen = traitlets.Dict().tag(sync=True)

    def __init__(self, history: "History", field: str | None = None, *, along: plot.Motion | None = None) -> None:
        kept = history.kept_increments
        if not kept:
            raise ValueError("no fields are kept: [output] every = 1 keeps those of all increments")
        self._history = history
        self._columns = _path(history, along)
        self._limits: dict[str, tuple[float, float]] = {}
        setting = _setting(history, self._columns)
        names = setting["fields"]
        chosen = field or ("zone" if "zone" in names else names[0])
        if chosen not in names:
            raise ValueError(
                f"field = {chosen!r}: kept are {', '.join(names)} ([output] fields of the case keeps others)"
            )
        force = np.abs(history.increments[self._columns[1]][kept])
        super().__init__(setting=setting, field=chosen, place=int(force.argmax()))
        self._show()

    @traitlets.validate("place")
    def _inside(self, proposal: dict[str, Any]) -> int:
        last = len(self._history.kept_increments) - 1
        return min(max(int(proposal["value"]), 0), last)

    @traitlets.validate("field")
    def _known(self, proposal: dict[str, Any]) -> str:
        names = ", ".join(_fields(self._history))
        if proposal["value"] not in _fields(self._history):
            raise traitlets.TraitError(f"field = {proposal['value']!r}: must be one of {names}")
        return str(proposal["value"])

    @traitlets.observe("place", "field")
    def _changed(self, _: object) -> None:
        if self.seen:
            self._show()

    def _show(self) -> None:
        history, name = self._history, self.field
        increment = history.kept_increments[self.place]
        values = history.field(name, increment)
        row = {column: history.increments[column][increment] for column in (*TOLD, *self._columns)}
        told = [[column.replace("_", " "), self._told(column, value)] for column, value in row.items()]
        condition = history.increments["regime"][increment].replace("_", " ")
        seen: dict[str, Any] = {
            "increment": increment,
            "stage": int(history.increments["stage"][increment]),
            "here": [float(row[column]) for column in self._columns],
            "name": label(name, history._units),
            "numbers": [["condition", condition], *told],
            "legend": [],
        }
        if history.is_line:
            seen["line"] = np.column_stack([history.x, values]).tolist()
            seen["range"] = list(self._range(name))
        else:
            seen["colours"], seen["legend"] = self._coloured(name, values)
        self.seen = seen

    def _told(self, column: str, value: float) -> str:
        kind = in_units(unit(column), self._history._units) if self._history._units else ""
        return f"{value:.5g} {kind}".rstrip()

    def _range(self, name: str) -> tuple[float, float]:
        """Return the limits of a field over all increments: colours mean the same everywhere."""
        if name not in self._limits:
            fields = [self._history.field(name, step) for step in self._history.kept_increments]  # type: ignore[arg-type]
            ends = np.array([[values.min(), values.max()] for values in fields])
            low, high = plot._limits(np.array([ends[:, 0].min(), ends[:, 1].max()]))
            self._limits[name] = (low, high if high > low else low + 1.0)
        return self._limits[name]

    def _coloured(self, name: str, values: npt.NDArray[Any]) -> tuple[bytes, list[list[str]]]:
        """Return the colours of the cells, rows from the top, four bytes each; and what they mean."""
        library = matplotlib()
        rows = values.T[::-1]
        if name == "zone":
            table = np.array([matplotlib("matplotlib.colors").to_rgba(colour) for _, colour in plot.ZONES])
            colours = table[rows.astype(np.int64)]
            meaning = [[word, colour.lower()] for word, colour in plot.ZONES]
        else:
            low, high = self._range(name)
            colours = library.colormaps["RdBu_r" if low < 0.0 else "viridis"]((rows - low) / (high - low))
            kind = in_units(unit(name), self._history._units)
            meaning = [[f"{name.replace('_', ' ')} from", f"{low:.4g}"], ["to", f"{high:.4g} {kind}"]]
        return np.rint(255 * colours).astype(np.uint8).tobytes(), meaning


def _fields(history: "History") -> list[str]:
    """Return the names of what can be shown: fields of one number in each cell."""
    found = []
    for name in history._kept.kept_fields(history.kept_increments[-1]):
        parts = (f"{name}_x", f"{name}_y") if name in VECTORS else (name,)
        found += [part for part in parts if not (history.is_line and part == "zone")]
    return found


def _path(history: "History", along: plot.Motion | None) -> tuple[str, str]:
    """Return the columns of motion and force: of the loop, or of pressing where nothing else moves."""
    motion, force = plot._loop_columns(history, along, None)
    if along is None and not np.ptp(history.increments[force]) > 0.0:
        return "approach", "normal_force"
    return motion, force


def _axis(history: "History", column: str) -> str:
    """Return the label of an axis of the path."""
    return plot._loop_label(history, column) if column in plot._LOOP_LABELS else label(column, history._units)


def _setting(history: "History", columns: tuple[str, str]) -> dict[str, Any]:
    """Return what does not change while the slider moves."""
    motion, force = (history.increments[column] for column in columns)
    length = in_units("length", history._units)
    return {
        "path": np.column_stack([motion, force]).tolist(),
        "axes": [_axis(history, column) for column in columns],
        "stages": list(history.stages),
        "kept": list(history.kept_increments),
        "fields": _fields(history),
        "cells": list(history.shape),
        "x": list(plot._ends(history.x)),
        "y": list(plot._ends(history.y)),
        "lengths": [f"x [{length}]", f"y [{length}]"],
        "colours": {"line": BLUE, "here": VERMILION},
    }

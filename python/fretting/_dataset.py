"""A history as an xarray Dataset."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from fretting._arguments import needed
from fretting._meaning import CYCLE_MEANING, FIELD_NAMES, MEANING, ZONE_NAMES, described

if TYPE_CHECKING:
    import xarray

    from fretting.history import History


def module(what: str) -> Any:
    """Return xarray, or say what needs it."""
    return needed("xarray", f"{what} needs xarray: pip install 'fretting[xarray]'")


def axes(history: "History") -> dict[str, Any]:
    """Return the centres of the cells along the axes of the surface."""
    along = {"x": history.x} if history.is_line else {"x": history.x, "y": history.y}
    return {
        name: (name, centres, described(f"cell centres along {name} [length]", history._units))
        for name, centres in along.items()
    }


def on_cells(history: "History", values: npt.NDArray[Any], words: str, *before: str) -> tuple[Any, ...]:
    """Return a variable of cells with its meaning; ``before`` are the dimensions before those of the surface."""
    across = ("x",) if history.is_line else ("y", "x")
    shaped = values.reshape(*values.shape[: len(before)], *history.shape)
    if not history.is_line:
        shaped = np.swapaxes(shaped, -1, -2)
    return (*before, *across), shaped, described(words, history._units)


def place(history: "History", axis: int, cell: float) -> float:
    """Return where a cell, counted from the first and not always whole, lies along an axis; 0 along a line contact."""
    centres = (history.x, history.y)[axis]
    return float(centres[0]) + cell * history.plan["grid"]["spacing"][axis] if len(centres) > 1 else 0.0


def numbers(history: "History", along: str, values: Iterable[float | None], words: str) -> tuple[Any, ...]:
    """Return a variable of numbers along a dimension; NaN where there is none."""
    known = np.array(list(values), dtype=float)
    return (along,), known, described(words, history._units)


def span(history: "History", cycle: int) -> tuple[int, int]:
    """Return the first and the last increment of a computed cycle."""
    count = len(history.cycles["cycle"])
    if not -count <= cycle < count:
        raise IndexError(f"cycle {cycle}: the history has {count} computed cycles, counted from 0")
    first, last = (int(history.cycles[name][cycle]) for name in ("first_increment", "last_increment"))
    return first, last


def rolls(history: "History", cycle: int, frame: str | None = None) -> bool:
    """Return whether the contact rolls in a computed cycle, in this frame or in any."""
    own = (history.plan["case"].get("kinematics") or {}).get("frame", "bodies")
    first, last = span(history, cycle)
    columns = [history.increments[name] for name in ("roll_x", "roll_y") if name in history.increments]
    way = (column[max(first - 1, 0) : last + 1] for column in columns)
    return frame in (None, own) and any(bool(np.ptp(part) > 0) for part in way)


def of_history(history: "History", every: bool) -> "xarray.Dataset":
    """Return a Dataset of every increment, or of the kept ones alone: see :meth:`fretting.History.to_xarray`."""
    library = module("to_xarray")
    kept = np.asarray(history.kept_increments, dtype=np.int64)
    chosen = np.arange(len(history)) if every else kept
    fields_along = "kept_increment" if every else "increment"
    increment = {"long_name": MEANING["increment"]}
    coordinates: dict[str, Any] = {
        "increment": ("increment", chosen, increment),
        "stage": ("increment", history.increments["stage"][chosen], {"long_name": MEANING["stage"]}),
        "stage_name": ("increment", _names(history, history.increments["stage"][chosen])),
        **axes(history),
    }
    across = ("x",) if history.is_line else ("y", "x")
    variables: dict[str, Any] = {
        name: ("increment", column[chosen], described(MEANING[name], history._units))
        for name, column in history.increments.items()
        if name not in ("increment", "stage")
    }
    fields = {name: stack for name in FIELD_NAMES if (stack := _stack(history, name)) is not None}
    if fields and every:
        coordinates["kept_increment"] = (
            "kept_increment",
            kept,
            {"long_name": "number of an increment whose fields are kept"},
        )
    for name, stack in fields.items():
        attributes: dict[str, Any] = described(MEANING[name], history._units)
        if name == "zone":
            attributes["flag_values"] = np.arange(len(ZONE_NAMES), dtype=np.uint8)
            attributes["flag_meanings"] = " ".join(ZONE_NAMES)
        variables[name] = ((fields_along, *across), stack, attributes)
    if len(history.cycles["cycle"]):
        coordinates |= _cycle_coordinates(history)
        for name, column in history.cycles.items():
            if name not in ("cycle", "stage"):
                meaning = described(CYCLE_MEANING[name], history._units, history.cycles["drive"].tolist())
                variables[f"cycle_{name}"] = ("cycle", column, meaning)
    attributes = {"stages": history.stages, "status": history.status}
    dataset: xarray.Dataset = library.Dataset(variables, coords=coordinates, attrs=attributes)
    return dataset


def _stack(history: "History", name: str) -> npt.NDArray[Any] | None:
    """Return a field of all kept increments, shape (kept, ny, nx) or (kept, nx); None when it is not kept."""
    if not history.kept_increments or name not in history._kept.kept_fields(history.kept_increments[0]):
        return None
    shape = (len(history.kept_increments), *reversed(history.shape))
    stack = np.empty(shape, dtype=np.uint8 if name == "zone" else np.float64)
    for place, increment in enumerate(history.kept_increments):
        stack[place] = history._kept.field(name, increment).reshape(history.shape).T
    return stack


def _cycle_coordinates(history: "History") -> dict[str, Any]:
    number, stage = history.cycles["cycle"], history.cycles["stage"]
    return {
        "cycle": (
            "cycle",
            np.arange(len(number)),
            {"long_name": "number of the computed cycle in the history, from 0"},
        ),
        "cycle_number": ("cycle", number, {"long_name": CYCLE_MEANING["cycle"]}),
        "cycle_stage": ("cycle", stage, {"long_name": CYCLE_MEANING["stage"]}),
        "cycle_stage_name": ("cycle", _names(history, stage)),
    }


def _names(history: "History", stages: npt.NDArray[Any]) -> npt.NDArray[np.str_]:
    return np.array([history.stages[stage] for stage in stages], dtype=np.str_)

"""A history as an xarray Dataset."""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from fretting import cycles
from fretting._meaning import FIELD_NAMES, MEANING, ZONE_NAMES, described

if TYPE_CHECKING:
    import xarray

    from fretting.history import History


def module(what: str) -> Any:
    """Return xarray, or say what needs it."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError(f"{what} needs xarray: pip install 'fretting[xarray]'") from error
    return xarray


def of_history(history: "History", every: bool) -> "xarray.Dataset":
    """Return a Dataset of every increment, or of the kept ones alone: see :meth:`fretting.History.to_xarray`."""
    library = module("to_xarray")
    kept = np.asarray(history.kept_increments, dtype=np.int64)
    chosen = np.arange(len(history)) if every else kept
    fields_along = "kept_increment" if every else "increment"
    increment = {"long_name": MEANING["increment"]}
    coordinates: dict[str, Any] = {
        "increment": ("increment", chosen, increment),
        "x": ("x", history.x, described("cell centres along x [length]", history._units)),
        "stage": ("increment", history.increments["stage"][chosen], {"long_name": MEANING["stage"]}),
        "stage_name": ("increment", _names(history, history.increments["stage"][chosen])),
    }
    if not history.is_line:
        coordinates["y"] = ("y", history.y, described("cell centres along y [length]", history._units))
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
                variables[f"cycle_{name}"] = ("cycle", column, described(cycles.MEANING[name], history._units))
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
        "cycle_number": ("cycle", number, {"long_name": cycles.MEANING["cycle"]}),
        "cycle_stage": ("cycle", stage, {"long_name": cycles.MEANING["stage"]}),
        "cycle_stage_name": ("cycle", _names(history, stage)),
    }


def _names(history: "History", stages: npt.NDArray[Any]) -> npt.NDArray[np.str_]:
    return np.array([history.stages[stage] for stage in stages], dtype=np.str_)

"""Subsurface stress of a history, as a Dataset."""

import json
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from fretting import _core, _dataset
from fretting._arrays import real_array
from fretting._meaning import described

if TYPE_CHECKING:
    import xarray

    from fretting.history import History

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")


def refuse_thinned(history: "History") -> None:
    """Refuse stresses below layers that became thinner in the run: they are computed for unworn layers."""
    if (history.plan["case"].get("wear") or {}).get("thinning_tolerance") is not None:
        raise ValueError(
            "wear.thinning_tolerance: the layers of this run became thinner by wear, and stresses below are those of "
            "unworn layers; a case with the thinner coating has them"
        )


def subsurface(
    history: "History",
    depths: npt.ArrayLike,
    increment: int,
    body: Literal["lower", "upper"],
    displacement: bool,
    threads: int | None,
) -> "xarray.Dataset":
    """Return stresses and displacements: see :meth:`fretting.History.subsurface`."""
    module = _dataset.module("subsurface")
    refuse_thinned(history)
    if displacement and (history.is_line or isinstance(history.plan["case"]["periodic"], str)):
        raise ValueError(
            "displacement: below a line contact, or another without end along one axis, displacements are not computed"
        )
    pressure = on_grid(history, history.field("pressure", increment))
    shear = None
    if not frictionless(history):
        x, y = (on_grid(history, part) for part in history.field("shear", increment))
        shear = (x, y)
    loads = pressure, shear, None, bulk_stress(history, increment, body)
    asked = (json.dumps(history.plan), body == "upper"), loads, points(depths), threads
    answer = _core.subsurface_stress(*asked)
    variables: dict[str, Any] = {
        name: _dataset.on_cells(history, answer[name], f"stress {name}, tension positive [pressure]", "depth")
        for name in COMPONENTS
    }
    variables["von_mises"] = _dataset.on_cells(history, answer["von_mises"], "von Mises stress [pressure]", "depth")
    stress = {name: variables[name][1] for name in COMPONENTS}
    tensor = np.stack([np.stack([stress["".join(sorted(i + j))] for j in "xyz"], axis=-1) for i in "xyz"], axis=-1)
    principal = np.moveaxis(np.linalg.eigvalsh(tensor)[..., ::-1], -1, 0)
    variables["principal"] = (
        ("order", *variables["xx"][0]),
        principal,
        described("principal stress, tension positive [pressure]", history._units),
    )
    if displacement:
        moved = _core.subsurface_displacement(*asked)
        for name, values in moved.items():
            words = f"displacement of the {body} body along {name[-1]} [length]"
            variables[name] = _dataset.on_cells(history, values, words, "depth")
    axes = {
        **coordinates(history, answer),
        "order": ("order", np.arange(1, 4), {"long_name": "1: the largest principal stress"}),
    }
    attributes = {"body": body, "increment": history._number(increment)}
    dataset: xarray.Dataset = module.Dataset(variables, coords=axes, attrs=attributes)
    return dataset


def bulk_stress(history: "History", number: int, body: str) -> tuple[float, float]:
    """Return the bulk stress of a body along x and y."""
    name = "bulk_stress" if body == "lower" else "upper_bulk_stress"
    x, y = (float(history.increments[f"{name}_{axis}"][number]) for axis in "xy")
    return x, y


def coordinates(history: "History", answer: dict[str, npt.NDArray[Any]]) -> dict[str, Any]:
    """Return depths with their layers and the axes of the surface."""
    return {
        "depth": ("depth", answer["depth"], described("depth under the surface [length]", history._units)),
        "layer": ("depth", answer["layer"], {"long_name": "layer: 0 is the outermost coating"}),
        **_dataset.axes(history),
    }


def points(depths: npt.ArrayLike) -> list[float]:
    """Return depths as a list."""
    known = np.atleast_1d(real_array("depths", depths))
    points: list[float] = real_array("depths", known, dimensions=1).tolist()
    return points


def on_grid(history: "History", field: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """Return a field with both axes, a line contact's too."""
    return np.ascontiguousarray(field.reshape(len(history.x), len(history.y)))


def frictionless(history: "History") -> bool:
    """Tell whether there was never friction, and so no shear."""
    return "frictionless" in history.increments["regime"]

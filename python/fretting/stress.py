"""Subsurface stress and fatigue of a history, as Datasets."""

import json
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from fretting import _core, _dataset
from fretting._arrays import real_array
from fretting._meaning import described

if TYPE_CHECKING:
    import xarray

    from fretting.history import History

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
PARAMETERS = {
    "smith_watson_topper": "Smith-Watson-Topper parameter, largest of all planes [pressure]",
    "fatemi_socie": "Fatemi-Socie parameter, largest of all planes [-]",
    "crossland": "Crossland criterion: below 1, unlimited life [-]",
    "dang_van": "Dang Van criterion: below 1, unlimited life [-]",
    "ruiz_f1": "Ruiz parameter F1 [pressure x length]",
    "ruiz_f2": "Ruiz parameter F2 [pressure^2 x length]",
}


def subsurface(
    history: "History", depths: npt.ArrayLike, increment: int, body: Literal["lower", "upper"], threads: int | None
) -> "xarray.Dataset":
    """Return stresses: see :meth:`fretting.History.subsurface`."""
    module = _dataset.module("subsurface")
    pressure = _on_grid(history, history.field("pressure", increment))
    shear = None
    if not _frictionless(history):
        x, y = (_on_grid(history, part) for part in history.field("shear", increment))
        shear = (x, y)
    setting = (history._bodies, _is_upper(body)), (history._spacing, history._periodic)
    even = _bulk_stress(history, increment, body), history._residual_stress
    answer = _core.subsurface_stress(*setting, (pressure, shear), _points(depths), even, threads)
    across = ("x",) if history.is_line else ("y", "x")
    order = (0, 1) if history.is_line else (0, 2, 1)

    def oriented(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
        return values.reshape(len(values), *history.shape).transpose(order)

    stress = {name: oriented(answer[name]) for name in COMPONENTS}
    tensor = np.stack([np.stack([stress["".join(sorted(i + j))] for j in "xyz"], axis=-1) for i in "xyz"], axis=-1)
    principal = np.moveaxis(np.linalg.eigvalsh(tensor)[..., ::-1], -1, 0)
    variables: dict[str, Any] = {
        name: (("depth", *across), values, described(f"stress {name}, tension positive [pressure]", history._units))
        for name, values in stress.items()
    }
    variables["von_mises"] = (
        ("depth", *across),
        oriented(answer["von_mises"]),
        described("von Mises stress [pressure]", history._units),
    )
    variables["principal"] = (
        ("order", "depth", *across),
        principal,
        described("principal stress, tension positive [pressure]", history._units),
    )
    coordinates = {**_coordinates(history, answer), "order": ("order", np.arange(1, 4), {"long_name": "1: the largest principal stress"})}
    attributes = {"body": body, "increment": history._number(increment)}
    dataset: xarray.Dataset = module.Dataset(variables, coords=coordinates, attrs=attributes)
    return dataset


class Constants(NamedTuple):
    """Constants of the material."""

    yield_strength: float | None
    torsion_limit: float | None
    tension_limit: float | None
    normal_stress_sensitivity: float


def fatigue(
    history: "History",
    depths: npt.ArrayLike,
    cycle: int,
    body: Literal["lower", "upper"],
    constants: Constants,
    threads: int | None,
) -> "xarray.Dataset":
    """Return fatigue parameters: see :meth:`fretting.History.fatigue`."""
    module = _dataset.module("fatigue")
    request = _request(constants)
    count = len(history.cycles["cycle"])
    if not -count <= cycle < count:
        raise IndexError(f"cycle {cycle}: the history has {count} computed cycles, counted from 0")
    first, last = (int(history.cycles[name][cycle]) for name in ("first_increment", "last_increment"))
    chosen = [number for number in history.kept_increments if first - 1 <= number <= last]
    if len(chosen) < 3:
        raise ValueError(
            f"fields of {len(chosen)} increments of the cycle are kept: three are needed ([output] every = ... keeps more)"
        )
    increments = [(*_fields(history, number), _bulk_stress(history, number, body)) for number in chosen]
    setting = (history._bodies, _is_upper(body)), (history._spacing, history._periodic)
    loading = increments, history._residual_stress
    answer = _core.fatigue(*setting, loading, _points(depths), json.dumps(request), threads)
    variables = {
        name: (
            ("depth", "x") if values.ndim == 2 else ("x",),
            values,
            described(PARAMETERS[name], history._units),
        )
        for name, values in answer.items()
        if name not in ("depth", "layer")
    }
    coordinates = {name: entry for name, entry in _coordinates(history, answer).items() if name != "y"}
    attributes = {"body": body, "increments": chosen}
    dataset: xarray.Dataset = module.Dataset(variables, coords=coordinates, attrs=attributes)
    return dataset


_Pair = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


def _fields(history: "History", number: int) -> tuple[npt.NDArray[np.float64], _Pair | None, _Pair | None]:
    """Return pressure, shear and slip of an increment; None for what is not kept."""
    kept = history._kept.kept_fields(number)

    def vector(name: Literal["shear", "slip"]) -> _Pair | None:
        if f"{name}_x" not in kept:
            return None
        x, y = (_on_grid(history, part) for part in history.field(name, number))
        return x, y

    shear = None if _frictionless(history) else vector("shear")
    if shear is None and not _frictionless(history):
        history.field("shear_x", number)  # refuses
    return _on_grid(history, history.field("pressure", number)), shear, vector("slip")


def _bulk_stress(history: "History", number: int, body: str) -> tuple[float, float]:
    """Return the bulk stress of a body along x and y."""
    name = "bulk_stress" if body == "lower" else "upper_bulk_stress"
    x, y = (float(history.increments[f"{name}_{axis}"][number]) for axis in "xy")
    return x, y


def _request(constants: Constants) -> dict[str, Any]:
    for name, value in constants._asdict().items():
        if value is not None and not (np.isfinite(value) and value > 0.0):
            if name == "normal_stress_sensitivity" and value == 0.0:
                continue
            raise ValueError(f"{name} = {value}: must be positive and finite")
    torsion, tension = constants.torsion_limit, constants.tension_limit
    if (torsion is None) != (tension is None):
        raise ValueError("torsion_limit and tension_limit: Crossland and Dang Van need both")
    return {
        "endurance": None if torsion is None else {"torsion": torsion, "tension": tension},
        "yield_strength": constants.yield_strength,
        "normal_stress_sensitivity": constants.normal_stress_sensitivity,
        "critical_distance": None,
    }


def _coordinates(history: "History", answer: dict[str, npt.NDArray[Any]]) -> dict[str, Any]:
    coordinates: dict[str, Any] = {
        "depth": ("depth", answer["depth"], described("depth under the surface [length]", history._units)),
        "layer": ("depth", answer["layer"], {"long_name": "layer: 0 is the outermost coating"}),
        "x": ("x", history.x, described("x [length]", history._units)),
    }
    if not history.is_line:
        coordinates["y"] = ("y", history.y, described("y [length]", history._units))
    return coordinates


def _points(depths: npt.ArrayLike) -> list[float]:
    points: list[float] = real_array("depths", np.atleast_1d(np.asarray(depths)), dimensions=1).tolist()
    return points


def _on_grid(history: "History", field: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    return np.ascontiguousarray(field.reshape(len(history.x), len(history.y)))


def _frictionless(history: "History") -> bool:
    return "frictionless" in history.increments["regime"]


def _is_upper(body: str) -> bool:
    if body not in ("lower", "upper"):
        raise ValueError(f"body = {body!r}: must be 'lower' or 'upper'")
    return body == "upper"

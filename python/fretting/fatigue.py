"""Fatigue of a history over a cycle, as datasets: parameters under all cells, a short crack, cracks of the coating."""

import functools
import json
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from fretting import _core, _dataset
from fretting._meaning import described
from fretting.stress import bulk_stress, coordinates, frictionless, on_grid, points, refuse_thinned

if TYPE_CHECKING:
    import xarray

    from fretting.case_types import FatigueConstants
    from fretting.history import History

PARAMETERS = {
    "smith_watson_topper": "Smith-Watson-Topper parameter, largest of all planes [pressure]",
    "fatemi_socie": "Fatemi-Socie parameter, largest of all planes [-]",
    "crossland": "Crossland criterion: below 1, unlimited life [-]",
    "dang_van": "Dang Van criterion: below 1, unlimited life [-]",
    "shakedown_strength": "smallest yield strength for elastic shakedown [pressure]",
    "ruiz_f1": "Ruiz parameter F1 [pressure x length]",
    "ruiz_f2": "Ruiz parameter F2 [pressure^2 x length]",
    "smith_watson_topper_cycles": "cycles to initiation by Smith-Watson-Topper; inf: above 1e18",
    "fatemi_socie_cycles": "cycles to initiation by Fatemi-Socie; inf: above 1e18",
}
MOST_SEVERE = {
    "largest": "largest value over all cells and depths, at the surface extrapolated to the rim of the contact",
    "largest_cycles": "cycles to initiation at the largest value; inf: above 1e18",
    "largest_cell": "largest value under the centres of cells, at that depth",
    "largest_cell_cycles": "cycles to initiation at the largest value of the cells; inf: above 1e18",
    "point_method": "largest value at half the critical distance",
    "point_method_cycles": "cycles to initiation by the point method; inf: above 1e18",
    "line_method": "largest mean down to twice the critical distance",
    "line_method_cycles": "cycles to initiation by the line method; inf: above 1e18",
}
LENGTHS = {
    "k1_max": ("largest", "largest stress intensity K_I of the cycle [pressure x sqrt(length)]"),
    "k1_range": ("range", "range of K_I while the crack is open [pressure x sqrt(length)]"),
    "k2_range": ("sliding_range", "range of K_II [pressure x sqrt(length)]"),
    "threshold": ("threshold", "threshold of a crack of this length [pressure x sqrt(length)]"),
}


def fatigue(
    history: "History",
    depths: npt.ArrayLike,
    cycle: int,
    body: Literal["lower", "upper"],
    constants: "FatigueConstants | None",
    threads: int | None,
) -> "xarray.Dataset":
    """Return fatigue parameters: see :meth:`fretting.History.fatigue`."""
    module = _dataset.module("fatigue")
    chosen, arguments = _cycle_of_places(history, cycle, body)
    answer = _core.fatigue(*arguments, points(depths), _constants(constants), threads)
    variables = {
        name: _dataset.on_cells(history, values, PARAMETERS[name], *("depth",) * (values.ndim - 2))
        for name, values in answer.items()
        if name not in ("depth", "layer", "most_severe")
    }
    severe = answer["most_severe"]
    variables |= _most_severe(history, severe)
    coords = {**coordinates(history, answer), "parameter": list(severe), "axis": ["x", "y", "z"]}
    attributes = {"body": body, "increments": chosen}
    dataset: xarray.Dataset = module.Dataset(variables, coords=coords, attrs=attributes)
    return dataset


def _most_severe(history: "History", severe: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """Return the largest value of each parameter with its place, as ``fret stress`` tells it."""
    found = severe.values()
    variables: dict[str, Any] = {
        name: _dataset.numbers(history, "parameter", (one.get(name) for one in found), words)
        for name, words in MOST_SEVERE.items()
        if any(name in one for one in found)
    }
    for axis, name in enumerate("xy"):
        places = [_dataset.place(history, axis, one["place"][axis]) for one in found]
        words = f"place of the largest value along {name} [length]"
        variables[f"largest_{name}"] = _dataset.numbers(history, "parameter", places, words)
    depths = (one["depth"] for one in found)
    variables["largest_depth"] = _dataset.numbers(history, "parameter", depths, "depth of the largest value [length]")
    normals = [one["normal"] or [np.nan] * 3 for one in found]
    words = "unit normal of the critical plane there"
    variables["critical_plane"] = (("parameter", "axis"), np.reshape(normals, (-1, 3)), {"long_name": words})
    return variables


def crack(
    history: "History",
    cycle: int,
    body: Literal["lower", "upper"],
    constants: "FatigueConstants | None",
    threads: int | None,
) -> "xarray.Dataset":
    """Return the course of a short crack: see :meth:`fretting.History.crack`."""
    module = _dataset.module("crack")
    chosen, arguments = _cycle_of_places(history, cycle, body)
    told = json.loads(_core.crack(*arguments, _constants(constants), threads))
    attributes: dict[str, Any] = {"body": body, "increments": chosen}
    dataset: xarray.Dataset
    if "reason" in told:
        unknown = dict.fromkeys(("x", "y", "angle", "length", "cycles"), np.nan)
        dataset = module.Dataset(attrs={**attributes, "fate": "none", "reason": told["reason"], **unknown})
        return dataset
    course = told["course"]
    x, y = (_dataset.place(history, axis, told["place"][axis]) for axis in range(2))
    attributes |= {"fate": course["fate"], "x": x, "y": y, "angle": told["angle"], "towards": told["towards"]}
    attributes["length"] = course["length"]
    ends = course["fate"] in ("does_not_grow", "stops")
    attributes["cycles"] = course["cycles"] if course["cycles"] is not None else np.inf if ends else np.nan
    lengths = course["lengths"]

    def column(key: str) -> npt.NDArray[np.float64]:
        return np.array([np.inf if at[key] is None else at[key] for at in lengths], dtype=float)

    variables = {
        name: (("length",), column(key), described(words, history._units)) for name, (key, words) in LENGTHS.items()
    }
    if any(at["cycles"] is not None for at in lengths):
        words = "cycles from the initial length on; inf: never reached"
        variables["cycles"] = (("length",), column("cycles"), {"long_name": words})
    length = ("length", column("length"), described("length of the crack [length]", history._units))
    dataset = module.Dataset(variables, coords={"length": length}, attrs=attributes)
    return dataset


def coating_fracture(
    history: "History",
    cycle: int,
    body: Literal["lower", "upper"],
    constants: "FatigueConstants | None",
    threads: int | None,
) -> "xarray.Dataset":
    """Return the cracks of the coating: see :meth:`fretting.History.coating_fracture`."""
    module = _dataset.module("coating_fracture")
    chosen, arguments = _cycle(history, cycle, body)
    told = json.loads(_core.coating_fracture(*arguments, _constants(constants), threads))
    cracks = told["cracks"]

    of = functools.partial(_dataset.numbers, history, "sense")
    released = [crack["released"] for crack in cracks]
    energy = "energy released by {} [force/length]"
    variables: dict[str, Any] = {
        "stress": of([crack["stress"] for crack in cracks], "mean stress over the thickness [pressure]"),
        "direction": of([crack["direction"] for crack in cracks], "direction of that stress to the x axis [degrees]"),
        "channelling": of([one["channelling"] for one in released], energy.format("channelling")),
        "delamination": of([one["delamination"] for one in released], energy.format("delamination")),
        "phase": of([one["phase"] for one in released], "phase angle of the delamination [degrees]"),
    }
    for kind, toughness in (("channelling", told["fracture_energy"]), ("delamination", told["interface_energy"])):
        if toughness is not None:
            known = variables[kind][1]
            factor = np.sqrt(np.divide(toughness, known, out=np.full_like(known, np.inf), where=known != 0))
            variables[f"{kind}_factor_of_safety"] = (
                ("sense",),
                factor,
                {"long_name": "factor on the stress that fractures"},
            )
    for axis, (name, centres) in enumerate((("x", history.x), ("y", history.y))):
        places = (float(centres[crack["cell"][axis]]) if len(centres) > 1 else 0.0 for crack in cracks)
        variables[name] = of(places, f"place along {name} [length]")
    variables["increment"] = (("sense",), np.array([chosen[crack["surface"]] for crack in cracks], dtype=int))
    senses = ["tension" if crack["stress"] > 0 else "compression" for crack in cracks]
    attributes = {"body": body, "increments": chosen}
    dataset: xarray.Dataset = module.Dataset(variables, coords={"sense": senses}, attrs=attributes)
    return dataset


def _cycle(history: "History", cycle: int, body: Literal["lower", "upper"]) -> tuple[list[int], tuple[Any, Any]]:
    """Return the kept increments of a cycle, and the run with its loading for the core."""
    refuse_thinned(history)
    first, last = _dataset.span(history, cycle)
    chosen = [number for number in history.kept_increments if first - 1 <= number <= last]
    if len(chosen) < 3:
        raise ValueError(
            f"fields of {len(chosen)} increments of the cycle are kept: three are needed "
            "([output] every = ... keeps more)"
        )
    increments = [(*_fields(history, number), bulk_stress(history, number, body)) for number in chosen]
    return chosen, ((json.dumps(history.plan), body == "upper"), increments)


def _cycle_of_places(
    history: "History", cycle: int, body: Literal["lower", "upper"]
) -> tuple[list[int], tuple[Any, Any]]:
    """Return the same of a cycle in which a cell is one place of the bodies."""
    if _dataset.rolls(history, cycle, "contact"):
        raise ValueError(
            'the contact rolls with kinematics.frame = "contact": the places of the bodies travel through the grid '
            '(frame = "bodies", on a grid that holds all of the way, keeps them)'
        )
    return _cycle(history, cycle, body)


_Pair = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


def _fields(history: "History", number: int) -> tuple[npt.NDArray[np.float64], _Pair | None, _Pair | None]:
    """Return pressure, shear and slip of an increment; None for what is not kept."""
    kept = history._kept.kept_fields(number)

    def vector(name: Literal["shear", "slip"]) -> _Pair | None:
        if f"{name}_x" not in kept:
            return None
        x, y = (on_grid(history, part) for part in history.field(name, number))
        return x, y

    shear = None if frictionless(history) else vector("shear")
    if shear is None and not frictionless(history):
        history.field("shear_x", number)  # refuses
    return on_grid(history, history.field("pressure", number)), shear, vector("slip")


def _constants(given: "FatigueConstants | None") -> str | None:
    """Return the constants as the core reads them; None: those of the case."""
    return None if given is None else json.dumps(given)

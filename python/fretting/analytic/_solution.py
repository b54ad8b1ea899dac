"""What all closed forms share: their arguments, and how numbers and curves come from the library."""

import json
from collections.abc import Mapping
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from fretting import _core
from fretting._arguments import real
from fretting._arrays import Reals, real_array

Material: TypeAlias = Mapping[str, float]
"""``young`` [pressure] and ``poisson`` [-], as in a case."""
Layer: TypeAlias = Mapping[str, float]
"""``thickness`` [length], ``young`` [pressure] and ``poisson`` [-], as in a case."""
Branch: TypeAlias = Literal["loading", "unloading", "reloading"]


def entries(name: str, given: Mapping[str, float], keys: tuple[str, ...]) -> tuple[float, ...]:
    """Return the entries of a material in order."""
    if not isinstance(given, Mapping):
        wanted = ", ".join(f"'{key}': ..." for key in keys)
        raise TypeError(f"{name}: expected a mapping as in a case, {{{wanted}}}, found {type(given).__name__}")
    if set(given) != set(keys):
        raise ValueError(f"{name}: has the keys {', '.join(map(str, given))}; must have {', '.join(keys)}")
    return tuple(real(f"{name}.{key}", given[key]) for key in keys)


def material_numbers(name: str, material: Material) -> tuple[float, float]:
    young, poisson = entries(name, material, ("young", "poisson"))
    return young, poisson


def layer_numbers(layer: Layer) -> tuple[float, float, float]:
    thickness, young, poisson = entries("layer", layer, ("thickness", "young", "poisson"))
    return young, poisson, thickness


def numbers_of(solution: _core.Solution) -> dict[str, Any]:
    numbers: dict[str, Any] = json.loads(solution.numbers())
    return numbers


def of_each(numbers: dict[str, Any]) -> dict[str, Any]:
    """Turn lists, one number for each force, into arrays."""
    return {name: None if values is None else np.array(values, dtype=np.float64) for name, values in numbers.items()}


def forces_of(tangential_forces: npt.ArrayLike) -> list[float]:
    found: list[float] = real_array("tangential_forces", tangential_forces, dimensions=1).tolist()
    return found


def curve(solution: _core.Solution, name: str, at: npt.ArrayLike) -> Reals:
    places = real_array(name, at)
    return solution.curve(name, places.ravel()).reshape(places.shape)


def surface(solution: _core.Solution, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
    along, across = np.broadcast_arrays(real_array("x", x), real_array("y", y))
    flat = [np.ascontiguousarray(places.ravel(), dtype=np.float64) for places in (along, across)]
    return solution.surface(flat[0], flat[1]).reshape(along.shape)

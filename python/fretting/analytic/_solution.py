"""What all closed forms share: their arguments, and how numbers and curves come from the library."""

import json
from collections.abc import Callable, Mapping
from dataclasses import fields
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


class Solution:
    """A solution of the compiled module, which is computed again where it is copied or sent to another process."""

    def __init__(self, of: Callable[..., _core.Solution], *given: object) -> None:
        self._asked = (of, *given)
        found = of(*given)
        self.numbers, self.function = found.numbers, found.function

    def __reduce__(self) -> tuple[type["Solution"], tuple[Any, ...]]:
        return Solution, self._asked


def solution_of(name: str, *given: float) -> Solution:
    """Return the solution of a closed form of the catalogue for the numbers of its parameters."""
    return Solution(_core.closed_form, name, list(given))


def numbers_of(solution: Solution | _core.Solution) -> dict[str, Any]:
    numbers: dict[str, Any] = json.loads(solution.numbers())
    return {name: tuple(value) if isinstance(value, list) else value for name, value in numbers.items()}


def of_each(numbers: dict[str, Any]) -> dict[str, Any]:
    """Turn lists, one number for each force, into arrays."""
    return {name: None if values is None else np.array(values, dtype=np.float64) for name, values in numbers.items()}


def equal(one: Any, other: Any) -> bool:
    """Whether two solutions are of one kind and have the same numbers, arrays among them."""
    names = [entry.name for entry in fields(one) if entry.compare]
    return type(one) is type(other) and all(np.array_equal(getattr(one, name), getattr(other, name)) for name in names)


def forces_of(tangential_forces: npt.ArrayLike) -> list[float]:
    found: list[float] = real_array("tangential_forces", tangential_forces, dimensions=1).tolist()
    return found


def values_of(solution: Solution, name: str, **at: npt.ArrayLike) -> Reals:
    """Return a function of the solution at points: one coordinate, or several of one broadcast shape."""
    given = [real_array(coordinate, values) for coordinate, values in at.items()]
    try:
        places = np.broadcast_arrays(*given)
    except ValueError:
        shapes = ", ".join(str(values.shape) for values in given)
        raise ValueError(f"{', '.join(at)} of shapes {shapes}: must fit each other") from None
    flat = [np.ascontiguousarray(one.ravel(), dtype=np.float64) for one in places]
    return solution.function(name, flat).reshape(places[0].shape)

"""What is asked of a design: objective, bounds of the numbers, limits of the results; checked, and told in words."""

import math
from collections.abc import Mapping
from typing import Any

from fretting._arguments import mapping, real, text

Side = float | Mapping[str, float]
"""A value, or the weights of results and numbers whose sum it is."""
Limit = tuple[Side | None, Side | None]
"""Least and largest value; ``None`` where there is none."""


def in_words(numbers: Mapping[str, float]) -> str:
    """Numbers with their paths."""
    return ", ".join(f"{path} = {number:.6g}" for path, number in numbers.items())


def limit_in_words(limit: Side) -> str:
    """A limit as a number, or as the sum that it is."""
    if isinstance(limit, int | float):
        return f"{limit:g}"
    return " + ".join(f"{weight:g} {name}" for name, weight in limit.items())


def objective_of(minimize: Any, maximize: Any) -> tuple[float, dict[str, float]]:
    """Sign of what is made smallest, and the weights of results and numbers that it is the sum of."""
    if (minimize is None) == (maximize is None):
        raise ValueError("minimize, maximize: expected one of both, such as minimize='max_pressure'")
    name, given, sign = ("minimize", minimize, 1.0) if maximize is None else ("maximize", maximize, -1.0)
    if isinstance(given, str):
        return sign, {given: 1.0}
    weights = {text(name, key): real(f"{name}[{key!r}]", weight) for key, weight in mapping(name, given).items()}
    if not weights or not all(math.isfinite(weight) for weight in weights.values()):
        raise ValueError(f"{name}: expected a result, or results with finite weights, such as {{'max_pressure': 1.0}}")
    return sign, weights


def _pair(name: str, pair: Any) -> tuple[Any, Any]:
    try:
        low, high = pair
    except (TypeError, ValueError):
        raise ValueError(f"{name}: expected a pair, the least and the largest value") from None
    return low, high


def bounds_of(path: str, pair: Any) -> tuple[float, float]:
    """Least and largest value of a number."""
    low, high = (real(f"by[{path!r}]", side) for side in _pair(f"by[{path!r}]", pair))
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise ValueError(f"by[{path!r}] = ({low:g}, {high:g}): must be finite and rise")
    return low, high


def limit_of(name: str, pair: Any) -> Limit:
    """Least and largest value of a result."""
    low, high = (_side(f"limits[{name!r}]", side) for side in _pair(f"limits[{name!r}]", pair))
    numbers = [side for side in (low, high) if isinstance(side, float)]
    if (low is None and high is None) or not all(map(math.isfinite, numbers)) or numbers != sorted(set(numbers)):
        raise ValueError(f"limits[{name!r}]: expected the least and the largest value, None where there is none")
    return low, high


def left(sign: float, limit: float, value: float, unit: float | None) -> float:
    """How much of a limit is left: the logarithm of its ratio to the value; where there is a unit, the difference."""
    if unit is None:
        return sign * math.copysign(1.0, limit) * math.log(limit / value)
    return sign * (limit - value) / unit


def _side(name: str, side: Any) -> Side | None:
    if side is None:
        return None
    if not isinstance(side, Mapping):
        return real(name, side)
    weights = {text(name, key): real(f"{name}[{key!r}]", weight) for key, weight in side.items()}
    if not weights or not all(math.isfinite(weight) for weight in weights.values()):
        raise ValueError(f"{name}: expected a value, or results and numbers with finite weights")
    return weights

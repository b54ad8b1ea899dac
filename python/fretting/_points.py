"""The points of a sweep: which key of the case takes which value."""

import copy
import itertools
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from fretting import _case, _paths
from fretting._meaning import MEANING
from fretting._paths import Table, put
from fretting.uncertainty import Distribution, drawn

Key: TypeAlias = str | tuple[str, ...]


@dataclass(frozen=True)
class Parameter:
    """A parameter of a sweep under a name of its own: a key of the case, or a function of yours that changes the case.

    Examples
    --------
    >>> import fretting
    >>> def amplitude(case, fraction):
    ...     limit = case["friction"]["coefficient"] * case["load"][0]["normal_force"]
    ...     case["load"][1]["tangential_force"] = [fraction * limit, 0.0]
    >>> parameters = {
    ...     "amplitude": fretting.Parameter([0.2, 0.5, 0.9], amplitude),
    ...     "nu": fretting.Parameter([0.2, 0.3], "lower.substrate.poisson"),
    ... }
    """

    values: Sequence[Any] | Distribution
    """The values, one per point of the axis; or a distribution that they are drawn from."""
    apply: str | Callable[[Table, Any], object]
    """A dotted key of the case; or a function of a copy of the case (a dict, the caller's to change) and a value."""

    def __post_init__(self) -> None:
        """Check what is applied."""
        if not isinstance(self.apply, str) and not callable(self.apply):
            raise TypeError(f"apply: expected a key of the case or a function, found {type(self.apply).__name__}")


Values: TypeAlias = Sequence[Any] | npt.NDArray[Any] | Parameter | Distribution
Parameters: TypeAlias = Mapping[Any, Values] | Sequence[Mapping[str, Any]]
"""Values of each axis by the key of the case that takes them, or a list of points."""


@dataclass(frozen=True)
class Dimension:
    """An axis, understood: what a dimension of the result is called, and how each of its points changes the case."""

    name: str
    coordinates: dict[str, list[Any]]
    changes: list[Callable[[Table], object]]
    keys: dict[str, str] = field(default_factory=dict)
    """Keys of the case that parameters of other names change."""


@dataclass(frozen=True)
class Point:
    """A point of the sweep: its place in the result, its name in messages, its case."""

    place: tuple[int, ...]
    name: str
    case: Table


@dataclass(frozen=True)
class Draw:
    """How samples are drawn from distributions."""

    samples: int | None = None
    seed: int = 0
    indices: bool = False


def is_uncertain(values: object) -> bool:
    """Whether values of an axis are a distribution."""
    return isinstance(values.values if isinstance(values, Parameter) else values, Distribution)


def dimensions(parameters: Parameters, draw: Draw | None = None) -> list[Dimension]:
    """Understand the parameters of a sweep."""
    if isinstance(parameters, Mapping):
        uncertain = {key: values for key, values in parameters.items() if is_uncertain(values)}
        found = [_dimension(key, values) for key, values in parameters.items() if key not in uncertain]
        found += _samples(uncertain, draw or Draw())
    elif isinstance(parameters, Sequence) and not isinstance(parameters, str):
        found = [_list_of_points(parameters)]
    else:
        raise TypeError(f"parameters: expected a mapping or a list of mappings, found {type(parameters).__name__}")
    if not found:
        raise ValueError("parameters: a sweep needs at least one")
    names = [name for dimension in found for name in (dimension.name, *dimension.coordinates)]
    for dimension in found:
        if not dimension.changes:
            raise ValueError(f"parameter {dimension.name!r} has no values")
        for name in {dimension.name, *dimension.coordinates}:
            if name in RESERVED or name.startswith("cycle_"):
                raise ValueError(f"parameter {name!r}: a variable of the result has this name; choose another name")
        if sum(name == dimension.name for name in names) > 2:
            raise ValueError(f"parameter {dimension.name!r} is there twice")
    return found


RESERVED = {"status", "error", *MEANING}
"""Names that the result of a sweep uses itself."""


def points(base: Table, found: Sequence[Dimension]) -> Iterable[Point]:
    """All points, the last axis fastest."""
    _refuse_one_place_twice(base, found)
    for place in itertools.product(*(range(len(dimension.changes)) for dimension in found)):
        case = copy.deepcopy(base)
        for dimension, index in zip(found, place, strict=True):
            dimension.changes[index](case)
        words = [
            f"{key} = {_shown(values[index])}"
            for dimension, index in zip(found, place, strict=True)
            for key, values in dimension.coordinates.items()
        ]
        yield Point(place, ", ".join(words), case)


def _refuse_one_place_twice(base: Table, found: Sequence[Dimension]) -> None:
    """Refuse two keys that name one place of the case: the values of the first would be lost."""
    before: dict[tuple[str, ...], str] = {}
    for name in (dimension.keys.get(name, name) for dimension in found for name in dimension.coordinates):
        other = before.setdefault(_paths.place(base, name), name)
        if other is not name:
            raise ValueError(f"parameters {other!r} and {name!r} are one place of the case")


def _dimension(key: Key, given: object) -> Dimension:
    if isinstance(given, Parameter):
        if not isinstance(key, str):
            raise TypeError(f"parameter {key!r}: a Parameter has one name")
        values = _values(key, given.values)
        apply = given.apply
        if isinstance(apply, str):
            return Dimension(key, {key: values}, [_by_keys([apply], [value]) for value in values], {key: apply})
        return Dimension(key, {key: values}, [_by_function(apply, value) for value in values])
    if isinstance(key, str):
        values = _values(key, given)
        return Dimension(key, {key: values}, [_by_keys([key], [value]) for value in values])
    if not (isinstance(key, tuple) and len(key) > 1 and all(isinstance(part, str) for part in key)):
        raise TypeError(f"parameter {key!r}: expected a dotted key of the case, or a tuple of at least two")
    rows = _values(", ".join(key), given)
    for index, row in enumerate(rows):
        if not isinstance(row, Sequence) or isinstance(row, str) or len(row) != len(key):
            raise ValueError(f"parameter {', '.join(key)}: value {index} must hold {len(key)} values, found {row!r}")
    columns = {part: [row[number] for row in rows] for number, part in enumerate(key)}
    return Dimension(", ".join(key), columns, [_by_keys(key, row) for row in rows])


def _samples(uncertain: Mapping[Any, Any], draw: Draw) -> list[Dimension]:
    """Understand the distributions: one dimension of samples of all of them."""
    if not uncertain:
        if draw.samples is not None:
            raise ValueError("samples: no parameter has a distribution, such as fretting.Normal(0.6, 0.05)")
        return []
    if draw.samples is None:
        raise ValueError(
            f"parameter {next(iter(uncertain))!r} has a distribution: give samples=..., how many are drawn"
        )
    keys = list(uncertain)
    if not all(isinstance(key, str) for key in keys):
        raise TypeError("a distribution belongs to one key of the case")
    distributions: list[Any] = [given.values if isinstance(given, Parameter) else given for given in uncertain.values()]
    rows = drawn(distributions, draw.samples, draw.seed, draw.indices)
    columns = {key: [row[number] for row in rows] for number, key in enumerate(keys)}
    one = [_applied(key, given) for key, given in uncertain.items()]

    def change(row: Sequence[float]) -> Callable[[Table], object]:
        def all_of_them(case: Table) -> None:
            for apply, value in zip(one, row, strict=True):
                apply(value)(case)

        return all_of_them

    named = {key: given.apply for key, given in uncertain.items() if isinstance(given, Parameter)}
    own = {name: apply for name, apply in named.items() if isinstance(apply, str)}
    return [Dimension("sample", columns, [change(row) for row in rows], own)]


def _applied(key: str, given: object) -> Callable[[object], Callable[[Table], object]]:
    apply = given.apply if isinstance(given, Parameter) else key
    if isinstance(apply, str):
        return lambda value: _by_keys([apply], [value])
    return lambda value: _by_function(apply, value)


def _list_of_points(rows: Sequence[Mapping[str, Any]]) -> Dimension:
    if not all(isinstance(row, Mapping) for row in rows):
        raise TypeError("parameters: in a list of points every point is a mapping from keys of the case to values")
    if not rows:
        raise ValueError("parameters: the list of points is empty")
    keys = list(rows[0])
    for key in keys:
        if not isinstance(key, str):
            raise TypeError(f"parameters: in a list of points {key!r} is no key of the case")
    for index, row in enumerate(rows):
        if set(row) != set(keys) or not keys:
            raise ValueError(
                f"parameters: point {index} has the keys {sorted(row)}: must have those of point 0, {keys}"
            )
    plain = [[_plain(key, row[key]) for key in keys] for row in rows]
    columns = {key: [row[number] for row in plain] for number, key in enumerate(keys)}
    return Dimension("point", columns, [_by_keys(keys, row) for row in plain])


def _values(name: str, given: object) -> list[Any]:
    if isinstance(given, np.ndarray):
        given = given.tolist()
    if isinstance(given, str | bytes | Mapping) or not isinstance(given, Iterable):
        raise TypeError(f"parameter {name!r}: expected a list of values, found {type(given).__name__}")
    return [_plain(f"{name}[{index}]", value) for index, value in enumerate(given)]


def _plain(name: str, value: object) -> Any:
    return _case.plain(value, name)


def _by_function(apply: Callable[[Table, Any], object], value: object) -> Callable[[Table], object]:
    return lambda case: apply(case, copy.deepcopy(value))


def _by_keys(keys: Sequence[str], values: Sequence[Any]) -> Callable[[Table], object]:
    def change(case: Table) -> None:
        for key, value in zip(keys, values, strict=True):
            put(case, key, copy.deepcopy(value))

    return change


def _shown(value: object) -> str:
    return json.dumps(value) if not isinstance(value, float) else f"{value:.6g}"

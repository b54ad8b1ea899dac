"""What a design asks for, as an optimiser takes it: scaled variables, the objective, and what is left of the limits."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from fretting import _case
from fretting._arguments import mapping, text
from fretting._arrays import Reals
from fretting._function import Results
from fretting._limits import Limit, Side, bounds_of, in_words, left, limit_of, objective_of
from fretting._paths import place, steps
from fretting.errors import DesignError, Evaluation, FrettingError
from fretting.planning import plan


class SignChangedError(Exception):
    """On the way a result and its limit took different signs: its margin is a difference from now on."""


class Question:
    """The problem of the optimiser: scaled variables, objective and margins to the limits, from one call each."""

    def __init__(
        self,
        case: _case.CaseLike,
        by: Mapping[str, tuple[float, float]],
        objectives: tuple[str | Mapping[str, float] | None, str | Mapping[str, float] | None],
        limits: Mapping[str, Limit] | None,
        threads: int | None,
    ) -> None:
        table = _case.table_from_anywhere(case)
        bounds = {text("by", path): bounds_of(path, pair) for path, pair in mapping("by", by).items()}
        if not bounds:
            raise ValueError("by: expected at least one number of the case, with its bounds")
        numbers = {place(table, path): path for path in bounds}

        def called(name: str) -> str:
            """Return the name that `by` has for a number."""
            return numbers.get(place(table, name), name)

        def weighed(weights: Mapping[str, float]) -> dict[str, float]:
            """Return weights by these names."""
            names = dict.fromkeys(map(called, weights))
            return {own: sum(weight for name, weight in weights.items() if called(name) == own) for own in names}

        self.sign, weights = objective_of(*objectives)
        self.weights = weighed(weights)
        self.limits: dict[str, Limit] = {}
        for name, pair in mapping("limits", {} if limits is None else limits).items():
            own = called(text("limits", name))
            if own in self.limits:
                raise ValueError(f"limits: {name} is named twice")
            least, most = limit_of(name, pair)
            self.limits[own] = (
                weighed(least) if isinstance(least, Mapping) else least,
                weighed(most) if isinstance(most, Mapping) else most,
            )
        both = ((name, ((-1.0, low), (1.0, high))) for name, (low, high) in self.limits.items())
        self.sides: list[tuple[str, float, Side]] = [
            (name, sign, value) for name, pair in both for sign, value in pair if value is not None
        ]
        """Limits one by one: result, sign of what is too much, value."""
        others = [name for _, _, side in self.sides if isinstance(side, dict) for name in side]
        of = [name for name in dict.fromkeys([*self.weights, *self.limits, *others]) if name not in bounds]
        _check_names(of, table, list(bounds))
        self.results = Results(case, of, list(bounds), threads)
        self.names = [*self.results.of, *self.results.by]
        self.threads = threads
        self.pairs = list(bounds.values())
        self.logarithmic = [low > 0.0 for low, _ in self.pairs]
        first = self.results.start
        for path, number, (low, high) in zip(bounds, first, self.pairs, strict=True):
            if not low <= number <= high:
                raise ValueError(
                    f"by: {path} = {number:g} in the case: must lie within its bounds, {low:g} to {high:g}"
                )
        self.start = self.scaled(first)
        self.low, self.high = (self.scaled(side) for side in zip(*self.pairs, strict=True))
        self.units: list[float | None] = []
        """What the margin to each counts in; None where it is the logarithm of a ratio."""
        self.evaluations: list[Evaluation] = []
        self.known: dict[bytes, tuple[Reals, Reals, Reals]] = {}
        self.near: dict[bytes, tuple[int, int, int] | None] = {}

    def scaled(self, numbers: Any) -> Reals:
        """Logarithms of numbers over those of the start, between positive bounds; of others, the way over theirs."""
        rows = zip(numbers, self.results.start, self.pairs, self.logarithmic, strict=True)
        return np.array(
            [math.log(x / first) if log else (x - first) / (high - low) for x, first, (low, high), log in rows]
        )

    def numbers(self, variables: Reals) -> Reals:
        """Return the numbers of scaled variables, within their bounds."""
        rows = zip(variables, self.results.start, self.pairs, self.logarithmic, strict=True)
        made = [(first * math.exp(x) if log else first + x * (high - low)) for x, first, (low, high), log in rows]
        sides = zip(variables, made, self.low, self.high, self.pairs, strict=True)
        return np.array(
            [
                low if x <= least else high if x >= most else min(max(number, low), high)
                for x, number, least, most, (low, high) in sides
            ]
        )

    def found(self, variables: Reals) -> tuple[Reals, Reals, Reals]:
        """Numbers, results and the numbers after them, derivatives by the scaled variables; every place is run once."""
        key = np.asarray(variables, dtype=float).tobytes()
        if key not in self.known:
            numbers = self.numbers(variables)
            try:
                values, matrix, self.near[key] = self.results.told(numbers)
            except (FrettingError, ValueError) as error:
                if not self.evaluations:
                    raise
                place = in_words(dict(zip(self.results.by, map(float, numbers), strict=True)))
                raise DesignError(f"design: {self.tried} run; the next, {place}: {error}", self.evaluations) from error
            self.evaluations.append(
                Evaluation(
                    dict(zip(self.results.by, map(float, numbers), strict=True)),
                    dict(zip(self.results.of, map(float, values), strict=True)),
                    {
                        name: dict(zip(self.results.by, map(float, row), strict=True))
                        for name, row in zip(self.results.of, matrix, strict=True)
                    },
                )
            )
            rates = [
                x if log else high - low
                for x, (low, high), log in zip(numbers, self.pairs, self.logarithmic, strict=True)
            ]
            both = np.concatenate([values, numbers])
            self.known[key] = numbers, both, np.vstack([matrix, np.eye(len(numbers))]) * np.array(rates)
        return self.known[key]

    def total(self, values: Reals) -> float:
        """Return the objective of results."""
        return float(self.sum(self.weights, values))

    def sum(self, weights: Mapping[str, float], values: Reals) -> Any:
        """Return the weighted sum of results and numbers, or of their derivatives."""
        return sum(weight * values[self.names.index(name)] for name, weight in weights.items())

    def objective(self, variables: Reals) -> float:
        """Return what is made smallest, over its size at the start."""
        _, values, _ = self.found(variables)
        return self.sign * self.total(values) / self.unit()

    def slope(self, variables: Reals) -> Reals:
        """Return its derivatives by the scaled variables."""
        _, _, matrix = self.found(variables)
        slope: Reals = self.sign * np.sum(self.parts(matrix), axis=0) / self.unit()
        return slope

    def parts(self, results: Reals) -> Reals:
        """Parts of the objective, from results or from their derivatives."""
        return np.array([weight * results[self.names.index(name)] for name, weight in self.weights.items()])

    def unit(self) -> float:
        """Return what the objective counts in: its largest part at the start; where that is 0, what it changes by."""
        _, values, matrix = self.found(self.start)
        size = float(np.abs(self.parts(values)).max() or np.abs(self.parts(matrix)).max())
        if size == 0.0:
            raise ValueError(
                "the objective is 0 at the numbers of the case, and changes with none of them: begin at others"
            )
        return size

    def begin(self) -> None:
        """Run the case as it is, and choose what every limit counts in."""
        _, values, _ = self.found(self.start)
        self.units = [None if self.alike(side, values) else self.unit_of(side) for side in self.sides]

    def alike(self, side: tuple[str, float, Side], values: Reals) -> bool:
        """Whether a result and its limit have the same sign, so that their ratio has a logarithm."""
        name, _, limit = side
        return self.value_of(limit, values) * float(values[self.names.index(name)]) > 0.0

    def value_of(self, limit: Side, values: Reals) -> float:
        """Return the value of a limit."""
        return float(limit) if isinstance(limit, int | float) else float(self.sum(limit, values))

    def unit_of(self, side: tuple[str, float, Side]) -> float:
        """Return what a difference counts in: the limit; where that is 0, what the result is or changes by."""
        name, _, limit = side
        if isinstance(limit, int | float) and limit != 0.0:
            return abs(limit)
        _, values, matrix = self.found(self.start)
        row = self.names.index(name)
        size = abs(self.value_of(limit, values)) or float(abs(values[row]) or np.abs(matrix[row]).max())
        if size == 0.0:
            raise ValueError(f"limits: {name} is 0 at the numbers of the case, and changes with none of them: leave it")
        return size

    def size_of(self, number: int, values: Reals) -> float | None:
        """Return what a difference is told in: the largest part of the limit as it is here; None for a logarithm."""
        limit, unit = self.sides[number][2], self.units[number]
        if unit is None or not isinstance(limit, Mapping):
            return unit
        return max(abs(weight * values[self.names.index(name)]) for name, weight in limit.items()) or unit

    def margins(self, variables: Reals, *, told: bool = False) -> Reals:
        """How much of each limit is left, in its unit, or (told) of the limit as it is here."""
        _, values, _ = self.found(variables)
        rows = []
        for number, (name, sign, limit) in enumerate(self.sides):
            if self.units[number] is None and not self.alike(self.sides[number], values):
                self.units[number] = self.unit_of(self.sides[number])
                raise SignChangedError
            unit = self.size_of(number, values) if told else self.units[number]
            rows.append(left(sign, self.value_of(limit, values), values[self.names.index(name)], unit))
        return np.array(rows)

    def slopes_of_margins(self, variables: Reals) -> Reals:
        """Return their derivatives by the scaled variables, in their units."""
        _, values, matrix = self.found(variables)
        rows = []
        for (name, sign, limit), unit in zip(self.sides, self.units, strict=True):
            row = self.names.index(name)
            of_limit = 0.0 if isinstance(limit, int | float) else self.sum(limit, matrix)
            size, own = (abs(self.value_of(limit, values)), abs(values[row])) if unit is None else (unit, unit)
            rows.append(sign * (of_limit / size - matrix[row] / own))
        return np.array(rows)

    def check_grid(self) -> None:
        """Refuse a grid that moves with the numbers."""
        case = self.results.at(np.array(self.results.start))
        grid = case.get("grid")
        if isinstance(grid, Mapping) and grid.get("size") == "auto":
            planned = plan(case)["grid"]
            size = [
                round(cells * spacing, 12) for cells, spacing in zip(planned["cells"], planned["spacing"], strict=True)
            ]
            raise ValueError(
                f'grid.size = "auto" moves the grid with the numbers, and derivatives are those on one grid: give it '
                f"in numbers; that of the case as it is would be {size}, wider where the contact may grow"
            )

    @property
    def tried(self) -> str:
        """How many cases were run, in words."""
        return f"{len(self.evaluations)} case{'s' if len(self.evaluations) != 1 else ''}"


def _check_names(of: list[str], table: Mapping[str, Any], by: list[str]) -> None:
    """Refuse a question of no result, and numbers of the case that stand where results do without being of `by`."""
    for name in of:
        first, *more = steps(name)
        if more and first in table and first != "stress":  # the table and the results below have one name
            raise ValueError(f"{name}: not a number of `by`, which has {', '.join(by)}")
    if not of:
        raise ValueError(
            "minimize, maximize, limits: expected at least one result in them, such as "
            "limits={'max_pressure': (None, 1e9)}; numbers of `by` alone need no run"
        )

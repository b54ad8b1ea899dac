"""Design: the numbers of a case at which a result is smallest or largest, within bounds and limits."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fretting import _case
from fretting._arguments import mapping, real, text, whole
from fretting._arrays import Reals
from fretting._function import Results
from fretting._limits import Limit, Side, bounds_of, in_words, limit_in_words, limit_of, objective_of
from fretting._points import Table
from fretting.differentiating import near_in_words
from fretting.errors import DesignError, Evaluation, FrettingError
from fretting.history import History
from fretting.planning import plan
from fretting.simulation import run

MET = 1e-4
"""A limit is met that is exceeded by no more than so much of itself, and is active that is as near."""
LEFT = 0.02
"""A slope of more than so much, per cent per cent, at what the optimiser takes for the optimum is told."""


@dataclass(frozen=True)
class Design:
    """What was found by :func:`fretting.design`."""

    numbers: dict[str, float]
    """The numbers of the case at the optimum, by path."""
    results: dict[str, float]
    """The results there: those of the objective and of the limits."""
    objective: float
    """The result or number that was made smallest or largest, or the weighted sum."""
    active: list[str]
    """The bounds and limits that the optimum lies at, in words."""
    prices: dict[str, float]
    """Shadow price of every active limit, by its result: by how many per cent the objective gets better when the limit
    is relaxed by one."""
    slope: float
    """What is left of the derivatives: by how many per cent the objective changes at most when a number changes by one
    per cent (of the distance of its bounds, where these are not both positive), as far as no active bound or limit is
    in the way."""
    notes: list[str]
    """What may mislead."""
    evaluations: list[Evaluation] = field(repr=False)
    """All cases that were run, in their order."""
    case: Table = field(repr=False)
    """The case at the optimum."""
    history: History = field(repr=False)
    """Its history."""


def design(
    case: _case.CaseLike,
    *,
    by: Mapping[str, tuple[float, float]],
    minimize: str | Mapping[str, float] | None = None,
    maximize: str | Mapping[str, float] | None = None,
    limits: Mapping[str, Limit] | None = None,
    tolerance: float = 1e-5,
    iterations: int = 40,
    threads: int | None = None,
) -> Design:
    """Find the numbers of a case at which a result is smallest or largest, while others keep within limits.

    Sequential quadratic programming (``scipy.optimize``, method SLSQP) with exact derivatives: an evaluation is a run
    and its derivatives (:func:`gradient`), however many numbers may change. It begins at the numbers of the case and
    finds an optimum near them; whether another one is better, other starts tell.

    Parameters
    ----------
    case : path, str or mapping
        As for :func:`fretting.run`; with a ``size`` of the grid in numbers, which does not move with the case.
    by : mapping of str to (float, float)
        The numbers that may change, by their paths as for :func:`gradient`, with their least and largest values.
        Between positive bounds logarithms are varied.
    minimize, maximize : str or mapping of str to float
        One of both: a result, as for :func:`gradient`, a number of ``by``, or the weights of such that are added up.
    limits : mapping of str to (least, largest), optional
        Least and largest value of results, or of numbers of ``by``; ``None`` where there is none. In place of a value
        the weights of results and numbers whose sum it is: ``{"max_worn_depth": (None, {THICKNESS: 0.5})}`` lets wear
        take half of a thickness.
    tolerance : float
        Relative change of the objective at which the optimum counts as reached.
    iterations : int
        Maximum number of iterations.
    threads : int, optional
        Worker threads. Default: all cores.

    Returns
    -------
    Design
        Numbers, results, active bounds and limits with their shadow prices, all evaluations, case and history.

    Raises
    ------
    CaseError
        When the case is refused.
    ValueError
        When a result, a number, a bound or a limit cannot be, as for :func:`gradient`; where the size of the grid is
        ``"auto"``.
    ImportError
        Without SciPy: ``pip install 'fretting[design]'``.
    DesignError
        When no optimum is reached, the limits cannot be met, or a case on the way has no answer: with the reason, the
        numbers, and all evaluations.
    RunError
        When the case itself is not solved.

    Examples
    --------
    A ball on a half-space whose modulus is to be as low as possible is limited by its approach:

    >>> import fretting
    >>> case = {
    ...     "grid": {"cells": [16, 16], "size": [4e-4, 4e-4]},
    ...     "upper": {"rigid": True},
    ...     "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    ...     "profile": {"sphere": {"radius": 10e-3}},
    ...     "load": [{"normal_force": 10.0, "increments": 1}],
    ... }
    >>> moduli = {"lower.substrate.young": (50e9, 500e9)}
    >>> found = fretting.design(case, by=moduli, minimize="max_pressure", limits={"approach": (None, 1e-6)})
    >>> found.active
    ['approach at its upper limit, 1e-06']
    """
    question = _Question(case, by, (minimize, maximize), limits, threads)
    accuracy, most = real("tolerance", tolerance), whole("iterations", iterations)
    if not 0.0 < accuracy < 1.0 or not 0 < most <= 10_000:
        raise ValueError(f"tolerance = {accuracy}, iterations = {most}: between 0 and 1, and from 1 to 10000")
    optimize = _scipy()
    question.check_grid()
    margins = {"type": "ineq", "fun": question.margins, "jac": question.slopes_of_margins}
    found = optimize.minimize(
        question.objective,
        question.start,
        jac=question.slope,
        bounds=list(zip(question.low, question.high, strict=True)),
        constraints=[margins] if question.limits else [],
        method="SLSQP",
        options={"ftol": accuracy, "maxiter": most},
    )
    return question.answer(found, optimize.nnls)


def _scipy() -> Any:
    try:
        from scipy import optimize
    except ImportError as error:
        raise ImportError("design needs SciPy: pip install 'fretting[design]', or pip install scipy") from error
    return optimize


class _Question:
    """The problem of the optimiser: scaled variables, objective and margins to the limits, from one call each."""

    def __init__(
        self,
        case: _case.CaseLike,
        by: Mapping[str, tuple[float, float]],
        objectives: tuple[str | Mapping[str, float] | None, str | Mapping[str, float] | None],
        limits: Mapping[str, Limit] | None,
        threads: int | None,
    ) -> None:
        self.sign, self.weights = objective_of(*objectives)
        self.limits = {
            text("limits", name): limit_of(name, pair) for name, pair in mapping("limits", limits or {}).items()
        }
        bounds = {text("by", path): bounds_of(path, pair) for path, pair in mapping("by", by).items()}
        others = [name for pair in self.limits.values() for side in pair if isinstance(side, dict) for name in side]
        of = [name for name in dict.fromkeys([*self.weights, *self.limits, *others]) if name not in bounds]
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

    def sides(self) -> list[tuple[str, float, Side]]:
        """Limits one by one: result, sign of what is too much, value."""
        both = ((name, ((-1.0, low), (1.0, high))) for name, (low, high) in self.limits.items())
        return [(name, sign, value) for name, pair in both for sign, value in pair if value is not None]

    def value_of(self, limit: Side, values: Reals) -> float:
        """Return the value of a limit."""
        return float(limit) if isinstance(limit, int | float) else float(self.sum(limit, values))

    def unit_of(self, side: tuple[str, float, Side]) -> float:
        """Return what the margin to a limit counts in: the limit; where that is 0, what the result is or changes by."""
        name, _, limit = side
        if isinstance(limit, int | float) and limit != 0.0:
            return abs(limit)
        _, values, matrix = self.found(self.start)
        row = self.names.index(name)
        size = abs(self.value_of(limit, values)) or float(abs(values[row]) or np.abs(matrix[row]).max())
        if size == 0.0:
            raise ValueError(f"limits: {name} is 0 at the numbers of the case, and changes with none of them: leave it")
        return size

    def margins(self, variables: Reals) -> Reals:
        """How much of each limit is left."""
        _, values, _ = self.found(variables)
        rows = []
        for name, sign, limit in self.sides():
            left = self.value_of(limit, values) - values[self.names.index(name)]
            rows.append(sign * left / self.unit_of((name, sign, limit)))
        return np.array(rows)

    def slopes_of_margins(self, variables: Reals) -> Reals:
        """Return their derivatives by the scaled variables."""
        _, _, matrix = self.found(variables)
        rows = []
        for name, sign, limit in self.sides():
            of_limit = 0.0 if isinstance(limit, int | float) else self.sum(limit, matrix)
            rows.append(sign * (of_limit - matrix[self.names.index(name)]) / self.unit_of((name, sign, limit)))
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

    def answer(self, found: Any, nnls: Any) -> Design:
        """Return the design, or why there is none."""
        variables = np.asarray(found.x, dtype=float)
        numbers, values, _ = self.found(variables)
        near = self.near[variables.tobytes()]
        margins = self.margins(variables)
        sides = self.sides()
        worst = int(np.argmin(margins)) if sides else -1
        met = not sides or margins[worst] >= -MET
        exceeded = ""
        if not met:
            name, sign, limit = sides[worst]
            value = values[self.names.index(name)]
            exceeded = f"{name} = {value:.6g} {'above' if sign > 0 else 'below'} its limit {limit_in_words(limit)}"
        if not found.success or not met:
            raise DesignError(_reason(found, exceeded, self), self.evaluations)
        active, prices, slope = self.balance(variables, nnls)
        notes = []
        if slope > LEFT:
            notes.append(
                f"the objective still changes by {slope:.2g} % when a number changes by 1 %: a kink, where derivatives "
                "on either side differ, or a tolerance that is too wide"
            )
        if near is not None:
            notes.append(near_in_words(near))
        case = self.results.at(numbers)
        return Design(
            numbers=dict(zip(self.results.by, map(float, numbers), strict=True)),
            results=dict(zip(self.results.of, map(float, values[: len(self.results.of)]), strict=True)),
            objective=self.total(values),
            active=active,
            prices=prices,
            slope=slope,
            notes=notes,
            evaluations=self.evaluations,
            case=case,
            history=run(case, threads=self.threads),
        )

    def balance(self, variables: Reals, nnls: Any) -> tuple[list[str], dict[str, float], float]:
        """Active bounds and limits, shadow prices, and the slope that they leave (Kuhn and Tucker's conditions)."""
        size = abs(self.objective(variables)) or 1.0
        words, names, columns, units = [], [], [], []
        rows = zip(self.results.by, variables, self.low, self.high, self.pairs, strict=True)
        for number, (path, x, low, high, pair) in enumerate(rows):
            for side, at, value, way in (("lower", low, pair[0], 1.0), ("upper", high, pair[1], -1.0)):
                if abs(x - at) <= MET:
                    words.append(f"{path} at its {side} bound, {value:g}")
                    names.append("")
                    units.append(1.0)
                    columns.append(way * np.eye(len(variables))[number])
        _, values, _ = self.found(variables)
        margins, slopes = self.margins(variables), self.slopes_of_margins(variables)
        for margin, row, (name, sign, limit) in zip(margins, slopes, self.sides(), strict=True):
            if margin <= MET:
                # A price is that of a per cent of the limit here, which may have moved from the start.
                units.append(abs(self.value_of(limit, values)) / self.unit_of((name, sign, limit)) or 1.0)
                words.append(f"{name} at its {'upper' if sign > 0 else 'lower'} limit, {limit_in_words(limit)}")
                names.append(name)
                columns.append(row)
        slope = self.slope(variables) / size
        if not columns:
            return [], {}, float(np.abs(slope).max())
        weights, _ = nnls(np.array(columns).T, slope)
        left = slope - np.array(columns).T @ weights
        priced = zip(names, weights, units, strict=True)
        prices = {name: float(weight * unit) for name, weight, unit in priced if name}
        return words, prices, float(np.abs(left).max())


def _reason(found: Any, exceeded: str, question: _Question) -> str:
    """Why there is no design, and what to try."""
    last = dict(zip(question.results.by, map(float, question.numbers(found.x)), strict=True))
    reached = f"{question.tried} run; the last place: {in_words(last)}"
    if exceeded:
        return (
            f"design: the limits are not met: {exceeded}. {reached}. Widen the limits or the bounds, or begin where "
            "they are met"
        )
    if found.status == 9:
        return (
            f"design: no optimum after {found.nit} iterations. {reached}. Allow more iterations, or a wider tolerance"
        )
    return (
        f"design: no optimum: the objective falls nowhere along its derivatives ({found.message}). {reached}. Cells "
        "that change their state make kinks: a finer grid, a smaller tolerance of the solver, or a wider one of the "
        "design"
    )

"""Design: the numbers of a case at which a result is smallest or largest, within bounds and limits."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fretting import _case
from fretting._arguments import needed, real, whole
from fretting._arrays import Reals
from fretting._limits import Limit, in_words, limit_in_words
from fretting._paths import Table
from fretting._question import Question, SignChangedError
from fretting.differentiating import near_in_words
from fretting.errors import DesignError, Evaluation
from fretting.history import History
from fretting.simulation import run

MET = 1e-4
"""A limit is met that is exceeded by no more than so much of itself as it is, and is active that is as near."""
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
    is relaxed by one. Where both limits of a result are active there are two, ``"approach at its lower limit"`` and
    ``"approach at its upper limit"``."""
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
        take half of a thickness. Objective and limits have at least one result among them.
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
    question = Question(case, by, (minimize, maximize), limits, threads)
    accuracy, most = real("tolerance", tolerance), whole("iterations", iterations)
    if not 0.0 < accuracy < 1.0 or not 0 < most <= 10_000:
        raise ValueError(f"tolerance = {accuracy}, iterations = {most}: between 0 and 1, and from 1 to 10000")
    optimize = needed("scipy.optimize", "design needs SciPy: pip install 'fretting[design]', or pip install scipy")
    question.check_grid()
    question.begin()
    margins = {"type": "ineq", "fun": question.margins, "jac": question.slopes_of_margins}
    spent = 0

    def went_on(_: Reals) -> None:
        nonlocal spent
        spent += 1

    while True:
        before = spent
        try:
            found = optimize.minimize(
                question.objective,
                question.start,
                jac=question.slope,
                bounds=list(zip(question.low, question.high, strict=True)),
                constraints=[margins] if question.limits else [],
                method="SLSQP",
                options={"ftol": accuracy, "maxiter": max(most - before, 1)},
                callback=went_on,
            )
            found.nit += before
            return _answer(question, found, optimize.nnls)
        except SignChangedError:
            continue  # once for each limit at most; what was run is known


def _answer(question: Question, found: Any, nnls: Any) -> Design:
    """Return the design, or why there is none."""
    variables = np.asarray(found.x, dtype=float)
    numbers, values, _ = question.found(variables)
    near = question.near[variables.tobytes()]
    margins = question.margins(variables, told=True)
    worst = int(np.argmin(margins)) if question.sides else -1
    met = not question.sides or margins[worst] >= -MET
    exceeded = ""
    if not met:
        name, sign, limit = question.sides[worst]
        value = values[question.names.index(name)]
        exceeded = f"{name} = {value:.6g} {'above' if sign > 0 else 'below'} its limit {limit_in_words(limit)}"
    if not found.success or not met:
        raise DesignError(_reason(found, exceeded, question), question.evaluations)
    active, prices, slope = _balance(question, variables, nnls)
    notes = []
    if slope > LEFT:
        notes.append(
            f"the objective still changes by {slope:.2g} % when a number changes by 1 %: a kink, where derivatives "
            "on either side differ, or a tolerance that is too wide"
        )
    if near is not None:
        notes.append(near_in_words(near))
    case = question.results.at(numbers)
    return Design(
        numbers=dict(zip(question.results.by, map(float, numbers), strict=True)),
        results=dict(zip(question.results.of, map(float, values[: len(question.results.of)]), strict=True)),
        objective=question.total(values),
        active=active,
        prices=prices,
        slope=slope,
        notes=notes,
        evaluations=question.evaluations,
        case=case,
        history=run(case, threads=question.threads),
    )


def _balance(question: Question, variables: Reals, nnls: Any) -> tuple[list[str], dict[str, float], float]:
    """Active bounds and limits, shadow prices, and the slope that they leave (Kuhn and Tucker's conditions)."""
    size = abs(question.objective(variables)) or 1.0
    words, columns, units = [], [], []
    sides: list[tuple[str, str]] = []
    rows = zip(question.results.by, variables, question.low, question.high, question.pairs, strict=True)
    for number, (path, x, low, high, pair) in enumerate(rows):
        for side, at, value, way in (("lower", low, pair[0], 1.0), ("upper", high, pair[1], -1.0)):
            if abs(x - at) <= MET:
                words.append(f"{path} at its {side} bound, {value:g}")
                sides.append(("", side))
                units.append(1.0)
                columns.append(way * np.eye(len(variables))[number])
    _, values, _ = question.found(variables)
    margins, slopes = question.margins(variables, told=True), question.slopes_of_margins(variables)
    for margin, row, unit, (name, sign, limit) in zip(margins, slopes, question.units, question.sides, strict=True):
        if margin <= MET:
            # A price is that of a per cent of the limit here, which may have moved from the start.
            units.append(1.0 if unit is None else abs(question.value_of(limit, values)) / unit or 1.0)
            side = f"{name} at its {'upper' if sign > 0 else 'lower'} limit"
            words.append(f"{side}, {limit_in_words(limit)}")
            sides.append((name, side))
            columns.append(row)
    slope = question.slope(variables) / size
    if not columns:
        return [], {}, float(np.abs(slope).max())
    weights, _ = nnls(np.array(columns).T, slope)
    left = slope - np.array(columns).T @ weights
    names = [name for name, _ in sides]
    called = [side if names.count(name) > 1 else name for name, side in sides]
    priced = zip(names, called, weights, units, strict=True)
    prices = {key: float(weight * unit) for name, key, weight, unit in priced if name}
    return words, prices, float(np.abs(left).max())


def _reason(found: Any, exceeded: str, question: Question) -> str:
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

"""Optima of a case against closed forms, and against sweeps."""

import math
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
from fretting._question import SignChangedError

pytest.importorskip("scipy")

FORCE, RADIUS, POISSON = 10.0, 10e-3, 0.3
YOUNG = "lower.substrate.young"


def ball(young: float, length: float = 1.0) -> dict[str, Any]:
    """A rigid ball on a half-space; lengths times a factor, as in another unit."""
    return {
        "grid": {"cells": [64, 64], "size": [400e-6 * length, 400e-6 * length]},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": young / length**2, "poisson": POISSON}},
        "profile": {"sphere": {"radius": RADIUS * length}},
        "solver": {"tolerance": 1e-9},
        "load": [{"normal_force": FORCE, "increments": 1}],
    }


def pressure_and_approach(young: float) -> tuple[float, float]:
    """Hertz: p_0 = (6 P E*^2 / (pi^3 R^2))^(1/3), delta = (9 P^2 / (16 R E*^2))^(1/3)."""
    modulus = young / (1.0 - POISSON**2)
    return (
        (6.0 * FORCE * modulus**2 / (math.pi**3 * RADIUS**2)) ** (1 / 3),
        (9.0 * FORCE**2 / (16.0 * RADIUS * modulus**2)) ** (1 / 3),
    )


# 22 to 26 cells in the diameter of the contact: pressure and approach are within 1 % of the closed form, and a modulus
# that follows from their ratio, to a power of 3/4, or from the pressure, to one of 3/2, within 1.5 %.
GRID = 0.015


def test_an_optimum_inside_is_that_of_the_closed_form() -> None:
    # p_0 grows with E*^(2/3), the approach falls with it: their sum over their values at 150 GPa is least there, and 2.
    best = 150e9
    pressure, approach = pressure_and_approach(best)
    weights = {"max_pressure": 1.0 / pressure, "approach": 1.0 / approach}
    for start in (60e9, 380e9):
        found = fretting.design(ball(start), by={YOUNG: (50e9, 400e9)}, minimize=weights)
        assert found.numbers[YOUNG] == pytest.approx(best, rel=GRID)
        assert found.objective == pytest.approx(2.0, rel=GRID)
        assert found.active == [] and found.prices == {} and found.slope < 0.01
        assert len(found.evaluations) < 12
        assert found.results["approach"] == found.history.increments["approach"][-1]


def test_an_optimum_at_a_limit_is_that_of_the_closed_form() -> None:
    limit, _ = pressure_and_approach(200e9)
    for sense in ({"minimize": "approach"}, {"maximize": {"approach": -1.0}}):
        found = fretting.design(ball(90e9), by={YOUNG: (50e9, 400e9)}, limits={"max_pressure": (None, limit)}, **sense)
        assert found.numbers[YOUNG] == pytest.approx(200e9, rel=GRID)
        assert found.results["max_pressure"] <= limit * (1 + 1e-4)
        assert found.active == [f"max_pressure at its upper limit, {limit:g}"]
        # The approach is as 1/p_0: one per cent more of pressure takes one per cent of it; the powers are the grid's.
        assert found.prices["max_pressure"] == pytest.approx(1.0, abs=0.03)
        assert found.slope < 1e-6


def test_both_limits_of_a_result_have_their_prices() -> None:
    """Limits of a pressure so near to each other that both count as active: the upper one costs approach, as above."""
    limit, _ = pressure_and_approach(200e9)
    found = fretting.design(
        ball(90e9),
        by={YOUNG: (50e9, 400e9)},
        minimize="approach",
        limits={"max_pressure": (limit * (1 - 4e-5), limit * (1 + 4e-5))},
    )
    assert found.numbers[YOUNG] == pytest.approx(200e9, rel=GRID)
    assert len(found.active) == 2
    assert found.prices["max_pressure at its upper limit"] == pytest.approx(1.0, abs=0.03)
    assert found.prices["max_pressure at its lower limit"] == 0.0
    assert len(found.prices) == 2


def softest(start: float, share: float) -> fretting.Design:
    """The softest half-space under a rigid ball (3 mm, 2 N) whose pressure is no more than a part of its modulus."""
    case = {
        **ball(start),
        "grid": {"cells": [64, 64], "size": [180e-6, 180e-6]},
        "profile": {"sphere": {"radius": 3e-3}},
        "load": [{"normal_force": 2.0, "increments": 1}],
    }
    limits = {"max_pressure": (None, {YOUNG: share})}
    return fretting.design(case, by={YOUNG: (20e9, 1000e9)}, minimize=YOUNG, limits=limits)


def test_a_limit_that_is_a_sum_is_met_from_all_starts() -> None:
    """p_0 = w E of Hertz' pressure: E = 6 P / (pi^3 R^2 (1 - nu^2)^2 w^3), from starts on either side of it."""
    share = 6.3e-3
    best = 6.0 * 2.0 / (math.pi**3 * 3e-3**2 * (1.0 - POISSON**2) ** 2 * share**3)
    found = [softest(start, share) for start in (30e9, 40e9, 60e9, 100e9, 400e9, 900e9)]
    for one in found:
        # The pressure on the grid is within 1 %, its power within 0.01: E is as the pressure to the third power, and
        # the price, 1 / (1 - 2/3), moves by 9 times as much as the power.
        assert one.numbers[YOUNG] == pytest.approx(best, rel=0.03)
        assert one.prices["max_pressure"] == pytest.approx(3.0, abs=0.09)
        assert one.results["max_pressure"] == pytest.approx(share * one.numbers[YOUNG], rel=1e-5)
        # The optimiser meets a limit to 1e-5.
        assert one.numbers == pytest.approx(found[0].numbers, rel=3e-5)
    # A price is what a limit that is wider by a thousandth brings; the second order is 6 thousandths of it.
    wider = softest(100e9, share * math.exp(1e-3)).numbers[YOUNG]
    assert -math.log(wider / found[3].numbers[YOUNG]) / 1e-3 == pytest.approx(found[3].prices["max_pressure"], rel=6e-3)


@pytest.mark.parametrize("start", [1e-5, 0.1])
def test_a_limit_that_moves_by_a_hundred_times_is_met(start: float) -> None:
    """The smallest ball whose approach is a part of its radius: 1 mm by Hertz, from one of 10 um and one of 10 cm."""
    radius = "profile.sphere.radius"
    modulus = 210e9 / (1.0 - POISSON**2)
    share = (9.0 * FORCE**2 / (16.0 * 1e-3 * modulus**2)) ** (1 / 3) / 1e-3
    case = {
        **ball(210e9),
        "grid": {"cells": [128, 128], "size": [360e-6, 360e-6]},
        "profile": {"sphere": {"radius": start}},
    }
    found = fretting.design(
        case, by={radius: (1e-5, 0.1)}, minimize=radius, limits={"approach": (None, {radius: share})}
    )
    # The radius is as the approach to a power of 3/4, which the grid has to 1 %.
    assert found.numbers[radius] == pytest.approx(1e-3, rel=GRID)
    assert found.results["approach"] == pytest.approx(share * found.numbers[radius], rel=1e-4)
    assert found.prices["approach"] == pytest.approx(0.75, abs=0.02)


def test_bounds_that_hold_an_optimum_are_named() -> None:
    by = {YOUNG: (50e9, 400e9), "load[0].normal_force": (5.0, 15.0)}
    found = fretting.design(ball(90e9), by=by, minimize="max_pressure")
    assert found.active == [f"{YOUNG} at its lower bound, 5e+10", "load[0].normal_force at its lower bound, 5"]
    assert found.numbers == pytest.approx({YOUNG: 50e9, "load[0].normal_force": 5.0}, rel=1e-12)
    assert found.slope == 0.0


def test_a_design_does_not_depend_on_units() -> None:
    limit, _ = pressure_and_approach(200e9)
    bounds = (50e9, 400e9)
    found = [
        fretting.design(
            ball(90e9, length),
            by={YOUNG: (bounds[0] / length**2, bounds[1] / length**2)},
            minimize="approach",
            limits={"max_pressure": (None, limit / length**2)},
        ).numbers[YOUNG]
        * length**2
        for length in (1.0, 1e3)
    ]
    assert found[0] == pytest.approx(found[1], rel=1e-6)


COATED: dict[str, Any] = {
    "grid": {"cells": [32, 32], "size": [100e-6, 100e-6]},
    "upper": {"substrate": {"young": 210e9, "poisson": 0.3}},
    "lower": {
        "coatings": [{"thickness": 2e-6, "young": 200e9, "poisson": 0.22}],
        "substrate": {"young": 210e9, "poisson": 0.3},
    },
    "profile": {"sphere": {"radius": 3e-3}},
    "friction": {"coefficient": 0.2},
    "load": [
        {"name": "press", "normal_force": 2.0, "increments": 4},
        {"name": "rub", "tangential_force": [0.25, 0.0], "cycles": 1, "increments": 16},
    ],
}
THICKNESS = "lower.coatings[0].thickness"
MODULUS = "lower.coatings[0].young"
ENERGY = "cycles[0].dissipated_energy"


PRESS, RUB = "load[0].normal_force", "load[1].tangential_force[0]"


def rubbed(force: float) -> dict[str, Any]:
    """The coated body, rubbed by a force to one side or the other."""
    return {**COATED, "load": [COATED["load"][0], {"name": "rub", "tangential_force": [force, 0.0], "increments": 4}]}


def test_limits_below_zero_are_those_of_the_mirrored_case() -> None:
    # The largest force of either sense that is no more than a tenth of the largest normal force: 0.3.
    by = {PRESS: (1.5, 3.0), RUB: (-0.5, 0.5)}
    bearable = {"max_pressure": (None, 1e12)}
    right = fretting.design(rubbed(0.05), by=by, maximize=RUB, limits={RUB: (None, {PRESS: 0.1}), **bearable})
    left = fretting.design(rubbed(-0.05), by=by, minimize=RUB, limits={RUB: ({PRESS: -0.1}, None), **bearable})
    # A limit is met to 1e-5.
    assert right.numbers == pytest.approx({PRESS: 3.0, RUB: 0.3}, rel=1e-5)
    assert left.numbers == pytest.approx({PRESS: 3.0, RUB: -0.3}, rel=1e-5)
    assert left.prices == pytest.approx(right.prices, rel=1e-3)
    assert right.prices[RUB] == pytest.approx(1.0, rel=1e-3)


@pytest.mark.parametrize("limit", [{RUB: ({PRESS: -0.05}, None)}, {RUB: ({PRESS: -0.05}, 0.4)}])
def test_a_result_may_change_its_sign_on_the_way_to_a_limit(limit: Any) -> None:
    # From a force to the right to the largest one to the left, 0.05 of the largest normal force.
    found = fretting.design(
        rubbed(0.2),
        by={PRESS: (1.5, 3.0), RUB: (-0.5, 0.5)},
        minimize=RUB,
        limits={**limit, "max_pressure": (None, 1e12)},
    )
    assert found.numbers == pytest.approx({PRESS: 3.0, RUB: -0.15}, rel=1e-4)
    assert found.prices[RUB] == pytest.approx(1.0, rel=1e-3)
    places = [tuple(one.numbers.values()) for one in found.evaluations]
    assert len(set(places)) == len(places), "nothing is run twice"


def test_what_begins_anew_has_the_iterations_that_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    optimize = pytest.importorskip("scipy.optimize")
    minimize, left = optimize.minimize, []

    def begun(*args: Any, callback: Any, options: dict[str, Any], **others: Any) -> Any:
        left.append(options["maxiter"])
        done = 0

        def went_on(place: Any) -> None:
            nonlocal done
            done += 1
            callback(place)
            if len(left) == 1 and done == 2:
                raise SignChangedError

        return minimize(*args, callback=went_on, options=options, **others)

    monkeypatch.setattr(optimize, "minimize", begun)
    fretting.design(COATED, by=BOUNDS, minimize=ENERGY, limits={"max_pressure": (None, 1e12)}, iterations=30)
    assert left == [30, 28]


def test_a_number_is_the_same_however_it_is_written() -> None:
    rubbed_by = "load.rub.tangential_force.0"
    found = fretting.design(
        rubbed(0.05),
        by={"load.0.normal_force": (1.5, 3.0), rubbed_by: (0.01, 0.5)},
        maximize={RUB: 0.5, "load[-1].tangential_force[0]": 0.5},
        limits={RUB: (None, {PRESS: 0.1}), "max_pressure": (None, 1e12)},
    )
    assert found.numbers == pytest.approx({"load.0.normal_force": 3.0, rubbed_by: 0.3}, rel=1e-5)
    assert found.objective == found.numbers[rubbed_by]
    assert set(found.prices) == {rubbed_by} and set(found.results) == {"max_pressure"}


BOUNDS = {THICKNESS: (1e-6, 8e-6), MODULUS: (120e9, 400e9)}


@pytest.fixture(scope="module")
def swept() -> tuple[list[np.ndarray[Any, Any]], Any]:
    """Thicknesses and moduli in steps of equal ratios, and what a sweep of them has."""
    pytest.importorskip("xarray")
    rows = [np.geomspace(*pair, 7) for pair in BOUNDS.values()]
    return rows, fretting.sweep(
        COATED, dict(zip(("lower.coatings.0.thickness", "lower.coatings.0.young"), rows, strict=True))
    )


@pytest.mark.parametrize(
    ("limit", "active"),
    [(0.83e9, ["max_pressure at its upper limit, 8.3e+08"]), (0.86e9, [THICKNESS, MODULUS])],
)
def test_the_optimum_of_a_coating_lies_where_a_sweep_has_it(limit: float, active: list[str], swept: Any) -> None:
    rows, told = swept
    found = fretting.design(COATED, by=BOUNDS, minimize=ENERGY, limits={"max_pressure": (None, limit)})
    allowed = told["cycle_dissipated_energy"].where(told["max_pressure"] <= limit)
    place = np.unravel_index(np.nanargmin(allowed.values), allowed.shape)
    best = [row[index] for row, index in zip(rows, place, strict=True)]
    assert found.objective <= allowed.values[place] * (1 + 1e-6)
    for number, other, row in zip(found.numbers.values(), best, rows, strict=True):
        assert abs(math.log(number / other)) <= math.log(row[1] / row[0]), (found.numbers, best)
    assert len(found.active) == len(active)
    assert all(words.startswith(name) for words, name in zip(found.active, active, strict=True)), found.active


GUIDE = Path(__file__).parents[2] / "docs" / "do" / "design-a-coating.md"


def test_a_limit_moves_with_a_number_and_a_number_is_an_objective() -> None:
    """The thinnest film and the stiffest one of the guide, and its table, whose films are run without derivatives."""
    pytest.importorskip("xarray")
    page = GUIDE.read_text(encoding="utf-8").partition("## A film that wears")[2].partition("## What can")[0]
    told: dict[str, Any] = {"fretting": fretting, "print": lambda *_: None}
    setup, thinnest, stiffest, sweep = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    exec("\n".join([setup.partition("\nfor ")[0], thinnest, stiffest, sweep.partition("\nfor ")[0]]), told)
    thin, stiff = told["thin"], told["stiff"]
    # The numbers of the page, to its digits; those of a vertex of two limits are as certain as these are met.
    assert thin.numbers == pytest.approx({THICKNESS: 1.92e-6}, rel=3e-3)
    assert thin.active == [f"max_worn_depth at its upper limit, 0.1 {THICKNESS}"]
    # A thickness that is ten times the worn depth goes with it, but for what the film's thickness does to the wear.
    assert thin.prices["max_worn_depth"] == pytest.approx(1.0, abs=0.01)
    assert stiff.numbers == pytest.approx({THICKNESS: 1.92e-6, MODULUS: 259e9}, rel=3e-3)
    assert stiff.objective == stiff.numbers[MODULUS] and len(stiff.active) == 2
    assert stiff.results["max_worn_depth"] == pytest.approx(0.1 * stiff.numbers[THICKNESS], rel=1e-4)
    assert list(stiff.prices.values()) == pytest.approx([1.23, 3.24], rel=0.01)
    assert set(stiff.history.cycles["stands_for"]) == {2000}
    # The thick branch: the bond decides, and of the largest modulus any film from 9.6 um on will do.
    assert told["thick"].numbers == pytest.approx({THICKNESS: 8.78e-6}, rel=3e-3)
    assert list(told["thick"].prices.values()) == pytest.approx([2.57], rel=0.01)
    assert told["stiffest"].numbers[MODULUS] == 400e9 and told["stiffest"].numbers[THICKNESS] > 9.5e-6
    assert len(told["stiffest"].active) == 1
    # The page says on which side of 4 to 5 um a start finds the thin film, where no thick one is thin enough.
    near = fretting.design(
        told["with_film"](4e-6), by={THICKNESS: (1e-6, 8e-6)}, minimize=THICKNESS, limits=told["lasting"]
    )
    assert near.numbers == pytest.approx({THICKNESS: 1.92e-6}, rel=3e-3)
    for start in (5e-6, 6e-6, 8e-6):
        with pytest.raises(fretting.DesignError, match=r"interface_shear = .* above its limit"):
            fretting.design(
                told["with_film"](start), by={THICKNESS: (1e-6, 8e-6)}, minimize=THICKNESS, limits=told["lasting"]
            )
    branches = re.findall(r"\| (\d+) um \| (\d+) MPa \| ([\d.]+) % \|", page)
    assert len(branches) == 8
    for depth, shear, loss in branches:
        # By plain runs, without derivatives; half of the last digit.
        worn, sheared = told["worn_and_sheared"](float(depth) * 1e-6, 200e9)
        assert sheared == pytest.approx(float(shear) * 1e6, abs=0.55e6)
        assert worn == pytest.approx(float(loss) / 100, abs=0.00055)
    table = re.findall(r"\| ([\d.]+) um \|" + 3 * r"\D*(\d+) MPa\D*\|" + r"\D*([\d.]+) %", page)
    assert len(table) == 3
    for depth, *shears, loss in table:
        for young, shear in zip((230e9, 259e9, 290e9), shears, strict=True):
            worn, sheared = told["worn_and_sheared"](float(depth) * 1e-6, young)
            # Half of the last digit, and what 1.92 um and 259 GPa leave out of the optimum.
            assert sheared == pytest.approx(float(shear) * 1e6, abs=0.55e6)
            assert worn == pytest.approx(float(loss) / 100, abs=0.00055)
            if young >= 259e9 and depth != "1.92":
                assert worn > 0.1 or sheared > 215e6


def test_what_stands_for_a_limit_is_checked() -> None:
    wrong: list[Any] = [{}, {YOUNG: math.inf}, "high"]
    for side in wrong:
        with pytest.raises((ValueError, TypeError), match="limits"):
            fretting.design(ball(90e9), by={YOUNG: (50e9, 400e9)}, minimize=YOUNG, limits={"approach": (None, side)})


def test_what_cannot_be_reached_is_an_error_with_all_that_was_run() -> None:
    low, _ = pressure_and_approach(50e9)
    with pytest.raises(fretting.DesignError, match=r"limits are not met: max_pressure = .* above its limit") as caught:
        fretting.design(
            ball(90e9), by={YOUNG: (50e9, 400e9)}, minimize="approach", limits={"max_pressure": (None, 0.9 * low)}
        )
    assert caught.value.evaluations[0].numbers == {YOUNG: 90e9}
    assert set(caught.value.evaluations[0].results) == {"approach", "max_pressure"}
    pressure, approach = pressure_and_approach(150e9)
    weights = {"max_pressure": 1.0 / pressure, "approach": 1.0 / approach}
    with pytest.raises(fretting.DesignError, match="after 1 iterations"):
        fretting.design(ball(60e9), by={YOUNG: (50e9, 400e9)}, minimize=weights, iterations=1)


def test_a_case_on_the_way_that_is_not_solved_names_its_numbers() -> None:
    # A ball of 1 m makes a contact beyond the grid.
    with pytest.raises(fretting.DesignError, match=r"the next, profile.sphere.radius = .* edge of the grid") as caught:
        fretting.design(ball(90e9), by={"profile.sphere.radius": (1e-3, 1.0)}, minimize="max_pressure")
    assert isinstance(caught.value.__cause__, fretting.CaseError)
    assert caught.value.evaluations[0].numbers == {"profile.sphere.radius": RADIUS}


def test_cells_about_to_change_their_state_are_told() -> None:
    # A force that turns back by a ten-millionth: the cells that slid stick, as near to their bound.
    pytest.importorskip("xarray")
    back = {"tangential_force": [0.25 * (1 - 1e-7), 0.0], "increments": 1}
    rub = {"tangential_force": [0.25, 0.0], "increments": 4}
    case = {**COATED, "solver": {"tolerance": 1e-10}, "load": [COATED["load"][0], rub, back]}
    found = fretting.design(case, by={THICKNESS: (1e-6, 8e-6)}, minimize="max_pressure")
    assert any(note.startswith("increment 8: ") and "another state" in note for note in found.notes), found.notes
    told = fretting.first_order(case, {THICKNESS: fretting.Normal(2e-6, 1e-7)}, of="max_pressure")
    assert told.attrs["note"].startswith("increment 8: ")


def test_an_objective_of_nothing_is_refused() -> None:
    # Without a tangential force nothing is dissipated, whatever the film.
    case = {**COATED, "load": COATED["load"][:1]}
    with pytest.raises(ValueError, match="changes with none of them"):
        fretting.design(case, by={THICKNESS: (1e-6, 8e-6)}, minimize="tangential_force_x")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"minimize": None}, "one of both"),
        ({"maximize": "approach"}, "one of both"),
        ({"minimize": {}}, "finite weights"),
        ({"minimize": {"approach": math.nan}}, "finite weights"),
        ({"minimize": "contact_area"}, "two runs"),
        ({"by": {YOUNG: (100e9, 400e9)}}, "must lie within its bounds"),
        ({"by": {YOUNG: (400e9, 50e9)}}, "must be finite and rise"),
        ({"by": {YOUNG: 3.0}}, "expected a pair"),
        ({"by": {}}, "by: expected at least one number"),
        ({"minimize": YOUNG}, "at least one result in them"),
        ({"minimize": "load[0].normal_force"}, r"load\[0\].normal_force: not a number of `by`, which has lower"),
        ({"limits": {"lower.substrate.poisson": (0.1, None)}}, "lower.substrate.poisson: not a number of `by`"),
        ({"limits": {"max_pressure": (None, {"profile.sphere.radius": 1e9})}}, "radius: not a number of `by`"),
        ({"minimize": "increments[7].contact_area"}, "two runs"),
        ({"by": {"load[0].normal_force": (1, 20), "load.0.normal_force": (1, 20)}}, "named twice"),
        ({"by": {PRESS: (1, 20)}, "limits": {PRESS: (2, 9), "load.0.normal_force": (3, 9)}}, "named twice"),
        ({"by": {"solver.tolerance": (1e-10, 1e-8)}}, "paths are those of the case"),
        ({"limits": {"max_pressure": (None, None)}}, "least and the largest"),
        ({"limits": {"max_pressure": (2.0, 1.0)}}, "least and the largest"),
        ({"tolerance": 0.0}, "between 0 and 1"),
        ({"case": {**ball(90e9), "grid": {"cells": [32, 32], "size": "auto"}}}, "moves the grid with the numbers"),
        (
            {
                "case": {**COATED, "wear": {"coefficient": 1e-13, "debris": {"fraction": 0.5, "stiffness": 1e14}}},
                "by": {THICKNESS: (1e-6, 8e-6)},
            },
            r"wear\.debris\.stiffness",
        ),
    ],
)
def test_questions_without_an_answer_are_refused(changes: dict[str, Any], words: str) -> None:
    arguments = {"case": ball(90e9), "by": {YOUNG: (50e9, 400e9)}, "minimize": "approach", **changes}
    with pytest.raises(ValueError, match=words):
        fretting.design(**arguments)


def test_without_scipy_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(ImportError, match=r"fretting\[design\]"):
        fretting.design(ball(90e9), by={YOUNG: (50e9, 400e9)}, minimize="approach")

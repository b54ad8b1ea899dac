"""Whatever is computed can be copied, and sent to another process, with the same numbers to the bit."""

import copy
import inspect
import pickle
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import fretting
from fretting import analytic

SPHERE = analytic.hertz(radius=1.0, force=1.0, modulus=1.0)
CYLINDER = analytic.hertz_line(radius=1.0, line_force=1.0, modulus=1.0)
GIVEN: dict[str, Any] = {
    "sphere": SPHERE, "cylinder": CYLINDER, "layer": {"thickness": 0.1, "young": 1.0, "poisson": 0.3},
    "lower": {"young": 1.0, "poisson": 0.3}, "radius": 1.0, "radius_x": 1.0, "radius_y": 2.0, "force": 1.0,
    "line_force": 1.0, "modulus": 1.0, "shear_modulus": 1.0, "friction_coefficient": 0.3, "tangential_force": 0.1,
    "tangential_forces": [0.1, 0.2], "strain": 0.005, "tilt": 0.01, "coupling": 0.3, "moment": 0.01, "slope": 0.1,
    "amplitude": 0.1, "wavelength": 1.0, "mean_pressure": 0.1, "half_width": 1.0, "flat_radius": 1.0,
    "edge_radius": 1.0, "contact_radius": 0.02,
}  # fmt: skip
WAYS: dict[str, Callable[[Any], Any]] = {
    "pickle": lambda thing: pickle.loads(pickle.dumps(thing)),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
}
PLACES = [0.0, 0.01, 0.3, 2.0]


def closed_forms() -> Iterator[tuple[str, Any]]:
    for name in analytic.__all__:
        function = getattr(analytic, name)
        if inspect.isfunction(function):
            needed = [one.name for one in inspect.signature(function).parameters.values() if one.default is one.empty]
            yield name, function(**{one: GIVEN[one] for one in needed})
    loop = analytic.mindlin_deresiewicz(SPHERE, friction_coefficient=0.3, shear_modulus=1.0, amplitude=0.2)
    yield "LoopPoint", loop.at("unloading", 0.1)
    yield "its peak", loop.peak


def curves(solution: Any) -> dict[str, Any]:
    """Curves of a solution at some places."""
    found = {}
    for name, method in inspect.getmembers(solution, inspect.ismethod):
        if name not in ("at", "__init__") and not name.startswith("_"):
            found[name] = method(*[PLACES] * len(inspect.signature(method).parameters))
    return found


@pytest.mark.parametrize("way", WAYS)
def test_closed_forms_are_the_same_afterwards(way: str) -> None:
    compared = 0
    for name, solution in closed_forms():
        again = WAYS[way](solution)
        assert repr(again) == repr(solution), name
        before = curves(solution)
        for curve, values in curves(again).items():
            np.testing.assert_array_equal(values, before[curve], err_msg=f"{name}.{curve}")
            compared += 1
    assert compared > 20


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("parity", ["even-even", "odd-even"])
def test_a_convolution_is_the_same_afterwards(way: str, parity: Any) -> None:
    random = np.random.default_rng(3)
    kernel, field = random.normal(size=(2, 7, 5))
    product = fretting.Convolution(kernel, parity=parity)
    expected = product(field)
    kernel[:] = 0.0  # the caller's own: what was made of it stays
    again = WAYS[way](product)
    assert (again.shape, again.parity) == (product.shape, parity)
    np.testing.assert_array_equal(again(field), expected)


@pytest.mark.parametrize("way", WAYS)
def test_what_functions_answer_is_the_same_afterwards(way: str, sphere_case: dict[str, Any]) -> None:
    sphere_case["grid"]["cells"] = [16, 16]
    plan = fretting.plan(sphere_case)
    again = WAYS[way](plan)
    assert (dict(again), again.seconds_expected) == (dict(plan), plan.seconds_expected)
    gradient = fretting.gradient(sphere_case, of="max_pressure")
    again = WAYS[way](gradient)
    assert (again, again.near_events) == (gradient, gradient.near_events)
    history = fretting.run(sphere_case)
    np.testing.assert_array_equal(WAYS[way](history).field("pressure"), history.field("pressure"))
    for distribution in (fretting.Normal(1.0, 0.1), fretting.Triangular(0.0, 0.5, 1.0)):
        assert WAYS[way](distribution) == distribution


@pytest.mark.parametrize("way", WAYS)
def test_errors_keep_what_they_tell(way: str, sphere_case: dict[str, Any]) -> None:
    with pytest.raises(fretting.CaseError) as refused:
        fretting.plan({**sphere_case, "grid": {"cells": [16, 16], "size": "atuo"}})
    again = WAYS[way](refused.value)
    assert (str(again), again.mistakes) == (str(refused.value), refused.value.mistakes)
    with pytest.raises(fretting.MissingFileError) as missing:
        fretting.plan("nowhere.toml")
    again = WAYS[way](missing.value)
    assert (str(again), again.path) == (str(missing.value), "nowhere.toml")

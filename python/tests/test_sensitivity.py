"""Exact sensitivities from Python and from the command, against closed forms and differences of runs."""

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
from fretting._function import Results

CASE: dict[str, Any] = {
    "grid": {"cells": [32, 32], "size": [320e-6, 320e-6]},
    "upper": {"rigid": True},
    "lower": {
        "coatings": [{"thickness": 20e-6, "young": 400e9, "poisson": 0.2}],
        "substrate": {"young": 210e9, "poisson": 0.3},
    },
    "profile": {"sphere": {"radius": 10e-3}},
    "friction": {"coefficient": 0.3},
    "solver": {"tolerance": 1e-10},
    "load": [
        {"name": "press", "normal_force": 12.0, "increments": 4},
        {"name": "rub", "tangential_force": [1.5, 0.0], "cycles": 1, "increments": 8},
    ],
}
MODULI = ["lower.coatings[0].young", "lower.substrate.young"]
FORCES = ["load[0].normal_force", "load[1].tangential_force[0]"]


def with_friction(coefficient: float) -> dict[str, Any]:
    return {**CASE, "friction": {"coefficient": coefficient}}


def test_derivatives_are_those_of_the_history() -> None:
    of = ["max_pressure", "cycles[0].dissipated_energy", "increments[5].shift_x"]
    found = fretting.gradient(CASE, of=of, by=["friction.coefficient", *MODULI, *FORCES])
    history = fretting.run(CASE)
    assert list(found) == of
    assert found["max_pressure"]["value"] == history.increments["max_pressure"][-1]
    assert found["increments[5].shift_x"]["value"] == history.increments["shift_x"][5]
    energy = found["cycles[0].dissipated_energy"]
    assert energy["value"] == pytest.approx(history.cycles["dissipated_energy"][0], rel=1e-12)
    # A difference over a step so small that hardly a cell changes its state; the runs leave 1e-10 over 1e-5.
    step = 0.3e-5
    up, down = (fretting.run(with_friction(0.3 + by)).cycles["dissipated_energy"][0] for by in (step, -step))
    assert energy["friction.coefficient"] == pytest.approx((up - down) / (2 * step), rel=1e-4)
    # Moduli and forces are one dimension: a pressure grows with both together, a length does not change.
    values = dict(zip([*MODULI, *FORCES], [400e9, 210e9, 12.0, 1.5], strict=True))
    for name, power in {"max_pressure": 1, "cycles[0].dissipated_energy": 1, "increments[5].shift_x": 0}.items():
        total = sum(found[name][path] * value for path, value in values.items())
        assert total == pytest.approx(power * found[name]["value"], abs=1e-6 * abs(found[name]["value"])), name


def test_ruiz_parameters_are_those_of_the_history() -> None:
    """Both are the largest of the map that the fields of a run have."""
    pytest.importorskip("xarray")
    found = fretting.gradient(CASE, of=["fatigue.ruiz_f1", "fatigue.ruiz_f2"], by=[*MODULI, *FORCES])
    output = {"fields": ["pressure", "shear", "slip"], "every": 1}
    fatigue = fretting.run({**CASE, "output": output}).fatigue([0.0])
    values = dict(zip([*MODULI, *FORCES], [400e9, 210e9, 12.0, 1.5], strict=True))
    for name, power in {"ruiz_f1": 1, "ruiz_f2": 2}.items():
        gradient = found[f"fatigue.{name}"]
        # The stress of one depth alone or of all: rounding.
        assert gradient["value"] == pytest.approx(float(fatigue[name].max()), rel=1e-12)
        # Moduli and forces are one dimension: slip does not change with it, shear and tension grow.
        total = sum(gradient[path] * value for path, value in values.items())
        assert total == pytest.approx(power * gradient["value"], rel=1e-6), name


def test_a_function_of_numbers_has_stresses() -> None:
    """Without derivatives they are those that come with them."""
    results = Results(CASE, ["increments[3].stress.tension", "fatigue.ruiz_f1", "approach"], FORCES, None)
    values, _ = results.differentiated(np.array([12.0, 1.5]))
    assert (results.values(np.array([12.0, 1.5])) == values).all()


def test_cells_about_to_change_their_state_are_told() -> None:
    # A force that turns back by a ten-millionth: the cells that slid stick, as near to their bound; before it none is.
    slid = {"tangential_force": [1.5, 0.0], "increments": 4}
    back = {"tangential_force": [1.5 * (1 - 1e-7), 0.0], "increments": 1}
    turned = {**CASE, "load": [CASE["load"][0], slid, back]}
    history = fretting.run({**turned, "output": {"fields": ["pressure", "zone"], "every": 1}})
    pressed, slipped = history.field("pressure", 7) > 0, history.field("zone", 7) == 2
    for by in ("profile.sphere.radius", ["profile.sphere.radius", "friction.coefficient"]):  # forward, backwards
        found = fretting.gradient(turned, of="max_pressure", by=by)
        near, other = found.near_events, found.on_the_other_side
        assert near is not None
        assert other is not None
        assert set(other["max_pressure"]) == set(found["max_pressure"]) - {"value"}
        assert near.increment == 8
        assert (near.cells, near.contact_cells) == (slipped.sum(), pressed.sum())
        assert near.share == pytest.approx(slipped.sum() / pressed.sum())
        before = fretting.gradient(turned, of="increments[7].max_pressure", by=by)
        assert before.near_events is None
        assert before.on_the_other_side is None


def test_without_names_all_numbers_are_taken() -> None:
    found = fretting.gradient(CASE, of="max_pressure")["max_pressure"]
    paths = {"friction.coefficient", *MODULI, *FORCES, "lower.coatings[0].thickness", "profile.sphere.radius"}
    assert paths | {"value", "lower.coatings[0].poisson", "lower.substrate.poisson"} == set(found)


@pytest.mark.parametrize(
    ("of", "by", "told"),
    [
        ("pressure", "friction.coefficient", "max_pressure"),
        ("contact_area", "friction.coefficient", "two runs"),
        ("max_pressure", "friction.strength", "paths are those of the case"),
        ("increments[40].shift_x", "friction.coefficient", "12 increments"),
    ],
)
def test_what_there_is_not_is_refused(of: str, by: str, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        fretting.gradient(CASE, of=of, by=by)


def test_wear_that_changes_the_response_is_refused_by_its_key() -> None:
    debris = {"fraction": 0.5, "stiffness": 1e14}
    with pytest.raises(ValueError, match=r"wear\.debris\.stiffness"):
        fretting.gradient({**CASE, "wear": {"coefficient": 1e-13, "debris": debris}}, of="max_pressure")


def test_the_command_gives_the_same(tmp_path: Path) -> None:
    text = Path(__file__).parents[2].joinpath("examples", "hertz.toml").read_text(encoding="utf-8")
    path = tmp_path / "hertz.toml"
    path.write_text(text, encoding="utf-8")
    call = [sys.executable, "-m", "fretting", "--json", "sensitivity", str(path), "--of", "max_pressure"]
    told = json.loads(subprocess.run(call, capture_output=True, text=True, check=True, timeout=600).stdout)
    of = told["of"]["max_pressure"]
    found = fretting.gradient(path, of="max_pressure")["max_pressure"]
    assert {"value": of["value"], **of["derivatives"]} == found
    # Hertz: the powers 1/3 of the force and -2/3 of the radius, within the error of the grid.
    assert of["logarithmic_derivatives"]["load[0].normal_force"] == pytest.approx(1 / 3, abs=2e-3)
    assert of["logarithmic_derivatives"]["profile.sphere.radius"] == pytest.approx(-2 / 3, abs=2e-3)


def test_weights_of_results_are_pulled_back_to_the_numbers() -> None:
    of, by = ["max_pressure", "cycles[0].dissipated_energy", "increments[5].shift_x"], [*MODULI, *FORCES]
    matrix = fretting.gradient(CASE, of=of, by=by)
    weights = dict(zip(of, [1e-9, 2e3, -5e5], strict=True))
    pulled = fretting.vjp(CASE, weights, by=by)
    assert list(pulled) == by
    for path in by:
        parts = [weight * matrix[name][path] for name, weight in weights.items()]
        # Each is solved to a tenth of the tolerance of the case, 1e-11.
        assert pulled[path] == pytest.approx(sum(parts), abs=1e-8 * max(map(abs, parts)))
    assert fretting.run(CASE).vjp(weights, by=by) == pulled
    with pytest.raises(ValueError, match="of no result"):
        fretting.vjp(CASE, {})
    with pytest.raises(ValueError, match="must be finite"):
        fretting.vjp(CASE, {"max_pressure": math.nan})


def test_a_function_of_numbers_says_which_numbers_it_does_not_know() -> None:
    for by, words in (
        ("friction", "no number of the case as it is written"),
        ("lower.coatings[7].young", "no number of the case as it is written"),
        (["profile.sphere.radius", "profile.sphere.radius"], "named twice"),
    ):
        with pytest.raises(ValueError, match=words):
            Results(CASE, "max_pressure", by, None)
    with pytest.raises(ValueError, match="expected 1"):
        Results(CASE, "max_pressure", "profile.sphere.radius", None).values(np.array([1.0, 2.0]))


def test_a_function_of_numbers_refuses_results_without_derivatives() -> None:
    by = "profile.sphere.radius"
    for of, words in (
        ("contact_area", "two runs"),
        ("pressure", "max_pressure"),
        ("cycles[0].stick_area", "dissipated"),
    ):
        with pytest.raises(ValueError, match=words):
            Results(CASE, of, by, None)
    for case, of, words in (
        (CASE, "increments[40].shift_x", "has 12 increments"),
        (CASE, "cycles[1].dissipated_energy", "has 1 cycles"),
        ({**CASE, "hardness": 3e9}, "max_pressure", "hardness"),
    ):
        function = Results(case, of, by, None)
        for answer in (function.values, function.differentiated):
            with pytest.raises(ValueError, match=words):
                answer(np.array([10e-3]))


def test_weights_of_fields_are_pulled_back() -> None:
    # The sum of the tractions times the area of a cell is the force: its derivative by itself is one, by all else none.
    by = [*FORCES, "lower.coatings[0].thickness"]
    area = np.full((32, 32), (320e-6 / 32) ** 2)
    found = fretting.vjp(CASE, {"pressure": 2 * area, "increments[5].shear_x": area, "normal_force": 0.5}, by=by)
    assert [found[path] for path in FORCES] == pytest.approx([2.5, 1.0], abs=1e-9)
    assert found[by[2]] * 20e-6 == pytest.approx(0.0, abs=1e-8)
    # a mask weighs what it shows by one
    shown = fretting.vjp(CASE, {"pressure": area > 0.0}, by=by)
    assert shown == pytest.approx(fretting.vjp(CASE, {"pressure": np.ones((32, 32))}, by=by), rel=1e-12)
    for weights, words in (
        ({"gap": area}, "pressure, shear_x, shear_y"),
        ({"pressure": area[:5]}, "5 x 32 weights"),
        ({"pressure": np.ones((2, 2, 2))}, "shape of a field"),
        ({"pressure": area * math.nan}, "finite"),
    ):
        with pytest.raises(ValueError, match=words):
            fretting.vjp(CASE, weights, by=by)


def test_a_history_that_started_from_another_is_not_pulled_back() -> None:
    first = fretting.run({**CASE, "load": CASE["load"][:1]})
    rub = {"normal_force": 12.0, "tangential_force": [1.5, 0.0], "increments": 4}
    second = fretting.run({**CASE, "load": [rub]}, start=first)
    # The case alone, from bodies apart, lets both forces grow together and dissipates less.
    with pytest.raises(ValueError, match="started from another one"):
        second.vjp({"dissipated_energy": 1.0})


# A function of the numbers whose derivative the chain rule gives from those of the results. Numbers that went through a
# logarithm differ in their last digit, and runs of those by a tenth of the tolerance of the case, 1e-10.
CHAIN_OF = ["max_pressure", "approach"]
CHAIN_BY = ["lower.coatings[0].young", "profile.sphere.radius"]


def expected_chain() -> tuple[float, list[float]]:
    found = fretting.gradient(CASE, of=CHAIN_OF, by=CHAIN_BY)
    pressure, approach = (found[name] for name in CHAIN_OF)
    values = {"lower.coatings[0].young": 400e9, "profile.sphere.radius": 10e-3}
    # f = (p / 1e9)^2 + 1e6 approach, by the logarithms of the numbers.
    by = [(2e-18 * pressure["value"] * pressure[path] + 1e6 * approach[path]) * value for path, value in values.items()]
    return (pressure["value"] / 1e9) ** 2 + 1e6 * approach["value"], by


def test_jax_differentiates_through_a_history() -> None:
    jax = pytest.importorskip("jax")
    from fretting.jax import results

    function = results(CASE, of=CHAIN_OF, by=CHAIN_BY)

    def loss(logarithms: Any) -> Any:
        pressure, approach = function(jax.numpy.exp(logarithms))
        return (pressure / 1e9) ** 2 + 1e6 * approach

    with jax.enable_x64(True):
        at = jax.numpy.log(jax.numpy.array([400e9, 10e-3]))
        value, by = jax.jit(jax.value_and_grad(loss))(at)
        expected, expected_by = expected_chain()
        assert float(value) == pytest.approx(expected, rel=1e-9)
        assert float(loss(at)) == pytest.approx(expected, rel=1e-9)
        assert [float(part) for part in by] == pytest.approx(expected_by, rel=1e-7)


def test_torch_differentiates_through_a_history() -> None:
    torch = pytest.importorskip("torch")
    from fretting.torch import results

    function = results(CASE, of=CHAIN_OF, by=CHAIN_BY)
    logarithms = torch.tensor([400e9, 10e-3], dtype=torch.float64).log().requires_grad_()
    pressure, approach = function(logarithms.exp())
    loss = (pressure / 1e9) ** 2 + 1e6 * approach
    loss.backward()
    expected, expected_by = expected_chain()
    assert loss.item() == pytest.approx(expected, rel=1e-9)
    assert logarithms.grad.tolist() == pytest.approx(expected_by, rel=1e-7)
    assert function(logarithms.detach().exp())[0].item() == pytest.approx(pressure.item(), rel=1e-9)

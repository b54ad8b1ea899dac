"""Uncertainty of first order, against closed forms and against samples."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting

pytest.importorskip("xarray")

HERTZ: dict[str, Any] = {
    "grid": {"cells": [64, 64], "size": [400e-6, 400e-6]},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    "profile": {"sphere": {"radius": 10e-3}},
    "load": [{"normal_force": 10.0, "increments": 1}],
}
POWERS = {"lower.substrate.young": 2 / 3, "load[0].normal_force": 1 / 3, "profile.sphere.radius": -2 / 3}
MEANS = {"lower.substrate.young": 210e9, "load[0].normal_force": 10.0, "profile.sphere.radius": 10e-3}
SCATTER = {"lower.substrate.young": 0.05, "load[0].normal_force": 0.08, "profile.sphere.radius": 0.03}


def test_hertz_scatters_by_its_powers() -> None:
    # p_0 = (6 P E*^2/(pi^3 R^2))^(1/3). On 64 x 64 cells the powers are within 0.5 %.
    root3 = math.sqrt(3.0)
    distributions = {
        # Uniform between 1 -+ sqrt(3) times the deviation.
        "lower.substrate.young": fretting.Uniform(210e9 * (1 - 0.05 * root3), 210e9 * (1 + 0.05 * root3)),
        "load[0].normal_force": fretting.Normal(10.0, 0.8),
        "profile.sphere.radius": fretting.Lognormal(10e-3, 0.3e-3),
    }
    found = fretting.first_order(HERTZ, distributions, of="max_pressure")
    mean, deviation = found["max_pressure"].values
    parts = [(POWERS[key] * SCATTER[key]) ** 2 for key in distributions]
    assert deviation / mean == pytest.approx(math.sqrt(sum(parts)), rel=0.005)
    fractions = found["max_pressure_fraction"]
    assert list(fractions["uncertain"].values) == list(distributions)
    assert fractions.values == pytest.approx(np.array(parts) / sum(parts), abs=0.005)
    assert fractions.values.sum() == pytest.approx(1.0, rel=1e-12)
    assert mean == fretting.run(HERTZ).increments["max_pressure"][-1]


def test_lognormal_inputs_have_the_closed_form() -> None:
    # A product of powers of lognormal numbers is lognormal: its relative deviation is sqrt(exp(sum n^2 ln(1 + c^2))
    # - 1), which first order meets to the fourth power of c, 0.1 % of it here; the rest is the grid's, as above.
    given = {key: fretting.Lognormal(MEANS[key], SCATTER[key] * MEANS[key]) for key in POWERS}
    found = fretting.first_order(HERTZ, given, of="max_pressure")["max_pressure"].values
    exponent = sum(POWERS[key] ** 2 * math.log1p(SCATTER[key] ** 2) for key in POWERS)
    assert found[1] / found[0] == pytest.approx(math.sqrt(math.expm1(exponent)), rel=0.006)


RUBBED: dict[str, Any] = {
    "grid": {"cells": [32, 32], "size": [320e-6, 320e-6]},
    "upper": {"rigid": True},
    "lower": {
        "coatings": [{"thickness": 20e-6, "young": 400e9, "poisson": 0.2}],
        "substrate": {"young": 210e9, "poisson": 0.3},
    },
    "profile": {"sphere": {"radius": 10e-3}},
    "friction": {"coefficient": 0.3},
    "load": [
        {"name": "press", "normal_force": 12.0, "increments": 4},
        {"name": "rub", "tangential_force": [2.5, 0.0], "cycles": 1, "increments": 8},
    ],
}


def test_samples_say_the_same_where_a_result_is_nearly_linear() -> None:
    given = {
        "lower.coatings.0.thickness": fretting.Uniform(15e-6, 25e-6),
        "lower.coatings.0.young": fretting.Normal(400e9, 30e9),
        "load.press.normal_force": fretting.Normal(12.0, 0.5),
    }
    told = fretting.first_order(RUBBED, given, of=["max_pressure", "approach"])
    sampled = fretting.uncertainty(fretting.sweep(RUBBED, given, samples=64, seed=3))
    for name in ("max_pressure", "approach"):
        mean, deviation = told[name].values
        by_samples = [float(sampled[name].sel(statistic=what)) for what in ("mean", "deviation")]
        assert mean == pytest.approx(by_samples[0], rel=0.01)
        # 64 Sobol' points find a deviation within some per cent; the second order of a scatter of 15 % is 2 % of it.
        assert deviation == pytest.approx(by_samples[1], rel=0.06)


def test_what_bends_is_not_in_the_first_order() -> None:
    # The dissipated energy falls steeply with friction, and bends: sliding begins at mu = 0.21, three deviations away.
    given = {"friction.coefficient": fretting.Normal(0.3, 0.03)}
    told = fretting.first_order(RUBBED, given, of="cycles[0].dissipated_energy")["cycles[0].dissipated_energy"].values
    sampled = fretting.uncertainty(fretting.sweep(RUBBED, given, samples=32, seed=3))["cycle_dissipated_energy"]
    mean, deviation = (float(sampled.sel(statistic=what).squeeze()) for what in ("mean", "deviation"))
    # The curve is convex: the mean is above the result at the mean, the deviation above the tangent's, but not by much.
    assert told[0] < mean < 1.05 * told[0]
    assert 1.05 * told[1] < deviation < 1.5 * told[1]


@pytest.mark.parametrize(
    ("distributions", "of", "words"),
    [
        ({}, "max_pressure", "at least one"),
        ({"load[0].normal_force": fretting.Normal(10.0, 1.0)}, [], "at least one"),
        ({"load[0].normal_force": fretting.Normal(10.0, 1.0)}, "contact_area", "two runs"),
        ({"grid.size[0]": fretting.Normal(4e-4, 1e-6)}, "max_pressure", "paths are those of the case"),
    ],
)
def test_what_has_no_first_order_is_refused(distributions: dict[str, Any], of: str, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        fretting.first_order(HERTZ, distributions, of=of)


def test_debris_that_gives_has_no_first_order() -> None:
    given = {"load[0].normal_force": fretting.Normal(10.0, 1.0)}
    with pytest.raises(ValueError, match=r"wear\.debris\.stiffness"):
        fretting.first_order(
            {**RUBBED, "wear": {"coefficient": 1e-13, "debris": {"fraction": 0.5, "stiffness": 1e14}}},
            given,
            of="max_pressure",
        )


def in_a_folder(folder: Path) -> Path:
    """Write a case that names a file beside it, and a stage with a hyphen in its name."""
    rows = (np.arange(24) - 11.5) * 10e-6
    np.savetxt(folder / "ball.txt", (rows[:, None] ** 2 + rows[None, :] ** 2) / 20e-3)
    path = folder / "case.toml"
    path.write_text(
        "grid = { cells = [24, 24], size = [240e-6, 240e-6] }\nupper.rigid = true\n"
        "lower.substrate = { young = 210e9, poisson = 0.3 }\n"
        "profile.heights = { file = 'ball.txt', of = 'gap' }\n"
        "[[load]]\nname = 'press-1'\nnormal_force = 4.0\nincrements = 1\n"
    )
    return path


def test_a_case_file_keeps_its_folder_and_stages_their_names(tmp_path: Path) -> None:
    """From another folder, by the name of the stage as by its number; what the gradient of the file says."""
    path = in_a_folder(tmp_path)
    assert Path.cwd().resolve() != tmp_path.resolve()
    slope = fretting.gradient(path, of="max_pressure", by="load[0].normal_force")["max_pressure"]
    for key in ("load[0].normal_force", "load.0.normal_force", "load.press-1.normal_force"):
        found = fretting.first_order(path, {key: fretting.Normal(4.0, 0.1)}, of="max_pressure")
        mean, deviation = found["max_pressure"].values
        assert mean == slope["value"]
        assert deviation == pytest.approx(0.1 * slope["load[0].normal_force"], rel=1e-12)


def test_a_design_of_a_case_file_keeps_its_folder_and_stages_their_names(tmp_path: Path) -> None:
    """The pressure grows with the load: the largest is that of the largest load, 6^(1/3) of that under 1 N by Hertz."""
    pytest.importorskip("scipy")
    key = "load.press-1.normal_force"
    found = fretting.design(in_a_folder(tmp_path), by={key: (1.0, 6.0)}, maximize="max_pressure")
    assert found.numbers[key] == pytest.approx(6.0, rel=1e-4)
    modulus = 210e9 / (1.0 - 0.09)
    pressure = (6.0 * 6.0 * modulus**2 / (math.pi**3 * 10e-3**2)) ** (1 / 3)
    # on cells of an eighth of the contact radius
    assert found.results["max_pressure"] == pytest.approx(pressure, rel=0.02)

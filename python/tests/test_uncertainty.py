"""Sweeps with distributions, against closed forms."""

import re
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import fretting

pytest.importorskip("xarray")


def hertz_case() -> dict[str, Any]:
    return {
        "grid": {"cells": [16, 16], "size": "auto"},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
        "profile": {"sphere": {"radius": 10e-3}},
        "load": [{"name": "press", "normal_force": 10.0, "increments": 1}],
    }


def test_power_laws_of_uncertain_numbers_have_their_moments_and_indices() -> None:
    # Hertz: p0 ~ P^(1/3) E^(2/3); of lognormal numbers the logarithms add, var ln p0 = s_P^2/9 + 4 s_E^2/9. An
    # automatic grid keeps the contact the same in cells, so that the power law is exact on it.
    parameters = {
        "load.press.normal_force": fretting.Lognormal(10.0, 1.0),
        "lower.substrate.young": fretting.Lognormal(210e9, 10.5e9),
    }
    with ThreadPoolExecutor(2) as executor:
        answer = fretting.sweep(hertz_case(), parameters, samples=128, seed=4, indices=True, executor=executor)
    assert answer["max_pressure"].sizes == {"sample": 512}
    told = fretting.uncertainty(answer)
    square_p, square_e = np.log1p(0.1**2) / 9, 4 * np.log1p(0.05**2) / 9
    both = square_p + square_e
    middle = told["max_pressure_quantile"].sel(quantile=0.5)
    high = told["max_pressure_quantile"].sel(quantile=0.975)
    # of 256 samples
    assert abs(float(np.log(high / middle)) / (1.96 * np.sqrt(both)) - 1.0) < 0.06
    spread = told["max_pressure"].sel(statistic="deviation") / told["max_pressure"].sel(statistic="mean")
    assert abs(float(spread) / np.sqrt(np.expm1(both)) - 1.0) < 0.02
    # nearly a sum of two normal numbers: indices are the fractions of its variance
    first = told["max_pressure_first"].sel(uncertain="load.press.normal_force")
    total = told["max_pressure_total"].sel(uncertain="lower.substrate.young")
    assert abs(float(first) - square_p / both) < 0.03
    assert abs(float(total) - square_e / both) < 0.03
    again = fretting.sweep(hertz_case(), parameters, samples=128, seed=4, indices=True, threads=1)
    assert again["max_pressure"].identical(answer["max_pressure"])


def test_energy_of_mindlin_and_deresiewicz_with_uncertain_friction(fretting_case: dict[str, Any]) -> None:
    fretting_case["output"] = {"fields": ["pressure"]}
    fretting_case["load"][1]["cycles"] = 2  # the first begins untouched
    fretting_case["grid"] = {"cells": [32, 32], "size": [300e-6, 300e-6]}
    parameters = {"friction.coefficient": fretting.Uniform(0.2, 0.4)}
    answer = fretting.sweep(fretting_case, parameters, samples=32, seed=1, keep="all")
    found = answer["cycle_dissipated_energy"].values
    friction = answer["friction.coefficient"].values
    # mean and variance over the distribution, in closed form: W = A mu^2 f(Q/(mu P)), integrated by Gauss points
    points, weights = np.polynomial.legendre.leggauss(40)
    exact = np.array([closed_form(0.3 + 0.1 * point) for point in points])
    mean = 0.5 * weights @ exact
    deviation = np.sqrt(0.5 * weights @ (exact - mean) ** 2)
    # the samples themselves: evenly spread, one in each of 32 parts
    sampled = np.array([closed_form(value) for value in friction])
    assert abs(sampled.mean() / mean - 1.0) < 1e-2
    assert abs(sampled.std(ddof=1) / deviation - 1.0) < 3e-2
    # the runs: what 32 cells and 16 increments leave
    told = fretting.uncertainty(answer)["cycle_dissipated_energy"]
    assert abs(float(told.sel(statistic="mean")) / mean - 1.0) < 0.05
    assert abs(float(told.sel(statistic="deviation")) / deviation - 1.0) < 0.08
    assert np.isfinite(found).all()
    pytest.importorskip("matplotlib")
    axes = fretting.plot.loop_band(answer)
    assert len(axes.collections) >= 3  # branches: there, back, there
    assert fretting.plot.band(answer, "dissipated_energy").lines


def test_maps_of_samples_show_their_middle_and_how_far_they_lie_apart() -> None:
    pytest.importorskip("matplotlib")
    import matplotlib.pyplot as plt

    axes = {"load.press.normal_force": [5.0, 10.0, 20.0], "profile.sphere.radius": [5e-3, 10e-3]}
    answer = fretting.sweep(hertz_case(), {**axes, "lower.substrate.young": fretting.Uniform(190e9, 230e9)}, samples=8)
    left, right = fretting.plot.band_map(answer, "max_pressure", x="load.press.normal_force", y="profile.sphere.radius")
    middle, width = (np.asarray(place.collections[0].get_array()) for place in (left, right))
    assert middle.shape == width.shape == (2, 3)
    # Hertz: p0 = (6 P E*^2 / (pi^3 R^2))^(1/3); the grid is the same in cells at every point, so that ratios are exact.
    force, radius = np.array(axes["load.press.normal_force"]), np.array(axes["profile.sphere.radius"])
    law = (force[None, :] / radius[:, None] ** 2) ** (1 / 3)
    for found in (middle, width):
        assert np.allclose(found / found[0, 0], law / law[0, 0], rtol=1e-6)
    # p0 ~ E^(2/3): between the second and the last but one of the samples in order, quantiles by linear interpolation
    young = np.sort(answer["lower.substrate.young"].values) ** (2 / 3)
    low, high = np.quantile(young, (0.025, 0.975))
    assert np.allclose(width / middle, (high - low) / np.median(young), rtol=1e-6)
    plt.close("all")
    # Sliding conditions: with so much scatter of the friction some samples of the middle force slide.
    case = hertz_case()
    case |= {"friction": {"coefficient": 0.3}}
    case["load"].append({"name": "rub", "shift": [0.2e-6, 0.0], "increments": 8, "cycles": 1})
    sweep: dict[str, Any] = {
        "friction.coefficient": fretting.Uniform(0.1, 0.9),
        "load.press.normal_force": [2.0, 20.0],
        "load.rub.shift.0": [0.05e-6, 0.2e-6, 0.8e-6],
    }
    answer = fretting.sweep(case, sweep, samples=8)
    pair = plt.subplots(1, 2)[1]
    left, right = fretting.plot.band_map(
        answer, "cycle_regime", x="load.rub.shift.0", y="load.press.normal_force", axes=tuple(pair)
    )
    regimes = answer["cycle_regime"].transpose("sample", "load.press.normal_force", "load.rub.shift.0").values
    share = np.asarray(right.collections[0].get_array())
    counted = [
        [max((regimes[:, i, j] == word).mean() for word in set(regimes[:, i, j])) for j in range(3)] for i in range(2)
    ]
    assert np.allclose(share, counted) and share.min() < 1.0 == share.max()
    assert left is pair[0] and right is pair[1]
    with pytest.raises(ValueError, match="beside the samples"):
        fretting.plot.band_map(answer, "cycle_regime", x="load.rub.shift.0", y="friction.coefficient")
    plt.close("all")


def closed_form(friction: float) -> float:
    """Mindlin & Deresiewicz (1953), J. Appl. Mech. 20, 327: energy of a cycle, identical spheres with nu = 0, E = 200
    GPa.
    """
    force, amplitude, modulus, shear = 20.0, 2.4, 200e9, 100e9
    radius = (3 * force * 10e-3 / (4 * modulus / 2)) ** (1 / 3)
    part = amplitude / (friction * force)
    brackets = 1 - (1 - part) ** (5 / 3) - 5 / 6 * part * (1 + (1 - part) ** (2 / 3))
    return float(9 * friction**2 * force**2 * (2 / shear + 2 / shear) / (10 * radius) * brackets)


def test_mistakes_are_told() -> None:
    uncertain = {"load.press.normal_force": fretting.Normal(10.0, 0.1)}
    with pytest.raises(ValueError, match="samples="):
        fretting.sweep(hertz_case(), uncertain)
    with pytest.raises(ValueError, match="no parameter has a distribution"):
        fretting.sweep(hertz_case(), {"load.press.normal_force": [1.0]}, samples=4)
    with pytest.raises(ValueError, match="between 2 and"):
        fretting.sweep(hertz_case(), uncertain, samples=1)
    grid = fretting.sweep(hertz_case(), {"load.press.normal_force": [5.0, 10.0]})
    with pytest.raises(ValueError, match="no samples"):
        fretting.uncertainty(grid)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: fretting.Normal(float("nan"), 1.0), "mean = nan: must be finite"),
        (lambda: fretting.Normal(1.0, 0.0), "deviation = 0.0: must be positive"),
        (lambda: fretting.Lognormal(-1.0, 0.1), "mean = -1.0: must be positive"),
        (lambda: fretting.Lognormal(1.0, -0.1), "deviation = -0.1: must be positive"),
        (lambda: fretting.Uniform(0.3, 0.2), "low = 0.3, high = 0.2: low must lie below high"),
        (lambda: fretting.Uniform(0.3, float("inf")), "high = inf: must be finite"),
        (lambda: fretting.Triangular(0.1, 0.4, 0.3), "low = 0.1, mode = 0.4, high = 0.3: low must lie below high"),
        (lambda: fretting.Triangular(0.1, 0.1, 0.1), "low = 0.1, mode = 0.1, high = 0.1: low must lie below high"),
        (lambda: fretting.Weibull(0.0, 1.0), "shape = 0.0: must be positive"),
        (lambda: fretting.Weibull(2.0, -1.0), "scale = -1.0: must be positive"),
    ],
)
def test_a_distribution_is_refused_where_it_is_made_by_the_name_of_its_argument(
    make: Callable[[], fretting.Distribution], words: str
) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(words)}"):
        make()


def test_what_is_no_distribution_is_refused() -> None:
    with pytest.raises(TypeError, match=r"^deviation = 'x': must be a real number"):
        fretting.Normal(1.0, "x")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"^Distribution: the base of .* Uniform, Normal"):
        fretting.Distribution()
    # What may be, stays: whole numbers are numbers, the likeliest value may be the least one.
    assert isinstance(fretting.Normal(1, 1).mean, float)
    assert fretting.Triangular(0.0, 0.0, 1.0).mode == 0.0

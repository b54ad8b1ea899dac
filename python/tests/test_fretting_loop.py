"""Partial slip of like bodies without contraction: Cattaneo (1938), Mindlin (1949), Mindlin & Deresiewicz (1953)."""

import numpy as np
import pytest
from numpy.typing import NDArray

import fretting

YOUNG, RADIUS, FRICTION, FORCE, AMPLITUDE = 200e9, 10e-3, 0.2, 20.0, 2.4
NORMAL_MODULUS = YOUNG / 2.0  # two bodies, nu = 0
SHEAR_MODULUS = (YOUNG / 2.0) / 4.0  # 1/G* = 2 (2 - nu)/G, G = E/2
A = (0.75 * FORCE * RADIUS / NORMAL_MODULUS) ** (1.0 / 3.0)
PEAK = 1.5 * FORCE / (np.pi * A**2)


def stick_radius(share: float) -> float:
    return float(A * (1.0 - share) ** (1.0 / 3.0))


def shift(share: float) -> float:
    """Shift under the share T/(mu P) of the sliding force, on first loading."""
    return float(3.0 * FRICTION * FORCE / (16.0 * A * SHEAR_MODULUS) * (1.0 - (1.0 - share) ** (2.0 / 3.0)))


def disc(r: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    """Hertz's pressure of a smaller disc at the same curvature, over p0."""
    return np.asarray(np.sqrt(np.maximum(radius**2 - r**2, 0.0)) / A)


@pytest.fixture(scope="module")
def history() -> fretting.History:
    material = {"young": YOUNG, "poisson": 0.0}
    return fretting.run(
        {
            "grid": {"cells": [64, 64], "size": [2.6 * A, 2.6 * A]},
            "upper": {"substrate": material},
            "lower": {"substrate": material},
            "profile": {"sphere": {"radius": RADIUS}},
            "friction": {"coefficient": FRICTION},
            "load": [
                {"name": "indent", "normal_force": FORCE, "increments": 1},
                {"name": "fretting", "tangential_force": [AMPLITUDE, 0.0], "cycles": 2, "increments": 16},
            ],
            "output": {"every": 1},
        }
    )


def test_first_peak_is_cattaneo_mindlin(history: fretting.History) -> None:
    peak = 4  # a quarter of the first cycle after the indentation
    share = AMPLITUDE / (FRICTION * FORCE)
    assert history.increments["tangential_force_x"][peak] == pytest.approx(AMPLITUDE, rel=1e-8)
    assert history.increments["regime"][peak] == "partial_slip"
    # 25 cells a radius: integral values to (dx/a)^2 = 2e-3, the circle of slip to about half a cell.
    assert history.increments["shift_x"][peak] == pytest.approx(shift(share), rel=1e-3)
    c = stick_radius(share)
    dx = history.x[1] - history.x[0]
    assert np.sqrt(history.increments["stick_area"][peak] / np.pi) == pytest.approx(c, abs=0.5 * dx)
    r = np.hypot(history.x[:, None], history.y[None, :])
    expected = FRICTION * PEAK * (disc(r, A) - disc(r, c))
    away = (np.abs(r - A) > 1.5 * dx) & (np.abs(r - c) > 1.5 * dx)
    assert np.abs(history.field("shear_x", peak) - expected)[away].max() < 0.005 * FRICTION * PEAK
    assert np.abs(history.field("shear_y", peak)).max() < 1e-3 * FRICTION * PEAK


def test_unloaded_contact_keeps_the_shear_of_mindlin_and_deresiewicz(history: fretting.History) -> None:
    zero = 8
    share = AMPLITUDE / (FRICTION * FORCE)
    assert abs(history.increments["tangential_force_x"][zero]) < 1e-8 * AMPLITUDE
    expected_shift = shift(share) - 2.0 * shift(share / 2.0)
    assert history.increments["shift_x"][zero] == pytest.approx(expected_shift, rel=2e-3)
    r = np.hypot(history.x[:, None], history.y[None, :])
    c, half = stick_radius(share), stick_radius(share / 2.0)
    expected = -FRICTION * PEAK * (disc(r, A) - 2.0 * disc(r, half) + disc(r, c))
    dx = history.x[1] - history.x[0]
    away = (np.abs(r - A) > 1.5 * dx) & (np.abs(r - c) > 1.5 * dx) & (np.abs(r - half) > 1.5 * dx)
    assert np.abs(history.field("shear_x", zero) - expected)[away].max() < 0.01 * FRICTION * PEAK


def test_second_cycle_closes_and_its_area_is_the_dissipated_energy(history: fretting.History) -> None:
    force, moved = history.increments["tangential_force_x"], history.increments["shift_x"]
    energy = history.increments["dissipated_energy"]
    assert (np.diff(energy) >= -1e-12 * energy[-1]).all()
    second = slice(16, 33)
    assert moved[32] == pytest.approx(moved[16], rel=1e-6)
    lost = energy[32] - energy[16]
    # Closed loop between reversals at peaks; Mindlin & Deresiewicz (1953).
    loop = fretting.analytic.mindlin_deresiewicz(
        fretting.analytic.hertz(radius=RADIUS, force=FORCE, modulus=NORMAL_MODULUS),
        friction_coefficient=FRICTION,
        shear_modulus=SHEAR_MODULUS,
        amplitude=AMPLITUDE,
    )
    assert lost == pytest.approx(loop.dissipated_energy_per_cycle, rel=2e-3)
    # Sixteen chords inscribed in the two branches cut off about 2 % of the area.
    area = np.sum(0.5 * (force[second][1:] + force[second][:-1]) * np.diff(moved[second]))
    assert area == pytest.approx(loop.dissipated_energy_per_cycle, rel=0.03)


def test_closed_forms_of_the_library_are_those_written_here() -> None:
    share = AMPLITUDE / (FRICTION * FORCE)
    moduli = fretting.analytic.effective_moduli(
        lower={"young": YOUNG, "poisson": 0.0}, upper={"young": YOUNG, "poisson": 0.0}
    )
    assert moduli.normal == pytest.approx(NORMAL_MODULUS)
    assert moduli.shear == pytest.approx(SHEAR_MODULUS)
    assert moduli.coupling == 0.0
    sphere = fretting.analytic.hertz(radius=RADIUS, force=FORCE, modulus=NORMAL_MODULUS)
    contact = fretting.analytic.cattaneo_mindlin(
        sphere, friction_coefficient=FRICTION, shear_modulus=SHEAR_MODULUS, tangential_force=AMPLITUDE
    )
    assert contact.stick_radius == pytest.approx(stick_radius(share), rel=1e-13)
    assert contact.shift == pytest.approx(shift(share), rel=1e-13)
    r = np.linspace(0.0, 1.2 * A, 41)
    expected = FRICTION * PEAK * (disc(r, A) - disc(r, stick_radius(share)))
    np.testing.assert_allclose(contact.shear(r), expected, atol=1e-12 * FRICTION * PEAK)
    loop = fretting.analytic.mindlin_deresiewicz(
        sphere, friction_coefficient=FRICTION, shear_modulus=SHEAR_MODULUS, amplitude=AMPLITUDE
    )
    back = loop.at("unloading", 0.0)
    assert back.shift == pytest.approx(shift(share) - 2.0 * shift(share / 2.0), rel=1e-12)
    assert loop.at("loading", AMPLITUDE).shift == pytest.approx(loop.peak.shift, rel=1e-14)
    forces = np.linspace(-AMPLITUDE, AMPLITUDE, 4001)
    up = np.array([loop.at("reloading", force).shift for force in forces])
    down = np.array([loop.at("unloading", force).shift for force in forces])
    area = np.sum(0.5 * ((down - up)[1:] + (down - up)[:-1]) * np.diff(forces))
    assert area == pytest.approx(loop.dissipated_energy_per_cycle, rel=1e-6)
    with pytest.raises(ValueError, match="friction holds at most"):
        fretting.analytic.cattaneo_mindlin(
            sphere, friction_coefficient=FRICTION, shear_modulus=SHEAR_MODULUS, tangential_force=1.01 * FRICTION * FORCE
        )

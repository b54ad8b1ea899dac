"""A sphere on a half-space: Hertz (1881)."""

from typing import Any

import numpy as np
import pytest

import fretting


def test_pressure_radius_and_approach_are_hertz(sphere_case: dict[str, Any]) -> None:
    force, radius, modulus = 12.0, 10e-3, 210e9 / (1.0 - 0.3**2)
    a = (0.75 * force * radius / modulus) ** (1.0 / 3.0)
    peak = 1.5 * force / (np.pi * a**2)
    sphere_case["output"] = {"fields": ["pressure", "gap", "zone"]}
    history = fretting.run(sphere_case)
    steps = history.increments
    dx = history.x[1] - history.x[0]

    assert steps["normal_force"][-1] == pytest.approx(force, rel=1e-8)
    assert steps["residual"][-1] <= 1e-8
    # 15 cells a radius: integral values err by about (dx/a)^2 / 10 = 5e-4. The nearest cell's middle lies dx/sqrt(2)
    # from the peak, where the pressure is lower by (dx/a)^2 / 4 = 1.2e-3.
    assert steps["approach"][-1] == pytest.approx(a**2 / radius, rel=5e-4)
    assert steps["max_pressure"][-1] == pytest.approx(peak, rel=2e-3)
    assert np.sqrt(steps["contact_area"][-1] / np.pi) == pytest.approx(a, abs=0.1 * dx)  # from the zero line of p

    pressure = history.field("pressure")
    r = np.hypot(history.x[:, None], history.y[None, :])
    expected = peak * np.sqrt(np.maximum(1.0 - (r / a) ** 2, 0.0))
    inside = r < a - 1.5 * dx
    assert np.abs(pressure - expected)[inside].max() < 0.005 * peak
    assert (pressure[r > a + dx] == 0.0).all()
    assert pressure.sum() * dx**2 == pytest.approx(force, rel=1e-8)
    np.testing.assert_array_equal(history.field("zone") > 0, pressure > 0.0)
    gap = history.field("gap")
    assert np.abs(gap[pressure > 0.0]).max() < 1e-6 * steps["approach"][-1]
    assert gap.min() > -1e-6 * steps["approach"][-1]


def test_prescribed_approach_gives_hertz_force(sphere_case: dict[str, Any]) -> None:
    modulus, radius, approach = 210e9 / (1.0 - 0.3**2), 10e-3, 0.5e-6
    sphere_case["load"] = [{"approach": approach, "increments": 1}]
    history = fretting.run(sphere_case, threads=1)
    a = np.sqrt(approach * radius)
    assert history.increments["approach"][-1] == approach
    assert history.increments["normal_force"][-1] == pytest.approx(4.0 * modulus * a**3 / (3.0 * radius), rel=1e-3)


def test_any_number_of_threads_gives_the_same_bits(sphere_case: dict[str, Any]) -> None:
    one, two = (fretting.run(sphere_case, threads=threads).field("pressure") for threads in (1, 2))
    np.testing.assert_array_equal(one, two)


def test_closed_forms_of_the_library_are_hertz() -> None:
    moduli = fretting.analytic.effective_moduli(lower={"young": 210e9, "poisson": 0.3})
    assert moduli.normal == pytest.approx(210e9 / 0.91, rel=1e-14)
    sphere = fretting.analytic.hertz(radius=10e-3, force=12.0, modulus=moduli.normal)
    a = (0.75 * 12.0 * 10e-3 / moduli.normal) ** (1.0 / 3.0)
    assert sphere.contact_radius == pytest.approx(a, rel=1e-14)
    assert sphere.approach == pytest.approx(a**2 / 10e-3, rel=1e-14)
    r = np.array([[0.0, 0.5 * a], [a, 2.0 * a]])
    np.testing.assert_allclose(sphere.pressure(r), sphere.max_pressure * np.array([[1.0, 0.75**0.5], [0, 0]]))
    ellipse = fretting.analytic.hertz_ellipse(radius_x=10e-3, radius_y=10e-3, force=12.0, modulus=moduli.normal)
    assert ellipse.semi_axes == pytest.approx((a, a), rel=1e-12)
    with pytest.raises(ValueError, match="force = -1"):
        fretting.analytic.hertz(radius=10e-3, force=-1.0, modulus=moduli.normal)

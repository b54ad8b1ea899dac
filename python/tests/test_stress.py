"""Stresses under the surface, against Hertz."""

import pickle
from typing import Any

import numpy as np
import pytest

import fretting


def test_axis_under_a_sphere_follows_hertz(sphere_case: dict[str, Any]) -> None:
    history = fretting.run(sphere_case)
    modulus = 210e9 / (1 - 0.3**2)
    radius = (3 * 12.0 * 10e-3 / (4 * modulus)) ** (1 / 3)
    peak = 1.5 * 12.0 / (np.pi * radius**2)
    depths = radius * np.array([0.25, 0.48, 1.0, 2.0])
    stress = fretting.subsurface_stress(history, depths)
    s = depths / radius
    zz = -1 / (1 + s**2)
    middle = history.shape[0] // 2  # the axis passes between four cells
    found = stress["zz"][:, middle - 1 : middle + 1, middle - 1 : middle + 1].mean(axis=(1, 2)) / peak
    # 48 cells over 3.3 radii: pressure good to 1e-3, and the four cells lie 0.05 radii off the axis
    assert np.abs(found - zz).max() < 6e-3
    assert stress["von_mises"].shape == (4, 48, 48)
    assert abs(stress["von_mises"][1].max() / peak - 0.62) < 5e-3


def test_interfaces_stand_twice_and_pickled_histories_answer_alike(fretting_case: dict[str, Any]) -> None:
    fretting_case["lower"]["coatings"] = [{"thickness": 50e-6, "young": 400e9, "poisson": 0.2}]
    history = fretting.run(fretting_case)
    stress = fretting.subsurface_stress(history, [0.0, 50e-6, 100e-6], step=4)
    assert stress["layer"].tolist() == [0, 0, 1, 1]
    size = np.abs(stress["zz"]).max()
    for name in ("zz", "xz", "yz"):
        assert np.abs(stress[name][1] - stress[name][2]).max() < 1e-12 * size
    assert np.abs(stress["xx"][1] - stress["xx"][2]).max() > 1e-2 * size
    assert np.allclose(stress["zz"][0], -history.field("pressure", 4), atol=1e-12 * size)
    assert np.allclose(stress["xz"][0], -history.field("shear_x", 4), atol=1e-12 * size)
    again = fretting.subsurface_stress(pickle.loads(pickle.dumps(history)), [0.0, 50e-6, 100e-6], step=4)
    assert all(np.array_equal(again[name], values) for name, values in stress.items())
    upper = fretting.subsurface_stress(history, 0.0, step=4, body="upper")
    assert np.allclose(upper["xz"][0], history.field("shear_x", 4), atol=1e-12 * size)


def test_impossible_depths_and_bodies_are_refused(sphere_case: dict[str, Any]) -> None:
    history = fretting.run(sphere_case)
    with pytest.raises(ValueError, match="above the surface"):
        fretting.subsurface_stress(history, [-1e-6])
    with pytest.raises(ValueError, match="upper body is rigid"):
        fretting.subsurface_stress(history, [0.0], body="upper")
    with pytest.raises(ValueError, match="not finite"):
        fretting.subsurface_stress(history, [np.nan])

"""Line contacts: fields of one axis, from the run and from its folder, and the closed forms of lines and of stretched
contacts.
"""

from pathlib import Path

import numpy as np
import pytest

import fretting
from fretting import analytic

CELLS = 128
CASE = {
    "grid": {"cells": CELLS, "size": 0.05},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 1.0, "poisson": 0.3}},
    "profile": {"cylinder": {"radius": 1.0, "axis": "y"}},
    "friction": {"coefficient": 0.3},
    "load": [{"normal_force": 1e-4, "increments": 4}],
}


@pytest.fixture(scope="module")
def history() -> fretting.History:
    return fretting.run(CASE)


def test_fields_have_one_axis(history: fretting.History) -> None:
    assert history.is_line
    assert history.shape == (CELLS,)
    pressure = history.field("pressure")
    assert pressure.shape == (CELLS,)
    # force per unit length: the sum of the pressures times the width of a strip
    assert pressure.sum() * (history.x[1] - history.x[0]) == pytest.approx(1e-4, rel=1e-8)
    assert "128 cells of a line contact" in repr(history)


def test_stress_under_a_line_is_that_of_plane_strain(history: fretting.History) -> None:
    stress = history.subsurface([1e-3, 5e-3])
    assert stress["xx"].shape == (2, CELLS)
    plane_strain = 0.3 * (stress["xx"] + stress["zz"])
    assert np.abs(stress["yy"] - plane_strain).max() < 1e-12 * np.abs(stress["zz"]).max()


def test_pressed_contact_is_wider_than_hertz_by_its_friction(history: fretting.History) -> None:
    # 0.9765 of Hertz's half-width by a dense program; a cell of 128 is 2 % of the width
    moduli = analytic.effective_moduli(lower={"young": 1.0, "poisson": 0.3})
    hertz = analytic.hertz_line(radius=1.0, line_force=1e-4, modulus=moduli.normal)
    width = history.increments["contact_area"][-1]
    assert width / (2.0 * hertz.half_width) == pytest.approx(0.9765, abs=0.02)


def test_a_folder_gives_back_what_the_run_gave(tmp_path: Path) -> None:
    case = "\n".join(
        [
            "[grid]",
            "cells = 128",
            "size = 0.05",
            "[upper]",
            "rigid = true",
            "[lower]",
            "substrate = { young = 1.0, poisson = 0.3 }",
            "[profile.cylinder]",
            "radius = 1.0",
            'axis = "y"',
            "[friction]",
            "coefficient = 0.3",
            "[[load]]",
            "normal_force = 1e-4",
            "increments = 4",
        ]
    )
    (tmp_path / "line.toml").write_text(case)
    fretting._core.command_line(["fret", "run", str(tmp_path / "line.toml"), "--out", str(tmp_path / "out"), "--quiet"])
    loaded = fretting.open_results(tmp_path / "out")
    run = fretting.run(CASE)
    assert loaded.is_line
    for name in ("pressure", "shear_x", "zone"):
        assert np.array_equal(loaded.field(name), run.field(name))


def test_closed_forms_have_their_numbers() -> None:
    line = analytic.hertz_line(radius=1.0, line_force=1e-4, modulus=1.0)
    unit = 2.0 * 0.4 * line.max_pressure  # strain that moves the middle of stick by the half-width
    pushed = analytic.cattaneo_line(line, friction_coefficient=0.4, tangential_force=0.36 * 0.4e-4, strain=0.1 * unit)
    assert pushed.stick_half_width / line.half_width == pytest.approx(0.8, rel=1e-12)
    assert pushed.stick_offset / line.half_width == pytest.approx(0.1, rel=1e-12)
    assert pushed.shear(2.0 * line.half_width) == 0.0
    stretched = analytic.stretched_line(line, friction_coefficient=0.4, strain=0.25 * unit)
    assert stretched.stick_half_width / line.half_width == pytest.approx(0.766556, abs=1e-6)
    sphere = analytic.hertz(radius=1.0, force=1e-4, modulus=1.0)
    alike = analytic.equibiaxial_sphere(sphere, friction_coefficient=0.4, strain=0.945460 * 0.4 * sphere.max_pressure)
    assert alike.stick_radius / sphere.contact_radius == pytest.approx(0.5, abs=1e-6)
    offset = analytic.stretched_sphere(
        sphere, friction_coefficient=0.4, shear_modulus=0.25, tangential_force=0.2e-4, strain=1e-4
    )
    assert offset.shear([0.0, 9.0], 0.0).shape == (2,)
    sliding = analytic.sliding_cylinder(
        radius=1.0, line_force=1e-4, modulus=1.0, coupling=0.5, friction_coefficient=0.5
    )
    assert sliding.offset / sliding.half_width == pytest.approx(-0.155958, abs=1e-6)
    assert analytic.tilted_punch(radius=1.0, force=1.0, modulus=1.0, tilt=0.1).moment == pytest.approx(4.0 / 3.0 * 0.1)
    assert analytic.tilted_line_punch(half_width=1.0, line_force=1.0, modulus=1.0, tilt=0.1).moment == pytest.approx(
        np.pi / 40.0
    )
    with pytest.raises(ValueError, match="friction holds at most"):
        analytic.cattaneo_line(line, friction_coefficient=0.4, tangential_force=1e-4)

"""Line contacts: fields of one axis, from the run and from its folder, and the closed forms of lines and of stretched
contacts.
"""

from pathlib import Path
from typing import Any

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


def test_a_history_of_a_line_contact_is_that_of_a_run() -> None:
    """Another way: the program, of second order in 256 cells and in its increments."""
    line = analytic.hertz_line(radius=1.0, line_force=1e-4, modulus=1.0)
    assert line.half_width == pytest.approx(np.sqrt(4e-4 / np.pi), rel=1e-12)
    sliding = 0.4e-4
    forces = sliding * np.array([0.6, -0.3, 0.3, -0.6, 0.6])
    material = {"young": 2 * (1 - 0.3**2), "poisson": 0.3}
    case = {
        "grid": {"cells": 256, "size": 2.6 * line.half_width, "datum": 0.1},
        "upper": {"substrate": material},
        "lower": {"substrate": material},
        "profile": {"cylinder": {"radius": 1.0, "axis": "y"}},
        "friction": {"coefficient": 0.4},
        "load": [{"normal_force": 1e-4, "increments": 1}]
        + [{"tangential_force": [force, 0.0], "increments": 16} for force in forces],
    }
    run = fretting.run(case)
    ends = [16 * (number + 1) for number in range(len(forces))]
    shear_modulus = material["young"] / 2.6
    exact = analytic.line_history(
        line,
        friction_coefficient=0.4,
        tangential_forces=forces,
        shear_compliance=2 / shear_modulus,
        datum=0.1,
    )
    assert run.increments["shift_x"][ends] == pytest.approx(exact.shift, rel=1e-4)  # found: 4e-5
    assert run.increments["dissipated_energy"][ends] == pytest.approx(exact.dissipated_energy, rel=1e-3)  # found: 6e-4
    assert exact.stick_half_width[0] == pytest.approx(line.half_width * np.sqrt(0.4), rel=1e-12)
    # the loop has closed: shift and shear are those of the first push
    first = analytic.line_history(line, friction_coefficient=0.4, tangential_forces=forces[:1])
    assert first.shift is None
    places = np.linspace(-1.1, 1.1, 23) * line.half_width
    assert exact.shear(places) == pytest.approx(first.shear(places), rel=1e-12, abs=1e-20)
    pushed = analytic.cattaneo_line(line, friction_coefficient=0.4, tangential_force=forces[0])
    assert first.shear(places) == pytest.approx(pushed.shear(places), rel=1e-12, abs=1e-20)
    # along the axis the slip obeys the same law with the shear compliance
    along = analytic.line_history(
        line, friction_coefficient=0.4, tangential_forces=forces, shear_compliance=2.0, along_axis=True, datum=0.1
    )
    assert along.dissipated_energy == pytest.approx(exact.dissipated_energy, rel=1e-12)
    for words, wrong in (
        ("shear_compliance", {"datum": 1.0}),
        ("positive depth", {"datum": -1.0, "shear_compliance": 1.0}),
        ("friction holds at most", {"tangential_forces": [2 * sliding]}),
        ("dimensions", {"tangential_forces": [[0.1 * sliding]]}),
    ):
        given: dict[str, Any] = {"friction_coefficient": 0.4, "tangential_forces": forces} | wrong
        with pytest.raises(ValueError, match=words):
            analytic.line_history(line, **given)


def test_a_history_of_a_sphere_meets_its_loop() -> None:
    sphere = analytic.hertz(radius=10e-3, force=10.0, modulus=115e9)
    given = {"friction_coefficient": 0.5, "shear_modulus": 24e9}
    history = analytic.tangential_history(sphere, **given, tangential_forces=[3.0, 1.0, 2.0, -3.0, 1.5])
    loop = analytic.mindlin_deresiewicz(sphere, **given, amplitude=3.0)
    for place, point in enumerate((loop.at("loading", 3.0), loop.at("unloading", 1.0))):
        assert history.shift[place] == pytest.approx(point.shift, rel=1e-12)
        assert history.stick_radius[place] == pytest.approx(point.stick_radius, rel=1e-12)
    # the small loop is forgotten
    end = loop.at("reloading", 1.5)
    assert history.shift[4] == pytest.approx(end.shift, rel=1e-12)
    r = np.linspace(0.0, 1.2, 13) * sphere.contact_radius
    assert history.shear(r) == pytest.approx(end.shear(r), rel=1e-12, abs=1e-6)

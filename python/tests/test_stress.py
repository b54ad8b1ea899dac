"""Stresses under the surface, against Hertz."""

import json
import pickle
from typing import Any

import numpy as np
import pytest

import fretting

pytest.importorskip("xarray")


def test_axis_under_a_sphere_follows_hertz(sphere_case: dict[str, Any]) -> None:
    history = fretting.run(sphere_case)
    modulus = 210e9 / (1 - 0.3**2)
    radius = (3 * 12.0 * 10e-3 / (4 * modulus)) ** (1 / 3)
    peak = 1.5 * 12.0 / (np.pi * radius**2)
    depths = radius * np.array([0.25, 0.48, 1.0, 2.0])
    stress = history.subsurface(depths)
    s = depths / radius
    zz = -1 / (1 + s**2)
    middle = history.shape[0] // 2  # the axis passes between four cells
    found = stress["zz"].values[:, middle - 1 : middle + 1, middle - 1 : middle + 1].mean(axis=(1, 2)) / peak
    # 48 cells over 3.3 radii: pressure good to 1e-3, and the four cells lie 0.05 radii off the axis
    assert np.abs(found - zz).max() < 6e-3
    assert stress["von_mises"].shape == (4, 48, 48)
    assert abs(stress["von_mises"][1].max() / peak - 0.62) < 5e-3


def test_interfaces_stand_twice_and_pickled_histories_answer_alike(fretting_case: dict[str, Any]) -> None:
    fretting_case["lower"]["coatings"] = [{"thickness": 50e-6, "young": 400e9, "poisson": 0.2}]
    history = fretting.run(fretting_case)
    stress = history.subsurface([0.0, 50e-6, 100e-6], increment=4)
    assert stress["layer"].values.tolist() == [0, 0, 1, 1]
    size = float(np.abs(stress["zz"]).max())
    for name in ("zz", "xz", "yz"):
        assert np.abs(stress[name].values[1] - stress[name].values[2]).max() < 1e-12 * size
    assert np.abs(stress["xx"].values[1] - stress["xx"].values[2]).max() > 1e-2 * size
    assert np.allclose(stress["zz"][0], -history.field("pressure", 4).T, atol=1e-12 * size)
    assert np.allclose(stress["xz"][0], -history.field("shear_x", 4).T, atol=1e-12 * size)
    again = pickle.loads(pickle.dumps(history)).subsurface([0.0, 50e-6, 100e-6], increment=4)
    assert again.identical(stress)
    upper = history.subsurface(0.0, increment=4, body="upper")
    assert np.allclose(upper["xz"][0], history.field("shear_x", 4).T, atol=1e-12 * size)


def test_impossible_depths_and_bodies_are_refused(sphere_case: dict[str, Any]) -> None:
    history = fretting.run(sphere_case)
    with pytest.raises(ValueError, match="above the surface"):
        history.subsurface([-1e-6])
    with pytest.raises(ValueError, match="upper body is rigid"):
        history.subsurface([0.0], body="upper")
    with pytest.raises(ValueError, match="not finite"):
        history.subsurface([np.nan])


def test_principal_stresses_have_the_invariants_of_the_tensor(sphere_case: dict[str, Any]) -> None:
    stress = fretting.run(sphere_case).subsurface([0.0, 40e-6])
    first, second, third = stress["principal"].values
    assert (first >= second).all()
    assert (second >= third).all()
    size = float(np.abs(stress["zz"]).max())
    # Trace and von Mises stress, both from the components: to rounding of the eigenvalues.
    assert (
        np.abs(first + second + third - (stress["xx"] + stress["yy"] + stress["zz"]).values).max() < 1e-13 * 30 * size
    )
    mises = np.sqrt(0.5 * ((first - second) ** 2 + (second - third) ** 2 + (third - first) ** 2))
    assert np.abs(mises - stress["von_mises"].values).max() < 1e-13 * 30 * size


def test_fatigue_parameters_are_those_of_the_command(fretting_case: dict[str, Any], tmp_path: Any) -> None:
    """Two ways to the same numbers; Ruiz's F1 is also the largest product of shear stress and slip range by hand."""
    fretting_case["output"] = {"fields": ["pressure", "shear", "slip"], "every": 2}
    fretting_case["stress"] = {
        "depths": [0.0, 20e-6],
        "yield_strength": 1e9,
        "torsion_limit": 3e8,
        "tension_limit": 4e8,
    }
    history = fretting.run(fretting_case, folder=tmp_path / "run")
    fatigue = history.fatigue([0.0, 20e-6])
    given = history.fatigue([0.0, 20e-6], constants={"yield_strength": 1e9, "torsion_limit": 3e8, "tension_limit": 4e8})
    assert fatigue.identical(given)
    told = json.loads((tmp_path / "run" / "stress" / "stress.json").read_text())["fatigue"]
    assert told["increments"] == fatigue.attrs["increments"]
    for name, entry in told["parameters"].items():
        if "ruiz" in name:  # the others are also extrapolated to the edge of contact, between the cells
            assert float(fatigue[name].max()) == pytest.approx(entry["largest"], rel=1e-12), name
        else:
            assert float(fatigue[name].max()) <= entry["largest"] * (1 + 1e-12)
    assert fatigue["smith_watson_topper"].dims == ("depth", "y", "x")
    # the contact is its own mirror image in y, and so is what its cycle does
    swt = fatigue["smith_watson_topper"].values
    assert np.abs(swt - swt[:, ::-1]).max() < 1e-6 * swt.max()
    with pytest.raises(ValueError, match="need both"):
        history.fatigue([0.0], constants={"torsion_limit": 3e8})
    with pytest.raises(ValueError, match="must be positive"):
        history.fatigue([0.0], constants={"yield_strength": -1.0})
    with pytest.raises(ValueError, match="no constants of cracks"):
        history.crack()
    with pytest.raises(IndexError, match="1 computed cycles"):
        history.fatigue([0.0], cycle=1)


def test_springs_below_a_coating_pass_tractions_and_are_those_of_the_response(fretting_case: dict[str, Any]) -> None:
    springs = {"normal_stiffness": 4e15, "shear_stiffness": 1e15}
    coating = {"thickness": 50e-6, "young": 400e9, "poisson": 0.2}
    bonded = fretting.run(fretting_case | {"lower": fretting_case["lower"] | {"coatings": [coating]}})
    fretting_case["lower"]["coatings"] = [coating | {"interface": springs}]
    history = fretting.run(fretting_case)
    # more compliant at every wavenumber: the same force sinks deeper, over a larger area
    assert history.increments["approach"][-1] > 1.01 * bonded.increments["approach"][-1]
    assert history.increments["contact_area"][-1] > bonded.increments["contact_area"][-1]
    stress = history.subsurface([50e-6], increment=4)
    size = float(np.abs(stress["zz"]).max())
    for name in ("zz", "xz", "yz"):
        assert np.abs(stress[name].values[0] - stress[name].values[1]).max() < 1e-12 * size
    # a layer on springs over a rigid base, long waves: 1/k_n + h/E_oed, 1/k_t + h/G; next order (k h)^2
    body = {"coatings": [coating | {"interface": springs}], "base": "rigid"}
    k = 1e-3 / 50e-6
    found = fretting.frequency_response(k, body)
    oedometric = 400e9 * 0.8 / (1.2 * 0.6)
    # normal and tangential spring are coupled through the layer's height: (k h)^2 k_n/k_t at the most
    assert abs(float(found["zz"]) / (1 / 4e15 + 50e-6 / oedometric) - 1) < 1e-4
    assert abs(float(found["tt"]) / (1 / 1e15 + 50e-6 * 2.4 / 400e9) - 1) < 1e-4


def test_an_interface_that_holds_nothing_is_refused_with_its_place(fretting_case: dict[str, Any]) -> None:
    coating = {"thickness": 50e-6, "young": 400e9, "poisson": 0.2}
    for interface, message in [
        ("frictionless", "nothing holds the coating against friction"),
        ({"normal_stiffness": 0.0}, "nothing carries the layer"),
        ({"shear_stiffness": -1.0}, "shear stiffness -1.0"),
    ]:
        fretting_case["lower"]["coatings"] = [coating | {"interface": interface}]
        with pytest.raises(fretting.CaseError, match=message) as refused:
            fretting.plan(fretting_case)
        assert "lower.coatings[0].interface" in str(refused.value)


def sphere(**changes: Any) -> dict[str, Any]:
    body = {"substrate": {"young": 1.0, "poisson": 0.3}}
    return {
        "grid": {"cells": [48, 48], "size": [3.2, 3.2]},
        "upper": {"rigid": True},
        "lower": body,
        "profile": {"sphere": {"radius": 100.0}},
        "load": [{"normal_force": 4.0 / 273.0, "increments": 1}],  # a = 1 on a half-space under a rigid sphere
        **changes,
    }


def test_the_surface_outside_a_hertz_contact_is_where_hertz_has_it() -> None:
    history = fretting.run(sphere())
    moved = history.subsurface([0.0, 20.0], displacement=True)
    r = np.hypot(*np.meshgrid(history.x, history.y))
    p0 = 2.0 / (np.pi * 0.91 * 100.0)
    within = np.pi * p0 / 4.0 * (2.0 - r**2)
    beyond = np.maximum(r, 1.0)
    outside = 0.5 * p0 * ((2.0 - r**2) * np.arcsin(1.0 / beyond) + np.sqrt(beyond**2 - 1.0))
    exact = 0.91 * np.where(r < 1.0, within, outside)
    # Cells of a fifteenth of the radius, whose edge is a staircase.
    np.testing.assert_allclose(moved.displacement_z.values[0], exact, rtol=2e-3)
    # Far below a force, Boussinesq: P (1 + nu) (3 - 2 nu) / (2 pi E z), up to (a/z)^2.
    middle = moved.displacement_z.values[1, 23:25, 23:25].mean()
    assert middle == pytest.approx(4.0 / 273.0 * 1.3 * 2.4 / (2.0 * np.pi * 20.0), rel=1e-2)
    # Drawn to the middle by pressure, as nu < 0.5: u_r = -(1 - 2 nu)(1 + nu) P / (2 pi E r) outside.
    along = moved.displacement_x.values[0, 24, -1]
    assert along == pytest.approx(-0.4 * 1.3 * 4.0 / 273.0 / (2.0 * np.pi * history.x[-1]), rel=5e-3)


def test_displacements_of_both_surfaces_close_the_gap_and_follow_the_motion() -> None:
    body = {"substrate": {"young": 1.0, "poisson": 0.3}, "coatings": [{"thickness": 0.3, "young": 3.0, "poisson": 0.2}]}
    history = fretting.run(
        sphere(
            upper=body,
            lower=body,
            friction={"coefficient": 0.5},
            output={"fields": ["pressure", "shear", "slip", "gap", "zone"]},
            load=[{"normal_force": 0.01, "increments": 1}, {"tangential_force": [0.001, 0.0], "increments": 1}],
        )
    )
    lower, upper = (history.subsurface([0.0], body=which, displacement=True) for which in ("lower", "upper"))
    end = {name: column[-1] for name, column in history.increments.items()}
    gap = history.field("gap").T
    r = np.hypot(*np.meshgrid(history.x, history.y))
    together = (lower.displacement_z + upper.displacement_z).values[0]
    # The same coefficients and products of them: rounding.
    np.testing.assert_allclose(together, end["approach"] - r**2 / 200.0 + gap, atol=1e-9 * end["approach"])
    # The shear on the upper body is opposite: what it lifts here it lowers on the other side.
    mirrored = upper.displacement_z.values[:, :, ::-1]
    np.testing.assert_allclose(lower.displacement_z, mirrored, atol=1e-9 * end["approach"])
    sticks = (history.field("zone").T == 1) & (history.field("slip_x").T == 0.0)
    apart = (lower.displacement_x - upper.displacement_x).values[0][sticks]
    assert sticks.sum() > 100
    np.testing.assert_allclose(apart, end["shift_x"], rtol=1e-6)  # the tolerance of the solver, 1e-8 of the tractions
    energy = (
        0.5 * (history.field("pressure").T * together).sum()
        + 0.5
        * (
            history.field("shear_x").T * (lower.displacement_x - upper.displacement_x).values[0]
            + history.field("shear_y").T * (lower.displacement_y - upper.displacement_y).values[0]
        ).sum()
    )
    cell = (3.2 / 48) ** 2
    assert end["elastic_energy"] == pytest.approx(energy * cell, rel=1e-7)


def test_a_wave_in_full_contact_is_pressed_flat() -> None:
    history = fretting.run(
        {
            "grid": {"cells": [32, 4], "size": [1.0, 0.125], "periodic": True},
            "upper": {"rigid": True},
            "lower": {"substrate": {"young": 1.0, "poisson": 0.3}},
            "profile": {"wave": {"amplitude": 1e-3, "wavelength_x": 1.0}},
            "load": [{"normal_force": 0.125 * 0.01, "increments": 1}],  # above p* = pi E* amplitude / wavelength
        }
    )
    assert history.increments["contact_cells"][-1] == 128
    moved = history.subsurface([0.0], displacement=True).displacement_z.values[0, 0]
    wave = 1e-3 * np.cos(2.0 * np.pi * history.x)
    # Collocation: the surfaces meet at the middles of the cells, to the tolerance of the gap.
    np.testing.assert_allclose(np.abs(moved - moved.mean()), np.abs(wave - wave.mean()), atol=1e-9)


def test_displacements_below_a_line_contact_are_refused() -> None:
    history = fretting.run(
        sphere(grid={"cells": 48, "size": 3.2}, profile={"cylinder": {"radius": 100.0, "axis": "y"}})
    )
    with pytest.raises(ValueError, match="line contact"):
        history.subsurface([0.0], displacement=True)

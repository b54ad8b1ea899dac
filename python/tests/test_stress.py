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

"""Stress, fatigue and a crack under a line contact with bulk and residual stress, against closed forms."""

import json
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import fretting

pytest.importorskip("xarray")

YOUNG, POISSON = 74e9, 0.33
STRENGTH: Any = {
    "strength_coefficient": 714e6,
    "strength_exponent": -0.078,
    "ductility_coefficient": 0.166,
    "ductility_exponent": -0.538,
}
CRACK: Any = {"threshold": 1e6, "short_crack_length": 90e-6, "initial_length": 20e-6, "final_length": 0.2e-3}


def line_case(line_force: float, bulk: float) -> dict[str, Any]:
    """Return a frictionless cylinder on a flat that is pulled back and forth, with a residual stress of (-50, 20)
    MPa.
    """
    substrate = {"young": YOUNG, "poisson": POISSON}
    return {
        "grid": {"cells": 512, "size": 0.96e-3},
        "upper": {"substrate": substrate},
        "lower": {"substrate": {**substrate, "residual_stress": [-50e6, 20e6]}},
        "profile": {"cylinder": {"radius": 50e-3, "axis": "y"}},
        "load": [
            {"normal_force": line_force, "increments": 1},
            {"bulk_stress": bulk, "cycles": 1, "increments": 8},
        ],
        "output": {"every": 1},
    }


def under_hertz_line(x: npt.NDArray[Any], z: float) -> dict[str, npt.NDArray[Any]]:
    """Return the stress under a Hertz line contact of half-width 1 and pressure 1: McEwen 1949; Johnson 1985, eq.
    4.49.
    """
    s = 1 - x**2 + z**2
    root = np.sqrt(s**2 + 4 * x**2 * z**2)
    m, n = np.sqrt((root + s) / 2), np.sign(x) * np.sqrt(np.maximum(root - s, 0) / 2)
    share = (z**2 + n**2) / (m**2 + n**2)
    return {
        "xx": -(m * (1 + share) - 2 * z),
        "zz": -m * (1 - share),
        "xz": -n * (m**2 - z**2) / (m**2 + n**2),
    }


def test_stress_with_bulk_and_residual_stress_is_the_sum_of_the_closed_forms() -> None:
    """Johnson's stress below a cylinder, the bulk in plane strain and the residual stress add: at the peak of the
    pull, at depths.
    """
    history = fretting.run(line_case(9.327e4, 92.7e6))
    hertz = fretting.analytic.hertz_line(radius=50e-3, line_force=9.327e4, modulus=YOUNG / (2 * (1 - POISSON**2)))
    a, p0 = hertz.half_width, hertz.max_pressure
    peak = int(np.argmax(history.increments["bulk_stress_x"]))
    assert history.increments["bulk_stress_x"][peak] == pytest.approx(92.7e6)
    for depth in (0.3, 0.78, 2.0):
        stress = history.subsurface([depth * a], increment=peak)
        exact = under_hertz_line(history.x / a, depth)
        exact["yy"] = POISSON * (exact["xx"] + exact["zz"])
        even = {"xx": 92.7e6 - 50e6, "yy": POISSON * 92.7e6 + 20e6, "zz": 0.0, "xz": 0.0}
        for name, part in even.items():
            error = np.abs(stress[name].values[0] - (p0 * exact[name] + part)).max()
            assert error < 2e-4 * p0, (name, depth)  # 200 cells in the half-width: the pressure is good to 1e-4


def test_smith_watson_topper_of_the_cycle_is_that_of_the_closed_form() -> None:
    """The contact stands still while the bulk stress swings: the parameter over all planes by a fine table in
    Python.
    """
    history = fretting.run(line_case(9.327e4, 92.7e6))
    hertz = fretting.analytic.hertz_line(radius=50e-3, line_force=9.327e4, modulus=YOUNG / (2 * (1 - POISSON**2)))
    a, p0, depth = hertz.half_width, hertz.max_pressure, 1.5
    found = history.fatigue([depth * a], constants={"strain_life": STRENGTH})
    exact = under_hertz_line(history.x / a, depth)
    angle = np.linspace(0, np.pi, 2001)[:, None]
    c, s = np.cos(angle), np.sin(angle)
    # normals in the plane: the stress along y is never the largest here
    contact = p0 * (exact["xx"] * c**2 + exact["zz"] * s**2 + 2 * exact["xz"] * s * c)
    largest = contact + (92.7e6 - 50e6) * c**2
    strain = ((1 + POISSON) * 92.7e6 * c**2 - POISSON * (1 + POISSON) * 92.7e6) / YOUNG
    table = np.maximum(largest, 0) * np.abs(strain)
    parameter = table.max(axis=0)
    outside = np.abs(history.x) > 1.1 * a  # tension by the bulk; below the contact planes across y count as well
    assert np.abs(found["smith_watson_topper"].values[0] - parameter)[outside].max() < 2e-4 * parameter.max()
    # life by the law itself: the parameter at the cycles found
    cycles = found["smith_watson_topper_cycles"].values[0][outside]
    law = 714e6**2 / YOUNG * (2 * cycles) ** -0.156 + 714e6 * 0.166 * (2 * cycles) ** -0.616
    assert np.allclose(law, found["smith_watson_topper"].values[0][outside], rtol=1e-9)
    # a swinging uniaxial strain in plane strain needs the von Mises stress of half its range to shake down
    needed = 92.7e6 * np.sqrt(1 - POISSON + POISSON**2)
    assert np.allclose(found["shakedown_strength"].values, needed, rtol=1e-9)


def test_a_crack_beside_a_light_contact_is_that_of_the_pull_alone(tmp_path: Any) -> None:
    """K = 1.1215 s sqrt(pi l) of an edge crack in tension: the pull less the residual stress; the command says the
    same as Python.
    """
    case = line_case(10.0, 150e6)
    case["lower"]["substrate"]["fatigue"] = {"crack": CRACK, "strain_life": STRENGTH}
    case["stress"] = {"depths": [0.0, 10e-6]}
    history = fretting.run(case, folder=tmp_path / "run")
    crack = history.crack()
    exact = 1.121522 * (150e6 - 50e6) * np.sqrt(np.pi * crack.length.values)
    assert np.abs(crack["k1_range"].values / exact - 1).max() < 0.02  # p0 is 1 % of the pull
    assert abs(crack.attrs["angle"]) < 1.0
    threshold = 1e6 * np.sqrt(crack.length.values / (crack.length.values + 90e-6))
    assert np.allclose(crack["threshold"].values, threshold, rtol=1e-12)
    told = json.loads((tmp_path / "run" / "stress" / "stress.json").read_text())["fatigue"]["crack"]
    assert {name: told[name] for name in ("fate", "x", "angle", "length")} == {
        name: crack.attrs[name] for name in ("fate", "x", "angle", "length")
    }
    assert crack.attrs["fate"] == "grows"
    strong: Any = {"crack": {**CRACK, "threshold": 1e8}}
    weak = history.crack(constants=strong)
    assert weak.attrs["fate"] == "does_not_grow"


def test_a_coating_pulled_with_its_substrate_channels_and_delaminates_as_a_film_does() -> None:
    """(pi/2) 1.2578 s^2 h (1 - nu^2)/E by Beuth, s^2 h (1 - nu^2)/(2 E) by Hutchinson and Suo, of a film as stiff as
    its substrate.
    """
    case = line_case(1e3, 150e6)
    thickness = 5e-6
    case["lower"]["coatings"] = [
        {
            "thickness": thickness,
            "young": YOUNG,
            "poisson": POISSON,
            "residual_stress": [-50e6, 20e6],
            "fatigue": {"fracture_energy": 2.0, "interface_energy": 1.0},
        }
    ]
    found = fretting.run(case).coating_fracture()
    tension = found.sel(sense="tension")
    stress = 150e6 - 50e6
    energy = stress**2 * thickness * (1 - POISSON**2) / YOUNG
    # p0 is 1 % of the pull; the energies go with its square
    assert abs(float(tension["stress"]) / stress - 1) < 0.02
    assert abs(float(tension["channelling"]) / (np.pi / 2 * 1.25781 * energy) - 1) < 0.04
    assert abs(float(tension["delamination"]) / (0.5 * energy) - 1) < 0.04
    assert abs(float(tension["phase"]) - 52.07) < 0.01
    assert (
        abs(float(tension["channelling_factor_of_safety"]) / np.sqrt(2.0 / float(tension["channelling"])) - 1) < 1e-12
    )
    assert abs(float(tension["direction"])) < 1.0
    compression = found.sel(sense="compression")
    assert float(compression["channelling"]) == 0.0
    assert float(compression["phase"]) == 90.0
    del case["lower"]["coatings"]
    with pytest.raises(ValueError, match="no coating that is bonded"):
        fretting.run(case).coating_fracture()


def test_python_and_the_command_tell_one_life(tmp_path: Any) -> None:
    """The tension behind a slider has a cusp between the cells: both extrapolate it to the rim, tell the largest cell
    beside it, the critical plane, and the values at the critical distance.
    """
    substrate: Any = {"young": YOUNG, "poisson": POISSON}
    constants: Any = {"strain_life": STRENGTH, "critical_distance": 20e-6}
    case: Any = {
        "grid": {"cells": 128, "size": 2.6e-3},
        "upper": {"substrate": substrate},
        "lower": {"substrate": {**substrate, "fatigue": constants}},
        "profile": {"cylinder": {"radius": 50e-3, "axis": "y"}},
        "friction": {"coefficient": 0.5},
        "load": [
            {"normal_force": 4e5, "increments": 1},
            {"tangential_force": [1.6e5, 0.0], "cycles": 1, "increments": 8},
        ],
        "output": {"every": 1},
        "stress": {"depths": [0.0, 5e-6, 10e-6, 20e-6, 40e-6]},
    }
    history = fretting.run(case, folder=tmp_path / "run")
    found = history.fatigue(case["stress"]["depths"])
    told = json.loads((tmp_path / "run" / "stress" / "stress.json").read_text())["fatigue"]["parameters"]
    assert set(found.parameter.values) == {name for name in told if not name.startswith("ruiz")}
    for name in found.parameter.values:
        one, other = found.sel(parameter=name), told[name]
        for ours, theirs in (
            ("largest", "largest"),
            ("largest_cell", "largest_cell"),
            ("largest_x", "x"),
            ("largest_depth", "depth"),
        ):
            assert float(one[ours]) == pytest.approx(other[theirs], rel=1e-12, abs=1e-18), (name, ours)
    one, other = found.sel(parameter="smith_watson_topper"), told["smith_watson_topper"]
    assert float(one["largest_cycles"]) == pytest.approx(other["cycles"], rel=1e-12)
    assert float(one["largest_cell_cycles"]) == pytest.approx(other["largest_cell_cycles"], rel=1e-12)
    assert list(one["critical_plane"].values) == pytest.approx(other["normal"])
    # at the surface the largest cell is that of the array; the rim lies above it and fails earlier
    array = found["smith_watson_topper"]
    assert float(one["largest_depth"]) == 0.0
    assert float(one["largest_cell"]) == pytest.approx(float(array.sel(depth=0.0).max()), rel=1e-12)
    assert float(one["largest"]) > 1.02 * float(one["largest_cell"])
    assert float(one["largest_cycles"]) < float(one["largest_cell_cycles"])
    # the point method by hand: the largest value of the array at half the critical distance
    assert float(one["point_method"]) == pytest.approx(float(array.sel(depth=10e-6).max()), rel=1e-12)
    for method in ("point", "line"):
        told_at = other["critical_distance"][method]
        assert float(one[f"{method}_method"]) == pytest.approx(told_at["value"], rel=1e-9)
        assert float(one[f"{method}_method_cycles"]) == pytest.approx(told_at["cycles"], rel=1e-9)
    table = (tmp_path / "run" / "stress" / "fatigue.csv").read_text().splitlines()
    row = dict(zip(table[0].split(","), table[1].split(","), strict=True))
    assert row["parameter"] == "smith_watson_topper"
    assert float(row["largest_cell"]) == pytest.approx(float(one["largest_cell"]), rel=1e-12)
    assert float(row["point_method"]) == pytest.approx(float(one["point_method"]), rel=1e-12)
    assert abs(float(row["normal_x"])) == pytest.approx(abs(float(one["critical_plane"][0])), rel=1e-9)


def test_every_crack_has_cycles() -> None:
    """A table over load cases asks each crack for its cycles: inf of one that stops or does not grow, NaN where
    nothing says how fast it grows.
    """
    history = fretting.run(line_case(10.0, 150e6))
    laws: list[dict[str, float]] = [{}, {"paris_coefficient": 1e-28, "paris_exponent": 3.0}]
    fates = {}
    for threshold in (1e6, 1e8):
        for law in laws:
            constants: Any = {"crack": {**CRACK, **law, "threshold": threshold}}
            crack = history.crack(constants=constants)
            fates[threshold, bool(law)] = crack.attrs["fate"], crack.attrs["cycles"]
    assert fates[1e8, False] == fates[1e8, True] == ("does_not_grow", np.inf)
    assert fates[1e6, False][0] == "grows"
    assert np.isnan(fates[1e6, False][1])
    assert np.isfinite(fates[1e6, True][1])
    assert fates[1e6, True][1] > 0
    pressed = fretting.run(line_case(9.327e4, 1e3)).crack(constants={"crack": CRACK})
    assert pressed.attrs["fate"] in ("none", "does_not_grow", "stops")
    assert not np.isfinite(pressed.attrs["cycles"])


def test_a_graded_coating_and_a_cut_one_are_one_film() -> None:
    """Energy of delamination: s^2/2 times the integral of (1 - nu^2)/E over the thickness, of a modulus that falls
    linearly from 4 to 1 h (1 - nu^2) ln 4 / 3; a film cut in two is the film.
    """

    def fractured(coatings: list[Any]) -> Any:
        case: Any = line_case(1e3, 1e3)
        case["lower"]["coatings"] = coatings
        case["lower"]["substrate"].pop("residual_stress")
        return fretting.run(case).coating_fracture().sel(sense="tension")

    thickness = 5.5e-6
    film: Any = {"thickness": thickness, "poisson": 0.3, "residual_stress": 500e6}
    graded = fractured([{**film, "gradient": {"young": [400e9, 100e9], "law": "linear", "layers": 80}}])
    stress = float(graded["stress"])
    assert stress == pytest.approx(500e6, rel=0.02)  # the contact adds 1 %
    exact = stress**2 / 2 * (1 - 0.3**2) * thickness * np.log(4.0) / 3 / 100e9
    assert float(graded["delamination"]) == pytest.approx(exact, rel=2e-4)  # of 80 sublayers 1.3e-4, order two
    assert np.isnan(float(graded["channelling"]))
    whole = fractured([{**film, "young": 400e9}])
    for parts in ((0.5, 0.5), (0.9, 0.1)):
        cut = fractured([{**film, "young": 400e9, "thickness": part * thickness} for part in parts])
        for name in ("stress", "delamination"):
            assert float(cut[name]) == pytest.approx(float(whole[name]), rel=1e-4), (parts, name)
        # the substrate below is softer, however thin the layer of the film's own material is
        assert np.isnan(float(cut["channelling"]))
        assert np.isnan(float(cut["phase"]))


def test_places_that_travel_through_the_grid_have_no_fatigue() -> None:
    """In the frame of the contact a cell is another place of the bodies after each increment of a roll."""
    histories = {}
    for frame in ("bodies", "contact"):
        case: dict[str, Any] = {
            "grid": {"cells": 128, "size": 3.2},
            "upper": {"rigid": True},
            "lower": {"substrate": {"young": 1.0, "poisson": 0.3, "thermal_conductivity": 1.0}},
            "profile": {"cylinder": {"radius": 100.0, "axis": "y"}},
            "friction": {"coefficient": 0.3},
            "kinematics": {"frame": frame},
            "load": [{"normal_force": 2e-3, "increments": 2}, {"roll": 0.2, "cycles": 1, "increments": 16}],
            "output": {"every": 1},
        }
        histories[frame] = fretting.run(case)
    found = histories["bodies"].fatigue([0.05])
    assert float(found.shakedown_strength.max()) > 0.0
    for attempt in (histories["contact"].fatigue, lambda depths: histories["contact"].crack(constants=CRACK)):
        with pytest.raises(ValueError, match='frame = "bodies"'):
            attempt([0.05])
    for history in histories.values():
        with pytest.raises(ValueError, match="the contact rolls"):
            history.temperature(frequency=10.0)

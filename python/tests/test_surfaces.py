"""Heights and friction maps from Python: arrays in the dict, files beside the case, and what is refused."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting

CELLS, SIZE = 24, 2.4
CENTRE = (np.arange(CELLS) - (CELLS - 1) / 2) * SIZE / CELLS
GAP = (CENTRE[:, None] ** 2 + CENTRE[None, :] ** 2) / 200


def case(profile: dict[str, Any], **more: object) -> dict[str, Any]:
    return {
        "grid": {"cells": [CELLS, CELLS], "size": [SIZE, SIZE]},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 1.0, "poisson": 0.3}},
        "profile": profile,
        "load": [{"normal_force": 0.008, "increments": 1}],
        **more,
    }


def test_an_array_and_a_file_of_heights_are_the_same_contact(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    formula = fretting.run(case({"sphere": {"radius": 100.0}})).field("pressure")
    array = fretting.run(case({"heights": {"values": -GAP}})).field("pressure")
    np.save(tmp_path / "ball.npy", -GAP * 1e6)
    np.savetxt(tmp_path / "ball.txt", GAP, fmt="%.17e")
    monkeypatch.chdir(tmp_path)
    npy = fretting.run(case({"heights": {"file": "ball.npy", "unit": 1e-6}})).field("pressure")
    text = fretting.run(case({"heights": {"file": "ball.txt", "of": "gap"}})).field("pressure")
    for pressure in (array, npy, text):
        # The gaps agree to rounding; the solver's tolerance is 1e-8.
        np.testing.assert_allclose(pressure, formula, atol=1e-7 * formula.max())


def test_a_relative_file_starts_at_the_case_file(tmp_path: Path) -> None:
    np.save(tmp_path / "mu.npy", np.full((CELLS, CELLS), 0.3, dtype=np.float32))
    text = (
        f"[grid]\ncells = [{CELLS}, {CELLS}]\nsize = [{SIZE}, {SIZE}]\n[upper]\nrigid = true\n"
        "[lower]\nsubstrate = { young = 1.0, poisson = 0.3 }\n[profile.sphere]\nradius = 100.0\n"
        '[friction]\nmap = "mu.npy"\n[[load]]\nnormal_force = 0.008\nincrements = 1\n'
    )
    (tmp_path / "case.toml").write_text(text)
    friction = fretting.plan(tmp_path / "case.toml")["case"]["friction"]["coefficient"]["map"]
    assert friction["cells"] == [CELLS, CELLS]
    assert friction["largest"] == np.float32(0.3)


def test_a_map_in_a_stage_holds_from_there_on() -> None:
    mu = np.where(CENTRE[:, None] < 0, 0.0, 0.4) + np.zeros((1, CELLS))
    load = [{"normal_force": 0.008, "increments": 1}, {"friction": mu, "shift": [0.001, 0.0], "increments": 2}]
    history = fretting.run(case({"sphere": {"radius": 100.0}}, load=load))
    shear = history.field("shear_x")
    assert np.all(shear[CENTRE < 0] == 0)
    assert shear.sum() > 0


def test_a_profile_of_one_dimension_and_pairs_are_a_line_contact() -> None:
    x = (np.arange(64) - 31.5) / 10
    question = case({})
    question["grid"] = {"cells": 64, "size": 6.4}
    pressures = []
    for values in (-(x**2) / 200, np.column_stack((x, -(x**2) / 200)), list(-(x**2) / 200)):
        question["profile"] = {"heights": {"values": values}}
        pressures.append(fretting.run(question).field("pressure"))
    question["profile"] = {"cylinder": {"radius": 100.0, "axis": "y"}}
    formula = fretting.run(question).field("pressure")
    for pressure in pressures:
        # The gaps agree to rounding; the solver's tolerance is 1e-8.
        np.testing.assert_allclose(pressure, formula, atol=1e-7 * formula.max())


@pytest.mark.parametrize(
    ("profile", "said"),
    [
        ({"heights": {"values": np.zeros((3, 4))}}, "3 x 4 numbers"),
        ({"heights": {"values": np.full((CELLS, CELLS), np.nan)}}, "height [0, 0] = NaN"),
        ({"heights": {"values": np.zeros((CELLS, CELLS), dtype=complex)}}, "complex128: must be real numbers"),
        ({"heights": {"values": np.zeros((CELLS, CELLS, 1))}}, "must have one or two dimensions"),
        ({"heights": {"values": np.zeros(CELLS)}}, "24 x 1 numbers"),
        ({"heights": {"values": np.ma.masked_equal(np.eye(CELLS), 1.0)}}, "height [0, 0] = NaN"),
        ({"heights": {"values": np.ma.masked_equal(np.eye(CELLS), 1.0)}}, 'fill = "harmonic"'),
        ({"heights": {"values": np.where(np.eye(CELLS) > 0, -9999.0, GAP)}}, "height [0, 0] is -9999.0"),
        ({"heights": {"file": "nowhere.npy"}}, "nowhere.npy"),
    ],
)
def test_bad_heights_are_refused_in_one_message(profile: dict[str, Any], said: str) -> None:
    with pytest.raises(fretting.CaseError, match=r"profile\.heights") as caught:
        fretting.plan(case(profile))
    assert len(caught.value.mistakes) == 1
    assert said in str(caught.value)


@pytest.mark.long
def test_a_topography_of_surface_topography_is_read_through_its_heights() -> None:
    topographies = pytest.importorskip("SurfaceTopography")
    topography = topographies.Topography(-GAP, (SIZE, SIZE))
    question = case({"heights": {"values": topography.heights()}})
    question["grid"] = {"cells": list(topography.nb_grid_pts), "size": list(topography.physical_sizes)}
    expected = fretting.run(case({"sphere": {"radius": 100.0}})).field("pressure")
    np.testing.assert_allclose(fretting.run(question).field("pressure"), expected, atol=1e-7 * expected.max())


@pytest.mark.long
def test_the_recipe_for_measured_files_brings_them_to_one_unit(tmp_path: Path) -> None:
    topographies = pytest.importorskip("SurfaceTopography")
    cells, side = (64, 48), (320e-6, 240e-6)
    x, y = (np.arange(n) * s / n for n, s in zip(cells, side, strict=True))
    heights = -((x[:, None] - x.mean()) ** 2 + (y[None, :] - y.mean()) ** 2) / (2 * 5e-3)  # a ball of 5 mm, in metres
    micro = "\N{MICRO SIGN}m"
    head = f"Channel: Z\nWidth: {side[0] * 1e6:g} {micro}\nHeight: {side[1] * 1e6:g} {micro}\nValue units: {micro}"
    np.savetxt(tmp_path / "scan.txt", heights.T * 1e6, fmt="%.9e", header=head, delimiter="\t", encoding="utf-8")
    topography = topographies.read_topography(str(tmp_path / "scan.txt")).to_unit("m")
    question = case({"heights": {"values": topography.heights()}})
    question["grid"] = {"cells": list(topography.nb_grid_pts), "size": list(topography.physical_sizes)}
    question["lower"] = {"substrate": {"young": 210e9, "poisson": 0.3}}
    question["load"] = [{"normal_force": 10.0, "increments": 1}]
    hertz = fretting.analytic.hertz(radius=5e-3, force=10.0, modulus=210e9 / 0.91)
    # 9 cells in the radius of contact: within the 1 % of the manual
    assert fretting.run(question).increments["max_pressure"][-1] == pytest.approx(hertz.max_pressure, rel=0.01)

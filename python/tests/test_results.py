"""Histories written, opened and continued from Python; error bars and studies; increments found by what happens
there.
"""

import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting


@pytest.fixture
def case(fretting_case: dict[str, Any]) -> dict[str, Any]:
    fretting_case["grid"]["cells"] = [20, 24]
    fretting_case["load"][1]["increments"] = 8
    return fretting_case


def assert_same(one: fretting.History, other: fretting.History) -> None:
    """The same bits, but for the times."""
    for name, column in one.increments.items():
        if name != "wall_s":
            np.testing.assert_array_equal(column, other.increments[name], err_msg=name)
    for name, column in one.cycles.items():
        np.testing.assert_array_equal(column, other.cycles[name], err_msg=name)
    assert one.kept_increments == other.kept_increments
    for number in one.kept_increments:
        for name in ("pressure", "shear", "slip", "gap", "zone"):
            np.testing.assert_array_equal(one.field(name, number), other.field(name, number))  # type: ignore[arg-type]
    assert (one.status, one.stages, one.running_conditions) == (other.status, other.stages, other.running_conditions)


def test_three_ways_to_a_folder_hold_the_same_history(case: dict[str, Any], tmp_path: Path) -> None:
    memory = fretting.run(case)
    folder = fretting.run(case, folder=tmp_path / "run")
    saved = fretting.open_results(memory.save(tmp_path / "saved"))
    copied = fretting.open_results(folder.save(tmp_path / "copied"))
    for other in (folder, saved, copied):
        assert_same(memory, other)
    # Each is a state to start from, the same one.
    case["load"] = [{"tangential_force": [0.0, 0.0], "increments": 2}]
    on = [
        fretting.run(case, start=start) for start in (memory, tmp_path / "run", tmp_path / "saved", tmp_path / "copied")
    ]
    for other in on[1:]:
        assert_same(on[0], other)


def test_a_history_knows_its_case(case: dict[str, Any], tmp_path: Path) -> None:
    history = fretting.run(case, folder=tmp_path / "run")
    assert history.case == case
    assert history.version == fretting.__version__
    assert history.plan["grid"]["cells"] == [20, 24]
    assert_same(history, fretting.run(history.case))


def test_arrays_of_a_case_go_into_its_folder(case: dict[str, Any], tmp_path: Path) -> None:
    x = np.linspace(-1.0, 1.0, 20)[:, None]
    case["friction"] = {"map": 0.2 + 0.05 * x * np.ones((20, 24))}
    case["profile"] = {"heights": {"values": -1e-6 * (x**2 + np.linspace(-1.0, 1.0, 24) ** 2)}}
    case["load"] = [{"normal_force": 5.0, "increments": 1}, {"tangential_force": [0.5, 0.0], "increments": 2}]
    memory = fretting.run(case)
    folder = fretting.run(case, folder=tmp_path / "run")
    assert_same(memory, folder)
    assert sorted(path.name for path in (tmp_path / "run").glob("*.npy")) == ["array-0.npy", "array-1.npy"]
    # The folder is whole: its case runs again from its own files.
    assert_same(memory, fretting.run(tmp_path / "run" / "case.toml"))


def test_a_stopped_run_continues_and_a_solved_one_is_left_alone(case: dict[str, Any], tmp_path: Path) -> None:
    def stop(step: dict[str, Any]) -> None:
        if step["increment"] == 4:
            raise LookupError("enough")

    with pytest.raises(LookupError) as stopped:
        fretting.run(case, folder=tmp_path / "run", progress=stop)
    assert len(stopped.value.history) == 5  # type: ignore[attr-defined]
    with pytest.raises(ValueError, match="resume=True"):
        fretting.run(case, folder=tmp_path / "run")
    whole = fretting.run(case, folder=tmp_path / "run", resume=True)
    assert_same(fretting.run(case), whole)
    before = (tmp_path / "run" / "run.json").read_bytes()
    fretting.run(case, folder=tmp_path / "run", resume=True)
    assert (tmp_path / "run" / "run.json").read_bytes() == before
    # nor does what was solved until a run was stopped take the place of all of it
    with pytest.raises(ValueError, match="replace=True"):
        stopped.value.history.save(tmp_path / "run")  # type: ignore[attr-defined]
    assert (tmp_path / "run" / "run.json").read_bytes() == before


def test_results_of_another_case_are_kept(case: dict[str, Any], tmp_path: Path) -> None:
    history = fretting.run(case, folder=tmp_path / "run")
    other = {**case, "friction": {"coefficient": 0.3}}
    for attempt in (
        lambda: fretting.run(other, folder=tmp_path / "run"),
        lambda: fretting.run(other).save(tmp_path / "run"),
        lambda: history.save(tmp_path),
    ):
        with pytest.raises(ValueError, match="replace=True"):
            attempt()
    assert_same(history, fretting.open_results(tmp_path / "run"))
    replaced = fretting.run(other, folder=tmp_path / "run", replace=True)
    assert replaced.case["friction"] == {"coefficient": 0.3}
    with pytest.raises(ValueError, match="of a run with a folder"):
        fretting.run(case, resume=True)


@pytest.mark.parametrize("way", ["run", "save"])
def test_answers_about_earlier_results_go_with_them(case: dict[str, Any], tmp_path: Path, way: str) -> None:
    place, other = tmp_path / "run", {**case, "friction": {"coefficient": 0.3}}
    fretting.run(case, folder=place)
    (place / "stress").mkdir()
    for name in ("stress.json", "depths.csv", "mine.csv"):
        (place / "stress" / name).write_text("{}")
    fretting.run(other, folder=tmp_path / "other")
    opened = fretting.open_results(tmp_path / "other")
    if way == "run":
        fretting.run(other, folder=place, replace=True)
    else:
        opened.save(place, replace=True)
    assert [path.name for path in (place / "stress").iterdir()] == ["mine.csv"]
    assert_same(opened, fretting.open_results(place))


def test_a_failed_run_keeps_what_was_solved(case: dict[str, Any], tmp_path: Path) -> None:
    # Pressed by an approach, so that only the run finds out that friction does not carry the force.
    case["load"] = [{"approach": 1e-6, "increments": 2}, {"tangential_force": [50.0, 0.0], "increments": 4}]
    for folder in (None, tmp_path / "run"):
        with pytest.raises(fretting.RunError, match="increment 2") as failed:
            fretting.run(case, folder=folder)
        history = failed.value.history
        assert history is not None
        assert len(history) == failed.value.increment == 2
        assert not history.finished
        again = fretting.open_results(history.save(tmp_path / f"saved-{folder is None}"))
        np.testing.assert_array_equal(again.increments["normal_force"], history.increments["normal_force"])
        assert again.message == history.message


def test_error_bars_cover_the_closed_form(sphere_case: dict[str, Any], tmp_path: Path) -> None:
    history = fretting.run(sphere_case, estimate_error=True)
    bars = history.error_bars
    assert bars is not None
    hertz = fretting.analytic.hertz(radius=10e-3, force=12.0, modulus=210e9 / (1 - 0.3**2))
    for name, exact in (("max_pressure", hertz.max_pressure), ("approach", hertz.approach)):
        entry = bars["stages"][-1][name]
        assert abs(entry["value"] - exact) <= entry["error_bar"]
        assert entry["error_bar"] < 0.05 * exact
    assert fretting.run(sphere_case, folder=tmp_path / "run", estimate_error=True).error_bars is not None
    saved = fretting.open_results(history.save(tmp_path / "saved"))
    assert saved.error_bars == bars
    assert fretting.run(sphere_case).error_bars is None


def test_a_study_sees_the_known_orders(sphere_case: dict[str, Any]) -> None:
    pytest.importorskip("xarray")
    study = fretting.study(sphere_case, cells=[16, 32, 64])
    assert study["nx"].values.tolist() == [16, 32, 64]
    assert set(study["refined"].values.tolist()) == {"cells"}
    # Pressure and approach of a Hertz contact are of second order in the cell; the edge between the cells moves an
    # order by tenths.
    approach = study["error"].sel(quantity="approach").values
    assert approach[-1] < 1e-3
    assert 1.5 < np.log2(approach[0] / approach[-1]) / 2 < 3.0
    assert study["measured_by"].sel(quantity="approach").item() == "closed_form"
    assert "Choose for 1 %" in study.attrs["choice"]
    with pytest.raises(ValueError, match="cells"):
        fretting.study(sphere_case, cells=[2, 32])


def test_a_study_without_any_error_says_why(sphere_case: dict[str, Any]) -> None:
    pytest.importorskip("xarray")
    sphere_case["lower"]["coatings"] = [{"thickness": 2e-5, "young": 400e9, "poisson": 0.2}]
    with pytest.warns(fretting.FrettingWarning, match=r"no closed form .* give more levels, as in cells=\[32"):
        study = fretting.study(sphere_case, cells=[16])
    assert study.sizes["level"] == 0
    with warnings.catch_warnings():
        warnings.simplefilter("error", fretting.FrettingWarning)
        assert fretting.study(sphere_case, cells=[8, 16]).sizes["level"] == 2


def test_a_reference_that_is_no_file_is_refused_by_its_name(sphere_case: dict[str, Any], tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    for name in (tmp_path / "nofile", str(tmp_path / "nofile")):
        with pytest.raises(fretting.MissingFileError, match="nofile: no such file"):
            fretting.study(sphere_case, cells=[16], against=name)
    with pytest.raises(fretting.UnreadableError, match="a folder, not a file"):
        fretting.study(sphere_case, cells=[16], against=tmp_path)
    with pytest.raises(TypeError, match=r"^against: expected a path, found int"):
        fretting.study(sphere_case, cells=[16], against=3)  # type: ignore[arg-type]


def test_yes_and_no_are_no_other_words(sphere_case: dict[str, Any], tmp_path: Path) -> None:
    for name in ("estimate_error", "resume", "replace"):
        for value in ("no", None, np.zeros(2)):
            odd: dict[str, Any] = {name: value}
            with pytest.raises(TypeError, match=f"^{name} = .*: must be True or False"):
                fretting.run(sphere_case, folder=tmp_path / "run", **odd)
    pytest.importorskip("xarray")
    with pytest.raises(TypeError, match=r"^progress = 3: must be True or False"):
        fretting.study(sphere_case, cells=[16], progress=3)  # type: ignore[arg-type]


def test_increments_are_found_by_what_happens_there(case: dict[str, Any]) -> None:
    history = fretting.run(case)
    force = history.increments["tangential_force_x"]
    assert history.at() == len(history) - 1
    assert history.at("end", stage="indent") == 0
    assert force[history.at("maximum", cycle=0)] == force.max()
    assert history.at("minimum", stage="fretting", cycle=-1) == force.argmin()
    assert history.at("start", cycle=0) == history.cycles["first_increment"][0]
    with pytest.raises(ValueError, match="must be one of 'start'"):
        history.at("peak")  # type: ignore[arg-type]
    with pytest.raises(IndexError):
        history.at(cycle=1)
    with pytest.raises(ValueError, match="no stage is called 'rub'"):
        history.at(stage="rub")


def test_a_field_of_two_components_has_the_name_of_the_case(case: dict[str, Any]) -> None:
    history = fretting.run(case)
    shear = history.field("shear")
    assert shear.shape == (2, *history.shape)
    np.testing.assert_array_equal(shear[0], history.field("shear_x"))
    with pytest.raises(KeyError, match="the nearest is 4"):
        history.field("pressure", 3)
    with pytest.raises(KeyError, match="columns are"):
        history.cycles["energy"]


def test_closed_forms_of_layers_and_of_no_slip() -> None:
    analytic = fretting.analytic
    layer = {"thickness": 1.0, "young": 1.0, "poisson": 0.3}
    # Hertz is the limit: of no coupling, and of a layer much thicker than the contact is wide.
    hertz = analytic.hertz(radius=50.0, force=1e-5, modulus=1.0 / 0.91)
    stuck = analytic.no_slip_sphere(radius=50.0, force=1e-5, modulus=1.0 / 0.91, coupling=0.0)
    assert stuck.contact_radius == pytest.approx(hertz.contact_radius, rel=1e-12)
    thick = analytic.thick_layer(radius=50.0, contact_radius=1e-4, layer=layer)
    assert thick.approach == pytest.approx(1e-8 / 50.0, rel=1e-3)
    # Johnson (1985), section 5.8: springs of the modulus E(1 - nu)/((1 + nu)(1 - 2 nu)).
    thin = analytic.thin_layer(radius=1e6, force=1.0, layer=layer)
    stiffness = 0.7 / (1.3 * 0.4)
    assert thin.force == pytest.approx(np.pi * stiffness * thin.contact_radius**4 / 4e6, rel=1e-12)
    assert thin.pressure(0.0) == pytest.approx(thin.max_pressure)
    punch = analytic.no_slip_punch(radius=1.0, force=1.0, modulus=1.0, coupling=0.2857142857142857)
    assert punch.force_ratio == pytest.approx(np.arctanh(2 / 7) / (2 / 7))
    rounded = analytic.rounded_punch(flat_radius=1.0, edge_radius=1.0, force=0.01, modulus=1.0)
    assert rounded.contact_radius > 1.0
    table = analytic.spence_table()
    assert {point.poisson for point in table} == {0.0, 0.2, 0.3, 0.4}
    for call in (
        lambda: analytic.thin_layer(radius=1.0, force=1.0, layer={"young": 1.0, "poisson": 0.3}),
        lambda: analytic.effective_moduli(lower={"young": 1.0, "nu": 0.3}),
    ):
        with pytest.raises(ValueError, match="must have"):
            call()


def test_declared_units_stand_on_axes_and_in_attributes(sphere_case: dict[str, Any], tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    in_mm = {
        "units": {"length": "mm", "force": "N"},
        "grid": {"cells": [24, 24], "size": [0.24, 0.24]},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 210e3, "poisson": 0.3}},
        "profile": {"sphere": {"radius": 10.0}},
        "load": [{"normal_force": 12.0, "increments": 1}],
    }
    history = fretting.run(in_mm, folder=tmp_path / "run")
    assert history.units == {"length": "mm", "force": "N", "pressure": "MPa"}
    data = history.to_xarray()
    units = {
        name: data[name].attrs.get("units")
        for name in ("pressure", "approach", "dissipated_energy", "contact_area", "x")
    }
    assert units == {
        "pressure": "MPa",
        "approach": "mm",
        "dissipated_energy": "N mm",
        "contact_area": "mm^2",
        "x": "mm",
    }
    stored = json.loads((tmp_path / "run" / "fields.zarr" / "pressure" / "zarr.json").read_text())
    assert stored["attributes"]["units"] == "MPa"
    # Numbers are never converted: the same contact in metres has the same pressure in Pa.
    in_m = fretting.run({**sphere_case, "grid": {"cells": [24, 24], "size": [240e-6, 240e-6]}})
    ratio = in_m.increments["max_pressure"][-1] / history.increments["max_pressure"][-1]
    assert ratio == pytest.approx(1e6, rel=1e-7)  # both within the solver's tolerance of 1e-8
    assert "units" not in in_m.to_xarray()["pressure"].attrs
    with pytest.raises(fretting.CaseError, match="symbol of a unit"):
        fretting.run({**in_mm, "units": {"length": "milli metre", "force": "N"}})

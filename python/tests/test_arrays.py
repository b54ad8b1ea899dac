"""Names, shapes and number types of what a run leaves behind."""

import importlib.util
import io
import pickle
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

import fretting
from fretting._meaning import FieldName

REALS = {
    "normal_force", "approach", "tangential_force_x", "tangential_force_y", "shift_x", "shift_y", "twist_moment",
    "twist", "tilt_x", "tilt_y", "tilt_moment_x", "tilt_moment_y", "bulk_stress_x", "bulk_stress_y",
    "upper_bulk_stress_x", "upper_bulk_stress_y", "bulk_work", "max_pressure", "max_shear",
    "contact_area", "stick_area", "dissipated_energy", "worn_volume", "max_worn_depth", "residual", "wall_s",
    "full_grid_convolutions",
}  # fmt: skip
COUNTS = {
    "increment", "stage", "contact_cells", "stick_cells", "convolutions", "preconditioner_passes", "outer_iterations",
    "parts",
}  # fmt: skip


@pytest.fixture
def history(fretting_case: dict[str, Any]) -> fretting.History:
    fretting_case["grid"] = {"cells": [32, 24], "size": [300e-6, 300e-6]}
    return fretting.run(fretting_case)


def test_steps_are_columns_of_one_entry_an_increment(history: fretting.History) -> None:
    assert set(history.increments) >= REALS | COUNTS | {"regime"}
    assert len(history) == 17
    for name, column in history.increments.items():
        assert column.shape == (17,), name
    for name in REALS:
        assert history.increments[name].dtype == np.float64, name
        assert np.isfinite(history.increments[name]).all(), name
    for name in COUNTS:
        assert history.increments[name].dtype == np.int64, name
    np.testing.assert_array_equal(history.increments["increment"], np.arange(17))
    np.testing.assert_array_equal(history.increments["stage"], [0] + [1] * 16)
    assert history.stages == ["indent", "fretting"]
    assert set(history.increments["regime"]) <= {"full_stick", "partial_slip", "gross_slip"}


def test_fields_are_nx_by_ny_and_the_callers_own(history: fretting.History) -> None:
    for name in sorted(
        {*get_args(FieldName)}
        - {"worn_depth", "lower_worn_depth", "upper_worn_depth", "debris", "plastic_depth", "friction_work", "friction"}
    ):  # not asked for here
        field = history.field(name)
        assert field.shape == (32, 24), name
        assert field.dtype == (np.uint8 if name == "zone" else np.float64), name
        field[...] = 1
        assert not (history.field(name) == 1).all(), name
    assert set(np.unique(history.field("zone"))) <= {0, 1, 2}


def test_cell_centres_lie_about_the_first_point_of_touch(history: fretting.History) -> None:
    assert history.shape == (32, 24)
    np.testing.assert_allclose(history.x, (np.arange(32) - 15.5) * (300e-6 / 32), rtol=1e-14)
    np.testing.assert_allclose(history.y, (np.arange(24) - 11.5) * (300e-6 / 24), rtol=1e-14)


def test_steps_count_from_either_end(history: fretting.History) -> None:
    np.testing.assert_array_equal(history.field("pressure", -1), history.field("pressure", 16))
    assert 0 in history.kept_increments  # the last of a stage
    assert 16 in history.kept_increments
    with pytest.raises(IndexError, match="17 increments"):
        history.field("pressure", 17)
    with pytest.raises(IndexError, match="17 increments"):
        history.field("pressure", -18)


def test_what_was_not_kept_says_what_was(fretting_case: dict[str, Any]) -> None:
    fretting_case["grid"]["cells"] = [24, 24]
    fretting_case["output"] = {"fields": ["pressure"]}
    history = fretting.run(fretting_case)
    assert history.kept_increments == [0, 16]
    with pytest.raises(KeyError, match="kept are those of 0, 16"):
        history.field("pressure", 3)
    with pytest.raises(KeyError, match="zone is not kept; kept are: pressure"):
        history.field("zone")
    with pytest.raises(KeyError, match="no field is called 'presure'"):
        history.field("presure")  # type: ignore[arg-type]


def test_repr_tells_sizes_and_what_is_kept(history: fretting.History) -> None:
    text = repr(history)
    assert "17 increments, 32 x 24 cells, stages: indent, fretting" in text
    assert "pressure, shear_x" in text


def test_dataset_has_all_increments_the_kept_fields_and_the_cycles(history: fretting.History) -> None:
    pytest.importorskip("xarray")
    data = history.to_xarray()
    assert dict(data.sizes) == {
        "increment": 17,
        "kept_increment": len(history.kept_increments),
        "x": 32,
        "y": 24,
        "cycle": 1,
    }
    np.testing.assert_array_equal(data["normal_force"].values, history.increments["normal_force"])
    assert list(data["kept_increment"].values) == history.kept_increments
    np.testing.assert_array_equal(
        data["pressure"].sel(kept_increment=16).transpose("x", "y").values, history.field("pressure")
    )
    assert data["stage_name"].values.tolist() == ["indent"] + 16 * ["fretting"]
    assert data["stage"].values.tolist() == history.increments["stage"].tolist()
    assert data["cycle_energy_ratio"].values.tolist() == history.cycles["energy_ratio"].tolist()
    assert (data["cycle_number"].item(), data["cycle_stage_name"].item()) == (1, "fretting")
    zone = data["zone"]
    assert zone.dtype == zone.attrs["flag_values"].dtype == np.dtype(np.uint8)
    assert (zone.attrs["flag_values"].tolist(), zone.attrs["flag_meanings"]) == ([0, 1, 2], "open stick slip")
    kept = history.to_xarray(increments="kept")
    assert list(kept["increment"].values) == history.kept_increments
    assert kept["pressure"].dims == ("increment", "y", "x")
    np.testing.assert_array_equal(kept["approach"].values, history.increments["approach"][history.kept_increments])


def test_a_map_of_a_dataset_has_x_to_the_right(history: fretting.History) -> None:
    pytest.importorskip("xarray")
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    mesh = history.to_xarray()["shear_x"].isel(kept_increment=-1).plot.pcolormesh()
    assert mesh.axes is not None
    assert mesh.axes.get_xlabel().startswith("cell centres along x")
    np.testing.assert_array_equal(np.asarray(mesh.get_array()).reshape(24, 32), history.field("shear_x").T)
    matplotlib.pyplot.close("all")


@pytest.mark.long
def test_a_long_history_with_few_kept_fields_makes_a_small_dataset(tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    case = {
        "grid": {"cells": [256, 256], "size": [4e-3, 4e-3]},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
        "profile": {"sphere": {"radius": 10e-3}},
        "load": [{"normal_force": 12.0, "increments": 300}],
        "output": {"fields": ["pressure", "zone"]},
    }
    history = fretting.run(case)
    data = history.to_xarray()
    fields, columns = 256 * 256 * (8 + 1), 300 * 40 * 20  # at most 40 numbers and words of 20 bytes an increment
    assert fields < data.nbytes < fields + columns
    if importlib.util.find_spec("netCDF4") or importlib.util.find_spec("h5netcdf"):
        data.to_netcdf(tmp_path / "history.nc")
        assert (tmp_path / "history.nc").stat().st_size < 1.2 * (fields + columns)
        xarray = pytest.importorskip("xarray")
        with xarray.open_dataset(tmp_path / "history.nc") as again:
            assert again["zone"].dtype == np.uint8
            assert again["zone"].attrs["flag_values"].tolist() == [0, 1, 2]
            np.testing.assert_array_equal(again["pressure"].values, data["pressure"].values)


def test_history_survives_pickling(history: fretting.History) -> None:
    again = pickle.loads(pickle.dumps(history))
    assert repr(again) == repr(history)
    assert again.kept_increments == history.kept_increments
    for name in sorted(
        {*get_args(FieldName)}
        - {"worn_depth", "lower_worn_depth", "upper_worn_depth", "debris", "plastic_depth", "friction_work", "friction"}
    ):  # not asked for here
        np.testing.assert_array_equal(again.field(name, 4), history.field(name, 4))
    for name, column in history.increments.items():
        np.testing.assert_array_equal(again.increments[name], column)


def test_progress_is_told_after_every_increment(
    sphere_case: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    sphere_case["grid"]["cells"] = [16, 16]
    sphere_case["load"][0]["increments"] = 3
    heard: list[dict[str, Any]] = []
    history = fretting.run(sphere_case, progress=heard.append)
    assert [step["increment"] for step in heard] == [0, 1, 2]
    assert all(step["increments"] == 3 for step in heard)
    assert [step["normal_force"] for step in heard] == list(history.increments["normal_force"])
    fretting.run(sphere_case, progress=True)
    assert "increment 2  " in capsys.readouterr().err


class Gone:
    """A stderr whose terminal has gone away."""

    def isatty(self) -> bool:
        """It was one."""
        return True

    def write(self, text: str) -> int:
        """Nobody reads it."""
        raise BrokenPipeError

    def flush(self) -> None:
        """Nobody reads it."""
        raise BrokenPipeError


def closed() -> io.StringIO:
    stream = io.StringIO()
    stream.close()
    return stream


@pytest.mark.parametrize("stderr", [None, Gone(), closed()], ids=["none, as under pythonw", "gone", "closed"])
def test_a_run_goes_on_where_its_progress_cannot_be_told(
    sphere_case: dict[str, Any], monkeypatch: pytest.MonkeyPatch, stderr: Any
) -> None:
    sphere_case["grid"]["cells"] = [16, 16]
    monkeypatch.setattr("sys.stderr", stderr)
    assert fretting.run(sphere_case, progress=True).finished
    pytest.importorskip("xarray")
    assert fretting.sweep(sphere_case, {"load.0.normal_force": [6.0, 12.0]}, progress=True)["approach"].size == 2


def test_what_progress_raises_ends_the_run(sphere_case: dict[str, Any]) -> None:
    sphere_case["grid"]["cells"] = [16, 16]
    sphere_case["load"][0]["increments"] = 5
    heard = []

    def stop(step: dict[str, Any]) -> None:
        heard.append(step)
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        fretting.run(sphere_case, progress=stop)
    assert len(heard) == 1


def test_a_run_may_be_started_while_another_tells_its_progress(sphere_case: dict[str, Any]) -> None:
    """With one worker thread, which is the one that waits."""
    sphere_case["grid"]["cells"] = [16, 16]
    product = fretting.Convolution(np.ones((4, 4)))
    inner = []

    def run_another(step: dict[str, Any]) -> None:
        inner.append(
            fretting.run(sphere_case, threads=1).increments["approach"][-1] + 0.0 * product(np.ones((4, 4))).sum()
        )

    outer = fretting.run(sphere_case, threads=1, progress=run_another)
    assert inner == [outer.increments["approach"][-1]]


def test_bad_thread_counts_are_refused(sphere_case: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="threads = 0"):
        fretting.run(sphere_case, threads=0)

"""A folder that ``fret run`` has written, opened as a history."""

import json
import pickle
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
from fretting.__main__ import main

CASE = """
title = "to and fro"
[grid]
cells = [20, 24]
size = [220e-6, 264e-6]
[upper]
rigid = true
[lower]
substrate = { young = 210e9, poisson = 0.3 }
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.1
[[load]]
name = "press"
normal_force = 1.0
increments = 2
[[load]]
name = "rub"
tangential_force = [0.05, 0.0]
cycles = 2
increments = 8
[output]
fields = ["pressure", "shear", "slip", "gap", "zone"]
every = 4
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("load")
    (place / "case.toml").write_text(CASE)
    assert main(["run", str(place / "case.toml"), "--out", str(place / "run"), "--quiet"]) == 0
    return place / "run"


@pytest.fixture
def copy(folder: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(folder, tmp_path / "run"))


def test_a_loaded_history_is_the_one_a_run_gives(folder: Path) -> None:
    run, loaded = fretting.run(CASE), fretting.open_results(folder)
    assert loaded.stages == run.stages
    assert set(loaded.increments) == set(run.increments)
    for name, column in run.increments.items():
        assert loaded.increments[name].dtype.kind == column.dtype.kind, name
        if name != "wall_s":
            np.testing.assert_array_equal(loaded.increments[name], column, err_msg=name)
    for name, column in run.cycles.items():
        assert loaded.cycles[name].dtype.kind == column.dtype.kind, name
        np.testing.assert_array_equal(loaded.cycles[name], column, err_msg=name)
    assert loaded.running_conditions == run.running_conditions
    assert loaded.worn_through == run.worn_through
    np.testing.assert_array_equal(loaded.x, run.x)
    np.testing.assert_array_equal(loaded.y, run.y)
    assert loaded.kept_increments == run.kept_increments
    for step in run.kept_increments:
        for name in ("pressure", "shear_x", "shear_y", "slip_x", "slip_y", "gap", "zone"):
            field, solved = (history.field(name, step) for history in (loaded, run))  # type: ignore[arg-type]
            assert field.dtype == solved.dtype
            np.testing.assert_array_equal(field, solved, err_msg=name)
    assert repr(loaded) == repr(run)
    stress = [history.subsurface([0.0, 20e-6])["von_mises"] for history in (loaded, run)]
    np.testing.assert_array_equal(stress[0], stress[1])


def test_a_pickled_history_does_without_its_folder(copy: Path) -> None:
    text = pickle.dumps(fretting.open_results(copy))
    field = fretting.open_results(copy).field("pressure")
    shutil.rmtree(copy)
    again = pickle.loads(text)
    np.testing.assert_array_equal(again.field("pressure"), field)
    with pytest.raises(KeyError, match="columns are: increment"):
        again.increments["presure"]


def test_fields_are_found_from_another_current_folder(copy: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(copy.parent)
    history, expected = fretting.open_results(copy.name), fretting.open_results(copy).field("pressure")
    monkeypatch.chdir("/")
    np.testing.assert_array_equal(history.field("pressure"), expected)


def test_a_folder_that_is_gone_is_named_when_its_history_is_saved(copy: Path, tmp_path: Path) -> None:
    history = fretting.open_results(copy)
    shutil.rmtree(copy)
    with pytest.raises(fretting.MissingFileError, match=f"{re.escape(str(copy))}: no such folder") as refused:
        history.save(tmp_path / "other")
    assert refused.value.path == str(copy)
    assert not (tmp_path / "other").exists()


def test_what_is_no_run_is_refused(tmp_path: Path) -> None:
    with pytest.raises(fretting.MissingFileError, match="no such folder"):
        fretting.open_results(tmp_path / "nowhere")
    with pytest.raises(fretting.UnreadableError, match=r"has no run\.json"):
        fretting.open_results(tmp_path)


def test_a_run_that_failed_opens_as_what_there_is(tmp_path: Path) -> None:
    # Pressed by an approach, so that only the run finds out that friction does not carry the force.
    case = CASE.replace("normal_force = 1.0", "approach = 70e-9")
    (tmp_path / "case.toml").write_text(case.replace("[0.05, 0.0]", "[9.0, 0.0]").replace("every = 4", "every = 1"))
    assert main(["run", str(tmp_path / "case.toml"), "--out", str(tmp_path / "run"), "--quiet"]) == 1
    history = fretting.open_results(tmp_path / "run")
    assert (history.finished, history.status, len(history)) == (False, "refused", 2)
    assert history.message is not None
    assert "increment 2 (rub): tangential force" in history.message
    assert "not the whole history: refused: increment 2" in repr(history)
    whole = fretting.run(case)
    np.testing.assert_array_equal(history.increments["approach"], whole.increments["approach"][:2])
    assert history.kept_increments == [0, 1]
    np.testing.assert_array_equal(history.field("pressure"), whole.field("pressure", 1))
    assert np.abs(history.subsurface([20e-6])["von_mises"]).max() > 0.0
    assert len(history.cycles["cycle"]) == 0
    assert (
        len(fretting.run(case.partition("[[load]]")[0] + case[case.index('[[load]]\nname = "rub"') :], start=history))
        == 16
    )


def test_a_run_that_was_killed_opens_as_what_there_is(copy: Path) -> None:
    """A kill leaves the record of a running run, a torn line, fields and a cycle beyond it; the store's steps stand
    from the start.
    """
    whole = fretting.open_results(copy)
    record = json.loads((copy / "run.json").read_text())
    del record["totals"]
    (copy / "run.json").write_text(json.dumps({**record, "status": "running", "message": None}))
    lines = (copy / "history.csv").read_text().splitlines(keepends=True)
    (copy / "history.csv").write_text("".join(lines[:9]) + lines[9][:20])
    history = fretting.open_results(copy)
    assert (history.finished, history.status, len(history)) == (False, "running", 8)
    np.testing.assert_array_equal(history.increments["shift_x"], whole.increments["shift_x"][:8])
    assert history.kept_increments == [step for step in whole.kept_increments if step < 8]
    np.testing.assert_array_equal(history.field("zone", 5), whole.field("zone", 5))
    assert len(history.cycles["cycle"]) == 0


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-9])


def _poison(path: Path) -> None:
    numbers = np.frombuffer(path.read_bytes(), dtype=np.uint8).copy()
    numbers[:8] = 255  # a double with all bits set is not a number; a zone of 255 is none
    path.write_bytes(numbers.tobytes())


@pytest.mark.parametrize("spoil", [_cut, _poison, Path.unlink])
@pytest.mark.parametrize(
    "name",
    ["run.json", "history.csv", "cycles.csv", "fields.zarr/x/c/0", "fields.zarr/increment/c/0",
     "fields.zarr/pressure/c/0/0/0", "fields.zarr/zone/c/0/0/0"],
)  # fmt: skip
def test_a_damaged_folder_is_refused_never_half_read(copy: Path, name: str, spoil: Any) -> None:
    spoil(copy / name)
    with pytest.raises(fretting.UnreadableError, match="error: ") as refused:  # noqa: PT012  on opening or on reading
        history = fretting.open_results(copy)
        history.field("pressure", history.kept_increments[0])
        history.field("zone", history.kept_increments[0])
    assert name.partition("/c/")[0] in str(refused.value) or "run.json" in str(refused.value)


def test_a_name_that_steps_do_not_have_is_answered_with_those_they_have(folder: Path) -> None:
    steps = fretting.open_results(folder).increments
    with pytest.raises(KeyError, match=r"history\.field\('pressure', increment\)"):
        steps["pressure"]
    with pytest.raises(KeyError, match=r"columns are: increment, .*max_pressure"):
        steps["presure"]
    assert steps.get("presure") is None

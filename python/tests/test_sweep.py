"""Many cases: every point is what `run` alone gives, wherever it is solved, and a stopped sweep goes on."""

import concurrent.futures
import copy
import json
import multiprocessing
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting

pytest.importorskip("xarray")

FRICTION, FORCE = "friction.coefficient", "load.fretting.tangential_force.0"
AXES = {FRICTION: [0.2, 0.4], FORCE: [0.5, 1.0, 1.5]}


@pytest.fixture
def case(fretting_case: dict[str, Any]) -> dict[str, Any]:
    fretting_case["grid"]["cells"] = [20, 20]
    fretting_case["load"][1]["increments"] = 8
    del fretting_case["output"]
    return fretting_case


def changed(case: dict[str, Any], friction: float, force: float) -> dict[str, Any]:
    case = copy.deepcopy(case)
    case["friction"]["coefficient"] = friction
    case["load"][1]["tangential_force"][0] = force
    return case


def energy_outside(history: fretting.History) -> dict[str, Any]:
    """Measured on fields, so that it must have been done where the history was."""
    return {"row": history.field("pressure").sum(axis=0), "half": 0.5 * history.increments["dissipated_energy"][-1]}


@pytest.fixture
def alone(case: dict[str, Any]) -> np.ndarray[Any, Any]:
    """Dissipated energy of every point, each run by itself."""
    energies = [[fretting.run(changed(case, mu, q)).increments["dissipated_energy"][-1] for q in AXES[FORCE]]
                for mu in AXES[FRICTION]]  # fmt: skip
    return np.asarray(energies)


EXECUTORS: dict[str, Callable[[], concurrent.futures.Executor | None]] = {
    "none": lambda: None,
    "threads": lambda: concurrent.futures.ThreadPoolExecutor(2),
    "spawned processes": lambda: concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("spawn")),
}


@pytest.mark.parametrize("kind", EXECUTORS)
def test_every_point_is_what_a_run_alone_gives(case: dict[str, Any], alone: np.ndarray[Any, Any], kind: str) -> None:
    """To the last bit: results do not depend on threads or on the process."""
    executor = EXECUTORS[kind]()
    answer = fretting.sweep(case, AXES, executor=executor)
    if executor:
        executor.shutdown()
    assert answer["dissipated_energy"].dims == (FRICTION, FORCE)
    np.testing.assert_array_equal(answer["dissipated_energy"].values, alone)
    np.testing.assert_array_equal(answer[FORCE].values, AXES[FORCE])
    assert (answer["status"] == "solved").all()
    assert (answer["error"] == "").all()
    # A cycle's dissipated energy is what the history gained in it: here all of it, pressing alone loses nothing.
    np.testing.assert_allclose(answer["cycle_dissipated_energy"].values, alone, rtol=1e-12)
    # Three points of each friction begin with the same indentation: solved once, in this process.
    pressing = case["load"][0]["increments"]
    assert answer.attrs["increments_in_common"] == (0 if "processes" in kind else 6 * pressing)
    # Forces are held to the tolerance of the case, 1e-8.
    np.testing.assert_allclose(answer["cycle_force_amplitude"].values[0], AXES[FORCE], rtol=1e-7)


FORKED = """
import concurrent.futures, multiprocessing, fretting
CASE = {
    "grid": {"cells": [16, 16], "size": [240e-6, 240e-6]},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    "profile": {"sphere": {"radius": 10e-3}},
    "load": [{"normal_force": 12.0, "increments": 1}],
}
AXES = {"load.0.normal_force": [4.0, 8.0, 12.0]}
here = fretting.sweep(CASE, AXES)["approach"].values.tolist()
with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as executor:
    there = fretting.sweep(CASE, AXES, executor=executor)["approach"].values.tolist()
assert there == here, (there, here)
print("done")
"""


@pytest.mark.long
@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_sweep_in_forked_processes_after_a_solve_of_the_parent() -> None:
    """Worker threads do not survive a fork: a child that waited for them would hang."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore::DeprecationWarning", "-c", FORKED],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "done\n"), done.stderr


def test_a_sweep_on_a_dask_cluster(case: dict[str, Any], alone: np.ndarray[Any, Any]) -> None:
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        answer = fretting.sweep(case, AXES, executor=client.get_executor())
    np.testing.assert_array_equal(answer["dissipated_energy"].values, alone)


MPI = """
import sys, numpy as np, fretting
from mpi4py.futures import MPIPoolExecutor
CASE, AXES = {case!r}, {axes!r}
if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        assert executor.num_workers == 2
        answer = fretting.sweep(CASE, AXES, executor=executor)
    print(answer["dissipated_energy"].values.tolist())
"""


@pytest.mark.long
def test_a_sweep_on_mpi(case: dict[str, Any], alone: np.ndarray[Any, Any], tmp_path: Path) -> None:
    pytest.importorskip("mpi4py")
    launcher = Path(sys.executable).parent / "mpiexec"
    if not launcher.exists():
        pytest.skip("no mpiexec beside this Python")
    script = tmp_path / "mpi_sweep.py"
    script.write_text(MPI.format(case=case, axes=AXES))
    done = subprocess.run(
        [launcher, "-n", "3", sys.executable, "-m", "mpi4py.futures", script],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == alone.tolist()


def test_points_that_fail_are_recorded_and_the_others_solved(case: dict[str, Any]) -> None:
    def press(case: dict[str, Any], approach: float) -> None:
        case["load"][0] = {"approach": approach, "increments": 1 if approach > 0.0 else 0}

    # What force an approach makes is not known before: at 10 nm it cannot carry the tangential one.
    answer = fretting.sweep(case, {"depth": fretting.Parameter([-1e-6, 1e-8, 1e-6], press)})
    assert answer["status"].values.tolist() == ["refused", "failed", "solved"]
    assert np.isnan(answer["normal_force"].values[:2]).all()
    assert answer["increment"].values.tolist() == [-1, -1, 8]
    assert answer["regime"].values.tolist()[:2] == ["", ""]
    press(case, 1e-8)
    with pytest.raises(fretting.RunError) as alone:
        fretting.run(case)
    assert str(answer["error"].values[1]) == str(alone.value)


def test_a_sweep_of_refused_points_only_is_refused(case: dict[str, Any]) -> None:
    with pytest.raises(fretting.CaseError, match=r"all 2 points .* refused; the first:\n(.|\n)*coeficient") as refused:
        fretting.sweep(case, {"friction.coeficient": [0.1, 0.2]})
    assert refused.value.mistakes[0].message.startswith("unknown key `coeficient`")


@pytest.mark.parametrize(
    ("axes", "message"),
    [
        ({"load.7.normal_force": [1.0]}, "load has 2 entries, from 0; there is no 7"),
        ({"load.fretten.normal_force": [1.0]}, "no entry of load is called 'fretten' ('indent', 'fretting')"),
        ({"friction.coefficient.x": [1.0]}, "friction.coefficient is 0.2, which has no entry 'x'"),
        ({FRICTION: []}, "has no values"),
        ({FRICTION: 0.1}, "expected a list of values, found float"),
        ({FRICTION: [0.1, float("nan")]}, "must be finite"),
        ({(FRICTION, FORCE): [(0.1,)]}, "value 0 must hold 2 values"),
        ({}, "at least one"),
        ([], "the list of points is empty"),
        ([{FRICTION: 0.1}, {FORCE: 0.1}], "point 1 has the keys"),
        ({"approach": fretting.Parameter([1e-6], lambda case, value: None)}, "a variable of the result has this name"),
        ("friction", "expected a mapping or a list of mappings, found str"),
        ({"load[7].normal_force": [1.0]}, "load has 2 entries, from 0; there is no 7"),
        ({"": [1.0]}, "unknown key ``"),
        ({"load[0].normal_force": [1.0], "load.indent.normal_force": [2.0]}, "are one place of the case"),
        ({"load[0]..normal_force": [1.0]}, "unknown key ``"),
    ],
)
def test_mistaken_axes_are_refused_before_any_work(case: dict[str, Any], axes: Any, message: str) -> None:
    with pytest.raises((ValueError, TypeError)) as refused:
        fretting.sweep(case, axes)
    assert message in str(refused.value)


def test_axes_may_be_keys_that_change_together_functions_or_points(case: dict[str, Any]) -> None:
    together = fretting.sweep(case, {(FRICTION, FORCE): [(0.2, 0.5), (0.4, 1.0)]})
    name = f"{FRICTION}, {FORCE}"
    assert dict(together.sizes) == {name: 2}
    np.testing.assert_array_equal(together[FRICTION].values, [0.2, 0.4])

    def both(case: dict[str, Any], scale: float) -> None:
        case["friction"]["coefficient"] = 0.2 * scale
        case["load"][1]["tangential_force"] = [0.5 * scale, 0.0]

    by_function = fretting.sweep(case, {"scale": fretting.Parameter([1.0, 2.0], both)})
    by_points = fretting.sweep(case, [{FRICTION: 0.2, FORCE: 0.5}, {FRICTION: 0.4, FORCE: 1.0}])
    assert dict(by_points.sizes) == {"point": 2}
    for other in (by_function, by_points):
        np.testing.assert_array_equal(other["dissipated_energy"].values, together["dissipated_energy"].values)
    lists = fretting.sweep(case, {"load.1.tangential_force": [[0.5, 0.0], [0.0, 0.5]]})
    assert lists["load.1.tangential_force_values"].values.tolist() == ["[0.5, 0.0]", "[0.0, 0.5]"]


def test_histories_are_kept_as_asked(case: dict[str, Any]) -> None:
    history = fretting.run(case)
    every = fretting.sweep(case, {FRICTION: [0.2]}, keep="all")
    np.testing.assert_array_equal(every["shift_x"].values[0], history.increments["shift_x"])
    stages = fretting.sweep(case, {FRICTION: [0.2]}, keep="stages")
    np.testing.assert_array_equal(stages["increment"].values[0], [0, 8])
    with pytest.raises(ValueError, match="keep = 'lots'"):
        fretting.sweep(case, AXES, keep="lots")  # type: ignore[arg-type]


def test_what_is_measured_becomes_a_variable(case: dict[str, Any]) -> None:
    answer = fretting.sweep(case, {FRICTION: [0.2, 0.4]}, measure=energy_outside)
    assert answer["row"].dims == (FRICTION, "row_0")
    np.testing.assert_array_equal(answer["half"].values, 0.5 * answer["dissipated_energy"].values)
    np.testing.assert_array_equal(answer["row"].values[0], fretting.run(case).field("pressure").sum(axis=0))


def test_a_folder_keeps_finished_points(case: dict[str, Any], tmp_path: Path) -> None:
    told: list[dict[str, Any]] = []
    folder = tmp_path / "sweep"

    def stop_after_two(news: dict[str, Any]) -> None:
        told.append(news)
        if news["done"] == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fretting.sweep(case, AXES, folder=folder, progress=stop_after_two)
    assert len(list((folder / "points").iterdir())) == 2
    told.clear()
    rest = fretting.sweep(case, AXES, folder=folder, progress=told.append)
    assert [news["done"] for news in told] == [3, 4, 5, 6]
    assert rest.attrs["solved_before"] == 2
    again = fretting.sweep(case, AXES, folder=folder)
    assert again.attrs["solved_before"] == 6
    whole = fretting.sweep(case, AXES)
    for name in whole.data_vars:
        if name != "wall_s":
            np.testing.assert_array_equal(again[name].values, whole[name].values, err_msg=str(name))
    assert not list(folder.rglob("*.part"))
    # More values of an axis need only the new points.
    more = fretting.sweep(case, {**AXES, FRICTION: [0.2, 0.3, 0.4]}, folder=folder)
    assert more.attrs["solved_before"] == 6


def test_only_solved_points_count_as_solved_before(case: dict[str, Any], tmp_path: Path) -> None:
    """Two of the three: the third is refused, found again, and not solved."""
    axes = {FRICTION: [0.2, -0.1, 0.4]}
    fretting.sweep(case, axes, folder=tmp_path)
    assert len(list((tmp_path / "points").iterdir())) == 3
    again = fretting.sweep(case, axes, folder=tmp_path)
    assert again.attrs["solved_before"] == 2
    assert sorted(again["status"].values.tolist()) == ["refused", "solved", "solved"]


def test_a_changed_base_case_and_a_damaged_file_are_noticed(case: dict[str, Any], tmp_path: Path) -> None:
    axes = {FRICTION: [0.2, 0.4]}
    first = fretting.sweep(case, axes, folder=tmp_path)
    stiffer = copy.deepcopy(case)
    stiffer["lower"]["substrate"]["young"] *= 2.0
    with pytest.warns(UserWarning, match="the base case has changed"):
        second = fretting.sweep(stiffer, axes, folder=tmp_path)
    assert second.attrs["solved_before"] == 0
    assert (second["approach"].values < first["approach"].values).all()
    for damaged in (tmp_path / "points").iterdir():
        damaged.write_bytes(damaged.read_bytes()[:40])
    third = fretting.sweep(stiffer, axes, folder=tmp_path)
    assert third.attrs["solved_before"] == 0
    np.testing.assert_array_equal(third["approach"].values, second["approach"].values)


def test_a_changed_file_of_a_case_makes_other_points(case: dict[str, Any], tmp_path: Path) -> None:
    strength = tmp_path / "strength.npy"
    case["friction"]["max_shear"] = str(strength)

    def solved_before(value: float) -> int:
        np.save(strength, np.full((20, 20), value))
        answer = fretting.sweep(case, {FORCE: [0.5]}, folder=tmp_path / "points")
        return int(answer.attrs["solved_before"])

    assert [solved_before(1e12), solved_before(1e12)] == [0, 1]
    with pytest.warns(UserWarning, match="the base case has changed"):
        assert solved_before(5e7) == 0


def test_an_array_of_strengths_is_that_of_its_file(case: dict[str, Any], tmp_path: Path) -> None:
    values = np.linspace(8e7, 1.2e8, 400).reshape(20, 20)
    np.save(tmp_path / "strength.npy", values)
    given, read = (
        fretting.run({**case, "friction": {**case["friction"], "max_shear": strength}}).field("shear_x")
        for strength in (values, str(tmp_path / "strength.npy"))
    )
    np.testing.assert_array_equal(given, read)


def test_a_folder_of_other_things_is_left_alone(case: dict[str, Any], tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(FileExistsError, match="holds files that are no sweep"):
        fretting.sweep(case, AXES, folder=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_progress_is_told(case: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    fretting.sweep(case, {FRICTION: [-1.0, 0.4]}, progress=True)
    assert "point 2/2  1 failed" in capsys.readouterr().err


def test_a_parameter_has_a_short_name(case: dict[str, Any]) -> None:
    answer = fretting.sweep(case, {"mu": fretting.Parameter([0.2, 0.4], FRICTION)})
    assert answer["approach"].dims == ("mu",)
    by_key = fretting.sweep(case, {FRICTION: [0.2, 0.4]})
    np.testing.assert_array_equal(answer["dissipated_energy"].values, by_key["dissipated_energy"].values)


def test_keys_are_read_as_the_program_prints_them(case: dict[str, Any]) -> None:
    case["lower"] = {"coatings": [{"thickness": 1e-5, "young": 300e9, "poisson": 0.0}], **case["lower"]}
    case["units"] = {"length": "m", "force": "N"}
    keys = "lower.coatings[0].young", "load[1].tangential_force[0]"
    printed = fretting.sweep(case, {keys[0]: [250e9, 350e9], keys[1]: [1.0, 2.0]})
    dotted = fretting.sweep(case, {"lower.coatings.0.young": [250e9, 350e9], FORCE: [1.0, 2.0]})
    np.testing.assert_array_equal(printed["dissipated_energy"].values, dotted["dissipated_energy"].values)
    assert printed["dissipated_energy"].dims == keys
    assert [printed[key].attrs["units"] for key in keys] == ["Pa", "N"]
    # a stage may be called as the number of another one is written
    case["load"][1]["name"] = "rub[0]"
    named = fretting.sweep(case, {"load.rub[0].tangential_force[0]": [1.0, 2.0]})
    by_number = fretting.sweep(case, {keys[1]: [1.0, 2.0]})
    np.testing.assert_array_equal(named["dissipated_energy"].values, by_number["dissipated_energy"].values)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (3, "must return a mapping from names to numbers, .* it returned int"),
        (None, "it returned NoneType"),
        ("peak", "it returned str"),
        ({1: 2.0}, "a name is a str, and 1 is int"),
    ],
)
def test_what_measure_must_return_is_said(case: dict[str, Any], given: Any, words: str) -> None:
    with pytest.raises(TypeError, match=f"^measure: .*{words}"):
        fretting.sweep(case, {FRICTION: [0.2]}, measure=lambda history: given)


def test_arguments_of_another_kind_are_refused_by_their_names(case: dict[str, Any]) -> None:
    for name in ("executor", "measure", "keep", "indices", "progress", "threads"):
        for value in ("x", 3.5, np.zeros((2, 2))):
            odd: dict[str, Any] = {name: value}
            with pytest.raises((TypeError, ValueError), match=name):
                fretting.sweep(case, {FRICTION: [0.2]}, **odd)
    with pytest.raises(TypeError, match="found the class ThreadPoolExecutor"):
        fretting.sweep(case, {FRICTION: [0.2]}, executor=concurrent.futures.ThreadPoolExecutor)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="apply: expected a key of the case or a function, found int"):
        fretting.Parameter([0.2], 3)  # type: ignore[arg-type]


def test_a_mistake_in_what_is_measured_ends_the_sweep_at_its_first_point(case: dict[str, Any]) -> None:
    told: list[dict[str, Any]] = []

    def mistaken(history: fretting.History) -> dict[str, Any]:
        return {"x": undefined_name}  # type: ignore[name-defined]  # noqa: F821

    with pytest.raises(NameError, match="undefined_name") as raised:
        fretting.sweep(case, {FRICTION: [0.2, 0.3, 0.4]}, measure=mistaken, progress=told.append)
    assert "at the first point that is solved: friction.coefficient = 0.2" in raised.value.__notes__[0]
    assert not told
    with concurrent.futures.ThreadPoolExecutor(2) as executor, pytest.raises(NameError):
        fretting.sweep(case, {FRICTION: [0.2, 0.3]}, measure=mistaken, executor=executor)


def test_an_endless_life_is_an_answer(case: dict[str, Any], tmp_path: Path) -> None:
    def life(history: fretting.History) -> dict[str, Any]:
        endless = history.case["friction"]["coefficient"] < 0.25
        return {"cycles": np.inf if endless else 2e5, "row": np.array([1.0, -np.inf if endless else 3.0])}

    for solved_before in (0, 2):
        answer = fretting.sweep(case, {FRICTION: [0.2, 0.3]}, measure=life, folder=tmp_path / "sweep")
        assert answer.attrs["solved_before"] == solved_before
        np.testing.assert_array_equal(answer["cycles"].values, [np.inf, 2e5])
        np.testing.assert_array_equal(answer["row"].values, [[1.0, -np.inf], [1.0, 3.0]])
    with pytest.raises(ValueError, match="measure: cycles is not a number everywhere"):
        fretting.sweep(case, {FRICTION: [0.4]}, measure=lambda _: {"cycles": np.nan})


def test_where_nothing_is_measured_the_other_numbers_stay(case: dict[str, Any], tmp_path: Path) -> None:
    mend = False

    def unsure(history: fretting.History) -> dict[str, Any]:
        friction = history.case["friction"]["coefficient"]
        if friction == 0.3 and not mend:
            raise RuntimeError("not here")
        return {"twice": 2.0 * friction, "word": f"mu {friction}", "row": np.ones(3)}

    axes = {FRICTION: [0.2, 0.3, 0.4]}
    with pytest.warns(fretting.FrettingWarning, match=r"measure failed at 1 of 3 points.*0.3: RuntimeError: not here"):
        answer = fretting.sweep(case, axes, measure=unsure, folder=tmp_path / "sweep")
    assert answer["status"].values.tolist() == ["solved"] * 3
    assert np.isfinite(answer["dissipated_energy"].values).all()
    np.testing.assert_array_equal(answer["twice"].values, [0.4, np.nan, 0.8])
    assert answer["word"].values.tolist() == ["mu 0.2", "", "mu 0.4"]
    assert answer["row"].shape == (3, 3)
    assert answer["error"].values[1] == "measure: RuntimeError: not here"
    # A point that was not measured is not finished: once the mistake is corrected it is solved again, and alone.
    mend = True
    again = fretting.sweep(case, axes, measure=unsure, folder=tmp_path / "sweep")
    assert again.attrs["solved_before"] == 2
    np.testing.assert_array_equal(again["twice"].values, [0.4, 0.6, 0.8])


def test_a_sweep_without_a_solved_point_raises(case: dict[str, Any]) -> None:
    beyond = {
        **case,
        "grid": {"cells": [16, 16], "size": [1e-6, 1e-6]},
        "profile": {"heights": {"values": np.zeros((16, 16)).tolist()}},
    }
    with pytest.raises(fretting.RunError, match=r"(?s)none of the 2 points .* edge of the grid"):
        fretting.sweep(beyond, {FRICTION: [0.2, 0.3]})


def test_declared_units_reach_the_dataset_of_a_sweep(case: dict[str, Any]) -> None:
    answer = fretting.sweep({**case, "units": {"length": "m", "force": "N"}}, {FRICTION: [0.2, 0.3]})
    assert answer["max_pressure"].attrs["units"] == "Pa"
    assert answer["cycle_dissipated_energy"].attrs == {
        "long_name": "last cycle: dissipated energy W_d of this simulated cycle", "units": "N m",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("motion", "units"),
    [({"shift": [1e-7, 0.0]}, ("N", "m", "N/m")), ({"twist": 1e-3}, ("N m", "rad", "N m"))],
)
def test_axes_amplitudes_and_stiffness_have_their_units(
    case: dict[str, Any], motion: dict[str, Any], units: tuple[str, str, str]
) -> None:
    press, rub = case["load"][:2]
    rub = {"name": "rub", **motion, "cycles": 1, "increments": 8}
    declared = {**case, "units": {"length": "m", "force": "N"}, "load": [press, rub]}
    force, twist = "load.0.normal_force", next(iter(motion))
    answer = fretting.sweep(
        declared,
        {
            force: [0.9 * press["normal_force"], press["normal_force"]],
            FRICTION: [0.2, 0.3],
            "named": fretting.Parameter([9e-3, 10e-3], "profile.sphere.radius"),
        },
    )
    assert answer[force].attrs == {"units": "N"}
    assert answer["named"].attrs == {"units": "m"}
    assert answer[FRICTION].attrs == {}
    names = ("cycle_force_amplitude", "cycle_displacement_amplitude", "cycle_stiffness")
    assert tuple(answer[name].attrs["units"] for name in names) == units, twist
    alone = fretting.run(declared).to_xarray()
    assert tuple(alone[name].attrs["units"] for name in names) == units
    pytest.importorskip("matplotlib").use("Agg")
    axes = fretting.plot.regime_map(answer.isel(named=0), x=FRICTION, y=force)
    assert (axes.get_xlabel(), axes.get_ylabel()) == (FRICTION, f"{force} [N]")
    # without units the kinds of quantities are told in words
    del declared["units"]
    plain = fretting.sweep(declared, {FRICTION: [0.2]})
    assert plain["cycle_force_amplitude"].attrs["long_name"].endswith(("[force]", "[force x length]"))

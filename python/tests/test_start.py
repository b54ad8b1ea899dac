"""A history that goes on from a solved state is that of an unbroken run; what was solved before a failure is kept."""

import copy
import pickle
import signal
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
from fretting.__main__ import main

RUB = {"tangential_force": [0.05, 0.02], "cycles": 1, "increments": 8}
SAME = 1e-6
"""Share of the largest value: tractions that satisfy the equations to 1e-8 differ by up to 100 times as much."""


@pytest.fixture
def case() -> dict[str, Any]:
    """A coated contact, so that pressure and shear act on each other."""
    return {
        "grid": {"cells": [20, 24], "size": [200e-6, 240e-6]},
        "upper": {"rigid": True},
        "lower": {
            "coatings": [{"thickness": 20e-6, "young": 400e9, "poisson": 0.25}],
            "substrate": {"young": 210e9, "poisson": 0.3},
        },
        "profile": {"sphere": {"radius": 10e-3}},
        "friction": {"coefficient": 0.2},
    }


def with_load(case: dict[str, Any], *stages: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {**copy.deepcopy(case), "load": list(stages), **more}


PRESS = {"name": "press", "normal_force": 1.0, "increments": 4}


def assert_goes_on(whole: fretting.History, part: fretting.History) -> None:
    for name in ("normal_force", "approach", "shift_x", "shift_y", "max_pressure", "max_shear", "dissipated_energy"):
        expected = whole.increments[name][-len(part) :]
        np.testing.assert_allclose(
            part.increments[name], expected, rtol=0, atol=SAME * np.abs(whole.increments[name]).max()
        )
    for field in ("pressure", "shear_x", "slip_y"):
        expected = whole.field(field)
        np.testing.assert_allclose(part.field(field), expected, rtol=0, atol=SAME * np.abs(expected).max())


def test_press_once_branch_into_many(case: dict[str, Any], tmp_path: Path) -> None:
    whole = fretting.run(with_load(case, PRESS, RUB))
    pressed = fretting.run(with_load(case, PRESS))
    rub = with_load(case, RUB)
    assert_goes_on(whole, fretting.run(rub, start=pressed))
    assert_goes_on(whole, fretting.run(rub, start=(whole, 3)))
    assert_goes_on(whole, fretting.run(rub, start=(pressed, -1)))
    answer = fretting.sweep(rub, {"load.0.tangential_force.0": [0.01, 0.05]}, start=pressed)
    energy = answer["dissipated_energy"].values
    assert energy[0] < energy[1]
    np.testing.assert_allclose(energy[1], whole.increments["dissipated_energy"][-1], rtol=SAME)
    with ProcessPoolExecutor(1) as pool:
        again = fretting.sweep(
            rub, {"load.0.tangential_force.0": [0.01, 0.05]}, executor=pool, start=pressed, folder=tmp_path / "s"
        )
    np.testing.assert_array_equal(again["dissipated_energy"].values, energy)
    # Another state to start from makes other points.
    elsewhere = fretting.sweep(
        rub, {"load.0.tangential_force.0": [0.01, 0.05]}, start=(whole, 3), folder=tmp_path / "s"
    )
    assert elsewhere.attrs["solved_before"] == 0
    plan = fretting.plan(rub, start=pressed)
    assert plan["increments"] == 8


def test_the_same_from_a_folder(case: dict[str, Any], tmp_path: Path) -> None:
    whole = fretting.run(with_load(case, PRESS, RUB))
    text = """
grid = { cells = [20, 24], size = [200e-6, 240e-6] }
upper.rigid = true
lower.coatings = [{ thickness = 20e-6, young = 400e9, poisson = 0.25 }]
lower.substrate = { young = 210e9, poisson = 0.3 }
profile.sphere.radius = 10e-3
friction.coefficient = 0.2
load = [{ name = "press", normal_force = 1.0, increments = 4 }]
"""
    (tmp_path / "press.toml").write_text(text)
    folder = tmp_path / "pressed"
    assert main(["run", str(tmp_path / "press.toml"), "--out", str(folder), "--quiet"]) == 0
    rub = with_load(case, RUB)
    for start in (folder, f"{folder}:3", (folder, 3), fretting.open_results(folder)):
        assert_goes_on(whole, fretting.run(rub, start=start))
    with pytest.raises(fretting.UnreadableError, match=r"no state at the end of increment 1(.|\n)*from 0\): 3;"):
        fretting.run(rub, start=(folder, 1))
    with pytest.raises(fretting.MissingFileError, match="no such folder"):
        fretting.run(rub, start=tmp_path / "nowhere")


def test_what_is_no_state_to_start_from_is_refused(case: dict[str, Any]) -> None:
    pressed = fretting.run(with_load(case, PRESS))
    rub = with_load(case, RUB)
    with pytest.raises(ValueError, match="no state at the end of increment 1; it has those of 3"):
        fretting.run(rub, start=(pressed, 1))
    with pytest.raises(IndexError, match="the history has 4 increments"):
        fretting.run(rub, start=(pressed, 4))
    with pytest.raises(ValueError, match="went through another process"):
        fretting.run(rub, start=pickle.loads(pickle.dumps(pressed)))
    with pytest.raises(TypeError, match="expected a folder or a History, found int"):
        fretting.run(rub, start=3)  # type: ignore[arg-type]
    rub["lower"]["substrate"]["young"] = 200e9
    with pytest.raises(
        fretting.CaseError, match=r"lower.substrate.young = 200000000000.0: the state to start from has 21"
    ) as refused:
        fretting.run(rub, start=pressed)
    assert refused.value.mistakes[0].line is not None


def failing(case: dict[str, Any]) -> dict[str, Any]:
    """Pressed by an approach, so that only the run finds out that friction does not carry the force."""
    return with_load(
        case, {"name": "press", "approach": 70e-9, "increments": 4}, {**RUB, "tangential_force": [9.0, 0.0]}
    )


def test_what_was_solved_before_a_failure_is_in_the_exception(case: dict[str, Any]) -> None:
    whole = fretting.run(with_load(case, {"approach": 70e-9, "increments": 4}, RUB))
    with pytest.raises(fretting.RunError, match=r"increment 4 .*above what friction carries") as raised:
        fretting.run(failing(case))
    error = raised.value
    history = error.history
    assert history is not None
    assert (error.increment, len(history), history.finished, history.status) == (4, 4, False, "failed")
    assert history.message is not None
    assert "above what friction carries" in history.message
    assert "not the whole history: failed" in repr(history)
    np.testing.assert_array_equal(history.increments["approach"], whole.increments["approach"][:4])
    assert history.kept_increments == [3]
    assert_goes_on(whole, fretting.run(with_load(case, RUB), start=history))
    again = pickle.loads(pickle.dumps(error))
    np.testing.assert_array_equal(again.history.increments["approach"], history.increments["approach"])


def test_what_progress_raises_carries_the_history(case: dict[str, Any]) -> None:
    def stop(step: dict[str, Any]) -> None:
        if step["increment"] == 2:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough") as raised:
        fretting.run(with_load(case, PRESS), progress=stop)
    history = raised.value.history  # type: ignore[attr-defined]
    assert (len(history), history.status, history.message) == (3, "interrupted", "enough")


INTERRUPTED = """
import fretting, pickle, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell starts what runs behind it without
CASE = {
    "grid": {"cells": [48, 48], "size": [300e-6, 300e-6]}, "upper": {"rigid": True},
    "lower": {"substrate": {"young": 210e9, "poisson": 0.3}}, "profile": {"sphere": {"radius": 10e-3}},
    "load": [{"normal_force": 12.0, "increments": 100000}], "output": {"every": 10},
}
def told(step):
    if step["increment"] == 30:
        print("running", flush=True)
try:
    fretting.run(CASE, progress=told)
except KeyboardInterrupt as stop:
    history = stop.history
    assert isinstance(stop, fretting.RunInterrupted) and stop.increment == len(history) > 30
    assert history.status == "interrupted" and not history.finished
    assert len(history.kept_increments) >= 3
    case = {**CASE, "load": [{"normal_force": 1.0, "increments": 1}]}
    on = fretting.run(case, start=history)
    print(abs(on.increments["normal_force"][-1] - 1.0) < 1e-6, flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to one process")
def test_what_was_solved_before_ctrl_c_is_in_the_exception() -> None:
    with subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "running\n"
        process.send_signal(signal.SIGINT)
        said, errors = process.communicate(timeout=600)
        assert (said, process.returncode) == ("True\n", 0), errors

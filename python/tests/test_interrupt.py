"""Ctrl-C ends a run, soon."""

import subprocess
import sys

import pytest

INTERRUPTED = """
import fretting, os, signal, threading, time

solved, interrupted_after = 0, []

def on_step(step):
    global solved
    solved += 1
    if solved == 2:
        threading.Thread(target=press_ctrl_c, daemon=True).start()

def press_ctrl_c():
    while not interrupted_after:
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.001)

def on_ctrl_c(number, frame):
    if frame.f_code is fretting.run.__code__ and not interrupted_after:  # in the solver, not in on_step
        interrupted_after.append(solved)
        raise KeyboardInterrupt

signal.signal(signal.SIGINT, on_ctrl_c)
try:
    fretting.run({
        "grid": {"cells": [1024, 1024], "size": "auto"},
        "upper": {"substrate": {"young": 5e9, "poisson": 0.1}},
        "lower": {"coatings": [{"thickness": 1e-4, "young": 420e9, "poisson": 0.3}],
                  "substrate": {"young": 210e9, "poisson": 0.3}},
        "profile": {"sphere": {"radius": 10e-3}},
        "friction": {"coefficient": 0.3},
        "load": [{"normal_force": 12.0, "increments": 1000}],
        "solver": {"tolerance": 1e-10},
    }, threads=1, progress=on_step)
except KeyboardInterrupt as stop:
    print(interrupted_after[0], solved, stop.increment)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to one process")
def test_a_run_in_the_solver_ends_with_the_increment_in_which_ctrl_c_is_pressed() -> None:
    # The time limit ends a test that hangs, and says nothing of how soon a run ends: that is counted in increments.
    told = subprocess.run([sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, timeout=600, check=False)
    assert told.returncode == 0, told.stderr
    before, heard, solved = map(int, told.stdout.split())
    # The increment that is being solved may still be finished; nobody hears of it any more.
    assert before == heard <= solved <= before + 1

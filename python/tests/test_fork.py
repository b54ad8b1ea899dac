"""Worker threads do not survive a fork: a child makes its own."""

import subprocess
import sys

import pytest

RUN_IN_PARENT_AND_CHILDREN = """
import multiprocessing
import fretting

CASE = {
    "grid": {"cells": [24, 24], "size": [240e-6, 240e-6]},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    "profile": {"sphere": {"radius": 10e-3}},
    "load": [{"normal_force": 12.0, "increments": 2}],
}

def peak(_):
    fretting.influence_coefficients({"substrate": {"young": 1.0, "poisson": 0.3}}, cells=(8, 8), spacing=(1.0, 1.0))
    return float(fretting.run(CASE).increments["max_pressure"][-1])

if __name__ == "__main__":
    here = peak(0)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map(peak, range(4)) == [here] * 4
    assert peak(0) == here
    print("done")
"""


@pytest.mark.skipif(not hasattr(__import__("os"), "fork"), reason="no fork on this system")
def test_a_forked_child_can_run_after_its_parent() -> None:
    done = subprocess.run(
        [sys.executable, "-W", "ignore::DeprecationWarning", "-c", RUN_IN_PARENT_AND_CHILDREN],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, "done\n"), done.stderr

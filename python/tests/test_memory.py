"""Memory and threads: what is needed is compared with what there is, and the interpreter lives on."""

import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import fretting

LIMITED = """
import resource
import fretting

case = {
    "grid": {"cells": [2048, 2048], "size": "auto"},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    "profile": {"sphere": {"radius": 10e-3}},
    "friction": {"coefficient": 0.3},
    "load": [{"normal_force": 10.0, "increments": 1}],
    "output": {"fields": ["pressure", "shear"]},
}
small = {**case, "grid": {"cells": [64, 64], "size": "auto"}}
fretting.run(small, threads=2)
resource.setrlimit(resource.RLIMIT_AS, (int(1.5e9), -1))
try:
    fretting.run(case, threads=2)
except MemoryError as error:
    assert isinstance(error, fretting.RunError), type(error)
    assert "ulimit -v" in str(error), error
    print("refused")
for ask in (
    lambda: fretting.influence_coefficients(case["lower"], cells=(8192, 4096), spacing=(1e-6, 1e-6)),
    lambda: fretting.Convolution(__import__("numpy").ones((6000, 6000))),
    lambda: fretting.run(small).subsurface([k * 1e-7 for k in range(20000)]),
    lambda: fretting.plan({**case, "grid": {"cells": [8192, 8192], "size": "auto"}}),
):
    try:
        ask()
        print("done")
    except (MemoryError, fretting.CaseError) as error:
        assert "memory" in str(error) or "allocate" in str(error), error
        print("refused")
print("lacking" if fretting.plan(case)["memory_lacking"] else "fits")
print(fretting.run(small, threads=2).shape)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="limits on the address space are Linux's")
def test_too_little_memory_is_an_error_and_the_interpreter_lives_on() -> None:
    answer = subprocess.run([sys.executable, "-c", LIMITED], capture_output=True, text=True, timeout=600, check=False)
    assert answer.returncode == 0, answer.stderr
    assert answer.stdout.split("\n")[:-1] == ["refused"] * 5 + ["lacking", "(64, 64)"], answer.stdout


MANY_THREADS = """
import resource
import fretting

case = {
    "grid": {"cells": [16, 16], "size": "auto"},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    "profile": {"sphere": {"radius": 10e-3}},
    "load": [{"normal_force": 10.0, "increments": 1}],
}
held = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (held + 800_000_000, -1))
for ask in (
    lambda: fretting.run(case, threads=200),
    lambda: fretting.study(case, cells=[8, 16], threads=200),
):
    try:
        ask()
        print("done")
    except MemoryError as error:
        assert "ulimit -v" in str(error) and "fewer threads give the same numbers" in str(error), error
        print("refused")
print(fretting.run(case, threads=1).shape)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="limits on the address space are Linux's")
def test_threads_without_room_for_them_are_a_lack_of_memory() -> None:
    told = subprocess.run(
        [sys.executable, "-c", MANY_THREADS], capture_output=True, text=True, timeout=600, check=False
    )
    assert told.returncode == 0, told.stderr
    assert told.stdout.split("\n")[:-1] == ["refused", "refused", "(16, 16)"], told.stdout


@pytest.mark.long
def test_a_case_that_no_machine_holds_is_refused_before_it_starts(sphere_case: dict[str, Any]) -> None:
    sphere_case["grid"] = {"cells": [8192, 8192], "size": [1e-3, 1e-3]}
    sphere_case["output"] = {"fields": ["pressure", "shear", "slip"], "every": 1}
    sphere_case["load"] = [{"normal_force": 10.0, "increments": 5000}]
    plan = fretting.plan(sphere_case)
    assert plan["kept_bytes"] == 5000 * 40 * 8192**2
    assert plan["memory_lacking"] and plan.seconds_expected is None
    with pytest.raises(fretting.OutOfMemoryError, match=r"needs about 13\d{3}\.\d GB of memory") as refused:
        fretting.run(sphere_case)
    assert isinstance(refused.value, MemoryError) and isinstance(refused.value, fretting.RunError)


def test_points_beside_each_other_are_counted_together(sphere_case: dict[str, Any]) -> None:
    pytest.importorskip("xarray")
    from concurrent.futures import ThreadPoolExecutor

    sphere_case["grid"] = {"cells": [4096, 4096], "size": [1e-3, 1e-3]}
    with ThreadPoolExecutor(60) as executor, pytest.raises(MemoryError, match=r"60 points of .* beside each other"):
        fretting.sweep(sphere_case, {"load.0.normal_force": np.linspace(1.0, 2.0, 60).tolist()}, executor=executor)


@pytest.mark.parametrize("threads", [0, -3, 1025, 10**6, 10**30])
def test_numbers_of_threads_are_bounded_as_in_the_command(sphere_case: dict[str, Any], threads: int) -> None:
    words = f"threads = {threads}: must be a whole number from 1 to 1024"
    with pytest.raises(ValueError, match=words):
        fretting.run(sphere_case, threads=threads)
    told = subprocess.run(
        [sys.executable, "-m", "fretting", "run", "case.toml", f"--threads={threads}"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode == 1 and "must be a whole number from 1 to 1024" in told.stderr


@pytest.mark.parametrize("threads", [True, False, 2.0, "2"])
def test_what_is_no_number_of_threads_is_refused(sphere_case: dict[str, Any], threads: Any) -> None:
    with pytest.raises(TypeError, match="must be a whole number from 1 to 1024"):
        fretting.run(sphere_case, threads=threads)


def test_any_whole_number_of_threads_will_do(sphere_case: dict[str, Any]) -> None:
    assert len(fretting.run(sphere_case, threads=np.int64(2))) > 0  # type: ignore[arg-type]

"""The command `fret` that comes with the package is the program itself."""

import os
import signal
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

import pytest

CASE = """
[grid]
cells = [24, 24]
size = "auto"
[upper]
rigid = true
[lower]
substrate = { young = 210e9, poisson = 0.3 }
[profile.sphere]
radius = 10e-3
[[load]]
normal_force = 12.0
increments = INCREMENTS
"""


def fret(*words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "fretting", *words], capture_output=True, text=True, timeout=600, check=False, cwd=folder
    )


def test_it_is_installed_under_its_name(tmp_path: Path) -> None:
    program = Path(sysconfig.get_path("scripts")) / ("fret.exe" if os.name == "nt" else "fret")
    if not program.exists():
        pytest.skip("the package is not installed, only on the path")
    said = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=600, check=True, cwd=tmp_path)
    assert said.stdout == fret("--version", folder=tmp_path).stdout


def test_it_solves_refuses_and_says_so_in_its_exit_code(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(CASE.replace("INCREMENTS", "2"))
    (tmp_path / "bad.toml").write_text(CASE.replace("INCREMENTS", "0"))
    solved = fret("run", "case.toml", folder=tmp_path)
    assert solved.returncode == 0, solved.stderr
    assert "max pressure" in solved.stdout
    assert (tmp_path / "results" / "case" / "history.csv").exists()
    refused = fret("check", "bad.toml", folder=tmp_path)
    assert refused.returncode == 1
    assert "bad.toml:13:14" in refused.stderr
    assert fret("no-such-verb", folder=tmp_path).returncode == 1


@pytest.mark.skipif(os.name == "nt", reason="signals are not those of POSIX")
def test_ctrl_c_ends_a_run_in_good_order(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(CASE.replace("INCREMENTS", "100000").replace("24", "64"))
    process = subprocess.Popen(
        [sys.executable, "-m", "fretting", "run", "case.toml"], cwd=tmp_path,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    table = tmp_path / "results" / "case" / "history.csv"
    deadline = time.monotonic() + 600  # ends a test that hangs
    while not (table.exists() and table.read_text().count("\n") > 2) and time.monotonic() < deadline:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=600)
    assert process.returncode == 130, said
    assert "increments are solved and kept in" in said
    assert "Traceback" not in said
    assert table.read_text().endswith("\n")

"""The hand-written stubs say what the compiled module has, and the types of the package and of its tests hold."""

import subprocess
import sys
from pathlib import Path

import pytest


def test_stubs_match_the_compiled_module(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    done = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "fretting._core", "--concise"],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
        cwd=tmp_path,  # the installed package is judged, not the sources
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_types_hold(root: Path) -> None:
    pytest.importorskip("mypy")
    done = subprocess.run(
        [sys.executable, "-m", "mypy"], capture_output=True, text=True, timeout=600, check=False, cwd=root
    )
    assert done.returncode == 0, done.stdout + done.stderr

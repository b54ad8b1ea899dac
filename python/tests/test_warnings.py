"""What may mislead is told of: by the plan, by the history, through Python's own warnings, and by a folder read
back.
"""

import pickle
import subprocess
import sys
import tomllib
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting


def _names(facts: list[Any]) -> list[str]:
    return [fact["name"] for fact in facts]


def test_a_modulus_without_its_gpa_is_told_of(sphere_case: dict[str, Any]) -> None:
    sphere_case["grid"]["size"] = "auto"
    assert fretting.plan(sphere_case).warnings == []
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert fretting.run(sphere_case).warnings == []
    sphere_case["lower"]["substrate"]["young"] = 210.0
    plan = fretting.plan(sphere_case)
    # Hertz: a contact of 73 mm on a ball of 10 mm.
    radius = (0.75 * 12.0 * 10e-3 * 0.91 / 210.0) ** (1 / 3)
    strain = next(fact for fact in plan.warnings if fact["name"] == "contact_radius_over_body_radius")
    assert strain["value"] == pytest.approx(radius / 10e-3, rel=0.06)  # a coarse grid knows it to a twentieth
    assert strain["value"] > strain["bound"]
    assert "warning: " in repr(plan)
    with pytest.warns(fretting.FrettingWarning, match="contact radius over body radius") as caught:
        history = fretting.run(sphere_case)
    assert Path(caught[0].filename) == Path(__file__)
    assert "contact_radius_over_body_radius" in _names(history.warnings)
    assert pickle.loads(pickle.dumps(history)).warnings == history.warnings
    assert "warning" in repr(history)


def test_a_folder_has_the_warnings_of_its_run(sphere_case: dict[str, Any], tmp_path: Path) -> None:
    sphere_case["grid"]["size"] = [1.0, 1.0]
    history = fretting.run(sphere_case)
    assert "few_cells" in _names(history.warnings)
    text = (
        "load = [{ name = 'indent', normal_force = 12.0, increments = 1 }]\n"
        "grid = { cells = [48, 48], size = [1.0, 1.0] }\nupper.rigid = true\n"
        "lower.substrate = { young = 210e9, poisson = 0.3 }\nprofile.sphere.radius = 10e-3\n"
    )
    assert tomllib.loads(text)["lower"] == sphere_case["lower"]
    (tmp_path / "case.toml").write_text(text)
    command = [sys.executable, "-m", "fretting", "run", "case.toml", "--out", "out", "--quiet"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert fretting.open_results(tmp_path / "out").warnings == history.warnings


def test_totals_of_wear_count_every_cycle(fretting_case: dict[str, Any]) -> None:
    fretting_case["wear"] = {"coefficient": 1e-13, "every": 5}
    fretting_case["load"][1] |= {"cycles": 20, "increments": 8}
    history = fretting.run(fretting_case)
    cycles, steps = history.cycles, history.increments
    assert cycles["last_cycle"][-1] == cycles["stands_for"].sum() == 20
    assert len(cycles["cycle"]) < 20
    total = float((cycles["dissipated_energy"] * cycles["stands_for"]).sum())
    # Like bodies pressed in one increment do not rub: what is dissipated is that of the cycles.
    assert steps["dissipated_energy"][-1] == pytest.approx(total, rel=1e-12)
    assert steps["worn_volume"][-1] == pytest.approx(1e-13 * total, rel=1e-12)
    np.testing.assert_array_equal(steps["worn_volume"][cycles["last_increment"]], cycles["worn_volume"])

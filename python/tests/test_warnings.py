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


def test_a_film_pressed_by_a_good_part_of_its_thickness_is_told_of() -> None:
    thickness = 0.1
    for fraction, told in [(0.3, True), (0.01, False)]:
        history = _quiet(
            {
                "grid": {"cells": [48, 48], "size": "auto"},
                "upper": {"rigid": True},
                "lower": {"coatings": [{"thickness": thickness, "young": 1.0, "poisson": 0.3}], "base": "rigid"},
                "profile": {"sphere": {"radius": 100.0}},
                "load": [{"approach": fraction * thickness, "increments": 1}],
            }
        )
        facts = [fact for fact in history.warnings if fact["name"] == "approach_over_layer_thickness"]
        assert [fact["value"] for fact in facts] == [pytest.approx(fraction, rel=1e-12)] * told


def test_a_scar_as_deep_as_a_good_part_of_the_coating_is_told_of() -> None:
    def worn(wear: float) -> fretting.History:
        body = {"young": 1.0, "poisson": 0.0}
        return _quiet(
            {
                "grid": {"cells": [32, 32], "size": [3.2, 3.2]},
                "upper": {"substrate": body},
                "lower": {"coatings": [{"thickness": 4e-3, **body}], "substrate": {"young": 1.1, "poisson": 0.0}},
                "profile": {"sphere": {"radius": 100.0}},
                "friction": {"coefficient": 0.3},
                "wear": {"coefficient": wear},
                "load": [
                    {"normal_force": 4 * 0.5 / 300, "increments": 1},
                    {"shift": [0.05, 0.0], "increments": 4, "cycles": 5},
                ],
                "output": {"fields": ["worn_depth"]},
            }
        )

    slight, deep = worn(0.1), worn(1.0)
    assert "wear_depth_over_coating_thickness" not in _names(slight.warnings)
    fact = next(fact for fact in deep.warnings if fact["name"] == "wear_depth_over_coating_thickness")
    # The deepest place of the kept field, by the thickness.
    assert fact["value"] == pytest.approx(float(deep.field("worn_depth").max()) / 4e-3, rel=1e-12)
    assert fact["value"] > fact["bound"]


def _quiet(case: dict[str, Any]) -> fretting.History:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fretting.FrettingWarning)
        return fretting.run(case)

"""What identify_indentation promises in Python: a modulus by Hertz, typed constants, errors of its own kind."""

import json
from pathlib import Path

import numpy as np
import pytest

import fretting

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples" / "indentation"
YOUNG = "lower.substrate.young"
CASE = {
    "grid": {"cells": [32, 32], "size": "auto"},
    "units": {"length": "mm", "force": "N"},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 50e3, "poisson": 0.3}},
    "profile": {"sphere": {"radius": 1.0}},
    "load": [{"normal_force": 1.0, "increments": 1}],
}


def hertz(folder: Path) -> Path:
    """Write a log of a rigid ball on E = 70 GPa behind a frame of 20 N/um, without noise."""
    own = np.linspace(-1e-4, 1e-3, 60)
    load = 4 / 3 * 70e3 / 0.91 * np.maximum(own, 0.0) ** 1.5
    log = folder / "log.txt"
    depth = own + load / 20e3 + 4e-4
    rows = "\n".join(f"{d:.9f};{p:.9f}" for d, p in zip(depth, load, strict=True))
    log.write_text("depth [mm];load [N]\n" + rows + "\n", encoding="utf-8")
    return log


def test_modulus_touch_and_frame_of_a_closed_form(tmp_path: Path) -> None:
    found = fretting.identify_indentation(hertz(tmp_path), case=CASE, fit=YOUNG, frame=True)
    # The error of 32 cells, half a per cent, goes into modulus and frame together.
    assert abs(found.constants[YOUNG].value / 70e3 - 1) < 0.02
    assert abs(found.constants["frame compliance"].value * 20e3 - 1) < 0.05
    assert found.frame_compliance == found.constants["frame compliance"].value
    assert abs(found.touch - 4e-4) < 2e-6
    assert found.measured["line"][0] == 2 and len(found.measured["depth"]) == 60
    assert found.solved_indentations < 60
    assert json.loads(found.to_json())["parameters"][0]["name"] == YOUNG
    found.save(tmp_path / "answer")
    assert "Indentation of" in (tmp_path / "answer" / "identified.html").read_text(encoding="utf-8")
    calibrated = fretting.identify_indentation(
        hertz(tmp_path), case={**CASE, "lower": {"substrate": {"young": 70e3, "poisson": 0.3}}}, frame=True
    )
    assert abs(calibrated.frame_compliance * 20e3 - 1) < 0.05


def test_the_example_has_the_modulus_it_was_made_with() -> None:
    key = "lower.coatings[0].young"
    found = fretting.identify_indentation(EXAMPLES / "film_test.csv", case=EXAMPLES / "film.toml", fit=[key])
    young = found.constants[key]
    assert young.told and abs(young.value / 180 - 1) < 0.01
    assert young.interval[0] < 180 < young.interval[1]
    assert abs(found.touch - 0.035) < 2e-4
    assert young.change_on_half_the_cells is not None


def test_what_cannot_be_fitted_is_refused(tmp_path: Path) -> None:
    log = hertz(tmp_path)
    with pytest.raises(ValueError, match="fit: nothing is fitted"):
        fretting.identify_indentation(log, case=CASE)
    with pytest.raises(ValueError, match="the case has no positive number there"):
        fretting.identify_indentation(log, case=CASE, fit="lower.coatings[0].young")
    with pytest.raises(ValueError, match="no line names the columns"):
        fretting.identify_indentation(log, case=CASE, fit=YOUNG, columns={"depth": "time"})
    with pytest.raises(fretting.MissingFileError):
        fretting.identify_indentation(tmp_path / "none.csv", case=CASE, fit=YOUNG)


def test_ways_out_are_those_of_python(tmp_path: Path) -> None:
    """What a message says to write is what the function takes."""
    other = tmp_path / "other.csv"
    other.write_text(hertz(tmp_path).read_text().replace("depth", "one").replace("load", "two"))
    with pytest.raises(ValueError, match=r'columns=\{"depth": ".*", "force": ".*"\}') as refused:
        fretting.identify_indentation(other, case=CASE, fit=YOUNG)
    assert "--" not in str(refused.value)
    with pytest.raises(ValueError, match=r'units=\{"depth": "m"\}') as refused:
        fretting.identify_indentation(hertz(tmp_path), case=CASE, fit=YOUNG, units={"depth": "kg"})
    assert "--" not in str(refused.value)
    with pytest.raises(ValueError, match="fit=nope: the case has no positive number there"):
        fretting.identify_indentation(hertz(tmp_path), case=CASE, fit="nope")

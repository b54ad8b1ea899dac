"""How a case is refused: all mistakes, each with its place and a way out."""

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting

GOOD = """\
[grid]
cells = [32, 32]
size = "auto"
[upper]
rigid = true
[lower]
substrate = { young = 210e9, poisson = 0.3 }
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.1
[[load]]
normal_force = 12.0
increments = 4
"""


def refusal(case: object) -> fretting.CaseError:
    with pytest.raises(fretting.CaseError) as caught:
        fretting.plan(case)  # type: ignore[arg-type]
    return caught.value


def test_a_good_case_is_accepted_as_text_and_as_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "good.toml"
    file.write_text(GOOD)
    (tmp_path / "good").write_text(GOOD)
    monkeypatch.chdir(tmp_path)
    for case in (GOOD, file, str(file), "good"):
        assert fretting.plan(case)["increments"] == 4


@pytest.mark.parametrize(
    ("good", "bad", "line", "column", "said", "help_said"),
    [
        ("radius =", "raduis =", 9, 1, "raduis", "radius"),
        ("cells = [32, 32]", 'cells = "many"', 2, 9, "many", ""),
        ("poisson = 0.3", "poisson = 0.7", 7, 40, "0.7", ""),
        ("[profile.sphere]", "[profile.spere]", 8, 10, "spere", "sphere"),
        ("normal_force = 12.0", "normal_force = 12.0\napproach = 1e-6", 14, 12, "both at once", "the other follows"),
        ("coefficient = 0.1", "coefficient = -0.1", 11, 15, "-0.1", ""),
        ("increments = 4", "increments = 0", 14, 14, "increments = 0", ""),
        ("radius = 10e-3", "radius = nan", 9, 10, "must be a positive finite length", ""),
    ],
)
def test_a_mistake_has_line_column_and_words(
    good: str, bad: str, line: int, column: int, said: str, help_said: str
) -> None:
    assert good in GOOD
    error = refusal(GOOD.replace(good, bad))
    (mistake,) = (mistake for mistake in error.mistakes if (mistake.line, mistake.column) == (line, column))
    assert said in mistake.message
    assert help_said in (mistake.help or "")
    text = str(error)
    assert mistake.message in text
    assert f":{line}:{column}" in text
    assert bad.splitlines()[-1] in text


def test_all_mistakes_are_told_at_once_in_the_order_of_the_text() -> None:
    text = GOOD.replace("poisson = 0.3", "poisson = 0.7").replace("radius =", "raduis =").replace("0.1", "-0.1")
    error = refusal(text)
    assert len(error.mistakes) >= 2
    lines = [mistake.line for mistake in error.mistakes]
    assert lines == sorted(lines, key=lambda line: line or 0)


def test_text_that_is_not_toml_is_a_case_error_too() -> None:
    assert refusal("grid = [\n").mistakes[0].line == 1
    assert refusal("no such\nthing").mistakes


@pytest.fixture
def good(sphere_case: dict[str, Any]) -> dict[str, Any]:
    return sphere_case


def test_a_dict_is_judged_by_the_same_rules(good: dict[str, Any]) -> None:
    bad = copy.deepcopy(good)
    bad["lower"]["substrate"]["poisson"] = 0.7
    error = refusal(bad)
    assert [mistake.message for mistake in error.mistakes if "0.7" in mistake.message]
    assert error.mistakes[0].line is not None
    assert error.mistakes[0].column is not None
    assert "poisson = 0.7" in str(error)


def test_a_dict_with_a_misspelt_key_is_refused(good: dict[str, Any]) -> None:
    good["load"][0]["normal_forse"] = good["load"][0].pop("normal_force")
    error = refusal(good)
    assert "normal_forse" in str(error)
    assert "normal_force" in (error.mistakes[0].help or "")


def test_numpy_numbers_arrays_and_tuples_are_welcome_in_a_dict(good: dict[str, Any]) -> None:
    good["grid"] = {"cells": np.array([48, 48]), "size": (np.float64(240e-6), np.float32(240e-6))}
    good["load"][0]["increments"] = np.int64(3)
    good["upper"] = {"rigid": np.bool_(True)}
    good["title"] = None
    assert fretting.plan(good)["increments"] == 3


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (float("nan"), "profile.sphere.radius = nan: must be finite"),
        (float("inf"), "profile.sphere.radius = inf: must be finite"),
        (1 + 2j, "profile.sphere.radius: complex is not a number"),
        (object(), "profile.sphere.radius: object is not"),
        ({3: 4}, "profile.sphere.radius has the key 3"),
    ],
)
def test_values_that_no_case_can_hold_are_named_by_their_place(good: dict[str, Any], value: object, said: str) -> None:
    good["profile"]["sphere"]["radius"] = value
    error = refusal(good)
    assert said in str(error)
    assert error.mistakes[0].message in str(error)


def test_what_is_no_case_at_all_is_a_type_error() -> None:
    with pytest.raises(TypeError, match="expected a path, TOML text or a dict, found int"):
        fretting.plan(3)  # type: ignore[arg-type]


def test_a_missing_file_is_named_with_what_to_do_instead(tmp_path: Path) -> None:
    with pytest.raises(fretting.MissingFileError, match=r"nowhere/at_all\.toml: no such file") as missed:
        fretting.run("nowhere/at_all.toml")
    assert isinstance(missed.value, FileNotFoundError)
    assert isinstance(missed.value, fretting.FrettingError)
    assert "current folder" in str(missed.value)
    assert missed.value.path == str(Path("nowhere/at_all.toml"))
    again = pickle.loads(pickle.dumps(missed.value))
    assert (str(again), again.path) == (str(missed.value), missed.value.path)
    with pytest.raises(fretting.UnreadableError, match="a folder, not a file"):
        fretting.plan(tmp_path)


def test_a_file_that_is_not_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_bytes(b'title = "\xff\xfe"')
    assert "UTF-8" in str(refusal(tmp_path / "case.toml"))


def test_exceptions_have_one_base_and_survive_pickling() -> None:
    error = refusal(GOOD.replace("radius =", "raduis ="))
    assert isinstance(error, fretting.FrettingError)
    assert isinstance(error, ValueError)
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error)
    assert again.mistakes == error.mistakes
    failure = fretting.RunError("increment 3 not solved", 3)
    again = pickle.loads(pickle.dumps(failure))
    assert (str(again), again.increment) == ("increment 3 not solved", 3)
    assert isinstance(failure, fretting.FrettingError)


def test_run_refuses_like_plan() -> None:
    with pytest.raises(fretting.CaseError, match="raduis"):
        fretting.run(GOOD.replace("radius =", "raduis ="))

"""One vocabulary: columns and fields are named in the core alone; what repeats their names agrees with it."""

import json
import re
from typing import Any, get_args

import fretting
from fretting import _core
from fretting._meaning import CYCLE_KINDS, CYCLE_MEANING, FIELD_NAMES, MEANING, STEP_KINDS, VECTORS, FieldName

VOCABULARY = json.loads(_core.vocabulary())


def test_fields_of_the_type_hint_are_those_of_the_core() -> None:
    names = tuple(entry["name"] for entry in VOCABULARY["fields"])
    assert get_args(FieldName) == names == FIELD_NAMES
    documented = re.search(r"name : str\n(.*?)\.\n", fretting.History.field.__doc__ or "", re.DOTALL)
    assert documented is not None
    assert tuple(re.findall(r'"(\w+)"', documented[1])) == (*names, *VECTORS)


def test_the_docstring_of_a_history_lists_every_column() -> None:
    text = fretting.History.__doc__ or ""
    steps = text[text.index("increments : dict") : text.index("x, y : ndarray")]
    listed = text[text.index("cycles : dict") : text.index("running_conditions :")]
    assert sorted(re.findall(r"``(\w+)``", steps)) == sorted(STEP_KINDS)
    assert sorted(re.findall(r"``(\w+)``", listed)) == sorted(CYCLE_KINDS)


def test_a_solved_history_has_every_column_with_its_type(fretting_case: dict[str, Any]) -> None:
    history = fretting.run(fretting_case)
    assert list(history.increments) == list(STEP_KINDS)
    kinds = {int: "i", float: "f", str: "U"}
    assert {name: column.dtype.kind for name, column in history.increments.items()} == {
        name: kinds[kind] for name, kind in STEP_KINDS.items()
    }
    assert list(history.cycles) == list(CYCLE_KINDS)
    assert set(MEANING) == set(STEP_KINDS) | set(FIELD_NAMES)
    assert set(CYCLE_MEANING) == set(CYCLE_KINDS)

"""The typed dictionaries of a case say what the schema says."""

import json
import subprocess
import sys
import typing
from pathlib import Path
from typing import Any

import pytest

import fretting
from fretting import case_types


def schema(root: Path) -> dict[str, Any]:
    text: dict[str, Any] = json.loads((root / "examples" / "fret.schema.json").read_text(encoding="utf-8"))
    return text


def test_every_table_has_the_keys_of_the_schema(root: Path) -> None:
    whole = schema(root)
    tables = {"Case": whole, **{name.removesuffix("File"): entry for name, entry in whole["$defs"].items()}}
    tables = {name: entry for name, entry in tables.items() if entry.get("type") == "object"}
    assert len(tables) > 20
    for name, entry in tables.items():
        typed = getattr(case_types, name)
        assert set(typing.get_type_hints(typed)) == set(entry["properties"]), name
        assert typed.__required_keys__ == set(entry.get("required", ())), name


def test_choices_are_those_of_the_schema(root: Path) -> None:
    for name, entry in schema(root)["$defs"].items():
        words = entry.get("enum") or [part["const"] for part in entry.get("oneOf", ()) if "const" in part]
        if words:
            plain = name.removesuffix("File").removesuffix("Schema")
            alias = getattr(case_types, {"InterfaceWord": "NamedInterface"}.get(plain, plain.removesuffix("Word")))
            assert set(typing.get_args(alias)) == set(words), name


def test_a_checker_finds_a_misspelt_key(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    text = """
import fretting
case: fretting.Case = {
    "grid": {"cells": [32, 32], "size": "auto"},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 210e9, "KEY": 0.3}},
    "profile": {"sphere": {"radius": 10e-3}},
    "load": [{"normal_force": 10.0, "increments": 1}],
}
history = fretting.run(case)
"""
    for key, code in (("poisson", 0), ("poison", 1)):
        (tmp_path / "case.py").write_text(text.replace("KEY", key))
        call = [sys.executable, "-m", "mypy", "--strict", "case.py"]
        done = subprocess.run(call, capture_output=True, text=True, timeout=600, check=False, cwd=tmp_path)
        assert done.returncode == code, done.stdout + done.stderr
    assert fretting.Case is case_types.Case

"""What the tests share: the repository's root and the cases they vary."""

from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let ``--long`` run what takes long, too."""
    parser.addoption("--long", action="store_true", help="run the tests marked as long, too")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave long tests aside unless they are asked for."""
    if config.getoption("--long"):
        return
    for item in items:
        if "long" in item.keywords:
            item.add_marker(pytest.mark.skip(reason="takes long: --long runs it"))


@pytest.fixture
def root() -> Path:
    """Root of the repository."""
    return ROOT


@pytest.fixture
def sphere_case() -> dict[str, Any]:
    """Rigid sphere on steel without friction: Hertz's contact, of contact radius 73 micrometres."""
    return {
        "grid": {"cells": [48, 48], "size": [240e-6, 240e-6]},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
        "profile": {"sphere": {"radius": 10e-3}},
        "load": [{"name": "indent", "normal_force": 12.0, "increments": 1}],
    }


@pytest.fixture
def fretting_case() -> dict[str, Any]:
    """Like bodies without lateral contraction, where Cattaneo and Mindlin are exact; then one cycle to and fro."""
    material = {"young": 200e9, "poisson": 0.0}
    return {
        "title": "Cattaneo-Mindlin",
        "grid": {"cells": [48, 48], "size": [300e-6, 300e-6]},
        "upper": {"substrate": dict(material)},
        "lower": {"substrate": dict(material)},
        "profile": {"sphere": {"radius": 10e-3}},
        "friction": {"coefficient": 0.2},
        "load": [
            {"name": "indent", "normal_force": 20.0, "increments": 1},
            {"name": "fretting", "tangential_force": [2.4, 0.0], "cycles": 1, "increments": 16},
        ],
        "output": {"fields": ["pressure", "shear", "slip", "gap", "zone"], "every": 4},
    }

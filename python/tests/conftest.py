"""What the tests share: the repository's root and the cases they vary."""

import shutil
import subprocess
import sys
from collections.abc import Iterator
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


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the built site."""
    for name in ("mkdocs", "material", "mkdocstrings", "latex2mathml"):
        pytest.importorskip(name)
    site = tmp_path_factory.mktemp("site")
    call = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--site-dir", str(site)]
    subprocess.run(
        call, check=True, cwd=ROOT, timeout=600, env={"NO_MKDOCS_2_WARNING": "1", "PATH": ""}, capture_output=True
    )
    return site


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Return a browser without a window; tests that want one are skipped where there is none.

    It ends with the file of the tests: as long as it is open an event loop runs, which others may want.
    """
    api = pytest.importorskip("playwright.sync_api", reason="no browser is driven: pip install playwright")
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    with api.sync_playwright() as playwright:
        own = Path(playwright.chromium.executable_path)
        path = None if own.exists() else next(filter(None, map(shutil.which, names)), None)
        if path is None and not own.exists():
            pytest.skip("no browser: playwright install chromium, or a chromium on the path")
        opened = playwright.chromium.launch(executable_path=path)
        yield opened
        opened.close()


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

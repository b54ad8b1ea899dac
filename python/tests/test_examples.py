"""The page of examples has every example, with what it says of itself and a picture of the case as it is."""

import importlib.util
import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "examples.md"


@pytest.fixture(scope="module")
def examples() -> Any:
    """Return the script that writes the page."""
    spec = importlib.util.spec_from_file_location("examples", ROOT / "docs" / "site" / "examples.py")
    assert spec is not None and spec.loader is not None
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


def test_no_example_is_missing() -> None:
    page = PAGE.read_text(encoding="utf-8")
    files = [*(ROOT / "examples").rglob("*.toml"), *(ROOT / "examples").rglob("*.py")]
    files += ROOT.glob("crates/*/examples/*.rs")
    assert len(files) > 50
    missing = [path.name for path in files if f"](../{path.relative_to(ROOT).as_posix()})" not in page]
    assert missing == [], "run docs/site/examples.py"
    shown = re.findall(r"\]\(\.\./((?:examples|crates)/[^)]+)\)", page)
    assert sorted(shown) == sorted(path.relative_to(ROOT).as_posix() for path in files)


def test_the_page_says_what_the_examples_say(examples: Any) -> None:
    assert PAGE.read_text(encoding="utf-8") == examples.page(), "run docs/site/examples.py"
    for name in examples.cases():
        title, words = examples.taught(name)
        assert title and len(words) > 40, f"{name} does not say what it shows"


def test_every_thumbnail_is_of_the_case_as_it_is(examples: Any) -> None:
    assert examples.stale() == [], "run docs/site/examples.py"
    drawn = sorted((ROOT / "docs" / "pictures" / "examples").rglob("*.png"))
    assert drawn == sorted(examples.picture(name) for name in examples.cases())
    for path in drawn:
        assert path.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
        assert path.stat().st_size < 40_000, path.name

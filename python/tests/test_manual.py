"""The manual: all pages of the site in one, whose links lead to places in it, printed by a browser."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def script() -> Any:
    """Return the script that prints the manual."""
    pytest.importorskip("yaml")
    spec = importlib.util.spec_from_file_location("manual", ROOT / "docs" / "site" / "manual.py")
    assert spec is not None and spec.loader is not None
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


def test_every_page_of_the_menu_is_in_the_manual_and_every_link_leads_to_a_place(script: Any, site: Path) -> None:
    text = script.manual(site)
    names = re.findall(r'\bid="([^"]*)"', text)
    assert len(names) == len(set(names))
    away = [place for place in re.findall(r'href="#([^"]*)"', text) if place not in set(names)]
    assert away == []
    for picture in set(re.findall(r'src="([^"]*)"', text)):
        assert (site / picture).exists(), picture
    menu = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    for page in re.findall(r": ((?:[\w-]+/)*[\w-]+)\.md$", menu.partition("Developers' notes")[0], re.MULTILINE):
        assert f'<article id="{page.replace("/", "-")}">' in text, page


@pytest.mark.long
def test_a_browser_prints_the_manual(site: Path, browser: Any, tmp_path: Path) -> None:
    assert browser.is_connected()
    script = str(ROOT / "docs" / "site" / "manual.py")
    call = [sys.executable, script, "--site", str(site), "--out", str(tmp_path / "manual.pdf")]
    subprocess.run(call, check=True, timeout=600)
    printed = (tmp_path / "manual.pdf").read_bytes()
    assert printed.startswith(b"%PDF") and len(printed) > 1_000_000
    assert not (site / "manual.html").exists()

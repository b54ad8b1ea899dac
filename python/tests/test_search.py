"""What a tribologist types into the search of the site finds the right page first."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

QUERIES = {
    "active set": {"theory/solution-algorithm.html"},
    "Newton method": {"theory/solution-algorithm.html"},
    "preconditioner": {"theory/solution-algorithm.html"},
    "stick slip zone": {
        "learn/quick-start.html",
        "learn/fretting-loop.html",
        "do/publication-figures.html",
        "gallery.html",
    },
    "Dundurs": {"reference/glossary.html", "theory/contact-problem.html"},
    "shakedown": {"theory/friction-and-history.html", "theory/subsurface-stress.html"},
    "mixed precision": {"theory/simplifications.html"},
    "backward Euler": {"theory/second-order.html", "theory/friction-and-history.html", "theory/contact-problem.html"},
    "wear coefficient": {"theory/wear.html", "learn/wear.html"},
    "energy ratio": {"theory/fretting-quantities.html"},
    "partial slip gross slip": {"theory/fretting-quantities.html"},
    "fretting map": {"learn/fretting-map.html"},
    "critical distance": {"theory/subsurface-stress.html"},
    "machine compliance rig": {"do/compare-with-a-rig.html"},
    "paraview": {"do/read-results.html"},
    "pandas": {"do/read-results.html"},
    "sign of shear": {"theory/contact-problem.html", "faq.html"},
    "units": {"do/units.html"},
    "rough surface": {"do/describe-the-bodies.html", "do/line-contact-and-periodic-surfaces.html"},
    "line contact": {"do/line-contact-and-periodic-surfaces.html"},
    "graded coating": {"do/graded-coatings.html"},
    "how many cells grid": {"do/choose-grid-and-increments.html", "faq.html"},
    "residual": {"theory/contact-problem.html"},
    "exit codes": {"reference/messages.html"},
    "Cattaneo Mindlin": {
        "trust/verification.html",
        "trust/verification-record.html",
        "do/coming-from-other-programs.html",
    },
    "cite": {"cite.html"},
    "resume interrupted run": {"do/continue-a-run.html"},
    "tamaas": {"do/coming-from-other-programs.html", "trust/comparison.html"},
    "known failures": {"limits.html"},
    "fatigue parameters": {"theory/subsurface-stress.html", "do/subsurface-stresses.html"},
}
"""Queries, and the pages that answer them: one of these has to come first."""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the built site."""
    pytest.importorskip("mkdocs")
    pytest.importorskip("material")
    pytest.importorskip("mkdocstrings")
    site = tmp_path_factory.mktemp("site")
    call = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--site-dir", str(site)]
    subprocess.run(
        call, check=True, cwd=ROOT, timeout=120, env={"NO_MKDOCS_2_WARNING": "1", "PATH": ""}, capture_output=True
    )
    return site


@pytest.fixture(scope="module")
def found(site: Path) -> dict[str, list[str]]:
    """Return the pages that the search finds for each query, best first."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("the search runs in node")
    call = [
        node,
        str(ROOT / "docs" / "site" / "search.js"),
        str(site),
        *QUERIES,
    ]
    told = subprocess.run(call, capture_output=True, text=True, check=True, timeout=120).stdout
    answer: dict[str, list[str]] = json.loads(told)
    return answer


@pytest.mark.parametrize("query", QUERIES)
def test_the_right_page_comes_first(query: str, found: dict[str, list[str]]) -> None:
    assert found[query][:1] and found[query][0] in QUERIES[query], found[query]


def test_the_search_needs_no_server_and_no_network(site: Path) -> None:
    # Opened as a file a page can neither fetch the index nor start a worker: both have to come as scripts.
    script = (site / "search" / "search_index.js").read_text(encoding="utf-8")
    index = (site / "search" / "search_index.json").read_text(encoding="utf-8")
    assert script == f"var __index = {index}"
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        if 'data-md-component="search"' in text:
            sources = re.findall(r'<script[^>]* src="([^"]*)"', text)
            stand_in = [source for source in sources if "iframe-worker" in source]
            assert not [source for source in sources if source.startswith(("http", "//"))], page
            assert len(stand_in) == 1 and (page.name == "404.html" or (page.parent / stand_in[0]).exists()), page

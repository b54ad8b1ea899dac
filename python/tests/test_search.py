"""What a tribologist types into the search of the site finds the right page first."""

import json
import re
import shutil
import subprocess
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
    "roughness": {"do/describe-the-bodies.html"},
    "asperities Greenwood Williamson": {"do/line-contact-and-periodic-surfaces.html", "do/describe-the-bodies.html"},
    "profilometer": {"learn/install.html", "do/describe-the-bodies.html"},
    "hardness": {"do/identify-indentation.html", "do/describe-the-bodies.html", "faq.html"},
    "Berkovich": {"do/identify-indentation.html", "do/describe-the-bodies.html"},
    "nanoindentation": {"do/identify-indentation.html"},
    "TiN": {"reference/materials.html", "faq.html"},
    "DLC": {"reference/materials.html", "faq.html"},
    "CrN": {"reference/materials.html"},
    "elastic modulus TiN": {"reference/materials.html"},
    "multilayer": {"do/describe-the-bodies.html"},
    "coefficient of friction": {"do/vary-friction.html"},
    "torsion": {"do/load-the-contact.html"},
    "false brinelling": {"do/oscillating-bearing.html"},
    "creepage": {"do/rolling.html"},
    "pin on disk": {"faq.html", "theory/wear.html"},
    "wear scar": {"learn/wear.html", "theory/wear.html", "trust/experiments.html"},
    "third body debris": {"do/moving-surfaces.html", "theory/wear.html", "trust/experiments.html"},
    "S-N curve": {"faq.html", "do/subsurface-stresses.html"},
    "Wöhler": {"do/subsurface-stresses.html"},
    "SWT": {"do/subsurface-stresses.html"},
    "Dang Van": {"do/subsurface-stresses.html", "theory/subsurface-stress.html"},
    "multiaxial fatigue": {"do/subsurface-stresses.html"},
    "residual stress": {"learn/stress-and-fatigue.html", "do/fretting-fatigue-tests.html"},
    "dovetail": {"do/fretting-fatigue-tests.html"},
    "flash temperature": {"do/temperature-and-contact-resistance.html"},
    "Excel": {"do/read-results.html"},
    "Matlab": {"do/read-results.html"},
    "Jupyter": {"do/explore.html", "learn/install.html", "faq.html"},
    "widget": {"do/explore.html", "learn/install.html", "faq.html"},
    "FEM": {"faq.html", "trust/comparison.html"},
    "Abaqus": {"faq.html", "trust/comparison.html"},
    "plasticity": {"trust/comparison.html", "faq.html", "limits.html"},
    "GPU": {"faq.html"},
    "mesh convergence": {"do/choose-grid-and-increments.html"},
    "not converged": {"reference/messages.html"},
    "uncertainty": {"do/uncertainty.html"},
    "optimisation": {"do/design-a-coating.html"},
    "PyTorch": {"do/sensitivities.html"},
    "examples": {"examples.html"},
    "licence": {"faq.html"},
    "friction coefficient": {"do/vary-friction.html"},
    "coating thickness": {"do/describe-the-bodies.html", "do/graded-coatings.html"},
    "python sweep": {"do/sweep.html"},
    "Hertz pressure": {"learn/hertz-then-a-coating.html", "reference/closed-forms.html"},
    "spreadsheet": {"do/read-results.html"},
    "methods section": {"cite.html", "do/publication-figures.html"},
    "nanoindenter": {"do/identify-indentation.html"},
    "interactive": {"do/explore.html"},
    "decimal comma": {"do/load-the-contact.html", "do/units.html", "do/compare-with-a-rig.html"},
    "crowned roller": {"do/describe-the-bodies.html"},
    "template": {"learn/quick-start.html"},
    "diameter or radius of the ball": {"faq.html", "do/describe-the-bodies.html"},
    "load cell": {"do/compare-with-a-rig.html"},
    "atomic force microscope": {"do/describe-the-bodies.html"},
    "Young's modulus DLC": {"reference/materials.html"},
    "frequency": {"faq.html", "do/temperature-and-contact-resistance.html"},
    "displacement amplitude": {"do/load-the-contact.html"},
    "how many cycles until steady": {"do/load-the-contact.html", "learn/wear.html"},
}
"""Queries, and the pages that answer them: one of these has to come first."""


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
    told = subprocess.run(call, capture_output=True, text=True, check=True, timeout=600).stdout
    answer: dict[str, list[str]] = json.loads(told)
    return answer


@pytest.mark.parametrize("query", QUERIES)
def test_the_right_page_comes_first(query: str, found: dict[str, list[str]]) -> None:
    assert found[query][:1] and found[query][0] in QUERIES[query], found[query]


def test_developers_notes_are_neither_found_nor_in_the_menu(site: Path) -> None:
    index = json.loads((site / "search" / "search_index.json").read_text(encoding="utf-8"))
    shown = (site / "index.html").read_text(encoding="utf-8")
    places = {entry["location"].partition("#")[0] for entry in index["docs"]}
    folder = site / "developers"
    listed = {page.name for page in folder.glob("*.html") if f"developers/{page.name}" in places}
    assert listed == {"api-decisions.html", "dependencies.html", "extend.html", "notes.html", "versions.html"}
    links = (folder / "notes.html").read_text(encoding="utf-8")
    for page in folder.glob("*.html"):
        if page.name not in listed:
            assert f'href="developers/{page.name}"' not in shown and f'href="{page.name}"' in links, page.name


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

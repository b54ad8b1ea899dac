"""Pages, help texts, examples and docstrings use the terms of the field: no home-made words.

The glossary (docs/reference/glossary.md) has one term per thing. Each entry below is a word that users would not know,
or would misunderstand, with the term to use. Public names that are older (``closure``, ``opening``, ``worn_depth``,
``shift``, ``left_out``) stand in code quotes, which are not searched.
"""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

HOME_MADE = {
    r"scenes?": "case, problem",
    r"scenes? that repeats?": "periodic",
    r"free space": "non-periodic, infinite half-space",
    r"(like|equal) bodies": "elastically similar bodies, or identical bodies",
    r"(act|acts) on each other": "normal-tangential coupling",
    r"(largest|peak|max) pressures?": "maximum contact pressure",
    r"turning force": "rotating tangential force",
    r"twist moment": "torsional moment",
    r"energy lost|work of friction|lost in the cycle": "dissipated energy",
    r"worn depth": "wear depth",
    r"shares? of": "fraction of",
    r"accumulated slip|slip accumulated": "relative slip since the start, or slip distance",
    r"ladders?|rungs?|climbs?": "refinement study, level",
    r"headline numbers?": "quantity of interest",
    r"companions?": "auxiliary coarse solution",
    r"between the cells(?!')": "sub-cell reconstruction",
    r"(in front of|behind) (a|the) mirrors?|without its mirrors": "with symmetry reduction",
    r"left out|leaves? out|leaving out": "automatic simplification, skipped, without",
    r"in boxes|the box|a box": "active subdomain",
    r"own cell|own zz": "self-influence coefficient",
    r"looks? at the equations": "residual evaluation",
    r"frozen (zones?|problems?|contact)": "linearised problem on fixed active sets",
    r"six digits|all digits": "single precision, double precision",
    r"fronts? (of slip )?(are |is )?carried": "extrapolation of the stick-slip boundary",
    r"mended": "fixed",
    r"judged?|judges?|verdicts?": "check, residual, reference",
    r"a line an|a line a|an increment of its own|a row a|a file a": "per",
    r"cells a (side|wave|period)|points? a|one an increment": "per",
    r"not given": "default",
    r"rooms?|floors?|house": "module, layer, architecture",
    r"at the most|at the least": "at most, at least",
    r"broken off": "interrupted",
    r"goes? on|going on|went on": "continue",
    r"to and fro|there and back": "cyclic, reversal",
    r"a blink": "under a second",
    r"twins?": "second implementation",
    r"journey|sister|kin": "(plain words)",
    r"in the mean square": "RMS, L2",
    r"nobody asked": "not requested",
    r"E1/E2": "E_c/E_s, defined where first used",
    r"mu W|T/mu ?W": "mu P: W is not a force",
    r"Hertz,? \(?1882": "Hertz 1881",
    r"steady closure|closure of": "cycle-to-cycle change",
}
"""Home-made expressions, as regular expressions over whole words, and the terms to use."""

ALLOWED = {
    r"room for": "space for",
    r"memory is there|in-house": "idioms",
    r"not a companion|whose companion is|companion on coatings": "a companion paper",
    r"peak_pressure|max pressure|max_pressure": "names in output and API, until they are renamed",
    r"fret schema|json schema": "no scene",
}
"""Expressions that hold a home-made word and are right."""

TEXTS = [ROOT / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "python/README.md")]
PAGES = sorted([*TEXTS, *ROOT.glob("crates/*/README.md"), *(ROOT / "docs").rglob("*.md")])
DIARIES = {
    "performance-log.md",
    "2026-11-usability.md",
    "2026-11-checks.md",
    "2026-11-refinement-studies.md",
    "2026-11-reviews-again.md",
    "simplifications-measured.md",
}
"""Developers' notes of a day: kept as they were written, and say so.

The last is printed by a program whose cases have short names.
"""


def plain(markdown: str) -> str:
    """Return a page without code, links' targets, formulas and HTML."""
    text = re.sub(r"```.*?```", " ", markdown, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->", " ", text, flags=re.DOTALL)
    text = re.sub(r"`[^`\n]*`", " ", text)
    text = re.sub(r"\]\([^)]*\)", "] ", text)
    return re.sub(r"\$[^$]*\$", " ", text)


def found(text: str) -> list[str]:
    """Return the home-made words of a text, each with its place and the term to use."""
    for allowed in ALLOWED:
        text = re.sub(allowed, lambda match: "_" * len(match[0]), text, flags=re.IGNORECASE)
    hits = []
    for word, term in HOME_MADE.items():
        flags = 0 if word[0].isupper() or word.startswith("mu") else re.IGNORECASE
        for match in re.finditer(rf"(?<![\w-])(?:{word})(?![\w-])", " ".join(text.split()), flags):
            around = match.string[max(match.start() - 40, 0) : match.end() + 30]
            hits.append(f"{match[0]!r} -> {term}: ...{around}...")
    return hits


@pytest.mark.parametrize(
    "page", [p for p in PAGES if p.name not in DIARIES], ids=lambda page: page.relative_to(ROOT).as_posix()
)
def test_pages(page: Path) -> None:
    assert found(plain(page.read_text(encoding="utf-8"))) == []


def test_diaries_say_that_they_are() -> None:
    for name in DIARIES - {"simplifications-measured.md"}:
        assert "Developers' notes, dated" in (ROOT / "docs" / "developers" / name).read_text(encoding="utf-8"), name


COMMANDS = ["", "run", "check", "plan", "schema", "report", "export", "study", "stress", "sweep"]


@pytest.mark.parametrize("command", COMMANDS)
def test_help_texts(command: str) -> None:
    call = [sys.executable, "-m", "fretting", *command.split(), "--help"]
    told = subprocess.run(call, capture_output=True, text=True, check=True, timeout=600).stdout
    assert found(re.sub(r"--leave-out", "", told)) == []


def test_schema() -> None:
    text = (ROOT / "examples" / "fret.schema.json").read_text(encoding="utf-8")
    described = " ".join(re.findall(r'"description": "((?:[^"\\]|\\.)*)"', text))
    assert found(re.sub(r"`[^`]*`", "", described)) == []


@pytest.mark.parametrize("case", sorted((ROOT / "examples").rglob("*.toml")), ids=lambda path: path.name)
def test_examples(case: Path) -> None:
    text = case.read_text(encoding="utf-8")
    told = " ".join(re.findall(r"#([^\n]*)", text) + re.findall(r'^title = "(.*)"', text, re.MULTILINE))
    assert found(told) == []


def docstrings() -> list[tuple[str, str]]:
    """Return the docstrings of the package with their places."""
    all_of_them = []
    for path in sorted((ROOT / "python" / "fretting").glob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        alone = (node.value for node in ast.walk(tree) if isinstance(node, ast.Expr))
        texts = (value for value in alone if isinstance(value, ast.Constant) and isinstance(value.value, str))
        all_of_them += [(f"{path.name}:{value.lineno}", str(value.value)) for value in texts]
    return all_of_them


def test_docstrings() -> None:
    hits = [f"{place} {hit}" for place, text in docstrings() for hit in found(re.sub(r"`+[^`]*`+", "", text))]
    assert hits == []


def test_the_search_finds_what_it_looks_for() -> None:
    assert (
        len(
            found("The scene that repeats has like bodies; the largest pressure is a share of it, a line an increment.")
        )
        >= 5
    )
    assert found("The case is periodic; room for the scar; its companion, whose companion is a paper") != []
    assert found("room for the scar") == []

"""What the pages show runs as it stands there, and the site builds without a warning."""

import contextlib
import importlib.util
import io
import json
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted([ROOT / "README.md", ROOT / "python" / "README.md", *(ROOT / "docs").rglob("*.md")])
BLOCK = re.compile(r"^```(\w+)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)

NOT_RUN = (
    "pip ",
    "cargo install",
    "cargo xtask",
    "cargo run --release -p ",
    "cargo +nightly fuzz",
    "python docs/site",
    "python docs/data/reviews",
    "mpiexec",
)
"""Beginnings of shell lines that are for a person: they install, or are run by other tests."""


def blocks(page: Path) -> list[tuple[str, str]]:
    return BLOCK.findall(page.read_text(encoding="utf-8"))


def whole_case(shown: str) -> dict[str, Any]:
    """Put what a page shows of a case into a case that has the rest."""
    rest = tomllib.loads("""
        grid = { cells = [24, 24], size = [240e-6, 240e-6] }
        upper = { rigid = true }
        lower.coatings = [{ thickness = 5e-6, young = 400e9, poisson = 0.2 }]
        lower.substrate = { young = 210e9, poisson = 0.3 }
        profile = { sphere = { radius = 10e-3 } }
        friction = { coefficient = 0.2 }
        load = [{ normal_force = 1.0, increments = 1 }]
    """)
    part = tomllib.loads(shown)
    stages = part.get("load", [{"normal_force": 1.0}])
    if not {"normal_force", "approach"} & stages[0].keys():
        part["load"] = [*rest["load"], *stages]
    if "map" in part.get("friction", {}):
        rest.pop("friction")
    for body in ("upper", "lower"):
        if "substrate" in part.get(body, {}):
            rest[body] = {}
    return {**rest, **part, **{body: {**rest[body], **part.get(body, {})} for body in ("upper", "lower")}}


def run_shell(text: str, folder: Path) -> None:
    for line in text.splitlines():
        command = line.split("#")[0].strip().replace("cargo run --release -- ", "fret ")
        if not command or command.startswith(NOT_RUN):
            continue
        assert command.startswith("fret "), f"a page shows a command that no test knows: {command}"
        # That each example is a good case is what a page promises; other tests solve smaller ones.
        command = re.sub(r"^fret run (examples/\S+)$", r"fret plan \1", command)
        words = [sys.executable, "-m", "fretting", *shlex.split(command)[1:]]
        if "CASE" in words or "DIR" in words:
            continue
        done = subprocess.run(words, capture_output=True, text=True, timeout=600, check=False, cwd=folder)
        assert done.returncode == 0, f"{command}\n{done.stderr}"


def check_toml(text: str, folder: Path) -> None:
    named = re.match(r"# ([\w.-]+\.toml)\n", text)
    if named:
        (folder / named[1]).write_text(text)
    if "base" in tomllib.loads(text) and {"axes", "distributions"} & set(tomllib.loads(text)):
        return  # a sweep, which a command of the page solves
    for name in re.findall(r'"([\w.-]+\.npy)"', text):
        rng = np.random.default_rng(1)
        np.save(folder / name, rng.random(whole_case(text)["grid"]["cells"]))
    fretting.plan(whole_case(text))


LONG = {"subsurface-stresses.md"}
"""Pages whose snippets take long."""


@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, marks=[pytest.mark.long] * (page.name in LONG), id=page.relative_to(ROOT).as_posix())
        for page in PAGES
    ],
)
def test_snippets_run_in_their_order(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = [(language, text) for language, text in blocks(page) if language in ("python", "toml", "sh", "bash")]
    if not found:
        pytest.skip("shows nothing to run")
    if any("plot" in text or "savefig" in text for _, text in found):
        matplotlib = pytest.importorskip("matplotlib")
        matplotlib.use("Agg")
    if any("sweep(" in text or "xarray" in text for _, text in found):
        pytest.importorskip("xarray")
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "page"}
    printed = io.StringIO()
    for number, (language, text) in enumerate(found, 1):
        if text.startswith(("# with a measurement of your own", "# with a line scan of your own")):
            continue
        if language == "python":
            with contextlib.redirect_stdout(printed):
                exec(compile(text, f"{page.name}, snippet {number}", "exec"), names)
        elif language == "toml":
            check_toml(text, tmp_path)
        else:
            run_shell(text, tmp_path)
    if page.name == "README.md" or page.parent.name == "learn":
        shown = re.findall(r"^print\(.*\) +# (.*)$", "\n".join(text for _, text in found), re.MULTILINE)
        for number in re.findall(r"\d+(?:\.\d+)?", " ".join(shown)):
            assert number in printed.getvalue(), f"the page says {number}, which its code does not print"
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")


def test_notebooks_of_tutorials_lead_nowhere_but_to_the_network() -> None:
    pytest.importorskip("latex2mathml")
    hooks = module(ROOT / "docs" / "site" / "hooks.py")
    tutorials = [page for page in PAGES if page.parent.name == "learn" and "```python" in page.read_text()]
    assert tutorials
    for page in tutorials:
        cells = hooks.notebook(page.read_text(encoding="utf-8"))["cells"]
        words = "".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
        assert re.findall(r"\]\((?![a-z]+:)[^)]*\)", words) == [], page.name


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    for target in re.findall(r"\]\(([^)\s#]+)", text):
        if not re.match(r"[a-z]+:", target):
            assert (page.parent / target).exists(), target


def module(path: Path) -> Any:
    """Load a script of the documentation."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


def test_the_page_of_keys_is_that_of_the_schema() -> None:
    schema = json.loads((ROOT / "examples" / "fret.schema.json").read_text(encoding="utf-8"))
    written = module(ROOT / "docs" / "site" / "case_format.py").page(schema)
    page = (ROOT / "docs" / "reference" / "case-format.md").read_text(encoding="utf-8")
    assert page == written, "run docs/site/case_format.py"


def test_closed_forms_are_those_of_the_catalogue() -> None:
    written = (ROOT / "python" / "fretting" / "analytic" / "_generated.py").read_text(encoding="utf-8")
    generated = module(ROOT / "docs" / "site" / "closed_forms.py").generated()
    assert written == generated, "run docs/site/closed_forms.py"


def test_reference_pages_say_what_the_program_says() -> None:
    generated = module(ROOT / "docs" / "site" / "reference.py")
    for name, page in generated.PAGES.items():
        written = (ROOT / "docs" / "reference" / f"{name}.md").read_text(encoding="utf-8")
        assert written == page(), "run docs/site/reference.py"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_figures_tables_and_numbers_are_those_of_their_files(page: Path) -> None:
    render = module(ROOT / "docs" / "data" / "render.py")
    text = page.read_text(encoding="utf-8")
    assert render.rendered(text, page) == text, "run docs/data/render.py"


def test_measured_numbers_name_their_origin() -> None:
    for path in (ROOT / "docs" / "data").glob("*.json"):
        found = json.loads(path.read_text(encoding="utf-8"))
        assert {"date", "commit", "version", "machine"} <= found["measured"].keys(), path.name
        assert found["by"], path.name


def test_no_picture_is_older_than_its_script() -> None:
    draw = module(ROOT / "docs" / "pictures" / "draw.py")
    assert draw.stale() == [], "run docs/pictures/draw.py --stale"


def test_every_picture_has_its_script_and_every_script_its_page() -> None:
    draw = module(ROOT / "docs" / "pictures" / "draw.py")
    drawn = {path.stem for suffix in ("png", "svg") for path in (ROOT / "docs" / "pictures").glob(f"*.{suffix}")}
    assert drawn == draw.scripts().keys()
    shown = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    assert [name for name in drawn if f"<!-- figure {name} -->" not in shown] == []


@pytest.mark.long
def test_the_site_builds_without_a_warning(tmp_path: Path) -> None:
    for name in ("material", "mkdocstrings", "latex2mathml"):
        pytest.importorskip(name)
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", tmp_path / "site"],
        capture_output=True, text=True, timeout=600, check=False, cwd=ROOT,
        env={"NO_MKDOCS_2_WARNING": "1", "PATH": ""},
    )  # fmt: skip
    assert (done.returncode, done.stdout.strip()) == (0, ""), done.stdout + done.stderr
    assert "contact_area" in (tmp_path / "site" / "reference" / "python.html").read_text(encoding="utf-8")
    for tutorial in (ROOT / "docs" / "learn").glob("*.md"):
        snippets = [text for language, text in blocks(tutorial) if language == "python"]
        if snippets:
            written = json.loads((tmp_path / "site" / "learn" / f"{tutorial.stem}.ipynb").read_text(encoding="utf-8"))
            code = ["".join(cell["source"]) for cell in written["cells"] if cell["cell_type"] == "code"]
            assert [text for text in code if "%%writefile" not in text] == [text.strip() for text in snippets], (
                tutorial.name
            )
    for page in (tmp_path / "site").rglob("*.html"):
        for formula in re.findall(r"<math.*?</math>", page.read_text(encoding="utf-8"), re.DOTALL):
            assert "\\" not in re.sub(r"<[^>]+>", "", formula), (
                f"{page.name}: a formula is not understood: {formula[:200]}"
            )


def test_the_page_of_the_rig_shows_what_log_and_model_give(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    page = (ROOT / "docs" / "do" / "compare-with-a-rig.md").read_text(encoding="utf-8")
    text = re.search(r"```toml\n(# driven\.toml\n.*?)```", page, re.DOTALL)
    assert text is not None
    model = fretting.run(tomllib.loads(text[1])).cycles
    log = fretting.identify("examples/rig/test_12.csv", case="examples/rig/ball_on_ball.toml").cycles
    rows = {
        "$W_d$": (log["dissipated_energy"], model["dissipated_energy"], "{:.3f}", 1.0),
        "$Q^*$": (log["force_amplitude"], model["force_amplitude"], "{:.1f}", 1.0),
        "amplitude of the actuator": (log["displacement_amplitude"], model["actuator_amplitude"], "{:.2f}", 1e3),
        "$A$ at the actuator": (log["energy_ratio"], model["actuator_energy_ratio"], "{:.3f}", 1.0),
        "$D$ at the actuator": (log["sliding_ratio"], model["actuator_sliding_ratio"], "{:.3f}", 1.0),
    }
    for name, (measured, computed, form, factor) in rows.items():
        expected = [form.format(factor * values[-1]) for values in (measured, computed)]
        shown = next(line for line in page.splitlines() if line.startswith(f"| {name} |")).split("|")[2:4]
        assert [cell.split()[0] for cell in shown] == expected, name


def test_names_on_the_page_of_extensions_are_in_the_program() -> None:
    """Files, functions and types that stand there between backticks; results of a run are no files of the program."""
    listed = [path for part in ("crates", "docs", "python", "tests") for path in (ROOT / part).rglob("*.*")]
    program = [path for path in listed if path.suffix in (".rs", ".py", ".toml")]
    words = {word for path in program for word in re.findall(r"\w+", path.read_text(encoding="utf-8"))}
    gone = []
    for term in re.findall(r"`([^`\n]+)`", (ROOT / "docs" / "developers" / "extend.md").read_text(encoding="utf-8")):
        if re.fullmatch(r"[\w/-]+\.(rs|py|css|toml)", term):
            if not any(path.as_posix().endswith(f"/{term}") for path in listed):
                gone.append(term)
        elif re.fullmatch(r"\w+(::\w+)*", term) and not set(term.split("::")) <= words:
            gone.append(term)
    assert not gone


def test_the_page_of_messages_says_what_the_program_says(tmp_path: Path) -> None:
    lines = ["[grid]", "cells = [16, 16]", 'size = "auto"', "[upper]", "rigid = true", "[lower.substrate]"]
    lines += ["young = 210e9", "poisson = 0.3", "[[load]]", "normal_force = 1.0", "increments = 1"]
    lines += ["[profile.sphere]", "radius = -10e-3", "", "[friction]", "coeficient = 0.2", ""]
    (tmp_path / "ball.toml").write_text("\n".join(lines), encoding="utf-8")
    call = [sys.executable, "-m", "fretting", "check", "ball.toml"]
    told = subprocess.run(call, capture_output=True, text=True, timeout=600, check=False, cwd=tmp_path).stderr
    assert told.strip() in (ROOT / "docs" / "reference" / "messages.md").read_text(encoding="utf-8")

"""Write the page of all examples, docs/examples.md, and draw a thumbnail of each.

    python docs/site/examples.py            draws what has changed since it was drawn, and writes the page
    python docs/site/examples.py --all      draws all of them; a few minutes

Titles, words and groups come from the files themselves. A thumbnail, ``docs/pictures/examples/NAME.png``, carries the
hash of its case and of the files that the case names. Tests compare page and hashes.
"""

import ast
import csv
import hashlib
import html
import json
import re
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
PICTURES = ROOT / "docs" / "pictures" / "examples"
PAGE = ROOT / "docs" / "examples.md"
HEAD = """---
search:
  boost: 0.5
---

# All examples

<!-- Written by docs/site/examples.py from the files of examples/: edit the comments at their beginning. -->

Every case file of `examples/`, with what it shows. `fret run FILE` solves it, `fret report` of its folder of results makes a page with pictures, `fret explore FILE` gives it sliders; figures with their scripts are in the [gallery](gallery.md).

A thumbnail has the loop or the path of the load on the left (one increment and rolling: pressure, and shear, along x); on the right, at the largest load, stick (blue) and slip (orange), else the contact pressure, dark to bright; of line contacts pressure (blue) and shear along x; of wear the wear depth. Of sweeps: sliding conditions over both axes, and lives or dissipated energy along one.
"""

Case = dict[str, Any]
FIRST = (
    "hertz",
    "cylinder_on_flat",
    "gross_slip",
    "friction/cattaneo_mindlin",
    "coated_sphere",
    "dlc_ball_on_flat",
    "bonded_tile",
)
GROUPS: list[tuple[str, Callable[[str, Case], bool]]] = [
    ("First contacts and coatings", lambda name, _: name.removesuffix(".toml") in FIRST),
    ("Bodies and surfaces", lambda name, _: name.startswith("surfaces/")),
    ("Friction that varies", lambda name, _: name.startswith("friction/")),
    ("Rolling", lambda _, case: any("roll" in stage for stage in case.get("load", []))),
    ("Wear", lambda _, case: "wear" in case),
    (
        "Stress and fatigue",
        lambda _, case: "stress" in case or any("bulk_stress" in stage for stage in case.get("load", [])),
    ),
    ("Heat and current", lambda _, case: "thermal" in case),
    ("Measured logs", lambda name, _: name.startswith(("rig/", "indentation/"))),
    ("Sweeps", lambda _, case: "axes" in case),
    ("Figures of a paper", lambda name, _: "paper_figure" in name),
    ("Loads and motions", lambda _, __: True),
]
"""Headings with what stands below them: the first that fits."""


def cases() -> dict[str, Case]:
    """Return all case and sweep files by their path within the examples."""
    paths = sorted(EXAMPLES.rglob("*.toml"))
    return {path.relative_to(EXAMPLES).as_posix(): tomllib.loads(path.read_text(encoding="utf-8")) for path in paths}


def taught(name: str) -> tuple[str, str]:
    """Return the title of an example, and what it shows: its key ``title`` and the comment at its beginning."""
    text = (EXAMPLES / name).read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#:schema")]
    comment = []
    for line in lines:
        if not line.startswith("#"):
            break
        comment.append(line[1:].strip() if not line.startswith("#   ") else "")
    paragraphs = [" ".join(part.split()) for part in re.split(r"\n\n+", "\n".join(comment)) if part.strip()]
    case = tomllib.loads(text)
    title = case.get("title", "")
    if not title:  # of a sweep: what its comment says before the colon
        title, _, rest = paragraphs[0].partition(": ")
        paragraphs[0] = rest[:1].upper() + rest[1:]
    return title[:1].upper() + title[1:], " ".join(paragraphs)


def scripts() -> dict[str, str]:
    """Return the Python and Rust programs among the examples, by their path, with their first sentence."""
    found = {}
    for path in [*sorted(EXAMPLES.rglob("*.py")), *sorted(ROOT.glob("crates/*/examples/*.rs"))]:
        text = path.read_text(encoding="utf-8")
        words = ast.get_docstring(ast.parse(text)) if path.suffix == ".py" else re.sub(r"^//! ?", "", text, flags=re.M)
        found[path.relative_to(ROOT).as_posix()] = " ".join((words or "").partition("\n\n")[0].split())
    return found


def page() -> str:
    """Return the page."""
    every = cases()
    grouped: dict[str, list[str]] = {heading: [] for heading, _ in GROUPS}
    for name, case in every.items():
        grouped[next(heading for heading, belongs in GROUPS if belongs(name, case))].append(name)
    shown_on = _pages()
    parts = [HEAD]
    for heading, names in grouped.items():
        rows = ["| | |", "|---|---|"]
        for name in names:
            title, words = taught(name)
            where = ", ".join(f"[{title}]({page})" for page, title in shown_on.get(name, []))
            picture = Path(name).with_suffix(".png").as_posix()
            rows.append(
                f"| ![{_plain(title)}](pictures/examples/{picture}) | **{_plain(title)}** [`{name}`](../examples/{name})"
                f"<br>{_plain(words)}{f' *On pages:* {where}.' if where else ''} |"
            )
        parts.append(f"## {heading}\n\n" + "\n".join(rows) + "\n")
    rows = ["| program | what it does |", "|---|---|"]
    rows += [f"| [`{name}`](../{name}) | {_plain(words)} |" for name, words in scripts().items()]
    parts.append("## Programs\n\n" + "\n".join(rows) + "\n")
    return "\n".join(parts)


def _pages() -> dict[str, list[tuple[str, str]]]:
    """Return the pages for users that name an example, with their titles, by the example."""
    docs = PAGE.parent
    found: dict[str, list[tuple[str, str]]] = {}
    for folder in ("learn", "do", "theory", "trust"):
        for path in sorted((docs / folder).glob("*.md")):
            text = path.read_text(encoding="utf-8")
            heading = re.search(r"^# (.*)$", text, re.MULTILINE)
            for name in sorted(set(re.findall(r"examples/([\w/]+\.toml)", text))):
                title = heading[1] if heading else path.stem
                found.setdefault(name, []).append((path.relative_to(docs).as_posix(), title))
    return found


def _plain(words: str) -> str:
    """Return words as Markdown that shows them as they are; code stays code."""
    parts = re.split(r"(`[^`]*`)", words)
    shown = [
        part if part.startswith("`") else re.sub(r"([*_|\[\]])", r"\\\1", html.escape(part, quote=False))
        for part in parts
    ]
    return "".join(shown)


def fingerprint(name: str) -> str:
    """Return the hash of what a case says and of the files beside it that it names; its comments do not count."""
    path = EXAMPLES / name
    text = json.dumps(tomllib.loads(path.read_text(encoding="utf-8")), sort_keys=True, default=str)
    digest = hashlib.sha256(text.encode())
    for named in sorted(set(re.findall(r'"([\w./-]+\.(?:npy|txt|csv|toml))"', text))):
        beside = path.parent / named
        digest.update(
            beside.read_bytes()
            if beside.suffix != ".toml"
            else fingerprint(beside.resolve().relative_to(EXAMPLES).as_posix()).encode()
        )
    return digest.hexdigest()[:16]


def picture(name: str) -> Path:
    """Return the thumbnail of an example."""
    return PICTURES / Path(name).with_suffix(".png")


def stale() -> list[str]:
    """Return the examples whose thumbnail is missing, or was drawn of another case."""
    return [
        name
        for name in cases()
        if not picture(name).exists() or fingerprint(name).encode() not in picture(name).read_bytes()
    ]


def draw(name: str) -> None:
    """Draw the thumbnail of an example."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    import fretting

    case = cases()[name]
    look = {"font.size": 6, "axes.labelsize": 6, "axes.titlesize": 6, "xtick.labelsize": 5, "ytick.labelsize": 5}
    with fretting.plot.style(), mpl.rc_context({**look, "figure.figsize": (2.5, 1.1), "axes.linewidth": 0.5}):
        figure, axes = plt.subplots(1, 2)
        (_sweep if "axes" in case else _history)(name, case, axes)
        for panel in axes:
            panel.set(xlabel="", ylabel="", title="")
            panel.tick_params(which="both", bottom=False, left=False, labelbottom=False, labelleft=False)
            for text in (panel.xaxis.offsetText, panel.yaxis.offsetText):
                text.set_visible(False)
            if panel.get_legend():
                panel.get_legend().remove()
        picture(name).parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(picture(name), dpi=160, metadata={"Comment": fingerprint(name), "Software": None})
        plt.close(figure)


def _history(name: str, case: Case, axes: Any) -> None:
    """Draw loop and zones, or what else a case is about."""
    import numpy as np

    import fretting

    fields = ["pressure", "shear", "zone", *(["worn_depth"] if "wear" in case else [])]
    # what is kept and evaluated besides is no part of the picture
    asked = {key: value for key, value in case.items() if key not in ("output", "stress", "thermal", "rig")}
    if "rig" in case:
        asked["rig"] = {key: value for key, value in case["rig"].items() if key != "columns"}
    asked["output"] = {"fields": fields, "every": 1 if "wear" not in case else 16}
    history = fretting.run(_beside(asked, (EXAMPLES / name).parent))
    left, right = axes
    columns = history.increments
    moves = {"x": "tangential_force_x", "y": "tangential_force_y", "twist": "twist_moment"}
    kept = np.array(history.kept_increments)
    force = sum(columns[column] ** 2 for column in list(moves.values())[:2]) + columns["twist_moment"] ** 2
    chosen = int(kept[force[kept].argmax()]) if force.any() else int(kept[columns["normal_force"][kept].argmax()])
    moved = any(np.ptp(columns[column]) > 0.0 for column in moves.values())
    if len(history) == 1 or any("roll" in stage for stage in case["load"]):
        fretting.plot.section(history, ("pressure", "shear_x") if moved else "pressure", chosen, ax=left)
    elif moved:
        fretting.plot.loop(history, ax=left)
    else:
        left.plot(columns["approach"], columns["normal_force"])
    zones = set(np.unique(history.field("zone", chosen)))
    if "wear" in case:
        fretting.plot.field(history, "worn_depth", ax=right)
    elif history.is_line:
        fretting.plot.section(history, ("pressure", "shear_x"), chosen, ax=right)
    elif {1, 2} <= zones:
        fretting.plot.zones(history, chosen, ax=right)
    else:
        fretting.plot.field(history, "pressure", chosen, ax=right)
    for bar in axes[0].figure.axes[2:]:
        bar.remove()
    long, short = sorted((np.ptp(history.x), np.ptp(history.y)), reverse=True)
    right.set_aspect("equal" if short > 0.4 * long else "auto")


def _beside(case: Case, folder: Path) -> Case:
    """Return a case whose files are named from anywhere."""

    def whole(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: whole(part) for key, part in value.items()}
        if isinstance(value, list):
            return [whole(part) for part in value]
        if isinstance(value, str) and value.endswith((".npy", ".txt", ".csv")) and (folder / value).exists():
            return str(folder / value)
        return value

    found = whole(case)
    assert isinstance(found, dict)
    return found


def _sweep(name: str, case: Case, axes: Any) -> None:
    """Draw the sliding condition over the axes of a sweep, and what comes out along the last axis."""
    import fretting

    slow, fast = case["axes"]
    with tempfile.TemporaryDirectory() as folder:
        call = [sys.executable, "-m", "fretting", "sweep", str(EXAMPLES / name), "--out", f"{folder}/sweep", "--quiet"]
        subprocess.run(call, check=True)
        with Path(folder, "sweep", "summary.csv").open(encoding="utf-8", newline="") as table:
            points = [{key.partition(" [")[0]: value for key, value in row.items()} for row in csv.DictReader(table)]
    map_of, curves = axes
    colours = dict(fretting.plot.REGIMES)
    across, up = ([float(point[axis]) for point in points] for axis in (fast, slow))
    shown = [colours[point["cycle_regime"]] for point in points]
    map_of.scatter(across, up, c=shown, s=26, edgecolors="0.4", linewidths=0.3)
    what = next(key for key in ("smith_watson_topper_cycles", "cycle_dissipated_energy") if key in points[0])
    for value in dict.fromkeys(point[slow] for point in points):
        line = [point for point in points if point[slow] == value]
        curves.plot([float(point[fast]) for point in line], [float(point[what]) for point in line])
    curves.set_yscale("log")
    for panel in axes:
        panel.set_xscale("log" if max(across) > 5 * min(across) else "linear")
    map_of.set_yscale("log" if max(up) > 5 * min(up) else "linear")
    map_of.margins(0.15)


if __name__ == "__main__":
    for example in cases() if sys.argv[1:] == ["--all"] else stale():
        draw(example)
        print(picture(example).relative_to(ROOT))
    PAGE.write_text(page(), encoding="utf-8")

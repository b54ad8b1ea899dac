"""Write figures, tables and numbers into the pages.

    python docs/data/render.py

A page holds places such as ``<!-- table cost -->...<!-- end -->``: what stands between is written by this script,
tables and numbers from ``docs/data/*.json`` and from pages that other commands write, figures with the caption that
their script carries. A test fails when a page differs from what this script would write.
"""

import ast
import json
import math
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
import experiment_tables

DOCS = HERE.parent
ROOT = DOCS.parent
PLACE = re.compile(r"<!-- (figure|table|number) ([\w-]+) -->(.*?)<!-- end -->", re.DOTALL)
PAGES = sorted([ROOT / "README.md", *DOCS.rglob("*.md")])


def data(name: str) -> Any:
    """Return a file of measurements."""
    return json.loads((HERE / f"{name}.json").read_text(encoding="utf-8"))


def rendered(text: str, page: Path) -> str:
    """Return a page with every place filled in; links of tables that begin with @ start at the folder of the pages."""

    def fill(place: re.Match[str]) -> str:
        kind, name, _ = place.groups()
        if kind == "number":
            return f"<!-- number {name} -->{NUMBERS[name]()}<!-- end -->"
        here = Path(os.path.relpath(DOCS, page.parent)).as_posix()
        body = figure(name, page) if kind == "figure" else TABLES[name]().replace("](@", f"]({here}/")
        return f"<!-- {kind} {name} -->\n\n{body}\n\n<!-- end -->"

    return PLACE.sub(fill, text)


def caption(name: str) -> tuple[str, str]:
    """Return title and text of a figure: the docstring of its script."""
    script = DOCS / "pictures" / f"{name}.py"
    docstring = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or ""
    title, _, text = docstring.partition("\n\n")
    return " ".join(title.split()), " ".join(text.split()).replace("*", "\\*").replace("_", "\\_")


def figure(name: str, page: Path) -> str:
    """Return a picture with its caption, as seen from a page."""
    title, text = caption(name)
    folder = DOCS / "pictures"
    picture = folder / f"{name}.svg" if (folder / f"{name}.svg").exists() else folder / f"{name}.png"
    path = Path(os.path.relpath(picture, page.parent)).as_posix()
    return f"![{title.rstrip('.')}]({path})\n\n*{title} {text} Script: `docs/pictures/{name}.py`.*"


def _table(head: list[str], rows: list[list[str]], of: dict[str, Any]) -> str:
    lines = [" | ".join(head), "|".join("---" for _ in head), *(" | ".join(row) for row in rows)]
    body = "\n".join(f"| {line} |" if number != 1 else f"|{line}|" for number, line in enumerate(lines))
    measured = of["measured"]
    return (
        f"{body}\n\n*Measured {measured['date']}, version {measured['version']}, commit {measured['commit']}, {measured['machine']}; "
        f"`{of['by']}`.*"
    )


def _power(value: float | None, digits: int = 1) -> str:
    return "-" if value is None else f"{abs(value):.{digits}e}".replace("e-0", "e-")


def _percent(value: float) -> str:
    return f"{100 * value:+.0f} %" if abs(value) >= 0.095 else f"{100 * value:+.1f} %"


def verification() -> str:
    """Return the table of the page Verification in two minutes."""
    of = data("verification")
    hertz, partial, coated = of["hertz"], of["cattaneo_mindlin"], of["coated_sphere"]
    rows = [
        ["normal contact", "Hertz", "approach / maximum pressure", "256 x 256", f"{_power(hertz['approach'])} / {_power(hertz['max_pressure'])}"],
        ["coated sphere, $E_c/E_s$ = 1/4 to 4", "axisymmetric integral equation", "approach / maximum pressure", "128 x 128",
         f"{_power(coated['approach'])} / {_power(coated['max_pressure'])}"],
        ["partial slip, identical bodies", "Cattaneo-Mindlin", "displacement / stick area / energy", "64 x 64",
         f"{_power(partial['shift'])} / {_power(partial['stick_area'])} / {_power(partial['dissipated_energy'])}"],
        ["fretting loop, 0.9 $\\mu P$", "Mindlin-Deresiewicz", "displacement / energy", "128 x 128",
         f"{_power(of['loop']['displacement'])} / {_power(of['loop']['dissipated_energy'])}"],
        ["torsion to 0.9 of full slip", "Lubkin", "rotation", "96 x 96", _power(of["torsion"]["twist"])],
        ["coupled indentation, $\\mu$ = 0.304", "Spence", "stick radius / contact radius, 40 increments", "96 x 96",
         f"{of['spence']['stick_radius'] - 0.9:+.3f} (half a cell: {of['spence']['half_cell']:.3f})"],
        ["subsurface stress, coated", "Hankel integrals", "$\\sigma_{zz}$, $\\sigma_{rr}$ on the axis", "256 x 256", "1.3e-8 ([record](@trust/verification-record.md#subsurface-stress))"],
        ["wear in partial slip", "Popov's limiting shape", "force / pressure", "48 x 48", "5e-3 / 9e-3 ([record](@trust/verification-record.md#loadings))"],
        ["rough contact", "ContactMechanics, same operator", "pressure", "40 x 40", "2.6e-12 ([record](@trust/verification-record.md#profiles))"],
        experiment_tables.verification_row(data("experiments")),
    ]  # fmt: skip
    return _table(["capability", "reference", "quantity", "grid", "relative error"], rows, of)


def spence() -> str:
    """Return the table of the history error."""
    of = data("spence")
    rows = [
        [
            f"{row['friction']:g}",
            f"{row['ramp']}, {row['increments']}",
            _power(row["shear_error"]),
            _percent(row["energy_error"]),
            f"{row['stick_radius']:.3f} ({row['stick_radius_exact']:g})",
            str(row["convolutions"]),
        ]
        for row in of["rows"]
    ]
    head = [
        "$\\mu$",
        "ramp, increments",
        "shear traction, L2",
        "dissipated energy",
        "stick radius (Spence)",
        "convolutions",
    ]
    return _table(head, rows, of)


def orders() -> str:
    """Return the table of the orders of histories of every kind."""
    of = data("orders")
    rows = []
    for row in of["rows"]:
        rules = [row["end_point"], row["second_order"]]
        errors = [", ".join(f"{error:.1e}" for error in rule["errors"]) for rule in rules]
        at = of["counts"].index(32)
        counts = ", ".join(str(rule["convolutions"][at]) for rule in rules)
        rows.append(
            [row["history"], row["quantity"].replace("_", " "), *errors, f"{row['second_order']['order']:.1f}", counts]
        )
    counts = ", ".join(str(count) for count in of["counts"])
    head = ["cycle", "quantity", f"end point, {counts}", "second order", "order shown", "applications at 32"]
    return _table(head, rows, of)


def cost() -> str:
    """Return the table of costs."""
    of = data("cost")
    rows = []
    for row in of["rows"]:
        simplified, full = row["with"], row["without"]
        nx, ny = row["cells"]
        rows.append(
            [
                f"`{row['case']}`",
                row["what"],
                f"{nx} x {ny}",
                str(row["increments"]),
                f"{simplified['solve_s']:.2g} s",
                f"{full['solve_s']:.2g} s",
                str(simplified["convolutions"]),
            ]
        )
    return _table(
        ["example", "what", "cells", "increments", "time", "time without simplifications", "convolutions"], rows, of
    )


def moving_cost() -> str:
    """Return the table of what moving surfaces cost."""
    of = data("moving_cost")
    rows = [
        [
            row["case"],
            *(f"{row[kind]['applications']:.1f}" for kind in ("small", "finite")),
            f"{100 * (row['finite']['applications'] / row['small']['applications'] - 1):+.0f} %",
            *(f"{1e3 * row[kind]['seconds'] / row['increments']:.2f}" for kind in ("small", "finite")),
        ]
        for row in of["rows"]
    ]
    head = ["case", "applications per increment, small", "finite", "difference", "CPU time per increment [ms], small", "finite"]  # fmt: skip
    return _table(head, rows, of)


def others() -> str:
    """Return the times of other programs."""
    of = data("others")
    rows = []
    for row in of["rows"]:
        with_, without, tamaas, aspher = (
            row[key] for key in ("with_symmetry", "without_symmetry", "tamaas_periodic", "aspher")
        )
        rows.append(
            [
                f"{row['cells']} x {row['cells']}",
                f"{with_:g}",
                f"{without:g}",
                f"{aspher:g}",
                f"{aspher / with_:.1f} / {aspher / without:.1f}",
                f"{tamaas:g}",
                f"{tamaas / with_:.0f} / {tamaas / without:.0f}",
            ]
        )
    names = of["versions"]
    head = ["cells", "this, with symmetry [ms]", "this, without [ms]", f"aspher {names['aspher']} [ms]", "ratio with / without",
            f"tamaas {names['tamaas']}, periodic [ms]", "ratio with / without"]  # fmt: skip
    return _table(head, rows, of)


def _seconds(value: float | None) -> str:
    return "-" if value is None else f"{value:.2g}" if value < 10 else f"{value:.0f}"


SCENES = {
    "hertz": "Hertz",
    "rough 1 %": "rough, 1 % in contact",
    "rough 10 %": "rough, 10 %",
    "rough 50 %": "rough, 50 %",
    "cattaneo": "Cattaneo-Mindlin",
    "loop": "coated loop, 8 + 8 increments",
}


def large() -> str:
    """Return the table of large contacts."""
    of = data("large")
    known = {(row["scene"], row["cells"], row["program"]): row for row in of["rows"]}
    rows = []
    for scene, cells in sorted({key[:2] for key in known}, key=lambda key: (list(SCENES).index(key[0]), key[1])):
        us = known[scene, cells, "fretting"]
        whole = known.get((scene, cells, "fretting, nothing left out"))
        others = [known.get((scene, cells, name)) for name in ("aspher", "tamaas")]
        errors = us.get("errors", {})
        rows.append(
            [
                f"{SCENES[scene]}, {cells} x {cells}" + ("*" if "measured" in us else ""),
                f"{_seconds(us['wall_s'])} ({_seconds(us['cpu_s'])})",
                _seconds(whole and whole["wall_s"]),
                *(_seconds(other and other["solver_s"]) for other in others),
                "-" if us["memory"] is None else f"{us['memory'] / 1e6:.0f}",
                f"{us['applications'] / us['increments']:.0f}",
                _power(us["residual"], 0),
                _power(max((abs(error) for error in errors.values()), default=None)),
            ]
        )
    head = ["contact", "wall (CPU) [s]", "without simplifications [s]", "aspher [s]", "tamaas [s]", "memory [MB]", "applications an increment", "residual",
            "largest error"]  # fmt: skip
    return _table(head, rows, of) + _apart(of)


def _apart(of: dict[str, Any]) -> str:
    """Return when and with what the rows with a star were measured."""
    apart = {
        f"{row['measured']['date']}, commit {row['measured']['commit']}" for row in of["rows"] if "measured" in row
    }
    return f"\n\n\\* {'; '.join(sorted(apart))}." if apart else ""


def threads() -> str:
    """Return the table of the times on one thread and on two."""
    of = data("threads")
    names = {"loop": "coated loop, 8 + 8 increments", "hertz": "Hertz", "stress": "stresses at eight depths", "fatigue": "stresses and fatigue at eight depths, 17 increments",
             "line": "line contact, 4 + 96 increments"}  # fmt: skip
    rows = [
        [
            f"{names[row['scene']]}, {row['cells']}"
            + ("" if row["scene"] == "line" else f" x {row['cells']}")
            + ("*" if "measured" in row else ""),
            _seconds(row["one_s"]),
            "-" if row["more_s"] is None else _seconds(row["more_s"]),
            "-" if row["more_s"] is None else f"{row['one_s'] / row['more_s']:.2f}",
            "-" if row["two_at_once_s"] is None else f"{2 * row['one_s'] / row['two_at_once_s']:.2f}",
        ]
        for row in of["rows"]
    ]
    head = ["run", "one thread [s]", "two threads [s]", "faster by", "two runs at once on one thread each: faster by"]
    return _table(head, rows, of) + _apart(of)


def _line_seconds() -> str:
    """Return the time of a line contact, rounded up to a tenth of a second."""
    row = next(row for row in data("threads")["rows"] if row["scene"] == "line")
    return f"{math.ceil(10 * row['one_s']) / 10:g}"


def _random(column: int) -> Callable[[], str]:
    def number() -> str:
        text = (DOCS / "trust" / "random-cases.md").read_text(encoding="utf-8")
        row = next(line for line in text.splitlines() if line.startswith("| all |"))
        return row.split("|")[column + 1].strip()

    return number


def _sliding(key: str, digits: int) -> Callable[[], str]:
    return lambda: f"{min(data('verification')['sliding'][f'{key}_{ratio}'] for ratio in ('0.5', '2')):.{digits}f}"


def _slowest() -> str:
    text = (DOCS / "trust" / "extremes.md").read_text(encoding="utf-8")
    found = re.search(r"contact nearly fills the period: .* takes ([\d.]+) times the iterations", text)
    return found[1] if found else "1"


def _experiment(name: str) -> Callable[[], str]:
    """Return what writes a table of the page Comparison with experiments."""

    def table() -> str:
        of = data("experiments")
        return _table(*getattr(experiment_tables, name)(of), of)

    return table


def _moving(name: str) -> Callable[[], str]:
    """Return what writes a table of that page with bodies that move, or with debris, beside the others."""

    def table() -> str:
        of, moving = data("experiments"), data("moving_scars")
        return _table(*getattr(experiment_tables, name)(of, moving), moving)

    return table


def _moving_number(name: str) -> Callable[[], str]:
    return lambda: experiment_tables.moving_numbers(data("experiments"), data("moving_scars"))[name]


def _number(name: str) -> Callable[[], str]:
    """Return what writes a number of the page Comparison with experiments."""
    return lambda: experiment_tables.numbers(data("experiments"))[name]


TABLES: dict[str, Callable[[], str]] = {
    "verification": verification,
    "spence": spence,
    "orders": orders,
    "cost": cost,
    "moving_cost": moving_cost,
    "others": others,
    "large": large,
    "threads": threads,
    **{name: _experiment(name) for name in ("impact", "impact_spin", "titanium_scars", "titanium_energy")},
    **{name: _moving(name) for name in ("scar", "coating", "titanium_debris")},
}
NUMBERS: dict[str, Callable[[], str]] = {
    "random_cases": _random(1),
    "random_unsolved": _random(4),
    "random_wrong": _random(5),
    "extremes_slowest": _slowest,
    "line_seconds": _line_seconds,
    "sliding_stick": _sliding("last_stick", 2),
    "sliding_far": _sliding("far", 4),
    **{name: _number(name) for name in experiment_tables.numbers(data("experiments"))},
    **{
        name: _moving_number(name)
        for name in experiment_tables.moving_numbers(data("experiments"), data("moving_scars"))
    },
}

if __name__ == "__main__":
    for page in PAGES:
        before = page.read_text(encoding="utf-8")
        after = rendered(before, page)
        if after != before:
            page.write_text(after, encoding="utf-8")
            print(page.relative_to(ROOT))

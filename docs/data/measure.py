"""Measure the numbers that the pages print.

    python docs/data/measure.py [NAME ...]

writes ``docs/data/NAME.json`` for each name (all of them when none is given), with the date, the commit, the version
of the program and the machine. `render.py` then writes the tables of the pages from these files; a test fails when
they differ.
"""

import datetime
import json
import os
import platform
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from experiments import experiments, moving_scars
from moving_cost import moving_cost
from orders import orders

import fretting
from fretting import analytic

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
GOLDEN = ROOT / "tests" / "golden"
STEEL = {"young": 210e9, "poisson": 0.3}


def origin() -> dict[str, Any]:
    """Return where and when a measurement was made."""
    commit = subprocess.run(
        ["git", "log", "-1", "--format=%h", "--", "crates", "python"],
        capture_output=True,
        text=True,
        check=False,
        cwd=ROOT,
    ).stdout.strip()
    names = [line.partition(":")[2].strip() for line in _cpu_lines() if line.startswith("model name")]
    return {
        "date": datetime.datetime.now(tz=datetime.UTC).date().isoformat(),
        "commit": commit,
        "version": fretting.__version__,
        "machine": f"{names[0] if names else platform.processor()}, {os.cpu_count()} cores, {platform.system()}",
    }


def _cpu_lines() -> list[str]:
    place = Path("/proc/cpuinfo")
    return place.read_text(encoding="utf-8").splitlines() if place.exists() else []


def golden(name: str) -> list[dict[str, Any]]:
    """Return the rows of a reference table."""
    rows: list[dict[str, Any]] = json.loads((GOLDEN / f"{name}.json").read_text(encoding="utf-8"))["rows"]
    return rows


COMMAND = ROOT / "target" / "release" / "fret"
"""The command as `cargo build --release` leaves it."""


def fret(*words: str, folder: Path = ROOT) -> dict[str, Any]:
    """Run the command and return its JSON."""
    done = subprocess.run(
        [sys.executable, "-m", "fretting", *words, "--json"], capture_output=True, text=True, check=True, cwd=folder
    )
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def studied(case: Path, *words: str) -> dict[str, float | None]:
    """Return the errors of the finest level of a refinement study."""
    with tempfile.TemporaryDirectory() as folder:
        answer = fret("study", str(case), "--out", folder, "--threads", "1", *words)
    finest = answer["lines"][0]["levels"][-1]
    return {**finest["errors"], "pressure_l2": finest["error_of_pressure"], "shear_l2": finest["error_of_shear"]}


def verification() -> dict[str, Any]:
    """Measure the rows of the page Verification in two minutes."""
    rows: dict[str, Any] = {
        "hertz": studied(ROOT / "examples/hertz.toml", "--cells", "64,128,256"),
        "cattaneo_mindlin": studied(ROOT / "examples/friction/cattaneo_mindlin.toml", "--cells", "16,32,64"),
        "coated_sphere": _coated_spheres(),
        "loop": _loop(),
        "torsion": _torsion(),
        "spence": _spence_point(),
        "sliding": _sliding(),
    }
    return rows


def _coated_spheres() -> dict[str, float]:
    """Return the largest errors over five coatings, 128 x 128 cells."""
    errors: dict[str, list[float]] = {"max_pressure": [], "approach": [], "contact_area": []}
    modulus = analytic.effective_moduli(lower={"young": 210e9, "poisson": 0.3}).normal
    force = 12.0
    hertz = analytic.hertz(radius=10e-3, force=force, modulus=modulus)
    for row in golden("coated_sphere"):
        if row["h"] != 1.0 or row["young_ratio"] not in (0.25, 0.5, 1.0, 2.0, 4.0) or row["poisson_coating"] != 0.3:
            continue
        radius = row["a"] * hertz.contact_radius
        case = {
            "grid": {"cells": [128, 128], "size": [2.4 * radius, 2.4 * radius]},
            "upper": {"rigid": True},
            "lower": {
                "coatings": [{"thickness": hertz.contact_radius, "young": row["young_ratio"] * 210e9, "poisson": 0.3}],
                "substrate": STEEL,
            },
            "profile": {"sphere": {"radius": 10e-3}},
            "load": [{"normal_force": force, "increments": 1}],
        }
        exact = {
            "max_pressure": row["p0"] * hertz.max_pressure,
            "approach": row["approach"] * hertz.approach,
            "contact_area": np.pi * radius**2,
        }
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder)
            (place / "case.toml").write_text(_toml(case), encoding="utf-8")
            text = "".join(f"{name} = {value!r}\n" for name, value in exact.items())
            (place / "exact.toml").write_text(text, encoding="utf-8")
            found = studied(place / "case.toml", "--cells", "64,128", "--against", str(place / "exact.toml"))
        for name, list_ in errors.items():
            list_.append(abs(found[name] or 0.0))
    return {name: max(list_) for name, list_ in errors.items()} | {"cases": len(errors["approach"])}


def _toml(case: dict[str, Any]) -> str:
    """Return a case as TOML with inline tables."""

    def value(node: Any) -> str:
        if isinstance(node, dict):
            return "{ " + ", ".join(f"{key} = {value(item)}" for key, item in node.items()) + " }"
        if isinstance(node, list):
            return "[" + ", ".join(map(value, node)) + "]"
        return json.dumps(node) if isinstance(node, bool | str) else repr(node)

    return "".join(f"{key} = {value(item)}\n" for key, item in case.items())


MU, RADIUS, MODULUS, SHEAR = 0.3, 100.0, 0.5, 0.125
FORCE = 4 * MODULUS / (3 * RADIUS)
"""Two bodies of E = 1, nu = 0, contact radius 1."""


def _similar(cells: int, stages: list[dict[str, Any]], size: float = 2.4) -> fretting.History:
    body = {"substrate": {"young": 1.0, "poisson": 0.0}}
    return fretting.run(
        {
            "grid": {"cells": [cells, cells], "size": [size, size]},
            "upper": body,
            "lower": body,
            "profile": {"sphere": {"radius": RADIUS}},
            "friction": {"coefficient": MU},
            "load": [{"normal_force": FORCE, "increments": 1}, *stages],
            "output": {"fields": ["pressure"]},
        }
    )


def _loop() -> dict[str, float]:
    """Compare a fretting loop of amplitude 0.9 mu P with Mindlin and Deresiewicz, 128 x 128 cells."""
    amplitude = 0.9 * MU * FORCE
    stage = {"tangential_force": [amplitude, 0.0], "increments": 40, "cycles": 2}
    history = _similar(128, [stage])
    sphere = analytic.hertz(radius=RADIUS, force=FORCE, modulus=MODULUS)
    exact = analytic.mindlin_deresiewicz(sphere, friction_coefficient=MU, shear_modulus=SHEAR, amplitude=amplitude)
    worst = 0.0
    for step in range(1, len(history)):
        place = (step - 1) % 40 + 1
        first = step <= 10
        branch = "loading" if first else ("unloading" if 10 < place <= 30 else "reloading")
        force = float(np.clip(history.increments["tangential_force_x"][step], -amplitude, amplitude))
        if first:
            shift = analytic.cattaneo_mindlin(
                sphere, friction_coefficient=MU, shear_modulus=SHEAR, tangential_force=force
            ).shift
        else:
            shift = exact.at(branch, force).shift
        worst = max(worst, abs(history.increments["shift_x"][step] - shift) / exact.peak.shift)
    energy = history.cycles["dissipated_energy"][1] / exact.dissipated_energy_per_cycle - 1
    return {"displacement": worst, "dissipated_energy": abs(float(energy))}


def _torsion() -> dict[str, float]:
    """Compare a first torsional loading to 0.9 of the full-slip moment with Lubkin, 96 x 96 cells."""
    full = 3 * np.pi * MU * FORCE / 16
    history = _similar(96, [{"twist_moment": 0.9 * full, "increments": 9}])
    sphere = analytic.hertz(radius=RADIUS, force=FORCE, modulus=MODULUS)
    exact = [
        analytic.torsion(sphere, friction_coefficient=MU, shear_modulus=0.25, moment=moment).twist
        for moment in history.increments["twist_moment"][1:]
    ]
    found = history.increments["twist"][1:]
    return {"twist": float(np.max(np.abs(found - exact)) / max(exact))}


def _indented(row: dict[str, Any], cells: int, increments: int | str, ramp: str) -> fretting.History:
    """Indent a half-space by a rigid sphere with friction; the frictionless contact radius is 1."""
    force = 4 / (1 - row["poisson"] ** 2) / (3 * RADIUS)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fretting.FrettingWarning)  # coarse histories are what is measured
        return fretting.run(
            {
                "grid": {"cells": [cells, cells], "size": [2.3, 2.3]},
                "upper": {"rigid": True},
                "lower": {"substrate": {"young": 1.0, "poisson": row["poisson"]}},
                "profile": {"sphere": {"radius": RADIUS}},
                "friction": {"coefficient": row["friction"]},
                "load": [{"normal_force": force, "increments": increments, "ramp": ramp}],
                "output": {"fields": ["shear"]},
            }
        )


def _row(poisson: float, stick: float) -> dict[str, Any]:
    return next(row for row in golden("spence") if (row["poisson"], row["stick"]) == (poisson, stick))


def _stick_radius(history: fretting.History) -> float:
    stick, contact = (float(history.increments[name][-1]) for name in ("stick_cells", "contact_cells"))
    return float(np.sqrt(stick / contact))


def _spence_point() -> dict[str, float]:
    row = _row(0.3, 0.9)
    history = _indented(row, 96, 40, "linear")
    return {"stick_radius": _stick_radius(history), "half_cell": 0.5 * 2.3 / 96 / row["radius"]}


def spence() -> dict[str, Any]:
    """Measure the error of the history in a growing contact: linear, cubic and automatic increments."""
    cells, finest = 64, 640
    rows = []
    for stick in (0.2, 0.9):
        row = _row(0.3, stick)
        exact = _indented(row, cells, finest, "linear")
        shear = exact.field("shear_x")
        for ramp, counts in [("linear", (10, 20, 40, 80, "auto")), ("cubic", (10, 20, 40, 80))]:
            for count in counts:
                history = _indented(row, cells, count, ramp)
                steps = history.increments
                rows.append(
                    {
                        "friction": round(row["friction"], 3),
                        "stick_radius_exact": stick,
                        "ramp": ramp,
                        "increments": count,
                        "stick_radius": _stick_radius(history),
                        "shear_error": float(np.linalg.norm(history.field("shear_x") - shear) / np.linalg.norm(shear)),
                        "energy_error": float(
                            steps["dissipated_energy"][-1] / exact.increments["dissipated_energy"][-1] - 1
                        ),
                        "convolutions": int(steps["convolutions"].sum()),
                    }
                )
                print(rows[-1])
    return {"poisson": 0.3, "cells": cells, "finest": finest, "half_cell": 0.5 * 2.3 / cells, "rows": rows}


def _sliding() -> dict[str, float]:
    """Find the tangential force at which the last stick cell of a coated contact vanishes, over mu P."""
    hertz = analytic.hertz(
        radius=10e-3, force=12.0, modulus=analytic.effective_moduli(lower={"young": 210e9, "poisson": 0.3}).normal
    )
    answers = {}
    for ratio in (0.5, 2.0):
        coating = {"thickness": hertz.contact_radius, "young": ratio * 210e9, "poisson": 0.3}
        history = fretting.run(
            {
                "grid": {"cells": [64, 64], "size": "auto"},
                "upper": {"rigid": True},
                "lower": {"coatings": [coating], "substrate": STEEL},
                "profile": {"sphere": {"radius": 10e-3}},
                "friction": {"coefficient": 0.1},
                "load": [
                    {"normal_force": 12.0, "increments": 10, "ramp": "cubic"},
                    {"shift": [1.6e-7, 0.0], "increments": 160},
                    {"shift": [4e-6, 0.0], "increments": 10},
                ],
                "output": {"fields": []},
            }
        )
        ratio_of = history.increments["tangential_force_x"] / (0.1 * 12.0)
        sticks = np.flatnonzero(history.increments["stick_cells"][10:] > 0) + 10
        answers[f"last_stick_{ratio:g}"] = float(ratio_of[sticks[-1]])
        answers[f"far_{ratio:g}"] = float(ratio_of[-1])
    return answers


COSTS = {
    "hertz.toml": "Hertz, frictionless, one increment",
    "friction/cattaneo_mindlin.toml": "Cattaneo-Mindlin, identical bodies",
    "dlc_ball_on_flat.toml": "DLC film, two cycles",
    "coated_sphere.toml": "alumina coating, one cycle",
    "paper_figure_3.toml": "coated half-space, 100 + 300 increments",
    "wear_partial_slip.toml": "partial-slip wear, cycle jumps",
}


def cost() -> dict[str, Any]:
    """Time the built command on the examples, one thread, with and without simplifications: least of three."""
    rows = []
    for name, what in COSTS.items():
        case = ROOT / "examples" / name
        found: dict[str, Any] = {"case": name, "what": what}
        for key, choice in [("with", "all"), ("without", "none")]:
            times = []
            for _ in range(3 if name != "paper_figure_3.toml" else 1):
                with tempfile.TemporaryDirectory() as folder:
                    started = time.perf_counter()
                    words = ["--out", folder, "--force", "--threads", "1", "--leave-out", choice, "--quiet"]
                    subprocess.run([COMMAND, "run", str(case), *words], check=True, cwd=ROOT)
                    times.append(time.perf_counter() - started)
                    record = json.loads((Path(folder) / "run.json").read_text(encoding="utf-8"))
            found[key] = {
                "seconds": min(times),
                "solve_s": record["totals"]["wall_s"],
                "convolutions": record["totals"]["convolutions"],
            }
            found["cells"] = record["plan"]["grid"]["cells"]
            found["increments"] = record["totals"]["increments"]
        rows.append(found)
        print(found)
    return {"rows": rows}


MEASUREMENTS = {
    "verification": verification,
    "spence": spence,
    "cost": cost,
    "orders": orders,
    "experiments": experiments,
    "moving_scars": moving_scars,
    "moving_cost": moving_cost,
}


if __name__ == "__main__":
    for name in sys.argv[1:] or MEASUREMENTS:
        answer = {"measured": origin(), "by": f"python docs/data/measure.py {name}", **MEASUREMENTS[name]()}
        (HERE / f"{name}.json").write_text(json.dumps(answer, indent=1) + "\n", encoding="utf-8")
        print(f"docs/data/{name}.json")

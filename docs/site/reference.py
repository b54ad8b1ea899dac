"""Write the generated reference pages: command line, output files, closed forms.

    python docs/site/reference.py

from the help texts of the command, the vocabulary of the results and the docstrings of the package. A test compares
the pages with what this would write now.
"""

import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

from fretting import analytic
from fretting._meaning import CYCLE_MEANING, FIELD_NAMES, MEANING

DOCS = Path(__file__).resolve().parents[1]


def command_line() -> str:
    """Return the page of the command line: what ``fret --help`` prints, for every command."""
    parts = [
        "# Command line\n",
        "<!-- Written by docs/site/reference.py from `fret --help`: edit the comments of crates/fret-cli/src/arguments.rs. -->\n",
        "`fret` is installed with the Python package or with `cargo install --path crates/fret-cli`; `python -m fretting` is the same command. Exit codes: "
        "[Messages and exit codes](messages.md).\n",
    ]
    overview = _help()
    commands = re.findall(r"^  ([a-z-]+) ", overview.partition("Commands:")[2].partition("Options:")[0], re.MULTILINE)
    parts.append(f"## fret\n\n```text\n{overview}\n```\n")
    parts += [f"## fret {name}\n\n```text\n{_help(name)}\n```\n" for name in commands if name != "help"]
    return "\n".join(parts)


def _help(*words: str) -> str:
    # Without a terminal (its input would be one, too) and without COLUMNS the help is wrapped at 100 columns.
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"} | {"NO_COLOR": "1"}
    call = [sys.executable, "-m", "fretting", *words, "--help"]
    done = subprocess.run(call, capture_output=True, text=True, check=True, env=environment, stdin=subprocess.DEVNULL)
    return "\n".join(line.rstrip() for line in done.stdout.strip().splitlines())


FILES = [
    ("case.toml", "the case as it was read"),
    ("history.csv", "one row per increment"),
    ("cycles.csv", "one row per cycle, of stages with cycles"),
    (
        "fields.zarr",
        "fields of the kept increments (Zarr 3): one array per field, dimensions increment, y, x; coordinates increment, x, y",
    ),
    ("run.json", "the run: program, version, plan, totals, status, warnings, origin"),
    (
        "error_bars.json",
        "with `--estimate-error`: value and bar of each quantity at the end of each stage (`stages`); stages that have"
        " none, and why (`without`)",
    ),
    (
        "states/",
        "what a run that starts from a state needs besides the kept fields; `memory`: what the second order remembers at the end of the run",
    ),
    ("checkpoint", "of an unfinished run: what `--resume` needs"),
    ("report.html", "written by `fret report`"),
    (
        "stress/",
        "written by `fret stress`: `stress.json` (maxima, fatigue parameters), `depths.csv` (one row per depth), `fatigue.csv` (one row per parameter and layer), sections (SVG), volume (VTK)",
    ),
    (
        "heat/",
        "written by `fret heat`, and by `fret run` of a case with conductivities: `heat.json` (temperature rise, contact resistance), `temperature.npz` (fields)",
    ),
    ("export.npz, csv/, vtk/", "written by `fret export`"),
]
RUN = [
    ("program, version, format", "`fretting`, its version, and the format of the folder (1)"),
    (
        "commit, tree_is_clean",
        "the commit the program was built from (`unknown` without git), and whether its sources were unchanged, or null",
    ),
    ("status", "`solved`, `interrupted`, `failed`, `refused`, `running`"),
    ("message", "why it ended early"),
    ("plan", "the case with all defaults, grid, automatic simplifications (`left_out`), memory"),
    ("totals", "increments, convolutions, iterations, dissipated energy, worn volume, largest residual, wall time"),
    ("warnings", "list of name, value, bound, stage, message, help"),
    ("start", "the state it started from, or null"),
    (
        "worn_through",
        'cycle and place where a coating was first worn through (`to` = "coating") or the limit reached ("limit"), or null',
    ),
    ("worn_by_layer", "wear volume of each layer of the lower and the upper body, or null"),
    (
        "checksums, states",
        "of a run that ended: CRC-32 of `case.toml`, of `cycles.csv`, of `history.csv` without its times (the same whenever the case is solved) and of these (`wall_s`), and the increments in `states/`: what was changed or is missing since is noticed by every command that reads the folder",
    ),
    ("threads, started_unix_s, tolerance", "threads, start time, solver tolerance"),
]


def output_files() -> str:
    """Return the page of the output files."""
    parts = [
        "# Output files\n",
        "<!-- Written by docs/site/reference.py from the vocabulary in crates/fret-core/src/history (columns.rs, field_names.rs): edit it there. -->\n",
        "What `fret run CASE` writes into its results folder. Units are those of the case. How to read it: [Read the results](../do/read-results.md).\n",
        _table("file", FILES),
        "## history.csv\n\nAlso `history.increments` in Python. Increments count from 0.\n",
        _table("column", [(name, text) for name, text in MEANING.items() if name not in FIELD_NAMES]),
        "## cycles.csv\n\nAlso `history.cycles` in Python. Definitions: [Fretting quantities](../theory/fretting-quantities.md).\n",
        _table("column", list(CYCLE_MEANING.items())),
        "## fields.zarr\n\nAlso `history.field(name, step)`, index `[i, j]` = `[x, y]`. `shear` and `slip` of `[output] fields` are two fields each. Every chunk ends with a checksum (codec `crc32c` of Zarr 3).\n",
        _table("field", [(name, MEANING[name]) for name in FIELD_NAMES]),
        "## run.json\n",
        _table("key", RUN),
        "## study.csv, study.json\n\nWritten by `fret study`: one row per level with cells, increments, tolerance, wall time, convolutions, and error and observed order of each "
        "quantity of interest (sub-cell reconstruction; `_plain`: cell values; `_extrapolated`: Richardson;"
        " of line contacts as without). Error and order are empty where a quantity has no limit, the order also where its levels are not in the asymptotic range"
        " (`convergence` in the JSON file). Values in the JSON file are in its `units`, those that the case declares, or null. `efficient`: no other level takes less work (operator applications by the size of their grids) and is more accurate.\n",
        "## summary.csv\n\nWritten by `fret sweep`: one row per point with the values of the parameters, status, error message, the last row of `history.csv` and of `cycles.csv`; of cases with `[stress]` or `[thermal]` also largest stresses, fatigue parameters with place and life, crack, coating, temperature rise and resistances ([Run a parameter sweep](../do/sweep.md#lives-cracks-coatings-temperatures)). Heads have units where the cases declare them. `points.json` lists the points in their order; `fret report` reads it.\n",
        "## uncertainty.json\n\nWritten by `fret sweep` where there are `[samples]`: `count`, `seed`, `indices`, `distributions`, `quantile_fractions`, and `quantities`: of every number of `summary.csv` `count` (the samples that gave it), `mean`, `deviation`, `min`, `max`, `quantiles` and, on request and where it varies, `sobol_indices` (`first`, `total`) of every key. Where a sample is endless, numbers without bound are the word `inf` (a text), and there is no deviation (null). With axes beside the samples a list `points` takes the place of `quantities`, each with its `values` and its `quantities`.\n",
        "## identified.json, cycles.csv of a log, identified.html\n\nWritten by `fret identify`: the fitted constants with their 95 % intervals, what was removed from the log, notes, the quantities of every measured cycle (also as `cycles.csv`, with units in its head; empty where a cycle was skipped), which cycles and rows were skipped and why, whether the loops were turned, the sliding conditions over the test (`sliding_conditions`: from which cycle to which), the fitted cycle as measured and as computed; a page with the pictures, also of friction, energy, amplitudes and stiffness over the cycles.\n",
        "## identified.json, indentation.csv, identified.html of an indentation\n\nWritten by `fret identify --indentation`: the fitted numbers of the case, the depth at first touch and the compliance of the frame (`parameters`, each with its 95 % interval, whether the curve tells it, and its change on half of the cells), standard deviation of the loads about the curve over the largest load (`noise`), correlation of neighbouring residuals, how many indentations were solved, rows that were skipped, the points that were fitted (`measured`, also as `indentation.csv`: line in the log, depth from the touch on, load, computed load, residual) and the computed curve (`contact_depth`: without the part of the frame); a page with both and the residuals.\n",
    ]
    return "\n".join(parts)


def _table(head: str, rows: list[tuple[str, str]]) -> str:
    lines = [f"| {head} | meaning |", "|---|---|"]
    lines += [f"| `{name}` | {text.replace('|', chr(92) + '|')} |" for name, text in rows]
    return "\n".join(lines) + "\n"


def closed_forms() -> str:
    """Return the page of the closed forms."""
    parts = [
        "# Closed-form solutions\n",
        "<!-- Written by docs/site/reference.py from the docstrings of python/fretting/analytic, which follow from crates/fret-core/src/analytic: edit them there. -->\n",
        "`fretting.analytic`: homogeneous half-spaces; several are recognised by `fret study` and drawn by `fret report`. Arguments and results: "
        "[Python](python.md#closed-forms).\n",
        "| function | problem | result | source |",
        "|---|---|---|---|",
    ]
    for name in sorted(analytic.__all__):
        function = getattr(analytic, name)
        if not inspect.isfunction(function):
            continue
        text = inspect.getdoc(function) or ""
        source = text.partition("References\n----------\n")[2].partition("\n\nExamples")[0]
        source = " ".join(source.split()).replace("*", "")
        answer = inspect.signature(function).return_annotation
        fields = ", ".join(
            f"`{field}`" for field in getattr(answer, "__annotations__", {}) if not field.startswith("_")
        )
        parts.append(f"| `{name}` | {text.splitlines()[0]} | {fields} | {source} |")
    return "\n".join(parts) + "\n"


PAGES = {"command-line": command_line, "output-files": output_files, "closed-forms": closed_forms}

if __name__ == "__main__":
    for name, page in PAGES.items():
        (DOCS / "reference" / f"{name}.md").write_text(page(), encoding="utf-8")

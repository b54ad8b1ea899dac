"""Wall time of the command `fret` on one thread over that on two (or more): coupled loops, Hertz contacts, stresses at depth, a line contact.

    cargo build --release
    python benches/threads.py target/release/fret [--threads N] [--only SCENE ...]

Wants numpy, and a machine that does nothing else. Runs on one thread and on N take turns; the medians of five stand (three, from 1024
cells a side on), files of results included. Two runs side by side on one thread each say what the machine gives at the most.
With `--only` the rows of the other scenes stay as they are. *stress*: after the coupled loop, of its last increment; *fatigue*: of all its
increments, with the parameters of fatigue over its cycle; *line*: examples/cylinder_on_flat.toml with 4 increments of pressing and three cycles
of 32, on one thread. Writes docs/data/threads.json; `docs/data/render.py` makes the table of docs/trust/performance.md from it.
"""

import argparse
import json
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from large_contacts import ROOT, case, origin, timed

RESULT = ROOT / "docs" / "data" / "threads.json"
SCENES = [("loop", cells) for cells in (64, 128, 256, 512, 1024)] + [("hertz", 1024), ("hertz", 2048)]
SCENES += [("stress", 512), ("stress", 1024), ("fatigue", 512), ("line", 1024)]
DEPTHS = ",".join(f"{depth}e-6" for depth in (10, 20, 40, 60, 80, 100, 120, 150))


def text_of(scene, cells, folder):
    """Return the text of a case."""
    if scene == "line":
        text = (ROOT / "examples" / "cylinder_on_flat.toml").read_text(encoding="utf-8").split("[stress]")[0]
        for before, after in (
            ("cells = 512", f"cells = {cells}"),
            ("increments = 1\n", "increments = 4\n"),
            ("cycles = 2", "cycles = 3"),
        ):
            assert text.count(before) == 1, before
            text = text.replace(before, after)
        return text + "[output]\nevery = 1000\n"
    if scene == "fatigue":
        return case("loop", cells, folder).replace("every = 1000", "every = 1")
    return case("loop" if scene == "stress" else scene, cells, folder)


def medians(command, scene, cells, threads, folder):
    """Return the median wall times on one thread and on more, and of two runs at once on one thread each [s]."""
    (folder / "case.toml").write_text(text_of(scene, cells, folder), encoding="utf-8")
    below = scene in ("stress", "fatigue")

    def words(number, name="results"):
        if below:
            every = ["--every", "1000"] if scene == "stress" else []
            return [command, "stress", "results", "--quiet", "--depths", DEPTHS, *every, "--threads", str(number)]
        return [command, "run", "case.toml", "--quiet", "--force", "--out", name, "--threads", str(number)]

    if below:
        subprocess.run([command, "run", "case.toml", "--quiet", "--force", "--out", "results"], check=True, cwd=folder)
    repeats = 5 if cells < 1024 else 3
    alone = scene == "line"
    walls = {number: [] for number in ((1,) if alone else (1, threads))}
    for _ in range(repeats):
        for number, found in walls.items():
            found.append(timed(words(number), folder)[0]["wall_s"])
    at_once = []
    if not below and not alone:
        for _ in range(repeats):
            begun = time.perf_counter()
            running = [subprocess.Popen(words(1, f"results{place}"), cwd=folder) for place in range(2)]
            assert not any(process.wait() for process in running)
            at_once.append(time.perf_counter() - begun)
    return {
        "one_s": statistics.median(walls[1]),
        "more_s": None if alone else statistics.median(walls[threads]),
        "two_at_once_s": statistics.median(at_once) if at_once else None,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--only", nargs="+", choices=sorted({scene for scene, _ in SCENES}))
    given = parser.parse_args()
    command = str(given.command.resolve())
    measured = origin()
    before = json.loads(RESULT.read_text(encoding="utf-8")) if given.only else {"measured": measured, "rows": []}
    rows = []
    for scene, cells in SCENES:
        if given.only and scene not in given.only:
            rows += [row for row in before["rows"] if (row["scene"], row["cells"]) == (scene, cells)]
            continue
        with tempfile.TemporaryDirectory() as name:
            found = medians(command, scene, cells, given.threads, Path(name))
        rows.append({"scene": scene, "cells": cells, "threads": given.threads, **found})
        if given.only:
            rows[-1]["measured"] = measured
        print(rows[-1], flush=True)
    of = {"measured": before["measured"], "by": "python benches/threads.py", "rows": rows}
    RESULT.write_text(json.dumps(of, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

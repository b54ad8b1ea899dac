"""Kill runs at random moments and go on with them: every file of the results must be that of an unbroken run.

    python docs/data/reviews/kills.py [KILLS]

With `fret` on the path. A coated contact with wear in blocks of cycles, increments left to the program, all fields
kept; up to six kills (SIGKILL) a run, then `--resume` with one or two threads at random. Files are compared byte by
byte, `history.csv` and `run.json` without the times on the clock.
"""

import csv
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

CASE = """
[grid]
cells = [48, 48]
size = "auto"
[upper]
rigid = true
[lower]
coatings = [{ thickness = 7e-5, young = 420e9, poisson = 0.3 }]
substrate = { young = 210e9, poisson = 0.3 }
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.3
[wear]
coefficient = 1e-14
every = 2
[[load]]
normal_force = 12.0
increments = 4
[[load]]
tangential_force = [2.5, 0.0]
cycles = 8
increments = "auto"
[output]
fields = ["pressure", "shear", "slip", "gap", "zone", "worn_depth"]
every = 1
"""


def started(folder: Path, *words: str) -> "subprocess.Popen[bytes]":
    """Start a run of the case beside the folder."""
    call = ["fret", "run", str(folder.parent / "case.toml"), "--out", str(folder), *words]
    return subprocess.Popen(call, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def without_times(node: Any) -> Any:
    """Drop what a clock says, and how many threads there were."""
    if isinstance(node, dict):
        clock = ("wall", "time", "started", "ended", "threads", "seconds", "finished", "resumed")
        return {key: without_times(value) for key, value in node.items() if not any(word in key for word in clock)}
    return [without_times(item) for item in node] if isinstance(node, list) else node


def contents(folder: Path) -> dict[str, Any]:
    """Return all files of a folder, without times on the clock."""
    found: dict[str, Any] = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_dir() or "checkpoint" in name or name.endswith("lock"):
            continue
        if name == "history.csv":
            with path.open(encoding="utf-8") as file:
                found[name] = [
                    {k: v for k, v in row.items() if "wall_s" not in (k or "")} for row in csv.DictReader(file)
                ]
        elif name == "run.json":
            found[name] = without_times(json.loads(path.read_text(encoding="utf-8")))
        else:
            found[name] = path.read_bytes()
    return found


if __name__ == "__main__":
    numbers = random.Random(4)
    wanted = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    with tempfile.TemporaryDirectory() as place:
        (Path(place) / "case.toml").write_text(CASE, encoding="utf-8")
        whole = Path(place) / "whole"
        begin = time.perf_counter()
        assert started(whole).wait() == 0
        lasts, expected = time.perf_counter() - begin, contents(whole)
        kills = runs = same = 0
        while kills < wanted:
            folder, runs = Path(place) / f"run{runs}", runs + 1
            words: tuple[str, ...] = ()
            for _ in range(numbers.randint(1, 6)):
                run = started(folder, *words)
                time.sleep(numbers.uniform(0.02, lasts))
                kills += run.poll() is None
                run.kill()
                run.wait()
                words = ("--resume", "--threads", str(numbers.randint(1, 2)))
            code = started(folder, *words).wait()
            differ = [name for name, value in expected.items() if contents(folder).get(name) != value]
            same += code == 0 and not differ and contents(folder).keys() == expected.keys()
            if code or differ:
                print(code, differ, contents(folder).keys() ^ expected.keys())
    print(f"{kills} kills, {runs} runs of {lasts:.1f} s: {same} with the same bits in all {len(expected)} files")

"""What a plan expects of a run against what the run took: memory, convolutions, time.

    python benches/expected_cost.py FRET [--examples] [--cases WORD] [--threads N]

FRET is the program (`target/release/fret`). Without options the cases below are run, whose memory and counts the constants of
`crates/fret-core/src/plan/` come from; `--examples` runs those of `examples/` instead. Peak memory is the kernel's own count (`maxrss`), so that
Linux or macOS is wanted; the time is that of `totals.wall_s`, operators included.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

BALL = """
[upper]
rigid = true
[lower]
substrate = {{ young = 210e9, poisson = {poisson} }}
{coating}
[profile]
sphere = {{ radius = 10e-3 }}
"""
LIKE = """
[upper]
substrate = { young = 210e9, poisson = 0.3 }
[lower]
substrate = { young = 210e9, poisson = 0.3 }
[profile]
sphere = { radius = 10e-3 }
"""
FILM = "coatings = [{ young = 280e9, poisson = 0.25, thickness = 2e-6 }]"
PRESS = '[[load]]\nname = "press"\nnormal_force = 12.0\nincrements = {press}\n'
CYCLE = '[[load]]\nname = "cycle"\ntangential_force = [1.5, 0.0]\ncycles = {cycles}\nincrements = {increments}\n'


def text(cells, bodies, stages, friction=0.0, size='"auto"', more="", periodic=False):
    """The TOML text of a case."""
    grid = f"[grid]\ncells = [{cells}, {cells}]\nsize = {size}\n" + ("periodic = true\n" if periodic else "")
    law = f"[friction]\ncoefficient = {friction}\n" if friction else ""
    return grid + bodies + law + stages + more


def cases():
    """All made cases by name."""
    coated = BALL.format(poisson=0.3, coating=FILM)
    plain = BALL.format(poisson=0.3, coating="")
    press = PRESS.format(press=1)
    loop = PRESS.format(press=5) + CYCLE.format(cycles=1, increments=20)
    made = {}
    for cells in (64, 128, 256, 512, 1024, 2048, 4096):
        made[f"normal {cells}"] = text(cells, plain, press)
    for cells in (1024, 2048):
        made[f"normal coated {cells}"] = text(cells, coated, press)
    for cells in (64, 128, 256, 512, 1024):
        made[f"uncoupled {cells}"] = text(cells, LIKE, loop, 0.3)
        made[f"coupled {cells}"] = text(cells, coated, loop, 0.3)
    twisted = PRESS.format(press=2) + '[[load]]\ntwist = 1e-4\ntangential_force = [0.7, 0.9]\nincrements = 4\n'
    for cells in (256, 512, 1024):
        made[f"coupled whole {cells}"] = text(cells, coated, twisted, 0.3)
    made["uncoupled whole 512"] = text(512, LIKE, twisted, 0.3)
    wear = '[wear]\nlaw = "energy"\ncoefficient = 2e-13\nevery = 20\n'
    many = PRESS.format(press=5) + CYCLE.format(cycles=3, increments=20)
    for cells in (64, 256, 512):
        made[f"wear {cells}"] = text(cells, LIKE, many, 0.3, more=wear)
    wave = "[upper]\nrigid = true\n[lower]\nsubstrate = { young = 210e9, poisson = 0.3 }\n[profile]\nwave = { amplitude = 1e-6, wavelength_x = 1e-3, wavelength_y = 1e-3 }\n"
    for cells in (256, 512, 1024):
        made[f"periodic {cells}"] = text(cells, wave, press, size="[1e-3, 1e-3]", periodic=True)
    slide = PRESS.format(press=2) + "[[load]]\ntangential_force = [1.0, 0.0]\nincrements = 4\n"
    for cells in (256, 512):
        made[f"periodic coupled {cells}"] = text(cells, wave, slide, 0.3, size="[1e-3, 1e-3]", periodic=True)
    keep = '[output]\nfields = ["pressure", "shear", "slip", "gap", "zone"]\nevery = 1\n'
    made["kept 256"] = text(256, LIKE, loop, 0.3, more=keep)
    made["kept 512"] = text(512, coated, PRESS.format(press=20), 0.3, more=keep)
    for cells in (64, 128, 256):
        made[f"many cycles {cells}"] = text(cells, coated, PRESS.format(press=10) + CYCLE.format(cycles=5, increments=20), 0.3)
    auto = 'normal_force = 12.0\nincrements = "auto"\n'
    for cells in (64, 128):
        made[f"auto {cells}"] = text(cells, coated, "[[load]]\n" + auto + '[[load]]\ntangential_force = [1.5, 0.0]\nincrements = "auto"\n', 0.3)
    return made


def run(fret, path, folder, threads):
    """Run a case; peak memory [bytes], time [s], and its summary."""
    out = folder / "results"
    command = [fret, "run", str(path), "--json", "--force", "--out", str(out)]
    if threads:
        command += ["--threads", str(threads)]
    started = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    answer = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - started
    peak = usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024)
    found = json.loads(answer) if answer else {}
    subprocess.run(["rm", "-rf", str(out)], check=True)
    return peak, wall, found, status, usage.ru_utime + usage.ru_stime


def main():
    """Print the table, a line a case."""
    parser = argparse.ArgumentParser()
    parser.add_argument("fret")
    parser.add_argument("--examples", action="store_true")
    parser.add_argument("--cases", default="")
    parser.add_argument("--threads", type=int)
    asked = parser.parse_args()
    print(f"{'case':34} {'memory':>9} {'taken':>9} {'ratio':>6} {'conv.':>8} {'taken':>8} {'ratio':>6} {'time':>8} {'taken':>8} {'ratio':>6}   cpu    inc", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        if asked.examples:
            found = {str(path.relative_to(ROOT / "examples")): path for path in sorted((ROOT / "examples").rglob("*.toml"))}
        else:
            found = {}
            for number, (name, words) in enumerate(cases().items()):
                found[name] = folder / f"{number}.toml"
                found[name].write_text(words)
        for name, path in found.items():
            if asked.cases not in name:
                continue
            planned = subprocess.run([asked.fret, "plan", str(path), "--json"], capture_output=True, text=True)
            if planned.returncode:
                print(f"{name:34} refused: {planned.stdout[:300]}")
                continue
            plan = json.loads(planned.stdout)
            peak, wall, answer, status, cpu = run(asked.fret, path, folder, asked.threads)
            if status:
                print(f"{name:34} {answer.get('message', status)}")
                continue
            totals = answer.get("totals", answer)
            time_s = plan.get("seconds_expected", float("nan"))
            taken = totals.get("wall_s", wall)
            count = totals.get("work", totals).get("convolutions", -1)
            print(
                f"{name:34} {plan['memory_bytes'] / 1e6:9.1f} {peak / 1e6:9.1f} {plan['memory_bytes'] / peak:6.2f}"
                f" {plan['convolutions_expected']:8} {count:8} {(plan['convolutions_expected'] or 0) / count:6.2f}"
                f" {time_s:8.3g} {taken:8.3g} {time_s / taken:6.2f} {cpu:8.3g} {plan.get('increments_expected')} {answer['increments']}",
                flush=True,
            )


if __name__ == "__main__":
    main()

"""Large contacts: time, memory, work and accuracy of the command `fret`, beside aspher and tamaas where they solve the same.

    cargo build --release
    python benches/large_contacts.py target/release/fret [--most CELLS] [--only SCENE]

Wants numpy; aspher and tamaas are left out with a message where they are not installed (benches/README.md). Each run is a process of
its own with `--threads`, and so many threads for the others: wall and CPU time and peak memory are those of the whole process as the
system counts them, files of results included. A short run is made three times, and the least wall time stands.
Writes docs/data/large.json; `docs/data/render.py` makes the tables of docs/trust/performance.md from it.

Scenes: *hertz* a sphere, side four contact radii; *rough* a rigid flat on a self-affine rough half-space in a period (Hurst exponent 0.8,
wavelengths from an eighth of the period to 8 cells, RMS slope h' = 0.05), contact on about 1, 10 and 50 % of it; *cattaneo* similar spheres,
T = 0.75 mu P in one step; *loop* examples/coated_sphere.toml with 8 increments of pressing and 8 of a cycle, the bodies coupled.
"""

import argparse
import datetime
import json
import math
import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
RESULT = ROOT / "docs" / "data" / "large.json"
NU, RADIUS, YOUNG, FORCE = 0.3, 5e-3, 210e9, 100.0
SLOPE, ROUGH_MODULUS = 0.05, 1.0 / (1.0 - NU**2)
# Mean pressure over E* h' for about 1, 10 and 50 % of contact.
MEAN_PRESSURES = {"rough 1 %": 0.0045, "rough 10 %": 0.047, "rough 50 %": 0.33}
SIZES = {
    "hertz": (1024, 2048, 4096),
    "rough": (1024, 2048, 4096),
    "cattaneo": (1024, 2048, 4096),
    "loop": (256, 512, 1024, 2048, 4096),
}


def hertz_radius(nu):
    modulus = YOUNG / (1 - nu**2) / 2
    return (3 * FORCE * RADIUS / (4 * modulus)) ** (1 / 3), modulus


def sphere(cells, nu, more):
    side = 4 * hertz_radius(nu)[0]
    body = f"{{ young = {YOUNG!r}, poisson = {nu} }}"
    return f"""
[grid]
cells = [{cells}, {cells}]
size = [{side!r}, {side!r}]
[upper]
substrate = {body}
[lower]
substrate = {body}
[profile.sphere]
radius = {RADIUS!r}
{more}
"""


def heights(cells):
    """Return a self-affine surface of a period of 1."""
    x, y = np.meshgrid(np.fft.fftfreq(cells) * cells, np.fft.rfftfreq(cells) * cells, indexing="ij")
    wave = np.hypot(x, y)
    amplitude = np.where((wave >= 8) & (wave <= cells / 8), np.maximum(wave, 1) ** -1.8, 0.0)
    phases = np.exp(2j * np.pi * np.random.default_rng(1).random(wave.shape))
    found = np.fft.irfft2(amplitude * phases, s=(cells, cells))
    slopes = [np.diff(found, axis=axis, append=found.take([0], axis)) * cells for axis in (0, 1)]
    return np.ascontiguousarray(found * SLOPE / math.sqrt(np.mean(slopes[0] ** 2 + slopes[1] ** 2)))


def case(scene, cells, folder):
    """Return the text of a case."""
    if scene == "hertz":
        return sphere(cells, NU, f"[[load]]\nnormal_force = {FORCE}\nincrements = 1\n")
    if scene == "cattaneo":
        press = f'[[load]]\nname = "press"\nnormal_force = {FORCE}\nincrements = 1\n'
        pull = f"[[load]]\ntangential_force = [{0.75 * 0.2 * FORCE}, 0.0]\nincrements = 1\n"
        return sphere(cells, 0.0, "[friction]\ncoefficient = 0.2\n" + press + pull + "[output]\nevery = 1000\n")
    if scene == "loop":
        text = (ROOT / "examples" / "coated_sphere.toml").read_text(encoding="utf-8")
        for before, after in (
            ("cells = [128, 128]", f"cells = [{cells}, {cells}]"),
            ("increments = 20", "increments = 8"),
            ("increments = 32", "increments = 8"),
            ("every = 8", "every = 1000"),
        ):
            assert text.count(before) == 1, before
            text = text.replace(before, after)
        return text
    # In a process of its own: the system counts the memory of a parent for its children, too.
    make = f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r}); import large_contacts as b, numpy as np; np.save('heights.npy', b.heights({cells}))"
    subprocess.run([sys.executable, "-c", make], check=True, cwd=folder)
    force = MEAN_PRESSURES[scene] * ROUGH_MODULUS * SLOPE
    return f"""
[grid]
cells = [{cells}, {cells}]
size = [1.0, 1.0]
periodic = true
[upper]
rigid = true
[lower]
substrate = {{ young = 1.0, poisson = {NU} }}
[profile.heights]
file = "heights.npy"
[[load]]
normal_force = {force!r}
increments = 1
"""


def timed(words, folder):
    """Return wall and CPU time [s], peak memory [bytes] and what a process printed."""
    with open(folder / "out", "w+b") as out:
        begun = time.perf_counter()
        process = subprocess.Popen(words, stdout=out, cwd=folder)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - begun
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise RuntimeError(f"{words} ended with {process.returncode}")
        out.seek(0)
        text = out.read().decode()
    return {"wall_s": wall, "cpu_s": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss * 1024}, text


def least(words, folder):
    found, begun = None, time.perf_counter()
    for _ in range(3):
        one = timed(words, folder)
        if found is None or one[0]["wall_s"] < found[0]["wall_s"]:
            found = one
        if time.perf_counter() - begun > 10:
            break
    return found


def ours(command, scene, cells, threads, *words):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "case.toml").write_text(case(scene, cells, folder), encoding="utf-8")
        call = [
            command,
            "run",
            "case.toml",
            "--json",
            "--quiet",
            "--force",
            "--out",
            "results",
            "--threads",
            str(threads),
            *words,
        ]
        row, text = least(call, folder)
    answer = json.loads(text)
    last = answer["stages"][-1]
    increments = answer["increments"]
    row |= {
        "increments": increments,
        "applications": answer["work"]["convolutions"],
        "residual": answer["largest_residual"],
        "contact_share": last["contact_cells"] / cells**2,
    }
    if scene == "hertz":
        radius, modulus = hertz_radius(NU)
        exact = {"approach": radius**2 / RADIUS, "max_pressure": 2 * modulus * radius / (math.pi * RADIUS)}
        row["errors"] = {key: last[key] / value - 1 for key, value in exact.items()}
        row["errors"]["radius"] = math.sqrt(last["contact_area"] / math.pi) / radius - 1
    if scene == "cattaneo":
        radius, modulus = hertz_radius(0.0)
        # Cattaneo and Mindlin: mu delta (2 - nu) / (2 (1 - nu)) (1 - (1 - T / mu P)^(2/3)), with delta = 3 P / (4 E* a) and nu = 0.
        shift = 0.2 * 3 * FORCE / (4 * modulus * radius) * (1 - 0.25 ** (2 / 3))
        row["errors"] = {
            "stick_radius": math.sqrt(last["stick_area"] / last["contact_area"]) / 0.25 ** (1 / 3) - 1,
            "shift": last["shift"][0] / shift - 1,
        }
    return row


PEER = """
import sys, time
import numpy as np
sys.path.insert(0, sys.argv[1])
import large_contacts as bench
peer, scene, cells, threads = sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5])
periodic = scene != "hertz"
if periodic:
    side, modulus, mean = 1.0, bench.ROUGH_MODULUS, bench.MEAN_PRESSURES[scene] * bench.ROUGH_MODULUS * bench.SLOPE
    surface = bench.heights(cells)
else:
    radius, modulus = bench.hertz_radius(bench.NU)
    side = 4 * radius
    mean = bench.FORCE / side**2
    x = (np.arange(cells) + 0.5 - cells / 2) * side / cells
    surface = -(x[:, None] ** 2 + x[None, :] ** 2) / (2 * bench.RADIUS)
if peer == "tamaas":
    import tamaas as tm
    tm.initialize(threads)
    tm.set_log_level(tm.LogLevel.error)
    begun = time.perf_counter()
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [side, side], [cells, cells])
    model.E, model.nu = modulus * (1 - bench.NU**2), bench.NU
    solver = tm.PolonskyKeerRey(model, np.ascontiguousarray(surface), 1e-8)
    solver.solve(mean)
    print(time.perf_counter() - begun, np.mean(model.traction[...] > 0))
else:
    import aspher
    gap = np.ascontiguousarray(surface.max() - surface).ravel()
    begun = time.perf_counter()
    precision, coarsest = ("double", 64) if cells >= 512 else ("float_then_double", 16)
    answer = aspher.solve_nested(grid_size=cells, gap=gap, p_nominal=mean, domain_size=side, E_star=modulus,
        backend=sys.argv[6], tol=1e-8, precision=precision, coarsest=coarsest)
    print(time.perf_counter() - begun, answer.status)
"""


def peer(name, scene, cells, threads, backend=""):
    """Return the time that the solver itself took, and memory of its process; surfaces are made outside of it."""
    environment = {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"}
    os.environ.update(dict.fromkeys(environment, str(threads)))
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, "-c", PEER, str(Path(__file__).parent), name, scene, str(cells), str(threads), backend]
        row, text = timed(words, Path(folder))
    seconds, said = text.split()[-2:]
    return {
        "solver_s": float(seconds),
        "process_s": row["wall_s"],
        "cpu_s": row["cpu_s"],
        "memory": row["memory"],
        "said": said,
    }


def origin():
    commit = subprocess.run(
        ["git", "log", "-1", "--format=%h", "--", "crates"], capture_output=True, text=True, check=True, cwd=ROOT
    )
    cpu = Path("/proc/cpuinfo")
    lines = cpu.read_text(encoding="utf-8").splitlines() if cpu.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")] or [
        platform.processor()
    ]
    version = next(
        line for line in (ROOT / "Cargo.toml").read_text(encoding="utf-8").splitlines() if line.startswith("version")
    )
    return {
        "date": datetime.datetime.now(tz=datetime.UTC).date().isoformat(),
        "commit": commit.stdout.strip(),
        "version": version.split('"')[1],
        "machine": f"{names[0]}, {os.cpu_count()} cores, {platform.system()}",
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path)
    parser.add_argument("--most", type=int, default=4096, help="most cells a side")
    parser.add_argument("--only", help="scenes whose name begins so")
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument(
        "--patience",
        type=float,
        default=20.0,
        help="a program that took longer with fewer cells is not run with more [s]",
    )
    given = parser.parse_args()
    measured = origin()
    before = json.loads(RESULT.read_text(encoding="utf-8")) if RESULT.exists() else {"measured": measured, "rows": []}
    known = before["rows"]
    rows = {(row["scene"], row["cells"], row["program"]): row for row in known}
    scenes = ["hertz", *MEAN_PRESSURES, "cattaneo", "loop"]
    command = str(given.command.resolve())
    for scene in scenes:
        if given.only and not scene.startswith(given.only):
            continue
        last = {}
        for cells in SIZES[scene.split()[0]]:
            if cells > given.most:
                continue
            ways = {"fretting": lambda: ours(command, scene, cells, given.threads)}
            if scene in ("hertz", "cattaneo", "loop"):
                ways["fretting, nothing left out"] = lambda: ours(
                    command, scene, cells, given.threads, "--leave-out", "none"
                )
            if scene == "hertz" or scene in MEAN_PRESSURES:
                ways["tamaas"] = lambda: peer("tamaas", scene, cells, given.threads)
                ways["aspher"] = lambda: peer(
                    "aspher", scene, cells, given.threads, "fft" if scene == "hertz" else "periodic"
                )
            for program, way in ways.items():
                if last.get(program, 0.0) > given.patience:
                    continue
                try:
                    row = way()
                except (ImportError, RuntimeError) as error:
                    print(f"left out: {scene} {cells} {program}: {error}", file=sys.stderr)
                    last[program] = math.inf
                    continue
                last[program] = row.get("wall_s", row.get("solver_s"))
                rows[scene, cells, program] = {
                    "scene": scene,
                    "cells": cells,
                    "program": program,
                    "threads": given.threads,
                    **row,
                    "measured": measured,
                }
                print(rows[scene, cells, program], flush=True)
                RESULT.write_text(
                    json.dumps(
                        {"measured": before["measured"], "by": "python benches/large_contacts.py", "rows": list(rows.values())},
                        indent=1,
                    )
                    + "\n",
                    encoding="utf-8",
                )


if __name__ == "__main__":
    main()

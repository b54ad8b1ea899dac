"""Error against CPU time of one thread, Hertz and a coated sphere, in one run: exact influence coefficients, the sampled
frequency response of most of the literature, and tamaas and aspher where they can do the scene.

    pip install tamaas numpy matplotlib                          # aspher: see README.md
    cargo bench -p fretting --bench error_time --no-run         # prints the path of the binary
    python benches/error_against_others.py PATH_OF_THE_BINARY error_against_others.png

Side four contact radii, solved to residuals at which the grid alone makes the error. Time of the first two includes the
coefficients, in the mean of many runs; that of tamaas only the solution, that of aspher all it does, the
least of some runs. What is not installed is left out, and said.
"""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import csv
import subprocess
import sys
import time

import numpy as np

CELLS = (16, 32, 64, 128, 256)
POISSON = 0.3
MODULUS = 1 / (1 - POISSON**2)
FORCE = 4 * MODULUS / 3  # contact radius 1 under a unit sphere
PEAK = 1.5 * FORCE / np.pi
SIDE = 4.0


def least(work, seconds=1.0):
    """Least CPU time of a few runs [s]."""
    best, begun, runs = np.inf, time.monotonic(), 0
    while runs == 0 or (time.monotonic() - begun < seconds and runs < 20):
        start = time.process_time()
        work()
        best = min(best, time.process_time() - start)
        runs += 1
    return best


def centres(cells, parts=1):
    n = cells * parts
    return (np.arange(n) + 0.5 - n / 2) * SIDE / n


def heights(cells):
    x = centres(cells)
    return -0.5 * (x[:, None] ** 2 + x[None, :] ** 2)


def errors(pressure):
    """Errors of the largest pressure and of the pressure in the mean square, against Hertz's means over the cells."""
    cells, parts = pressure.shape[0], 8
    x = centres(cells, parts)
    exact = PEAK * np.sqrt(np.maximum(1 - x[:, None] ** 2 - x[None, :] ** 2, 0))
    exact = exact.reshape(cells, parts, cells, parts).mean(axis=(1, 3))
    apart = np.linalg.norm(pressure - exact) / np.linalg.norm(exact)
    return abs(pressure.max() / PEAK - 1), apart


def tamaas(cells, periodic):
    import tamaas as tm

    tm.initialize(1)
    tm.set_log_level(tm.LogLevel.error)
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [SIDE, SIDE], [cells, cells])
    model.E, model.nu = 1.0, POISSON
    if not periodic:
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tm.PolonskyKeerRey(model, np.ascontiguousarray(heights(cells)), 1e-8)
    if not periodic:
        solver.setIntegralOperator("dcfft")

    def work():
        model.traction[...] = 0
        solver.solve(FORCE / SIDE**2)

    seconds = least(work)
    return (seconds, *errors(np.array(model.traction)))


def aspher(cells):
    """Nested grids with its exact convolution, in the quickest of its settings here."""
    import aspher

    gap = -heights(cells).ravel()
    answer = None

    def work():
        nonlocal answer
        answer = aspher.solve_nested(
            grid_size=cells, gap=gap, p_nominal=FORCE / SIDE**2, domain_size=SIDE, E_star=MODULUS,
            backend="fft", tol=1e-8, precision="float_then_double", coarsest=16,
        )  # fmt: skip

    seconds = least(work)
    return (seconds, *errors(np.array(answer.pressure).reshape(cells, cells)))


def ours(binary):
    text = subprocess.run(
        [binary, ",".join(map(str, CELLS))], check=True, capture_output=True, text=True
    ).stdout
    return list(csv.DictReader(text.splitlines()))


def others():
    """Rows of the other solvers, as those of the binary."""
    ways = {
        "tamaas, periodic": lambda n: tamaas(n, True),
        "tamaas, free space": lambda n: tamaas(n, False),
        "aspher, free space": aspher,
    }
    for name, way in ways.items():
        try:
            for cells in CELLS:
                seconds, peak, apart = way(cells)
                yield {
                    "method": name,
                    "scene": "Hertz",
                    "cells": cells,
                    "seconds": seconds,
                    "peak_cell": peak,
                    "pressure_l2": apart,
                }
        except ImportError as error:
            print(f"left out: {name}: {error}", file=sys.stderr)


def table(rows):
    print("| scene | solver | cells a side | CPU time [ms] | max pressure, cell | between cells | approach | pressure L2 |")
    print("|---|---|---|---|---|---|---|---|")
    for row in rows:
        shown = [row.get(key) for key in ("peak_cell", "peak_between", "approach", "pressure_l2")]
        cells = ["-" if v is None or np.isnan(float(v)) else f"{float(v):.1e}" for v in shown]
        milliseconds = f"{1e3 * float(row['seconds']):.3g}"
        print(f"| {row['scene']} | {row['method']} | {row['cells']} | {milliseconds} | {' | '.join(cells)} |")


def draw(rows, path):
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot

    panels = [
        ("Hertz", "pressure_l2", "Hertz: pressure in the mean square"),
        ("Hertz", "peak_cell", "Hertz: largest pressure"),
        ("coated, E1/E2 = 4, h = a", "peak_cell", "coating 4 times stiffer, as thick as the contact:\nlargest pressure"),
    ]
    figure, axes = pyplot.subplots(1, 3, figsize=(15, 4.8), constrained_layout=True)
    for axis, (scene, key, title) in zip(axes, panels, strict=True):
        methods = list(dict.fromkeys(row["method"] for row in rows if row["scene"] == scene))
        for number, method in enumerate(methods):
            own = [row for row in rows if row["scene"] == scene and row["method"] == method]
            x = [float(row["seconds"]) for row in own]
            axis.loglog(x, [float(row[key]) for row in own], "o-", color=f"C{number}", label=method)
            if key == "peak_cell" and method == "exact coefficients":
                y = [float(row["peak_between"]) for row in own]
                axis.loglog(x, y, "o--", color=f"C{number}", label="the same, between the cells")
        axis.set(title=title, xlabel="CPU time [s]", ylabel="relative error")
        axis.grid(alpha=0.3)
    handles, labels = axes[1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels), fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    rows = ours(sys.argv[1]) + list(others())
    table(rows)
    if len(sys.argv) > 2:
        draw(rows, sys.argv[2])


if __name__ == "__main__":
    main()

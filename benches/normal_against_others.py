"""CPU seconds of a Hertz contact, side four contact radii, against other open solvers, in one run on one thread.

    pip install tamaas numpy                                     # aspher: see README.md
    cargo bench -p fretting --bench normal_contact --no-run     # prints the path of the binary
    python benches/normal_against_others.py PATH_OF_THE_BINARY

The gap is given to all. Ours is the benchmark binary (`time`): influence coefficients, coarse grids and the final check on the
whole grid included, to a residual of 1e-8. Tamaas runs to the tolerance at which its pressure is as near to Hertz's as ours; what
it precomputes once per grid is not counted. aspher (nested grids on a free half-space, the fastest of its settings) runs to 1e-8
and counts everything.
"""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import subprocess
import sys
import time

import numpy as np

CELLS = (128, 256, 512)
MODULUS = 1 / (1 - 0.3**2)
FORCE = 4 * MODULUS / 3  # contact radius 1 under a unit sphere
SIDE = 4.0


def least(work, seconds=4.0):
    """Least CPU time of a few runs [s]."""
    best, begun, runs = np.inf, time.monotonic(), 0
    while runs < 3 or (time.monotonic() - begun < seconds and runs < 20):
        start = time.process_time()
        work()
        best = min(best, time.process_time() - start)
        runs += 1
    return best


def heights(cells):
    x = (np.arange(cells) + 0.5 - cells / 2) * SIDE / cells
    return -0.5 * (x[:, None] ** 2 + x[None, :] ** 2)


def tamaas_seconds(cells):
    """Polonsky and Keer on a periodic grid, where a convolution is a quarter of ours."""
    import tamaas as tm

    tm.initialize(1)
    tm.set_log_level(tm.LogLevel.error)
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [SIDE, SIDE], [cells, cells])
    model.E, model.nu = 1.0, 0.3
    solver = tm.PolonskyKeerRey(model, np.ascontiguousarray(heights(cells)), 1e-8)

    def work():
        model.traction[...] = 0
        solver.solve(FORCE / SIDE**2)

    return least(work)


# The quickest of its settings on the machine of the tables: small grids want the first, large ones the second.
ASPHER = ({"precision": "float_then_double", "coarsest": 16}, {"precision": "double", "coarsest": 64})


def aspher_seconds(cells):
    """Nested grids with its exact convolution."""
    import aspher

    gap = -heights(cells).ravel()

    def work(settings):
        answer = aspher.solve_nested(
            grid_size=cells, gap=gap, p_nominal=FORCE / SIDE**2, domain_size=SIDE, E_star=MODULUS,
            backend="fft", tol=1e-8, **settings,
        )  # fmt: skip
        assert answer.status == "converged", answer.status

    return min(least(lambda settings=settings: work(settings)) for settings in ASPHER if settings["coarsest"] <= cells)


def ours(binary):
    text = subprocess.run([binary, "time"], check=True, capture_output=True, text=True).stdout
    rows = [line.split() for line in text.splitlines()]
    return {int(cells): (float(mirrored), float(whole)) for cells, mirrored, whole in rows}


def main():
    us = ours(sys.argv[1])
    others = {"tamaas, periodic": tamaas_seconds, "aspher, free space": aspher_seconds}
    for name in list(others):
        try:
            others[name](16)
        except ImportError as error:
            print(f"left out: {name}: {error}", file=sys.stderr)
            del others[name]
    print("| cells a side | this [ms] | this without mirrors [ms] |" + "".join(f" {name} [ms] | this over it |" for name in others))
    print("|---|---|---|" + "---|---|" * len(others))
    for cells in CELLS:
        mirrored, whole = us[cells]
        row = f"| {cells} | {1e3 * mirrored:.2f} | {1e3 * whole:.2f} |"
        for way in others.values():
            seconds = way(cells)
            row += f" {1e3 * seconds:.1f} | {mirrored / seconds:.3f} |"
        print(row)


if __name__ == "__main__":
    main()

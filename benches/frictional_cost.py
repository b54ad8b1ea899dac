"""Cost of frictional contacts in convolutions of scipy, measured in one run on one thread.

The unit is one zero-padded real convolution of the same grid by scipy.fft (rfft2, product, irfft2), timed beside each
scene in three ways: the quickest single one and the mean of many in a row, both in this process, whose allocator has learnt from
the contacts to keep its pages; and the median in a process of its own, where pages come anew as in any program that does nothing
else. CPU time counts, planning and influence coefficients included, best of a few runs;
the growth with the cells also by rounds in which all grids take turns, small ones several times, the median of which counts. Run: ``python benches/frictional_cost.py
[--long]`` with the wheel, numpy and scipy installed.
"""

import argparse
import subprocess
import sys
import time
from collections.abc import Sequence

import numpy as np
import scipy.fft

import fretting

MATERIAL = {"young": 1.0, "poisson": 0.3}
RADIUS = 100.0
HALF_SPACE = 1.0 / (1.0 - 0.3**2)


def unit(n: int, repeats: int) -> np.ndarray:
    """CPU time of a scipy convolution of n x n cells: the best, and the mean [s]."""
    field = np.random.default_rng(1).random((n, n))
    kernel = scipy.fft.rfft2(np.random.default_rng(2).random((2 * n, 2 * n)))
    best, begun = np.inf, time.process_time()
    for _ in range(repeats):
        start = time.process_time()
        scipy.fft.irfft2(scipy.fft.rfft2(field, (2 * n, 2 * n)) * kernel)[:n, :n].copy()
        best = min(best, time.process_time() - start)
    return np.array([best, (time.process_time() - begun) / repeats])


ALONE = """
import sys, time, numpy as np, scipy.fft
n, repeats, times = int(sys.argv[1]), int(sys.argv[2]), []
field = np.random.default_rng(1).random((n, n))
kernel = scipy.fft.rfft2(np.random.default_rng(2).random((2 * n, 2 * n)))
for _ in range(repeats):
    start = time.process_time()
    scipy.fft.irfft2(scipy.fft.rfft2(field, (2 * n, 2 * n)) * kernel)[:n, :n].copy()
    times.append(time.process_time() - start)
print(np.median(times))
"""


def unit_alone(n: int, repeats: int) -> float:
    """CPU time of a scipy convolution of n x n cells in a process of its own: the median [s]."""
    return float(subprocess.run([sys.executable, "-c", ALONE, str(n), str(repeats)], check=True, capture_output=True).stdout)


def sphere(cells: int, size: float, bodies: dict, friction: float, load: list) -> dict:
    """A sphere whose contact radius on one homogeneous body of modulus 1, nu 0.3 would be 1 under its force."""
    return {
        "grid": {"cells": [cells, cells], "size": [size, size]},
        **bodies,
        "profile": {"sphere": {"radius": RADIUS}},
        "friction": {"coefficient": friction},
        "load": load,
        "output": {"fields": ["pressure"]},
    }


RIGID_ON_HALF_SPACE = {"upper": {"rigid": True}, "lower": {"substrate": MATERIAL}}
IDENTICAL = {"upper": {"substrate": {"young": 2.0, "poisson": 0.3}}, "lower": {"substrate": {"young": 2.0, "poisson": 0.3}}}
COATED = {
    "upper": {"rigid": True},
    "lower": {"coatings": [{"thickness": 1.0, "young": 2.0, "poisson": 0.3}], "substrate": MATERIAL},
}
FORCE = 4.0 * HALF_SPACE / (3.0 * RADIUS)


def scenes(long: bool) -> list[tuple[str, int, dict, str]]:
    """Name, cells, case, bound that is asked for."""
    pull = 0.75 * 0.1 * FORCE

    def loop(steps: int) -> list:
        force = [pull, 0.0]
        back = [-pull, 0.0]
        return [
            {"tangential_force": force, "increments": steps // 5},
            {"tangential_force": back, "increments": 2 * steps // 5},
            {"tangential_force": force, "increments": 2 * steps // 5},
        ]

    press = {"normal_force": FORCE, "increments": 1}
    found = [
        ("Cattaneo-Mindlin, nu 0.3, one step", 256,
         sphere(256, 2.2, IDENTICAL, 0.1, [press, {"tangential_force": [pull, 0.0], "increments": 1}]), "45"),
        ("loop of 40 steps", 128, sphere(128, 2.2, IDENTICAL, 0.1, [press, *loop(40)]), "350"),
    ]  # fmt: skip
    for mu in (0.1, 0.3):
        stages = [
            {"normal_force": FORCE, "increments": 20, "ramp": "cubic"},
            {"tangential_force": [0.75 * mu * FORCE, 0.0], "increments": 10},
        ]
        found.append((f"coupled 20 + 10, mu {mu}", 128, sphere(128, 2.2, RIGID_ON_HALF_SPACE, mu, stages), "500"))
    for n in (64, 128, 256, 512):
        stages = [
            {"normal_force": FORCE, "increments": 4, "ramp": "cubic"},
            {"tangential_force": [pull, 0.0], "increments": 4},
        ]
        found.append(("coupled 4 + 4, mu 0.1", n, sphere(n, 2.2, RIGID_ON_HALF_SPACE, 0.1, stages), ""))
    if long:
        stages = [
            {"normal_force": FORCE, "increments": 100},
            {"tangential_force": [0.75 * 0.1 * FORCE, 0.0], "increments": 300, "cycles": 1},
        ]
        found.append(("figure 3: E1/E2 = 2, 100 + 300", 128, sphere(128, 1.98, COATED, 0.1, stages), "4000"))
    return found


def slope_of(cells: Sequence[int], seconds: Sequence[float]) -> float:
    """Exponent of the cells in the seconds."""
    return float(np.polyfit(np.log(cells), np.log(seconds), 1)[0])


def rounds(count: int) -> list[tuple[list[int], list[float]]]:
    """Cells a side and CPU times of the scenes that tell the growth, all of them within seconds: the machine's mood counts for all."""
    growing = [(n, case) for name, n, case, _ in scenes(False) if name.startswith("coupled 4")]
    found = []
    for _ in range(count):
        row = []
        for n, case in growing:
            times = []
            for _ in range(max(1, 512 * 512 // (4 * n * n))):
                start = time.process_time()
                fretting.run(case, threads=1)
                times.append(time.process_time() - start)
            row.append(float(np.median(times)))
        found.append(([n for n, _ in growing], row))
    return found


def main() -> None:
    """Print the table."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--long", action="store_true", help="the 400 increments of figure 3 too")
    print(f"{'scene':36} {'n':>4} {'CPU s':>8} {'ms: best':>9} {'mean':>6} {'alone':>6} {'in best':>8} {'in means':>9} {'in alone':>9} {'asked':>6} {'applications':>12} {'an increment':>12}")
    seconds = {}
    for name, n, case, asked in scenes(arguments.parse_args().long):
        repeats = 200 if n <= 128 else 20
        best, one = np.inf, np.full(3, np.inf)
        for _ in range(3):
            one = np.minimum(one, [*unit(n, repeats), unit_alone(n, repeats)])
            start = time.process_time()
            history = fretting.run(case, threads=1)
            best = min(best, time.process_time() - start)
            one = np.minimum(one, [*unit(n, repeats), unit_alone(n, repeats)])
        steps = history.increments
        applications = int(steps["convolutions"].sum())
        seconds[name, n] = best / len(history)
        quickest, mean, alone = 1e3 * one
        in_units = best / one
        print(
            f"{name:36} {n:4d} {best:8.3f} {quickest:9.2f} {mean:6.2f} {alone:6.2f} {in_units[0]:8.0f} {in_units[1]:9.0f} {in_units[2]:9.0f}"
            f" {asked:>6} {applications:12d} {applications / len(history):12.1f}",
            flush=True,
        )
    times = [(n, value) for (name, n), value in seconds.items() if name.startswith("coupled 4")]
    print(f"time an increment grows like n^{slope_of(*zip(*times)):.2f} from {times[0][0]} to {times[-1][0]} by the times above")
    found = [slope_of(*row) for row in rounds(7)]
    print(
        f"in {len(found)} rounds of all four grids, small ones by the median of several runs: n^{np.median(found):.2f}"
        f" (n^{min(found):.2f} to n^{max(found):.2f})"
    )


if __name__ == "__main__":
    main()

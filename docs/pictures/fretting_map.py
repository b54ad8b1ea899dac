"""Draw a fretting map: the regime over shift amplitude and normal force, for three coatings.

    python examples/fretting_map.py [PICTURE]

needs ``pip install 'fretting[all]'`` and writes ``fretting_map.png`` into ``docs/pictures`` of the project when no
PICTURE is given. 3 x 8 x 8 runs of one cycle on small grids, solved by processes: about half a minute on two cores.

A rigid ball of 10 mm radius on steel, bare and under 50 micrometres of a coating half and twice as stiff; mu = 0.3.
Expect: the border of gross slip lies at a shift that grows with the force to the power of two thirds, as Cattaneo and
Mindlin have it for bare bodies, and further out on a soft coating than on a stiff one.
"""

import concurrent.futures
import multiprocessing
import sys
from pathlib import Path

import fretting
import matplotlib
import numpy as np

STEEL = {"young": 210e9, "poisson": 0.3}
FRICTION = 0.3
COATINGS = {
    "coating half as stiff": [{"thickness": 50e-6, "young": 105e9, "poisson": 0.3}],
    "no coating": [],
    "coating twice as stiff": [{"thickness": 50e-6, "young": 420e9, "poisson": 0.3}],
}
CASE = {
    "grid": {"cells": [32, 32], "size": "auto"},
    "upper": {"rigid": True},
    "lower": {"substrate": STEEL},
    "profile": {"sphere": {"radius": 10e-3}},
    "friction": {"coefficient": FRICTION},
    "load": [
        {"name": "press", "normal_force": 1.0, "increments": 4, "ramp": "cubic"},
        {"name": "rub", "shift": [1e-7, 0.0], "cycles": 1, "increments": 16},
    ],
}
FORCE, SHIFT = "load.press.normal_force", "load.rub.shift.0"
AXES = {
    "coating": fretting.Axis(list(COATINGS), lambda case, name: case["lower"].update(coatings=COATINGS[name])),
    FORCE: np.geomspace(2.0, 40.0, 8),
    SHIFT: np.geomspace(4e-8, 8e-7, 8),
}


def sliding_shift(force):
    """Shift at which bare bodies begin to slide (Cattaneo 1938, Mindlin 1949)."""
    moduli = fretting.analytic.effective_moduli(lower=(STEEL["young"], STEEL["poisson"]))
    sphere = fretting.analytic.hertz(radius=10e-3, force=force, modulus=moduli.normal)
    return 3.0 * FRICTION * force / (16.0 * moduli.shear * sphere.contact_radius)


def main(picture):
    """Solve all points and draw the map."""
    with concurrent.futures.ProcessPoolExecutor(mp_context=multiprocessing.get_context("spawn")) as executor:
        answer = fretting.sweep(CASE, AXES, executor, progress=True)
    for message in answer["error"].values.ravel():
        if message:
            print(message)
    import matplotlib.pyplot as plt

    figure, pictures = plt.subplots(1, 3, figsize=(11, 3.9), sharey=True, layout="constrained")
    forces = np.geomspace(*answer[FORCE].values[[0, -1]], 50)
    for axes, name in zip(pictures, COATINGS, strict=True):
        fretting.plot.regime_map(answer.sel(coating=name), x=SHIFT, y=FORCE, axes=axes)
        axes.plot([sliding_shift(force) for force in forces], forces, "k--", lw=1)
        axes.set(xscale="log", yscale="log", xlabel="shift amplitude [m]", title=name)
        axes.set_xticks([5e-8, 1e-7, 2e-7, 5e-7], ["5e-8", "1e-7", "2e-7", "5e-7"], minor=False)
        axes.set_yticks([2, 5, 10, 20, 40], ["2", "5", "10", "20", "40"], minor=False)
        axes.minorticks_off()
        axes.set_ylabel("normal force [N]" if axes is pictures[0] else "")
    figure.savefig(picture, dpi=130)


if __name__ == "__main__":
    matplotlib.use("Agg")
    main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1] / "docs" / "pictures" / "fretting_map.png")

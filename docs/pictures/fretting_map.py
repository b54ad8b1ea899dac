"""Running-condition fretting map of three coatings.

Rigid ball, R = 10 mm, on steel (210 GPa, nu = 0.3), coating 50 um thick with E_c/E_s = 1/2, 1 and 2, mu = 0.3; sliding
condition of the first cycle over displacement amplitude and normal force, 14 x 14 points per map, 32 x 32 cells, 16
increments per cycle. Dashed: onset of gross slip of the uncoated contact (Cattaneo, Mindlin).
"""

import concurrent.futures
import multiprocessing

import numpy as np
from _figures import PINK, SKY, SLIP_COLOUR, STICK_COLOUR, figure, letters, save
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

import fretting

STEEL = {"young": 210e9, "poisson": 0.3}
FRICTION = 0.3
FORCE, SHIFT = "load.press.normal_force", "load.rub.shift.0"
CASE = {
    "grid": {"cells": [32, 32], "size": "auto"},
    "upper": {"rigid": True},
    "lower": {"coatings": [{"thickness": 50e-6, "young": 210e9, "poisson": 0.3}], "substrate": STEEL},
    "profile": {"sphere": {"radius": 10e-3}},
    "friction": {"coefficient": FRICTION},
    "load": [
        {"name": "press", "normal_force": 1.0, "increments": 4, "ramp": "cubic"},
        {"name": "rub", "shift": [1e-7, 0.0], "cycles": 1, "increments": 16},
    ],
    "output": {"fields": []},
}
AXES = {
    "lower.coatings.0.young": [105e9, 210e9, 420e9],
    FORCE: np.geomspace(2.0, 40.0, 14),
    SHIFT: np.geomspace(4e-8, 8e-7, 14),
}
CONDITIONS = {"full_stick": STICK_COLOUR, "partial_slip": SKY, "mixed": PINK, "gross_slip": SLIP_COLOUR}


def onset(force: float) -> float:
    """Displacement at which uncoated bodies begin to slide (Cattaneo 1938, Mindlin 1949)."""
    moduli = fretting.analytic.effective_moduli(lower=STEEL)
    sphere = fretting.analytic.hertz(radius=10e-3, force=force, modulus=moduli.normal)
    return 3.0 * FRICTION * force / (16.0 * moduli.shear * sphere.contact_radius)


def edges(values: np.ndarray) -> np.ndarray:
    """Borders between values that grow by factors."""
    logs = np.log(values)
    middle = (logs[1:] + logs[:-1]) / 2
    return np.exp(np.concatenate([[2 * logs[0] - middle[0]], middle, [2 * logs[-1] - middle[-1]]]))


def main() -> None:
    """Solve all points and draw the maps."""
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
        answer = fretting.sweep(CASE, AXES, executor=executor)
    drawn, panels = figure(3, height=64, sharey=True)
    names = list(CONDITIONS)
    forces = np.geomspace(2, 40, 50)
    for axes, young, title in zip(panels, AXES["lower.coatings.0.young"], ("1/2", "1 (uncoated)", "2"), strict=True):
        words = answer["cycle_regime"].sel({"lower.coatings.0.young": young}).transpose(FORCE, SHIFT).values
        codes = np.array([[names.index(word) if word in names else np.nan for word in row] for row in words.tolist()])
        axes.pcolormesh(
            edges(AXES[SHIFT]) * 1e6,
            edges(AXES[FORCE]),
            codes,
            cmap=ListedColormap(list(CONDITIONS.values())),
            vmin=-0.5,
            vmax=3.5,
        )
        axes.plot([onset(force) * 1e6 for force in forces], forces, "k--", lw=1, label="onset, uncoated")
        axes.set(xscale="log", yscale="log", xlabel="displacement amplitude [um]", title=f"$E_c/E_s$ = {title}")
        axes.set_xticks([0.05, 0.1, 0.2, 0.5], ["0.05", "0.1", "0.2", "0.5"])
        axes.set_yticks([2, 5, 10, 20, 40], ["2", "5", "10", "20", "40"])
        axes.minorticks_off()
    panels[0].set_ylabel("normal force [N]")
    letters(panels)
    patches = [Patch(facecolor=c, label=name.replace("_", " ")) for name, c in CONDITIONS.items()]
    drawn.legend(handles=[*patches, panels[0].lines[0]], loc="outside lower center", ncols=5)
    save(drawn)


if __name__ == "__main__":
    main()

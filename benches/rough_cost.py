"""Count operator applications of rough contacts: a ball with a scan rough down to four cells, pressed and rubbed, bare and coated.

Counts do not depend on the machine. Prints the median and the worst increment of pressing and of the cycle.
"""

import argparse
import statistics
import warnings
from typing import Any

import numpy as np

import fretting

SIZE = 3.6e-4
"""Side of the grid [m]."""
COATINGS = {"bare": [], "30 um, 380 GPa": [(30e-6, 380e9)], "3 um, 900 GPa": [(3e-6, 900e9)]}


def heights(cells: int, roughness: float, seed: int) -> Any:
    """Return random heights [m] of a power law, waves from a quarter of the side down to four cells."""
    wavenumber = np.fft.fftfreq(cells, d=SIZE / cells)
    size = np.hypot(*np.meshgrid(wavenumber, wavenumber, indexing="ij"))
    size[0, 0] = 1.0
    inside = (size >= 4 / SIZE) & (size <= cells / 4 / SIZE)
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal((cells, cells)))
    found = np.fft.ifft2(np.where(inside, size**-1.8, 0.0) * noise).real
    return roughness * found / found.std()


def case(cells: int, coatings: list[tuple[float, float]], integration: str, seed: int) -> dict[str, Any]:
    """Return a rough ball of silicon nitride on steel, 12 increments of pressing and a cycle of 16."""
    layers = [{"thickness": thickness, "young": young, "poisson": 0.25} for thickness, young in coatings]
    return {
        "grid": {"cells": [cells, cells], "size": [SIZE, SIZE]},
        "upper": {
            "substrate": {"young": 310e9, "poisson": 0.26},
            "profile": {"sphere": {"radius": 10e-3}, "heights": {"values": heights(cells, 5e-8, seed)}},
        },
        "lower": {"substrate": {"young": 210e9, "poisson": 0.3}, "coatings": layers},
        "friction": {"coefficient": 0.3},
        "solver": {"integration": integration},
        "load": [
            {"normal_force": 60.0, "increments": 12, "ramp": "cubic"},
            {"tangential_force": [9.0, 0.0], "cycles": 1, "increments": 16},
        ],
        "output": {"fields": []},
    }


def main() -> None:
    """Print a row for each contact."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cells", type=int, default=128)
    parser.add_argument("--seed", type=int, default=7)
    asked = parser.parse_args()
    print("| contact | rule | pressing: median, worst | cycle: median, worst | all |\n|---|---|---|---|---|")
    for name, coatings in COATINGS.items():
        for integration in ("end_point", "second_order"):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", fretting.FrettingWarning)
                history = fretting.run(case(asked.cells, coatings, integration, asked.seed), threads=1)
            counts, stage = history.increments["convolutions"], history.increments["stage"]
            parts = [counts[stage == number].tolist() for number in (0, 1)]
            of_parts = [f"{statistics.median(part):.0f}, {max(part)}" for part in parts]
            print(f"| {name} | {integration} | {' | '.join(of_parts)} | {counts.sum()} |", flush=True)


if __name__ == "__main__":
    main()

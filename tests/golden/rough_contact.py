"""Rough contacts solved by two independent packages, for `rough_contact.json`.

    pip install tamaas ContactMechanics SurfaceTopography
    python tests/golden/rough_contact.py > tests/golden/rough_contact.json

A rigid rough surface on a half-space with E = 1, nu = 0.3, as heights of 40 x 40 cells:

- `ball`: a rough sphere in free space. Both packages use Love's influence coefficients of uniform pressure on a cell, as this
  project does: the same discrete problem. Pressures are those of
  ContactMechanics; tamaas (Polonsky-Keer-Rey, operator "dcfft") agrees to its own tolerance.
- `period`: a rough surface that repeats. This project's operator is the frequency response times the cell's factors
  sin(k d/2)/(k d/2) along x and y; ContactMechanics is given the same symbol. (tamaas uses the response alone, of a
  displacement that is not averaged over cells; its solution is a neighbour, and the distance is printed.)

What each package was run with, and how far they are from one another, is in the output.
"""

import json
import sys

import ContactMechanics
import numpy as np
import tamaas
from SurfaceTopography import Topography

CELLS = 40
MODULUS = 1 / (1 - 0.3**2)


def roughness(rms: float, waves: int) -> np.ndarray:
    """Heights of a sum of waves with directions and phases by the golden ratio, amplitudes falling as 1/k^0.9."""
    x = (np.arange(CELLS) + 0.5) / CELLS
    heights = np.zeros((CELLS, CELLS))
    number = 0
    for a in range(0, waves + 1):
        for b in range(-waves, waves + 1):
            if (a, b) <= (0, 0):
                continue
            number += 1
            phase = 2 * np.pi * ((number * 0.618033988749895) % 1)
            wave = np.cos(2 * np.pi * (a * x[:, None] + b * x[None, :]) + phase)
            heights += wave / np.hypot(a, b) ** 0.9
    return heights * rms / heights.std()


def by_tamaas(heights: np.ndarray, size: float, mean: float, free: bool) -> tuple[np.ndarray, float]:
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [size, size], [CELLS, CELLS])
    model.E, model.nu = 1.0, 0.3
    solver = tamaas.PolonskyKeerRey(model, heights, 1e-15)
    if free:
        tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver.setIntegralOperator("dcfft")
    solver.max_iter = 20000
    error = solver.solve(mean)
    return np.array(model.traction), error


def by_contact_mechanics(heights: np.ndarray, size: float, mean: float, free: bool) -> np.ndarray:
    kind = ContactMechanics.FreeFFTElasticHalfSpace if free else ContactMechanics.PeriodicFFTElasticHalfSpace
    half_space = kind((CELLS, CELLS), MODULUS, (size, size))
    if not free:
        d = size / CELLS
        k = [np.fft.fftfreq(CELLS, d), np.fft.rfftfreq(CELLS, d)]
        factor = np.sinc(k[0] * d)[:, None] * np.sinc(k[1] * d)[None, :]
        shape = half_space.surface_stiffness.shape
        factor = factor if shape == factor.shape else np.sinc(k[1] * d)[:, None] * np.sinc(k[0] * d)[None, :]
        half_space.surface_stiffness[...] /= factor
        half_space.greens_function[...] *= factor
    topography = Topography(heights, (size, size), periodic=not free)
    system = ContactMechanics.make_system(substrate=half_space, surface=topography)
    result = system.minimize_proxy(external_force=mean * size * size, pentol=1e-14, maxiter=20000)
    if not result.success:
        raise SystemExit(f"ContactMechanics: {result.message}")
    return np.array(-result.jac if hasattr(result, "jac") else -result["jac"])[:CELLS, :CELLS] / (size / CELLS) ** 2


def main() -> None:
    tamaas.set_log_level(tamaas.LogLevel.warning)
    size = 3.0
    d = size / CELLS
    x = (np.arange(CELLS) - (CELLS - 1) / 2) * d
    ball = roughness(1e-3, 8) - (x[:, None] ** 2 + x[None, :] ** 2) / (2 * 100.0)
    period = roughness(2e-3, 6)
    out = {
        "origin": "tests/golden/rough_contact.py",
        "tamaas": tamaas.__version__,
        "ContactMechanics": ContactMechanics.__version__,
        "size": size,
    }
    for name, heights, mean, free in (("ball", ball, 1.2e-3, True), ("period", period, 1.5e-3, False)):
        heights = np.round(heights, 12)
        first, error = by_tamaas(heights, size, mean, free)
        second = by_contact_mechanics(heights, size, mean, free)
        second = second * (mean * CELLS**2 / second.sum())
        apart = np.abs(first - second).max() / second.max()
        print(f"{name}: tamaas error {error:.1e}, cells in contact {np.sum(first > 0)} and {np.sum(second > 0)}, "
              f"pressures apart by {apart:.1e} of the largest", file=sys.stderr)
        pressure = second
        out[name] = {
            "by": "ContactMechanics",
            "tamaas_is_off_by": apart,
            "mean_pressure": mean,
            "contact_cells": int(np.sum(pressure > 0)),
            "heights": heights.tolist(),
            "pressure": [[float(f"{p:.13e}") for p in row] for row in pressure],
        }
    json.dump(out, sys.stdout)


main()

"""Plane contact of a wavy surface, loaded and unloaded.

Periodic contact of identical bodies, nu = 0.3, mu = 0.3, amplitude of the wave 0.01 of the wavelength, mean pressure
0.4 of full contact, tangential load 0.7 mu P and back to -0.14 mu P. (a) Shear traction after unloading, line:
superposition of Jaeger and Ciavarella, dots: 256 cells per wavelength. (b) RMS error of the shear traction relative to
the RMS of mu p; it scatters, since the borders of stick fall differently relative to cell centres.
"""

import numpy as np
from _figures import BLACK, figure, letters, save

import fretting
from fretting import analytic

MU, amplitude = 0.3, 0.01
modulus = 1 / (2 * (1 - 0.09))
full = np.pi * modulus * amplitude
mean = 0.4 * full
load = 0.7 * MU * mean
body = {"substrate": {"young": 1.0, "poisson": 0.3}}
errors, counts = [], [64, 128, 256, 512, 1024]
drawn, (left, right) = figure(2, height=62)
for cells in counts:
    area = 4 / cells
    history = fretting.run(
        {
            "grid": {"cells": [cells, 4], "size": [1.0, 4 / cells], "periodic": True},
            "upper": body,
            "lower": body,
            "profile": {"wave": {"amplitude": amplitude, "wavelength_x": 1.0}},
            "friction": {"coefficient": MU},
            "load": [
                {"normal_force": mean * area, "increments": 1},
                {"tangential_force": [load * area, 0.0], "increments": 6},
                {"tangential_force": [-0.2 * load * area, 0.0], "increments": 6},
            ],
        }
    )

    def at(pressure: float, x: np.ndarray = history.x) -> np.ndarray:
        """Pressure of Westergaard's contact at a mean pressure."""
        return analytic.westergaard(
            amplitude=amplitude, wavelength=1.0, mean_pressure=pressure, modulus=modulus
        ).pressure(x)

    whole = at(mean)
    exact = MU * (whole - at(mean - load / MU)) - 2 * MU * (whole - at(mean - 1.2 * load / (2 * MU)))
    shear = history.field("shear_x")[:, 1]
    errors.append(np.sqrt(((shear - exact) ** 2).sum() / ((MU * whole) ** 2).sum()))
    if cells == 256:
        left.plot(history.x, exact / full, label="superposition")
        left.set_ylim(-0.22, 0.14)
        left.plot(history.x[::3], shear[::3] / full, "o", color=BLACK, ms=2, label="computed")
left.set(xlabel="$x$ / wavelength", ylabel="$q / p^*$")
left.legend(loc="upper left", fontsize=6)
right.loglog(counts, errors, "o-", label="computed")
right.loglog(counts, errors[0] * counts[0] / np.array(counts), color="0.6", ls=":", label="first order")
right.set(xlabel="cells per wavelength", ylabel="RMS error / RMS $\\mu p$", xticks=counts, xticklabels=counts)
right.minorticks_off()
right.legend()
letters((left, right))
save(drawn)

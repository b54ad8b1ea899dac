"""Rough contact.

Rigid flat on a self-affine rough half-space, periodic, nu = 0.3, frictionless, 256 x 256 cells; Hurst exponent 0.8,
wavelengths from the period to 8 cells, RMS slope h' = 0.05, mean pressure 0.05 E* h'. (a) Topography relative to its
RMS height. (b) Contact pressure relative to E* h', logarithmic; white: out of contact. (c) Distribution of the contact
pressure.
"""

import matplotlib.pyplot as plt
import numpy as np
from _figures import figure, letters, map_of, save
from matplotlib.colors import LogNorm

import fretting

CELLS, MODULUS, SLOPE = 256, 1 / 0.91, 0.05
wave = np.hypot(*np.meshgrid(np.fft.fftfreq(CELLS) * CELLS, np.fft.rfftfreq(CELLS) * CELLS, indexing="ij"))
kept = (wave >= 1) & (wave <= CELLS / 8)
amplitude = np.where(kept, np.maximum(wave, 1) ** -1.8, 0.0)
heights = np.fft.irfft2(amplitude * np.exp(2j * np.pi * np.random.default_rng(1).random(wave.shape)), s=(CELLS, CELLS))
gradient = np.hypot(*np.gradient(heights, 1 / CELLS))
heights *= SLOPE / np.sqrt(np.mean(gradient**2))
mean = 0.05 * MODULUS * SLOPE
history = fretting.run(
    {
        "grid": {"cells": [CELLS, CELLS], "size": [1.0, 1.0], "periodic": True},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 1.0, "poisson": 0.3}},
        "profile": {"heights": {"values": heights}},
        "load": [{"normal_force": mean, "increments": 1}],
    }
)
p = history.field("pressure") / (MODULUS * SLOPE)
drawn, panels = figure(3, height=60)
image = map_of(panels[0], history, heights / heights.std(), 1.0, cmap="cividis")
drawn.colorbar(image, ax=panels[0], label="height / RMS", location="bottom", shrink=0.85)
image = map_of(panels[1], history, np.where(p > 0, p, np.nan), 1.0, cmap="viridis", norm=LogNorm(1e-2, 1.5))
drawn.colorbar(image, ax=panels[1], label="$p / E^* h'$", location="bottom", shrink=0.85)
panels[2].hist(p[p > 0], bins=60, density=True, histtype="step")
panels[2].set(xlabel="$p / E^* h'$", ylabel="probability density", xlim=(0, 2))
panels[2].set_title(f"contact fraction {np.mean(p > 0):.3f}", fontsize=7, loc="right")
for axes in panels[:2]:
    axes.set(xticks=[], yticks=[])
letters(panels)
plt.close()
save(drawn)

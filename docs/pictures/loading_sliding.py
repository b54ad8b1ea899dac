"""From partial slip to gross slip.

Identical bodies with nu = 0, mu = 0.3, prescribed displacement amplitude, 48 x 48 cells, 60 increments per cycle,
second cycle. (a) Loops for amplitudes of 0.6, 1.1 and 2 times the onset of gross slip. (b) Energy ratio A = W_d/(4 Q*
delta*); line: closed form (Mindlin and Deresiewicz, with rigid sliding beyond the onset), dots: computed, dotted:
criterion A = 0.2.
"""

import numpy as np
from _figures import BLACK, figure, letters, save
from _loadings import FORCE, MU, ONSET, SHEAR, indentation, problem

import fretting


def ratio(amplitude: np.ndarray) -> np.ndarray:
    """Energy ratio of a loop of this amplitude over the onset."""
    f = 1 - np.maximum(1 - amplitude, 0) ** 1.5
    loop = 0.9 * (MU * FORCE) ** 2 / SHEAR * (1 - (1 - f) ** (5 / 3) - 5 * f / 6 * (1 + (1 - f) ** (2 / 3)))
    loop = loop + 4 * MU * FORCE * np.maximum(amplitude - 1, 0) * ONSET
    return loop / (4 * f * MU * FORCE * amplitude * ONSET)


drawn, (left, right) = figure(2, height=62)
amplitudes = np.array([0.3, 0.6, 0.9, 1.1, 1.5, 2.0, 3.0])
found = []
for amplitude in amplitudes:
    stages = [indentation(), {"shift": [amplitude * ONSET, 0.0], "increments": 60, "cycles": 2}]
    history = fretting.run({**problem(48, stages), "output": {"fields": []}})
    found.append(history.cycles["energy_ratio"][1])
    if amplitude in (0.6, 1.1, 2.0):
        x, y = history.increments["shift_x"][60:] / ONSET, history.increments["tangential_force_x"][60:] / (MU * FORCE)
        left.plot(x, y, lw=1, label=f"{amplitude:g}")
left.set(xlabel="$\\delta$ / onset of gross slip", ylabel="$Q / \\mu P$")
left.legend(title="amplitude / onset", title_fontsize=6, fontsize=6)
fine = np.linspace(0.2, 3, 200)
right.plot(fine, ratio(fine), label="closed form")
right.plot(amplitudes, found, "o", color=BLACK, label="computed")
right.axhline(0.2, color="0.6", ls=":")
right.text(3.0, 0.21, "A = 0.2", ha="right", fontsize=6)
right.set(xlabel="amplitude / onset of gross slip", ylabel="energy ratio A")
right.legend(loc="upper left")
letters((left, right))
save(drawn)

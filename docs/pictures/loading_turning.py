"""Rotating tangential force.

Identical bodies with nu = 0, mu = 0.3, |Q| = 0.7 mu P, 32 x 32 cells, 24 increments per turn, three turns. (a) Path of
the upper body for constant
|Q| and for a force that grows linearly from zero. (b) Check by symmetry: the shear traction a quarter of a turn later
must be the shear traction rotated by 90 degrees; largest difference relative to mu p_0 (the transient of the first
turn decays).
"""

import numpy as np
from _figures import figure, letters, save
from _loadings import FORCE, MU, ONSET, PEAK, indentation, problem

import fretting

amplitude = 0.7 * MU * FORCE
wave = {"tangential_force": [amplitude, amplitude], "phase": {"tangential_force": [90, 0]}, "waveform": "sine"}
circle = [
    indentation(),
    {"tangential_force": [amplitude, 0.0], "increments": 4},
    {**wave, "increments": 24, "cycles": 3},
]
spiral = [indentation(), {**wave, "increments": 24, "cycles": 3, "envelope": [0, 1]}]
drawn, (left, right) = figure(2, height=66)
for label, stages in {"constant |Q|": circle, "growing |Q|": spiral}.items():
    history = fretting.run(problem(32, stages))
    left.plot(
        history.increments["shift_x"] / ONSET, history.increments["shift_y"] / ONSET, ".-", ms=3, lw=0.8, label=label
    )
    if label == "constant |Q|":
        turned = []
        for step in range(5, len(history) - 6):
            a = [history.field(f"shear_{axis}", increment=step) for axis in "xy"]
            b = [history.field(f"shear_{axis}", increment=step + 6) for axis in "xy"]
            quarter = [-np.rot90(a[1]), np.rot90(a[0])]
            turned.append(max(abs(b[0] - quarter[0]).max(), abs(b[1] - quarter[1]).max()) / (MU * PEAK))
        right.semilogy(np.arange(len(turned)) / 24, turned, ".-", ms=3, lw=0.8)
left.set(xlabel="$\\delta_x$ / onset of gross slip", ylabel="$\\delta_y$ / onset", aspect="equal")
left.legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize=6)
right.set(xlabel="turns", ylabel="difference / $\\mu p_0$")
letters((left, right))
save(drawn)

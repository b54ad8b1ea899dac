"""Normal and tangential cycles with a phase between them.

Identical bodies with nu = 0, mu = 0.3, 48 x 48 cells, P = 0.7 + 0.2 sin(wt + phase), Q = 0.4 mu P_max sin(wt), 24
increments per cycle, second cycle. (a) Lines: exact (method of dimensionality reduction), dots: computed. (b) Error of
the displacement relative to its maximum.
"""

from _figures import figure, letters, save
from _loadings import FORCE, MU, ONSET, along, indentation, problem

import fretting

drawn, (left, right) = figure(2, height=62)
for phase, mark in ((0, "o"), (90, "s"), (180, "v")):
    cycles = {
        "normal_force": 0.2 * FORCE,
        "tangential_force": [0.4 * MU * FORCE, 0.0],
        "phase": {"normal_force": phase},
        "waveform": "sine",
        "increments": 24,
        "cycles": 2,
    }
    history = fretting.run(problem(48, [indentation(0.7, increments=6), cycles]))
    exact, _ = along(history)
    rows = slice(29, None)
    force = history.increments["tangential_force_x"][rows] / (MU * FORCE)
    (line,) = left.plot(exact[rows] / ONSET, force, lw=0.9)
    left.plot(
        history.increments["shift_x"][rows] / ONSET,
        force,
        mark,
        color=line.get_color(),
        ms=2.5,
        label=f"normal force {phase} degrees ahead",
    )
    error = abs(history.increments["shift_x"] - exact)[6:] / abs(exact).max()
    right.semilogy(error, mark + "-", color=line.get_color(), ms=2, lw=0.7)
left.set(xlabel="$\\delta$ / onset of gross slip", ylabel="$Q / \\mu P_{max}$")
left.legend(fontsize=6)
right.set(xlabel="increment of the cycles", ylabel="error of $\\delta$ / max $\\delta$", ylim=(1e-5, 1e-2))
letters((left, right))
save(drawn)

"""Normal and tangential force changed together.

Identical bodies with nu = 0, mu = 0.3, 48 x 48 cells; proportional paths after Mindlin and Deresiewicz (1953), 8
increments each. (a) Lines: exact (method of dimensionality reduction, 4000 springs), dots: computed. (b) Error of the
displacement relative to its maximum; below 1e-5 not shown.
"""

from _figures import figure, letters, save
from _loadings import FORCE, MU, ONSET, along, problem

import fretting

cases = {
    "Q up, P up slowly": [(0.5, 0.0), (0.5, 0.3), (1.0, 0.9)],
    "Q up, P up fast": [(0.5, 0.0), (0.5, 0.3), (1.0, 0.45)],
    "Q up, P down": [(1.0, 0.0), (1.0, 0.3), (0.6, 0.5)],
    "Q down, P up": [(0.5, 0.0), (0.5, 0.4), (1.0, 0.1)],
    "Q down, P down": [(1.0, 0.0), (1.0, 0.7), (0.6, 0.2)],
}
drawn, (left, right) = figure(2, height=68)
for (label, points), mark in zip(cases.items(), "osv^D", strict=True):
    stages = [
        {"normal_force": p * FORCE, "tangential_force": [t * MU * FORCE, 0.0], "increments": 8} for p, t in points
    ]
    history = fretting.run(problem(48, stages))
    exact, _ = along(history)
    force = history.increments["tangential_force_x"] / (MU * FORCE)
    (line,) = left.plot(exact / ONSET, force, lw=0.9)
    left.plot(history.increments["shift_x"] / ONSET, force, mark, color=line.get_color(), ms=2.5, label=label)
    error = abs(history.increments["shift_x"] - exact) / abs(exact).max()
    right.plot(range(8, 24), error[8:], mark + "-", color=line.get_color(), ms=2.5, lw=0.7)
left.set(xlabel="$\\delta$ / onset of gross slip", ylabel="$Q / \\mu P_{max}$")
left.legend(fontsize=6)
right.set(xlabel="increment", ylabel="error of $\\delta$ / max $\\delta$", yscale="log", ylim=(1e-5, 1e-2))
letters((left, right))
save(drawn)

"""Approach to the steady state of a coupled contact.

Rigid sphere on a coated half-space, h = a, nu = 0.3, and identical bodies; mu = 0.3, amplitude 0.7 mu P, 32 x 32
cells, 12 increments per cycle. (a) First ten loops of the coated contacts. (b) Cycle-to-cycle change (largest relative
change of tractions and motions over a cycle). Elastically similar bodies repeat from the second cycle on (below 1e-9,
not shown); coupled ones approach the steady state slowly and do not reach 1e-5 in 30 cycles.
"""

import numpy as np
from _figures import BLUE, GREEN, ORANGE, figure, letters, save
from _loadings import FORCE, MU, ONSET, indentation, problem

import fretting

cycles = {"tangential_force": [0.7 * MU * FORCE, 0.0], "increments": 12, "cycles": 30}
stages = [indentation(increments=6, ramp="cubic"), cycles]
drawn, (left, right) = figure(2, height=62)
for label, coating, colour in (
    ("E_c/E_s = 2", (2.0, 1.0), ORANGE),
    ("E_c/E_s = 1/2", (0.5, 1.0), GREEN),
    ("elastically similar", None, BLUE),
):
    history = fretting.run(problem(32, stages, coating))
    name = f"${label}$" if coating else label
    right.semilogy(
        history.cycles["cycle"],
        np.where(history.cycles["closure"] > 1e-9, history.cycles["closure"], np.nan),
        "o-",
        ms=2.5,
        lw=0.8,
        color=colour,
        label=name,
    )
    if coating:
        x, y = (
            history.increments["shift_x"][6 : 6 + 120] / ONSET,
            history.increments["tangential_force_x"][6 : 6 + 120] / (MU * FORCE),
        )
        left.plot(x, y, lw=0.8, color=colour, label=name)
left.set(xlabel="$\\delta$ / onset of the uncoated contact", ylabel="$Q / \\mu P$")
left.legend()
right.set(xlabel="cycle", ylabel="cycle-to-cycle change")
right.legend()
letters((left, right))
save(drawn)

"""Loop and zones of the quick start.

Rigid ball, R = 10 mm, on steel (210 GPa, nu = 0.3), mu = 0.2, P = 12 N, Q* = 1.5 N (0.63 mu P), 48 x 48 cells, 30 + 24
increments. (a) Tangential force over relative displacement, first cycle. (b) Zones at the first peak.
"""

from _figures import figure, letters, save, zone_legend, zones

import fretting

history = fretting.run(
    {
        "grid": {"cells": [48, 48], "size": "auto"},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
        "profile": {"sphere": {"radius": 10e-3}},
        "friction": {"coefficient": 0.2},
        "load": [
            {"name": "press", "normal_force": 12.0, "increments": 30, "ramp": "cubic"},
            {"name": "rub", "tangential_force": [1.5, 0.0], "cycles": 1, "increments": 24},
        ],
        "output": {"every": 1},
    }
)
drawn, (left, right) = figure(2, height=60)
left.plot(history.increments["shift_x"][29:] * 1e9, history.increments["tangential_force_x"][29:], ".-")
left.set(xlabel="relative displacement [nm]", ylabel="tangential force [N]")
zones(right, history, 35, 1e-6)
right.set(xlabel="x [um]", ylabel="y [um]")
zone_legend(right, loc="upper left", bbox_to_anchor=(1, 1))
letters((left, right))
save(drawn)

"""Write test_12.csv: what a rig would export of the case ball_on_ball.toml.

Mindlin and Deresiewicz's loop (mu = 0.6) in series with a rig of 30 kN/mm, driven to 8 um; 1 % of noise, offsets, a
drift. An example made by a formula, not a measurement. Needs numpy.
"""

from pathlib import Path

import numpy as np

P, R, MODULUS, SHEAR, MU, RIG, AMPLITUDE = 100.0, 10.0, 105e3, 105e3 / 4, 0.6, 3e4, 8e-3
POINTS, CYCLES = 100, 5
limit = MU * P
radius = np.cbrt(0.75 * P * R / MODULUS)
forces = np.linspace(0.0, limit, 2001)
onset = 3 * limit / (16 * radius * SHEAR) * (1 - (1 - forces / limit) ** (2 / 3)) + forces / RIG


def first_loading(displacement: np.ndarray) -> np.ndarray:
    """Return the force after a displacement of the actuator from rest."""
    return np.interp(displacement, onset, forces)


random = np.random.default_rng(12)
lines = ["Versuch 12;Kugel auf Kugel;P = 100 N", "Datum;03.04.2025", "", "Zyklus;Weg;Kraft", ";µm;N"]
for cycle in range(1, CYCLES + 1):
    time = np.arange(POINTS) / POINTS
    place = AMPLITUDE * np.where(time < 0.5, 1 - 4 * time, 4 * time - 3)
    sign = np.where(time < 0.5, 1.0, -1.0)
    force = sign * (limit - 2 * first_loading(0.5 * (AMPLITUDE - sign * place)))
    place = place + AMPLITUDE * (0.3 + 0.03 * (cycle + time) + 0.01 * random.standard_normal(POINTS))
    force = force + limit * (0.05 + 0.01 * random.standard_normal(POINTS))
    rows = (f"{cycle};{1e3 * d:.3f};{q:.3f}".replace(".", ",") for d, q in zip(place, force, strict=True))
    lines.extend(rows)
Path(__file__).with_name("test_12.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")

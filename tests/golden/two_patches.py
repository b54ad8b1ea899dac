"""Friction on two patches, solved by a dense matrix and block relaxation, for `two_patches.json`.

    python tests/golden/two_patches.py > tests/golden/two_patches.json      (numpy)

A rigid sphere of radius 100 on a half-space with E = 1, nu = 0.3, on 20 x 20 square cells: first pressed by an approach, then
moved along x and y in steps, held against rotation. Friction is 0 where x < 0 and 0.4 where x > 0 (`halves`), or 0.5 and 0.05 by
turns on the quarters (`quarters`). Influence coefficients of uniform tractions on cells are the closed forms of Boussinesq and
Cerruti, by the corner values of antiderivatives. Each step is the implicit contact problem with Coulomb friction: cell after
cell, pressure and shear are set to the solution of the cell's own problem (pressure by its gap, shear by projection on the
friction disc) until nothing changes. Nothing here is shared with the project: no transform, no conjugate gradients, no zones.
"""

import json
import sys

import numpy as np

CELLS, SIZE, RADIUS, POISSON = 20, 2.4, 100.0, 0.3
SHEAR_MODULUS = 1 / (2 * (1 + POISSON))
D = SIZE / CELLS
APPROACH = 0.0085
SHIFTS = ([0.0004, 0.0], [0.0012, 0.0005])


def over_cell(f, x, y):
    """Integral over a cell at offset (x, y) of the function with the antiderivative f."""
    total = 0.0
    for sx, sy, sign in ((1, 1, 1), (-1, 1, -1), (1, -1, -1), (-1, -1, 1)):
        total = total + sign * f(x + sx * D / 2, y + sy * D / 2)
    return total


def matrix() -> np.ndarray:
    """Displacement (z, x, y) of every cell's centre by unit traction (p, q_x, q_y) on every cell."""
    r = np.hypot
    centre = (np.arange(CELLS) - (CELLS - 1) / 2) * D
    x, y = (c.ravel() for c in np.meshgrid(centre, centre, indexing="ij"))
    dx, dy = x[:, None] - x[None, :], y[:, None] - y[None, :]
    over_x = over_cell(lambda a, b: b * np.log(a + r(a, b)), dx, dy)  # of x^2 / r^3
    over_y = over_cell(lambda a, b: a * np.log(b + r(a, b)), dx, dy)  # of y^2 / r^3
    across = over_cell(lambda a, b: -r(a, b), dx, dy)  # of x y / r^3
    out_x = over_cell(lambda a, b: b * np.log(r(a, b)) + a * np.arctan(b / a), dx, dy)  # of x / r^2
    out_y = over_cell(lambda a, b: a * np.log(r(a, b)) + b * np.arctan(a / b), dx, dy)  # of y / r^2
    g, nu = 2 * np.pi * SHEAR_MODULUS, POISSON
    own = (1 - nu) / g * (over_x + over_y)
    turn = (1 - 2 * nu) / (2 * g)
    n = CELLS * CELLS
    k = np.zeros((n, 3, n, 3))
    k[:, 0, :, 0] = own
    k[:, 1, :, 1] = own + nu / g * over_x
    k[:, 2, :, 2] = own + nu / g * over_y
    k[:, 1, :, 2] = k[:, 2, :, 1] = nu / g * across
    k[:, 0, :, 1], k[:, 0, :, 2] = turn * out_x, turn * out_y
    k[:, 1, :, 0], k[:, 2, :, 0] = -turn * out_x, -turn * out_y
    return k


def step(k, gap, friction, before, shift, t, u):
    """Relax tractions t (n, 3) with displacements u to the end of one step; tangential parts count from `before`."""
    n = len(gap)
    columns = [np.ascontiguousarray(k[:, :, c, :].reshape(3 * n, 3)) for c in range(n)]
    near = [c for c in range(n) if gap[c] < 1.2 * APPROACH]
    flat = u.reshape(-1)
    for sweep in range(20000):
        worst = 0.0
        for c in near:
            old = t[c].copy()
            t[c, 0] = max(0.0, old[0] - (gap[c] + u[c, 0] - APPROACH) / k[c, 0, c, 0])
            q = old[1:] - (u[c, 1:] - before[c] - shift) / k[c, 1, c, 1]
            size, limit = np.hypot(*q), friction[c] * t[c, 0]
            t[c, 1:] = q if size <= limit else q * (limit / size if limit > 0 else 0.0)
            change = t[c] - old
            if change.any():
                flat += columns[c] @ change
                worst = max(worst, abs(change).max())
        if worst < 1e-14 * t[:, 0].max():
            return sweep
    raise SystemExit("not converged")


def main() -> None:
    k = matrix()
    centre = (np.arange(CELLS) - (CELLS - 1) / 2) * D
    x, y = (c.ravel() for c in np.meshgrid(centre, centre, indexing="ij"))
    gap = (x**2 + y**2) / (2 * RADIUS)
    maps = {"halves": np.where(x < 0, 0.0, 0.4), "quarters": np.where(x * y > 0, 0.5, 0.05)}
    out = {"origin": "tests/golden/two_patches.py", "cells": CELLS, "size": SIZE, "approach": APPROACH, "shifts": SHIFTS}
    for name, friction in maps.items():
        t, u = np.zeros((len(gap), 3)), np.zeros((len(gap), 3))
        before, at = np.zeros((len(gap), 2)), np.zeros(2)
        rows = []
        for shift in ([0.0, 0.0], *SHIFTS):
            sweeps = step(k, gap, friction, before, np.array(shift) - at, t, u)
            before, at = u[:, 1:].copy(), np.array(shift)
            force = t.sum(axis=0) * D * D
            on_circle = (np.hypot(t[:, 1], t[:, 2]) >= friction * t[:, 0] * (1 - 1e-9)) & (t[:, 0] > 0)
            print(name, shift, sweeps, "sweeps, force", force, "slip", on_circle.sum(), "of", (t[:, 0] > 0).sum(), file=sys.stderr)
            fields = {word: [float(f"{v:.11e}") for v in t[:, i]] for i, word in enumerate(("pressure", "shear_x", "shear_y"))}
            rows.append({"force": force.tolist(), **fields})
        out[name] = {"friction": friction.tolist(), "steps": rows}
    json.dump(out, sys.stdout)


main()

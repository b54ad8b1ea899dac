"""Force by creepage of two like coated cylinders that roll and stick everywhere: numbers of `tests/rolling.rs`, printed.

The response along the surface of a bilayer in plane strain is C_ll(k) of O'Sullivan & King (1988). Of a cell's uniform
shear the displacement is that of the coating's half-space, in closed form, and an integral that decays like
exp(-2 k h), by quadrature. A particle was one cell further ahead an increment ago, so that without slip
xi d = u_i - u_(i+1) in every cell of the contact: a dense system for the shear of its cells.

Check: without a coating the force tends to pi a E* xi / 2 (Carter).
"""

import numpy as np
from scipy.integrate import quad

CELLS, HALF_WIDTH, THICKNESS = 40, 1.0, 0.5
YOUNG, POISSON = 1.82, 0.3


def response(k, young):
    """C_ll of the bilayer at the wavenumber k."""
    g1, g2 = young / 2 / (1 + POISSON), YOUNG / 2 / (1 + POISSON)
    x, free = k * THICKNESS, 3 - 4 * POISSON
    lam = (g1 * free - g2 * free) / (g1 * free + g2)
    kap = (g1 / g2 - 1) / (g1 / g2 + free)
    e = np.exp(-2 * x)
    d = 1 - (lam + kap + 4 * kap * x * x) * e + lam * kap * e * e
    return (1 - POISSON) / (g1 * k) * (1 - 4 * kap * x * e - lam * kap * e * e) / d


def of_half_space(m):
    """Integral of -ln |m - s| over a cell of unit width, up to a constant."""

    def term(y):
        return y * np.log(abs(y)) if y else 0.0

    return -(term(m + 0.5) - term(m - 0.5))


def difference(m, d, young):
    """Displacement of both bodies at m cells from a loaded cell less that at m + 1."""
    shear = young / 2 / (1 + POISSON)

    def rest(k):
        beyond = response(k, young) - (1 - POISSON) / (shear * k)
        return beyond * np.sinc(k * d / 2 / np.pi) * 2 * np.sin(k * (m + 0.5) * d) * np.sin(k * d / 2)

    edges = [1e-12, *np.linspace(0.05, 1, 20) * 25 / THICKNESS]
    between = zip(edges[:-1], edges[1:], strict=True)
    parts = [quad(rest, a, b, epsabs=1e-15, epsrel=1e-12, limit=400)[0] for a, b in between]
    closed = (1 - POISSON) / shear * d / np.pi * (of_half_space(m) - of_half_space(m + 1))
    return 2 * (closed + d / np.pi * sum(parts))


def force_by_creepage(young):
    d = 2 * HALF_WIDTH / CELLS
    known = {m: difference(m, d, young) for m in range(-CELLS, CELLS + 1)}
    matrix = np.array([[known[i - j] for j in range(CELLS)] for i in range(CELLS)])
    return np.linalg.solve(matrix, np.full(CELLS, d)).sum() * d


for young in (YOUNG, YOUNG / 2, 2 * YOUNG, 10 * YOUNG):
    print(young, f"{force_by_creepage(young):.10f}")

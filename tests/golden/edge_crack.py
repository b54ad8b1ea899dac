"""Stress intensity of an edge crack in a half-plane, normal and inclined: digits for the tests of `subsurface/edge_crack.rs`.

    python tests/golden/edge_crack.py

Dislocations along the crack as in the program, but with another quadrature: s = 1 - t^2 takes the root at the tip away, Gauss-Legendre
points in t carry the dislocations, zeros of Legendre's function of the second kind are the points of collocation (there the rule is exact
for a Cauchy integral), and no condition is set at the mouth. Error of the order N^-2, extrapolated from N and 2 N. Known: 1.12152226
(Koiter), 0.683 for a linear stress (Tada, Paris & Irwin), 0.705 and 0.364 at 45 degrees (Murakami).
"""

import numpy as np


def second_kind(degree, x):
    """Legendre's function of the second kind, |x| < 1."""
    before, value = np.arctanh(x), x * np.arctanh(x) - 1
    for n in range(1, degree):
        before, value = value, ((2 * n + 1) * x * value - n * before) / (n + 1)
    return value


def factors(angle, count, tension, shear):
    """K_I and K_II over sqrt(pi l) of a crack at an angle to the surface, for tractions over the distance from the mouth."""
    nodes, weights = np.polynomial.legendre.leggauss(2 * count)
    barycentric = (-1.0) ** np.arange(2 * count) * np.sqrt((1 - nodes**2) * weights) / -nodes
    at_tip = 2 * (barycentric / barycentric.sum())[nodes > 0]
    weights, nodes = weights[nodes > 0], nodes[nodes > 0]
    zeros = []
    for low, high in zip(nodes, [*nodes[1:], 1 - 1e-16]):
        sign = second_kind(2 * count, low) > 0
        for _ in range(80):
            middle = (low + high) / 2
            low, high = (middle, high) if (second_kind(2 * count, middle) > 0) == sign else (low, middle)
        zeros.append((low + high) / 2)
    turn = np.exp(1j * angle)
    at, place = 1 - nodes**2, 1 - np.array(zeros) ** 2
    matrix = np.zeros((2 * count, 2 * count))
    for kind, burgers in enumerate((1, 1j)):
        a = np.conj(burgers * np.conj(turn))
        for j in range(count):
            z0, z = at[j] * turn, place * turn
            far, height = 1 / (z - np.conj(z0)), z0 - np.conj(z0)
            phi = -(a * far + np.conj(a) * height * far**2)
            slope = a * far**2 + 2 * np.conj(a) * height * far**3
            psi = -phi - z * slope - np.conj(a) * far
            traction = 2 * burgers / (place - at[j]) + 2 * phi.real + turn**2 * (np.conj(z) * slope + psi)
            matrix[:count, kind * count + j] = traction.real * 2 * weights[j]
            matrix[count:, kind * count + j] = traction.imag * 2 * weights[j]
    density = np.linalg.solve(matrix, -np.concatenate([tension(place), shear(place)]))
    return np.array([at_tip @ density[:count], at_tip @ density[count:]]) * 2 * np.pi * np.sqrt(2)


def extrapolated(degrees, tension, shear, count=64):
    """The limit of an error that falls with the square of the number."""
    angle = np.deg2rad(90 - degrees)
    return (4 * factors(angle, 2 * count, tension, shear) - factors(angle, count, tension, shear)) / 3


if __name__ == "__main__":
    one, zero = np.ones_like, np.zeros_like
    print("normal, uniform", extrapolated(0, one, zero), "linear", extrapolated(0, lambda s: s, zero))
    for degrees in (30, 45, 60):
        c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
        print(degrees, extrapolated(degrees, lambda p: c * c * one(p), lambda p: -c * s * one(p)))

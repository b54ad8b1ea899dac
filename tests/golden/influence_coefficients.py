"""Influence coefficients of coated half-spaces: Love's and Cerruti's closed forms for the coating's own half-space, and for what
differs from it the Hankel integral along the real axis at Gauss points of the cell. The difference of the responses falls like
exp(-2 k h), so its kernels are smooth over a distance of 2 h and need nothing special where the cell lies on itself. Responses by
mpmath (radial_kernels.py), sums in double precision with scipy's Bessel functions: good to about 1e-13 of zz at the same offset.

Computes all rows of the table and compares. The table itself was made earlier, by the same formulas in a program that is lost; its
numbers stand as they were."""
import json
import pathlib

import mpmath as mp
import numpy as np
from radial_kernels import DIGITS, transformed
from scipy.special import j0, j1

BODIES = [
    ([[2.0, 0.3, 0.1]], [1.0, 0.3]),
    ([[2.0, 0.3, 1.0]], [1.0, 0.3]),
    ([[2.0, 0.3, 10.0]], [1.0, 0.3]),
    ([[2.0, 0.3, 100.0]], [1.0, 0.3]),
    ([[0.5, 0.3, 1.0]], [1.0, 0.3]),
    ([[0.5, 0.3, 10.0]], [1.0, 0.3]),
    ([[10.0, 0.25, 5.0]], [1.0, 0.35]),
]
OFFSETS = [(0, 0), (1, 0), (1, 1), (3, 2), (17, 0), (40, 17), (120, 90)]


def constants(young, nu):
    """Factors over distance of Z0, A0, B2, Z1 of a homogeneous half-space, times 2 pi."""
    young, nu = mp.mpf(young), mp.mpf(nu)
    mu = young / (2 * (1 + nu))
    normal = (1 - nu) / mu
    return [normal, (normal + 1 / mu) / 2, (normal - 1 / mu) / 2, (1 - 2 * nu) / (2 * mu)]


def corner(x, y):
    """1/r, (x^2 - y^2)/r^3, 2 x y/r^3, x/r^2 and y/r^2, integrated over x and y without limits."""
    r = mp.hypot(x, y)
    across, along = x * mp.asinh(y / abs(x)), y * mp.asinh(x / abs(y))
    log = mp.log(r)
    return [across + along, along - across, -2 * r, y * log + x * mp.atan(y / x), x * log + y * mp.atan(x / y)]


def over_cell(i, j):
    """The same integrals over the unit cell at (i, j)."""
    total = [mp.mpf(0)] * 5
    half = mp.mpf(1) / 2
    for sx in (-1, 1):
        for sy in (-1, 1):
            total = [sum_ + sx * sy * part for sum_, part in zip(total, corner(i + sx * half, j + sy * half))]
    return total


def components(z0, a0, b2_even, b2_odd, z1_x, z1_y):
    return dict(zz=z0, xx=a0 - b2_even, yy=a0 + b2_even, xy=-b2_odd, zx=z1_x, zy=z1_y)


def homogeneous(material, i, j):
    z0, a0, b2, z1 = (factor / (2 * mp.pi) for factor in constants(*material))
    flat, even, odd, x, y = over_cell(i, j)
    return components(z0 * flat, a0 * flat, b2 * even, b2 * odd, z1 * x, z1 * y)


def wavenumbers(thickness, farthest, points):
    """Nodes and weights up to exp(-2 k h) = 1e-18: panels that grow from 0 until a wave fits into one."""
    last, longest = 21 / thickness, 6 / farthest
    edges = [0.0, 1e-9]
    while edges[-1] < last:
        edges.append(edges[-1] + min(edges[-1], longest, 0.5 / thickness))
    x, w = np.polynomial.legendre.leggauss(points)
    low, high = np.array(edges[:-1])[:, None], np.array(edges[1:])[:, None]
    return ((low + high) / 2 + (high - low) / 2 * x).ravel(), ((high - low) / 2 * w).ravel()


def remainder(layers, substrate):
    """What differs from the coating's half-space, k times the response, at a wavenumber: tabulated by Chebyshev's polynomials."""
    young, nu, thickness = layers[0]

    def exact(k):
        return [float(value - one) for value, one in zip(transformed(mp.mpf(k), layers, substrate), constants(young, nu))]

    # In k h the difference is analytic about the real axis; panels of length 1/8 up to 21.
    count, length = 168, 0.125 / thickness
    nodes = np.cos(np.pi * (np.arange(20) + 0.5) / 20)
    panels = []
    for n in range(count):
        values = np.array([exact((n + 0.5 + 0.5 * node) * length) for node in nodes])
        panels.append(np.polynomial.chebyshev.chebfit(nodes, values, 19))

    def at(k):
        place = k / length
        panel = np.minimum(place.astype(int), count - 1)
        result = np.empty((4, k.size))
        for n in np.unique(panel):
            here = panel == n
            result[:, here] = np.polynomial.chebyshev.chebval(2 * (place[here] - n) - 1, panels[n])
        return result

    return at


def kernels(r, nodes, weights, difference):
    """Z0, A0, B2, Z1 of the difference at distances r."""
    total = []
    for distance in r:
        z = nodes * distance
        zero, one = j0(z), j1(z)
        bessel = [zero, zero, 2 * one / z - zero, one]
        total.append([np.sum(weights * lane * wave) for lane, wave in zip(difference, bessel)])
    return np.array(total).T / (2 * np.pi)


def layered(at, thickness, i, j, points, panel_points):
    """The difference over the cell at (i, j), by Gauss points in pieces of the coating's thickness, or of half the distance."""
    pieces = int(np.ceil(1 / max(thickness, (np.hypot(i, j) - 0.8) / 2)))
    nodes, weights = wavenumbers(thickness, np.hypot(i + 1, j + 1), panel_points)
    difference = at(nodes)
    x, w = np.polynomial.legendre.leggauss(points)
    edges = np.linspace(-0.5, 0.5, pieces + 1)
    places = np.concatenate([(a + b) / 2 + (b - a) / 2 * x for a, b in zip(edges, edges[1:])])
    weight = np.concatenate([(b - a) / 2 * w for a, b in zip(edges, edges[1:])])
    dx, dy = (part.ravel() for part in np.meshgrid(i + places, j + places, indexing="ij"))
    both = np.outer(weight, weight).ravel()
    r = np.hypot(dx, dy)
    distances, index = np.unique(np.round(r, 14), return_inverse=True)
    z0, a0, b2, z1 = kernels(distances, nodes, weights, difference)[:, index]
    cos, sin = dx / r, dy / r
    sums = [z0, a0, b2 * (cos**2 - sin**2), 2 * b2 * cos * sin, z1 * cos, z1 * sin]
    return components(*(np.sum(both * one) for one in sums))


def main():
    mp.mp.dps = DIGITS
    table = json.loads(pathlib.Path(__file__).with_suffix(".json").read_text())["rows"]
    expected = {(json.dumps(row["layers"]), row["i"], row["j"]): row for row in table}
    rows, worst = [], 0.0
    for layers, substrate in BODIES:
        at = remainder(layers, substrate)
        young, nu, thickness = layers[0]
        for i, j in OFFSETS:
            own = homogeneous((young, nu), i, j)
            rest = layered(at, thickness, i, j, 16, 20)
            values = {name: float(own[name] + rest[name]) for name in own}
            row = expected[json.dumps(layers), i, j]
            error = max(abs(values[name] - row[name]) for name in values) / row["zz"]
            rows.append(dict(layers=layers, substrate=substrate, i=i, j=j, **values))
            print(rows[-1], f"{error:.1e}", flush=True)
            worst = max(worst, error)
    assert len(rows) == len(table)
    print(f"largest difference from the table: {worst:.1e} of zz")
    assert worst < 1e-12


if __name__ == "__main__":
    main()

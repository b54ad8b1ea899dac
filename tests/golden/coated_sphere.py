"""Frictionless contact of a rigid paraboloid r^2/(2 R) with a coated half-space: axisymmetric, no grid.

With the pressure's Hankel transform  Int_0^a chi(t) cos(k t) dt,  Abel's transform turns  u_z = approach - r^2/(2 R), r < a,  into
Fredholm's equation of the second kind

    c [pi/2 chi(s) + Int_0^a chi(t) (m(s - t) + m(s + t))/2 dt] = approach - s^2/R,     m(x) = Int_0^oo (k C_zz(k)/c - 1) cos(k x) dk

with c = k C_zz at infinity, the coating's own half-space (Sneddon 1965, Int. J. Engng Sci. 3, 47, for c alone). The pressure ends at
zero where chi(a) = 0, which gives the approach; the force is 2 pi Int chi dt and the pressure in the middle - Int chi'(t)/t dt. chi
is even and smooth: Gauss points, and Chebyshev's polynomials of t^2 for its derivative. Everything twice, with more points and
panels: the difference is the accuracy, 1e-11 at the best. Responses by mpmath (radial_kernels.py)."""
import json
import pathlib

import mpmath as mp
import numpy as np
from radial_kernels import DIGITS, half_space, transformed

RATIOS = [0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 10.0]
THICKNESSES = [0.25, 0.5, 1.0, 2.0]
POISSON = 0.3


def response(ratio, panels, points):
    """Wavenumbers times the thickness, their weights, and k C_zz over that of the coating, less 1."""
    mp.mp.dps = DIGITS
    layers, substrate = [[ratio, POISSON, 1.0]], [1.0, POISSON]
    far = half_space(mp.mpf(ratio), mp.mpf(POISSON))[0]
    x, w = np.polynomial.legendre.leggauss(points)
    # finer where a stiff coating on a soft base changes fastest
    edges = np.concatenate([[0.0], np.geomspace(1e-3, 1.0, panels), np.linspace(1.0, 22.0, 2 * panels)[1:]])
    low, high = edges[:-1, None], edges[1:, None]
    k, weight = ((low + high) / 2 + (high - low) / 2 * x).ravel(), ((high - low) / 2 * w).ravel()
    return k, weight, np.array([float(transformed(mp.mpf(one), layers, substrate)[0] / far - 1) for one in k])


def solved(a, thickness, table, count, c):
    """Force, approach and pressure in the middle for a contact radius, with R = 1."""
    k, weight, difference = table
    k, weight = k / thickness, weight / thickness
    x, w = np.polynomial.legendre.leggauss(count)
    s, w = a * (x + 1) / 2, a * w / 2
    waves = np.cos(np.outer(s, k))
    matrix = np.pi / 2 * np.eye(count) + (waves * (weight * difference)) @ waves.T * w
    one, square = np.linalg.solve(c * matrix, np.array([np.ones(count), s**2]).T).T

    # values at a and 0 and chi'/t, by polynomials of t^2
    def fit(values):
        return np.polynomial.chebyshev.Chebyshev.fit(s**2, values, min(count - 1, 24), domain=[0, a * a])

    approach = fit(square)(a * a) / fit(one)(a * a)
    chi = approach * one - square
    slope = 2 * fit(chi).deriv()(s**2)
    return 2 * np.pi * np.sum(w * chi), approach, -np.sum(w * slope)


def contact(ratio, thickness, table, count):
    """p0, a and approach over Hertz's on the bare substrate, whose contact radius is 1."""
    c = (1 - POISSON**2) * 2 / ratio
    modulus = 1 / (1 - POISSON**2)
    force = 4 / 3 * modulus

    def off(a):
        return solved(a, thickness, table, count, c)[0] - force

    low, high = 0.1, 4.0
    for _ in range(12):
        middle = (low + high) / 2
        low, high = (middle, high) if off(middle) < 0 else (low, middle)
    before, here = low, high
    f_before, f_here = off(before), off(here)
    for _ in range(20):
        if f_here == f_before or abs(here - before) < 1e-15:
            break
        before, here, f_before = here, here - f_here * (here - before) / (f_here - f_before), f_here
        f_here = off(here)
    _, approach, peak = solved(here, thickness, table, count, c)
    return np.array([peak / (2 * modulus / np.pi), here, approach])


def main():
    rows = []
    tables = {ratio: [response(ratio, 16, 12), response(ratio, 22, 16)] for ratio in RATIOS}
    for thickness in THICKNESSES:
        for ratio in RATIOS:
            coarse, fine = (contact(ratio, thickness, table, count) for table, count in zip(tables[ratio], (40, 60)))
            accuracy = max(1e-11, float(np.max(np.abs(coarse / fine - 1))))
            p0, a, approach = map(float, fine)
            rows.append(dict(young_ratio=ratio, poisson_coating=POISSON, poisson_substrate=POISSON, h=thickness, p0=p0, a=a, approach=approach, accuracy=accuracy))
            print(rows[-1], flush=True)
    about = (
        "Frictionless contact of a rigid paraboloid r^2/(2R) with a coated half-space, from a spectral axisymmetric solution (no grid). "
        "Normalised by the Hertz values of the bare SUBSTRATE at the same load: p0/pH, a/aH, approach/approachH; thickness = h * aH. "
        "Digits good to about 'accuracy' (relative). Made by coated_sphere.py."
    )
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"rows": [\n')
        file.write(",\n".join(json.dumps(row) for row in rows) + "\n]}\n")


if __name__ == "__main__":
    main()

"""Point-force kernels of harsh stacks: 40-digit Gauss quadrature along the real axis of what differs from the coating's
half-space, with mpmath's Bessel functions; the response by transfer matrices exp(M k h) of the 4 x 4 first-order system."""
import json
import pathlib

import mpmath as mp

DIGITS = 40


def system(nu, mu):
    b = 1 / (2 * (1 - nu))
    g = (1 - 2 * nu) * b
    a = nu / (1 - nu)
    # (w, t)' with w = (kU, kW), t = (Q, P) on the part below, s = k z
    return mp.matrix([[0, -1, -1 / mu, 0], [a, 0, 0, -g / mu], [-4 * mu * b, 0, 0, -a], [0, 0, 1, 0]])


def half_space(young, nu):
    mu = young / (2 * (1 + nu))
    return (1 - nu) / mu, (1 - 2 * nu) / (2 * (1 - nu)), mu


def transformed(k, layers, substrate):
    """k C_zz, k (C_rr + C_tt)/2, k (C_rr - C_tt)/2, k C_rz."""
    mp.mp.dps = DIGITS + 20 + int(2.2 * k * sum(h for _, _, h in layers))
    if substrate is None:
        y, v = mp.matrix([[0, 0], [0, 0], [1, 0], [0, 1]]), [mp.mpf(0), mp.mpf(1)]
    else:
        c0, g, mu = half_space(*map(mp.mpf, substrate))
        y, v = mp.matrix([[c0, c0 * g], [c0 * g, c0], [1, 0], [0, 1]]), [1 / mu, mp.mpf(1)]
    for young, nu, h in reversed(layers):
        young, nu, h = map(mp.mpf, (young, nu, h))
        mu, x = young / (2 * (1 + nu)), k * h
        m, c, s, one = -system(nu, mu), mp.cosh(x), mp.sinh(x), mp.eye(4)
        y = (c * one + s * m + (x * s / 2 * one + (x * c - s) / 2 * m) * (m * m - one)) * y
        v = [c * v[0] + s / mu * v[1], mu * s * v[0] + c * v[1]]
    compliance, across = y[0:2, 0:2] * y[2:4, 0:2] ** -1, v[0] / v[1]
    mp.mp.dps = DIGITS
    rr = compliance[0, 0]
    return [+compliance[1, 1], (rr + across) / 2, (rr - across) / 2, +compliance[0, 1]]


def gauss(n):
    points = []
    for i in range(1, n + 1):
        x = mp.cos(mp.pi * (i - mp.mpf(1) / 4) / (n + mp.mpf(1) / 2))
        for _ in range(8):
            before, value = mp.mpf(1), x
            for k in range(2, n + 1):
                before, value = value, ((2 * k - 1) * x * value - (k - 1) * before) / k
            slope = n * (x * value - before) / (x * x - 1)
            x -= value / slope
        points.append((x, 2 / ((1 - x * x) * slope * slope)))
    return points


def kernels(r, layers, substrate, rule):
    """Z0, A0, B2, Z1 at distance r."""
    r = mp.mpf(r)
    c0, g, mu = half_space(*map(mp.mpf, layers[0][:2]))
    far = [c0, (c0 + 1 / mu) / 2, (c0 - 1 / mu) / 2, c0 * g]
    edges = [mp.mpf(0)] + [mp.mpf(10) ** (n / 2) for n in range(-40, -2)]
    edge, width = mp.mpf(10) ** -1, min(mp.mpf(1) / 2, 2 / r)
    while edge < 45:
        edges.append(edge)
        edge += width
    total = [mp.mpf(0)] * 4
    for a, b in zip(edges, edges[1:]):
        for x, weight in rule:
            k = (a + b) / 2 + (b - a) / 2 * x
            response = transformed(k, layers, substrate)
            for lane, order in enumerate((0, 0, 2, 1)):
                total[lane] += (b - a) / 2 * weight * (response[lane] - far[lane]) * mp.besselj(order, k * r)
    return [(total[lane] + far[lane] / r) / (2 * mp.pi) for lane in range(4)]


def main():
    mp.mp.dps = DIGITS + 5
    rule = gauss(24)
    mp.mp.dps = DIGITS
    cases = [
        ([[1e-6, 0.3, 1.0]], [1.0, 0.3], 2), ([[1e-6, 0.3, 1.0]], [1.0, 0.3], 8), ([[1e-6, 0.3, 1.0]], [1.0, 0.3], 12),
        ([[1e-4, 0.3, 1.0]], [1.0, 0.3], 4), ([[1e6, 0.3, 1.0]], [1.0, 0.3], 1), ([[1.0, 0.3, 1.0]], None, 8),
        ([[1e-6, 0.5, 1.0]], [1.0, 0.3], 12),
    ]
    rows = []
    for layers, substrate, r in cases:
        values = [mp.nstr(value, 18) for value in kernels(r, layers, substrate, rule)]
        rows.append(dict(layers=layers, substrate=substrate, r=r, **dict(zip(("z0", "a0", "b2", "z1"), values))))
    about = ("Displacement at distance r from a unit point force on a layered half-space (rigid base: substrate null): "
             "G_zz = z0, G_xx, G_yy = a0 -/+ cos(2 phi) b2, G_zx = cos(phi) z1. Made by radial_kernels.py, 18 digits of the binary inputs.")
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"rows": [\n')
        file.write(",\n".join(json.dumps(row) for row in rows) + "\n]}\n")


if __name__ == "__main__":
    main()

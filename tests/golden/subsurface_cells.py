"""Stress under a uniformly loaded rectangle of a layered half-space, by an independent way: the waves of every layer
(Papkovich-Neuber potentials, decaying from its top and from its bottom) from one dense system of boundary and interface
equations a wavenumber, then the plane integral over wavenumbers in polar coordinates (Gauss panels in k, trapezoidal rule in
the angle) with the rectangle's sine factors. No Hankel transform, no table, no integration over the rectangle in space.

Writes subsurface_cells.json. numpy; two minutes.
"""

import json

import numpy as np


def waves(k, g, nu, z, h):
    """[U, W, T, S] (times 2G, 2G, 1, 1) of the four waves A, B (decaying from z = 0), C, D (decaying upward from z = h)."""
    kz, kg = k * z, k * (z - h)
    e, f = np.exp(-kz), np.exp(kg)
    zero = np.zeros_like(k)
    u = np.stack([-e, -kz * e, -f, -kg * f]) / (2 * g)
    w = np.stack([e, (3 - 4 * nu + kz) * e, -f, (3 - 4 * nu - kg) * f]) / (2 * g)
    t = k * np.stack([e, (1 - 2 * nu + kz) * e, -f, (1 - 2 * nu - kg) * f])
    s = k * np.stack([-e, -(2 - 2 * nu + kz) * e, -f, (2 - 2 * nu - kg) * f])
    return np.stack([u, w, t, s]) + zero  # (4 quantities, 4 waves, k)


def transfer(k, layers, substrate, depth, layer):
    """Stress per unit P, Q, q_t wave: dict of arrays over k."""
    n = len(layers)
    size = 4 * n + (2 if substrate else 0)
    a = np.zeros((len(k), size, size))
    b = np.zeros((len(k), size, 2))
    moduli = [(e / (2 * (1 + nu)), nu, h) for e, nu, h in layers]
    if substrate:
        moduli.append((substrate[0] / (2 * (1 + substrate[1])), substrate[1], 0.0))
    scale = [1.0, 1.0, 1.0, 1.0]

    def put(row, column, block, sign):
        for q in range(block.shape[0]):
            for w in range(block.shape[1]):
                a[:, row + q, column + w] += sign * block[q, w] * scale[q]

    def count(m):
        return 4 if m < n else 2

    top = waves(k, *moduli[0][:2], 0.0, moduli[0][2])[2:, : count(0)]
    put(0, 0, top, 1.0)
    b[:, 0, 1] = -1.0  # T = -Q
    b[:, 1, 0] = -1.0  # S = -p
    for m in range(n):
        g, nu, h = moduli[m]
        row = 2 + 4 * m
        bottom = waves(k, g, nu, h, h)
        if m + 1 < len(moduli):
            g2, nu2, h2 = moduli[m + 1]
            put(row, 4 * m, bottom, 1.0)
            put(row, 4 * (m + 1), waves(k, g2, nu2, 0.0, h2)[:, : count(m + 1)], -1.0)
        else:
            put(row, 4 * m, bottom[:2], 1.0)
    norm = np.abs(a).max(axis=2, keepdims=True)
    x = np.linalg.solve(a / norm, b / norm)
    tops = np.concatenate([[0.0], np.cumsum([h for _, _, h in layers])])
    g, nu, h = moduli[layer]
    field = waves(k, g, nu, depth - tops[layer], h)[:, : count(layer)]
    amplitudes = x[:, 4 * layer : 4 * layer + count(layer)]
    u, w, t, s = np.einsum("qwk,kwl->qlk", field, amplitudes)
    lame = 2 * g * nu / (1 - 2 * nu)
    slope = (s + lame * k * u) / (lame + 2 * g)
    along = -(lame + 2 * g) * k * u + lame * slope
    across = lame * (slope - k * u)
    # across the plane: decaying and growing wave a layer
    size = 2 * n + (1 if substrate else 0)
    a = np.zeros((len(k), size, size))
    b = np.zeros((len(k), size))
    b[:, 0] = -1.0

    def pair(g, z, h):
        e, f = np.exp(-k * z), np.exp(k * (z - h))
        return np.stack([np.stack([e, f]), g * k * np.stack([-e, f])])  # u, stress

    def put_pair(row, column, block, sign):
        for q in range(block.shape[0]):
            for w in range(block.shape[1]):
                a[:, row + q, column + w] += sign * block[q, w]

    put_pair(0, 0, pair(moduli[0][0], 0.0, moduli[0][2])[1:, : (2 if n else 1)], 1.0)
    for m in range(n):
        g_m, _, h_m = moduli[m]
        bottom = pair(g_m, h_m, h_m)
        if m + 1 < len(moduli):
            put_pair(1 + 2 * m, 2 * m, bottom, 1.0)
            below = pair(moduli[m + 1][0], 0.0, moduli[m + 1][2])[:, : (2 if m + 1 < n else 1)]
            put_pair(1 + 2 * m, 2 * (m + 1), below, -1.0)
        else:
            put_pair(1 + 2 * m, 2 * m, bottom[:1], 1.0)
    x = np.linalg.solve(a, b[:, :, None])[:, :, 0]
    block = pair(g, depth - tops[layer], h)[:, : (2 if layer < n else 1)]
    ut, stz = np.einsum("qwk,kw->qk", block, x[:, 2 * layer : 2 * layer + block.shape[1]])
    return dict(zz=s, lz=t, ll=along, tt=across, tz=stz, lt=k * g * ut)


def stresses(layers, substrate, depth, layer, sides, offsets):
    """For every offset the six components by p, q_x, q_y on the rectangle."""
    reach = max(np.hypot(*o) for o in offsets) + np.hypot(*sides)
    end = 42.0 / depth
    # few and wide panels at first grade toward 0, then steps that resolve the wave
    width = min(4.0 / reach, 1.0 / depth)
    edges = np.concatenate([width * 0.5 ** np.arange(30, 0, -1), np.arange(width, end + width, width)])
    edges = np.concatenate([[0.0], edges])
    point, weight = np.polynomial.legendre.leggauss(20)
    k = (0.5 * (edges[1:] + edges[:-1])[:, None] + 0.5 * np.diff(edges)[:, None] * point).ravel()
    dk = (0.5 * np.diff(edges)[:, None] * weight).ravel()
    f = transfer(k, layers, substrate, depth, layer)
    result = np.zeros((len(offsets), 3, 6))
    for first in range(0, len(k), 400):
        part = slice(first, first + 400)
        kk = k[part]
        count = int(kk.max() * reach + 60)
        theta = 2 * np.pi * (np.arange(count) + 0.5) / count
        c, s = np.cos(theta)[None, :], np.sin(theta)[None, :]
        sinc = np.sinc(kk[:, None] * c * sides[0] / 2 / np.pi) * np.sinc(kk[:, None] * s * sides[1] / 2 / np.pi)
        plane = sinc * (kk * dk[part])[:, None] * (2 * np.pi / count) / (4 * np.pi**2) * sides[0] * sides[1]
        get = {name: (v[:, part, None] if v.ndim == 2 else v[part, None]) for name, v in f.items()}
        components = []
        for load in range(3):
            # amplitudes of P, Q, q_t: q_l = i Q
            if load == 0:
                p, q, qt = 1.0 + 0 * c, 0 * c, 0 * c
            elif load == 1:
                p, q, qt = 0 * c, c / 1j, -s
            else:
                p, q, qt = 0 * c, s / 1j, c
            both = {name: get[name][0] * p + get[name][1] * q for name in ("zz", "lz", "ll", "tt")}
            slz, stz, slt = 1j * both["lz"], get["tz"] * qt, 1j * get["lt"] * qt
            sll, stt = both["ll"], both["tt"]
            components.append([
                c * c * sll + s * s * stt - 2 * c * s * slt,
                s * s * sll + c * c * stt + 2 * c * s * slt,
                both["zz"],
                c * s * (sll - stt) + (c * c - s * s) * slt,
                c * slz - s * stz,
                s * slz + c * stz,
            ])
        for number, (x, y) in enumerate(offsets):
            phase = plane * np.exp(1j * kk[:, None] * (c * x + s * y))
            for load in range(3):
                for component in range(6):
                    result[number, load, component] += (components[load][component] * phase).sum().real
    return result


STACKS = [
    ([(2.0, 0.3, 1.0)], (1.0, 0.3)),
    ([(0.25, 0.2, 0.5)], (1.0, 0.4)),
    ([(10.0, 0.2, 0.5), (0.5, 0.45, 0.8)], (1.0, 0.3)),
    ([(100.0, 0.25, 0.4)], (1.0, 0.3)),
    ([(1.0, 0.3, 1.0), (3.0, 0.2, 0.6)], None),
]
OFFSETS = [(0, 0), (1, 0), (0, 1), (2, 1), (3, 7)]

rows = []
for layers, substrate in STACKS:
    tops = [0.0, *np.cumsum([h for _, _, h in layers])]
    points = [(0.3, 0), (tops[1], 0)]
    if len(layers) > 1 or substrate:
        points.append((tops[1], 1))
    points.append((tops[-1], len(layers) - 1) if not substrate else (tops[-1] + 1.5, len(layers)))
    for depth, layer in points:
        for sides in [(1.0, 1.0), (0.5, 1.5)]:
            offsets = [(i * sides[0], j * sides[1]) for i, j in OFFSETS]
            values = stresses(layers, substrate, depth, layer, sides, offsets)
            for (i, j), value in zip(OFFSETS, values):
                rows.append(dict(layers=layers, substrate=substrate, depth=depth, layer=layer, sides=sides, i=i, j=j,
                                 stress=[[float(f"{v:.15e}") for v in load] for load in value]))
            print(layers, substrate, depth, layer, sides, values[0, 0, :3])
with open("subsurface_cells.json", "w") as file:
    json.dump(dict(origin="subsurface_cells.py", rows=rows), file, indent=0)

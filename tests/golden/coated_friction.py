"""A rigid sphere pressed with friction on a coated half-space: axisymmetric, increment by increment.

Pressure and radial shear are linear between rings of equal width. Displacements at the rings: the coating's own half-space by
elliptic integrals (spence.py), what differs from it by the Hankel integral along the real axis with responses by mpmath
(radial_kernels.py). In every increment zones change until all laws hold: pressure and gap at least zero and one of both zero; where the
surfaces stick u_r stays; where they slip q = mu p against the slip. One dense system for every guess of the zones."""
import json
import pathlib

import mpmath as mp
import numpy as np
from radial_kernels import DIGITS, half_space, transformed
from scipy.special import j0, j1
from spence import W, X, matrices, running

POISSON, FRICTION, INCREMENTS = 0.3, 0.1, 100
MODULUS = 1 / (1 - POISSON**2)
FORCE = 4 / 3 * MODULUS
PEAK = 2 * MODULUS / np.pi
# coating over substrate, and the radius to which rings are laid: beyond that of the contact
BODIES = [(0.5, 1.26), (1.0, 1.05), (2.0, 0.87), (4.0, 0.71)]


def response(ratio):
    """Nodes, weights, and what k C_zz, k C_rr, k C_rz differ by from the coating's half-space; its two constants."""
    mp.mp.dps = DIGITS
    far = half_space(mp.mpf(ratio), mp.mpf(POISSON))
    x, w = np.polynomial.legendre.leggauss(16)
    edges = np.concatenate([[0.0], np.geomspace(1e-3, 1.0, 16), np.linspace(1.0, 22.0, 43)[1:]])
    low, high = edges[:-1, None], edges[1:, None]
    k, weight = ((low + high) / 2 + (high - low) / 2 * x).ravel(), ((high - low) / 2 * w).ravel()
    differences = []
    for one in k:
        zz, mean, half, rz = transformed(mp.mpf(one), [[ratio, POISSON, 1.0]], [1.0, POISSON])
        differences.append([float(zz - far[0]), float(mean + half - far[0]), float(rz - far[0] * far[1])])
    return k, weight, np.array(differences).T, float(far[0]), float(far[1])


def hats(nodes, k, bessel):
    """Int of every node's hat times bessel(k s) s ds."""
    result = np.zeros((len(nodes), len(k)))
    for n in range(len(nodes) - 1):
        low, high = nodes[n], nodes[n + 1]
        s = low + (high - low) * X
        wave = bessel(np.outer(s, k))
        weight = (W * (high - low) * s)[:, None]
        result[n] += np.sum(weight * (1 - X)[:, None] * wave, axis=0)
        result[n + 1] += np.sum(weight * X[:, None] * wave, axis=0)
    return result


def operator(nodes, ratio):
    """u_z and u_r by pressures and shears at the nodes: [[zz, zr], [rz, rr]]."""
    k, weight, (zz, rr, rz), c, g = response(ratio)
    normal, radial = matrices(nodes, nodes)
    within = running(nodes, 1)
    inward = np.zeros_like(within)
    inward[1:] = within[1:] / nodes[1:, None]
    sums = running(nodes, 0)
    beyond = sums[-1] - sums
    at0, at1 = j0(np.outer(nodes, k)), j1(np.outer(nodes, k))
    hat0, hat1 = hats(nodes, k, j0), hats(nodes, k, j1)
    return (
        c * normal + (at0 * (weight * zz)) @ hat0.T,
        -c * g * beyond - (at0 * (weight * rz)) @ hat1.T,
        -c * g * inward - (at1 * (weight * rz)) @ hat0.T,
        c * radial + (at1 * (weight * rr)) @ hat1.T,
    )


def pressed(nodes, ratio):
    """Pressures, shears and approach at the end."""
    zz, zr, rz, rr = operator(nodes, ratio)
    count = len(nodes)
    area = 2 * np.pi * running(nodes, 1)[-1]
    gap = nodes**2 / 2
    p, q, u = np.zeros(count), np.zeros(count), np.zeros(count)
    contact = nodes < 0.05 * nodes[-1]
    stick = contact & (nodes < 0.7 * nodes[contact][-1])
    for increment in range(1, INCREMENTS + 1):
        force = FORCE * (increment / INCREMENTS) ** 3
        for _ in range(400):
            inside = np.flatnonzero(contact)
            sticks = np.flatnonzero(stick & contact & (nodes > 0))
            slides = np.where(contact & ~stick & (nodes > 0), FRICTION, 0.0)
            n, m = len(inside), len(sticks)
            matrix, right = np.zeros((n + m + 1, n + m + 1)), np.zeros(n + m + 1)
            matrix[:n, :n] = zz[np.ix_(inside, inside)] + zr[np.ix_(inside, inside)] * slides[inside]
            matrix[:n, n:-1] = zr[np.ix_(inside, sticks)]
            matrix[:n, -1] = -1
            right[:n] = -gap[inside]
            matrix[n:-1, :n] = rz[np.ix_(sticks, inside)] + rr[np.ix_(sticks, inside)] * slides[inside]
            matrix[n:-1, n:-1] = rr[np.ix_(sticks, sticks)]
            right[n:-1] = u[sticks]
            matrix[-1, :n], right[-1] = area[inside], force
            # displacements and tractions of about one size
            solution = np.linalg.solve(matrix, right)
            p = np.zeros(count)
            p[inside] = solution[:n]
            q = slides * p
            q[sticks] = solution[n:-1]
            approach = solution[-1]
            open_ = zz @ p + zr @ q + gap - approach
            moved = rz @ p + rr @ q - u
            now_contact = np.where(contact, p > 0, open_ < 0)
            now_stick = np.where(stick, q < FRICTION * p, moved > 0) & now_contact
            if (now_contact == contact).all() and (now_stick == stick).all():
                break
            contact, stick = now_contact, now_stick
        else:
            raise RuntimeError(f"increment {increment}: zones do not settle")
        u = u + moved
    return p, q, approach


def main():
    rows = []
    for ratio, size in BODIES:
        found = []
        for rings in RINGS:
            nodes = np.linspace(0, size, rings + 1)
            p, q, approach = pressed(nodes, ratio)
            last = np.flatnonzero(p > 0)[-1]
            # p^2 falls in proportion to a^2 - r^2 at the edge
            near = slice(last - 6, last)
            slope, start = np.polyfit(nodes[near] ** 2, p[near] ** 2, 1)
            edge = np.sqrt(-start / slope)
            radii = np.arange(1, int(10 * (edge - 0.05)) + 1) / 10
            fields = [np.interp(radii, nodes, field) / PEAK for field in (p, q)]
            found.append((edge, approach, *fields))
        error = max(float(np.max(np.abs(a - b))) for a, b in zip(found[0][1:], found[1][1:]))
        edge, approach, pressure, shear = found[1]
        rows.append(dict(ratio=ratio, edge=round(float(edge), 4), approach=round(float(approach), 6), pressure=[round(float(v), 6) for v in pressure], shear=[round(float(v), 6) for v in shear], error=float(f"{error:.1e}")))
        print(rows[-1], flush=True)
    about = (
        "A rigid sphere pressed on a coated half-space with friction 0.1 in 100 increments of the contact radius: coating ratio times as "
        "stiff as the substrate, as thick as Hertz's contact radius a_H on the bare substrate, nu = 0.3 both. At r = 0.1, 0.2, ... a_H: "
        "pressure and outward shear on the lower body over Hertz's largest pressure; edge: contact radius over a_H; approach over "
        "Hertz's. error: largest difference of a solution with half the rings. Made by coated_friction.py."
    )
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"rows": [\n')
        file.write(",\n".join(json.dumps(row) for row in rows) + "\n]}\n")


RINGS = (90, 180)

if __name__ == "__main__":
    main()

"""A rigid flat punch and a rigid sphere pressed on a half-space with friction: sticking within c, slipping between c and a.

The punch loads every point in proportion, so its displacements hold as they are: u_z = 1 within a, no radial displacement within
c, q = mu p beyond (Spence 1968, Proc. R. Soc. A 305, 55). Pressure and shear are linear between rings graded towards 0, c and a;
displacements by elliptic integrals, coupled through

    u_r = ... - g/r Int_0^r p s ds,     u_z = ... - g Int_r^a q ds,     g = (1 - 2 nu)/(2 (1 - nu)).

The friction that belongs to c is the one with which shear goes on without a jump or a peak at c. A sphere is a punch that grows:
with f = force of the punch over the frictionless one and w(r) its displacement outside,
    approach = kappa a^2/R,  1/2 = kappa (1 - 2 Int_0^1 w(1/x) x dx),  force = f kappa times Hertz's,  peak = pi p(0) kappa a/a_H times his.
Three numbers of rings and Aitken's extrapolation; the error is the last difference."""
import json
import pathlib

import numpy as np
from scipy.special import ellipe, ellipk, ellipkm1

POINTS = 24
X, W = np.polynomial.legendre.leggauss(POINTS)
X, W = (X + 1) / 2, W / 2


def graded(low, high, count, power):
    """Nodes between low and high, finer at both ends."""
    s = np.linspace(0, 1, count + 1)
    t = s**power / (s**power + (1 - s) ** power)
    return low + (high - low) * t


def complement(small, large):
    """1 - (small/large)^2; points that rounding lays on the ring itself carry next to no weight."""
    return np.maximum((large - small) * (large + small) / large**2, 1e-30)


def normal_kernel(r, s):
    """Int J0(k r) J0(k s) dk."""
    small, large = np.minimum(r, s), np.maximum(r, s)
    return 2 / (np.pi * large) * ellipkm1(complement(small, large))


def radial_kernel(r, s):
    """Int J1(k r) J1(k s) dk."""
    small, large = np.minimum(r, s), np.maximum(r, s)
    m = (small / large) ** 2
    series = np.pi / 4 * m * (1 + m * (3 / 8 + m * (15 / 64 + m * 175 / 1024)))
    return 2 / (np.pi * small) * np.where(m < 1e-3, series, ellipkm1(complement(small, large)) - ellipe(m))


def matrices(nodes, places):
    """u_z of pressures and u_r of shears at the nodes, linear between them, at places; times r of the ring, over c0."""
    count = len(nodes)
    normal, radial = np.zeros((len(places), count)), np.zeros((len(places), count))
    for n in range(count - 1):
        low, high = nodes[n], nodes[n + 1]
        for i, place in enumerate(places):
            # towards an end at which the kernel is singular
            if place == low:
                t, w = X**4, 4 * X**3 * W
            elif place == high:
                t, w = 1 - X**4, 4 * X**3 * W
            else:
                t, w = X, W
            s = low + (high - low) * t
            if place == high:
                s = high - (high - low) * X**4
            weight = w * (high - low) * s
            for matrix, kernel in ((normal, normal_kernel), (radial, radial_kernel)):
                value = weight * kernel(max(place, 1e-300), s)
                matrix[i, n] += np.sum(value * (1 - t))
                matrix[i, n + 1] += np.sum(value * t)
    return normal, radial


def running(nodes, power):
    """Int_0^node f s^power ds of f linear between nodes."""
    count = len(nodes)
    matrix = np.zeros((count, count))
    for n in range(count - 1):
        low, high = nodes[n], nodes[n + 1]
        s = low + (high - low) * X
        weight = W * (high - low) * s**power
        matrix[n + 1 :, n] += np.sum(weight * (1 - X))
        matrix[n + 1 :, n + 1] += np.sum(weight * X)
    return matrix


class Punch:
    """Of radius 1, pressed in by 1, c0 = 1: so E* = 2."""

    def __init__(self, stick, count):
        inner, outer = graded(0, stick, count, 2), graded(stick, 1, count, 3)
        self.nodes = np.concatenate([inner, outer[1:]])
        self.border = count
        self.normal, self.radial = matrices(self.nodes[:-1], self.nodes[:-1])
        self.pressure_within = running(self.nodes[:-1], 1)
        self.shear_within = running(self.nodes[:-1], 0)
        # the last ring has the pressure of its inner edge
        last = self.nodes[-2:]
        s = last[0] + (last[1] - last[0]) * X**4
        w = 4 * X**3 * W * (last[1] - last[0])
        for i, place in enumerate(self.nodes[:-1]):
            self.normal[i, -1] += np.sum(w * s * normal_kernel(max(place, 1e-300), s))
            self.radial[i, -1] += np.sum(w * s * radial_kernel(max(place, 1e-300), s))
        self.last = last

    def solved(self, poisson):
        """Friction, and pressures at the nodes."""
        g = (1 - 2 * poisson) / (2 * (1 - poisson))
        count, border = len(self.nodes) - 1, self.border
        total = self.shear_within[-1].copy()
        total[-1] += self.last[1] - self.last[0]
        beyond = total - self.shear_within
        inward = np.zeros((count, count))
        inward[1:] = self.pressure_within[1:] / self.nodes[1:-1, None]

        def off(mu):
            # unknown: p at all nodes, q at the nodes between 0 and c
            free = slice(1, border)
            slips = np.zeros(count)
            slips[border:] = mu
            size = count + border - 1
            matrix, right = np.zeros((size, size)), np.zeros(size)
            matrix[:count, :count] = self.normal - g * beyond * slips
            matrix[:count, count:] = -g * beyond[:, free]
            right[:count] = 1
            matrix[count:, :count] = (self.radial * slips - g * inward)[free]
            matrix[count:, count:] = self.radial[free, free]
            solution = np.linalg.solve(matrix, right)
            p, q = solution[:count], mu * solution[:count] * (np.arange(count) >= border)
            q[free] = solution[count:]
            # what is left of the law of stick at the border
            return (self.radial @ q - g * inward @ p)[border], p

        before, here = 0.1, 0.3
        f_before, f_here = off(before)[0], off(here)[0]
        for _ in range(60):
            if f_here == f_before or abs(here - before) < 1e-14:
                break
            step = -f_here * (here - before) / (f_here - f_before)
            before, f_before, here = here, f_here, max(here + step, 0.3 * here)
            f_here = off(here)[0]
        return here, off(here)[1]

    def sphere(self, p):
        """f, radius, peak and approach over Hertz's, from the pressures of the punch."""
        nodes = self.nodes
        modulus = 2.0
        x, wx = 1 - X**3, 3 * X**2 * W
        force = deficit = 0.0
        for n in range(len(p)):
            low, high = nodes[n], nodes[n + 1]
            s = low + (high - low) * X
            value = p[n] + (p[min(n + 1, len(p) - 1)] - p[n]) * X
            ring = W * (high - low) * s * value
            force += 2 * np.pi * np.sum(ring)
            outside = 2 / np.pi * x * ellipk(np.outer(s, x) ** 2)
            deficit += np.sum(ring * (outside @ (wx * x)))
        f = force / (2 * modulus)
        kappa = 0.5 / (1 - 2 * deficit)
        radius = (f * kappa) ** (-1 / 3)
        return f, radius, np.pi * p[0] / modulus * kappa * radius, kappa * radius**2


def main():
    rows = []
    for poisson in (0.0, 0.2, 0.3, 0.4):
        for stick in (0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9):
            found = []
            for count in COUNTS:
                punch = Punch(stick, count)
                friction, p = punch.solved(poisson)
                found.append(np.array([friction, *punch.sphere(p)]))
            a, b, c = found
            limit = c - (c - b) ** 2 / (c - 2 * b + a)
            names = ("friction", "punch_force", "radius", "max_pressure", "approach")
            row = dict(poisson=poisson, stick=stick, **{n: round(float(v), 6) for n, v in zip(names, limit)}, error=float(f"{np.max(np.abs(limit - c)):.1e}"))
            rows.append(row)
            print(row, flush=True)
    about = (
        "A rigid indenter pressed on a half-space with friction: stick = c/a; friction that belongs to it; force of a flat punch over the "
        "frictionless one at the same approach; contact radius, pressure in the middle and approach of a sphere over Hertz's at the same "
        "force. error: difference of the extrapolated values from those of the most rings. Made by spence.py."
    )
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"rows": [\n')
        file.write(",\n".join(json.dumps(row) for row in rows) + "\n]}\n")


COUNTS = (20, 40, 80)

if __name__ == "__main__":
    main()

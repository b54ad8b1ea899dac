"""Normal influence coefficients zz of coated half-spaces from the own cell to 255 cells away, mpmath with 62 digits.

Z0(r) = Re of Int D(z/r) H_0(z) dz / (2 pi r) along a ray 10 degrees off the real axis, trapezoid in the logarithm of |z|;
D = k C_zz by transfer matrices exp(M k h) of the first-order system. What differs from the coating's own half-space is
interpolated in r^2 over each cell and integrated by Gauss points; the half-space itself by Love's closed form."""
import json
import pathlib

import mpmath as mp
from radial_kernels import half_space

# 25 of them remain where exp(2 k h) is largest
DIGITS = 62
CELLS = 256
OFFSETS = [(0, 0), (3, 2), (CELLS // 4, 0), (CELLS - 1, 0)]
ANGLE, STEP = mp.mpf(10) * mp.pi / 180, mp.mpf(1) / 40


def upwards(state, mu, a, b, g):
    """Derivative of (k U, k W, Q, P) towards the surface, over k."""
    u, w, q, p = state
    return [w + q / mu, g / mu * p - a * u, 4 * mu * b * u + a * p, -q]


def normal_response(k, layers, substrate):
    """k C_zz at a complex wavenumber."""
    c0, g, mu = substrate
    states = [[c0, c0 * g, mp.mpf(1), mp.mpf(0)], [c0 * g, c0, mp.mpf(0), mp.mpf(1)]]
    for (c0, g, mu), nu, h in reversed(layers):
        x = k * h
        if mp.re(x) > 40:
            states = [[c0, c0 * g, mp.mpf(1), mp.mpf(0)], [c0 * g, c0, mp.mpf(0), mp.mpf(1)]]
            continue
        a, b = nu / (1 - nu), 1 / (2 * (1 - nu))
        e = mp.exp(x)
        c, s = (e + 1 / e) / 2, (e - 1 / e) / 2
        lifted = []
        for state in states:
            # exp(M x) of a matrix whose eigenvalues are 1 and -1, both double
            one = upwards(state, mu, a, b, g)
            rest = [v - u for u, v in zip(state, upwards(one, mu, a, b, g))]
            last = upwards(rest, mu, a, b, g)
            lifted.append([
                c * state[n] + s * one[n] + x * s / 2 * rest[n] + (x * c - s) / 2 * last[n] for n in range(4)
            ])
        states = lifted
    one, two = states
    # the combination of both without shear
    return (one[1] * two[2] - two[1] * one[2]) / (one[3] * two[2] - two[3] * one[2])


def ray():
    turn = mp.expj(ANGLE)
    points = []
    first, last = int(-42 / STEP), int(mp.log(80 / mp.sin(ANGLE)) / STEP)
    for n in range(first, last + 1):
        z = mp.exp(n * STEP) * turn
        points.append((z, STEP * z * mp.hankel1(0, z)))
    return points


def remainder(r, layers, substrate, points):
    """Z0(r) minus that of the coating's half-space."""
    far = layers[0][0][0]
    total = mp.mpf(0)
    for z, weight in points:
        total += mp.re((normal_response(z / r, layers, substrate) - far) * weight)
    return total / (2 * mp.pi * r)


def love(i, j):
    """Integral of 1/r over the unit cell at (i, j)."""
    def corner(x, y):
        return x * mp.asinh(y / abs(x)) + y * mp.asinh(x / abs(y))
    x, y = [i + mp.mpf(1) / 2, i - mp.mpf(1) / 2], [j + mp.mpf(1) / 2, j - mp.mpf(1) / 2]
    return corner(x[0], y[0]) - corner(x[0], y[1]) - corner(x[1], y[0]) + corner(x[1], y[1])


def over_cell(i, j, function):
    """Integral over the unit cell at (i, j) of a function that is smooth in r^2, interpolated at Chebyshev nodes of r^2."""
    half = mp.mpf(1) / 2
    near = max(i - half, 0) ** 2 + max(j - half, 0) ** 2
    far = (i + half) ** 2 + (j + half) ** 2
    count = 20
    cosines = [mp.cos(mp.pi * (n + half) / count) for n in range(count)]
    values = [function(mp.sqrt((near + far) / 2 + (far - near) / 2 * u)) for u in cosines]
    coefficients = [
        mp.mpf(2 if m else 1) / count * sum(v * mp.cos(mp.pi * m * (n + half) / count) for n, v in enumerate(values))
        for m in range(count)
    ]

    def at(x, y):
        u = (2 * (x * x + y * y) - near - far) / (far - near)
        one, two = mp.mpf(0), mp.mpf(0)
        for value in reversed(coefficients[1:]):
            one, two = 2 * u * one - two + value, one
        return u * one - two + coefficients[0]

    rule = [(x, w) for x, w in mp.calculus.quadrature.GaussLegendre(mp.mp).calc_nodes(3, 220)]
    return sum(wx * wy / 4 * at(i + x / 2, j + y / 2) for x, wx in rule for y, wy in rule)


def main():
    mp.mp.dps = DIGITS
    points = ray()
    rows = []
    for young in (2.0, 100.0):
        for thickness in (1.0, 10.0):
            layers, substrate = [[young, 0.3, thickness]], [1.0, 0.3]
            below = half_space(*map(mp.mpf, substrate))
            constants = [(half_space(mp.mpf(e), mp.mpf(nu)), mp.mpf(nu), mp.mpf(h)) for e, nu, h in layers]
            coating = constants[0][0][0] / (2 * mp.pi)
            for i, j in OFFSETS:
                rest = over_cell(i, j, lambda r: remainder(r, constants, below, points))
                zz = coating * love(i, j) + rest
                rows.append(dict(layers=layers, substrate=substrate, i=i, j=j, zz=mp.nstr(zz, 17)))
                print(rows[-1], flush=True)
    about = ("Normal displacement zz at the centre of cell (i, j) by unit pressure on the unit square cell at the origin of a coated "
             "half-space; layers = [E, nu, thickness]. Made by normal_coefficients.py, 15 digits.")
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"rows": [\n')
        file.write(",\n".join(json.dumps(row) for row in rows) + "\n]}\n")


if __name__ == "__main__":
    main()

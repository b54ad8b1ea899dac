"""Influence coefficients, six components, in the regimes asked for: coatings 1e-3 to 1e4 cells thick, square cells and 1:10
cells both ways, offsets to 1000 cells. mpmath 1.4.1 and whole numbers of Python, no other package; some minutes of one core.

The way from the layers to the numbers shares one thought with the library, the ray in wavenumbers, and is held to the real axis:

1.  Response. In plane strain Airy's function of a layer is (a cosh s + b sinh s + c s cosh s + d s sinh s) exp(i k x), s = k z; of
    the half-space below, (a + b s) exp(-s). Tractions are f, f', displacements follow from Hooke's law; the conditions at the surface
    and at all interfaces are one system of linear equations, solved by elimination with DIGITS digits at complex k, 44 of which
    go where cosh is largest.
2.  Cells. A point force acts by J_n(k r), which are derivatives of J_0: what a cell answers is an integral along its edges of
        S_q(r) = 1/(2 pi) Int D_q(k) J_1(k r)/k dk,  q = Z0, A0, B2        F(r) = 1/(2 pi) Int D_Z1(k) J_0(k r)/k dk + constant
        zz = Int S_Z0 n.r/r ds      A, B = Int S (x/r) dy along the edges x = const  +, - the same along y      xx, yy = A -/+ B
        xy = 2 [Int S_B2 (y/r) dy]      zx = - [Int F dy]      zy = - [Int F dx]
    with the response D split as below; the own cell needs nothing of its own. Gauss points in tau, y = a sinh tau on an edge at the
    distance a, where everything is analytic for |Im tau| < pi/2.
3.  Transform. D = D(0), whose S is the constant D(0)/(2 pi) and F = -D(0)/(2 pi) log r (this is Love's and Cerruti's half-space),
    plus the layers' part, which begins like k: so its integral runs on a ray, with Hankel functions, and all that is singular at 0 is a
    simple pole. Trapezoid in log k; distances on the same lattice, in units of the coating's thickness, so that one table serves every
    thickness. Between lattice points Lagrange's polynomial of 34 points in log r.
    Without ray, lattice and interpolation: Gauss points on the real axis, at three distances, must agree to 1e-18.

Everything is done twice, with another angle, step, order of Gauss and interpolation: the last two numbers of a row are the largest
difference of the six, plus 1e-17 of zz for the digits printed, over zz of the own cell and over zz of the row. Values below it are 0."""
import json
import math
import pathlib
from operator import mul

import mpmath as mp

DIGITS = 90
BITS = 270
BESSEL_DIGITS = 60
# lattice of wavenumbers and distances, in units of the total thickness
LEAST_WAVENUMBER, LEAST_DISTANCE, LARGEST_DISTANCE = 1e-33, 4e-5, 2e7
SATURATED = 50

# name, layers (E, nu, share of the thickness), substrate
FAMILIES = [
    ("soft", [(0.1, 0.4, 1.0)], (1.0, 0.3)),
    ("stiff", [(10.0, 0.25, 1.0)], (1.0, 0.3)),
    ("hard", [(1e3, 0.3, 1.0)], (1.0, 0.45)),
    ("rigid base", [(1.0, 0.3, 1.0)], None),
    ("two layers", [(4.0, 0.25, 0.25), (0.2, 0.45, 0.75)], (1.0, 0.3)),
]
THICKNESSES = [1e-3, 0.1, 1.0, 30.0, 1e4]
SPACINGS = [(1.0, 1.0), (1.0, 10.0), (10.0, 1.0)]
DISTANCES = [1, 3, 10, 100, 1000]


def eliminate(rows, sides):
    """Unknowns of rows u = right side for two right sides; rows and right sides are spent."""
    count = len(rows)
    for n in range(count):
        pivot = max(range(n, count), key=lambda row: abs(rows[row][n]))
        rows[n], rows[pivot], sides[n], sides[pivot] = rows[pivot], rows[n], sides[pivot], sides[n]
        top = rows[n]
        filled = [m for m in range(n + 1, count) if top[m] != 0]
        for row in range(n + 1, count):
            if rows[row][n] != 0:
                factor = rows[row][n] / top[n]
                for m in filled:
                    rows[row][m] -= factor * top[m]
                sides[row] = [one - factor * other for one, other in zip(sides[row], sides[n])]
    for n in reversed(range(count)):
        for side in range(2):
            rest = sides[n][side]
            for m in range(n + 1, count):
                if rows[n][m] != 0:
                    rest -= rows[n][m] * sides[m][side]
            sides[n][side] = rest / rows[n][n]
    return sides


def state(material, derivatives):
    """P, Q, k U, k W of one term of Airy's function from its derivatives 0 to 3."""
    nu, shear = material
    f, f1, f2, f3 = derivatives
    return [f, f1, -((1 - nu) * f2 + nu * f) / (2 * shear), ((1 - nu) * f3 + (nu - 2) * f1) / (2 * shear)]


def layer_terms(s):
    e = mp.exp(s)
    c, h = (e + 1 / e) / 2, (e - 1 / e) / 2
    return [
        (c, h, c, h), (h, c, h, c),
        (s * c, c + s * h, 2 * h + s * c, 3 * c + s * h), (s * h, h + s * c, 2 * c + s * h, 3 * h + s * c),
    ]


BASE_TERMS = [(1, -1, 1, -1), (0, 1, -2, 3)]
TOP_TERMS = [(1, 0, 1, 0), (0, 1, 0, 1), (0, 1, 0, 3), (0, 0, 2, 0)]


def combined(factors, forms):
    return [sum(factor * form[n] for factor, form in zip(factors, forms)) for n in range(len(forms[0]))]


def half_space_response(material):
    """k C_zz, k C_rz, k C_rr, k C_tt."""
    p0, q0, u0, w0 = state(material, BASE_TERMS[0])
    p1, q1, u1, w1 = state(material, BASE_TERMS[1])
    # the first term plus the second is a unit of pressure alone, the second a unit of shear
    assert (p0 + p1, q0 + q1, p1, q1) == (1, 0, 0, 1)
    return w0 + w1, w1, u1, 1 / material[1]


def response(k, layers, substrate):
    """k times C_zz, (C_rr + C_tt)/2, (C_rr - C_tt)/2, C_rz; layers ((nu, shear modulus), thickness)."""
    stack = []
    for material, thickness in layers:
        if mp.re(k) * thickness > SATURATED:
            substrate = material
            break
        stack.append((material, k * thickness))
    if not stack:
        zz, rz, rr, across = half_space_response(substrate)
        return [zz, (rr + across) / 2, (rr - across) / 2, rz]

    # what is sought: c and d of every layer; a and b follow from the tractions f, f' on its top. A form is a list of factors
    # of these unknowns and, last, of P and Q at the surface
    count = 2 * len(stack)
    unit = [[mp.mpf(n == m) for m in range(count + 2)] for n in range(count + 2)]
    pressure, shear = unit[count], unit[count + 1]
    rows = []
    for at, (material, depth) in enumerate(stack):
        c, d = unit[2 * at], unit[2 * at + 1]
        amplitudes = [pressure, [q - one for q, one in zip(shear, c)], c, d]
        top = [combined([state(material, terms)[which] for terms in TOP_TERMS], amplitudes) for which in (2, 3)]
        if at == 0:
            surface = top
        else:
            rows += [[here - there for here, there in zip(*both)] for both in zip(top, displacements)]
        ends = [state(material, terms) for terms in layer_terms(depth)]
        pressure, shear, *displacements = [combined([end[which] for end in ends], amplitudes) for which in range(4)]
    if substrate:
        zz, rz, rr, _ = half_space_response(substrate)
        below = [combined([rz, rr], [pressure, shear]), combined([zz, rz], [pressure, shear])]
        rows += [[here - there for here, there in zip(*both)] for both in zip(below, displacements)]
    else:
        rows += displacements
    solution = eliminate([row[:count] for row in rows], [[-value for value in row[count:]] for row in rows])
    at_unit = [
        [row[count + side] + sum(row[n] * solution[n][side] for n in range(count)) for row in surface] for side in (0, 1)
    ]
    (_, zz), (rr, rz) = at_unit

    across = 1 / substrate[1] if substrate else mp.mpf(0)
    for (_, shear), depth in reversed(stack):
        e = mp.exp(depth)
        c, h = (e + 1 / e) / 2, (e - 1 / e) / 2
        across = (h + across * shear * c) / (c + across * shear * h) / shear
    return [zz, (rr + across) / 2, (rr - across) / 2, rz]


def hankel(z):
    """H_0 and H_1 of the first kind by their power series, with digits for what cancels in it."""
    mp.mp.dps = BESSEL_DIGITS + int(1.2 * abs(z))
    z = +z
    w, term, n = -z * z / 4, mp.mpc(1), 0
    # of (z/2)^2n: J_0 and 2/z J_1 and what digamma adds to Y_0 and Y_1
    j0 = j1 = y0 = y1 = mp.mpc(0)
    harmonic, least = mp.mpf(0), mp.mpf(10) ** -mp.mp.dps
    while abs(term) > least or n < 3:
        next_harmonic = harmonic + mp.mpf(1) / (n + 1)
        j0 += term
        y0 -= harmonic * term
        j1 += term / (n + 1)
        y1 += (harmonic + next_harmonic) * term / (n + 1)
        n, harmonic = n + 1, next_harmonic
        term *= w / (n * n)
    logarithm = mp.log(z / 2) + mp.euler
    zero = j0 + 2j / mp.pi * (logarithm * j0 + y0)
    one = z / 2 * j1 + 1j * (2 / mp.pi * logarithm * z / 2 * j1 - 2 / (mp.pi * z) - z / (2 * mp.pi) * y1)
    mp.mp.dps = BESSEL_DIGITS
    return +zero, +one


class Lattice:
    """Hankel functions on a ray, as whole numbers over 2^BITS: constants for all stacks."""

    def __init__(self, degrees, steps):
        self.step = mp.mpf(1) / steps
        self.angle = mp.pi * degrees / 180
        self.turn = mp.expj(self.angle)
        self.first = math.floor(math.log(LEAST_WAVENUMBER) * steps)
        self.saturated = math.ceil(math.log(SATURATED / math.cos(math.radians(degrees))) * steps) + 1
        self.radii = (math.floor(math.log(LEAST_DISTANCE) * steps) - 24, math.ceil(math.log(LARGEST_DISTANCE) * steps) + 24)
        self.last = math.ceil(math.log(70 / math.sin(math.radians(degrees))) * steps)
        self.origin = self.first + self.radii[0]
        mp.mp.dps = BESSEL_DIGITS
        one, zero = [], []
        for n in range(self.origin, self.last + 1):
            z = mp.exp(n * self.step) * self.turn
            for values, value in zip((zero, one), hankel(z)):
                values.append(value)
        mp.mp.dps = DIGITS
        self.weights = [whole(values) for values in (one, one, one, zero)]


def whole(values):
    return [[int(mp.ldexp(part(value), BITS)) for value in values] for part in (mp.re, mp.im)]


class Family:
    """S and F of a stack of unit thickness on the lattice of distances."""

    def __init__(self, lattice, layers, substrate):
        def material(young, nu):
            return mp.mpf(nu), mp.mpf(young) / (2 * (1 + mp.mpf(nu)))

        self.step, self.start = lattice.step, lattice.radii[0]
        layers = [(material(young, nu), mp.mpf(share)) for young, nu, share in layers]
        substrate = material(*substrate) if substrate else None
        self.zero = response(mp.mpf(0), [], substrate) if substrate else [mp.mpf(0)] * 4
        far = [one - other for one, other in zip(response(mp.mpf(0), [], layers[0][0]), self.zero)]
        saturated = lattice.saturated + math.ceil(-math.log(layers[0][1]) / lattice.step)
        found = [[], [], [], []]
        for m in range(lattice.first, saturated):
            values = response(mp.exp(m * lattice.step) * lattice.turn, layers, substrate)
            for lane in range(4):
                found[lane].append(values[lane] - self.zero[lane])
        longest = lattice.last - lattice.radii[0] + 1 - lattice.first
        self.stack = layers, substrate
        self.table = []
        for lane in range(4):
            # H_1 D/z has a pole at 0; between the axis and the ray lies this part of its residue
            least = mp.exp(lattice.first * lattice.step) * lattice.turn
            pole = 0 if lane == 3 else 2 * lattice.angle / mp.pi * mp.re(found[lane][0] / least)
            real, imaginary = whole(found[lane])
            rest = longest - len(real)
            real += [int(mp.ldexp(far[lane], BITS))] * rest
            imaginary += [0] * rest
            weight_real, weight_imaginary = lattice.weights[lane]
            row = []
            for n in range(*lattice.radii):
                begin = lattice.first + n - lattice.origin
                count = lattice.last - n - lattice.first + 1
                total = sum(map(mul, real[:count], weight_real[begin:])) - sum(map(mul, imaginary[:count], weight_imaginary[begin:]))
                sum_of_nodes = mp.ldexp(mp.mpf(total), -2 * BITS) * lattice.step
                row.append((sum_of_nodes + pole * mp.exp(-n * lattice.step)) / (2 * mp.pi))
            self.table.append(row)

    def at(self, r, thickness, points):
        """S of Z0, A0, B2 and F at a distance."""
        place = mp.log(r / thickness) / self.step - self.start
        low = int(mp.floor(place)) - points // 2 + 1
        t = place - low
        if t == int(t):
            weights, total = [mp.mpf(1) if n == int(t) else mp.mpf(0) for n in range(points)], mp.mpf(1)
        else:
            weights = [(-1) ** n * math.comb(points - 1, n) / (t - n) for n in range(points)]
            total = mp.fsum(weights)
        layered = [mp.fdot(weights, row[low:low + points]) / total for row in self.table]
        homogeneous = [1, 1, 1, -mp.log(r)]
        return [rest + zero * factor / (2 * mp.pi) for rest, zero, factor in zip(layered, self.zero, homogeneous)]


    def check(self):
        """S, and differences of F, against Gauss points on the real axis for what differs from the coating's half-space."""
        layers, substrate = self.stack
        far = response(mp.mpf(0), [], layers[0][0])
        edges = [mp.mpf(0)] + [mp.mpf(2) ** n for n in range(-14, 9)]
        distances = [mp.mpf(1) / 3, mp.mpf(1), mp.mpf(2)]
        totals = [[mp.mpf(0)] * 4 for _ in distances]
        for low, high in zip(edges, edges[1:]):
            for x, weight in gauss(40):
                k = (low + high) / 2 + (high - low) / 2 * x
                layered = [weight * (high - low) / 2 * (one - other) / k for one, other in zip(response(k, layers, substrate), far)]
                for total, r in zip(totals, distances):
                    j0, j1 = mp.besselj(0, k * r), mp.besselj(1, k * r)
                    for lane, bessel in enumerate((j1, j1, j1, j0 - mp.besselj(0, k))):
                        total[lane] += layered[lane] * bessel
        one = self.at(mp.mpf(1), mp.mpf(1), 34)
        worst = mp.mpf(0)
        for total, r in zip(totals, distances):
            found = self.at(r, mp.mpf(1), 34)
            found[3] -= one[3]
            expected = [(far[lane] + total[lane]) / (2 * mp.pi) for lane in range(3)]
            expected.append((total[3] - far[3] * mp.log(r)) / (2 * mp.pi))
            worst = max([worst] + [abs(a - b) / found[0] for a, b in zip(found, expected)])
        assert worst < mp.mpf(10) ** -18, worst
        return worst


RULES = {}


def gauss(n):
    if n not in RULES:
        points = []
        for i in range(1, n + 1):
            x = mp.cos(mp.pi * (i - mp.mpf(1) / 4) / (n + mp.mpf(1) / 2))
            for _ in range(7):
                before, value = mp.mpf(1), x
                for k in range(2, n + 1):
                    before, value = value, ((2 * k - 1) * x * value - (k - 1) * before) / k
                slope = n * (x * value - before) / (x * x - 1)
                x -= value / slope
            points.append((x, 2 / ((1 - x * x) * slope * slope)))
        RULES[n] = points
    return RULES[n]


def edge(kernels, a, low, high, setting):
    """Along the edge at the signed distance a, from low to high: Int S (a/r) ds of Z0, A0, B2, Int S_B2 (s/r) ds, Int F ds."""
    _, _, more, longest, points = setting
    near = abs(a)
    begin, end = mp.asinh(low / near), mp.asinh(high / near)
    pieces = int(mp.ceil((end - begin) / longest))
    half = (end - begin) / pieces / 2
    place = math.pi / 2 / float(half)
    count = math.ceil(26 * math.log(10) / (2 * math.asinh(place))) + more
    totals = [mp.mpf(0)] * 5
    for piece in range(pieces):
        middle = begin + (2 * piece + 1) * half
        for x, weight in gauss(count):
            tau = middle + half * x
            c, s = mp.cosh(tau), mp.sinh(tau)
            z0, a0, b2, f = kernels(near * c)
            for n, value in enumerate((a * z0, a * a0, a * b2, near * s * b2, near * c * f)):
                totals[n] += weight * half * value
    return totals


def coefficients(kernels, i, j, spacing, setting):
    """zz, xx, yy, xy, zx, zy at the offset (i, j)."""
    half = mp.mpf(1) / 2
    x, y = [[(n + side * half) * mp.mpf(d) for side in (-1, 1)] for n, d in zip((i, j), spacing)]
    (dx, dy) = [
        [after - before for before, after in zip(*(edge(kernels, at, *other, setting) for at in here))]
        for here, other in ((x, y), (y, x))
    ]
    a, b = dx[1] + dy[1], dy[2] - dx[2]
    return [dx[0] + dy[0], a - b, a + b, 2 * dx[3], -dx[4], -dy[4]]


def offsets(table):
    """The own cell and one offset along each axis and the diagonal; five tables make all of them."""
    x, y, both = [DISTANCES[(table + shift) % 5] for shift in (0, 2, 4)]
    return [(0, 0), (x, 0), (0, y), (both, both) if both < 1000 else (1000, 300)]


# degrees, steps per e-fold, Gauss points more, longest piece in tau, points of interpolation
SETTINGS = [(20, 26, 2, 1.0, 34), (16, 32, 6, 0.7, 40)]


def main():
    mp.mp.dps = DIGITS
    lattices = [Lattice(*setting[:2]) for setting in SETTINGS]
    print("Bessel functions made", flush=True)
    bodies, table = [], 0
    for name, shares, substrate in FAMILIES:
        mp.mp.dps = DIGITS
        families = [Family(lattice, shares, substrate) for lattice in lattices]
        print(name, "real axis:", mp.nstr(families[0].check(), 2), flush=True)
        mp.mp.dps = 40
        for thickness in THICKNESSES:
            # the thickness that the library sees: a sum of binary numbers
            layers = [[young, nu, share * thickness] for young, nu, share in shares]
            for spacing in SPACINGS:
                rows, own = [], None
                for i, j in offsets(table):
                    one, two = [
                        coefficients(lambda r: family.at(r, mp.mpf(thickness), setting[4]), i, j, spacing, setting)
                        for family, setting in zip(families, SETTINGS)
                    ]
                    if (i, j) == (0, 0):
                        own = one[0]
                    error = max(abs(a - b) for a, b in zip(one, two)) + abs(one[0]) * mp.mpf(10) ** -17
                    assert error < abs(one[0]) * mp.mpf(10) ** -12 + own * mp.mpf(10) ** -17, (name, thickness, spacing, i, j, one, two)
                    values = ["0" if abs(v) < error else mp.nstr(v, 18) for v in one]
                    rows.append([i, j] + values + [mp.nstr(error / own, 2), mp.nstr(error / abs(one[0]), 2)])
                bodies.append(dict(family=name, layers=layers, substrate=substrate, thickness=thickness, spacing=spacing, rows=rows))
                table += 1
        # another family, another choice
        table += 2
    about = (
        "Displacement at the centre of cell (i, j) by unit traction on the cell of the given spacing at the origin of a layered half-space; "
        "layers = [E, nu, thickness] from the surface down, substrate = [E, nu] or null (rigid). Each row: i, j, then zz, xx, yy, xy, zx, zy "
        "with 18 digits of the binary inputs, then the error (difference of two settings of the script, plus 1e-17 of zz) over zz of the own "
        "cell and over zz of the row; of exponentially small rows on a rigid base only these digits hold. Made by coefficient_regimes.py."
    )
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"bodies": [\n')
        texts = []
        for body in bodies:
            rows = body.pop("rows")
            lines = ",\n".join("[" + ", ".join(map(str, row)) + "]" for row in rows)
            texts.append(json.dumps(body)[:-1] + ', "rows": [\n' + lines + "\n]}")
        file.write(",\n".join(texts) + "\n]}\n")


if __name__ == "__main__":
    main()

"""Influence coefficients of line contacts (plane strain, antiplane): strips of unit width on layered half-spaces, relative to a
datum below the load. mpmath alone (with gmpy2 a few minutes, without a quarter of an hour).

Layers lie bonded on what is below them, or on springs (line_coefficients_interfaces.json, written by `line_coefficients.py interfaces`).

1.  Response. Airy's function of a layer is (a + b s) exp(-s) + (c + d s) exp(s - H), s = k z from its top, H = k h; of the base,
    (a + b s) exp(-s). Tractions and displacements at the surface, on both sides of every interface and at the base are one system of
    linear equations for all amplitudes, solved densely with DIGITS digits at complex k. The layer that holds the datum is cut there, so
    that the displacement of the datum is read off like that of the surface. Antiplane likewise.
2.  Coefficients, D = D(0) + E with E = O(k), strips from x - 1/2 to x + 1/2, T the datum's displacement times k:
        zz, xx, yy = [F(x + 1/2) - F(x - 1/2)],  F(x) = D(0) x (1 - log|x/d|)/pi + 1/pi Im Int E(k) (exp(i k x) - exp(-k x))/k^2 dk
                     - x/pi Int (T(k) - D(0) exp(-k d)) dk/k
        zx = D_rz(0)/2 + 1/pi Re Int E(k) (exp(i k (x - 1/2)) - exp(i k (x + 1/2)))/k^2 dk,  0 at offset 0
    The integrals with exp(i k x) run on a ray, where exp(-k x) contributes nothing of its own (its integral is real on the axis);
    trapezoid in log k.
3.  Judgement. Everything is done with two angles and steps; the largest difference over the largest of the own coefficients is the last number of a row. For
    one layer of thickness 1 the same coefficients by Gauss points on the real axis must agree to 1e-20."""
import json
import math
import pathlib
import sys

import mpmath as mp

DIGITS = 50
LEAST = 1e-24
DATUM_STEPS = 20
SETTINGS = [(20, 26), (13, 32)]
OFFSETS = [0, 1, 2, 7, 40, 300, 1000]

# name, [layers (E, nu, share of thickness), substrate] of the lower body, the same of the upper body or None
FAMILIES = [
    ("soft, 1e-4", ([(1e-4, 0.3, 1.0)], (1.0, 0.3)), None),
    ("soft, incompressible", ([(0.1, 0.5, 1.0)], (1.0, 0.25)), None),
    ("stiff", ([(10.0, 0.25, 1.0)], (1.0, 0.3)), None),
    ("stiff, 1e4", ([(1e4, 0.3, 1.0)], (1.0, 0.45)), None),
    ("nearly incompressible", ([(2.0, 0.49999, 1.0)], (1.0, 0.4999999)), None),
    ("rigid base", ([(1.0, 0.3, 1.0)], None), None),
    ("rigid base, incompressible", ([(1.0, 0.5, 1.0)], None), None),
    ("two layers", ([(4.0, 0.25, 0.25), (0.2, 0.45, 0.75)], (1.0, 0.3)), None),
    ("both coated", ([(4.0, 0.25, 1.0)], (1.0, 0.3)), ([(0.5, 0.4, 0.5)], (2.0, 0.2))),
    ("coated on a layer with a rigid base", ([(4.0, 0.25, 1.0)], (1.0, 0.3)), ([(0.5, 0.4, 0.5)], None)),
]
# the same with springs [normal, shear stiffness] below every layer of the lower body; 0: no shear passes, and zz alone has a meaning
ON_SPRINGS = [
    ("stiff on springs", ([(10.0, 0.25, 1.0)], (1.0, 0.3)), None, [(3.0, 0.2)]),
    ("soft on weak springs", ([(0.1, 0.5, 1.0)], (1.0, 0.25)), None, [(1e-3, 1e-4)]),
    ("rigid base on springs", ([(1.0, 0.3, 1.0)], None), None, [(0.5, 2.0)]),
    ("two layers, both on springs", ([(4.0, 0.25, 0.25), (0.2, 0.45, 0.75)], (1.0, 0.3)), None, [(1.0, 1e-2), (None, 0.3)]),
    ("both coated, one on springs", ([(4.0, 0.25, 1.0)], (1.0, 0.3)), ([(0.5, 0.4, 0.5)], (2.0, 0.2)), [(None, 0.05)]),
    ("slides freely", ([(4.0, 0.3, 1.0)], (1.0, 0.3)), None, [(None, 0)]),
]
THICKNESSES = [1e-3, 0.125, 1.0, 30.0, 1e4]
DATUMS = [512.0, 3.0]


def state(material, f, f1, f2, f3):
    """P, Q, k U, k W of Airy's function from its derivatives 0 to 3."""
    nu, shear = material
    return [f, f1, -((1 - nu) * f2 + nu * f) / (2 * shear), ((1 - nu) * f3 + (nu - 2) * f1) / (2 * shear)]


def terms(material, s, rest):
    """The four terms at s from the top and rest from the bottom of a layer."""
    down, up = mp.exp(-s), mp.exp(-rest)
    return [
        state(material, down, -down, down, -down),
        state(material, s * down, (1 - s) * down, (s - 2) * down, (3 - s) * down),
        state(material, up, up, up, up),
        state(material, s * up, (1 + s) * up, (s + 2) * up, (3 + s) * up),
    ]


def solve(rows, sides):
    """Gauss elimination with pivots; sides holds several right-hand sides per row."""
    count = len(rows)
    for n in range(count):
        pivot = max(range(n, count), key=lambda row: abs(rows[row][n]))
        rows[n], rows[pivot], sides[n], sides[pivot] = rows[pivot], rows[n], sides[pivot], sides[n]
        for row in range(n + 1, count):
            if rows[row][n] != 0:
                factor = rows[row][n] / rows[n][n]
                for m in range(n + 1, count):
                    if rows[n][m] != 0:
                        rows[row][m] -= factor * rows[n][m]
                sides[row] = [one - factor * other for one, other in zip(sides[row], sides[n])]
    for n in reversed(range(count)):
        for m in range(n + 1, count):
            if rows[n][m] != 0:
                sides[n] = [one - rows[n][m] * other for one, other in zip(sides[n], sides[m])]
        sides[n] = [one / rows[n][n] for one in sides[n]]
    return sides


def response(k, layers, base, at):
    """k C_zz, k C_rr, k C_tt, k C_rz at the top of layer `at` (the number of layers: of the base) per unit load at the surface."""
    stack = [(material, k * h) for material, h, _ in layers]
    # jump of displacement times k per traction at the springs below every layer
    jumps = [(k * shear, k * normal) for _, _, (normal, shear) in layers]
    count = 4 * len(stack) + (2 if base else 0)
    half = [(terms(base, mp.mpf(0), mp.mpf(0))[n]) for n in range(2)] if base else []
    rows = []
    tops = [terms(material, mp.mpf(0), depth) for material, depth in stack]
    bottoms = [terms(material, depth, mp.mpf(0)) for material, depth in stack]

    def row(entries):
        full = [mp.mpf(0)] * count
        for first, values in entries:
            full[first:first + len(values)] = values
        return full

    def column(found, which):
        return [term[which] for term in found]

    surface = tops[0] if stack else half
    sides = []
    for which in (0, 1):
        rows.append(row([(0, column(surface, which))]))
        sides.append([mp.mpf(which == 0), mp.mpf(which == 1)])
    for n in range(len(stack)):
        below = tops[n + 1] if n + 1 < len(stack) else half
        for which in range(4) if below else (2, 3):
            here = column(bottoms[n], which)
            there = [-value for value in column(below, which)] if below else []
            if which > 1:
                # k U less its jump by Q, k W less its jump by P
                traction = column(bottoms[n], 1 if which == 2 else 0)
                here = [value - jumps[n][which - 2] * one for value, one in zip(here, traction)]
            rows.append(row([(4 * n, here), (4 * n + 4, there)]))
            sides.append([mp.mpf(0), mp.mpf(0)])
    amplitudes = solve(rows, sides)
    seen = tops[at] if at < len(stack) else half

    def value(which, load):
        return sum(amplitudes[4 * at + n][load] * term[which] for n, term in enumerate(seen))

    # antiplane: u = a exp(-s) + b exp(s - H), traction q = -mu u'
    count = 2 * len(stack) + (1 if base else 0)

    def pair(material, s, rest):
        down, up = mp.exp(-s), mp.exp(-rest)
        return [(material[1] * down, down), (-material[1] * up, up)]

    half = pair(base, mp.mpf(0), mp.mpf(0))[:1] if base else []
    tops = [pair(material, mp.mpf(0), depth) for material, depth in stack]
    bottoms = [pair(material, depth, mp.mpf(0)) for material, depth in stack]
    rows, sides = [row([(0, column(tops[0] if stack else half, 0))])], [[mp.mpf(1)]]
    for n in range(len(stack)):
        below = tops[n + 1] if n + 1 < len(stack) else half
        for which in range(2) if below else (1,):
            here = column(bottoms[n], which)
            there = [-value for value in column(below, which)] if below else []
            if which == 1:
                here = [value - jumps[n][0] * one for value, one in zip(here, column(bottoms[n], 0))]
            rows.append(row([(2 * n, here), (2 * n + 2, there)]))
            sides.append([mp.mpf(0)])
    amplitudes_tt = solve(rows, sides)
    seen_tt = tops[at] if at < len(stack) else half
    tt = sum(amplitudes_tt[2 * at + n][0] * term[1] for n, term in enumerate(seen_tt))
    return [value(3, 0), value(2, 1), tt, value(2, 0)]


def opaque(layers, base, k):
    """Without what no wave reaches: 60 digits."""
    for n, (material, h, _) in enumerate(layers):
        if mp.re(k) * h > 140:
            return layers[:n], material
    return layers, base


def surface_response(k, body):
    layers, base = opaque(*body, k)
    return response(k, layers, base, 0)


def datum_response(k, body, depth):
    """The same three at the datum; nothing for a body on a rigid base."""
    layers, base = body
    if base is None:
        return [mp.mpf(0)] * 3
    cut, rest, at = [], depth, None
    for n, (material, h, jump) in enumerate(layers):
        if at is None and rest < h:
            cut += [(material, rest, BONDED), (material, h - rest, jump)]
            at = len(cut) - 1
        else:
            cut.append((material, h, jump))
            rest -= h if at is None else 0
    if at is None:
        cut.append((base, rest, BONDED))
        at = len(cut)
    if k * depth > 150:
        return [mp.mpf(0)] * 3
    if base is not None:
        # what lies far below the datum is not felt
        for n in range(at, len(cut)):
            if k * cut[n][1] > 140:
                cut, base = cut[:n], cut[n][0]
                break
    return response(k, cut, base, at)[:3]


BONDED = (mp.mpf(0), mp.mpf(0))
FREE = mp.mpf(10) ** 40


def compliances(springs):
    """Normal and shear jump of displacement per traction."""
    normal, shear = springs
    return (1 / mp.mpf(normal) if normal is not None else mp.mpf(0), mp.mpf(0) if shear is None else 1 / mp.mpf(shear) if shear else FREE)


def material(young, nu):
    return mp.mpf(nu), mp.mpf(young) / (2 * (1 + mp.mpf(nu)))


def bodies_of(family, thickness):
    found = []
    for body, sign in zip(family[1:3], (1, -1)):
        if body:
            layers, base = body
            jumps = [compliances(springs) for springs in family[3]] if sign == 1 and len(family) > 3 else [BONDED] * len(layers)
            stack = [(material(e, nu), mp.mpf(share * thickness), jump) for (e, nu, share), jump in zip(layers, jumps)]
            found.append((stack, material(*base) if base else None, sign))
    return found


def both(bodies, of):
    total = None
    for layers, base, sign in bodies:
        values = of((layers, base))
        values = [value * (sign if n == 3 else 1) for n, value in enumerate(values)]
        total = values if total is None else [a + b for a, b in zip(total, values)]
    return total


def lengths(bodies):
    found = [h for layers, _, _ in bodies for _, h, _ in layers]
    # what springs make with the stiffest material; a layer that slides freely adds none to zz
    stiffest = max(m[1] for layers, base, _ in bodies for m in [entry[0] for entry in layers] + ([base] if base else []))
    springs = [stiffest * jump for layers, _, _ in bodies for _, _, jumps in layers for jump in jumps if jump < FREE]
    return min(found), max(found + springs)


class Ray:
    def __init__(self, bodies, zero, degrees, steps):
        self.step = mp.mpf(1) / steps
        self.angle = mp.pi * degrees / 180
        self.turn = mp.expj(self.angle)
        least, longest = lengths(bodies)
        moduli = [m[1] for layers, base, _ in bodies for m in [entry[0] for entry in layers] + ([base] if base else [])]
        first = math.floor(mp.log(LEAST / (max(longest, 1000) * max(moduli) / min(moduli))) * steps)
        # the response is that of the coatings' half-spaces beyond
        last = math.ceil(mp.log(150 / least / mp.cos(self.angle)) * steps)
        self.nodes, self.rest = [], []
        for m in range(first, last + 1):
            k = mp.exp(m * self.step) * self.turn
            values = both(bodies, lambda body: surface_response(k, body))
            self.nodes.append(k)
            self.rest.append([a - b for a, b in zip(values, zero)])
        # beyond: constants, as far as exp(-k x) at x = 1/2 is there
        self.last = last
        while abs(self.nodes[-1]) < 300 / mp.sin(self.angle):
            self.last += 1
            self.nodes.append(mp.exp(self.last * self.step) * self.turn)
            self.rest.append(self.rest[-1])

    def coefficients(self, x):
        """The parts of E in zz, xx, yy, zx of the strip at x."""
        total = [mp.mpc(0)] * 4
        low, high = abs(x - mp.mpf(1) / 2), x + mp.mpf(1) / 2
        sign = -1 if x == 0 else 1
        limit = 120 / mp.sin(self.angle)
        for k, rest in zip(self.nodes, self.rest):
            if abs(k) * low > limit:
                break
            one, other = mp.exp(1j * k * high), mp.exp(1j * k * low)
            even = (one - mp.exp(-k * high)) - sign * (other - mp.exp(-k * low))
            for lane in range(3):
                total[lane] += rest[lane] * even / k
            total[3] += rest[3] * (other - one) / k
        scale = self.step / mp.pi
        return [scale * mp.im(total[lane]) for lane in range(3)] + [0 if x == 0 else scale * mp.re(total[3])]


def datum_integrals(bodies, zero, depth, steps):
    step = mp.mpf(1) / steps
    _, longest = lengths(bodies)
    moduli = [m[1] for layers, base, _ in bodies for m in [entry[0] for entry in layers] + ([base] if base else [])]
    first = math.floor(mp.log(LEAST / (max(longest, depth) * max(moduli) / min(moduli))) * steps)
    last = math.ceil(mp.log(120 / depth) * steps)
    total = [mp.mpf(0)] * 3
    for m in range(first, last + 1):
        k = mp.exp(m * step)
        values = both(bodies, lambda body: datum_response(k, body, depth))
        for lane in range(3):
            total[lane] += values[lane] - zero[lane] * mp.exp(-k * depth)
    return [step * value for value in total]


def table(bodies, depth, degrees, steps):
    zero = both(bodies, lambda body: response(mp.mpf(1), [], body[1], 0) if body[1] else [mp.mpf(0)] * 4)
    ray = Ray(bodies, zero, degrees, steps)

    def primitive(x, d):
        return x * (1 - mp.log(abs(x) / d))

    found = {}
    for d in depth:
        datum = datum_integrals(bodies, zero, d, DATUM_STEPS + steps // 8)
        for i in OFFSETS:
            x = mp.mpf(i)
            if i not in found:
                found[i] = ray.coefficients(x), {}
            layered = found[i][0]
            logarithm = primitive(x + mp.mpf(1) / 2, d) - primitive(x - mp.mpf(1) / 2, d)
            values = [zero[lane] * logarithm / mp.pi + layered[lane] - datum[lane] / mp.pi for lane in range(3)]
            values.append(0 if i == 0 else zero[3] / 2 + layered[3])
            found[i][1][d] = values
    return {d: [found[i][1][d] for i in OFFSETS] for d in depth}


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


def check():
    """Own coefficient and offset 2 of a layer of thickness 1 on the real axis: Gauss points for what differs from the coating's half-space,
    the coating's own part by the closed form, up to constants: differences of zz, xx, yy."""
    family = FAMILIES[2]
    bodies = bodies_of(family, 1.0)
    layers, base, _ = bodies[0]
    far = response(mp.mpf(1), [], layers[0][0], 0)
    rule = gauss(36)
    edges = [mp.mpf(0)] + [mp.mpf(2) ** (mp.mpf(n) / 2) for n in range(-60, 4)]
    edges += [edges[-1] + mp.mpf(n) / 2 for n in range(1, 130)]
    total = [mp.mpf(0)] * 4
    for low, high in zip(edges, edges[1:]):
        for point, weight in rule:
            k = (low + high) / 2 + (high - low) / 2 * point
            rest = [a - b for a, b in zip(response(k, layers, base, 0), far)]
            strip = 2 * mp.sin(k / 2) / k ** 2 * weight * (high - low) / 2 / mp.pi
            for lane in range(3):
                total[lane] += rest[lane] * strip * (1 - mp.cos(2 * k))
            total[3] += rest[3] * strip * mp.sin(2 * k)

    def primitive(x):
        return x * (1 - mp.log(abs(x)))

    logarithm = 2 * primitive(mp.mpf(1) / 2) - primitive(mp.mpf(5) / 2) + primitive(mp.mpf(3) / 2)
    expected = [far[lane] * logarithm / mp.pi + total[lane] for lane in range(3)] + [far[3] / 2 + total[3]]
    rows = table(bodies, [mp.mpf(3)], *SETTINGS[0])[mp.mpf(3)]
    found = [rows[0][lane] - rows[2][lane] for lane in range(3)] + [rows[2][3]]
    worst = max(abs(a - b) for a, b in zip(found, expected))
    assert worst < mp.mpf(10) ** -20, worst
    print("real axis:", mp.nstr(worst, 2), flush=True)


def main():
    mp.mp.dps = DIGITS
    on_springs = sys.argv[1:] == ["interfaces"]
    check()
    found = []
    for family in ON_SPRINGS if on_springs else FAMILIES:
        # jumps of FREE take 40 digits
        mp.mp.dps = DIGITS + (60 if family[0] == "slides freely" else 0)
        for thickness in THICKNESSES:
            bodies = bodies_of(family, thickness)
            depth = [mp.mpf(d) for d in DATUMS]
            one, two = [table(bodies, depth, *setting) for setting in SETTINGS]
            for d, datum in zip(depth, DATUMS):
                # the other coefficients of a layer that slides freely are those of its motion as a whole
                count = 1 if family[0] == "slides freely" else 4
                own = max(abs(value) for value in one[d][0][:count])
                rows = []
                for i, a, b in zip(OFFSETS, one[d], two[d]):
                    a, b = a[:count], b[:count]
                    error = max(abs(p - q) for p, q in zip(a, b)) / own
                    assert error < mp.mpf(10) ** -16, (family[0], thickness, datum, i, error)
                    rows.append([i] + [mp.nstr(value, 18) for value in a] + [mp.nstr(error, 2)])
                written = []
                for body in family[1:3]:
                    if body:
                        layers, base = body
                        written.append(dict(layers=[[e, nu, share * thickness] for e, nu, share in layers], substrate=base))
                    else:
                        written.append(None)
                if on_springs:
                    written[0]["interfaces"] = family[3]
                found.append(dict(family=family[0], lower=written[0], upper=written[1], datum=datum, rows=rows))
            print(family[0], thickness, "error", max(row[-1] for body in found[-2:] for row in body["rows"]), flush=True)
    about = (
        "Displacement of the middle of the strip at offset i by unit traction on the strip of unit width at 0, relative to the datum below the "
        "load; layers = [E, nu, thickness] from the surface down, substrate = [E, nu] or null (rigid base), upper = null (rigid body). Each "
        "row: i, then zz, xx, yy, zx with 18 digits of the binary inputs, then the difference of two settings of the script over the largest own coefficient. "
        "Made by line_coefficients.py."
    )
    name = "line_coefficients_interfaces.json" if on_springs else "line_coefficients.json"
    if on_springs:
        about += " interfaces: normal and shear stiffness below each layer of the lower body (null: bonded); where no shear passes (0), rows hold zz alone."
    with open(pathlib.Path(__file__).with_name(name), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"bodies": [\n')
        texts = []
        for body in found:
            rows = body.pop("rows")
            lines = ",\n".join("[" + ", ".join(map(str, row)) + "]" for row in rows)
            texts.append(json.dumps(body)[:-1] + ', "rows": [\n' + lines + "\n]}")
        file.write(",\n".join(texts) + "\n]}\n")


if __name__ == "__main__":
    main()

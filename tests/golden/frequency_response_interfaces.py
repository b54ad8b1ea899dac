"""Reference responses of seeded random stacks whose layers are bonded by springs, or slide freely: the solutions of the 4 x 4
first-order system of frequency_response_random.py carried upward in mpmath, with a jump of displacement by traction over stiffness at
every interface. Where no shear passes, two other solutions go on: free motion along the interface, and pressure without shear."""

import json
import pathlib
import random

import mpmath as mp

from frequency_response_random import system


def response(wavenumber, layers, interfaces, substrate):
    """zz, rr, rz, tt of layers (E, nu, h) with interfaces None (bonded) or (normal, shear stiffness; None: bonded, 0: free) below them."""
    total = sum(mp.mpf(wavenumber) * mp.mpf(h) for _, _, h in layers)
    mp.mp.dps = int(150 + 3 * float(total))
    k = mp.mpf(wavenumber)
    if substrate is None:
        y = mp.matrix([[0, 0], [0, 0], [1, 0], [0, 1]])
        v = mp.matrix([0, 1])
    else:
        young, nu = map(mp.mpf, substrate)
        mu = young / (2 * (1 + nu))
        c0 = (1 - nu) / mu
        g = (1 - 2 * nu) / (2 * (1 - nu))
        y = mp.matrix([[c0, c0 * g], [c0 * g, c0], [1, 0], [0, 1]])
        v = mp.matrix([1 / mu, 1])
    for (young, nu, h), interface in zip(reversed(layers), reversed(interfaces)):
        if interface is not None:
            normal, shear = interface
            if normal is not None:
                y[1, :] += k / mp.mpf(normal) * y[3, :]
            if shear == 0:
                # of both solutions the one without shear; and sliding alone
                one = y[:, 0] * y[2, 1] - y[:, 1] * y[2, 0]
                one[0] = 0
                y = mp.matrix(4, 2)
                y[:, 0] = mp.matrix([1, 0, 0, 0])
                y[:, 1] = one
                v = mp.matrix([1, 0])
            elif shear is not None:
                y[0, :] += k / mp.mpf(shear) * y[2, :]
                v[0] += k / mp.mpf(shear) * v[1]
        young, nu, h = map(mp.mpf, (young, nu, h))
        mu = young / (2 * (1 + nu))
        x = k * h
        m = system(nu, mu) * (-1)
        c, s = mp.cosh(x), mp.sinh(x)
        unit = mp.eye(4)
        y = (c * unit + s * m + (x * s / 2 * unit + (x * c - s) / 2 * m) * (m * m - unit)) * y
        v = mp.matrix([c * v[0] + s / mu * v[1], mu * s * v[0] + c * v[1]])
    w, t = y[0:2, 0:2], y[2:4, 0:2]
    compliance = w * t**-1
    size = mp.sqrt(abs(compliance[0, 0] * compliance[1, 1]))
    assert abs(compliance[0, 1] - compliance[1, 0]) < mp.mpf(10) ** -40 * size
    digits = lambda z: mp.nstr(z / k, 20, strip_zeros=False)
    return dict(
        zz=digits(compliance[1, 1]),
        rr=digits(compliance[0, 0]),
        rz=digits((compliance[0, 1] + compliance[1, 0]) / 2),
        tt=digits(v[0] / v[1]),
    )


def main():
    rng = random.Random(20261123)
    logu = lambda a, b: a * (b / a) ** rng.random()

    def poisson():
        return rng.choice([0.5, 0.25, -0.5, rng.uniform(-0.9, 0.5), rng.uniform(0, 0.5)])

    def springs(kind, young, h):
        own = young / h
        spring = lambda: own * logu(1e-8, 1e8)
        if kind == "springs":
            return [spring(), spring()]
        if kind == "shear spring":
            return [None, spring()]
        if kind == "normal spring":
            return [spring(), None]
        if kind == "frictionless":
            return [None, 0]
        return [spring(), 0]

    rows = []
    kinds = ["springs", "shear spring", "normal spring", "frictionless", "normal spring, free shear"]
    for rigid in (False, True):
        for count in (1, 3):
            for kind in kinds:
                for k in (1e-6, 1e-3, 0.1, 1.0, 5.0, 40.0):
                    layers = [[logu(1, 1e4), poisson(), logu(0.01, 1)] for _ in range(count)]
                    interfaces = [springs(kind, young, h) if rng.random() < 0.7 else None for young, _, h in layers]
                    chosen = rng.randrange(count)
                    interfaces[chosen] = springs(kind, layers[chosen][0], layers[chosen][2])
                    substrate = None if rigid else [logu(1, 1e4), poisson()]
                    case = f"{count} layers, {kind}, {'rigid base' if rigid else 'half-space'}"
                    rows.append(
                        dict(
                            case=case,
                            layers=layers,
                            interfaces=interfaces,
                            substrate=substrate,
                            k=k,
                            **response(k, layers, interfaces, substrate),
                        )
                    )
    about = (
        "Surface compliance of seeded random layered half-spaces with springs [normal, shear stiffness] below layers (null: bonded; "
        "shear 0: no shear passes), fields otherwise as in frequency_response_random.json. Made by frequency_response_interfaces.py: mpmath, transfer "
        "matrices of the first-order system with 150 digits and 3 more per unit of k h, jumps of displacement between them."
    )
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"rows": [\n')
        file.write(",\n".join(json.dumps(row) for row in rows) + "\n]}\n")


if __name__ == "__main__":
    main()

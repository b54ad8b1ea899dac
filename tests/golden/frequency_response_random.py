"""Reference responses of seeded random stacks: transfer matrices of the 4 x 4 first-order system by matrix exponentials in
mpmath, with enough digits for the growing exponentials; inputs are the binary values of the printed decimals."""
import json
import pathlib
import random

import mpmath as mp

def system(nu, mu):
    b = 1/(2*(1-nu)); g = (1-2*nu)*b; a = nu/(1-nu)
    # (w, t)' with w = (kU, kW), t = (Q, P) on the part below, s = k z
    return mp.matrix([[0, -1, -1/mu, 0], [a, 0, 0, -g/mu], [-4*mu*b, 0, 0, -a], [0, 0, 1, 0]])

def response(wavenumber, layers, substrate):
    total = sum(mp.mpf(wavenumber)*mp.mpf(h) for _, _, h in layers)
    mp.mp.dps = int(120 + 3*float(total))
    k = mp.mpf(wavenumber)
    if substrate is None:
        # columns: (w, t) at the base with w = 0
        y = mp.matrix([[0, 0], [0, 0], [1, 0], [0, 1]])
        v = mp.matrix([0, 1])  # out of plane (k u, q)
    else:
        E, nu = map(mp.mpf, substrate); mu = E/(2*(1+nu)); c0 = (1-nu)/mu; g = (1-2*nu)/(2*(1-nu))
        y = mp.matrix([[c0, c0*g], [c0*g, c0], [1, 0], [0, 1]])
        v = mp.matrix([1/mu, 1])
    for E, nu, h in reversed(layers):
        E, nu, h = map(mp.mpf, (E, nu, h)); mu = E/(2*(1+nu)); x = k*h
        M = system(nu, mu)*(-1)     # upward
        c, s = mp.cosh(x), mp.sinh(x); I = mp.eye(4)
        # double eigenvalues +-1
        T = c*I + s*M + (x*s/2*I + (x*c-s)/2*M)*(M*M-I)
        y = T*y
        v = mp.matrix([c*v[0] + s/mu*v[1], mu*s*v[0] + c*v[1]])
    w, t = y[0:2, 0:2], y[2:4, 0:2]
    C = w*t**-1
    assert abs(C[0, 1]-C[1, 0]) < mp.mpf(10)**-40*abs(C[0, 0])
    f = lambda z: mp.nstr(z/k, 20, strip_zeros=False)
    return dict(zz=f(C[1, 1]), rr=f(C[0, 0]), rz=f((C[0, 1]+C[1, 0])/2), tt=f(v[0]/v[1]))

rng = random.Random(20260730)
def poisson():
    u = rng.random()
    if u < .2: return .5
    if u < .3: return .5 - 10**rng.uniform(-12, -1)
    if u < .4: return -.9
    if u < .5: return .25
    return rng.uniform(-.9, .5)
def random_stack(count, contrast, rigid, thin=False, nu=None):
    logu = lambda a, b: a*(b/a)**rng.random()
    layers = [[logu(1, contrast), poisson() if nu is None else nu, logu(1e-3, 1)] for _ in range(count)]
    if thin:
        for i in range(1, count, 2): layers[i][2] = 1e-3
    total = sum(l[2] for l in layers)
    for l in layers: l[2] /= total
    return layers, (None if rigid else [logu(1, contrast), poisson() if nu is None else nu])
def main():
    rows = []
    def add(case, layers, substrate, k):
        rows.append(dict(case=case, layers=layers, substrate=substrate, k=k, **response(k, layers, substrate)))
    for rigid in (False, True):
        base = 'rigid base' if rigid else 'half-space'
        for k in (1e-8, 1e-4, 1e-2, .3, 2., 17., 130.):
            for contrast in (1e6, 1e12):
                for count in (1, 3, 7):
                    add(f'{count} layers within {contrast:g}, {base}', *random_stack(count, contrast, rigid), k)
            add(f'interlayers 1e-3 thick, {base}', *random_stack(5, 1e6, rigid, thin=True), k)
            add(f'incompressible, {base}', *random_stack(4, 1e2, rigid, nu=.5), k)
    about = ("Surface compliance of seeded random layered half-spaces, fields as in frequency_response.json. Inputs are binary values, "
             "printed as the shortest decimals that read back to them. Made by frequency_response_random.py: mpmath, transfer matrices "
             "exp(M k h) of the 4 x 4 first-order system with 120 digits and 3 more per unit of k h.")
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"rows": [\n')
        file.write(",\n".join(json.dumps(row) for row in rows) + "\n]}\n")


if __name__ == "__main__":
    main()

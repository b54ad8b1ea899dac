"""Formulas of contact and elasticity by quadrature, for `references.py`: none of them is the program's own."""

import math

import numpy as np


def elliptic(modulus: float) -> tuple[float, float]:
    """Return the complete elliptic integrals K and E of a modulus, by the arithmetic-geometric mean."""
    a, b, c, power, total = 1.0, math.sqrt(1 - modulus**2), modulus, 1.0, 0.5 * modulus**2
    for _ in range(9):  # converges quadratically
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        total += power * c**2
        power *= 2
    first = math.pi / (2 * a)
    return first, first * (1 - total)


def hertz_ellipse(radius_x: float, radius_y: float, force: float, modulus: float) -> dict[str, float | list[float]]:
    """Return approach, maximum contact pressure and semi-axes (x, y) of an ellipsoid on a half-space (Hertz 1881)."""
    low, high = sorted((1 / radius_x, 1 / radius_y))  # curvature along the long and the short axis
    inside, outside = 1e-9, 1 - 1e-12  # b/a
    for _ in range(200):
        ratio = (inside + outside) / 2
        e = math.sqrt(1 - ratio**2)
        first, second = elliptic(e)
        found = (second / ratio**2 - first) / (first - second)  # curvature across over curvature along
        inside, outside = (ratio, outside) if found > high / low else (inside, ratio)
    # low / 2 = (p0 / E*) b / (e^2 a^2) (K - E), P = 2 pi a b p0 / 3
    a = (3 * force / (2 * math.pi * modulus) * (first - second) / e**2 / (low / 2)) ** (1 / 3)
    b = ratio * a
    p0 = 3 * force / (2 * math.pi * a * b)
    axes = [a, b] if radius_x > radius_y else [b, a]
    return {"approach": p0 / modulus * b * first, "max_pressure": p0, "axes": axes}


def film_modulus(young: float, poisson: float) -> float:
    """Return the oedometric modulus."""
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


def mindlin_shift(force: float, mu: float, fraction: float, modulus: float) -> float:
    """Return the shift of two equal bodies of nu = 0, contact radius 1, pulled by this fraction of mu P (Cattaneo
    1938).
    """
    # tangential over normal compliance of nu = 0: 1; shift at full slip mu a^2/R = mu 3 P / (4 E* a)
    return 0.75 * mu * force / modulus * (1 - (1 - fraction) ** (2 / 3))


def loop_energy(force: float, mu: float, fraction: float, modulus: float) -> float:
    """Return the energy of a cycle between plus and minus this fraction of mu P, by Masing's rule and quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(200)
    pull = fraction * (nodes + 1) / 2  # from 0 to the amplitude on the first loading curve
    curve = np.array([mindlin_shift(force, mu, float(part), modulus) for part in pull])
    area = float((weights * curve).sum()) * fraction / 2 * mu * force  # integral of shift dT on the first loading
    peak = mindlin_shift(force, mu, fraction, modulus) * fraction * mu * force
    # Either branch of the loop is the first curve twice as large (Masing): between them lie 4 peaks less 8 areas.
    return 4 * peak - 8 * area


def sliding_sphere_stress(place: tuple[float, float, float], p0: float, mu: float, poisson: float) -> dict[str, float]:
    """Return the stresses under p0 sqrt(1 - r^2) and mu times it along x on the unit disc, tension positive.

    Point forces on a half-space (Boussinesq, Cerruti; Johnson 1985, 3.19 and 3.75), integrated over the disc with
    nodes that are dense below the place.
    """
    x, y, z = place
    nodes, weights = np.polynomial.legendre.leggauss(160)
    # r = sin(phi): p r dr = cos(phi)^2 sin(phi) dphi; uniform angles, a periodic integrand
    phi = (nodes + 1) * math.pi / 4
    angles = 2 * math.pi * (np.arange(320) + 0.5) / 320
    r, load = np.sin(phi), p0 * np.cos(phi) ** 2 * np.sin(phi) * weights * math.pi / 4 * (2 * math.pi / 320)
    dx = x - r[:, None] * np.cos(angles)
    dy = y - r[:, None] * np.sin(angles)
    force = np.repeat(load[:, None], len(angles), axis=1)
    rho = np.sqrt(dx**2 + dy**2 + z**2)
    s = 1 - 2 * poisson
    plane = dx**2 + dy**2
    # Boussinesq, force P along z into the body
    normal = {
        "xx": s / plane * ((1 - z / rho) * (dx**2 - dy**2) / plane + z * dy**2 / rho**3) - 3 * z * dx**2 / rho**5,
        "yy": s / plane * ((1 - z / rho) * (dy**2 - dx**2) / plane + z * dx**2 / rho**3) - 3 * z * dy**2 / rho**5,
        "zz": -3 * z**3 / rho**5,
        "xy": s / plane * ((1 - z / rho) * 2 * dx * dy / plane - dx * dy * z / rho**3) - 3 * dx * dy * z / rho**5,
        "xz": -3 * dx * z**2 / rho**5,
        "yz": -3 * dy * z**2 / rho**5,
    }
    far = rho + z
    # Cerruti, force Q along x
    third = 1 / rho**3
    shear = {
        "xx": -3 * dx**3 / rho**5
        + s * (dx * third - 3 * dx / (rho * far**2) + dx**3 * third / far**2 + 2 * dx**3 / (rho**2 * far**3)),
        "yy": -3 * dx * dy**2 / rho**5
        + s * (dx * third - dx / (rho * far**2) + dx * dy**2 * third / far**2 + 2 * dx * dy**2 / (rho**2 * far**3)),
        "zz": -3 * dx * z**2 / rho**5,
        "xy": -3 * dx**2 * dy / rho**5
        + s * (-dy / (rho * far**2) + dx**2 * dy * third / far**2 + 2 * dx**2 * dy / (rho**2 * far**3)),
        "yz": -3 * dx * dy * z / rho**5,
        "xz": -3 * dx**2 * z / rho**5,
    }
    return {name: float((force * (normal[name] + mu * shear[name])).sum()) / (2 * math.pi) for name in normal}

"""Draw the pictures of surfaces-and-friction.md: each with the solution on the left and its error on the right.

    python docs/draw_surfaces_and_friction.py [FOLDER]      (fretting, numpy, matplotlib)
"""

import json
import sys
from pathlib import Path

import fretting
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).parent
FOLDER = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "pictures"
GOLDEN = HERE.parent / "tests/golden"
MODULUS = 1 / 0.91
HALF_SPACE = {"substrate": {"young": 1.0, "poisson": 0.3}}
GRIDS = [24, 48, 96, 144]


def pressed(cells, size, profile, force, **more):
    """A rigid body pressed once on a half-space of E = 1, nu = 0.3."""
    case = {
        "grid": {"cells": list(cells), "size": list(size), "periodic": more.pop("periodic", False)},
        "upper": {"rigid": True},
        "lower": HALF_SPACE,
        "profile": profile,
        "load": [{"normal_force": force, "increments": 1}],
        "output": {"fields": ["pressure", "gap"]},
        **more,
    }
    return fretting.run(case)


def panels(title):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4), constrained_layout=True)
    figure.suptitle(title, fontsize=11)
    return figure, axes


def save(figure, name):
    figure.savefig(FOLDER / f"surface_{name}.png", dpi=80)
    plt.close(figure)
    print(name)


def field(axes, history, values, label, unit=1.0, cmap="viridis", limits=None):
    """A map over x and y; symmetric limits for signed fields."""
    x, y = history.x / unit, history.y / unit
    low, high = limits or (None, None)
    image = axes.imshow(
        values.T, origin="lower", extent=[x[0], x[-1], y[0], y[-1]], cmap=cmap, vmin=low, vmax=high, aspect="equal"
    )
    plt.colorbar(image, ax=axes, label=label, shrink=0.9)
    axes.set(xlabel="x", ylabel="y")


def errors(axes, counts, curves, label):
    for (name, values), mark in zip(curves.items(), "osv^", strict=False):
        axes.loglog(counts, np.abs(values), mark + "-", label=name, ms=4)
    counts = np.array(counts, float)
    top = max(abs(next(iter(curves.values()))[0]), 1e-12)
    axes.loglog(counts, top * (counts[0] / counts), "k:", lw=0.8, label="first and second order")
    axes.loglog(counts, top * (counts[0] / counts) ** 2, "k:", lw=0.8)
    axes.set(xlabel=label, ylabel="relative error")
    axes.set_xticks(counts, [f"{int(c)}" for c in counts])
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7)


def on_radii(function, r):
    """A function of the radius, computed once for each radius."""
    radii, place = np.unique(np.round(r, 12), return_inverse=True)
    return np.array([float(function(radius)) for radius in radii])[place].reshape(np.shape(r))


def round_shape(name, title, profile, force, approach, radius, pressure, *, area=True):
    """A shape of revolution: pressure along x with the closed form, and errors over four grids."""
    figure, (left, right) = panels(title)
    size = 2.4 * radius
    curves = {"approach": [], "pressure, rms over r < 0.9 a": []}
    if area:
        curves["contact radius"] = []
    for cells in GRIDS:
        history = pressed([cells] * 2, [size] * 2, profile, force)
        r = np.hypot(history.x[:, None], history.y[None, :])
        exact = on_radii(pressure, r)
        inside = (r < 0.9 * radius) & (r > 0.1 * radius)
        p = history.field("pressure")
        curves["approach"].append(history.steps["approach"][0] / approach - 1)
        curves["pressure, rms over r < 0.9 a"].append(
            np.sqrt(np.mean((p - exact)[inside] ** 2)) / (force / np.pi / radius**2)
        )
        if area:
            curves["contact radius"].append(np.sqrt(history.steps["contact_area"][0] / np.pi) / radius - 1)
        if cells == 48:
            middle = cells // 2
            x = np.linspace(-1.2 * radius, 1.2 * radius, 400)
            y = history.y[middle]
            left.plot(x, on_radii(pressure, np.hypot(x, y)), "k-", lw=0.9, label="closed form")
            left.plot(history.x, p[:, middle], "o", ms=3, label="48 x 48 cells")
            left.set(xlabel="x", ylabel="pressure / E", ylim=(0, 1.15 * p[:, middle].max()))
            left.legend(fontsize=7)
    errors(right, GRIDS, curves, "cells a side")
    save(figure, name)


NODES = np.polynomial.legendre.leggauss(60)


def gauss(f, lower, upper):
    t, w = NODES
    return (upper - lower) / 2 * np.sum(w * f((lower + upper) / 2 + (upper - lower) / 2 * t))


def rounded_punch():
    """Sneddon's solution for the gap (r - b)^2 / 2R beyond b, here with b = 0.6, a = 1, R = 30."""
    b, a, radius = 0.6, 1.0, 30.0
    rate = lambda t: (2 * np.sqrt(np.maximum(t**2 - b**2, 0)) - b * np.arccos(np.minimum(b / t, 1))) / radius  # noqa: E731
    force = 2 * MODULUS * gauss(lambda t: t * rate(t), b, a)
    approach = a / radius * (np.sqrt(a**2 - b**2) - b * np.arccos(b / a))

    def pressure(r):
        if r >= a:
            return 0.0
        low, high = np.sqrt(max(b**2 - r**2, 0)), np.sqrt(a**2 - r**2)
        return MODULUS / np.pi * gauss(lambda s: rate(np.hypot(r, s)) / np.hypot(r, s), low, high)

    profile = {"rounded_punch": {"flat_radius": b, "edge_radius": radius}}
    round_shape("rounded_punch", "Rounded punch: flat of 0.6 a", profile, force, approach, a, pressure)


def ellipsoid():
    figure, (left, right) = panels("Ellipsoid, radii 220 and 70")
    exact = fretting.analytic.hertz_ellipse(220.0, 70.0, 0.0147, MODULUS)
    a, b = exact.semi_axes
    curves = {"approach": [], "largest pressure": [], "contact area": []}
    for cells in GRIDS:
        history = pressed([cells] * 2, [2.3 * a, 2.3 * b], {"ellipsoid": {"radius_x": 220.0, "radius_y": 70.0}}, 0.0147)
        step = {key: values[0] for key, values in history.steps.items()}
        curves["approach"].append(step["approach"] / exact.approach - 1)
        curves["largest pressure"].append(step["max_pressure"] / exact.peak_pressure - 1)
        curves["contact area"].append(step["contact_area"] / (np.pi * a * b) - 1)
    field(left, history, history.field("pressure"), "pressure / E")
    angle = np.linspace(0, 2 * np.pi, 200)
    left.plot(a * np.cos(angle), b * np.sin(angle), "w--", lw=0.8)
    errors(right, GRIDS, curves, "cells a side")
    save(figure, "ellipsoid")


def row(x, a, radius, period):
    """Pressure under a row of cylinders at distances `period`, by the substitution s = tan(pi x / L)."""
    s, b = np.tan(np.pi * np.asarray(x) / period), np.tan(np.pi * a / period)
    t = b * np.cos(np.pi * (np.arange(400) + 0.5) / 400)
    s = np.clip(s, -b, b)[..., None]
    share = (np.arctan(t) - np.arctan(s)) / np.where(t == s, 1, t - s)
    return MODULUS * period / (2 * np.pi**2 * radius) * np.sqrt(np.maximum(b**2 - s[..., 0] ** 2, 0)) * np.pi / 400 * share.sum(-1)


def long_cylinder():
    figure, (left, right) = panels("Long cylinder: a row of cylinders, half-width 1, R = 50")
    a, radius = 1.0, 50.0
    curves = {}
    for period, mark in ((4.0, "o"), (16.0, "s")):
        angle = np.pi * (np.arange(4000) + 0.5) / 4000
        force = np.pi / 4000 * np.sum(row(a * np.cos(angle), a, radius, period) * a * np.sin(angle))
        values = []
        for cells in (64, 128, 256, 512):
            depth = 8 * period / cells
            profile = {"cylinder": {"radius": radius, "axis": "y"}}
            history = pressed([cells, 8], [period, depth], profile, force * depth, periodic=True)
            p = history.field("pressure")[:, 4]
            exact = row(history.x, a, radius, period) * (np.abs(history.x) < a)
            values.append(np.sqrt(np.sum((p - exact) ** 2) / np.sum(exact**2)))
        curves[f"period {period:g} a"] = values
        x = np.linspace(-a, a, 300)
        left.plot(x, row(x, a, radius, period), "k-", lw=0.8)
        left.plot(history.x[::8], p[::8], mark, ms=3, label=f"period {period:g} a")
    line = fretting.analytic.hertz_line(radius, np.pi * a**2 * MODULUS / (4 * radius), MODULUS)
    x = np.linspace(-a, a, 300)
    left.plot(x, line.peak_pressure * np.sqrt(1 - x**2), "r--", lw=0.8, label="one cylinder (Hertz)")
    left.set(xlabel="x", ylabel="pressure / E", xlim=(-1.5, 1.5))
    left.legend(fontsize=7)
    errors(right, [64, 128, 256, 512], curves, "cells a period")
    right.set_ylabel("pressure, rms over rms")
    save(figure, "long_cylinder")


def finite_cylinder():
    figure, (left, right) = panels("Finite cylinder with square ends, R = 50")
    lengths, off = [1.0, 2.0, 4.0, 8.0], []
    for length in lengths:
        ny = int(24 * length)
        history = pressed(
            [128, ny], [1.6, 1.1 * length], {"cylinder": {"radius": 50.0, "axis": "y", "length": length}}, 0.0025 * length
        )
        p = history.field("pressure")
        middle = p[:, ny // 2]
        line = fretting.analytic.hertz_line(50.0, middle.sum() * 1.6 / 128, MODULUS)
        off.append(middle.max() / line.peak_pressure - 1)
        if length == 2.0:
            field(left, history, p, "pressure / E", limits=(0, 2 * middle.max()))
    ratio = [length / line.half_width for length in lengths]
    right.loglog(ratio, np.abs(off), "o-", ms=4, label="middle against the plane solution under its own line force")
    right.loglog(ratio, abs(off[0]) * (ratio[0] / np.array(ratio)) ** 2, "k:", lw=0.8, label="square of half-width over length")
    right.set_xticks(ratio, [f"{value:.0f}" for value in ratio])
    right.minorticks_off()
    right.set(xlabel="length over half-width", ylabel="largest pressure, relative")
    right.legend(fontsize=7)
    right.grid(alpha=0.3)
    save(figure, "finite_cylinder")


def wave():
    figure, (left, right) = panels("Wave: Westergaard, half of the pressure of full contact")
    amplitude = 1e-3
    mean = 0.5 * np.pi * MODULUS * amplitude
    exact = fretting.analytic.westergaard(amplitude, 1.0, mean, MODULUS)
    values = {"pressure, rms of the largest": [], "contact share": []}
    for cells in (32, 64, 128, 256):
        history = pressed([cells, 4], [1.0, 4 / cells], {"wave": {"amplitude": amplitude, "wavelength_x": 1.0}}, mean * 4 / cells, periodic=True)
        p = history.field("pressure")[:, 0]
        q = exact.pressure(history.x)
        values["pressure, rms of the largest"].append(np.sqrt(np.mean((p - q) ** 2)) / q.max())
        values["contact share"].append(history.steps["contact_area"][0] / (4 / cells) / 0.5 - 1)
    left.plot(history.x, q, "k-", lw=0.8, label="closed form")
    left.plot(history.x[::6], p[::6], "o", ms=3, label="256 cells")
    left.set(xlabel="x / wavelength", ylabel="pressure / E")
    left.legend(fontsize=7)
    errors(right, [32, 64, 128, 256], values, "cells a wave")
    save(figure, "wave")


def rough():
    golden = json.loads((GOLDEN / "rough_contact.json").read_text())
    size = golden["size"]
    titles = {"ball": "Sphere and roughness, free space", "period": "Roughness that repeats"}
    for name, title in titles.items():
        scene = golden[name]
        force = scene["mean_pressure"] * size**2
        history = pressed(
            [40, 40], [size] * 2, {"heights": {"values": np.array(scene["heights"])}}, force, periodic=name == "period", solver={"tolerance": 1e-11}
        )
        figure, (left, right) = panels(title)
        p, q = history.field("pressure"), np.array(scene["pressure"])
        field(left, history, np.where(p > 0, p, np.nan), "pressure / E")
        off = np.abs(p - q) / q.max()
        field(right, history, np.log10(np.maximum(off, 1e-16)), "log10, off ContactMechanics", cmap="magma")
        save(figure, f"rough_{name}")


def crossed():
    figure, (left, right) = panels("Both bodies curved: crossed cylinders of 120 and 80")
    exact = fretting.analytic.hertz_ellipse(80.0, 120.0, 0.01, MODULUS)
    a, b = exact.semi_axes
    curves = {"approach": [], "largest pressure": [], "contact area": []}
    for cells in GRIDS:
        case = {
            "grid": {"cells": [cells] * 2, "size": [2.3 * a, 2.3 * b]},
            "upper": {"rigid": True, "profile": {"cylinder": {"radius": 120.0, "axis": "x"}}},
            "lower": {**HALF_SPACE, "profile": {"cylinder": {"radius": 80.0, "axis": "y"}}},
            "load": [{"normal_force": 0.01, "increments": 1}],
        }
        history = fretting.run(case)
        step = {key: values[0] for key, values in history.steps.items()}
        curves["approach"].append(step["approach"] / exact.approach - 1)
        curves["largest pressure"].append(step["max_pressure"] / exact.peak_pressure - 1)
        curves["contact area"].append(step["contact_area"] / (np.pi * a * b) - 1)
    field(left, history, history.field("pressure"), "pressure / E")
    angle = np.linspace(0, 2 * np.pi, 200)
    left.plot(a * np.cos(angle), b * np.sin(angle), "w--", lw=0.8)
    errors(right, GRIDS, curves, "cells a side")
    save(figure, "two_profiles")


def patches():
    golden = json.loads((GOLDEN / "two_patches.json").read_text())
    n, size = golden["cells"], golden["size"]
    titles = {"quarters": "Friction map: 0.5 and 0.05 by turns", "halves": "No friction where x < 0, 0.4 where x > 0"}
    for name, title in titles.items():
        scene = golden[name]
        case = {
            "grid": {"cells": [n, n], "size": [size, size]},
            "upper": {"rigid": True},
            "lower": HALF_SPACE,
            "profile": {"sphere": {"radius": 100.0}},
            "friction": {"map": np.array(scene["friction"]).reshape(n, n)},
            "solver": {"tolerance": 1e-10},
            "load": [{"approach": golden["approach"], "shift": [0.0, 0.0], "increments": 1}]
            + [{"shift": shift, "increments": 1} for shift in golden["shifts"]],
            "output": {"fields": ["pressure", "shear"], "every": 1},
        }
        history = fretting.run(case)
        figure, (left, right) = panels(title + ", moved along x and y")
        qx, qy = history.field("shear_x"), history.field("shear_y")
        last = scene["steps"][-1]
        expected = [np.array(last[key]).reshape(n, n) for key in ("shear_x", "shear_y")]
        largest = max(last["pressure"])
        field(left, history, np.hypot(qx, qy) / largest, "shear over the largest pressure")
        left.quiver(history.x, history.y, qx.T, qy.T, color="w", width=0.004)
        off = np.hypot(qx - expected[0], qy - expected[1]) / largest
        field(right, history, np.log10(np.maximum(off, 1e-17)), "log10, off the dense solution", cmap="magma")
        save(figure, f"friction_{name}")


def falling():
    figure, (left, right) = panels("Friction falls from 0.6 to 0.3 under a held force (equal bodies, nu = 0)")
    sphere = fretting.analytic.hertz(100.0, 4 / 300 / 2, 0.5)
    force = 4 / 300 / 2
    values = {"shear, rms": [], "shift": []}
    exact = {mu: fretting.analytic.cattaneo_mindlin(sphere, mu, 1 / 8, 0.2 * force) for mu in (0.6, 0.3)}
    body = {"substrate": {"young": 1.0, "poisson": 0.0}}
    for cells in (32, 64, 128):
        case = {
            "grid": {"cells": [cells] * 2, "size": [2.2, 2.2]},
            "upper": body,
            "lower": body,
            "profile": {"sphere": {"radius": 100.0}},
            "friction": {"coefficient": 0.6},
            "load": [
                {"normal_force": force, "increments": 1},
                {"tangential_force": [0.2 * force, 0.0], "increments": 2},
                {"friction": 0.3, "increments": 1},
            ],
            "output": {"fields": ["shear"], "every": 1},
        }
        history = fretting.run(case)
        r = np.hypot(history.x[:, None], history.y[None, :])
        q = history.field("shear_x")
        target = exact[0.3].shear(r)
        values["shear, rms"].append(np.sqrt(np.mean((q - target)[r < 1] ** 2)) / target.max())
        values["shift"].append(history.steps["shift_x"][-1] / exact[0.3].shift - 1)
    middle = len(history.y) // 2
    x = np.linspace(-1, 1, 400)
    for mu, step in ((0.6, 2), (0.3, 3)):
        left.plot(x, exact[mu].shear(np.abs(x)), "k-", lw=0.8)
        left.plot(history.x[::3], history.field("shear_x", step=step)[::3, middle], "o", ms=3, label=f"friction {mu}")
    left.set(xlabel="x", ylabel="shear / E")
    left.legend(fontsize=7)
    errors(right, [32, 64, 128], values, "cells a side")
    save(figure, "friction_falling")


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    ellipsoid()
    long_cylinder()
    finite_cylinder()
    rounded_punch()
    punch = fretting.analytic.flat_punch(1.0, 0.01, MODULUS)
    round_shape("flat_punch", "Flat punch", {"flat_punch": {"radius": 1.0}}, 0.01, punch.approach, 1.0, punch.pressure, area=False)
    cone = fretting.analytic.cone(0.01, np.pi * MODULUS * 0.005, MODULUS)
    round_shape("cone", "Cone, slope 0.01", {"cone": {"slope": 0.01}}, np.pi * MODULUS * 0.005, cone.approach, 1.0, cone.pressure)
    wave()
    rough()
    crossed()
    patches()
    falling()


main()

"""Whole runs against numbers that the program did not compute: closed forms and quadratures written here.

    python docs/data/reviews/references.py [NAME ...]

prints a table of the errors found, a line per number; with names, of these groups alone (see ``GROUPS``). Five minutes
on one core.
"""

import math
import sys
import warnings
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from elasticity import film_modulus, hertz_ellipse, loop_energy, mindlin_shift, sliding_sphere_stress

import fretting

Row = tuple[str, str]
STEEL = {"young": 1.0, "poisson": 0.3}
SMOOTH = {"young": 1.0, "poisson": 0.0}


def solved(**tables: Any) -> fretting.History:
    """Run a case whose warnings are what is measured."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fretting.FrettingWarning)
        return fretting.run(dict(tables))


def sphere(cells: int, body: dict[str, Any], load: list[dict[str, Any]], **more: Any) -> fretting.History:
    """Run a sphere of radius 100; two bodies of SMOOTH or a rigid sphere on a coated or bare one."""
    size = more.pop("size", 2.4)
    upper = more.pop("upper", {"rigid": True})
    grid = {"cells": [cells, cells], "size": [size, size]}
    return solved(grid=grid, upper=upper, lower=body, profile={"sphere": {"radius": 100.0}}, load=load, **more)


def force_of(radius: float, modulus: float) -> float:
    """Return the force whose Hertz contact under a sphere of radius 100 has this radius."""
    return 4 * modulus * radius**3 / 300


def signed(values: list[float]) -> str:
    """Return numbers as they stand in a table."""
    return " / ".join(f"{value:+.1e}" for value in values)


def ellipse() -> Iterator[Row]:
    """Radii 1:5."""
    exact = hertz_ellipse(20.0, 100.0, 1.0, 1 / (1 - 0.09))
    a, b = max(exact["axes"]), min(exact["axes"])
    found: dict[str, list[float]] = {"approach": [], "max_pressure": [], "area": []}
    for cells in (64, 128, 256):
        history = solved(
            grid={"cells": [cells, cells], "size": [2.5 * b, 2.5 * a]},
            upper={"rigid": True},
            lower={"substrate": STEEL},
            profile={"ellipsoid": {"radius_x": 20.0, "radius_y": 100.0}},
            load=[{"normal_force": 1.0, "increments": 1}],
        )
        steps = history.increments
        found["approach"].append(float(steps["approach"][-1]) / exact["approach"] - 1)
        found["max_pressure"].append(float(steps["max_pressure"][-1]) / exact["max_pressure"] - 1)
        found["area"].append(float(steps["contact_area"][-1]) / (math.pi * a * b) - 1)
    for name, errors in found.items():
        yield f"Hertz ellipse, radii 1:5, 64 / 128 / 256 cells: {name}", signed(errors)


def slider() -> Iterator[Row]:
    """Sphere that slides, mu = 0.25: all stresses at 70 places of both bodies, and the tension at the rim."""
    for cells in (64, 128):
        worst, body = 0.0, {"substrate": STEEL}
        modulus = 0.5 / (1 - 0.09)
        force = force_of(1.0, modulus)
        history = sphere(
            cells,
            body,
            [{"normal_force": force, "increments": 1}, {"shift": [1.0, 0.0], "increments": 1}],
            upper=body,
            friction={"coefficient": 0.25},
            size=2.5,
        )
        p0 = 1.5 * force / math.pi
        depths = [0.15, 0.3, 0.45, 0.6, 0.9, 1.5, 2.0]
        for which, sign in (("lower", 1.0), ("upper", -1.0)):
            below = history.subsurface(depths, body=which)
            for level, depth in enumerate(depths):
                for i, j in [(0.9, 0.5), (0.5, 0.5), (0.7, 0.6), (0.25, 0.4), (0.1, 0.9)]:
                    x, y = (int(fraction * cells) for fraction in (i, j))
                    there = float(below.x[x]), float(below.y[y]), depth
                    exact = sliding_sphere_stress(there, p0, sign * 0.25, 0.3)
                    for name, value in exact.items():
                        worst = max(worst, abs(float(below[name][level, y, x]) - value) / p0)
        yield f"sliding sphere, mu = 0.25, nu = 0.3, six stresses at 70 places, {cells} cells: worst", f"{worst:.1e} p0"
        at = history.subsurface(np.linspace(0.40, 0.48, 9)).von_mises / p0
        yield f"the same: largest von Mises (0.64759 p0), {cells} cells", f"{float(at.max()) - 0.64759:+.1e} p0"


def loops() -> Iterator[Row]:
    """Energy of a cycle and the shift at its peak, two bodies of nu = 0."""
    for increments in (8, 40):
        energies, shifts = [], []
        for fraction in (0.3, 0.6, 0.9):
            force, mu = force_of(1.0, 0.5), 0.3
            pull = {"tangential_force": [fraction * mu * force, 0.0], "increments": increments, "cycles": 2}
            history = sphere(
                96,
                {"substrate": SMOOTH},
                [{"normal_force": force, "increments": 1}, pull],
                upper={"substrate": SMOOTH},
                friction={"coefficient": mu},
            )
            energies.append(float(history.cycles["dissipated_energy"][1]) / loop_energy(force, mu, fraction, 0.5) - 1)
            peak = float(np.max(history.increments["shift_x"]))
            shifts.append(peak / mindlin_shift(force, mu, fraction, 0.5) - 1)
        yield f"energy of a cycle, nu = 0, T = .3 / .6 / .9 mu P, {increments} increments", signed(energies)
        yield f"shift at its peak, {increments} increments", signed(shifts)


def ray() -> Iterator[Row]:
    """T and P grow together below the limit: no slip, and shear that is a multiple of the pressure."""
    shifts, energies = [], []
    for increments in (8, 32, 128):
        force, mu = force_of(1.0, 0.5), 0.3
        stage = {
            "normal_force": force,
            "tangential_force": [0.6 * mu * force, 0.0],
            "increments": increments,
            "ramp": "cubic",
        }
        history = sphere(64, {"substrate": SMOOTH}, [stage], upper={"substrate": SMOOTH}, friction={"coefficient": mu})
        last = {name: float(history.increments[name][-1]) for name in ("shift_x", "approach", "dissipated_energy")}
        shifts.append(last["shift_x"] / (0.6 * mu * last["approach"]) - 1)
        energies.append(last["dissipated_energy"] / (mu * force * last["shift_x"]))
    yield "T = .6 mu P from nothing, 8 / 32 / 128 cubic increments: shift", signed(shifts)
    yield "the same: energy over mu P times shift (0)", signed(energies)


def torsion() -> Iterator[Row]:
    """Twist up to 0.95 of the full-slip moment (Lubkin's integral, in the library's closed forms)."""
    force, mu = force_of(1.0, 0.5), 0.3
    full = 3 * math.pi * mu * force / 16
    hertz = fretting.analytic.hertz(radius=100.0, force=force, modulus=0.5)
    errors = []
    for fraction in (0.3, 0.7, 0.95):
        stages = [{"normal_force": force, "increments": 1}, {"twist_moment": fraction * full, "increments": 8}]
        history = sphere(96, {"substrate": SMOOTH}, stages, upper={"substrate": SMOOTH}, friction={"coefficient": mu})
        exact = fretting.analytic.torsion(hertz, friction_coefficient=mu, shear_modulus=0.25, moment=fraction * full)
        errors.append(float(history.increments["twist"][-1]) / exact.twist - 1)
    yield "torsion, .3 / .7 / .95 of full slip, 96 cells: twist", signed(errors)


def no_slip() -> Iterator[Row]:
    """Flat punch and sphere that stick: (1 - nu) ln(3 - 4 nu) / (1 - 2 nu) over the frictionless."""
    errors = []
    for poisson in (0.0, 0.3, 0.45):
        approaches = []
        for friction in ({"friction": {"coefficient": 50.0}}, {}):
            history = solved(
                grid={"cells": [128, 128], "size": [2.2, 2.2]},
                upper={"rigid": True},
                lower={"substrate": {"young": 1.0, "poisson": poisson}},
                profile={"flat_punch": {"radius": 1.0}},
                load=[{"normal_force": 1.0, "increments": 1}],
                **friction,
            )
            approaches.append(float(history.increments["approach"][-1]))
        ratio = (1 - poisson) * math.log(3 - 4 * poisson) / (1 - 2 * poisson)
        errors.append(approaches[1] / approaches[0] / ratio - 1)
    yield "punch that sticks, nu = 0 / .3 / .45, 128 cells: stiffness over the frictionless one", signed(errors)
    for poisson in (0.0, 0.3):
        errors = []
        modulus = 1 / (1 - poisson**2)
        coupling = 0.5 * (1 - 2 * poisson) / (1 - poisson)
        force = force_of(1.0, modulus)
        exact = fretting.analytic.no_slip_sphere(radius=100.0, force=force, modulus=modulus, coupling=coupling)
        for increments in (20, 40):
            body = {"substrate": {"young": 1.0, "poisson": poisson}}
            stages = [{"normal_force": force, "increments": increments}]
            history = sphere(48, body, stages, friction={"coefficient": 50.0})
            errors.append(float(history.increments["approach"][-1]) / exact.approach - 1)
        yield f"sphere that sticks, nu = {poisson:g}, 20 / 40 increments, 48 cells: approach", signed(errors)


def films() -> Iterator[Row]:
    """Thin compressible films on a rigid base: pressure and approach of a foundation, and the area between the cells
    (D4).
    """
    approaches, areas = [], []
    for thickness in (0.1, 0.03, 0.01, 0.003):
        modulus = film_modulus(1.0, 0.3) / thickness
        force = math.pi * modulus / 400  # contact radius 1: d = 1/200, integral of p
        body = {"coatings": [{"thickness": thickness, **STEEL}], "base": "rigid"}
        history = sphere(96, body, [{"normal_force": force, "increments": 1}])
        approaches.append(float(history.increments["approach"][-1]) * 200 - 1)
        areas.append((math.sqrt(float(history.increments["contact_area"][-1]) / math.pi) - 1) * 96 / 2.4)
    yield (
        "compressible film on a rigid base, h/a = .1 / .03 / .01 / .003: approach against a foundation",
        signed(approaches),
    )
    yield "the same: radius against a foundation, in cells", signed(areas)
    errors = []
    for thickness in (30.0, 300.0):
        force = force_of(1.0, 1 / 0.91)
        coating = {"thickness": thickness, "young": 1.0, "poisson": 0.3 + 1e-11}  # not left out
        body = {"coatings": [coating], "substrate": STEEL}
        history = sphere(64, body, [{"normal_force": force, "increments": 1}])
        errors.append(float(history.increments["approach"][-1]) * 100 - 1)
    yield (
        "coating of the substrate's own material, 30 and 300 a thick: approach against Hertz (64 cells)",
        signed(errors),
    )


def wear() -> Iterator[Row]:
    """Archard in gross slip."""
    force, mu, rate = force_of(1.0, 0.5), 0.3, 1e-3
    history = sphere(
        64,
        {"substrate": SMOOTH},
        [{"normal_force": force, "increments": 1}, {"shift": [0.02, 0.0], "cycles": 2, "increments": 16}],
        upper={"substrate": SMOOTH},
        friction={"coefficient": mu},
        wear={"coefficient": rate},
    )
    volume = float(history.increments["worn_volume"][-1])
    energy = float(history.cycles["total_dissipated_energy"][-1])
    yield "worn volume over wear coefficient times dissipated energy", f"{volume / (rate * energy) - 1:+.1e}"


def waves() -> Iterator[Row]:
    """Waves in two directions: the pressure of full contact, and light loads against Hertz."""
    errors = []
    for cells in (32, 64, 128):
        body = {"substrate": STEEL}
        shape = {"wave": {"amplitude": 0.01, "wavelength_x": 1.0, "wavelength_y": 1.0}}
        full = math.sqrt(2) * math.pi / 0.91 * 0.01
        history = solved(
            grid={"cells": [cells, cells], "size": [1.0, 1.0], "periodic": True},
            upper={"rigid": True},
            lower=body,
            profile=shape,
            load=[{"normal_force": 1.2 * full, "increments": 1}],
            output={"fields": ["pressure"]},
        )
        pressure = history.field("pressure")
        errors.append((float(pressure.max() - pressure.min()) / 2) / full - 1)
    yield "wave in two directions, 32 / 64 / 128 cells: amplitude of the pressure of full contact", signed(errors)


def uniform() -> Iterator[Row]:
    """Periodic layers on a rigid base give way to uniform tractions (D2)."""
    film = {"coatings": [{"thickness": 0.1, **STEEL}], "base": "rigid"}
    flat = {"wave": {"amplitude": 1e-6, "wavelength_x": 1.0, "wavelength_y": 1.0}}
    grid = {"cells": [32, 32], "size": [1.0, 1.0], "periodic": True}
    stages = [{"normal_force": 1e-2, "increments": 1}, {"tangential_force": [1e-3, 0.0], "increments": 1}]
    history = solved(
        grid=grid, upper={"rigid": True}, lower=film, profile=flat, friction={"coefficient": 0.9}, load=stages
    )
    approach = float(history.increments["approach"][-1]) - 1e-6
    shift = float(history.increments["shift_x"][-1])
    yield (
        "periodic film on a rigid base: approach by mean pressure, h/E_oed",
        f"{approach / (1e-2 * 0.1 / film_modulus(1.0, 0.3)) - 1:+.1e}",
    )
    yield "the same: shift by mean shear, h/G", f"{shift / (1e-3 * 0.1 * 2.6) - 1:+.1e}"


def similar() -> Iterator[Row]:
    """Jaeger and Ciavarella on a rough surface: shear is the difference of two pressures."""
    numbers = np.random.default_rng(7)
    waves_ = np.fft.fft2(numbers.standard_normal((64, 64)))
    k = np.hypot(*np.meshgrid(np.fft.fftfreq(64), np.fft.fftfreq(64), indexing="ij"))
    heights = np.fft.ifft2(waves_ * np.where(k > 0, 1 / np.maximum(k, 1 / 64) ** 1.8, 0) * (k < 0.2)).real * 1e-4
    mu, force, pull = 0.3, 2e-3, 0.5
    for periodic in (True, False):
        size = {"cells": [64, 64], "size": [1.0, 1.0], "periodic": periodic}
        x = (np.arange(64) + 0.5) / 64 - 0.5
        gap = heights if periodic else heights + (x[:, None] ** 2 + x[None, :] ** 2) * 0.5
        tables = {
            "grid": size,
            "upper": {"substrate": SMOOTH},
            "lower": {"substrate": SMOOTH},
            "profile": {"heights": {"values": gap, "of": "gap"}},
            "friction": {"coefficient": mu},
            "solver": {"tolerance": 1e-11},
        }
        rubbed = solved(
            load=[
                {"normal_force": force, "increments": 1},
                {"tangential_force": [pull * mu * force, 0.0], "increments": 1},
            ],
            **tables,
        )
        less = solved(load=[{"normal_force": force * (1 - pull), "increments": 1}], **tables)
        pressure = rubbed.field("pressure", 0 if len(rubbed) == 2 else 1)
        expected = mu * (pressure - less.field("pressure"))
        error = float(np.abs(rubbed.field("shear_x") - expected).max() / (mu * pressure.max()))
        yield (
            f"rough {'periodic' if periodic else 'free'} contact, nu = 0: shear against mu (p(P) - p(P - T/mu))",
            f"{error:.1e} mu p_max",
        )


GROUPS: dict[str, Callable[[], Iterator[Row]]] = {
    "ellipse": ellipse,
    "slider": slider,
    "loops": loops,
    "ray": ray,
    "torsion": torsion,
    "no_slip": no_slip,
    "films": films,
    "wear": wear,
    "waves": waves,
    "uniform": uniform,
    "similar": similar,
}

if __name__ == "__main__":
    print("| what | error |\n|---|---|")
    for name in sys.argv[1:] or GROUPS:
        for what, error in GROUPS[name]():
            print(f"| {what} | {error} |", flush=True)

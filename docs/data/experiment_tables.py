"""The tables of the page Comparison with experiments: heads and rows from ``docs/data/experiments.json``."""

import math
from typing import Any

Measured = dict[str, Any]
Table = tuple[list[str], list[list[str]]]


def percent(value: float) -> str:
    """Return a fraction as percent with its sign, one decimal below ten."""
    return f"{100 * value:+.0f} %" if abs(value) >= 0.095 else f"{100 * value:+.1f} %"


def signed(value: float, digits: int = 3) -> str:
    """Return a difference with its sign."""
    return f"{value:+.{digits}f}"


def missed(of: Measured, quantity: str, low: float, high: float, relative: bool = False) -> float:
    """Return the root mean square of what impacts between two angles are off."""
    rows = _row(of, quantity, low, high)
    off = [(row["computed"] - row["measured"]) / (row["measured"] if relative else 1.0) for row in rows]
    return math.sqrt(sum(value**2 for value in off) / len(off))


def verification_row(of: Measured) -> list[str]:
    """Return the row of the experiments in the table of the page Verification in two minutes."""
    small = max(
        row["measured"] - row["computed"] for row in of["kharaz"]["tangential_restitution"] if row["angle"] < 10
    )
    ours, seen = of["mccoll"]["computed"], of["mccoll"]["measured"]
    return [
        "**experiment**",
        "[five published tests](@trust/experiments.md)",
        "rebound of a ball at 20 to 60 / below 10 degrees; wear scar (small displacement), depth / half-width",
        "48 x 48; 320",
        f"{missed(of, 'tangential_restitution', 19, 70):.3f} / up to {small:.2f} too low; {percent(ours['depth'] / seen['depth'] - 1)} / "
        f"{percent(ours['half_width'] / seen['half_width'] - 1)}",
    ]


def impact(of: Measured) -> Table:
    """Return the table of the tangential restitution."""
    rows = [
        [f"{row['angle']:.1f}", f"{row['measured']:.3f}", f"{row['computed']:.3f}", signed(row["computed"] - row["measured"]),
         f"{row['uncoupled']:.3f}", f"{row['rigid']:.3f}"]
        for row in of["kharaz"]["tangential_restitution"]
    ]  # fmt: skip
    return ["angle [deg]", "measured", "computed", "difference", "uncoupled theory", "rigid ball"], rows


def impact_spin(of: Measured) -> Table:
    """Return the table of spins and rebound angles."""
    left = of["kharaz"]["spin"]
    right = [row for row in of["kharaz"]["rebound_angle"] if row["angle"] > 1]
    rows = [
        [
            *([f"{a['angle']:.1f}", f"{a['measured']:.0f}", f"{a['computed']:.0f}", percent(a["computed"] / a["measured"] - 1)] if a else [""] * 4),
            *([f"{b['angle']:.1f}", f"{b['measured']:.2f}", f"{b['computed']:.2f}", signed(b["computed"] - b["measured"], 2)]),
        ]
        for a, b in zip([*left, *[None] * (len(right) - len(left))], right, strict=True)
    ]  # fmt: skip
    head = [
        "angle [deg]",
        "spin [rad/s], measured",
        "computed",
        "error",
        "angle [deg]",
        "rebound angle [deg], measured",
        "computed",
        "difference",
    ]
    return head, rows


def scar(of: Measured, moving: Measured) -> Table:
    """Return the table of the wear scar of a cylinder."""
    wear = {**of["mccoll"], "moving": moving["mccoll"]["computed"]}
    names = {
        "measured": "measured",
        "finite_elements": "finite elements, moving surfaces",
        "moving": "computed, surfaces move",
        "computed": "computed, surfaces stay",
    }
    rms = {
        "measured": "-",
        "finite_elements": f"{wear['rms_finite_elements']:.2f}",
        "moving": f"{moving['mccoll']['rms']:.2f}",
        "computed": f"{wear['rms']:.2f}",
    }
    rows = [
        [
            text,
            f"{wear[name]['depth']:.2f}",
            f"{wear[name]['half_width']:.3f}",
            f"{1e3 * wear[name]['area']:.3f}",
            rms[name],
        ]
        for name, text in names.items()
    ]
    return [
        "",
        "depth [um]",
        "half-width at a tenth of the depth [mm]",
        "area [1e-3 mm2]",
        "RMS from measured, inside 0.3 mm [um]",
    ], rows


def coating(of: Measured, moving: Measured) -> Table:
    """Return the table of depths in a hard coating."""
    wear = of["fouvry_2007"]
    depths = wear["measured"]
    rows = [
        [
            "measured, before and after spalling",
            f"{depths['before_spalling']:.2f}, {' to '.join(f'{d:.2f}' for d in depths['after_spalling'])}",
        ],
        *[
            [f"computed, surfaces move, stroke +-{row['stroke']:.0f} um", f"{row['depth']:.2f}"]
            for row in moving["fouvry_2007"]
        ],
        ["computed, surfaces stay", f"{wear['computed']:.2f}"],
        *[[f"closed form, stroke +-{row['stroke']:.0f} um", f"{row['depth']:.2f}"] for row in wear["strokes"]],
    ]
    return [f"at {wear['volume'] / 1e4:.2f}e4 um3", "depth [um]"], rows


def titanium_scars(of: Measured) -> Table:
    """Return the table of the scars of Ti-6Al-4V."""
    rows = []
    for row in of["arnaud"]["rows"]:
        caps = [row["cap"], row["elastic_cap"], row["computed"]]
        rows.append(
            [
                f"{row['shape']}, {row['frequency_Hz']:g} Hz, {row['area_mm2']:.3f} mm2",
                f"{row['half_width_mm']:.1f}",
                " / ".join(f"{cap['half_width']:.2f}" for cap in caps),
                f"{row['deepest_mm']:.3f} (middle {row['middle_mm']:.3f})",
                " / ".join(f"{cap['depth']:.3f}" for cap in caps),
            ]
        )
    three = "rigid cap / elastic cap / computed"
    return ["scar", "half-width [mm], measured", three, "depth [mm], measured", three], rows


def titanium_debris(of: Measured, moving: Measured) -> Table:
    """Return the table of the scars of Ti-6Al-4V with debris."""
    seen = {row["shape"]: row for row in of["arnaud"]["rows"]}
    found = moving["arnaud"]
    names = [
        ("U", f"U, {found['fraction']:.2f} of the debris stays", "U"),
        ("U_of_model", f"U, {found['fraction_of_model']:.2f} stays", "U"),
        ("W", f"W, {found['fraction_of_model']:.2f} stays, rim of {found['rim']:.2f} mm", "W"),
        ("W_wider", f"W, {found['fraction_of_model']:.2f} stays, rim of {found['wider_rim']:.2f} mm", "W"),
    ]
    rows = []
    for key, text, shape in names:
        ours, theirs = found[key], seen[shape]
        pairs = [
            (ours["half_width"], theirs["half_width_mm"], 2),
            (ours["depth"], theirs["deepest_mm"], 3),
            (ours["deepest_at"], theirs["deepest_at_mm"], 1),
            (ours["middle"], theirs["middle_mm"], 3),
            (ours["area"], theirs["area_mm2"], 2),
        ]
        rows.append([text, *[f"{mine:.{digits}f} / {other:.{digits}f}" for mine, other, digits in pairs]])
    return [
        "computed / measured",
        "half-width [mm]",
        "depth [mm]",
        "deepest at [mm]",
        "middle [mm]",
        "area [mm2]",
    ], rows


def titanium_energy(of: Measured) -> Table:
    """Return the table of pressures and energies of the tests on Ti-6Al-4V."""
    rows = [
        [row["test"], f"{row['radius_mm']}, {row['force_N_per_mm']}", f"{row['pressure_MPa']}", f"{row['program_pressure']:.1f}",
         f"{row['measured_energy']:.3f}", f"{row['computed_energy']:.3f}", f"{row['implied_friction']:.2f}"]
        for row in of["fouvry_2017"]["rows"]
    ]  # fmt: skip
    head = [
        "test",
        "R [mm], P [N/mm]",
        "pressure [MPa], printed",
        "computed",
        "energy per cycle [J], printed",
        r"computed, $\mu$ = 0.6",
        r"$\mu$ that the printed energy implies",
    ]
    return head, rows


def _row(of: Measured, quantity: str, low: float, high: float) -> list[dict[str, float]]:
    return [row for row in of["kharaz"][quantity] if low < row["angle"] < high]


def _range(values: list[float], digits: int) -> str:
    return f"{min(values):.{digits}f} to {max(values):.{digits}f}"


def _spread(values: list[float]) -> float:
    return max(values) / min(values) - 1


def _higher_friction(of: Measured) -> str:
    rows = of["kharaz"]["higher_friction"]
    angles = sorted({row["angle"] for row in rows})
    measured = {row["angle"]: row["measured"] for row in of["kharaz"]["tangential_restitution"]}
    parts = []
    for angle in angles:
        values = ", ".join(f"{row['computed']:.3f}" for row in rows if row["angle"] == angle)
        parts.append(f"{values} at {angle:.1f} degrees (measured {measured[angle]:.3f})")
    frictions = ", ".join(f"{friction:g}" for friction in sorted({row["friction"] for row in rows}))
    return f"$\\mu$ = {frictions} give {'; '.join(parts)}"


def moving_numbers(of: Measured, moving: Measured) -> dict[str, str]:
    """Return the single numbers of bodies that move, and of debris, by name."""
    scar, elements, seen = moving["mccoll"]["computed"], of["mccoll"]["finite_elements"], of["mccoll"]["measured"]
    before = of["fouvry_2007"]["measured"]["before_spalling"]
    depths = {row["stroke"]: row["depth"] for row in moving["fouvry_2007"]}
    coarser = [abs(row["coarser"] / row["depth"] - 1) for row in moving["fouvry_2007"]]
    titanium = moving["arnaud"]
    u = titanium["U"]
    rows = {row["shape"]: row for row in of["arnaud"]["rows"]}
    off = {
        f"{name}_{part}": percent(titanium[key][part] / rows[shape][seen_as] - 1)
        for name, key, shape in (("u", "U", "U"), ("model", "U_of_model", "U"), ("w", "W", "W"), ("wider", "W_wider", "W"))
        for part, seen_as in (("half_width", "half_width_mm"), ("depth", "deepest_mm"), ("middle", "middle_mm"), ("area", "area_mm2"))
    }  # fmt: skip
    return {
        "moving_depth": percent(scar["depth"] / seen["depth"] - 1),
        "moving_width": percent(scar["half_width"] / seen["half_width"] - 1),
        "moving_area": percent(scar["area"] / seen["area"] - 1),
        **{
            f"moving_{name}_elements": percent(abs(scar[name] / elements[name] - 1)).lstrip("+")
            for name in ("depth", "half_width", "area")
        },
        "moving_grid": percent(abs(moving["mccoll"]["coarser"]["depth"] / scar["depth"] - 1)).lstrip("+"),
        "moving_coating": " and ".join(f"{depths[stroke]:.2f}" for stroke in (50.0, 100.0)),
        "moving_coating_error": " and ".join(percent(depths[stroke] / before - 1) for stroke in (50.0, 100.0)),
        "moving_coating_grid": percent(max(coarser)).lstrip("+"),
        "debris_fraction": f"{titanium['fraction']:.2f}",
        "debris_fraction_of_model": f"{titanium['fraction_of_model']:.2f}",
        "debris_power": f"{titanium['power']:.3f}",
        "debris_rim": f"{titanium['rim']:.2f}",
        "debris_wider_rim": f"{titanium['wider_rim']:.2f}",
        "debris_w_deepest_at": f"{titanium['W']['deepest_at']:.1f}",
        "debris_energy": f"{u['energy_per_length']:.0f}",
        "debris_w_energy": f"{titanium['W']['energy_per_length']:.0f}",
        "debris_middle": f"{u['debris']:.3f}",
        **{f"debris_{name}": text for name, text in off.items()},
    }


def numbers(of: Measured) -> dict[str, str]:
    """Return the single numbers of the page by name."""
    wear, small = of["mccoll"], _row(of, "tangential_restitution", 0, 10)
    refined = {
        row["angle"]: [r["computed"] for r in of["kharaz"]["refined"] if r["angle"] == row["angle"]]
        for row in of["kharaz"]["refined"]
    }
    every = [row for name in ("tangential_restitution", "spin", "rebound_angle") for row in of["kharaz"][name]]
    coating = of["fouvry_2007"]
    tests = of["fouvry_2017"]["rows"]
    return {
        "impact_rms": f"{missed(of, 'tangential_restitution', 19, 70):.3f}",
        "impact_most": f"{max(abs(row['computed'] - row['measured']) for row in _row(of, 'tangential_restitution', 19, 70)):.3f}",
        "impact_small": f"{max(row['measured'] - row['computed'] for row in small):.2f}",
        "impact_change": f"{max(row['last_change'] for row in every if row['angle'] > 1):.0e}".replace("e-0", "e-"),
        "impact_angle_rms": f"{missed(of, 'rebound_angle', 19, 70):.2f}",
        "impact_angle_small": _range(
            [row["measured"] - row["computed"] for row in _row(of, "rebound_angle", 1, 15)], 2
        ),
        "impact_spin": f"{percent(min(row['computed'] / row['measured'] - 1 for row in of['kharaz']['spin']))} to "
        f"{percent(max(row['computed'] / row['measured'] - 1 for row in of['kharaz']['spin']))}",
        "impact_uncoupled": f"{max(abs(row['uncoupled'] - row['measured']) for row in small):.3f}",
        "impact_coupling": f"{abs(of['kharaz']['coupling']):.3f}",
        "impact_similar": f"{max(abs(row['computed'] - row['uncoupled']) for row in of['kharaz']['similar']):.4f}",
        "impact_refined": f"{max(max(values) - min(values) for values in refined.values()):.4f}",
        "impact_friction": _higher_friction(of),
        "scar_depth": percent(wear["computed"]["depth"] / wear["measured"]["depth"] - 1),
        "scar_width": percent(wear["computed"]["half_width"] / wear["measured"]["half_width"] - 1),
        "scar_area": percent(wear["computed"]["area"] / wear["measured"]["area"] - 1),
        "scar_elements_depth": percent(wear["finite_elements"]["depth"] / wear["measured"]["depth"] - 1),
        "scar_elements_width": percent(wear["finite_elements"]["half_width"] / wear["measured"]["half_width"] - 1),
        "scar_stroke": f"{0.025 / wear['first_half_width']:.1f}",
        "scar_last_stroke": f"{0.025 / wear['computed']['half_width']:.1f}",
        "scar_friction": percent(_spread([row["depth"] for row in wear["friction"]])).lstrip("+"),
        "scar_grid": percent(_spread([wear["computed"]["depth"], *(row["depth"] for row in wear["coarser"])])).lstrip(
            "+"
        ),
        "coating_depth": f"{coating['computed']:.2f}",
        "coating_error": percent(coating["computed"] / coating["measured"]["before_spalling"] - 1),
        "coating_grid": percent(_spread([coating["computed"], *(row["depth"] for row in coating["refined"])])).lstrip(
            "+"
        ),
        "coating_pressures": f"{coating['max_pressure'] / 1e3:.2f} GPa to {coating['last_pressure'] / 1e3:.2f} GPa",
        "titanium_pressure": f"{100 * max(abs(row['program_pressure'] / row['pressure_MPa'] - 1) for row in tests):.1f} %",
        "titanium_friction": _range([row["implied_friction"] for row in tests], 2),
    }

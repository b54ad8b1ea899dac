"""Files of instruments: units, sizes and holes arrive as SurfaceTopography has them, in Python and for the command."""

import itertools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
from fretting.__main__ import main

topographies = pytest.importorskip("SurfaceTopography")
open_topography = pytest.importorskip("SurfaceTopography.IO").open_topography

# SurfaceTopography's reader of NetCDF maps the file, and closes it when the last array is gone.
pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")

POINTS, SIDES = (48, 40), (480.0, 400.0)  # um
CELLS = (24, 20)


def ball() -> np.ndarray[Any, np.dtype[np.float64]]:
    """Heights of a ball of 2 mm on the points, with waves of 60 um and 0.02 um, in um."""
    x, y = ((np.arange(n) + 0.5) * s / n for n, s in zip(POINTS, SIDES, strict=True))
    sphere = -((x[:, None] - 240.0) ** 2 + (y[None, :] - 200.0) ** 2) / (2 * 2000.0)
    return sphere + 0.02 * np.cos(2 * np.pi * x[:, None] / 60.0)


def written(folder: Path, heights: np.ndarray[Any, np.dtype[np.float64]]) -> Path:
    """Write a scan in a format that SurfaceTopography writes itself."""
    path = folder / "scan.nc"
    topographies.Topography(np.ma.masked_invalid(heights), SIDES, unit="um").to_netcdf(str(path))
    return path


def read_by_the_other(path: Path, fill: bool = False) -> Any:
    """Return what SurfaceTopography itself makes of a file, in mm."""

    def copied(topography: Any) -> Any:  # nothing that refers to the file may be left when it is closed
        millimetres = (topography.interpolate_undefined_data() if fill else topography).to_unit("mm")
        return np.array(millimetres.heights()), millimetres.physical_sizes

    with open_topography(str(path)) as reader:
        return copied(reader.topography())


def case(folder: Path, keys: str = "", cells: tuple[int, int] = POINTS, size: str = "[0.48, 0.4]") -> Path:
    """Write a case in mm whose lower body has the scan."""
    path = folder / "case.toml"
    path.write_text(
        f'[units]\nlength = "mm"\nforce = "N"\n[grid]\ncells = {list(cells)}\nsize = {size}\n[upper]\nrigid = true\n'
        "[lower]\nsubstrate = { young = 210e3, poisson = 0.3 }\n"
        f'[lower.profile.heights]\nfile = "scan.nc"\n{keys}\n'
        '[output]\nfields = ["gap", "pressure"]\n[[load]]\nnormal_force = 0.5\nincrements = 1\n'
    )
    return path


def record(path: Path) -> dict[str, Any]:
    """Return the record of the heights of a case."""
    (heights,) = fretting.plan(path)["case"]["profile"]["heights"]
    treatment: dict[str, Any] = heights["treatment"]
    return treatment


def test_units_and_points_are_those_of_the_other_reader(tmp_path: Path) -> None:
    heights = ball()
    path = written(tmp_path, heights)
    theirs, sizes = read_by_the_other(path)
    question = {
        "units": {"length": "mm", "force": "N"},
        "grid": {"cells": list(POINTS), "size": list(sizes)},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 210e3, "poisson": 0.3}, "profile": {"heights": {"values": theirs}}},
        "load": [{"normal_force": 0.5, "increments": 1}],
    }
    expected = fretting.run(question).field("pressure")
    found = fretting.run(case(tmp_path)).field("pressure")
    # The heights agree to rounding; the solver's tolerance is 1e-8.
    np.testing.assert_allclose(found, expected, atol=1e-6 * expected.max())
    treatment = record(tmp_path / "case.toml")
    assert treatment["points"] == list(POINTS)
    assert treatment["size"] == pytest.approx([0.48, 0.4])
    assert treatment["read_by"].startswith("SurfaceTopography ")


def test_holes_are_refused_and_filled_as_the_other_program_fills_them(tmp_path: Path) -> None:
    holed = ball()
    holed[5:9, 30:36] = np.nan
    holed[::7, ::5] = np.nan
    path = written(tmp_path, holed)
    count = int(np.isnan(holed).sum())
    with pytest.raises(fretting.CaseError, match=f"{count} of {holed.size} points have no measurement") as caught:
        fretting.plan(case(tmp_path))
    assert 'fill = "harmonic"' in str(caught.value)
    treatment = record(case(tmp_path, 'fill = "harmonic"'))
    assert (treatment["holes"], treatment["fill"]) == (count, "harmonic")
    theirs, _ = read_by_the_other(path, fill=True)
    table = fretting.plan(case(tmp_path, 'fill = "harmonic"'))["case"]["profile"]["heights"][0]
    # The same heights to rounding: rms and valley, which the record has, agree to the solver of the gradients.
    assert table["valley"] == pytest.approx(float(theirs.max() - theirs.min()), rel=1e-9)
    assert table["rms"] == pytest.approx(float(theirs.std()), rel=1e-9)


def test_the_command_of_the_wheel_reads_the_file_too(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    written(tmp_path, ball())
    keys = 'resample = "linear"\nlong_cutoff = 0.3\ndetrend = "plane"'
    path = case(tmp_path, keys, CELLS, "[0.4, 0.3]")
    assert main(["run", str(path), "--quiet", "--out", str(tmp_path / "out")]) == 0, capfd.readouterr().err
    (heights,) = json.loads((tmp_path / "out" / "run.json").read_text())["plan"]["case"]["profile"]["heights"]
    assert heights["treatment"]["resample"] == "linear"
    assert heights["treatment"]["long_cutoff"] == 0.3
    assert heights["cells"] == list(CELLS)
    # from Python the same bits
    found = fretting.run(path).field("pressure")
    np.testing.assert_array_equal(found, fretting.open_results(tmp_path / "out").field("pressure"))
    # the folder of results is read without the file
    (tmp_path / "scan.nc").unlink()
    assert main(["report", str(tmp_path / "out"), "--out", str(tmp_path / "page.html")]) == 0, capfd.readouterr().err


def test_a_line_scan_lies_in_a_line_contact(tmp_path: Path) -> None:
    x = (np.arange(200) + 0.5) / 200 * 2000.0
    scan = topographies.UniformLineScan(-((x - 1000.0) ** 2) / (2 * 50e3), 2000.0, unit="um")
    scan.to_netcdf(str(tmp_path / "scan.nc"))
    path = case(tmp_path, 'resample = "linear"')
    text = path.read_text().replace("cells = [48, 40]", "cells = 128").replace("size = [0.48, 0.4]", "size = 1.0")
    path.write_text(text.replace("normal_force = 0.5", "normal_force = 100.0"))
    found = fretting.run(path).increments["max_pressure"][-1]
    hertz = fretting.analytic.hertz_line(radius=50.0, line_force=100.0, modulus=210e3 / 0.91)
    # 74 cells in the contact, and points 10 um apart between which the parabola is straight: 1e-3
    assert found == pytest.approx(hertz.max_pressure, rel=5e-3)


def test_what_cannot_be_read_is_told(tmp_path: Path) -> None:
    (tmp_path / "scan.nc").write_bytes(b"\x00\x01\x02\x03 no scan")
    with pytest.raises(fretting.CaseError, match="no file of an instrument that SurfaceTopography reads"):
        fretting.plan(case(tmp_path))
    written(tmp_path, ball())
    with pytest.raises(fretting.CaseError, match='no channel "Current"; its channels are'):
        fretting.plan(case(tmp_path, 'channel = "Current"'))
    with pytest.raises(fretting.CaseError, match=r"48 x 40 points on 0.48 x 0.4, but the grid has 24 x 20 cells"):
        fretting.plan(case(tmp_path, "", CELLS))


GOLDEN = Path(__file__).parents[2] / "tests" / "golden" / "instruments"
MM = 'units = { length = "mm", force = "N" }\n'
FILES = {
    # name: keys of the heights, and how far positions are rounded in the file, of their range
    "sdf-1.sdf": ("", 0.0),
    "nc-1.nc": ("", 0.0),
    "gwyddion-export-german.txt": ('rows = "y"', 0.0),  # as an image the text has its rows along y
    "matrix-6.txt": ('rows = "y"', 0.0),
    "xyz-1.txt": ("", 0.0),
    "xyz-1-different-order.txt": ("", 0.0),
    "missing_data_2d.xyz": ('fill = "harmonic"', 0.0),
    "missing_data_1d_uniform.txt": ('fill = "harmonic"', 0.0),
    "csv-1.csv": ("", 2e-4 / 0.27),
    "xy-2.txt": ("unit = 1.0", 0.0),
    "nonuniform.asc": ("", 0.0),
}


def scan_of_the_other_reader(path: Path) -> tuple[Any, list[Any]]:
    """Return heights and places of the points along each axis, in mm where the file states a unit, filled."""
    with open_topography(str(path)) as reader:
        topography = reader.topography()
        if topography.has_undefined_data:
            topography = topography.interpolate_undefined_data()
        if topography.unit is not None:
            topography = topography.to_unit("mm")
        heights = np.array(topography.heights())
        if topography.dim == 1:
            return heights, [np.array(topography.positions())]
        counts, sizes = heights.shape, topography.physical_sizes
        return heights, [(np.arange(n) + 0.5) * float(side) / n for n, side in zip(counts, sizes, strict=True)]


def means(places: Any, lane: Any, borders: Any) -> list[float]:
    """Return the means between borders of what is linear between points, and goes on straight beyond the last."""

    def height(at: Any) -> Any:
        first = np.clip(np.searchsorted(places, at) - 1, 0, len(places) - 2)
        rise = (lane[first + 1] - lane[first]) / (places[first + 1] - places[first])
        return lane[first] + rise * (at - places[first])

    found = []
    for low, high in itertools.pairwise(borders):
        at = np.concatenate([[low], places[(places > low) & (places < high)], [high]])
        found.append(float(np.trapezoid(height(at), at) / (high - low)))
    return found


@pytest.mark.parametrize("name", list(FILES))
def test_files_of_others_are_solved_with_the_heights_of_the_other_reader(
    tmp_path: Path, name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    if not (GOLDEN / name).exists():
        pytest.skip("needs a checkout of the repository")
    (tmp_path / name).write_bytes((GOLDEN / name).read_bytes())
    heights, places = scan_of_the_other_reader(GOLDEN / name)
    # the head of this column says microns, which the other reader does not read
    places = [1e-3 * at for at in places] if name == "csv-1.csv" else places
    keys, rounding = FILES[name]
    # the middle eight tenths of the scan, on 16 cells along each axis
    borders = [0.5 * (at[0] + at[-1]) + 0.8 * (at[-1] - at[0]) * (np.arange(17) / 16 - 0.5) for at in places]
    expected = heights
    for axis in range(len(places)):
        lanes = np.moveaxis(expected, axis, -1)
        along = [means(places[axis], lane, borders[axis]) for lane in lanes.reshape(-1, lanes.shape[-1])]
        expected = np.moveaxis(np.reshape(along, (*lanes.shape[:-1], 16)), -1, axis)
    sides = [float(border[-1] - border[0]) for border in borders]
    valley = float(np.ptp(expected))
    line = len(places) == 1
    # so little that nothing is deformed by more than a millionth of the heights, or of a cell where they are level
    force = 1e-6 * 210e3 * (valley or sides[0] / 16) * (1.0 if line else min(sides) / 16)
    (tmp_path / "case.toml").write_text(
        f"{MM}grid.cells = {16 if line else [16, 16]}\ngrid.size = {sides[0] if line else sides}\n"
        "grid.beyond = 'no body'\nupper.rigid = true\nlower.substrate = { young = 210e3, poisson = 0.3 }\n"
        f"output = {{ fields = ['gap'] }}\nload = [{{ normal_force = {force}, increments = 1 }}]\n"
        f'[lower.profile.heights]\nfile = "{name}"\nresample = "linear"\n{keys}\n'
    )
    assert main(["run", str(tmp_path / "case.toml"), "--quiet", "--out", str(tmp_path / "out")]) == 0, (
        capfd.readouterr().err
    )
    gap = fretting.open_results(tmp_path / "out").field("gap")
    np.testing.assert_allclose(
        gap - gap.min(),
        # metres on micrometres are steeper than anything: a gap is no wider than a million grids
        np.minimum(expected.max() - expected, 1e6 * math.hypot(*sides)),
        # the contact deforms by some millionths; positions that are rounded in the file move the heights
        atol=(1e-4 + rounding) * (valley or sides[0]),
    )
    (told,) = json.loads((tmp_path / "out" / "run.json").read_text())["plan"]["case"]["profile"]["heights"]
    assert told["treatment"]["points"] == [*heights.shape, 1][:2]
    assert told["valley"] == pytest.approx(valley, rel=1e-9 + rounding, abs=1e-12)


def test_a_hole_between_uneven_points_is_refused(tmp_path: Path) -> None:
    name = "xy-6.txt"
    if not (GOLDEN / name).exists():
        pytest.skip("needs a checkout of the repository")
    (tmp_path / name).write_bytes((GOLDEN / name).read_bytes())
    (tmp_path / "case.toml").write_text(
        f"{MM}grid = {{ cells = 16, size = 2.0 }}\nupper.rigid = true\n"
        "lower.substrate = { young = 210e3, poisson = 0.3 }\nload = [{ normal_force = 1.0, increments = 1 }]\n"
        f'[lower.profile.heights]\nfile = "{name}"\nresample = "linear"\nfill = "harmonic"\n'
    )
    with pytest.raises(fretting.CaseError, match="fill: the points of this line scan are not evenly spaced"):
        fretting.plan(tmp_path / "case.toml")

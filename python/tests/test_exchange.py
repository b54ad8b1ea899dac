"""What ``fret export`` writes, opened by the programs it is written for."""

import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

CASE = """
[grid]
cells = [16, 20]
size = [240e-6, 300e-6]
[upper]
rigid = true
[lower]
substrate = { young = 210e9, poisson = 0.3 }
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.1
[[load]]
normal_force = 1.0
increments = 3
[[load]]
tangential_force = [0.05, 0.0]
increments = 4
[output]
every = 2
"""


FRET = [sys.executable, "-m", "fretting"]
"""The command that belongs to the package under test, whatever is called so on the path."""


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("exchange")
    (folder / "case.toml").write_text(CASE)
    subprocess.run([*FRET, "run", "case.toml", "--out", "run", "--quiet"], cwd=folder, check=True)
    subprocess.run([*FRET, "export", "run", "--npz", "--vtk", "--csv"], cwd=folder, check=True, capture_output=True)
    return folder / "run"


def test_numpy_opens_the_npz(results: Path) -> None:
    arrays = np.load(results / "export.npz")
    assert arrays["pressure"].shape == (4, 16, 20)
    assert arrays["kept_increment"].tolist() == [1, 2, 4, 6]
    assert arrays["regime"].tolist()[-1] == "partial_slip"
    # The pressure carries the force: to the tolerance of the solver.
    force = arrays["pressure"].sum(axis=(1, 2)) * 15e-6**2
    np.testing.assert_allclose(force, arrays["normal_force"][arrays["kept_increment"]], rtol=1e-7)


def test_xarray_opens_the_store_itself(results: Path) -> None:
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("zarr")
    arrays = np.load(results / "export.npz")
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # its metadata is consolidated: nothing has to be looked for
        data = xarray.open_zarr(results / "fields.zarr")
    assert set(data.data_vars) == {"pressure", "shear_x", "shear_y", "slip_x", "slip_y", "zone"}
    for name in data.data_vars:
        assert data[name].dims == ("increment", "y", "x")  # drawn with x to the right
        np.testing.assert_array_equal(data[name].transpose("increment", "x", "y").values, arrays[name])
    assert (data["zone"].dtype, data["zone"].attrs["flag_meanings"]) == (np.uint8, "open stick slip")


def test_zarr_opens_the_store_of_a_history_whose_length_was_not_known(tmp_path: Path) -> None:
    zarr = pytest.importorskip("zarr")
    case = CASE.replace("increments = 4", "cycles = 9\nincrements = 8") + "[wear]\ncoefficient = 1e-12\nevery = 4\n"
    (tmp_path / "case.toml").write_text(case.replace("every = 2\n[wear]", "every = 8\n[wear]"))
    subprocess.run([*FRET, "run", "case.toml", "--out", "run", "--quiet"], cwd=tmp_path, check=True)
    group = zarr.open_group(tmp_path / "run" / "fields.zarr", mode="r", use_consolidated=True)
    alone = zarr.open_array(tmp_path / "run" / "fields.zarr" / "pressure", mode="r")
    assert group["pressure"].shape == alone.shape == (len(group["increment"][:]), 20, 16)
    assert np.isfinite(group["pressure"][:]).all()


def test_pyvista_opens_the_images(results: Path) -> None:
    pyvista = pytest.importorskip("pyvista")
    arrays = np.load(results / "export.npz")
    reader = pyvista.get_reader(str(results / "vtk" / "history.pvd"))
    assert reader.time_values == arrays["kept_increment"].tolist()
    for place, time in enumerate(reader.time_values):
        reader.set_active_time_value(time)
        image = reader.read()[0]
        field = np.asarray(image.cell_data["pressure"]).reshape(20, 16).T
        np.testing.assert_array_equal(field, arrays["pressure"][place])
        shear = np.asarray(image.cell_data["shear"])[:, 0].reshape(20, 16).T
        np.testing.assert_array_equal(shear, arrays["shear_x"][place])
    centres = image.cell_centers().points
    np.testing.assert_allclose(np.unique(centres[:, 1].round(12)), arrays["y"], atol=1e-11)

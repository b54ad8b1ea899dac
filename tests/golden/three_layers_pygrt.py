"""Displacement of the surface of three-layer stacks by a point force on it, by PyGRT (Zhu Dengda et al., generalised reflection and
transmission matrices for seismology; `pip install pygrt-kit netCDF4`), a third party. Its discrete wavenumbers leave constants in some of
the components, so the table holds differences to the last distance. Units: force 1; PyGRT's are converted by the half-space's closed form,
which is also the check of the settings."""

import json
import pathlib
import tempfile

import numpy as np
import pygrt
from netCDF4 import Dataset

DISTANCES = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0]
STACKS = [
    ("stiff on soft on stiff", [(4.0, 0.25, 0.5), (0.5, 0.35, 1.0), (2.0, 0.2, 1.5)], (1.0, 0.3)),
    ("graded in steps", [(8.0, 0.22, 0.3), (4.0, 0.26, 0.3), (2.0, 0.28, 0.4)], (1.0, 0.3)),
    ("soft top", [(0.2, 0.4, 1.0), (3.0, 0.25, 0.5), (1.5, 0.3, 2.0)], (1.0, 0.3)),
]


def displacements(layers, substrate):
    """VFZ, VFR, HFR, HFT at the distances, as PyGRT gives them."""
    rows = []
    for young, nu, h in layers + [(*substrate, 0.0)]:
        mu = young / (2 * (1 + nu))
        lam = young * nu / ((1 + nu) * (1 - 2 * nu))
        rows.append(f"{h:.15g} {np.sqrt(lam + 2 * mu):.17g} {np.sqrt(mu):.17g} 1.0 1e9 1e9")
    with tempfile.TemporaryDirectory() as folder:
        model = pathlib.Path(folder) / "model"
        model.write_text("\n".join(rows) + "\n")
        found = pathlib.Path(folder) / "green.nc"
        pygrt.PyModel1D(modelpath=str(model), stgrn=str(found)).static_greenfn(
            depsrc=0, deprcv=0, dists=DISTANCES, converg_method="DCM", use_kmax_ref=True, k0=200, Length=160
        )
        with Dataset(found) as data:
            return {name: np.array(data[name][:], dtype=float).ravel() for name in ("VFZ", "VFR", "HFR", "HFT")}


def main():
    # a half-space: u_z = (1 - nu)/(2 pi mu r), u_r from the vertical force -(1 - 2 nu)/(4 pi mu r); horizontally 1/(2 pi mu r), (1 - nu)/(2 pi mu r)
    nu, mu, r = 0.3, 1.0 / 2.6, np.array(DISTANCES)
    exact = {
        "VFZ": (1 - nu) / (2 * np.pi * mu * r),
        "VFR": -(1 - 2 * nu) / (4 * np.pi * mu * r),
        "HFR": 1 / (2 * np.pi * mu * r),
        "HFT": (1 - nu) / (2 * np.pi * mu * r),
    }
    plain = displacements([(1.0, nu, 1.0)] * 3, (1.0, nu))
    factors = {}
    for name, values in plain.items():
        less, wanted = values - values[-1], exact[name] - exact[name][-1]
        factors[name] = wanted[0] / less[0]
        error = np.max(np.abs(less * factors[name] - wanted)) / np.abs(wanted[0])
        assert error < 1e-12, (name, error)
    rows = []
    for name, layers, substrate in STACKS:
        found = displacements(layers, substrate)
        values = {
            key: [float(f"{value:.12g}") for value in (one - one[-1]) * factors[key]] for key, one in found.items()
        }
        rows.append(
            dict(
                case=name,
                layers=layers,
                substrate=substrate,
                distances=DISTANCES,
                zz=values["VFZ"],
                zr=values["VFR"],
                rr=values["HFR"],
                tt=values["HFT"],
            )
        )
    about = (
        "Displacement of the surface of layered half-spaces, layers = [E, nu, thickness] from the surface down, substrate = [E, nu], by a unit point force "
        "on it, less that at the last distance: zz, zr normal and radial displacement by a normal force; rr, tt displacement along a tangential force, "
        f"on its line and beside it. Made by three_layers_pygrt.py with PyGRT {pygrt.__version__}, a third party's program."
    )
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write('{"about": ' + json.dumps(about) + ',\n"rows": [\n' + ",\n".join(map(json.dumps, rows)) + "\n]}\n")


if __name__ == "__main__":
    main()

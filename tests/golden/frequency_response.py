"""Reference responses of nine layered half-spaces at ten wavenumbers each: transfer matrices by mpmath, as in
frequency_response_random.py; inputs are binary, printed as the shortest decimals that read back to them."""
import json
import pathlib

from frequency_response_random import response

STACKS = [
    ("stiff coating 2:1", [[2.0, 0.3, 1.0]], [1.0, 0.3]),
    ("soft coating 1:2", [[0.5, 0.3, 1.0]], [1.0, 0.3]),
    ("ratio 1e4, nu 0.2/0.35", [[10000.0, 0.2, 1.0]], [1.0, 0.35]),
    ("ratio 1e-4, nu 0.2/0.35", [[0.0001, 0.2, 1.0]], [1.0, 0.35]),
    ("incompressible coating on compressible substrate", [[10.0, 0.5, 1.0]], [1.0, 0.0]),
    ("rigid base nu 0.3", [[1.0, 0.3, 1.0]], None),
    ("rigid base nu 0.5", [[1.0, 0.5, 1.0]], None),
    ("three layers", [[2.0, 0.25, 0.5], [0.1, 0.45, 0.2], [5.0, 0.3, 0.3]], [1.0, 0.3]),
    ("identical materials", [[1.0, 0.3, 1.0]], [1.0, 0.3]),
]
WAVENUMBERS = [1e-08, 1e-05, 0.001, 0.03, 0.3, 1.0, 3.0, 10.0, 40.0, 300.0]


def main():
    rows = []
    for case, layers, substrate in STACKS:
        for k in WAVENUMBERS:
            rows.append(dict(case=case, layers=layers, substrate=substrate, k=k, **response(k, layers, substrate)))
    about = (
        "Surface compliance of a layered elastic half-space at wavenumber k (rad per length): displacement/traction per unit "
        "amplitude, z into the body; u_x = i U, q_x = i Q, (U, W) = [[rr, rz],[rz, zz]] (Q, P), u_y = tt q_y. layers = [E, nu, "
        "thickness] from the surface down; substrate null = rigid base. Values: decimal strings good to 20 digits of the binary inputs. Made by "
        "frequency_response.py."
    )
    with open(pathlib.Path(__file__).with_suffix(".json"), "w") as file:
        file.write(json.dumps(dict(about=about, rows=rows), indent=0) + "\n")


if __name__ == "__main__":
    main()

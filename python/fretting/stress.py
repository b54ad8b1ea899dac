"""Subsurface stresses."""

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from fretting import _core
from fretting._arrays import real_array
from fretting.history import History


def subsurface_stress(
    history: History,
    depths: npt.ArrayLike,
    step: int = -1,
    body: Literal["lower", "upper"] = "lower",
    threads: int | None = None,
) -> dict[str, npt.NDArray[Any]]:
    """Subsurface stress of one body, from the kept tractions of an increment.

    Bulk stress and residual stress are included, layer by layer. Axes x and y of the contact, z into the body in question, from its own surface; tension is positive. Under the
    centres of the cells, exact for tractions that are uniform over each cell.

    Parameters
    ----------
    history : History
        A run that has kept ``pressure``, and ``shear`` if there is friction.
    depths : array_like
        Depths under the surface [length], not negative, in or at the faces of the coatings where the base is rigid.
    step : int, optional
        The increment; negative numbers count from the end.
    body : {"lower", "upper"}, optional
        The body.
    threads : int, optional
        Worker threads; default: all cores. The result is the same for any number.

    Returns
    -------
    dict of str to ndarray
        ``xx``, ``yy``, ``zz``, ``xy``, ``xz``, ``yz``, ``von_mises`` [pressure] of shape (nz, nx, ny), of a line contact (nz, nx); ``depth`` [length]
        and ``layer`` of shape (nz,). A depth at an interface appears twice, first as seen from above, then from below;
        ``layer`` is 0 in the outermost coating and the number of coatings in the substrate.

    Raises
    ------
    ValueError
        When a depth is above the surface or in a rigid base, or the body is rigid.
    KeyError
        When the tractions of the increment were not kept.

    Examples
    --------
    >>> import fretting
    >>> history = fretting.run({
    ...     "grid": {"cells": [32, 32], "size": "auto"},
    ...     "upper": {"rigid": True},
    ...     "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    ...     "profile": {"sphere": {"radius": 10e-3}},
    ...     "load": [{"normal_force": 10.0, "increments": 1}],
    ... })
    >>> fretting.subsurface_stress(history, [0.0, 20e-6])["von_mises"].shape
    (2, 32, 32)
    """
    if body not in ("lower", "upper"):
        raise ValueError(f"body = {body!r}: must be 'lower' or 'upper'")
    points = real_array("depths", np.atleast_1d(np.asarray(depths)), dimensions=1)
    pressure = history.field("pressure", step)
    shear = None
    if "frictionless" not in history.steps["regime"]:
        shear = (history.field("shear_x", step), history.field("shear_y", step))
    grid = len(history.x), len(history.y)
    tractions = pressure.reshape(grid), shear and (shear[0].reshape(grid), shear[1].reshape(grid))
    name = "bulk_stress" if body == "lower" else "upper_bulk_stress"
    bulk_stress = [float(history.steps[f"{name}_{axis}"][step]) for axis in "xy"]
    stress = _core.subsurface_stress(
        (history._bodies, body == "upper"), history._spacing, history._periodic, tractions, points.tolist(), (bulk_stress, history._residual_stress), threads
    )
    if history.is_line:
        return {name: values.reshape(len(values), *history.shape) if values.ndim == 3 else values for name, values in stress.items()}
    return stress

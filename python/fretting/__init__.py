"""Fretting contact of coated elastic bodies: pressure, shear, stick and slip through the loading history.

A case goes in, a history comes out:

>>> import fretting
>>> history = fretting.run({
...     "grid": {"cells": [32, 32], "size": "auto"},
...     "upper": {"rigid": True},
...     "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
...     "profile": {"sphere": {"radius": 10e-3}},
...     "load": [{"normal_force": 10.0, "increments": 1}],
... })
>>> history.field("pressure").shape
(32, 32)

Any consistent system of units. Fields have shape (nx, ny), index ``[i, j]`` at ``(x[i], y[j])``; z points into the
lower body, compression is positive.
"""

from fretting import analytic, plot
from fretting._core import __version__
from fretting._points import Parameter
from fretting.case_types import Case
from fretting.designing import Design, design
from fretting.differentiating import Gradient, NearEvents, gradient, vjp
from fretting.errors import (
    CaseError,
    DesignError,
    Evaluation,
    FrettingError,
    FrettingWarning,
    MissingFileError,
    Mistake,
    OutOfMemoryError,
    RunError,
    RunInterrupted,
    UnreadableError,
)
from fretting.history import History
from fretting.identifying import Identification, identify
from fretting.indenting import Indentation, identify_indentation
from fretting.kernels import Convolution, frequency_response, influence_coefficients
from fretting.loading import open_results
from fretting.planning import Plan, plan
from fretting.propagating import first_order
from fretting.simulation import run
from fretting.studying import study
from fretting.sweeping import sweep
from fretting.uncertainty import Distribution, Lognormal, Normal, Triangular, Uniform, Weibull, uncertainty

__all__ = [
    "Case",
    "CaseError",
    "Convolution",
    "Design",
    "DesignError",
    "Distribution",
    "Evaluation",
    "FrettingError",
    "FrettingWarning",
    "Gradient",
    "History",
    "Identification",
    "Indentation",
    "Lognormal",
    "MissingFileError",
    "Mistake",
    "NearEvents",
    "Normal",
    "OutOfMemoryError",
    "Parameter",
    "Plan",
    "RunError",
    "RunInterrupted",
    "Triangular",
    "Uniform",
    "UnreadableError",
    "Weibull",
    "__version__",
    "analytic",
    "design",
    "first_order",
    "frequency_response",
    "gradient",
    "identify",
    "identify_indentation",
    "influence_coefficients",
    "open_results",
    "plan",
    "plot",
    "run",
    "study",
    "sweep",
    "uncertainty",
    "vjp",
]

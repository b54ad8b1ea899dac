"""Uncertain inputs of a sweep: distributions, and what their samples say about the results."""

import json
import math
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from fretting import _core
from fretting._arguments import checked, real, whole

if TYPE_CHECKING:
    import xarray

__all__ = ["Distribution", "Lognormal", "Normal", "Triangular", "Uniform", "Weibull", "uncertainty"]

STATISTICS = ("mean", "deviation", "min", "max")


@dataclass(frozen=True)
class Distribution:
    """Distribution of an uncertain number of the case: a value of a key in the parameters of :func:`fretting.sweep`.

    The base of :class:`Uniform`, :class:`Normal`, :class:`Lognormal`, :class:`Triangular` and :class:`Weibull`, which
    raise a ``TypeError`` when an argument is no number, a ``ValueError`` when it is not finite or out of its range.
    """

    def __post_init__(self) -> None:
        """Check the arguments."""
        if type(self) is Distribution:
            raise TypeError(
                "Distribution: the base of all distributions, none itself; make a Uniform, Normal, Lognormal, "
                "Triangular or Weibull"
            )
        for name, value in asdict(self).items():
            number = real(name, value)
            if not math.isfinite(number):
                raise ValueError(f"{name} = {number}: must be finite")
            object.__setattr__(self, name, number)

    def _must_be_positive(self, *names: str) -> None:
        for name in names:
            number = getattr(self, name)
            if number <= 0.0:
                raise ValueError(f"{name} = {number}: must be positive")

    def _described(self) -> dict[str, Any]:
        name = type(self).__name__.lower()
        words = {"low": "from", "high": "to"}
        return {name: {words.get(key, key): value for key, value in asdict(self).items()}}


@dataclass(frozen=True)
class Uniform(Distribution):
    """Anything between two bounds, equally likely."""

    low: float
    """Lower bound."""
    high: float
    """Upper bound."""

    def __post_init__(self) -> None:
        """Check the arguments."""
        super().__post_init__()
        if self.low >= self.high:
            raise ValueError(f"low = {self.low}, high = {self.high}: low must lie below high")


@dataclass(frozen=True)
class Normal(Distribution):
    """Normal (Gauss)."""

    mean: float
    """Mean."""
    deviation: float
    """Standard deviation."""

    def __post_init__(self) -> None:
        """Check the arguments."""
        super().__post_init__()
        self._must_be_positive("deviation")


@dataclass(frozen=True)
class Lognormal(Distribution):
    """Lognormal: always positive, its logarithm is normal."""

    mean: float
    """Mean of the number itself."""
    deviation: float
    """Standard deviation of the number itself."""

    def __post_init__(self) -> None:
        """Check the arguments."""
        super().__post_init__()
        self._must_be_positive("mean", "deviation")


@dataclass(frozen=True)
class Triangular(Distribution):
    """Triangular."""

    low: float
    """Lower bound."""
    mode: float
    """The likeliest value."""
    high: float
    """Upper bound."""

    def __post_init__(self) -> None:
        """Check the arguments."""
        super().__post_init__()
        if not (self.low <= self.mode <= self.high and self.low < self.high):
            found = f"low = {self.low}, mode = {self.mode}, high = {self.high}"
            raise ValueError(f"{found}: low must lie below high, and mode between them or at one")


@dataclass(frozen=True)
class Weibull(Distribution):
    """Weibull, from zero up."""

    shape: float
    """Shape (modulus) [-]."""
    scale: float
    """The value below which 63.2 % lie."""

    def __post_init__(self) -> None:
        """Check the arguments."""
        super().__post_init__()
        self._must_be_positive("shape", "scale")


def drawn(distributions: list[Distribution], count: int, seed: int, indices: bool) -> list[list[float]]:
    """Return the values of every distribution in every sample, row by row."""
    count, seed = whole("samples", count), whole("seed", seed)
    if not (0 < count < 2**32 and 0 <= seed < 2**32):
        raise ValueError(f"samples = {count}, seed = {seed}: whole numbers, the seed from 0 to 4294967295")
    described = [distribution._described() for distribution in distributions]
    design = {"distributions": described, "count": count, "seed": seed, "indices": bool(indices)}
    return _core.sample_rows(json.dumps(design))


@checked
def uncertainty(dataset: "xarray.Dataset") -> "xarray.Dataset":
    """Return what the samples of a sweep say about its numbers.

    Parameters
    ----------
    dataset : xarray.Dataset
        From :func:`fretting.sweep` with distributions among its parameters.

    Returns
    -------
    xarray.Dataset
        Of every number of the sweep that varies: ``NAME`` with the dimension ``statistic`` (mean, deviation, min,
        max), ``NAME_quantile`` with ``quantile`` (0.025, 0.25, 0.5, 0.75, 0.975), and with ``indices=True``
        ``NAME_first`` and ``NAME_total`` with ``uncertain``, the uncertain keys: Sobol' indices of first order
        (Saltelli's estimator) and total (Jansen's). All other dimensions are kept. Points that were not solved do not
        count. A sample without bound, an endless life, is larger than all others: the mean is infinite then, deviation
        and indices are NaN, quantiles are what they are.

    Raises
    ------
    ValueError
        When the sweep has no samples.

    Examples
    --------
    >>> import fretting
    >>> case = {
    ...     "grid": {"cells": [16, 16], "size": "auto"},
    ...     "upper": {"rigid": True},
    ...     "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    ...     "profile": {"sphere": {"radius": 10e-3}},
    ...     "load": [{"normal_force": 10.0, "increments": 1}],
    ... }
    >>> answer = fretting.sweep(case, {"load.0.normal_force": fretting.Normal(10.0, 0.5)}, samples=16)
    >>> told = fretting.uncertainty(answer)
    >>> print(f"{float(told['max_pressure'].sel(statistic='deviation') /
    told['max_pressure'].sel(statistic='mean')):.3f}")
    0.017
    """
    if "sample" not in dataset.dims or not {"samples", "indices", "uncertain"} <= set(dataset.attrs):
        raise ValueError(
            "uncertainty: the sweep has no samples; give it distributions, such as fretting.Normal(0.6, 0.05)"
        )
    import xarray

    count, indices = int(dataset.attrs["samples"]), bool(dataset.attrs["indices"])
    own = 2 * count if indices else count
    keys = list(dataset.attrs["uncertain"])
    variables: dict[str, Any] = {}
    for name, variable in dataset.data_vars.items():
        if variable.dtype.kind != "f" or "sample" not in variable.dims:
            continue
        others = tuple(dimension for dimension in variable.dims if dimension != "sample")
        values = variable.transpose("sample", *others).values
        known = values[:own][~np.isnan(values[:own])]
        if len(known) < 2 or (known == known[0]).all():
            continue
        numbers = _along_samples(_core.statistics, values[:own])
        variables[str(name)] = (("statistic", *others), numbers[: len(STATISTICS)], variable.attrs)
        variables[f"{name}_quantile"] = (("quantile", *others), numbers[len(STATISTICS) :], variable.attrs)
        if indices:
            found = _along_samples(lambda column: _core.sobol_indices(column, count), values)
            variables[f"{name}_first"] = (("uncertain", *others), found[0::2])
            variables[f"{name}_total"] = (("uncertain", *others), found[1::2])
    coordinates: dict[str, Any] = {"statistic": list(STATISTICS), "quantile": list(_core.quantile_fractions())}
    if indices:
        coordinates["uncertain"] = keys
    kept = {name: entry for name, entry in dataset.coords.items() if "sample" not in entry.dims}
    return xarray.Dataset(variables, coords={**coordinates, **kept}, attrs={"samples": count})


def _along_samples(of: Any, values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    flat = np.ascontiguousarray(values.reshape(len(values), -1).T)
    columns = np.stack([of(column) for column in flat], axis=-1)
    return columns.reshape(len(columns), *values.shape[1:])

"""Propagation of uncertainty to first order: how much results scatter, from their derivatives, without samples."""

import json
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from fretting import _case, _core, _dataset
from fretting._arguments import mapping, of_kind, text, texts
from fretting._paths import put
from fretting.differentiating import near_in_words, told
from fretting.uncertainty import Distribution

if TYPE_CHECKING:
    import xarray


def first_order(
    case: _case.CaseLike,
    distributions: Mapping[str, Distribution],
    *,
    of: str | Iterable[str],
    threads: int | None = None,
) -> "xarray.Dataset":
    """Return how much results scatter with uncertain numbers of a case, to first order: one run instead of samples.

    The case is run at the means of the numbers. The variance of a result is the sum of the squares of derivative times
    standard deviation (the law of propagation of uncertainty, JCGM 100:2008): right where the result is close to linear
    over the scatter. What bends it (a mean that moves, a skewed distribution, a change between partial and gross slip)
    only samples tell: :func:`fretting.sweep` with the same distributions, and :func:`fretting.uncertainty`.

    Parameters
    ----------
    case : path, str or mapping
        As for :func:`fretting.run`.
    distributions : mapping of str to Distribution
        The uncertain numbers by their paths, as for :func:`gradient`. They do not depend on each other.
    of : str or iterable of str
        Results, as for :func:`gradient`.
    threads : int, optional
        Worker threads. Default: all cores.

    Returns
    -------
    xarray.Dataset
        For every result ``NAME`` with the dimension ``statistic`` (mean: the result at the means; deviation: the
        standard deviation), and ``NAME_fraction`` with ``uncertain``, the uncertain numbers: the fraction of the
        variance that each brings. The attribute ``note`` says where derivatives on either side of the case differ;
        empty where they do not.

    Raises
    ------
    CaseError
        When the case with the means is refused.
    ValueError
        Without a distribution, and when a result or a number has no derivatives, as for :func:`gradient`.
    RunError
        As for :func:`gradient`.

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
    >>> uncertain = {
    ...     "load[0].normal_force": fretting.Normal(10.0, 0.5),
    ...     "profile.sphere.radius": fretting.Normal(10e-3, 1e-4),
    ... }
    >>> told = fretting.first_order(case, uncertain, of="max_pressure")
    >>> told["max_pressure_fraction"].values.round(2).tolist()
    [0.86, 0.14]
    """
    module = _dataset.module("first_order")
    names, given = texts("of", of), mapping("distributions", distributions)
    if not names or not given:
        raise ValueError("of, distributions: expected at least one result and one uncertain number")
    keys = [text("distributions", key) for key in given]
    described = [of_kind(f"distributions[{key!r}]", given[key], Distribution)._described() for key in keys]
    table = _case.table_from_anywhere(case)
    moments = _core.moments(json.dumps(described))
    for key, (mean, _) in zip(keys, moments, strict=True):
        put(table, key, mean)
    found, near = told(table, names, keys, threads)
    variables: dict[str, Any] = {}
    for name in names:
        row = found[name]
        deviation, fractions = _core.first_order([row[key] for key in keys], [spread for _, spread in moments])
        variables[name] = ("statistic", [row["value"], deviation])
        variables[f"{name}_fraction"] = ("uncertain", fractions)
    dataset: xarray.Dataset = module.Dataset(
        variables,
        coords={"statistic": ["mean", "deviation"], "uncertain": keys},
        attrs={"note": "" if near is None else near_in_words(near)},
    )
    return dataset

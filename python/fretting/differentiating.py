"""Exact sensitivities: what a result depends on, and how much."""

from collections.abc import Iterable

from fretting import _case, _core
from fretting._arguments import texts


def gradient(
    case: _case.CaseLike,
    *,
    of: str | Iterable[str],
    by: str | Iterable[str] = (),
    threads: int | None = None,
) -> dict[str, dict[str, float]]:
    """Differentiate results of a history by numbers of its case, exactly.

    Parameters
    ----------
    case : path, str or mapping
        As for :func:`fretting.run`.
    of : str or iterable of str
        Results: a column of the last increment (``"max_pressure"``), of another (``"increments[7].shift_x"``), or the
        energy of a cycle (``"cycles[0].dissipated_energy"``).
    by : str or iterable of str
        Numbers of the case by their paths: ``"friction.coefficient"``, ``"friction.max_shear"``,
        ``"lower.coatings[0].young"``, ``"lower.substrate.poisson"``, ``"lower.coatings[0].thickness"``,
        ``"profile.sphere.radius"``, ``"load[0].normal_force"``, ``"load[1].tangential_force[0]"``,
        ``"rig.tangential_stiffness"``. Default: all there are.
    threads : int, optional
        Worker threads. Default: all cores.

    Returns
    -------
    dict of str to dict
        For every result its ``"value"``, and its derivatives by path, in the units of the case: of the result on the
        grid that the plan of the case chooses, which does not change with the numbers.

    Raises
    ------
    CaseError
        When the case is refused.
    ValueError
        When a result or a number is not one of the case, or the case is of a kind that is not covered: with wear,
        evolving friction, bulk stress, surfaces that move, or increments in parts.
    RunError
        When the run fails, or the linear equations of an increment are not solved.
    """
    found = _core.gradient(_case.read(case), texts("of", of), texts("by", by), threads)
    return {name: {"value": value, **derivatives} for name, value, derivatives in found}

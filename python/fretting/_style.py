"""The look of figures for a paper, and lengths, forces and stresses on their axes in the units a reader expects."""

import re
from types import TracebackType
from typing import TYPE_CHECKING, Any, Literal, Self

from fretting._arguments import checked, matplotlib, texts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Colours of Okabe and Ito, which the colour-blind can tell apart; reports have the same."""
BLUE, VERMILION, _, _, ORANGE, SKY, _ = PALETTE
OPEN, STICK, PARTIAL, MIXED, SLIP = "#F2F2F2", BLUE, SKY, "#F0E442", ORANGE
"""Colours of no contact, stick, partial slip, the condition between partial and gross slip, slip."""
HEIGHT = 0.75
"""Height of a figure over its width."""
LOOK = {
    "axes.axisbelow": True,
    "axes.formatter.limits": (-3, 4),
    "axes.formatter.use_mathtext": True,
    "axes.labelsize": 8.0,
    "axes.linewidth": 0.6,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 8.0,
    "figure.constrained_layout.use": True,
    "font.family": ["DejaVu Sans"],
    "font.size": 8.0,
    "legend.fontsize": 7.0,
    "legend.frameon": False,
    "lines.linewidth": 1.2,
    "lines.markersize": 3.5,
    "mathtext.fontset": "dejavusans",
    "pdf.fonttype": 42,
    "savefig.dpi": 300.0,
    "xtick.labelsize": 7.0,
    "xtick.major.width": 0.6,
    "ytick.labelsize": 7.0,
    "ytick.major.width": 0.6,
}
"""One font of 8 points, thin lines, 300 dots per inch, letters that stay letters."""

PREFIXES = {"": 0, "G": 9, "M": 6, "k": 3, "c": -2, "m": -3, "u": -6, "µ": -6, "μ": -6, "n": -9}


class Style:
    """A look that holds from now on, or, in a ``with``, until its end."""

    def __init__(self, settings: dict[str, Any]) -> None:
        self._parameters = _parameters()
        self._before = {name: self._parameters[name] for name in settings}
        self._parameters.update(settings)

    def __enter__(self) -> Self:
        """Begin a part with this look."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Restore the look that was before."""
        self._parameters.update(self._before)


def _parameters() -> Any:
    """Return what matplotlib keeps of its look."""
    return matplotlib().rcParams


@checked
def style(name: Literal["paper"] = "paper", *, width: float = 85.0) -> Style:
    """Give figures the look of a paper: one column wide, 300 dots per inch, colours that all readers can tell apart.

    It holds for all figures of matplotlib that are made afterwards; in a ``with`` for those made inside.

    Parameters
    ----------
    name : {"paper"}
        Which look.
    width : float
        Width of a figure [mm], from 20 to 400: 85 for one column of most journals, 170 for two. Height: three quarters.

    Returns
    -------
    Style
        What restores the look before at the end of a ``with``.

    Raises
    ------
    ValueError
        When the width lies elsewhere.

    Examples
    --------
    >>> import fretting.plot
    >>> with fretting.plot.style("paper"):
    ...     ...  # figures of 85 mm

    """
    if not 20.0 <= width <= 400.0:
        raise ValueError(f"width = {width}: from 20 to 400 mm")
    inches = width / 25.4
    cycle = matplotlib().cycler(color=PALETTE)
    return Style({**LOOK, "axes.prop_cycle": cycle, "figure.figsize": (inches, HEIGHT * inches)})


@checked
def scale(axes: "Axes", *units: str) -> "Axes":
    """Write the numbers along axes in other units, and those of a colour bar: what is drawn stays.

    Parameters
    ----------
    axes : matplotlib Axes
        What a function of this module returned, of a case that declares its units.
    *units : str
        Units of SI: ``"um"``, ``"mN"``, ``"MPa"``. Each goes to the axes of its kind.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        When a unit is not known, or no axis has a unit of its kind.

    Examples
    --------
    A loop of a case in mm and N, in um:

    >>> fretting.plot.scale(history.plot_loop(), "um")  # doctest: +SKIP
    """
    for unit in texts("units", units):
        wanted = _power(unit)
        if wanted is None:
            raise ValueError(f"unit {unit!r} is not known: m, N, Pa, J with a prefix, such as 'um', 'mN', 'MPa'")
        if not [axis for axis in _axes_of(axes) if _rewrite(axis, unit, wanted)]:
            raise ValueError(f"{unit!r}: no axis has a unit of its kind; a case declares its units in [units]")
    return axes


def _axes_of(axes: Any) -> list[Any]:
    """Axes along x and y, and those of colour bars that belong to them."""
    bars = [image.colorbar for image in (*axes.images, *axes.collections) if getattr(image, "colorbar", None)]
    return [axes.xaxis, axes.yaxis, *(bar.long_axis for bar in bars)]


def _power(unit: str) -> tuple[str, int] | None:
    """Return the kind of a unit and the power of ten it stands for."""
    for symbol, kind in (("N mm", "J"), ("N m", "J"), ("Pa", "Pa"), ("N", "N"), ("J", "J"), ("m", "m")):
        prefix = unit.removesuffix(symbol)
        if prefix != unit and prefix in PREFIXES:
            return kind, PREFIXES[prefix] - (3 if symbol == "N mm" else 0)
    return None


def _rewrite(axis: Any, unit: str, wanted: tuple[str, int]) -> bool:
    """Write the numbers of one axis in a unit, where its label says that it has one of the same kind."""
    label = axis.get_label_text()
    found = re.search(r"\[([^\]]+)\]", label)
    own = _power(found[1]) if found else None
    if found is None or own is None or own[0] != wanted[0]:
        return False
    power = own[1] - wanted[1]

    def written(value: float, _: int | None = None) -> str:
        scaled = value / 10.0**-power if power < 0 else value * 10.0**power  # powers of ten are exact that way
        return f"{scaled:.10g}".replace("-", "\N{MINUS SIGN}")

    axis.set_major_formatter(matplotlib("matplotlib.ticker").FuncFormatter(written))
    axis.set_label_text(label.replace(found[0], f"[{unit}]"))
    return True

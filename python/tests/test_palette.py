"""One palette in figures, reports and pages, whose colours all readers can tell apart."""

import itertools
import re
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from fretting import _style

ROOT = Path(__file__).resolve().parents[2]
PALETTE_CSS = ROOT / "crates" / "fret-drawing" / "src" / "palette.css"
PAGE_CSS = ROOT / "crates" / "fret-cli" / "src" / "report" / "page.css"

Real = npt.NDArray[np.float64]

SIGHT: dict[str, Real] = {
    "all cones": np.eye(3),
    "without red cones": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "without green cones": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "without blue cones": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}
"""Linear RGB as it is seen (Machado, Oliveira & Fernandes, IEEE Trans. Visualization 15 (2009) 1291, severity 1)."""


def colours(css: str) -> dict[str, str]:
    """Return the colours that a rule of a style sheet names."""
    return {name: colour.lower() for name, colour in re.findall(r"--([\w-]+): (#[0-9a-fA-F]{6});", css)}


def day() -> dict[str, str]:
    return colours(PALETTE_CSS.read_text(encoding="utf-8"))


def night() -> dict[str, str]:
    dark = PAGE_CSS.read_text(encoding="utf-8").partition("prefers-color-scheme: dark")[2].partition("}")[0]
    return {**day(), **colours(dark)}


def linear(colour: str) -> Real:
    """Return the light of a colour of sRGB (IEC 61966-2-1)."""
    parts = np.array([int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)])
    return np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)


def lab(light: Real) -> Real:
    """Return CIE L*a*b* of linear RGB, white D65: a distance of 2.3 is just seen."""
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ light.clip(0, 1)
    relative = xyz / np.array([0.9505, 1.0, 1.089])
    f = np.where(relative > 216 / 24389, np.cbrt(relative), (24389 / 27 * relative + 16) / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours by the definition of WCAG 2."""
    light = sorted(float(linear(colour) @ np.array([0.2126, 0.7152, 0.0722])) for colour in (one, other))
    return (light[1] + 0.05) / (light[0] + 0.05)


def test_figures_reports_and_pages_have_the_same_colours() -> None:
    shown = day()
    lines = [shown[f"c{number}"] for number in range(6)]
    assert lines == [colour.lower() for colour in _style.PALETTE[:6]]
    words = {
        "open": _style.OPEN,
        "stick": _style.STICK,
        "partial": _style.PARTIAL,
        "mixed": _style.MIXED,
        "slip": _style.SLIP,
    }
    assert {name: shown[name] for name in words} == {name: colour.lower() for name, colour in words.items()}
    style = (ROOT / "docs" / "pictures" / "style.mplstyle").read_text(encoding="utf-8")
    cycle = re.search(r"axes.prop_cycle: cycler\('color', \[(.*?)\]\)", style)
    assert cycle and re.findall(r"\w{6}", cycle[1]) == [colour.lstrip("#") for colour in _style.PALETTE]


def test_no_other_colour_is_written_where_pictures_are_drawn() -> None:
    # Only the palette, greys, and paper and ink of a page; viridis is given by its bytes.
    known = {*day().values(), *night().values(), *(colour.lower() for colour in _style.PALETTE)}
    sources = [
        *(ROOT / "crates" / "fret-cli" / "src").rglob("*.css"),
        *(ROOT / "crates" / "fret-cli" / "src").rglob("*.rs"),
    ]
    sources += [
        *(ROOT / "crates" / "fret-cli" / "src").rglob("*.js"),
        *(ROOT / "python" / "fretting").rglob("*.[jp][sy]"),
    ]
    for path in sources:
        for colour in re.findall(r"#([0-9a-fA-F]{6})\b", path.read_text(encoding="utf-8")):
            shade = np.array([int(colour[at : at + 2], 16) for at in (0, 2, 4)])
            assert f"#{colour.lower()}" in known or np.ptp(shade) <= 16, f"{path.relative_to(ROOT)}: #{colour}"


@pytest.mark.parametrize("sight", SIGHT)
@pytest.mark.parametrize("light", [day, night], ids=["by day", "in the dark"])
def test_everybody_can_tell_the_colours_apart(light, sight: str) -> None:  # type: ignore[no-untyped-def]  # noqa: ANN001
    shown = light()
    groups = [[f"c{number}" for number in range(6)], ["open", "stick", "partial", "mixed", "slip"]]
    for names in groups:
        seen = {name: lab(SIGHT[sight] @ linear(shown[name])) for name in names}
        for one, other in itertools.combinations(names, 2):
            # six times what is just seen
            assert np.linalg.norm(seen[one] - seen[other]) > 14.0, f"{one} and {other}"


def test_words_and_first_lines_stand_out_from_the_paper() -> None:
    for shown in (day(), night()):
        assert contrast(shown["ink"], shown["paper"]) > 7.0  # WCAG 2, level AAA
        assert contrast(shown["soft"], shown["paper"]) > 4.5  # level AA
        for name in ("c0", "c1", "c2"):
            assert contrast(shown[name], shown["paper"]) > 3.0, name  # pictures

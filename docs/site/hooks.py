"""What the site does beyond mkdocs: pages nobody listed, links out of the pages, formulas without a network."""

import html
import re
from pathlib import Path
from typing import Any

from latex2mathml.converter import convert

ROOT = Path(__file__).resolve().parents[2]
LINK = re.compile(r"(!?)\[([^\]]*)\]\((\.\./[^)#\s]*)(#[^)]*)?\)")
FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.DOTALL)


def on_config(config: Any) -> Any:  # noqa: ANN401
    """Put pages that stand nowhere in the navigation under "More"."""
    docs = Path(config["docs_dir"])
    listed = set(_pages(config["nav"]))
    excluded = docs / "site"
    found = sorted(path for path in docs.rglob("*.md") if excluded not in path.parents)
    more = [path.relative_to(docs).as_posix() for path in found if path.relative_to(docs).as_posix() not in listed]
    if more:
        config["nav"] = [*config["nav"], {"More": more}]
    return config


def on_page_markdown(markdown: str, page: Any, **_: object) -> str:  # noqa: ANN401
    """Name files outside the pages instead of linking them; they must be there."""
    here = Path(page.file.abs_src_path).parent

    def name(link: re.Match[str]) -> str:
        target = (here / link[3]).resolve()
        if (ROOT / "docs") in target.parents:
            return link[0]
        if not target.exists():
            raise FileNotFoundError(f"{page.file.src_path} links to {link[3]}, which is not there")
        words = "" if link[2].strip("`") == target.relative_to(ROOT).as_posix() else f"{link[2]} "
        return f"{words}(`{target.relative_to(ROOT).as_posix()}`)"

    return LINK.sub(name, markdown)


def on_page_content(content: str, **_: object) -> str:
    """Write formulas as MathML, which browsers draw themselves."""

    def drawn(formula: re.Match[str]) -> str:
        display = "block" if formula[2] == "[" else "inline"
        return convert(html.unescape(formula[3]).strip(), display=display)

    return FORMULA.sub(drawn, content)


def _pages(nav: Any) -> list[str]:  # noqa: ANN401
    if isinstance(nav, str):
        return [nav]
    items = nav.values() if isinstance(nav, dict) else nav
    return [page for item in items for page in _pages(item)]

"""What the site does beyond mkdocs: unlisted pages, links out of the pages, examples to download, formulas without a
network, tutorials as notebooks.
"""

import html
import json
import os
import re
import shutil
from pathlib import Path
from typing import Any

from latex2mathml.converter import convert

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
NOTES = "developers/"
LINK = re.compile(r"(!?)\[([^\]]*)\]\((\.\./[^)#\s]*)(#[^)]*)?\)")
PICTURE = re.compile(r'(<img alt="[^"]*" src="((?:\.\./)?pictures/[\w-]+\.(?:png|svg))" />)')
ROLE = re.compile(r":(?:attr|class|func|meth|mod):<code>(~?)([\w.]+)</code>")
FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.DOTALL)


def on_config(config: Any) -> Any:
    """Put pages that stand nowhere in the navigation under "More", but for developers' notes."""
    docs = Path(config["docs_dir"])
    listed = set(_pages(config["nav"]))
    excluded = docs / "site"
    found = sorted(path for path in docs.rglob("*.md") if excluded not in path.parents)
    places = [path.relative_to(docs).as_posix() for path in found]
    more = [place for place in places if place not in listed and not place.startswith(NOTES)]
    if more:
        config["nav"] = [*config["nav"], {"More": more}]
    return config


def on_page_markdown(markdown: str, page: Any, config: Any, **_: object) -> str:
    """Name files outside the pages instead of linking them, but for examples, which the site has; they must be there."""
    place = page.file.src_path
    search = page.meta.setdefault("search", {})
    if place.startswith((NOTES, "releases/")):  # users search for their own words
        search.setdefault("boost", 0.2)
    if place.startswith(NOTES) and place not in _pages(config["nav"]):
        search["exclude"] = True
    here = Path(page.file.abs_src_path).parent

    def name(link: re.Match[str]) -> str:
        target = (here / link[3]).resolve()
        if (ROOT / "docs") in target.parents:
            return link[0]
        if not target.exists():
            raise FileNotFoundError(f"{page.file.src_path} links to {link[3]}, which is not there")
        if target.is_file() and EXAMPLES in target.parents:
            address = Path(os.path.relpath(target, (ROOT / page.file.src_path).parent))
            return f'<a href="{address.as_posix()}" download>{_as_code(link[2])}</a>'
        words = "" if link[2].strip("`") == target.relative_to(ROOT).as_posix() else f"{link[2]} "
        return f"{words}(`{target.relative_to(ROOT).as_posix()}`)"

    return LINK.sub(name, markdown)


def on_page_content(content: str, page: Any, **_: object) -> str:
    """Write formulas as MathML, which browsers draw themselves, and the names in docstrings as links; offer tutorials as
    notebooks.
    """

    def drawn(formula: re.Match[str]) -> str:
        display = "block" if formula[2] == "[" else "inline"
        written = convert(html.unescape(formula[3]).strip(), display=display)
        return f'<div class="formula">{written}</div>' if display == "block" else written

    content = FORMULA.sub(drawn, content)
    content = ROLE.sub(lambda role: _named(role, content), content)
    # Words that a page is searched by and does not use: `search: { words: ... }` of its head. Found, not shown.
    if words := page.meta.get("search", {}).get("words"):
        content = content.replace("</h1>", f"</h1><p hidden>{html.escape(words)}</p>", 1)
    # A picture opens by itself, as large as it is: on a phone its letters are small.
    content = PICTURE.sub(r'<a href="\2">\1</a>', content)
    if _is_tutorial(page.file.src_path) and "```python" in page.markdown:
        name = Path(page.file.src_path).stem
        content += f'<p><a href="{name}.ipynb" download>This page as a notebook</a></p>'
    return content


def on_post_build(config: Any) -> None:
    """Put the examples beside the pages, and the tutorials as notebooks; the tests run the same snippets."""
    shutil.copytree(EXAMPLES, Path(config["site_dir"]) / EXAMPLES.name, dirs_exist_ok=True)
    for source in sorted((Path(config["docs_dir"]) / "learn").glob("*.md")):
        text = source.read_text(encoding="utf-8")
        if "```python" in text:
            target = Path(config["site_dir"]) / "learn" / f"{source.stem}.ipynb"
            target.write_text(json.dumps(notebook(text), indent=1) + "\n", encoding="utf-8")


def notebook(markdown: str) -> dict[str, Any]:
    """Return a page as a Jupyter notebook: Python snippets as code, case files written, the rest as text.

    It is read away from the site: links into it are words, and figures are those that its own code draws.
    """
    text = re.sub(r"<!-- figure .*?<!-- end -->|<!--.*?-->", "", markdown, flags=re.DOTALL)
    text = re.sub(r"\[([^\]]*)\]\((?![a-z]+:)[^)]*\)", r"\1", text)
    text = re.sub(r"^```toml\n# ([\w.-]+\.toml)\n", r"```python\n%%writefile \1\n", text, flags=re.MULTILINE)
    cells: list[dict[str, Any]] = []
    for number, part in enumerate(re.split(r"^```python\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)):
        if not part.strip():
            continue
        cell: dict[str, Any] = {
            "id": f"cell-{number}",
            "metadata": {},
            "source": part.strip().splitlines(keepends=True),
        }
        if number % 2:
            cells.append({**cell, "cell_type": "code", "execution_count": None, "outputs": []})
        else:
            cells.append({**cell, "cell_type": "markdown"})
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}


def _as_code(words: str) -> str:
    """Return words of a link as HTML: in backticks they are code."""
    plain = html.escape(words.strip("`"))
    return f"<code>{plain}</code>" if words.startswith("`") else plain


def _named(role: re.Match[str], content: str) -> str:
    """Return what a docstring names: a link, if the page has a place for it."""
    name = role[2]
    shown = f"<code>{name.rpartition('.')[2] if role[1] else name}</code>"
    places = [f"fretting.{name}", f"fretting.analytic.{name}", name]
    place = next((place for place in places if f'id="{place}"' in content), None)
    return f'<a href="#{place}">{shown}</a>' if place else shown


def _is_tutorial(path: str) -> bool:
    return path.startswith("learn/")


def _pages(nav: Any) -> list[str]:
    if isinstance(nav, str):
        return [nav]
    items = nav.values() if isinstance(nav, dict) else nav
    return [page for item in items for page in _pages(item)]

"""Print all pages of the site into one PDF: the manual.

    python -m mkdocs build --strict --quiet
    python docs/site/manual.py [--site target/site] [--out target/manual.pdf]

Formulas are MathML, which a browser sets and few other programs do: Chromium prints. Wants ``playwright`` (in the extra
``test``) and a Chromium: that of ``playwright install chromium``, or one on the path. Pages stand in the order of the
menu; links between them lead to places in the PDF; the outline is that of the headings. Developers' notes are left out.
"""

import argparse
import functools
import html
import http.server
import os
import re
import shutil
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).resolve().parents[2]
ARTICLE = re.compile(r"<article[^>]*>(.*?)</article>", re.DOTALL)
LEFT_OUT = ("Developers' notes",)
STYLE = """
@page { size: A4; margin: 18mm 16mm 20mm; }
body { background: #fff; }
.manual { max-width: none; margin: 0; font-size: 9.5pt; --md-code-bg-color: #f5f5f5; }
.manual article { break-before: page; }
.manual h1 { font-size: 20pt; }
.manual .part { break-before: page; font-size: 26pt; padding-top: 60mm; }
.manual pre > code, .manual table code { white-space: pre-wrap; overflow-wrap: anywhere; }
.manual table:not([class]) { display: table; font-size: 7.5pt; overflow: visible; }
.manual table:not([class]) :is(th, td) { min-width: 5em; padding: 2pt 4pt; overflow-wrap: break-word; }
.manual table:not([class]) td:first-child code { white-space: nowrap; }
.manual img { max-height: 105mm; }
.manual td > img[src*="pictures/examples/"] { width: 42mm; }
.manual .contents a { color: inherit; }
.manual .contents li { margin: 0; }
.manual :is(h1, h2, h3, h4) { break-after: avoid; }
.manual :is(figure, img, tr, math) { break-inside: avoid; }
.headerlink, .md-clipboard, a[download$="ipynb"], .md-code__nav { display: none !important; }
"""
FOOT = (
    '<div style="font: 7pt sans-serif; width: 100%; padding: 0 16mm; display: flex; justify-content: space-between">'
    '<span class="title"></span><span class="pageNumber"></span></div>'
)


def menu(items: list[Any], part: str = "") -> Iterator[tuple[str, str, str]]:
    """Give part, title and address of the pages in the order of the menu."""
    for item in items:
        title, what = next(iter(item.items()))
        if title in LEFT_OUT:
            continue
        if isinstance(what, str):
            yield part, title, what.removesuffix(".md") + ".html"
        else:
            yield from menu(what, part or title)


def pages() -> list[tuple[str, str, str]]:
    """Return part, title and address of every page of the manual."""
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    return list(menu(yaml.safe_load(text)["nav"]))


def anchor(address: str, place: str = "") -> str:
    """Return the name of a place of a page, unique in the manual."""
    page = re.sub(r"[^a-z0-9]+", "-", address.removesuffix(".html").lower())
    return f"{page}--{place}" if place else page


def page_in_manual(site: Path, address: str, known: set[str]) -> str:
    """Return the words of a page as part of the manual: names of places are unique, links lead to them."""
    found = ARTICLE.search((site / address).read_text(encoding="utf-8"))
    if found is None:
        raise SystemExit(f"{address}: no article; build the site first")
    folder = Path(address).parent.as_posix()

    def lead(link: re.Match[str]) -> str:
        before, target = link[1], html.unescape(link[2])
        if re.match(r"[a-z]+:", target):
            return link[0]
        page, _, place = target.partition("#")
        whole = os.path.normpath(f"{folder}/{page}") if page else address
        if before == "src":
            return f'src="{whole}"'
        return f'href="#{anchor(whole, place)}"' if whole in known else 'class="away"'

    text = re.sub(r'\b(href|src)="([^"]*)"', lead, found[1])
    text = re.sub(r'\bid="([^"]*)"', lambda name: f'id="{anchor(address, name[1])}"', text)
    return f'<article id="{anchor(address)}">{text}</article>'


def manual(site: Path) -> str:
    """Return all pages as one."""
    listed = pages()
    known = {address for _, _, address in listed}
    front = (site / listed[0][2]).read_text(encoding="utf-8")
    styles = "".join(re.findall(r'<link rel="stylesheet"[^>]*>', front))
    version = re.search(r'^version = "(.*)"', (ROOT / "Cargo.toml").read_text(encoding="utf-8"), re.MULTILINE)
    title = f"fretting {version[1] if version else ''}: manual"
    words, contents, before = [], [], ""
    for part, name, address in listed:
        if part != before:
            words.append(f'<h1 class="part" id="part-{part.lower().replace(" ", "-")}">{part}</h1>')
            contents.append(f"<li><strong>{part}</strong></li>")
            before = part
        contents.append(f'<li><a href="#{anchor(address)}">{html.escape(name)}</a></li>')
        text = page_in_manual(site, address, known)
        # a page inside a part is one level below it in the outline
        words.append(_lowered(text) if part else text)
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>{styles}'
        f"<style>{STYLE}</style></head>"
        f'<body data-md-color-scheme="default" data-md-color-primary="blue-grey"><div class="manual md-typeset">'
        f'<h1>{title}</h1><ul class="contents">{"".join(contents)}</ul>{"".join(words)}</div></body></html>'
    )


def _lowered(text: str) -> str:
    """Return a page whose headings stand one level lower."""
    return re.sub(r"<(/?)h([1-5])\b", lambda found: f"<{found[1]}h{int(found[2]) + 1}", text)


@contextmanager
def served(site: Path) -> Iterator[str]:
    """Serve a folder on this machine while it is printed."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None:  # type: ignore[override]
            """Say nothing."""

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(site))) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


def browser() -> str | None:
    """Return the browser of the machine, where playwright has none of its own."""
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    return next(filter(None, map(shutil.which, names)), None)


def printed(site: Path, out: Path) -> None:
    """Print the manual of a site."""
    from playwright.sync_api import sync_playwright

    file = site / "manual.html"
    file.write_text(manual(site), encoding="utf-8")
    try:
        with sync_playwright() as playwright, served(site) as address:
            own = Path(playwright.chromium.executable_path)
            path = own if own.exists() else browser()
            if path is None:
                raise SystemExit("no browser: playwright install chromium, or a chromium on the path")
            chromium = playwright.chromium.launch(executable_path=path)
            page = chromium.new_page()
            page.goto(f"{address}/{file.name}", wait_until="load", timeout=120_000)
            out.parent.mkdir(parents=True, exist_ok=True)
            page.pdf(
                path=out, prefer_css_page_size=True, outline=True, tagged=True, print_background=True,
                display_header_footer=True, header_template="<span></span>", footer_template=FOOT,
            )  # fmt: skip
            chromium.close()
    finally:
        file.unlink()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--site", type=Path, default=ROOT / "target" / "site")
    parser.add_argument("--out", type=Path, default=ROOT / "target" / "manual.pdf")
    asked = parser.parse_args()
    if not (asked.site / "index.html").exists():
        sys.exit(f"{asked.site}: no site; python -m mkdocs build --strict first")
    printed(asked.site, asked.out)
    print(asked.out)

"""Tables of facts as notebooks show them."""

import html
from collections.abc import Sequence


def html_table(title: str, facts: Sequence[tuple[str, str]]) -> str:
    """Return names and values as a table of HTML."""
    rows = "".join(
        f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
        f"<td style='text-align:left'>{html.escape(value)}</td></tr>"
        for name, value in facts
    )
    return f"<div><strong>{html.escape(title)}</strong><table>{rows}</table></div>"

"""What a person wants to know of a history first, and tables of it as notebooks show them."""

import html
from collections.abc import Sequence
from typing import TYPE_CHECKING

from fretting._meaning import in_units, unit

if TYPE_CHECKING:
    from fretting.history import History


def html_table(title: str, facts: Sequence[tuple[str, str]]) -> str:
    """Return names and values as a table of HTML."""
    rows = "".join(
        f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
        f"<td style='text-align:left'>{html.escape(value)}</td></tr>"
        for name, value in facts
    )
    return f"<div><strong>{html.escape(title)}</strong><table>{rows}</table></div>"


def facts(history: "History") -> list[tuple[str, str]]:
    """Return what a person wants to know first."""
    cells = "a line contact of " * history.is_line + " x ".join(map(str, history.shape))
    facts = [("stages", ", ".join(history.stages)), ("increments", str(len(history))), ("cells", cells)]
    if not history.finished:
        facts.append(("not the whole history", ": ".join(filter(None, (history.status, history.message)))))
    if not len(history):
        return facts
    last = {name: column[-1] for name, column in history.increments.items()}

    def told(name: str) -> str:
        kind = in_units(unit(name), history._units) if history._units else ""
        return f"{last[name]:.6g} {kind}".rstrip()

    facts += [
        ("sliding condition at the end", last["regime"].replace("_", " ")),
        ("normal force", told("normal_force")),
        ("max pressure", told("max_pressure")),
        ("contact area", told("contact_area")),
        ("dissipated energy", told("dissipated_energy")),
        *(
            [("worn volume", told("worn_volume")), ("max wear depth", told("max_worn_depth"))]
            if last["worn_volume"] > 0.0
            else []
        ),
        ("worst residual", f"{history.increments['residual'].max():.1e}"),
    ]
    done = history.cycles
    if len(done["cycle"]):
        ratio, regime = done["energy_ratio"][-1], done["regime"][-1]
        facts.append((f"last of {done['last_cycle'][-1]} cycles", f"{regime.replace('_', ' ')}, ratio {ratio:.3g}"))
    facts += [("warning", f"{fact['message']}; {fact['help']}") for fact in history.warnings]
    kept = history.kept_increments
    fields = ", ".join(history._kept.kept_fields(kept[-1])) if kept else "none"
    return [*facts, (f"fields of {len(kept)} increments", fields)]

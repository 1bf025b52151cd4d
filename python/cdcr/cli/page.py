"""The page that shows all figures with their captions, and the audit."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape
from pathlib import Path
from string import Template

from cdcr.paper._audit import Claim, audit
from cdcr.scenarios import Scenario

RATES = {"theta": "&theta;&#775;", "phi": "&phi;&#775;"}  # with a dot above


def page(drawn: Iterable[Scenario]) -> str:
    """Return the page in HTML; pictures are named relative to it."""
    shown = list(drawn)
    entries = [*map(_entry, shown), '<li><a href="#audit">The claims of the text</a></li>']
    frame = Template(Path(__file__).with_suffix(".html").read_text(encoding="utf-8"))
    return frame.substitute(
        entries="".join(entries),
        figures="\n".join(map(_figure, shown)),
        claims="\n".join(map(_row, audit())),
    )


def _entry(scenario: Scenario) -> str:
    title = escape(scenario.title)
    return f'<li>Fig. {scenario.paper_figure}: <a href="#{scenario.name}">{title}</a></li>'


def _figure(scenario: Scenario) -> str:
    name, title = scenario.name, escape(scenario.title)
    return f"""<figure id="{name}">
<h2>Fig. {scenario.paper_figure}</h2>
<a href="{name}.svg"><img src="{name}.png" alt="{title}" loading="lazy"></a>
<figcaption>
<p>{_typeset(scenario.description)}</p>
<p class="source">{escape(scenario.source)}. <code>cdcr run {name}</code>;
<a href="{name}.png">PNG</a>, <a href="{name}.svg">SVG</a></p>
</figcaption>
</figure>"""


def _typeset(text: str) -> str:
    """Return a text in HTML, with rates of angles and powers as formulae show them."""
    rates = re.sub(r"\b(theta|phi)d\b", lambda rate: RATES[rate[1]], escape(text))
    return re.sub(r"\^(-?\d+)", r"<sup>\1</sup>", rates)


def _row(claim: Claim) -> str:
    cells = (claim.where, claim.claim, claim.computed, claim.verdict)
    return f"<tr>{''.join(f'<td>{_typeset(cell)}</td>' for cell in cells)}</tr>"

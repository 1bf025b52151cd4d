"""The page that shows all figures with their captions, and the audit."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from cdcr.paper._audit import Claim, audit
from cdcr.scenarios import Scenario

PAPER = "https://doi.org/10.46604/ijeti.2020.4422"
STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff;
  max-width: 72rem; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.7rem; line-height: 1.25; }
h2 { font-size: 1.25rem; margin: 0 0 .6rem; }
a { color: #0059a0; }
nav ol { columns: 2; padding-left: 1.2rem; list-style: none; }
figure { margin: 2.8rem 0; padding-top: 1.6rem; border-top: 1px solid #d9d9d9; }
figure img { width: 100%; height: auto; }
figcaption p { max-width: 46rem; margin: .4rem 0; }
.source, .number { color: #666; font-size: .9rem; }
table { border-collapse: collapse; width: 100%; font-size: .95rem; }
th, td { text-align: left; vertical-align: top; padding: .45rem .8rem .45rem 0;
  border-bottom: 1px solid #d9d9d9; }
th { border-bottom: 2px solid #777; }
@media (max-width: 40rem) { nav ol { columns: 1; } }
"""


def page(drawn: Iterable[Scenario]) -> str:
    """Return the page in HTML; pictures are named relative to it."""
    shown = list(drawn)
    claims = audit()
    entries = [_entry(scenario) for scenario in shown]
    entries += ['<li><a href="#audit">The claims of the text</a></li>'] if claims else []
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en">',
        "<head>",
        '<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        "<title>The paper's figures, redrawn by cdcr</title>",
        f"<style>{STYLE}</style>",
        "</head>",
        "<body>",
        "<h1>The paper's figures, redrawn</h1>",
        "<p>Amouri, Mahfoudi, Zaatri: Dynamic Modeling of a Spatial Cable-Driven Continuum Robot "
        f'Using Euler-Lagrange Method, IJETI 2020, <a href="{PAPER}">doi '
        "10.46604/ijeti.2020.4422</a>. Each figure is computed from the paper's equations and its "
        "Table 1; where those do not give what the paper says, the caption tells.</p>",
        f"<nav><ol>{''.join(entries)}</ol></nav>",
        *(_figure(scenario) for scenario in shown),
        _audit(claims) if claims else "",
        "</body>",
        "</html>",
    ]
    return "\n".join(part for part in parts if part) + "\n"


def _entry(scenario: Scenario) -> str:
    title = escape(scenario.title)
    return f'<li>Fig. {scenario.paper_figure}: <a href="#{scenario.name}">{title}</a></li>'


def _figure(scenario: Scenario) -> str:
    name, title = scenario.name, escape(scenario.title)
    return f"""<figure id="{name}">
<h2><span class="number">Fig. {scenario.paper_figure}</span> {title}</h2>
<a href="{name}.svg"><img src="{name}.png" alt="{title}" loading="lazy"></a>
<figcaption>
<p>{escape(scenario.description)}</p>
<p class="source">{escape(scenario.source)}. <code>cdcr run {name}</code>;
<a href="{name}.png">PNG</a>, <a href="{name}.svg">SVG</a></p>
</figcaption>
</figure>"""


def _audit(claims: list[Claim]) -> str:
    columns = ("where", "claim", "computed", "verdict")
    head = "".join(f"<th>{column}</th>" for column in columns)
    rows = (
        "".join(f"<td>{escape(str(getattr(claim, column)))}</td>" for column in columns)
        for claim in claims
    )
    body = "\n".join(f"<tr>{row}</tr>" for row in rows)
    return f"""<section id="audit">
<h2>The claims of the text, against the paper's own equations</h2>
<table>
<thead><tr>{head}</tr></thead>
<tbody>
{body}
</tbody>
</table>
</section>"""

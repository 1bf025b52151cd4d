"""What ``cdcr audit`` does: compute the claims, then print them as a table or as JSON."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from cdcr.cli.run import DelayedBar
from cdcr.paper._audit import CHECKS, Claim, Verdict, audit, tally

# A mark and a colour for each verdict; its word always stands beside them.
MARKS: dict[Verdict, tuple[str, str]] = {
    "holds": ("+", "cyan"),
    "holds in part": ("~", "yellow"),
    "does not hold": ("x", "bold magenta"),
    "cannot be checked": ("?", "dim"),
}
WIDE = 100  # columns of a terminal from which on the sentences stand side by side
_PAPER = "Amouri, Mahfoudi, Zaatri (2020), doi 10.46604/ijeti.2020.4422"


def compute(console: Console) -> list[Claim]:
    """Compute all rows, with a bar where that takes long."""
    with DelayedBar(console, "audit", len(CHECKS)) as bar:
        return audit(progress=bar)


def as_json(claims: Sequence[Claim]) -> str:
    """Return the rows as one JSON array."""
    return json.dumps([claim.as_dict() for claim in claims], indent=2, allow_nan=False)


def print_audit(console: Console, claims: Sequence[Claim]) -> None:
    """Print a row per claim and how many have each verdict."""
    is_wide = console.width >= WIDE
    table = Table(
        title=Text(f"The claims of {_PAPER}, beside what its own equations give"),
        title_justify="left",
        title_style="bold",
        box=SIMPLE_HEAD,
        leading=1,
        expand=True,
    )
    (_wide_rows if is_wide else _narrow_rows)(table, claims)
    console.print(table)
    console.print(_summary(claims))


def _wide_rows(table: Table, claims: Sequence[Claim]) -> None:
    table.add_column("where", width=14)
    table.add_column("the paper says", ratio=2)
    table.add_column("its equations give", ratio=3)
    table.add_column("verdict", width=19)
    for claim in claims:
        table.add_row(_where(claim), Text(claim.claim), Text(claim.computed), _verdict(claim))


def _narrow_rows(table: Table, claims: Sequence[Claim]) -> None:
    table.add_column("where, verdict", width=19)
    table.add_column("what the paper says, and what its equations give", ratio=1)
    for claim in claims:
        left = Text.assemble(_where(claim), "\n", _verdict(claim))
        right = Text.assemble(
            ("Says: ", "bold"), claim.claim, ("\nGives: ", "bold"), claim.computed
        )
        table.add_row(left, right)


def _where(claim: Claim) -> Text:
    errors = f"\n({', '.join(claim.sources)})" if claim.sources else ""
    return Text(f"{claim.where}{errors}")


def _verdict(claim: Claim) -> Text:
    return _marked(claim.verdict, claim.verdict)


def _marked(verdict: Verdict, words: str) -> Text:
    mark, style = MARKS[verdict]
    return Text(f"{mark} {words}", style=style)


def _summary(claims: Sequence[Claim]) -> Text:
    counts: list[Any] = [Text(f"{len(claims)} claims: ", style="bold")]
    for i, (verdict, count) in enumerate(tally(claims).items()):
        counts += [Text(", " if i else ""), _marked(verdict, f"{verdict} {count}")]
    return Text.assemble(*counts)

"""The swing by all integrators: time at equal error, and the figure of error over time."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from peers import PEERS, Peer
from rows import layout
from swing import Swing
from turns import Entry, Spread, measure, over, time_at

ERRORS = (1e-6, 1e-8, 1e-10)
OURS = ("cdcr dop853", "cdcr dopri5", "cdcr adams", "cdcr bdf")
MODULES = {"scikit-sundae": "sksundae"}


def truth(swing: Swing) -> np.ndarray:
    """Bending vectors by cdcr's dop853, after an independent integrator has confirmed them."""
    ours = PEERS[0].prepare(swing)(1e-13)()
    for peer in PEERS:
        if peer.name in ("heyoka Taylor", "SciPy DOP853, NumPy") and installed(peer):
            other = np.abs(peer.prepare(swing)(1e-13)() - ours).max()
            print(
                f"truth: cdcr dop853 at rtol 1e-13; {peer.name} at 1e-13 differs by {other:.1e} rad"
            )
    return ours


def installed(peer: Peer) -> bool:
    """Whether the package of a peer can be imported here."""
    return find_spec(MODULES.get(peer.package, peer.package)) is not None


def entries_of(peer: Peer, swing: Swing, true: np.ndarray) -> list[Entry]:
    """Give an entry for each tolerance."""
    at = peer.prepare(swing)
    entries = []
    for k in peer.exponents:
        run = at(10.0**-k)
        entries.append(Entry(peer.name, 10.0**-k, float(np.abs(run() - true).max()), run))
    return entries


def report(turns: int, figure: Path | None) -> None:
    """Measure, and print the tables."""
    swing = Swing.make()
    print(f"equations beside cdcr's: accelerations differ by {swing.disagreement():.1e} relative")
    true = truth(swing)
    entries: list[Entry] = []
    for peer in PEERS:
        if not installed(peer):
            print(f"{peer.name}: {peer.package} is not installed", file=sys.stderr)
            continue
        entries += entries_of(peer, swing, true)
    measure(entries, turns)
    print(table(entries))
    if figure is not None:
        from figure import draw

        draw(entries, figure)


def table(entries: list[Entry]) -> str:
    """Give times at each error, and their ratio to the best of ours."""
    rows = []
    for name in dict.fromkeys(entry.method for entry in entries):
        mine = [entry for entry in entries if entry.method == name]
        row = [name]
        for error in ERRORS:
            times = [time_at(mine, error, turn) for turn in range(len(mine[0].times))]
            known = [1e3 * t for t in times if t is not None]
            ratio = over(entries, name, OURS, error)
            row += [f"{Spread(known).median:.3g}" if known else "", str(ratio or "")]
        rows.append(row)
    heads = [text for error in ERRORS for text in (f"ms at {error:.0e}", "over our best")]
    return layout(["10 s of one section", *heads], rows)

"""One result of one peer, in a process of its own: first.py NAME FILE, where FILE has the swing."""

from __future__ import annotations

import sys
from pathlib import Path


def main() -> None:
    """Run the peer of that name once at rtol 1e-8."""
    name, file = sys.argv[1:]
    if name == "nothing":
        return
    if name == "numpy":
        import numpy  # noqa: F401

        return
    if name.startswith("SoRoMoX"):
        soromox()
        return
    from peers import PEERS
    from swing import Swing

    peer = next(one for one in PEERS if one.name == name)
    peer.prepare(Swing.load(Path(file)))(1e-8)()


def soromox() -> None:
    """Do the same by a robot of one segment; cdcr, which tells its numbers, is loaded too."""
    import numpy as np
    import soromox_arms
    from part_sections import Pair

    import cdcr

    arm = soromox_arms.robot(1)
    pair = Pair("n = 1", cdcr.Model(arm), soromox_arms.soromox(arm))
    pair.soromox_run(np.array([0.8, 0.0]), np.array([0.0, 1.0]), np.linspace(0.0, 10.0, 101))(1e-8)


if __name__ == "__main__":
    main()

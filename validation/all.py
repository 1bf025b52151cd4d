"""The table of truth, of those sources whose data are in a folder.

    python validation/all.py FOLDER

What each needs there, and where to get it, stands in the README beside this file.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from pathlib import Path

import agotelli
import catheter
import ftdcr
import sorosim
import three_codes
import trunk
from common import Row, show

# What must be in the folder for a source, and its rows.
SOURCES: dict[str, Callable[[Path], list[Row]]] = {
    "sorosim_release": lambda path: sorosim.rows([path], parts=8, order=3),
    "soromox_three_codes": lambda path: three_codes.rows(path, parts=6),
    "ftdcr_v4/train.csv": lambda path: ftdcr.rows(path, None),
    "dataset_CR_dynamics": lambda path: agotelli.rows(path, parts=4),
    "trunk-stack": lambda path: trunk.rows(path, train=5),
    "DeepKoopman_catheter_model/data/catheter_1T_expt_forced_5.1.2": (
        lambda path: catheter.rows(path, "test.txt")
    ),
}


def main() -> None:
    """Print one table; what is missing is told on standard error."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    rows: list[Row] = []
    for name, make in SOURCES.items():
        if (folder / name).exists():
            with redirect_stdout(sys.stderr):  # what the fits say
                rows += make(folder / name)
        else:
            print(f"{folder / name} is not there: see validation/README.md", file=sys.stderr)
    if not rows:
        raise SystemExit(2)
    show(rows)


if __name__ == "__main__":
    main()

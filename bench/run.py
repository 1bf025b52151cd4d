"""Run all benchmarks: the C++ executables, then the Python rows; print a table.

Measures, never passes or fails: targets are shown beside the figures.
"""

from __future__ import annotations

import argparse
import json
import platform
import subprocess
import sys
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING

from rows import append, judged, ratios, real_time, table

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rows import Row

EXECUTABLES = (
    "dynamics",
    "sections",
    "batch",
    "rods",
    "step",
    "statics",
    "inverse_kinematics",
    "startup",
    "runs",
    "estimation",
)


def say(text: str) -> None:
    """Tell how far we are, without disturbing what goes to a file or a pipe."""
    print(text, file=sys.stderr, flush=True)


def cpp_rows(build: Path, quick: bool) -> Iterator[Row]:
    """Rows of the C++ executables."""
    for name in EXECUTABLES:
        say(f"bench_{name}")
        command = [str(build / f"bench_{name}"), *(["--quick"] if quick else [])]
        output = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
        yield from map(json.loads, output.splitlines())


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--build-dir",
        type=Path,
        default=Path("build/bench"),
        help="where CMake built with CDCR_BUILD_BENCH=ON (default: %(default)s)",
    )
    parser.add_argument("--quick", action="store_true", help="a tenth of the samples")
    parser.add_argument("--out", type=Path, help="append the rows to this file as JSON lines")
    arguments = parser.parse_args()
    build = arguments.build_dir / "bench"
    if not (build / "bench_runs").exists():
        parser.error(f"{build} has no bench_runs; build with -DCDCR_BUILD_BENCH=ON")

    # After the arguments: --help needs none of these packages.
    import numpy as np
    import scipy
    from identification_rows import identification_rows
    from python_rows import python_rows
    from scipy_rows import scipy_rows
    from sensitivity_rows import sensitivity_rows

    import cdcr

    quick = arguments.quick
    rows = list(cpp_rows(build, quick))
    built = {key: rows[0][key] for key in ("version", "commit", "compiler", "flags", "cpu")}
    about = {
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "version": cdcr.__version__,
        "cpu": built["cpu"],
    }
    rows += ratios(rows)
    say("Python")
    rows += [{**row, **about} for row in python_rows(quick, build / "bench_runs")]
    rows += [{**row, **about} for row in sensitivity_rows(quick)]
    rows += [{**row, **about} for row in identification_rows(quick)]
    say("SciPy")
    rows += [{**row, **about} for row in scipy_rows(quick)]
    started = datetime.now(timezone.utc).isoformat(timespec="seconds")
    rows = [judged({**row, "run": started}) for row in rows]
    print(table(rows))
    print(*real_time(rows), sep="\n")
    for group in (built, about):
        print(", ".join(f"{key} {value}" for key, value in group.items()))
    if arguments.out:
        append(arguments.out, rows)


if __name__ == "__main__":
    main()

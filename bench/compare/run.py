"""Set cdcr beside other software: processor time at equal error, peers in turn in one process.

    make compare

or, in an environment with what requirements.txt names and cdcr,

    PYTHONPATH=bench python bench/compare/run.py [--quick] [--only PART] [--figure FILE.png]

Parts: swing, sections, rods, start.
"""

from __future__ import annotations

import os

# One thread each, before anything loads NumPy or JAX: processor time is that of all threads.
os.environ.update(
    OMP_NUM_THREADS="1",
    OPENBLAS_NUM_THREADS="1",
    XLA_FLAGS="--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1",
    JAX_PLATFORMS="cpu",
)

import argparse
import platform
import sys
from importlib import import_module, metadata
from pathlib import Path

PARTS = ("swing", "sections", "rods", "start")
PACKAGES = (
    "numpy", "scipy", "numba", "numbalsoda", "heyoka", "casadi", "scikit-sundae", "soromox", "jax",
    "mujoco", "pyelastica",
)  # fmt: skip


def processor() -> str:
    """Name the processor, as Linux does."""
    names = [
        line.partition(": ")[2]
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        if line.startswith("model name")
    ]
    return f"{len(names)} x {names[0]}" if names else platform.processor()


def versions() -> str:
    """Tell what was compared."""
    found = []
    for package in PACKAGES:
        try:
            found.append(f"{package} {metadata.version(package)}")
        except metadata.PackageNotFoundError:
            found.append(f"{package} NOT INSTALLED")
    return ", ".join(found)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="two turns instead of seven")
    parser.add_argument("--only", choices=PARTS, help="one part alone")
    parser.add_argument("--figure", type=Path, help="draw time over error of the swing")
    arguments = parser.parse_args()
    turns = 2 if arguments.quick else 7

    import cdcr

    print(f"cdcr {cdcr.__version__}, {versions()}")
    print(f"Python {platform.python_version()}, {processor()}, load {os.getloadavg()[0]:.1f}")
    for part in PARTS if arguments.only is None else (arguments.only,):
        print(f"\n== {part} ==")
        sys.stdout.flush()
        import_module(f"part_{part}").report(turns, arguments.figure)


if __name__ == "__main__":
    main()

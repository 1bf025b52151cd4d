"""From the start of a process to its first result, imports and compilation included."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage

from part_swing import installed
from peers import PEERS
from rows import layout
from swing import Swing
from turns import Spread

CHOSEN = (
    "cdcr dop853", "cdcr bdf", "CasADi CVODES Adams, SX", "CasADi CVODES Adams, compiled C",
    "heyoka Taylor", "numbalsoda DOP853", "scikit-sundae Adams, numba", "SciPy DOP853, NumPy",
)  # fmt: skip
SLOW = 4.0  # processor time after which a process is not started again [s]


def spent(name: str, file: Path) -> float:
    """Processor time of one process [s]."""
    command = [sys.executable, str(Path(__file__).with_name("first.py")), name, str(file)]
    before = getrusage(RUSAGE_CHILDREN)  # os.times() counts in hundredths of a second
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = getrusage(RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def report(turns: int, figure: Path | None) -> None:
    """Measure in turn, and print the table."""
    names = ["nothing", "numpy"]
    names += [peer.name for peer in PEERS if peer.name in CHOSEN and installed(peer)]
    names += ["SoRoMoX Tsit5"] if find_spec("soromox") else []
    times: dict[str, list[float]] = {name: [] for name in names}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "swing.json")
        Swing.make().save(file)
        warm = {name: spent(name, file) for name in names}  # bytecode, and the disk's cache
        for _ in range(turns):
            for name in names:
                if warm[name] < SLOW:
                    times[name].append(spent(name, file))
    rows = [[name, str(Spread(times[name] or [warm[name]]))] for name in names]
    print(layout(["start to first result", "processor time [s]"], rows))

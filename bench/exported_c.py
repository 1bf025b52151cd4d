"""How many instructions a step of exported C takes, three sections: on x86-64 and on a Cortex-M7.

    python bench/exported_c.py

On x86-64 as callgrind counts (Debian: valgrind), on a Cortex-M7 as QEMU does (gcc-arm-none-eabi,
libnewlib-arm-none-eabi, qemu-system-arm). Of twice as many steps those of the first half are taken
off. What is not installed is left out, with a word.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from rows import layout

HERE = Path(__file__).parent / "exported_c"
STEPS = 100
HZ, RATE = 400e6, 1e3  # of a core, of a loop
TICK = 40  # instructions, see boot.c
M7 = ["-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard", "-nostartfiles"]
BOARD = [
    "-M",
    "mps2-an500",
    "-nographic",
    "-monitor",
    "none",
    "-serial",
    "none",
    "-icount",
    "shift=0",
]
PROGRAMS = {"x86-64": ("gcc", "valgrind"), "Cortex-M7": ("arm-none-eabi-gcc", "qemu-system-arm")}


def output(command: list[str]) -> str:
    """Run a command to its end; return what it wrote."""
    done = subprocess.run(command, check=True, capture_output=True, text=True, timeout=300)
    return done.stdout + done.stderr


def number(pattern: str, text: str) -> int:
    """Return the number that stands where the pattern has it."""
    found = re.search(pattern, text)
    if found is None or int(found[1]) == 0:
        raise RuntimeError(f"no count in {text!r}")
    return int(found[1])


def on_pc(folder: Path, real: str, steps: int) -> int:
    """Instructions of so many steps, start included, by callgrind."""
    program = str(folder / f"pc_{real}")
    sources = [str(HERE / "steps.c"), str(folder / "arm.c")]
    flags = ["-std=c99", "-O3", f"-DARM_REAL={real}", f"-I{folder}"]
    output(["gcc", *flags, *sources, "-o", program])
    callgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    return number(r"Collected : (\d+)", output([*callgrind, program, str(steps)]))


def on_m7(folder: Path, real: str, steps: int) -> int:
    """Instructions of so many steps, start included, by QEMU."""
    program = str(folder / f"m7_{real}")
    sources = [str(HERE / "steps.c"), str(HERE / "boot.c"), str(folder / "arm.c")]
    flags = ["-std=c99", "-O3", f"-DARM_REAL={real}", f"-DSTEPS={steps}", f"-I{folder}", *M7]
    output(["arm-none-eabi-gcc", *flags, *sources, "-T", str(HERE / "memory.ld"), "-o", program])
    host = ["-semihosting-config", "enable=on,target=native"]
    return TICK * number(r"(\d+)", output(["qemu-system-arm", *BOARD, *host, "-kernel", program]))


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.parse_args()
    import cdcr
    from cdcr.export import write_c

    ways: dict[str, Callable[[Path, str, int], int]] = {"x86-64": on_pc, "Cortex-M7": on_m7}
    rows = []
    with TemporaryDirectory() as name:
        folder = Path(name)
        write_c(cdcr.robots.three_sections(), folder, name="arm", overwrite=True)
        for kind, count in ways.items():
            missing = [one for one in PROGRAMS[kind] if shutil.which(one) is None]
            if missing:
                print(f"{kind} is left out: there is no {' and no '.join(missing)}")
                continue
            for real in ("float", "double"):
                step = (count(folder, real, 2 * STEPS) - count(folder, real, STEPS)) / STEPS
                share = 100.0 * step * RATE / HZ
                rows.append(
                    [f"{kind}, {real}", f"{step:,.0f}", f"{share:.1f} to {2 * share:.1f} %"]
                )
    print(layout(["a step", "instructions", "of 400 MHz at 1 kHz, 1 to 2 cycles each"], rows))


if __name__ == "__main__":
    main()

"""How many instructions exported C takes, three sections: on x86-64 and on a Cortex-M7.

A step without and with friction of the cables, and the derivatives of the accelerations.

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
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from rows import layout

HERE = Path(__file__).parent / "exported_c"
STEPS = 20
# What is counted: friction in the holes, and what steps.c and the compiler are told.
WHAT = {
    "a step": (0.0, []),
    "a step with friction": (0.3, []),
    "derivatives": (0.0, ["-DDERIVATIVES", "-fcx-limited-range"]),
}
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


def built(folder: Path, compiler: list[str], told: list[str]) -> str:
    """Compile the steps; return the program."""
    program = str(folder / "program")
    sources = [str(one) for one in (HERE / "steps.c", folder / "arm.c")]
    if "-DDERIVATIVES" in told:
        sources.append(str(folder / "arm_derivatives.c"))
    flags = ["-std=c99", "-O3", f"-I{folder}", *told]
    output([*compiler, *flags, *sources, "-o", program])
    return program


def on_pc(folder: Path, told: list[str], steps: int) -> int:
    """Instructions of so many steps, start included, by callgrind."""
    program = built(folder, ["gcc"], told)
    callgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    return number(r"Collected : (\d+)", output([*callgrind, program, str(steps)]))


def on_m7(folder: Path, told: list[str], steps: int) -> int:
    """Instructions of so many steps, start included, by QEMU."""
    start = [str(HERE / "boot.c"), "-T", str(HERE / "memory.ld"), f"-DSTEPS={steps}"]
    program = built(folder, ["arm-none-eabi-gcc", *M7, *start], told)
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

    ways: dict[str, Callable[[Path, list[str], int], int]] = {"x86-64": on_pc, "Cortex-M7": on_m7}
    rows = []
    robot = cdcr.robots.three_sections()
    for kind, count in ways.items():
        missing = [one for one in PROGRAMS[kind] if shutil.which(one) is None]
        if missing:
            print(f"{kind} is left out: there is no {' and no '.join(missing)}")
            continue
        for what, (friction, told) in WHAT.items():
            sections = [replace(one, cable_friction=friction) for one in robot.sections]
            for real in ("float", "double"):
                with TemporaryDirectory() as name:
                    folder, flags = Path(name), [f"-DARM_REAL={real}", *told]
                    write_c(replace(robot, sections=sections), folder, name="arm")
                    both = [count(folder, flags, steps) for steps in (STEPS, 2 * STEPS)]
                once = (both[1] - both[0]) / STEPS
                share = 100.0 * once * RATE / HZ
                told_share = f"{share:.1f} to {2 * share:.1f} %"
                rows.append([f"{kind}, {what}, {real}", f"{once:,.0f}", told_share])
    print(layout(["what", "instructions", "of 400 MHz at 1 kHz, 1 to 2 cycles each"], rows))


if __name__ == "__main__":
    main()

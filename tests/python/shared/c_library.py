"""Exported C, compiled by the system's compiler and called through ctypes."""

from __future__ import annotations

import ctypes
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cdcr

# As strict as a compiler gets about numbers; all of it in single precision where it is asked for.
FLAGS = ("-std=c99", "-O0", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror")
KINDS = {"double": ctypes.c_double, "float": ctypes.c_float}


class CLibrary:
    """A robot exported under the name "arm" and compiled for one kind of number."""

    def __init__(self, robot: cdcr.Robot, folder: Path, real: str) -> None:
        cdcr.export.write_c(robot, folder, name="arm", overwrite=True)
        shared = folder / f"arm_{real}.so"
        sources = [folder / "arm.c", folder / "arm_derivatives.c"]
        flags = ["-fcx-limited-range", "-shared", "-fPIC", f"-DARM_REAL={real}"]
        subprocess.run(["cc", *FLAGS, *flags, "-o", shared, *sources], check=True)
        self.library = ctypes.CDLL(str(shared))
        self.kind: Any = KINDS[real]
        self.dtype = np.dtype(self.kind)

    def numbers(self, values: Any) -> NDArray[Any]:
        """Values as this library has them."""
        return np.array(values, dtype=self.dtype)

    def call(self, name: str, *arguments: NDArray[Any] | float) -> int:
        """What arm_NAME gives back."""
        passed = [
            self.kind(one) if isinstance(one, float) else one.ctypes.data_as(ctypes.c_void_p)
            for one in arguments
        ]
        return int(getattr(self.library, f"arm_{name}")(*passed))

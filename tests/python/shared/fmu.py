"""An FMU unpacked and loaded by fmpy, version 2 or 3, by the names of its variables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr

fmpy: Any = pytest.importorskip("fmpy", reason="FMUs are tested by fmpy")
fmi2: Any = pytest.importorskip("fmpy.fmi2")
fmi3: Any = pytest.importorskip("fmpy.fmi3")

GRAVITY = (0.3, -0.2, -9.81)


class Fmu:
    """An instance; what it logs is in `messages`."""

    def __init__(self, robot: cdcr.Robot, folder: Path, *, fmi: int = 3, **options: Any) -> None:
        self.fmi = fmi
        self.file = folder / f"robot{fmi}.fmu"
        if not self.file.is_file():
            cdcr.export.write_fmu(robot, self.file, fmi=fmi, **options)
        self.description = fmpy.read_model_description(str(self.file))
        self.reference = {v.name: v.valueReference for v in self.description.modelVariables}
        self.unpacked = folder / f"unpacked {fmi} 100%"
        if not self.unpacked.is_dir():  # a library in use must not be written over
            fmpy.extract(str(self.file), str(self.unpacked))
        self.messages: list[str] = []
        self.slave = self.instantiate(self.description.guid)

    def instantiate(self, token: str) -> Any:
        about = {
            "guid": token,
            "unzipDirectory": str(self.unpacked),
            "modelIdentifier": self.description.coSimulation.modelIdentifier,
            "instanceName": "robot",
        }
        if self.fmi == 3:
            slave = fmi3.FMU3Slave(**about)
            slave.instantiate(logMessage=lambda *said: self.messages.append(said[-1].decode()))
            return slave
        slave = fmi2.FMU2Slave(**about)
        self.callbacks = fmi2.fmi2CallbackFunctions()
        self.callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(
            lambda *said: self.messages.append(said[4].decode())
        )
        slave.instantiate(callbacks=self.callbacks)
        return slave

    def begin(self, values: Mapping[str, float] | None = None, **times: float) -> None:
        """Initialize from time 0, or `startTime` to `stopTime`, with parameters set."""
        self.set(values or {})
        if self.fmi == 2:
            self.slave.setupExperiment(**times)
            self.slave.enterInitializationMode()
        else:
            self.slave.enterInitializationMode(**times)
        self.slave.exitInitializationMode()

    def set(self, values: Mapping[str, float]) -> None:
        write = self.slave.setReal if self.fmi == 2 else self.slave.setFloat64
        write(self.references(list(values)), list(values.values()))

    def get(self, names: Sequence[str]) -> NDArray[np.float64]:
        read = self.slave.getReal if self.fmi == 2 else self.slave.getFloat64
        return np.array(read(self.references(names)), dtype=np.float64)

    def references(self, names: Sequence[str]) -> list[int]:
        return [self.reference[name] for name in names]

    def names(self, kind: str) -> list[str]:
        """Return the variables of a kind, such as all of "q"."""
        return [name for name in self.reference if name.partition("[")[0] == kind]

    def jacobian(self, unknowns: Sequence[str], knowns: Sequence[str]) -> NDArray[np.float64]:
        rows, columns = self.references(unknowns), self.references(knowns)
        by_known = [
            self.slave.getDirectionalDerivative(rows, [column], [1.0]) for column in columns
        ]
        return np.transpose(np.array(by_known, dtype=np.float64))


def upright() -> cdcr.Robot:
    return cdcr.robots.three_sections(gravity=GRAVITY, payload=0.005)

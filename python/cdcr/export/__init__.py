"""Robots for other software: FMUs for co-simulation, MuJoCo models."""

from cdcr.export.fmu import write_fmu
from cdcr.export.mjcf import write_mjcf

__all__ = ["write_fmu", "write_mjcf"]

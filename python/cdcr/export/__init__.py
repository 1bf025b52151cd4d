"""Robots for other software: C for controllers, FMUs for co-simulation, MuJoCo models."""

from cdcr.export.c import write_c
from cdcr.export.fmu import write_fmu
from cdcr.export.mjcf import write_mjcf

__all__ = ["write_c", "write_fmu", "write_mjcf"]

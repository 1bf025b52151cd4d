"""Shapes of tensions that several test files use, and runs under them at the tightest tolerance."""

import math
from typing import Any

import cdcr
from cdcr.scenarios.file.shapes import pulse, ramp, sine, step

# One evaluation of a sum of a few terms near 10 N.
ROUNDING = 1e-14
TIGHT: dict[str, Any] = {"method": "dopri5", "rtol": 1e-12, "atol": 1e-14}

STEP = step(value=5.0, at=0.3)
RAMP = ramp(before=1.0, after=3.0, start=0.5, end=1.0)
PULSE = pulse(value=4.0, start=0.2, end=0.9, base=0.5)
SINE = sine(mean=2.0, amplitude=1.5, frequency=0.5, phase=math.pi / 2, start=0.25)


def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020())

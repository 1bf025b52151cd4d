"""What it costs to identify ten parameters of three sections, from poses and from a motion."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from python_rows import Timed

import cdcr
from cdcr.identification import Motion, Poses

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rows import Row

    from cdcr.base.arrays import FloatArray

NUM_POSES, MINUTE, RATE, NOISE = 443, 60.0, 100.0, 1e-3  # [s], [Hz], [m]
AT_REST = [
    "sections[:].youngs_modulus", "payload", "base tilt", "base position", "tip offset x",
]  # fmt: skip
IN_MOTION = [
    "sections[:].youngs_modulus", "sections[:].damping", "payload", "base tilt", "time shift",
]  # fmt: skip


def robot(stiffer: float) -> cdcr.Robot:
    """Return three damped sections that hang and carry a load."""
    known = cdcr.robots.three_sections(gravity=(0.0, 0.0, 9.81), payload=0.01 * stiffer)
    sections = tuple(
        replace(one, damping=1e-2 * stiffer, youngs_modulus=stiffer * one.youngs_modulus)
        for one in known.sections
    )
    return replace(known, sections=sections)


def seen(tip: FloatArray, draw: np.random.Generator) -> FloatArray:
    """Return places with noise."""
    noisy: FloatArray = tip + draw.normal(0.0, NOISE, tip.shape)
    return noisy


def measured(seconds: float) -> tuple[Poses, Motion]:
    """Return poses, and a motion under tensions that swing at frequencies of their own."""
    draw = np.random.default_rng(14)
    model = cdcr.Model(robot(1.1))
    pulls = draw.uniform(0.0, 4.0, (NUM_POSES, 9)) * (draw.uniform(size=(NUM_POSES, 9)) < 0.5)
    shapes = np.array([model.equilibrium(pull) for pull in pulls])
    poses = Poses(pulls, tip=seen(model.tips(shapes), draw), noise=NOISE)
    t = np.arange(0.0, seconds + 0.5 / RATE, 1.0 / RATE)
    swings = np.sin(2.0 * np.pi * np.outer(t, draw.uniform(0.1, 1.0, 9)) + np.arange(9.0))
    told = 1.0 + swings
    run = cdcr.simulate(model, model.equilibrium(told[0]), np.zeros(6), t=t, command=(t, told))
    return poses, Motion(t, told, tip=seen(run.tip, draw), noise=NOISE)


def identification_rows(quick: bool) -> Iterator[Row]:
    """Both fits, from a robot ten percent softer; `evaluations` of the model each took."""
    poses, motion = measured(MINUTE / 10.0 if quick else MINUTE)
    for data, paths, name in (
        (poses, AT_REST, f"{NUM_POSES} poses"),
        (motion, IN_MOTION, f"{len(motion) - 1} samples of a motion at {RATE:g} Hz"),
    ):
        found: list[cdcr.identification.Identified] = []

        def fit(data: object = data, paths: list[str] = paths, found: list = found) -> None:  # type: ignore[type-arg]
            found.append(cdcr.identify(data, robot(1.0), dict.fromkeys(paths)))  # type: ignore[arg-type]

        times = Timed(fit, 1, 1.0)
        yield times.row(
            f"identify 10 parameters, {name}", "s",
            misfit=found[-1].misfit, evaluations=found[-1].evaluations,
        )  # fmt: skip

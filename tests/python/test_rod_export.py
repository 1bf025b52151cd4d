"""What other software is told of rods: nothing yet; of tubes and given stiffnesses all."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.export.arcs import as_solid_arcs

# A dozen roundings.
REL = 1e-13

ROBOT = cdcr.robots.amouri2020(damping=0.01)
(SECTION,) = ROBOT.sections
HELIX = cdcr.Cable(radius=0.02, angle=[(0.0, 1.0)], end_section=0)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"sections": [replace(SECTION, bending_order=1)]}, "section 1 is more than that"),
        ({"cables": [HELIX]}, "cable 1 of cables does not run so"),
    ],
)
def test_rods_are_refused(change: dict[str, Any], sentence: str, tmp_path: Path) -> None:
    robot = replace(ROBOT, **change)
    with pytest.raises(ValueError, match=f"an FMU can be made .*{sentence}"):
        cdcr.export.write_fmu(robot, tmp_path / "arm.fmu")
    with pytest.raises(ValueError, match=f"a chain of rigid links can be made .*{sentence}"):
        cdcr.export.write_mjcf(robot, tmp_path / "arm.xml")


def test_a_tube_is_told_as_the_solid_arc_that_moves_alike() -> None:
    tube = replace(SECTION, backbone_inner_diameter=0.003, bending_stiffness=0.2)
    robot = replace(ROBOT, sections=(replace(tube, material_damping=0.02),))
    solid = as_solid_arcs(robot, "it")
    assert solid.sections[0].backbone_inner_diameter == 0.0
    q, qd, tension = [0.5, 0.3], [1.0, -2.0], [5.0, 1.0, 0.0]
    found = cdcr.Model(solid).forward_dynamics(q, qd, tension)
    wanted = cdcr.Model(robot).forward_dynamics(q, qd, tension)
    assert np.abs(found - wanted).max() <= REL * np.abs(wanted).max()
    assert as_solid_arcs(ROBOT, "it") == ROBOT

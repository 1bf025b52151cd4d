"""Gravity changed without building a model anew."""

import copy
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr

UP = (0.3, -0.2, 9.0)


@pytest.mark.parametrize("name", ["amouri2020", "three_sections"])
@pytest.mark.parametrize("formulation", ["exact", "taylor"])
def test_it_is_the_model_built_with_that_gravity(name: str, formulation: str) -> None:
    if name != "amouri2020" and formulation != "exact":
        return
    robot = cdcr.robots.get(name)
    old = cdcr.Model(robot, formulation)
    changed = old.with_gravity(np.array(UP))
    built = cdcr.Model(replace(robot, gravity=UP), formulation)
    q = np.linspace(0.1, 0.9, old.num_coordinates)
    for model in (changed, copy.deepcopy(changed)):
        assert model.robot == built.robot
        assert model.formulation == formulation
        np.testing.assert_array_equal(model.potential_gradient(q), built.potential_gradient(q))
        np.testing.assert_array_equal(model.bias(q, q), built.bias(q, q))
        np.testing.assert_array_equal(model.equilibrium(), built.equilibrium())
    before = cdcr.Model(robot, formulation)
    np.testing.assert_array_equal(old.potential_gradient(q), before.potential_gradient(q))


@pytest.mark.parametrize("gravity", [[0.0, 1.0], "down", [0.0, 0.0, np.nan], None])
def test_what_is_no_gravity_is_refused(gravity: Any) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    with pytest.raises(ValueError, match=r"^gravity"):
        model.with_gravity(gravity)

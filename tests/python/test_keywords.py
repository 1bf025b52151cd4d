"""Classes that take keywords say so, and which."""

import inspect
from collections.abc import Callable
from typing import Any

import pytest

import cdcr

MODEL = cdcr.Model(cdcr.robots.amouri2020())
ANY: Any = cdcr  # calls that type checkers refuse too

CASES: dict[str, tuple[Callable[[], object], str]] = {
    "section": (
        lambda: ANY.Section(0.5),
        "Section takes all by keyword, as in Section(length=..., backbone_mass=..., "
        "backbone_diameter=..., youngs_modulus=...), got 0.5 (float) without one. Known: length, ",
    ),
    "robot": (
        lambda: ANY.Robot([]),
        "Robot takes all by keyword, as in Robot(sections=...), got [] (list) without one. "
        "Known: sections, gravity, ",
    ),
    "cable": (
        lambda: ANY.Cable(0.01, angle=0.0),
        "Cable takes all by keyword, as in Cable(radius=..., angle=..., end_section=...), got 0.01",
    ),
    "wrench": (lambda: ANY.Wrench(0), "Wrench takes all by keyword, as in Wrench(section=...), "),
    "scenario": (lambda: ANY.scenarios.Scenario("mine"), "Scenario takes all by keyword, as in "),
    "pid": (
        lambda: ANY.Pid(MODEL, 1.0),
        "Pid takes all but model by keyword, as in Pid(model, kp=...), got 1.0 (float) without "
        "one. Known: model, kp, ki, ",
    ),
    "unknown": (
        lambda: ANY.Section(lenght=0.5),
        "Section has no keyword 'lenght'. Did you mean 'length'? Known: length, backbone_mass, ",
    ),
    "unknown here": (
        lambda: ANY.Robot(sections=[], cable_friction=0.3),
        "Robot has no keyword 'cable_friction'. Section can have it. Known: sections, ",
    ),
    "missing": (
        lambda: ANY.Section(length=0.5, youngs_modulus=1e9),
        "Section lacks backbone_mass, backbone_diameter",
    ),
    "missing beside one by place": (lambda: ANY.Pid(MODEL), "Pid lacks kp"),
    "nothing at all": (lambda: ANY.Pid(), "Pid lacks model, kp"),
}


@pytest.mark.parametrize("name", CASES)
def test_the_sentence_names_the_keywords(name: str) -> None:
    call, sentence = CASES[name]
    with pytest.raises(TypeError) as caught:
        call()
    assert str(caught.value).startswith(sentence)
    assert "\n" not in str(caught.value)


def test_other_errors_of_kind_stay_what_they_are() -> None:
    with pytest.raises(TypeError, match=r"^model must be a cdcr\.Model, got int$"):
        ANY.Pid(1, kp=1.0)


def test_a_signature_lists_the_keywords() -> None:
    assert list(inspect.signature(cdcr.Section).parameters)[:2] == ["length", "backbone_mass"]
    assert list(inspect.signature(cdcr.Pid).parameters)[:2] == ["model", "kp"]


def test_a_class_derived_from_one() -> None:
    class Proportional(cdcr.Pid):
        def __init__(self, model: cdcr.Model) -> None:
            super().__init__(model, kp=1.0)

    assert isinstance(Proportional(MODEL), cdcr.Pid)
    assert Proportional(MODEL).reference.tolist() == [0.0, 0.0]

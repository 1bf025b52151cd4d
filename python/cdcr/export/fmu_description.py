"""modelDescription.xml of an FMU, for FMI 2 and 3."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from xml.etree import ElementTree

from cdcr import _core
from cdcr.export.fmu_variables import Variable

IDENTIFIER = "cdcr_robot"  # also the name of the shared object

_UNITS: dict[str, dict[str, int]] = {
    "1": {},
    "s": {"s": 1},
    "m": {"m": 1},
    "m/s": {"m": 1, "s": -1},
    "m/s2": {"m": 1, "s": -2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "rad/s2": {"rad": 1, "s": -2},
}
_VARIABILITY = {"parameter": "fixed"}  # all else is continuous


def model_description(
    found: Sequence[Variable], *, fmi: int, name: str, about: str, token: str, step: float | None
) -> bytes:
    """Return the XML that tells what is in the FMU."""
    version = {2: "2.0", 3: "3.0"}[fmi]
    root = ElementTree.Element("fmiModelDescription", fmiVersion=version, modelName=name)
    root.set("guid" if fmi == 2 else "instantiationToken", token)
    root.set("description", about)
    root.set("license", "BSD-3-Clause")
    root.set("generationTool", f"cdcr {_core.__version__}")
    root.set("variableNamingConvention", "structured")
    root.append(_co_simulation(fmi, step))
    root.append(_units())
    categories = ElementTree.SubElement(root, "LogCategories")
    ElementTree.SubElement(
        categories, "Category", name="logStatusError", description="why a function failed"
    )
    experiment = {"startTime": "0", "stopTime": "10", "stepSize": "0.01"}
    ElementTree.SubElement(root, "DefaultExperiment", experiment)
    places = {variable.name: i for i, variable in enumerate(found)}
    described = ElementTree.SubElement(root, "ModelVariables")
    for variable in found:
        described.append((_scalar_variable if fmi == 2 else _float64)(variable, places))
    root.append((_structure_2 if fmi == 2 else _structure_3)(found, places))
    ElementTree.indent(root)
    return bytes(ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)) + b"\n"


def _co_simulation(fmi: int, step: float | None) -> ElementTree.Element:
    made = ElementTree.Element("CoSimulation", modelIdentifier=IDENTIFIER)
    state, derivative = ("FMUstate", "") if fmi == 2 else ("FMUState", "s")
    made.set("canHandleVariableCommunicationStepSize", "true")
    made.set("maxOutputDerivativeOrder", "1")
    made.set(f"canGetAndSet{state}", "true")
    made.set(f"canSerialize{state}", "true")
    made.set(f"providesDirectionalDerivative{derivative}", "true")
    if fmi == 3:
        made.set("providesAdjointDerivatives", "true")
        if step is not None:
            made.set("fixedInternalStepSize", repr(step))
    return made


def _units() -> ElementTree.Element:
    made = ElementTree.Element("UnitDefinitions")
    for name, powers in _UNITS.items():
        unit = ElementTree.SubElement(made, "Unit", name=name)
        base = {one: str(power) for one, power in powers.items()}
        ElementTree.SubElement(unit, "BaseUnit", base)
        if name == "rad":
            degree = {"name": "deg", "factor": repr(math.degrees(1.0))}
            ElementTree.SubElement(unit, "DisplayUnit", degree)
    return made


def _about(variable: Variable) -> dict[str, str]:
    return {
        "name": variable.name,
        "description": variable.description,
        "causality": variable.causality,
        "variability": _VARIABILITY.get(variable.causality, "continuous"),
    }


def _value(variable: Variable) -> dict[str, str]:
    value = {"unit": variable.unit}
    if variable.causality == "input":
        value["min"] = "0"
    if variable.start is not None:
        value["start"] = repr(variable.start)
    return value


def _float64(variable: Variable, places: Mapping[str, int]) -> ElementTree.Element:
    made = ElementTree.Element("Float64", _about(variable))
    made.set("valueReference", str(places[variable.name]))
    made.attrib |= _value(variable)
    if variable.state:
        made.set("derivative", str(places[variable.state]))
    return made


def _scalar_variable(variable: Variable, places: Mapping[str, int]) -> ElementTree.Element:
    made = ElementTree.Element("ScalarVariable", _about(variable))
    made.set("valueReference", str(places[variable.name]))
    real = ElementTree.SubElement(made, "Real", _value(variable))
    if variable.state:
        real.set("derivative", str(places[variable.state] + 1))  # counts from 1
    return made


def _structure_3(found: Sequence[Variable], places: Mapping[str, int]) -> ElementTree.Element:
    made = ElementTree.Element("ModelStructure")

    def add(kind: str, variable: Variable) -> None:
        on = [str(places[name]) for name in variable.depends_on]
        reference = {"valueReference": str(places[variable.name])}
        if kind != "InitialUnknown":  # those depend on the parameters too
            reference["dependencies"] = " ".join(on)
        ElementTree.SubElement(made, kind, reference)

    for variable in _outputs(found):
        add("Output", variable)
    for variable in _derivatives(found):
        add("ContinuousStateDerivative", variable)
    for variable in _unknowns(found):
        add("InitialUnknown", variable)
    return made


def _structure_2(found: Sequence[Variable], places: Mapping[str, int]) -> ElementTree.Element:
    made = ElementTree.Element("ModelStructure")
    kinds = {
        "Outputs": _outputs(found),
        "Derivatives": _derivatives(found),
        "InitialUnknowns": _unknowns(found),
    }
    for kind, unknowns in kinds.items():
        listed = ElementTree.SubElement(made, kind)
        for variable in unknowns:
            unknown = ElementTree.SubElement(listed, "Unknown")
            unknown.set("index", str(places[variable.name] + 1))
            if kind != "InitialUnknowns":
                on = [str(places[name] + 1) for name in variable.depends_on]
                unknown.set("dependencies", " ".join(on))
    return made


def _outputs(found: Sequence[Variable]) -> list[Variable]:
    return [variable for variable in found if variable.causality == "output"]


def _derivatives(found: Sequence[Variable]) -> list[Variable]:
    return [variable for variable in found if variable.state]


def _unknowns(found: Sequence[Variable]) -> list[Variable]:
    return [variable for variable in found if variable.depends_on]

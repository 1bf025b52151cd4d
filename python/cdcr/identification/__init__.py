"""Identification: parameters of a robot from measurements of it, with their uncertainty."""

from cdcr.identification.crossing import CrossValidation
from cdcr.identification.design import Design, informative_commands
from cdcr.identification.fit import identify as identify
from cdcr.identification.frequencies import Frequencies
from cdcr.identification.motions import Motion
from cdcr.identification.parameter import Parameter
from cdcr.identification.poses import Poses
from cdcr.identification.result import Identified

__all__ = [
    "CrossValidation",
    "Design",
    "Frequencies",
    "Identified",
    "Motion",
    "Parameter",
    "Poses",
    "informative_commands",
]

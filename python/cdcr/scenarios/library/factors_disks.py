"""Translation of the disks: H5 and H6 (Fig. 4)."""

from cdcr.scenarios.library._factors import factor_scenario

SCENARIO = factor_scenario(
    name="factors-disks",
    number=4,
    pair=("H5", "H6"),
    title="Translation of the disks: H₅ and H₆",
    description=(
        "H5 belongs to thetad^2 and H6 to phid^2 in the disks' kinetic energy of translation, "
        "eq. (15), summed over ten disks. The printed eqs. (27) and (28) give exactly half of what "
        "eq. (15) needs; (28) also lacks a cosine, put back here."
    ),
    remarks="eqs. (27), (28) print half of what (15) needs",
)

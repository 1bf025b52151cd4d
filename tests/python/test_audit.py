"""The audit of the origin paper: its numbers to the digits they are known to, and its verdicts."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from dataclasses import FrozenInstanceError
from decimal import Decimal

import pytest

import cdcr
from cdcr.paper import Claim, audit
from cdcr.paper._audit import CHECKS, VERDICTS, tally

# Of what must be equal but is computed in two ways: some hundred roundings.
ROUNDING = 1e-11

HOLDS, IN_PART, NOT, UNKNOWN = VERDICTS

# Names in the order of the paper, with their verdicts.
VERDICT_OF = {
    "real-time": UNKNOWN,
    "more-sections": IN_PART,
    "singularities": IN_PART,
    "constant-curvature": IN_PART,
    "friction": UNKNOWN,
    "torsion": UNKNOWN,
    "kinematics": HOLDS,
    "angular-velocity": IN_PART,
    "backbone-translation": HOLDS,
    "backbone-taylor": HOLDS,
    "material-range": UNKNOWN,
    "backbone-range": IN_PART,
    "backbone-rotation": NOT,
    "moment-of-inertia": HOLDS,
    "table-1": IN_PART,
    "superposed-curves": IN_PART,
    "kinetic-energy-terms": IN_PART,
    "gravity-ratio": NOT,
    "gravity-neglected": NOT,
    "elastic-energy": HOLDS,
    "generalised-forces": HOLDS,
    "two-cables": HOLDS,
    "velocity-order": NOT,
    "missing-fractions": NOT,
    "coefficients": HOLDS,
    "free-oscillation": NOT,
    "sample-step": UNKNOWN,
    "step-tension": NOT,
    "step-oscillation": IN_PART,
    "step-orientation": HOLDS,
    "two-tensions": UNKNOWN,
    "numerical-derivatives": UNKNOWN,
    "circle-tracking": HOLDS,
    "plane-tracking": IN_PART,
    "pid-gains": UNKNOWN,
    "pid-damping": IN_PART,
    "comparison": UNKNOWN,
    "simple-expressions": UNKNOWN,
    "disk-diameter": NOT,
    "turning-with-theta": NOT,
    "turning-with-phi": HOLDS,
    "disk-translation": NOT,
    "missing-cosine": NOT,
}

# The errors of the paper and the rows that show them.
ROW_OF_ERROR = {
    "E1": "velocity-order",
    "E2": "missing-fractions",
    "E3": "disk-translation",
    "E4": "turning-with-theta",
    "E5": "backbone-rotation",
    "E6": "missing-cosine",
    "E7": "angular-velocity",
    "E8": "disk-diameter",
}

# Numbers found by hand, by computer algebra or at 40 digits from the paper's equations; each is
# good to half a unit of its last digit.
KNOWN = {
    "table-1": {"ei": "0.291456", "stiffness": "0.363412", "i_xx": "8.2e-7", "mass": "0.1146"},
    "backbone-translation": {"h1_straight": "0.15"},
    "missing-fractions": {"m11_printed": "4.8186e-3", "m22_printed_over_square": "5.8670e-3"},
    "disk-translation": {"h5_printed_straight": "0.316663", "h5_straight": "0.633325"},
    "turning-with-theta": {"h3": "0.33333333", "h7": "3.85"},
    "disk-diameter": {"i_xx": "8.2e-7"},
    "superposed-curves": {
        "h1_percent": "0.045",
        "h2_percent": "-12",
        "h4_percent": "-41",
        "h6_percent": "-14",
        "h8_percent": "-51",
    },
    "kinetic-energy-terms": {
        "h1_percent": "0.045",
        "m11_percent": "0.056",
        "m11_printed_percent": "0.056",
        "m22_percent": "-13.8",
        "m22_printed_percent": "-12.6",
    },
    "gravity-ratio": {"straight_percent": "23.8", "edge_percent": "21.0"},
    "gravity-neglected": {
        "standing_degrees": "19.7",
        "hanging_degrees": "12.1",
        "weightless_degrees": "15.0",
    },
    "free-oscillation": {
        "frequency": "9.096",
        "period": "0.691",
        "damping": "9.12e-4",
        "damping_ratio": "0.0114",
    },
    "step-tension": {"degrees": "14.978", "excess_percent": "3.7", "modulus_gpa": "9.162"},
    "step-oscillation": {"lowest": "0.00", "highest": "29.96"},
    "two-tensions": {"theta_degrees": "14.978", "phi_degrees": "60.000"},
    "circle-tracking": {
        "turns": "1.0000",
        "peak_1": "5.754",
        "peak_2": "5.754",
        "peak_3": "5.754",
        "start_1": "4.984",
    },
    "plane-tracking": {
        "time": "2.40000",
        "tension_1": "41.6",
        "tension_2": "20.8",
        "tension_3": "0.0",
        "degrees_at_10": "450.000",
    },
    "pid-gains": {"degree_final": "13.9", "degree_lowest_tension": "-1.3", "moment_final": "13.8"},
    "pid-damping": {
        "degree_final": "15.53",
        "degree_settled": "0.44",
        "radian_final": "15.53",
        "radian_settled": "4.6",
        "radian_peak": "27.4",
    },
    "constant-curvature": {
        "one_section": "9.10",
        "beam": "7.279",
        "first_1_percent": "25",
        "first_2_percent": "4.75",
        "first_3_percent": "2.05",
        "first_4_percent": "1.14",
        "first_5_percent": "0.73",
        "first_8_percent": "0.28",
        "second_4_percent": "8.7",
        "second_8_percent": "2.0",
    },
}


@pytest.fixture(scope="module")
def claims() -> dict[str, Claim]:
    return {claim.name: claim for claim in audit()}


def test_rows_and_verdicts_in_the_order_of_the_paper(claims: dict[str, Claim]) -> None:
    assert [(name, claim.verdict) for name, claim in claims.items()] == list(VERDICT_OF.items())
    assert len(claims) == len(CHECKS)


def test_each_known_error_has_its_row(claims: dict[str, Claim]) -> None:
    found = {error: name for name, claim in claims.items() for error in claim.sources}
    assert found == ROW_OF_ERROR


@pytest.mark.parametrize(
    ("name", "key", "digits"),
    [(name, key, digits) for name, row in KNOWN.items() for key, digits in row.items()],
)
def test_numbers_to_the_digits_known(
    claims: dict[str, Claim], name: str, key: str, digits: str
) -> None:
    exponent = Decimal(digits).as_tuple().exponent
    assert isinstance(exponent, int)
    half = 0.5 * 10.0**exponent
    assert claims[name].values[key] == pytest.approx(float(digits), rel=0.0, abs=half * 1.0001)


def test_what_is_right_is_right_to_rounding(claims: dict[str, Claim]) -> None:
    for name, keys in {
        "kinematics": ("integral_gap", "pose_gap", "straight_gap"),
        "backbone-translation": ("h1_gap", "h2_gap"),
        "backbone-taylor": ("difference",),
        "moment-of-inertia": ("worst_gap",),
        "elastic-energy": ("energy_gap",),
        "generalised-forces": ("gap_19",),
        "coefficients": ("worst_gap", "m12"),
        "turning-with-phi": ("worst_gap",),
        "turning-with-theta": ("slip_gap",),
        "step-orientation": ("sideways",),
        "more-sections": ("fit_error", "least_in_angles"),
    }.items():
        for key in keys:
            assert abs(claims[name].values[key]) < ROUNDING, (name, key)


def test_energy_is_kept_only_in_the_mended_order(claims: dict[str, Claim]) -> None:
    values = claims["velocity-order"].values
    assert values["printed_percent"] > 10.0
    assert values["mended_percent"] < 1e-3  # what Runge-Kutta loses at that step
    assert claims["free-oscillation"].values["energy_drift_percent"] < 1e-5  # what dopri5 loses


def test_printed_disks_are_half(claims: dict[str, Claim]) -> None:
    values = claims["disk-translation"].values
    assert values["ratio_min"] == pytest.approx(0.5, rel=ROUNDING)
    assert values["ratio_max"] == pytest.approx(0.5, rel=ROUNDING)


def test_mended_inertia_does_not_depend_on_direction(claims: dict[str, Claim]) -> None:
    values = claims["missing-fractions"].values
    assert values["m11"] == pytest.approx(values["m22_over_square"], rel=ROUNDING)


def test_spin_of_the_frame(claims: dict[str, Claim]) -> None:
    values = claims["angular-velocity"].values
    assert values["spin"] == pytest.approx(math.cos(cdcr.taylor_range) - 1.0, abs=1e-8)
    assert values["spin_of_bending"] == pytest.approx(0.0, abs=1e-8)  # by differences
    assert 0.0 < values["share_of_m22_percent"] < 0.5


def test_damping_that_settles_settles(claims: dict[str, Claim]) -> None:
    # The envelope is that of small motion and crosses the band between two swings.
    period = claims["free-oscillation"].values["period"]
    settled = claims["free-oscillation"].values["settled_with_damping"]
    assert settled == pytest.approx(37.68, abs=period / 2.0)


def test_radian_reading_stays_far_away(claims: dict[str, Claim]) -> None:
    # The integral creeps on for an hour; without it 2.8 r/(K + 2.8 r) of the way is made.
    r, K = 0.019, claims["table-1"].values["stiffness"]
    without = 15.53 * 2.8 * r / (K + 2.8 * r)
    assert without < claims["pid-gains"].values["radian_final"] < 2.1


def test_cables_outside_their_sector_would_push(claims: dict[str, Claim]) -> None:
    values = claims["two-cables"].values
    assert values["least_inside"] == pytest.approx(0.0, abs=1e-12)
    assert values["lowest_outside"] < -1.0
    assert values["least_of_three"] >= 0.0


def test_two_and_three_digit_closed_forms(claims: dict[str, Claim]) -> None:
    # (sin(x)/x)^2 at x = half the angle per step, and the tension along the bisector.
    half = math.pi / 5.0 * 0.2 / 2.0
    error = 100.0 * (1.0 - (math.sin(half) / half) ** 2)
    found = claims["numerical-derivatives"].values["acceleration_error_percent"]
    assert found == pytest.approx(error, rel=1e-9)
    material = claims["material-range"].values
    assert material["tension"] == pytest.approx(0.363412 * 0.6 * math.pi / 0.019, rel=1e-5)
    assert material["strain_percent"] == pytest.approx(100 * 0.0025 * 0.6 * math.pi / 0.802)


def test_friction_takes_one_per_cent(claims: dict[str, Claim]) -> None:
    values = claims["friction"].values
    z = values["at_edge"] * cdcr.taylor_range
    assert -math.expm1(-z) / z == pytest.approx(0.99, rel=ROUNDING)
    assert values["at_step"] > values["at_edge"]


def test_exact_factors_run_far_faster_than_real_time(claims: dict[str, Claim]) -> None:
    assert min(claims["real-time"].values.values()) > 10.0


def test_polar_inertia_is_singular_where_that_in_q_is_not(claims: dict[str, Claim]) -> None:
    values = claims["more-sections"].values
    assert values["least_in_q"] == pytest.approx(0.25, rel=1e-6)  # (l/2)^2, by differences
    assert values["degree"] < 12


def test_every_row_says_something_with_its_numbers(claims: dict[str, Claim]) -> None:
    for claim in claims.values():
        for sentence in (claim.where, claim.claim, claim.computed):
            assert sentence
            assert sentence.isascii()
        assert claim.computed.endswith("."), claim.name
        assert claim.values
        assert all(math.isfinite(value) for value in claim.values.values()), claim.name
        assert any(character.isdigit() for character in claim.computed)
    for name, digits in {
        "step-tension": "14.978",
        "gravity-ratio": "23.8 %",
        "missing-fractions": "5.8670e-03",
        "circle-tracking": "5.754",
        "kinetic-energy-terms": "-13.8 %",
        "constant-curvature": "+4.75 %",
    }.items():
        assert digits in claims[name].computed


def test_numbers_are_computed_and_not_typed_in(
    claims: dict[str, Claim], monkeypatch: pytest.MonkeyPatch
) -> None:
    # Twice the pull: every number of the row follows.
    from cdcr.paper.claims import response

    monkeypatch.setattr(response, "PULL", 10.0)
    doubled = response.step_tension()
    assert doubled.values["degrees"] == pytest.approx(2 * claims["step-tension"].values["degrees"])
    assert "29.956 deg" in doubled.computed
    monkeypatch.setattr(response, "PRINTED_ANGLE", doubled.values["degrees"])
    assert response.step_tension().verdict == HOLDS


def test_progress_counts_the_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    from cdcr.paper import _audit

    monkeypatch.setattr(_audit, "CHECKS", CHECKS[-3:])
    told: list[int] = []
    assert len(audit(progress=told.append)) == 3
    assert told == [1, 2, 3]


def test_tally_counts_every_verdict(claims: dict[str, Claim]) -> None:
    counts = tally(claims.values())
    assert list(counts) == list(VERDICTS)
    assert sum(counts.values()) == len(claims)
    assert all(counts[v] == list(VERDICT_OF.values()).count(v) for v in VERDICTS)


def test_claims_are_frozen_and_go_into_json(claims: dict[str, Claim]) -> None:
    claim = claims["step-tension"]
    with pytest.raises(FrozenInstanceError):
        claim.verdict = HOLDS  # type: ignore[misc]
    row = json.loads(json.dumps(claim.as_dict()))
    assert list(row) == ["name", "where", "claim", "computed", "verdict", "values", "sources"]
    assert row["values"] == claim.values


def test_the_audit_is_loaded_only_when_asked_for() -> None:
    code = (
        "import sys, cdcr.paper; assert 'cdcr.paper._audit' not in sys.modules; "
        "from cdcr.paper import audit, Claim; assert 'cdcr.paper._audit' in sys.modules; "
        "assert 'scipy' not in sys.modules and 'rich' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_unknown_names_of_the_package_are_refused() -> None:
    with pytest.raises(AttributeError, match=r"'cdcr\.paper' has no attribute 'audits'"):
        _ = cdcr.paper.audits

"""``cdcr audit``: table and JSON, and that it is a report, not a test that fails."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("typer")

from rich.console import Console

from cdcr.cli import audit as cli_audit
from cdcr.paper import Claim, audit
from cdcr.paper._audit import VERDICTS
from command import cdcr_


@pytest.fixture(scope="module")
def claims() -> list[Claim]:
    return audit()


@pytest.fixture
def quick(claims: list[Claim], monkeypatch: pytest.MonkeyPatch) -> list[Claim]:
    """Have the command print rows that are computed already."""
    monkeypatch.setattr(cli_audit, "audit", lambda progress: claims)
    return claims


def printed(claims: list[Claim], width: int, *, colour: bool = False) -> str:
    console = Console(width=width, force_terminal=colour, color_system="256" if colour else None)
    with console.capture() as capture:
        cli_audit.print_audit(console, claims)
    return capture.get()


def words(text: str) -> set[str]:
    return set(text.split())


def test_json_is_one_array_with_all_rows() -> None:
    result = cdcr_("audit", "--json")
    assert result.exit_code == 0
    assert result.stderr == ""
    rows = json.loads(result.stdout)
    assert len({row["name"] for row in rows}) == len(rows) > 40
    assert {row["verdict"] for row in rows} == set(VERDICTS)
    (step,) = (row for row in rows if row["name"] == "step-tension")
    assert step["values"]["degrees"] == pytest.approx(14.978, abs=5e-4)


def test_table_has_every_row_and_a_summary(quick: list[Claim]) -> None:
    result = cdcr_("audit")
    assert result.exit_code == 0
    assert result.stderr == ""
    said = words(result.stdout)
    for claim in quick:
        missing = words(f"{claim.where} {claim.claim} {claim.computed} {claim.verdict}") - said
        assert not missing, claim.name
    assert f"{len(quick)} claims: + holds" in result.stdout


@pytest.mark.parametrize("width", [80, 120])
def test_lines_fit_the_terminal_and_nothing_is_cut(claims: list[Claim], width: int) -> None:
    text = printed(claims, width)
    assert max(map(len, text.splitlines())) <= width
    assert "…" not in text
    for claim in claims:
        assert words(claim.computed) <= words(text), claim.name


@pytest.mark.parametrize("width", [80, 120])
def test_verdicts_are_marked_by_sign_and_word(claims: list[Claim], width: int) -> None:
    text = printed(claims, width)
    for verdict, (mark, _) in cli_audit.MARKS.items():
        count = sum(claim.verdict == verdict for claim in claims)
        assert text.count(f"{mark} {verdict}") >= count > 0
    assert len({mark for mark, _ in cli_audit.MARKS.values()}) == len(VERDICTS)
    assert set(cli_audit.MARKS) == set(VERDICTS)


def test_colour_on_a_terminal_only(claims: list[Claim]) -> None:
    assert "\x1b[" not in printed(claims, 80)
    assert "\x1b[36m+ holds" in printed(claims, 80, colour=True)


@pytest.mark.parametrize("flag", ["--help", "-h"])
def test_help(flag: str) -> None:
    result = cdcr_("audit", flag)
    assert result.exit_code == 0
    assert "--json" in result.stdout
    assert "Exit code 0" in " ".join(result.stdout.split())


@pytest.mark.parametrize("args", [["--xml"], ["step-tension"]])
def test_unknown_options_are_mistakes(args: list[str]) -> None:
    result = cdcr_("audit", *args)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert args[0] in result.stderr


def test_interrupted(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(progress: object) -> list[Claim]:
        raise KeyboardInterrupt

    monkeypatch.setattr(cli_audit, "audit", interrupted)
    result = cdcr_("audit")
    assert result.exit_code == 130
    assert result.stderr.startswith("cdcr: interrupted")

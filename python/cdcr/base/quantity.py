"""What the fields of a description say about themselves."""

from __future__ import annotations


def quantity(about: str, unit: str, wanted: str, *, rare: bool = False) -> dict[str, object]:
    """Say what a field is, for refusals and for the comments in robot files.

    A `rare` field stands in files and tables only where it differs from its default.
    """
    return {"about": about, "unit": unit, "wanted": wanted, "rare": rare}

"""Where the numbers of the paper's scenarios come from."""


def source(where: str) -> str:
    """Return the citation of a place in the origin paper."""
    return f"Amouri, Mahfoudi, Zaatri (2020), {where}, doi 10.46604/ijeti.2020.4422"

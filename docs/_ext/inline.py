"""Formulas within the sentences and tables of cpp/*.md, as TeX between dollars.

What cannot be told from words (most `a` and `A` by themselves), code, links and units stay as
they are.
"""

from __future__ import annotations

import re

from typeset import GREEK, FormulaError, formula

COLUMNS = ("symbol", "bracket", "function", "coefficient")  # of tables, that hold formulas alone
UNITS = ("name in code", "not")  # and that hold none
SCRIPTS = r"(?:_(?:\w+(?:,[a-z]+)?|[-+]|\([^()]*\))|\^(?:-?\w+|\([^()]*\))|'+|\*(?!\*))*"
NAME = re.compile(
    rf"(?:(?:{'|'.join(GREEK)})d{{0,2}}|[qxlV]d{{1,2}}|d(?:[a-zA-Z]|qd|Pi)|M\d\d|[cCHhkq]\d|[A-Za-z])(?![A-Za-z\d])"
    rf"{SCRIPTS}(?!\w|-\w|\+\+)"
)
FUNCTION = re.compile(r"(?:sin|cos|tanh|coth|exp|sum|int)(?:[_^]\w+?)*\s(?=\S)")
NUMBER = re.compile(r"\d+!?(?!\w|[.,]\d)")
SIZE = re.compile(r"\|([^|]+)\|(?:\^\d)?")
OPERATOR = re.compile(
    r"/|\.(?=[A-Za-z])|\s(?:<-|<=|>=|[-+=<>])\s|\sx\s(?=[\w(]+)|\s(?!x\s)|(?<=\))(?=\()"
)
STRONG = re.compile(rf"{'|'.join(GREEK)}|[_^'=/.<>]|[A-Za-z]d\b|\bM\d|\b[cHq]\d|\(|sin|cos")
WORD = re.compile(r"[aA]")  # a letter that is a word too, but not before these:
LISTED = re.compile(r",|\sand [A-Zb]\b")
KEPT = re.compile(
    r"^#[^\n]*|^```.*?^```$|`[^`]*`|!?\[[^\]]*\]\([^)]*\)|\[(?!u\])[^\]]*\]|https?://\S+|e\.g\.|i\.e\."
    r"|\b[\w/]+\.(?:md|py|cpp)\b",
    re.MULTILINE | re.DOTALL,
)


def _operand(text: str, place: int) -> int:
    """Return where the operand at a place ends; the place itself where there is none."""
    if match := FUNCTION.match(text, place):
        end = _operand(text, match.end())
        return end if end > match.end() else place
    if match := NAME.match(text, place):
        return _bracket(text, match.end(), match.end())
    if match := NUMBER.match(text, place):
        return match.end()
    if re.match(r"-[\w(]", text[place : place + 2]):
        end = _operand(text, place + 1)
        return end if end > place + 1 else place
    if match := SIZE.match(text, place):
        return match.end() if _expression(match[1], 0) == len(match[1]) else place
    return _bracket(text, place, place)


def _bracket(text: str, place: int, without: int) -> int:
    if text[place : place + 1] != "(":
        return without
    end = _expression(text, place + 1)
    while end > place + 1 and text[end : end + 2] == ", ":
        after = _expression(text, end + 2)
        if after == end + 2:
            return without
        end = after
    if end == place + 1 or text[end : end + 1] != ")":
        return without
    scripts = re.compile(SCRIPTS).match(text, end + 1)
    return scripts.end() if scripts else end + 1


def _expression(text: str, start: int) -> int:
    place = _operand(text, start)
    while place > start and (match := OPERATOR.match(text, place)):
        end = _operand(text, match.end())
        product = match[0] in (" ", "\n")
        if end == match.end() or (product and WORD.fullmatch(text[start:place])):
            break
        if product and text[match.end() : end] == "a":
            break
        place = end
    return place


def _is_formula(found: str, before: str, after: str) -> bool:
    if STRONG.search(found):
        return re.search("[A-Za-z]", found) is not None
    unit = re.search(r"\d\s$", before)
    initial = found.isupper() and re.match(r"\. [A-Z]", after)
    word = WORD.match(found) and not LISTED.match(after)
    letters = re.fullmatch(r"[A-Za-z](?:\s[A-Za-z])*", found) and found != "N m"
    return bool(letters) and not (word or unit or initial)


def sentence(text: str) -> str:
    """Return text with its formulas as TeX.

    >>> sentence("a section bends by theta = x q, with q.q = sigma")
    'a section bends by $\\\\theta =xq$, with $q\\\\cdot q=\\\\sigma$'
    """
    told, place = [], 0
    while place < len(text):
        if place and re.match(r"[\w.'/\\$]", text[place - 1]):
            end = place
        else:
            end = _expression(text, place)
        found = text[place:end]
        if end > place and _is_formula(found, text[:place], text[end:]):
            tex = _tex(found.replace("\n", " "))
            told.append(tex or found)
            place = end
        else:
            told.append(text[place])
            place += 1
    return "".join(told)


def _tex(text: str) -> str:
    try:
        tex = formula(re.sub(r"(?<=\d) (?=\d)", " . ", text)).strip()
    except (FormulaError, IndexError):
        return ""
    return "" if r"\text{" in tex else f"${tex}$".replace("|", r"\vert ")


def _around_kept(text: str) -> str:
    told, place = [], 0
    for match in KEPT.finditer(text):
        told += [sentence(text[place : match.start()]), match[0]]
        place = match.end()
    return "".join([*told, sentence(text[place:])])


def _table(match: re.Match[str]) -> str:
    head, line, *rows = match[0].splitlines()
    kinds = [name.strip() for name in head.split("|")]
    told = [_around_kept(head), line]
    for row in rows:
        cells = row.split("|")
        for k, (kind, cell) in enumerate(zip(kinds, cells, strict=True)):
            if kind.startswith(COLUMNS):
                cells[k] = f" {_tex(cell.strip()) or cell.strip()} "
            elif kind == "unit":
                cells[k] = cell.replace("^2", "²").replace("^4", "⁴")
            elif not kind.startswith(UNITS):
                cells[k] = _around_kept(cell)
        told.append("|".join(cells))
    return "\n".join(told) + "\n"


TABLE = re.compile(r"^(?:\|.*\n){3,}", re.MULTILINE)


def inline(document: str) -> str:
    """Return a document, its displayed formulas set already, with those within lines as TeX."""
    told, place = [], 0
    for match in TABLE.finditer(document):
        told += [_around_kept(document[place : match.start()]), _table(match)]
        place = match.end()
    return "".join([*told, _around_kept(document[place:])])

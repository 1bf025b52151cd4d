"""The plain formulas of cpp/*.md as TeX, so that equations stand once and read well in both.

A formula is a line of tokens. A slash binds its two neighbours, as in 1/2 (a w + b p^2); what
follows _ or ^ is one word, number or bracket; qd is the rate of q, and M11 is M with two indices.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

GREEK = (
    *("alpha", "beta", "gamma", "theta", "phi", "sigma", "omega", "rho", "mu", "lambda"),
    *("zeta", "pi", "Pi", "Lambda", "tau"),
)
FUNCTIONS = ("sin", "cos", "tanh", "coth", "exp", "min", "max")
OPERATORS = ("atan2", "pinv", "null")
RATES = {"q": "q", "theta": r"\theta", "phi": r"\phi", "V": "V", "l": "l", "x": "x"}
DOTS = {"d": "dot", "dd": "ddot"}
LETTERS = "zx"  # products that are written without a space
VECTORS = {  # after these, x is a cross product
    *(
        "omega",
        "z",
        "q",
        "r",
        "r_k",
        "r_w",
        "h",
        "h_i",
        "b_i",
        "b_w",
        "v",
        "v_i",
        "rho",
        "rho_j",
        "w",
        "e",
        "f",
        "g",
        "tau",
        "L",
        "dr",
    ),
    *("V_r", "J_v", "J_omega"),
}
SIGNS = {
    "<-": r"\leftarrow ",
    "<=": r"\le ",
    ">=": r"\ge ",
    "+-": r"\pm ",
    "+=": r"\mathrel{+}=",
    ".": r"\cdot ",
    "*": "^{*}",
}
TOKEN = re.compile(
    r"(?P<gap>\s{2,})|(?P<space>\s)|(?P<number>\d+)|(?P<name>d2[A-Z]|[A-Za-z]+\d*(?![a-z]))"
    r"|(?P<word>[A-Za-z][A-Za-z0-9]*)|(?P<sign><-|<=|>=|\+=|\+-|[-+=<>.,:;|*/^_'()\[\]!])"
)
NUMBERED = re.compile(r"^(?P<body>.*?)(?:\s+\((?P<number>\d+)\))?$")
RELATION = re.compile(r"\\leftarrow |\\mathrel\{\+\}=|=|\\le ")
OPERAND = re.compile(r"[\w)\]}]\s*$")  # how TeX ends that a factor may follow


class FormulaError(ValueError):
    """A formula with something that has no meaning here."""


def symbol(name: str) -> str:
    """Return a name as TeX: Greek, rates, differentials, indices, words."""
    if name in (*GREEK, *FUNCTIONS, "sum", "int"):
        return rf"\{name} "
    if name in OPERATORS:
        return rf"\mathrm{{{name}}}"
    if len(name) == 1 or name == LETTERS:
        return name
    match = re.fullmatch(r"(\w+?)(d{1,2})", name)
    if match and match[1] in RATES:
        return rf"\{DOTS[match[2]]} {RATES[match[1]]}"
    if match := re.fullmatch(r"d2([A-Z])|d([a-z])2", name):
        return f"d^2 {match[1]}" if match[1] else f"d{match[2]}^2"
    if name[0] == "d" and (len(name) == 2 or name[1:] in (*GREEK, "qd")) and name[1] not in "do":
        return f"d{symbol(name[1:])}"
    if match := re.fullmatch(r"([A-Za-z])(\d+)", name):
        return f"{match[1]}_{{{match[2]}}}"
    return rf"\text{{ {name} }}"


class _Line:
    """One formula, read from left to right."""

    def __init__(self, text: str) -> None:
        self.tokens: list[tuple[str, str]] = []
        place = 0
        while place < len(text):
            match = TOKEN.match(text, place)
            if match is None:
                raise FormulaError(f"{text[place]!r} in the formula {text!r}")
            self.tokens.append((match.lastgroup or "", match[0]))
            place = match.end()
        self.place = 0

    def peek(self, ahead: int = 0) -> str:
        place = self.place + ahead
        return self.tokens[place][1] if place < len(self.tokens) else ""

    def kind(self) -> str:
        return self.tokens[self.place][0] if self.place < len(self.tokens) else ""

    def take(self) -> str:
        self.place += 1
        return self.tokens[self.place - 1][1]

    def until(self, *ends: str) -> str:
        """Read up to one of `ends`, which is left in place."""
        parts: list[str] = []
        last = ""  # the name just before, for x
        while self.place < len(self.tokens) and self.peek() not in ends:
            kind = self.kind()
            if kind == "gap":
                self.take()
                parts.append(r"\quad ")
                last = ""
            elif kind == "space":
                self.take()
            elif self.peek() == "/":
                self.take()
                self._skip_space()
                over, _ = self.atom()
                parts.append(rf"\frac{{{bare(parts.pop())}}}{{{bare(over)}}}")
                last = ""
            elif self.peek() == "x" and last in VECTORS and self.peek(1) not in ("^", ")"):
                self.take()
                parts.append(r"\times ")
                last = ""
            elif self.peek() == "1" and parts and OPERAND.search(parts[-1]):
                parts.append(rf"\,\mathbf{{{self.take()}}}")  # the unit matrix
            else:
                tex, last = self.atom()
                parts.append(tex)
        return "".join(parts).replace(r" }\text{ ", " ")

    def _skip_space(self) -> None:
        while self.kind() == "space":
            self.take()

    def atom(self) -> tuple[str, str]:
        """Read a symbol, a number, a bracket or a sign with what clings to it; its name too."""
        kind, text = self.kind(), self.take()
        name = text
        if kind in ("name", "word"):
            if text == "d" and self.peek() == "(":
                return "d" + self._bracket(), ""
            tex = symbol(text)
            script = self._scripts(tex)
            name += script[1]
            tex = script[0]
            if text in FUNCTIONS and self.peek() == " " and self.peek(1)[:1].isalpha():
                self._skip_space()
                tex += f"{self.atom()[0]} "
            elif self.peek() == "(" and not tex.endswith("} "):
                tex = self._scripts(tex + self._bracket())[0]
            return tex, name
        if kind == "number":
            return self._scripts(text)[0], ""
        if text in "([":
            self.place -= 1
            return self._scripts(self._bracket())[0], ""
        if text == "|":
            return self._scripts("|")[0], ""
        return SIGNS.get(text, f"{text} " if text in ",;" else text), ""

    def _bracket(self) -> str:
        left = self.take()
        right = {"(": ")", "[": "]"}[left]
        inside = self.until(right)
        if not self.peek():
            raise FormulaError(f"{left!r} without {right!r}")
        self.take()
        if r"\frac" in inside:
            return rf"\left{left}{inside}\right{right}"
        return f"{left}{inside}{right}"

    def _scripts(self, tex: str) -> tuple[str, str]:
        """Add primes, indices and powers; tell the index in plain letters too."""
        plain = low = high = ""
        index = re.fullmatch(r"(.+)_\{(\d+)\}", tex)
        if index:
            tex, low = index[1], index[2]
        while self.peek() in ("_", "^", "'", "!", "*"):
            sign = self.take()
            if sign == "_":
                script, plain = self._script()
                low = f"{low}, {script}" if low else script
                plain = f"_{plain}"
            elif sign == "^":
                high += self._script()[0]
            elif sign == "'":
                high += r"\prime "
            elif sign == "*":
                high += "*"
            else:
                tex += "!"
        if low and (word := re.fullmatch(r"\\text\{ (\w+) \}", tex)):
            tex = rf"\mathrm{{{word[1]}}}"
        if low:
            tex = f"{tex.rstrip()}_{{{low}}}"
        if high:
            tex = f"{tex.rstrip()}^{{{high}}}"
        return tex, plain

    def _script(self) -> tuple[str, str]:
        if self.peek() == "(":
            return bare(self._bracket()), ""
        if self.peek() in ("+", "-", "+-"):
            sign = self.take()
            number = self.take() if self.kind() == "number" else ""
            return SIGNS.get(sign, sign) + number, sign
        plain = self.take()
        tex = symbol(plain)
        if self.peek() == "," and self.peek(1)[:1].isalpha():
            self.take()
            more = self.take()
            return f"{_index(tex)}, {_index(symbol(more))}", plain
        return _index(tex), plain


def _index(tex: str) -> str:
    """Return a word that is an index without the spaces of a word in a sentence."""
    match = re.fullmatch(r"\\text\{ (\w+) \}", tex)
    if match:
        return match[1] if len(match[1]) == 2 else rf"\mathrm{{{match[1]}}}"
    return tex


def bare(tex: str) -> str:
    """Return a fraction's part without brackets around all of it."""
    if tex.startswith(r"\left(") and tex.endswith(r"\right)"):
        inside = tex[len(r"\left(") : -len(r"\right)")]
        return inside if inside.count(r"\left(") == inside.count(r"\right)") else tex
    if tex[:1] == "(" and tex[-1:] == ")":
        depth = 0
        for place, letter in enumerate(tex):
            depth += (letter == "(") - (letter == ")")
            if depth == 0 and place < len(tex) - 1:
                return tex
        return tex[1:-1]
    return tex


def formula(text: str) -> str:
    """Return one formula as TeX.

    >>> formula("T = 1/2 (a w + b p^2)")
    'T=\\\\frac{1}{2}(aw+bp^{2})'
    """
    return _Line(text).until("")


def aligned(lines: list[str]) -> Iterator[str]:
    """Yield the rows of an align* of formulas, each with its number where it has one."""
    for line in lines:
        match = NUMBERED.match(line.rstrip())
        assert match is not None
        label, body = re.match(r"^(?:([a-z]+(?: q)?):)?\s*(.*)$", match["body"].strip()).groups()
        tex = formula(re.sub(r"\s+(?=(=|<-) )", " ", body))
        if label:
            row = rf"\text{{{label}:}}\quad & {tex}"
        elif line[:1] == " ":
            row = rf"& \quad {tex}"
        elif tex.startswith(r"\text"):
            row = f"& {tex}"
        else:
            row = RELATION.sub(lambda sign: f"&{sign[0]}", tex, count=1)
        yield row + (rf" \tag{{{match['number']}}}" if match["number"] else "")


def math_block(lines: list[str]) -> str:
    """Return formulas as a block of MyST."""
    rows = " \\\\\n".join(aligned(lines))
    return f"```{{math}}\n:nowrap:\n\n\\begin{{align*}}\n{rows}\n\\end{{align*}}\n```\n"


FENCED = re.compile(r"^```text\n(.*?)^```\n", re.MULTILINE | re.DOTALL)
INDENTED = re.compile(r"(?<=\n\n)((?: {4}\S.* = .*\n)+)(?=\n)")


def typeset(document: str) -> str:
    """Return a document with its formulas as TeX: blocks with numbers, and indented equations."""

    def fenced(match: re.Match[str]) -> str:
        lines = match[1].splitlines()
        is_formula = any(re.search(r" \(\d+\)$", line) for line in lines)
        return math_block(lines) if is_formula else match[0]

    def indented(match: re.Match[str]) -> str:
        return math_block([line[4:] for line in match[1].splitlines()])

    return INDENTED.sub(indented, FENCED.sub(fenced, document))

"""What drives the cables through a run: a constant, a table or a function of time."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Any, Literal, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import finite
from cdcr.base.check import format_value, one_of, require_kind, short
from cdcr.files.number_csv import RUN_TIME, Layout, read_numbers
from cdcr.model.model import Model

Interpolation = Literal["linear", "previous"]
NO_TIMES = np.empty(0)


@dataclass(frozen=True, eq=False)
class TensionTable:
    """Commands of the cables at given times: tensions, or lengths where driven by length.

    Parameters
    ----------
    t : (N,) array_like
        Times, strictly increasing [s]; where lines connect the rows, a time given twice is a jump
        from its first row to its second. Integrators stop exactly at each.
    tension : (N, num_cables) array_like
        Commands at those times [N], [m] of cables driven by length. Before the first and after the
        last time these rows hold.
    interpolation : {"linear", "previous"}, optional
        Connect the rows by lines, or hold each until the next time.

    Raises
    ------
    ValueError
        For times out of order, other than one row for each, and what is no number >= 0.

    Examples
    --------
    >>> import cdcr
    >>> table = cdcr.TensionTable([0.0, 1.0, 2.0], [[0, 0, 0], [5, 0, 0], [5, 5, 0]])
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> cdcr.simulate(model, [0, 0], [0, 0], t=[0.0, 0.5, 1.5], tension=table).tension
    array([[0. , 0. , 0. ],
           [2.5, 0. , 0. ],
           [5. , 2.5, 0. ]])
    """

    t: ArrayLike
    tension: ArrayLike
    interpolation: Interpolation = "linear"

    def __post_init__(self) -> None:
        if not one_of(self.interpolation, ("linear", "previous")):
            raise ValueError(
                f"interpolation must be 'linear' or 'previous', got {short(self.interpolation)}"
            )
        t, rows = finite(self.t, "the table's t"), finite(self.tension, "the table's tension")
        if t.ndim != 1:
            raise ValueError(f"the table's t must have shape (any,), got {t.shape}")
        if rows.ndim != 2 or len(rows) != len(t):
            raise ValueError(
                f"the table's tension must have shape ({len(t)}, num_cables), got {rows.shape}"
            )
        back = np.flatnonzero(np.diff(t) < 0.0) + 1
        if len(back):
            k = back[0]
            raise ValueError(
                "the times of a tension table must be finite and strictly increasing, "
                f"got {t[k]:g} s at index {k} after {t[k - 1]:g} s"
            )
        if np.any(rows < 0.0):
            k, j = np.argwhere(rows < 0.0)[0]
            raise ValueError(
                f"tension[{k}, {j}] (cable {j + 1}) must be finite and >= 0 N (a cable cannot "
                f"push), or >= 0 m where driven by length, got {rows[k, j]:g}"
            )

    def __repr__(self) -> str:
        rows = " x ".join(str(size) for size in np.shape(self.tension))
        return f"<TensionTable: {rows} commands, {self.interpolation}>"

    @classmethod
    def load(
        cls, path: str | PathLike[str], model: Model, *, interpolation: Interpolation = "linear"
    ) -> TensionTable:
        """Read commands from a CSV file, as the files of scenarios do.

        Its columns are t, cable 1, cable 2 and so on, times in s and commands in N, in m of cables
        driven by length. The file of a run of that robot can be read too, for its commands.

        Parameters
        ----------
        path : path-like
            The file.
        model : Model
            The robot whose cables they are.
        interpolation : {"linear", "previous"}, optional
            Connect the rows by lines, or hold each until the next time.

        Returns
        -------
        TensionTable

        Raises
        ------
        FileNotFoundError
            If there is no such file.
        ValueError
            For other columns, and for what is no number >= 0, with file, line and column.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> import numpy as np
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> rows, header = [[0.0, 0, 0, 0], [1.5, 4, 0, 0]], "t,cable 1,cable 2,cable 3"
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     file = Path(folder) / "pull.csv"
        ...     np.savetxt(file, rows, delimiter=",", header=header, comments="")
        ...     cdcr.TensionTable.load(file, model)
        <TensionTable: 2 x 3 commands, linear>
        """
        from pathlib import Path

        from cdcr.runs.export import by_length, columns_of

        require_kind("model", model, Model)
        columns = tuple(f"cable {j + 1}" for j in range(model.num_cables))
        plain = Layout(columns, "a number >= 0 [N]", 0.0)
        asked = columns_of(model, "command" if by_length(model) else "tension")
        of_a_run = Layout(tuple(asked), plain.requirement, 0.0, RUN_TIME)
        _, t, rows = read_numbers(Path(path), "tension file", [plain, of_a_run])
        try:
            return cls(t, rows, interpolation)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None


CommandFunction: TypeAlias = Callable[..., ArrayLike]
Command: TypeAlias = (
    "ArrayLike | TensionTable | tuple[ArrayLike, ArrayLike] | CommandFunction | None"
)


def _takes_state(function: Callable[..., Any]) -> bool:
    """Whether a tension function wants (t, q, qd) rather than t alone."""
    try:
        # What np.vectorize made takes anything; the function that it calls tells.
        plain = getattr(function, "pyfunc", function)
        parameters = inspect.signature(plain).parameters.values()
    except (TypeError, ValueError):
        return False
    if any(p.kind is p.VAR_POSITIONAL for p in parameters):
        return True
    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    accepted = sum(p.kind in kinds for p in parameters)
    required = sum(p.kind in kinds and p.default is p.empty for p in parameters)
    if required == 3:
        return True
    if required <= 1 <= accepted:
        return False
    raise ValueError(
        f"a tension function must take (t) or (t, q, qd), got one that needs {required} arguments"
    )


def command_input(
    model: Model, command: Command, break_points: Sequence[float] = (), name: str = "tension"
) -> _core.TensionInput:
    """Turn what a user gives as command or tension into the core's input; messages say `name`."""
    none = isinstance(break_points, tuple) and not break_points
    breaks = NO_TIMES if none else finite(break_points, "break_points")
    if breaks.ndim != 1:
        got = format_value(break_points)
        raise ValueError(f"break_points must be a sequence of times, got {got}")
    if command is None:
        command = model.rest_command()
    if callable(command):
        function = command
        if not _takes_state(function):
            time_only = function
            function = lambda t, q, qd: time_only(t)  # noqa: E731
        return _core.TensionInput.function(model, function, breaks.tolist())
    if breaks.size > 0:
        raise ValueError("break_points go with a tension function; a table has its own")
    if isinstance(command, TensionTable):
        linear = command.interpolation == "linear"
        return _core.TensionInput.table(model, command.t, command.tension, linear)
    if isinstance(command, tuple) and len(command) == 2 and np.ndim(command[1]) == 2:
        return command_input(model, TensionTable(*command), name=name)
    return _core.TensionInput.constant(model, cast("ArrayLike", command), name)

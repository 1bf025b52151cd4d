"""Wrenches: forces and moments on the backbone, constant or changing in time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core
from cdcr.base.check import Check, format_value, is_iterable, one_of
from cdcr.base.keywords import by_keyword

Frame = Literal["base", "local"]
Profile: TypeAlias = "Callable[[float], float] | tuple[ArrayLike, ArrayLike] | None"


@by_keyword
@dataclass(frozen=True, kw_only=True, eq=False)
class Wrench:
    """A force and a moment on the backbone at a fraction of a section's length.

    Parameters
    ----------
    section : int
        Index of the section, 0 at the base.
    fraction : float, default 1
        Fraction of the section's length, 0 to 1.
    force : sequence of float, default (0, 0, 0)
        Force [N].
    moment : sequence of float, default (0, 0, 0)
        Moment about the point where the force acts [N m].
    frame : {"base", "local"}, default "base"
        Whether they keep their direction in the base frame, or turn with the backbone there.
    profile : optional
        How the size of the wrench changes over a run: a pair ``(times, factors)``, or a callable
        ``f(t)`` that returns the factor. None: constant.
    interpolation : {"linear", "previous"}, default "linear"
        Connect the factors of a table by lines, or hold each until the next time.
    break_points : sequence of float, default ()
        Times at which a callable `profile` is not smooth [s].

    Raises
    ------
    ValueError
        For a field that is no wrench's; section and fraction are checked against the model where
        the wrench is used.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> pull = cdcr.Wrench(section=0, force=(0.2, 0.0, 0.0))
    >>> q = model.equilibrium([0.0, 0.0, 0.0], wrenches=[pull])
    >>> print(f"{cdcr.polar(q)[0]:.4f} rad")
    0.2181 rad
    """

    section: int
    fraction: float = 1.0
    force: tuple[float, float, float] = (0.0, 0.0, 0.0)
    moment: tuple[float, float, float] = (0.0, 0.0, 0.0)
    frame: Frame = "base"
    profile: Profile = None
    interpolation: Literal["linear", "previous"] = "linear"
    break_points: tuple[float, ...] = ()

    if TYPE_CHECKING:  # any sequence goes in, a tuple comes out

        def __init__(
            self,
            *,
            section: int,
            fraction: float = ...,
            force: Sequence[float] | NDArray[np.floating[Any]] = ...,
            moment: Sequence[float] | NDArray[np.floating[Any]] = ...,
            frame: Frame = ...,
            profile: Profile = ...,
            interpolation: Literal["linear", "previous"] = ...,
            break_points: Sequence[float] = ...,
        ) -> None: ...

    def __post_init__(self) -> None:
        """Keep every value as a plain float, int or tuple, or refuse it."""
        check = Check()
        plain: dict[str, object] = {
            "section": check.whole("section", self.section, "a whole number >= 0", low=0),
            "fraction": check.number("fraction", self.fraction, "a number 0 to 1"),
            "break_points": check.numbers(
                "break_points", self.break_points, "a sequence of times", "a number of s"
            ),
        }
        for name, unit in (("force", "N"), ("moment", "N m")):
            each, value = f"a number of {unit}", getattr(self, name)
            plain[name] = check.vector(name, value, f"three numbers of {unit}", each)
        if not one_of(self.frame, ("base", "local")):
            check.refuse("frame", "'base' or 'local'", self.frame)
        if not one_of(self.interpolation, ("linear", "previous")):
            check.refuse("interpolation", "'linear' or 'previous'", self.interpolation)
        pair = isinstance(self.profile, tuple) and len(self.profile) == 2
        if not (self.profile is None or callable(self.profile) or pair):
            check.refuse("profile", "a pair (times, factors), a callable or None", self.profile)
        check.done()
        for name, value in plain.items():
            object.__setattr__(self, name, value)

    def at(self, t: float) -> Wrench:
        """Return the constant wrench that this one is at one time.

        Parameters
        ----------
        t : float
            The time [s].

        Returns
        -------
        Wrench

        Examples
        --------
        >>> import cdcr
        >>> push = cdcr.Wrench(section=0, force=(2.0, 0.0, 0.0), profile=([0.0, 1.0], [0.0, 1.0]))
        >>> push.at(0.25).force
        (0.5, 0.0, 0.0)
        """
        now = _loads((self,)).at(t)[0]
        return Wrench(
            section=self.section,
            fraction=self.fraction,
            force=now.force,
            moment=now.moment,
            frame=self.frame,
        )

    def _to_core(self) -> _core.CoreWrench:
        return _core.CoreWrench(
            self.section, self.fraction, self.force, self.moment, self.frame == "local"
        )


def _loads(wrenches: Sequence[Wrench]) -> _core.Loads:
    """Return wrenches and their profiles as the core takes them."""
    loads = _core.Loads()
    for i, wrench in enumerate(wrenches):
        if not isinstance(wrench, Wrench):
            raise ValueError(f"wrenches[{i}] must be a cdcr.Wrench, got {format_value(wrench)}")
        core = wrench._to_core()
        if wrench.profile is None:
            loads.add(core)
        elif callable(wrench.profile):
            loads.add_function(core, wrench.profile, list(wrench.break_points))
        else:
            times, factors = wrench.profile
            loads.add_table(core, times, factors, wrench.interpolation == "linear")
    return loads


def loads(wrenches: Wrench | Sequence[Wrench]) -> _core.Loads:
    """Return one wrench or several as the core's loads over time."""
    if isinstance(wrenches, Wrench):
        return _loads((wrenches,))
    if not is_iterable(wrenches):
        raise ValueError(
            f"wrenches must be a sequence of cdcr.Wrench, got {format_value(wrenches)}"
        )
    return _loads(tuple(wrenches))

"""Between the coordinates of a robot and the bending vectors of its sections."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray, finite
from cdcr.model.coordinates import polar
from cdcr.model.statics import StaticModel

if TYPE_CHECKING:
    from cdcr.model.model import Model


class ShapeModel(StaticModel):
    """The model of the core, and the bending vectors of its sections."""

    def bending_vectors(self, q: ArrayLike) -> FloatArray:
        """Bending vector of each section, the first one where its bending varies.

        Integrated over a section that does not twist, bending of any order is that of this vector,
        cpp/rods.md eq. (51).

        Parameters
        ----------
        q : (..., d) array_like
            Coordinates.

        Returns
        -------
        (..., n, 2) array
            In radians; zero where the bending of a section is locked.

        Raises
        ------
        ValueError
            For a wrong shape, and values that are not finite.

        Examples
        --------
        >>> import dataclasses
        >>> import cdcr
        >>> robot = cdcr.robots.amouri2020()
        >>> rod = dataclasses.replace(robot.sections[0], bending_order=1)
        >>> model = cdcr.Model(dataclasses.replace(robot, sections=[rod]))
        >>> model.bending_vectors([0.3, 0.4, 0.1, 0.0])
        array([[0.3, 0.4]])
        """
        state = finite(q, "q")
        if state.shape[-1:] != (self.num_coordinates,):
            raise ValueError(f"q must have shape (..., {self.num_coordinates}), got {state.shape}")
        vectors = np.zeros((*state.shape[:-1], self.num_sections, 2))
        for section, first in self._bending_starts():
            vectors[..., section, :] = state[..., first : first + 2]
        return vectors

    def polar(self, q: ArrayLike, *, continuous: bool = False) -> tuple[FloatArray, FloatArray]:
        """Bending angle and orientation angle of each section, of its first bending vector.

        Parameters
        ----------
        q : (..., d) array_like
            Coordinates.
        continuous : bool, optional
            Read q (N, d) as samples of a run, as ``cdcr.polar`` does.

        Returns
        -------
        theta, phi : (..., n) array
            In radians; both zero where the bending of a section is locked.

        Raises
        ------
        ValueError
            For a wrong shape, and values that are not finite.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.three_sections())
        >>> theta, phi = model.polar([0.3, 0.4, 0.0, 0.0, 0.1, 0.0])
        >>> theta, phi.round(4)
        (array([0.5, 0. , 0.1]), array([0.9273, 0.    , 0.    ]))
        """
        vectors = self.bending_vectors(q)
        joined = vectors.reshape(*vectors.shape[:-2], 2 * self.num_sections)
        theta, phi = polar(joined, continuous=continuous)
        leading = (*vectors.shape[:-2], self.num_sections)
        return np.reshape(theta, leading), np.reshape(phi, leading)

    def coordinates(self, bending: ArrayLike) -> FloatArray:
        """Coordinates of sections that bend evenly, without twist and stretch.

        Of cpp/rods.md eq. (51) those of order 0.

        Parameters
        ----------
        bending : (..., 2n) array_like
            A bending vector for each section [rad], as ``cdcr.bending`` gives them.

        Returns
        -------
        (..., d) array
            Coordinates with these as first bending vectors, and zeros.

        Raises
        ------
        ValueError
            For a wrong shape, values that are not finite, and where a section is to bend whose
            bending is locked.

        Examples
        --------
        >>> import dataclasses
        >>> import cdcr
        >>> robot = cdcr.robots.amouri2020()
        >>> rod = dataclasses.replace(robot.sections[0], bending_order=1, stretch_order=0)
        >>> model = cdcr.Model(dataclasses.replace(robot, sections=[rod]))
        >>> model.coordinates(cdcr.bending([0.5], [0.0]))
        array([0.5, 0. , 0. , 0. , 0. ])
        """
        vectors = finite(bending, "bending")
        if vectors.shape[-1:] != (2 * self.num_sections,):
            raise ValueError(
                f"bending must have shape (..., {2 * self.num_sections}), got {vectors.shape}"
            )
        vectors = vectors.reshape(*vectors.shape[:-1], self.num_sections, 2)
        q = np.zeros((*vectors.shape[:-2], self.num_coordinates))
        bends = np.zeros(self.num_sections, dtype=bool)
        for section, first in self._bending_starts():
            q[..., first : first + 2] = vectors[..., section, :]
            bends[section] = True
        wrong = np.argwhere(np.any(vectors != 0.0, axis=-1) & ~bends)
        if wrong.size:
            x, y = vectors[tuple(wrong[0])]
            raise ValueError(
                f"bending of section {wrong[0][-1] + 1} must be 0 rad, which is locked, "
                f"got ({x:g}, {y:g}) rad"
            )
        return q

    def _bending_starts(self) -> list[tuple[int, int]]:
        """Return sections that bend, and where their first bending vectors stand in q."""
        sections = cast("Model", self).robot.sections
        return [
            (i, self.section_slice(i).start)
            for i, section in enumerate(sections)
            if section.bending_order is not None
        ]

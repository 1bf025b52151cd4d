"""What a robot has to do with files."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot


class Filed:
    """A description that can be read from a file and written to one."""

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Robot:
        """Read a robot from a TOML file, as `save` writes it.

        Parameters
        ----------
        path : str or path
            The file. A section gives its cables either as ``cable_angles`` [rad] or as
            ``cable_angles_deg`` [deg].

        Returns
        -------
        Robot

        Raises
        ------
        FileNotFoundError
            Where there is no such file.
        ValueError
            Naming file, key and what is allowed, for broken TOML, unknown or missing keys, wrong
            types and values out of range.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> import cdcr
        >>> robot = cdcr.robots.amouri2020()
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     robot.save(Path(folder) / "robot.toml")
        ...     again = cdcr.Robot.load(Path(folder) / "robot.toml")
        >>> again == robot
        True
        """
        from cdcr.robot.file import load_robot

        return load_robot(cast("type[Robot]", cls), path)

    def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> None:
        """Write the robot to a TOML file; `load` gives back an equal robot.

        Parameters
        ----------
        path : str or path
            The file; it appears whole or not at all.
        overwrite : bool, default False
            Whether a file of that name may be replaced.

        Raises
        ------
        FileExistsError
            Where there is such a file and `overwrite` is False.
        FileNotFoundError
            Where there is no such folder.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> import cdcr
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     file = Path(folder) / "robot.toml"
        ...     cdcr.robots.amouri2020().save(file)
        ...     lines = file.read_text().splitlines()
        >>> lines[4]
        'gravity = [0.0, 0.0, 0.0]  # in the base frame [m/s^2]'
        """
        from cdcr.robot.file import save_robot

        save_robot(cast("Robot", self), path, overwrite=overwrite)

"""The server of viser: on this machine alone, quiet, at the port asked for or not at all."""

from __future__ import annotations

import errno
import html
import io
import json
import socket
from contextlib import redirect_stdout
from typing import Any

import numpy as np

from cdcr.base.check import Check
from cdcr.base.extras import require
from cdcr.view.live import LiveModel

HOST = "127.0.0.1"  # nobody else can connect
PORT = 8080
EYE = np.array([1.0, -1.55, 0.45])  # where one looks from, over the robot's length
FIELD = 0.6  # of view, in height [rad]
WIDTH = 1.1  # of what has to be seen, over its height
HALF = 1.35  # how much further away one looks from where the panel covers the lower half


def open_server(port: int, title: str) -> Any:
    """Start a viser.ViserServer; 0 takes any free port.

    Raises
    ------
    ImportError
        Without the extra ``view``.
    OSError
        Where the port is in use, or not for us.
    """
    viser: Any = require("viser", "view")
    check = Check()
    check.whole("port", port, "a whole number 0 to 65535", low=0, high=65535)
    check.done()
    _probe(port)
    with redirect_stdout(io.StringIO()):  # it tells its address whatever `verbose` is
        server = viser.ViserServer(host=HOST, port=port, label=title, verbose=False)
    if port and server.get_port() != port:  # taken meanwhile: it has gone on to the next
        close_server(server)
        raise _in_use(port)
    server.request_share_url = _never  # no way out of this machine, whatever a client asks
    server.gui.configure_theme(show_logo=False, show_share_button=False)
    return server


def close_server(server: Any) -> None:
    """Stop a server, so that its port is free."""
    with redirect_stdout(io.StringIO()):
        server.stop()


def name_page(server: Any, title: str) -> None:
    """Set what the browser calls the page: the client of viser knows of no title."""
    act = html.escape(f"document.title = {json.dumps(title)}")
    server.gui.add_html(f'<img hidden alt="" src="data:," onerror="{act}">')


def look_at(server: Any, model: LiveModel) -> None:
    """Show the whole robot, with what pulls it down below, from further away where it is narrow."""
    robot = model.robot
    axis, gravity = np.array(robot.base_orientation)[:, 2], np.array(robot.gravity)
    weight = float(np.linalg.norm(gravity))
    up = -gravity / weight if weight > 0.0 else np.array([0.0, 0.0, 1.0])
    across = np.eye(3)[int(np.argmin(np.abs(up)))]
    across = across - (across @ up) * up
    across /= np.linalg.norm(across)
    aside = np.cross(up, across)
    # To the right stands the panel.
    center = np.array(robot.base_position) + robot.length * (0.48 * axis + 0.13 * across)
    server.scene.set_up_direction(tuple(up))
    server.initial_camera.look_at = tuple(center)
    server.initial_camera.up = tuple(up)
    server.initial_camera.fov = FIELD
    eye = 1.25 * robot.length * (EYE @ np.stack([across, aside, up]))
    server.initial_camera.position = tuple(center + eye)

    def step_back(client: Any) -> None:
        if client.camera.aspect < WIDTH:
            away = HALF * eye * WIDTH / client.camera.aspect
            # To the upper half, as the panel covers the lower one.
            below = center - 0.5 * np.linalg.norm(away) * np.tan(FIELD / 2.0) * up
            client.camera.position = tuple(below + away)
            client.camera.look_at = tuple(below)  # which moves with the position

    server.on_client_connect(step_back)


def _probe(port: int) -> None:
    """Refuse a port that cannot be had."""
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((HOST, port))
        except PermissionError:
            raise OSError(
                f"port {port} is kept for the system; give one above 1023, or 0 for any free one"
            ) from None
        except OSError as error:
            if error.errno != errno.EADDRINUSE:
                raise
            raise _in_use(port) from None


def _in_use(port: int) -> OSError:
    return OSError(f"port {port} is in use; give another one, or 0 for any free one")


def _never(*_: object, **__: object) -> None:
    """Share nothing."""

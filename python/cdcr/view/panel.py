"""The panel beside the robot: what is shown, and what one can change."""

from __future__ import annotations

import html
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from cdcr.view.colors import legend
from cdcr.view.drawing import Drawing
from cdcr.view.live import LiveModel, round_up
from cdcr.view.session import Moment, Session

SPEEDS = ("0.1", "0.25", "0.5", "1", "2", "4")
STEPS = 500  # of a slider
MOST_GRAVITY = 10.0  # of a slider [m/s^2]
MOST_ADDED = 1.0  # share of critical damping
Task = Callable[[], object]


class Panel:
    """Controls of a session. What they do is done by `do`, in the thread that draws.

    Parameters
    ----------
    gui : viser.GuiApi
        Where they stand.
    session : Session
        What they control.
    drawing : Drawing
        What they show and hide.
    do : callable
        Takes a task, and does it before the next picture.
    """

    def __init__(
        self, gui: Any, session: Session, drawing: Drawing, do: Callable[[Task], object]
    ) -> None:
        self._session, self._drawing, self._do = session, drawing, do
        self._status = gui.add_html("")
        self._legend, self._scale = gui.add_html(""), 0.0
        with gui.add_folder("Time"):
            self._time(gui)
        self.cables: list[Any] = []
        if session.model.num_cables:
            with gui.add_folder("Cables"):
                self._cables(gui)
        with gui.add_folder("Loads"):
            self._loads(gui)
        with gui.add_folder("Show", expand_by_default=False):
            self._show(gui)
        self._set_commands()

    def update(self, moment: Moment, rate: float, pictures: float) -> None:
        """Tell the time, what was simulated over real time, and pictures a second."""
        session = self._session
        live = session.live
        state = "played" if live is None else "in its loop" if live.steered else "simulated"
        words = f"{rate:.2f} × real time" if session.playing else "paused"
        if live is not None and live.message:
            words += f", {live.message}: ask less of the cables, or Restart"
        if live is not None and live.pull is not None:
            force = float(np.linalg.norm(live.pull.force(live.model, live.q)))
            words += f", pulled with {force:.3g} N"
        if session.refusal:
            words += f"; {session.refusal}"
        first = f"<b>t = {moment.time:.2f} s</b> {state}, {html.escape(words)}"
        self._tell("<br>".join((first, f"{pictures:.0f} frames/s", *errors(session.model, moment))))
        if self._drawing.scale != self._scale and self._drawing.cables is not None:
            self._scale = self._drawing.scale
            self._legend.content = legend(self._scale)
        start, end = session.span
        if end > start:
            self._scrub.min, self._scrub.max = round(start, 2), round(end, 2)
            self._scrub.value = float(np.clip(round(moment.time, 2), start, end))
        self._play.label = "Pause" if session.playing else "Play"
        if self._back is not None:
            self._back.visible = live is not None
        if live is None or live.steered:
            self._set_commands()

    def tell_end(self, failure: str) -> None:
        """Tell that nothing goes on, and why."""
        self._tell(f"<b>stopped</b>: {html.escape(failure)}")

    def _tell(self, words: str) -> None:
        self._status.content = (
            '<div id="cdcr-status" style="padding:0.2em 0.9em;font-size:0.85em;'
            f'font-variant-numeric:tabular-nums">{words}</div>'
        )

    def _time(self, gui: Any) -> None:
        session = self._session
        self._play = gui.add_button("Pause")
        self._play.on_click(lambda _: self._do(self._toggle))
        start, end = session.span
        self._scrub = gui.add_slider("time [s]", start, max(end, start + 0.01), 0.01, start)
        self._on_change(self._scrub, session.seek)
        chosen = f"{session.speed:g}"
        speeds = SPEEDS if chosen in SPEEDS else (*SPEEDS, chosen)
        speed = gui.add_dropdown("speed", speeds, initial_value=chosen)
        self._on_change(speed, lambda value: setattr(session, "speed", float(value)))
        again = gui.add_button("Restart")
        again.on_click(lambda _: self._do(self._restart))
        self._back: Any = None
        if session.run is not None:
            self._back = gui.add_button("Back to the run", visible=False)
            self._back.on_click(lambda _: self._do(session.go_back))

    def _cables(self, gui: Any) -> None:
        session = self._session
        cables = session.model.robot.all_cables
        commands = session.command
        for j, (cable, (low, high)) in enumerate(zip(cables, session.ranges(), strict=True)):
            name = f"length {j + 1} [m]" if cable.length_driven else f"tension {j + 1} [N]"
            step = (high - low) / STEPS
            slider = gui.add_slider(name, low, high, step, float(np.clip(commands[j], low, high)))
            self._on_change(slider, partial(self._command, j))
            self.cables.append(slider)

    def _loads(self, gui: Any) -> None:
        robot = self._session.model.robot
        self._gravity = [
            self._load_slider(gui, f"gravity {axis} [m/s²]", -most, most, value)
            for axis, value in zip("xyz", robot.gravity, strict=True)
            for most in [max(MOST_GRAVITY, abs(value))]
        ]
        most = round_up(max(robot.mass, 2.0 * robot.payload, 1e-3))
        self._payload = self._load_slider(gui, "payload [kg]", 0.0, most, robot.payload)
        added = self._session.added_damping
        self._damping = self._load_slider(gui, "damping added", 0.0, MOST_ADDED, added)

    def _load_slider(self, gui: Any, name: str, low: float, high: float, value: float) -> Any:
        slider = gui.add_slider(name, low, high, (high - low) / STEPS, value)
        self._on_change(slider, lambda _: self._change())
        return slider

    def _show(self, gui: Any) -> None:
        drawing = self._drawing
        parts = {
            "backbone": [drawing.backbone],
            "disks": [drawing.disks, drawing.marks],
            "cables": [drawing.cables],
            "frames": [drawing.frames],
            "path of the tip": [drawing.trail],
            **drawing.ghosts,
            "markers measured": [drawing.markers],
        }
        for name, handles in parts.items():
            if shown := [handle for handle in handles if handle is not None]:
                box = gui.add_checkbox(name, True)
                self._on_change(box, partial(_set_visible, shown))

    def _on_change(self, control: Any, act: Callable[[Any], object]) -> None:
        """Act when a person changes a control, not when the program does."""

        def changed(event: Any) -> None:
            if event.client is not None:
                value = _within_range(event.target)
                self._do(lambda: act(value))

        control.on_update(changed)

    def _toggle(self) -> None:
        if self._session.playing:
            self._session.playing = False
        else:
            self._session.play()

    def _restart(self) -> None:
        self._session.restart()
        if self._session.live is not None:
            self._change()
        self._set_commands()

    def _command(self, cable: int, value: float) -> None:
        self._session.go_live()
        assert self._session.live is not None
        self._session.live.steer(cable, value)
        if not self._session.playing:
            self._session.play()

    def _change(self) -> None:
        """Go on under the loads that the sliders say."""
        self._session.go_live()
        assert self._session.live is not None
        x, y, z = (float(slider.value) for slider in self._gravity)
        self._session.live.change(
            gravity=(x, y, z),
            payload=float(self._payload.value),
            added_damping=float(self._damping.value),
        )

    def _set_commands(self) -> None:
        """Bring the sliders of the cables to the commands shown."""
        for slider, value in zip(self.cables, self._session.command, strict=True):
            slider.value = float(np.clip(value, slider.min, slider.max))


def errors(model: LiveModel, moment: Moment) -> list[str]:
    """Return what to say of how far reference and estimate are from the robot that is shown."""
    beside = {"reference": moment.reference, "estimate": moment.estimate}
    told = []
    for name, q in beside.items():
        if q is not None:
            off = 1e3 * float(np.linalg.norm(model.tip(q)[1] - model.tip(moment.q)[1]))
            most = float(np.abs(q - moment.q).max())
            told.append(f"{name}: tip {off:.2f} mm off, a coordinate {most:.4f} at most")
    return told


def _within_range(control: Any) -> Any:
    """Return the value of a control; a slider goes to its nearer end where a number is beyond it.

    The range holds back the mouse alone: beside a slider any number can be typed.
    """
    if hasattr(control, "max") and not control.min <= control.value <= control.max:
        control.value = float(np.clip(control.value, control.min, control.max))
    return control.value


def _set_visible(handles: list[Any], value: bool) -> None:
    for handle in handles:
        handle.visible = value

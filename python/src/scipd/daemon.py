# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A scipd of one's own: started, steered and ended by a test."""

from __future__ import annotations

import atexit
import os
import pathlib
import shutil
import tempfile
import weakref
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple, Union

from .clock import start_clock
from .control import Control
from .errors import ScipdEnded, ScipdError, ScipdNotReady
from .fault import Fault, request_of
from .options import ConfigLike, PathLike, environment_for, is_live, options
from .process import Process
from .program import find_program
from .recording import LastScans, Recording
from .robot import Robot
from .scan import Scan, Truth
from .scan_series import Series, in_step, limited
from .scene import Scene
from .sensor import Sensor
from .trajectory import Trajectory, TrajectoryLike
from .wire import Wire

_READY_S = 120.0
_LOG_LINES = 12
# Its sockets close a little before it has ended, as a core may be written in between.
_ENDING_S = 3.0
# A Unix socket has at most 107 bytes, and some test runners have folders that are longer than that.
_LONGEST_FOLDER = 80

_running: "weakref.WeakSet[Scipd]" = weakref.WeakSet()


class Scipd:
    """
    Starts scipd, and returns when it is ready. Use it as a context manager, or call close(). It ends with the process
    that made it, however that ends.

    world: a file or folder as --scene has it, or the name of a scene that ships with scipd, such as "square_room";
    without one, the rescue maze. The scanner is 0.25 m up.
    model: such as "UST-10LX" or "URG-04LX@3.3.00".
    config: a file, or a dict as a file has it, for any number of robots; then model and accuracy stand there.
    poses: a file or a source as --poses has it, or [(seconds, pose), ...]. In lockstep a file is one of TUM.
    clock: "wall", or "poses" for lockstep: time stands still, and clock.run() has it go on.
    accuracy: "ideal", "sensor" or "material".
    args: more options of scipd, which hold in place of what this package would choose.
    """

    def __init__(self, world: Optional[PathLike] = None, model: str = "UST-10LX", config: Optional[ConfigLike] = None,
                 poses: Union[TrajectoryLike, None] = None, clock: str = "wall", accuracy: Optional[str] = None,
                 seed: Optional[int] = None, args: Sequence[str] = ()) -> None:
        program = find_program()
        # A file is played by scipd on the wall clock, and by this package where that leads time.
        live = is_live(poses)
        scipds = os.fspath(poses) if isinstance(poses, (str, os.PathLike)) and (live or clock == "wall") else None
        drive = Trajectory.of(poses) if poses is not None and scipds is None else None
        folder = _new_folder()
        try:
            line = options(folder, world=world, model=model, config=config, poses=scipds, clock=clock,
                           accuracy=accuracy, seed=seed, args=args)
            self._process = Process([program, *line], folder, environment_for(folder))
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        self.wire = Wire()
        self._recordings: List[Recording] = []
        self._last: Optional[LastScans] = None
        self._closed = False
        self._told = False  # somebody knows that it has ended by itself
        try:
            self._begin(self._ready(program), clock == "poses", live, drive)
        except BaseException:
            self._process.end()
            raise
        _running.add(self)

    def _ready(self, program: str) -> Dict[str, Any]:
        ready = self._process.ready_line(_READY_S)
        if ready is not None:
            return ready
        code = self._process.exit_code
        self._process.end()
        what = f"was not ready within {_READY_S:.0f} s" if code is None else f"did not start: it {_ended(code)}"
        raise ScipdNotReady(f"{program} {what}. The end of its log:\n{self._log_end()}")

    def _begin(self, ready: Dict[str, Any], lockstep: bool, live: bool, drive: Optional[Trajectory]) -> None:
        self.control: str = ready["control"]
        self.http: Optional[str] = f"http://{ready['http']}/" if ready["http"] else None
        self._control = Control(self.control, self._why_gone)
        robots = list(dict.fromkeys(sensor["name"].split("/")[0] for sensor in ready["sensors"]))
        poses_at = ready.get("poses", {})
        self.clock = start_clock(self._control, robots, lockstep, led=live or bool(poses_at))
        self.scene = Scene(self._control, self.clock)
        self.sensors: Dict[str, Sensor] = {told["name"]: Sensor(self._control, self.clock, told)
                                           for told in ready["sensors"]}
        self._robots = {name: Robot(self._control, self.clock, name, poses_at.get(name)) for name in robots}
        for sensor in self.sensors.values():
            if sensor.is_scanner:
                self.wire.listen(self.control, sensor.name)
        if drive is not None:
            self.clock.drive(robots[0], drive)

    # Where it is.

    @property
    def host(self) -> Optional[str]:
        """Of the first scanner, as all below; of others, see `sensors`."""
        return self._first().host

    @property
    def port(self) -> Optional[int]:
        return self._first().port

    @property
    def tty(self) -> Optional[str]:
        return self._first().tty

    @property
    def pid(self) -> Optional[int]:
        return self._process.pid

    # What it is and what it sees.

    def robot(self, name: str = "robot") -> Robot:
        """Without a name the only one, whatever it is called."""
        if name in self._robots:
            return self._robots[name]
        if name == "robot" and len(self._robots) == 1:
            return next(iter(self._robots.values()))
        raise ValueError(f"there is no robot {name!r}; there are: {', '.join(self._robots)}")

    def sensor(self, name: Optional[str] = None) -> Sensor:
        """By its name ROBOT/SENSOR, or by SENSOR where that says enough; without a name the only one."""
        found = [sensor for key, sensor in self.sensors.items() if name is None or name in (key, key.split("/")[1])]
        if name is None and len(found) > 1:
            scanners = [sensor for sensor in found if sensor.is_scanner]
            found = scanners if len(scanners) == 1 else found
        if len(found) == 1:
            return found[0]
        raise ValueError(f"say which sensor: {', '.join(self.sensors)}" if name is None or found else
                         f"there is no sensor {name!r}; there are: {', '.join(self.sensors)}")

    def scan(self, sensor: Optional[str] = None, timeout_s: float = 10.0) -> Scan:
        """The next whole revolution, over the wire as a driver gets it. In lockstep time goes on until it is there, and
        no farther. Where a driver has the TCP port, it comes by the tty. Raises NoScan."""
        return self.sensor(sensor).scan(timeout_s)

    def scans(self, sensor: Optional[str] = None, seconds: Optional[float] = None, count: Optional[int] = None,
              timeout_s: float = 10.0) -> Iterator[Scan]:
        """Iterates over consecutive scans, as a driver gets them in a stream: for so many seconds by the scanner's
        stamps, or so many of them, or as long as the loop goes on. Each must come within `timeout_s`, else it raises
        NoScan. In lockstep time stands still between them."""
        return limited(Series(self.sensor(sensor), timeout_s), seconds, count)

    def scans_of(self, sensors: Sequence[str], seconds: Optional[float] = None, count: Optional[int] = None,
                 timeout_s: float = 10.0) -> Iterator[Tuple[Scan, ...]]:
        """Iterates over tuples of scans of one instant, in the order of `sensors`. The slowest scanner sets the pace:
        with each of its scans come those of the others that began nearest to it."""
        chosen = [self.sensor(name) for name in sensors]
        if not chosen or len({sensor.name for sensor in chosen}) < len(chosen):
            raise ValueError(f"name one or more scanners, each once, not {list(sensors)!r}")
        return in_step(chosen, seconds, count, timeout_s)

    def truth(self, sensor: Optional[str] = None, of: Optional[Scan] = None, timeout_s: float = 10.0) -> Truth:
        """What is true of the next whole turn, or of a scan that is less than a second old. No driver notices it."""
        return self.sensor(sensor if of is None else of.sensor).truth(of, timeout_s)

    @property
    def status(self) -> Dict[str, Any]:
        """GET /status."""
        status: Dict[str, Any] = self._control.get("/status")
        return status

    def ask(self, method: str, target: str, body: Any = None) -> Any:
        """Anything else of the control API. Raises Refused."""
        return self._control.ask(method, target, body)

    # What goes wrong.

    def fault(self, kind: str, sensor: Optional[str] = None, after: float = 0, seconds: Optional[float] = None,
              **members: Any) -> Fault:
        """Injects a fault into a scanner, `after` seconds from now and for `seconds`, or until stop(). `members`
        are those of docs/faults.md: steps=[400, 500], at={"scan": 40}, for_={"scans": 3}, until="RB"."""
        return Fault(self._control, self.sensor(sensor).name, request_of(kind, after, seconds, members))

    # What stays.

    @property
    def log(self) -> str:
        """What scipd has told on standard error."""
        return self._process.log

    def record(self, path: PathLike, sensor: Optional[str] = None) -> Recording:
        """Writes all scans from now on into FILE.mcap or FILE.jsonl, until stop() or close()."""
        recording = Recording(self.control, path, None if sensor is None else self.sensor(sensor).name)
        self._recordings.append(recording)
        self.clock.go_with(recording.catch_up)
        return recording

    def keep_last(self, seconds: float) -> None:
        """From now on save() has the scans of so many last seconds."""
        if self._last is None:
            self._last = LastScans(self.control, seconds)
            self.clock.go_with(self._last.catch_up)

    def save(self, folder: PathLike) -> List[pathlib.Path]:
        """Writes log, wire and the last scans there, also after close()."""
        place = pathlib.Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        (place / "scipd.log").write_text(self.log, encoding="utf-8")
        (place / "wire.txt").write_text(str(self.wire), encoding="utf-8")
        saved = [place / "scipd.log", place / "wire.txt"]
        if self._last is not None:
            self._last.save(place / "last_scans.mcap")
            saved.append(place / "last_scans.mcap")
        return saved

    # Its end.

    @property
    def exit_code(self) -> Optional[int]:
        """None: it runs. A negative number is that of the signal that ended it."""
        code = self._process.exit_code
        self._told = self._told or code is not None
        return code

    def close(self) -> None:
        """Ends it. Raises ScipdEnded if it had ended by itself, and nobody was told so far."""
        if self._closed:
            return
        self._closed = True
        _running.discard(self)
        code = self._process.exit_code
        crashed = code is not None and not self._told
        self.clock.close()
        self._process.end()
        self.wire.close()
        for recording in self._recordings:
            recording.stop()
        if self._last is not None:
            self._last.close()
        if crashed:
            raise self._gone(code)

    def __enter__(self) -> "Scipd":
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        try:
            self.close()
        except ScipdEnded:
            if kind is None:
                raise  # else what the test has raised says more

    def _first(self) -> Sensor:
        sensors = list(self.sensors.values())
        return next((sensor for sensor in sensors if sensor.is_scanner), sensors[0])

    def _why_gone(self) -> ScipdError:
        """Nobody answers on the control socket."""
        if self._closed:
            return ScipdEnded("this scipd was closed")
        code = self._process.wait(_ENDING_S)
        if code is None:
            return ScipdError(f"scipd does not answer on {self.control}. The end of its log:\n{self._log_end()}")
        return self._gone(code)

    def _gone(self, code: Optional[int]) -> ScipdEnded:
        self._told = True
        return ScipdEnded(f"scipd {_ended(code)} while it was needed. The end of its log:\n{self._log_end()}")

    def _log_end(self) -> str:
        lines = self.log.rstrip().splitlines()
        return "\n".join(lines[-_LOG_LINES:]) or "(it has said nothing)"


def _ended(code: Optional[int]) -> str:
    if code is not None and code < 0:
        return f"was ended by signal {-code}"
    return f"ended with exit code {code}"


def _new_folder() -> pathlib.Path:
    folder = tempfile.mkdtemp(prefix="scipd-")
    if len(os.fsencode(folder)) > _LONGEST_FOLDER:
        os.rmdir(folder)
        folder = tempfile.mkdtemp(prefix="scipd-", dir="/tmp")
    return pathlib.Path(folder)


@atexit.register
def _close_all() -> None:
    """What a program has not closed goes with it, and not a moment later."""
    for daemon in list(_running):
        try:
            daemon.close()
        except ScipdError:
            pass

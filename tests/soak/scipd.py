# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The scipd under load: its configuration, its start and end, and what the kernel reports about it.
import fcntl
import json
import os
import pathlib
import signal
import socket
import subprocess
import tempfile

# Name: (endless stream request, points of a scan, period in ms).
STREAMS = {
    "good/ust": (b"MD0000108000000", 1081, 25.0),
    "good/utm": (b"MD0000108000000", 1081, 25.0),
    "good/urg": (b"MD0044072501000", 682, 100.0),
    "driven/ust": (b"MD0000108000000", 1081, 25.0),
}
PICTURES = ("good/tof", 0.05)  # a camera whose pictures are read, and its period in s
# Hostile clients use `victim`, whose pictures take a megabyte each.
CONFIGURATION = """scene: {scenes}/square_room.sdf
seed: {seed}
control: control.sock
http: 127.0.0.1:0
robots:
  good:
    sensors:
      ust: {{model: UST-10LX, mount: {{xyz: [0, 0, 0.3]}}, tcp: '127.0.0.1:0', accuracy: sensor}}
      utm: {{model: UTM-30LX, mount: {{xyz: [0, 0, 0.3]}}, pty: good-utm}}
      urg: {{model: URG-04LX, mount: {{xyz: [0, 0, 0.3]}}, pty: good-urg}}
      tof: {{camera: {{columns: 160, rows: 120, fov_deg: [60, 45], rate_hz: 20, range_m: [0.1, 7.5]}}}}
  driven:
    pose: {{xyz: [-1, -1, 0]}}
    poses: {{from: 'udp:127.0.0.1:{driven}'}}
    sensors:
      ust: {{model: UST-10LX, mount: {{xyz: [0, 0, 0.3]}}, tcp: '127.0.0.1:0'}}
  steered:
    sensors:
      sonar: {{ranger: {{cone_deg: 30, beams: 61, rate_hz: 20, range_m: [0.02, 4.0]}}, mount: {{xyz: [0, 0, 0.3]}}}}
  victim:
    pose: {{xyz: [-1, 1, 0]}}
    poses: {{from: 'udp:127.0.0.1:{victim}'}}
    sensors:
      ust: {{model: UST-10LX, mount: {{xyz: [0, 0, 0.3]}}, tcp: '127.0.0.1:0'}}
      urg: {{model: URG-04LX, mount: {{xyz: [0, 0, 0.3]}}, pty: victim-urg}}
      utm: {{model: UTM-30LX, mount: {{xyz: [0, 0, 0.3]}}, tcp: '127.0.0.1:0', pty: victim-utm}}
      tof: {{camera: {{columns: 400, rows: 300, fov_deg: [60, 45], rate_hz: 20, range_m: [0.1, 7.5]}}}}
"""
STDERR_PIPE_BYTES = 4096  # so small that scipd notices a pause of the reader after a few lines


def free_udp_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Scipd:
    def __init__(self, program, scenes, seed):
        self.folder = tempfile.TemporaryDirectory(prefix="scipd-soak-")
        self.scenes = scenes
        self.udp = {"driven": free_udp_port(), "victim": free_udp_port()}
        self.file = pathlib.Path(self.folder.name) / "rig.yaml"
        self.configuration = CONFIGURATION.format(scenes=scenes, seed=seed, **self.udp)
        self.configure(self.configuration)
        reading, writing = os.pipe()
        self.standard_error = open(reading, "rb", buffering=0)
        try:
            fcntl.fcntl(writing, fcntl.F_SETPIPE_SZ, STDERR_PIPE_BYTES)
            # More than most machines of the tests have.
            self.process = subprocess.Popen([program, "--config", str(self.file), "--threads", "4"],
                                            stdout=subprocess.PIPE, stderr=writing, stdin=subprocess.DEVNULL)
        finally:
            os.close(writing)
        self.pid = self.process.pid

    def wait_until_ready(self):
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError("scipd does not start:\n" + self.standard_error.read().decode(errors="replace"))
        self.ready = json.loads(line)
        self.sensors = {sensor["name"]: sensor for sensor in self.ready["sensors"]}
        self.http = address(self.ready["http"])

    def tcp(self, sensor):
        return address(self.sensors[sensor]["tcp"])

    def tty(self, sensor):
        return self.sensors[sensor]["pty"]

    def configure(self, text):
        """Replaces the file in one step, because scipd may read it at any moment. So may deeds of other processes."""
        fresh = self.file.with_suffix(f".{os.getpid()}")
        fresh.write_text(text)
        fresh.rename(self.file)

    def reload(self):
        os.kill(self.pid, signal.SIGHUP)  # works in any process; send_signal works only in the parent

    def exit_code(self):
        return self.process.poll()

    def end(self):
        """Asks it to end. Returns its exit code, or None if it does not end."""
        self.process.terminate()
        try:
            return self.process.wait(30)
        except subprocess.TimeoutExpired:
            return None
        finally:
            self.process.kill()
            self.process.wait()
            self.folder.cleanup()

    def size(self):
        """Resident memory in MB, descriptors, threads."""
        with open(f"/proc/{self.pid}/status") as status:
            fields = dict(line.split(":", 1) for line in status)
        return int(fields["VmRSS"].split()[0]) / 1024, len(os.listdir(f"/proc/{self.pid}/fd")), int(fields["Threads"])

    def times_s(self):
        """How long its first thread ran, which serves all clients, and by thread how long it and those of the scans
        were ready to run but had no core. Nothing if the kernel does not tell."""
        ran_s, waited_s = 0.0, {}
        for task in pathlib.Path(f"/proc/{self.pid}/task").iterdir():
            first = task.name == str(self.pid)
            try:
                if first or (task / "comm").read_text().startswith("scans"):
                    ran, waited = (task / "schedstat").read_text().split()[:2]
                    waited_s[task.name] = int(waited) * 1e-9
                    ran_s = int(ran) * 1e-9 if first else ran_s
            except (OSError, ValueError):
                pass
        return ran_s, waited_s


def address(text):
    host, port = text.rsplit(":", 1)
    return host, int(port)

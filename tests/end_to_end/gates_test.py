# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Who may come in to a running scipd, and what they may do there: gates_test.py SCIPD SCENE GDAL
import contextlib
import grp
import json
import os
import pathlib
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time

MOVED = json.dumps({"xyz": [0.5, 0, 0]})
POSE = "/robots/robot/pose"
UPGRADE = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
           "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ=="}
EVIL = "http://evil.example"


class Answer:
    def __init__(self, data):
        head, _, self.body = data.partition(b"\r\n\r\n")
        first, *fields = head.decode().split("\r\n")
        self.status = int(first.split()[1])
        self.fields = {key.lower(): value for key, value in (field.split(": ", 1) for field in fields)}

    def refused(self, status, field=None):
        assert self.status == status, (self.status, self.body)
        problem = json.loads(self.body)
        assert problem["status"] == status and problem["detail"], problem
        assert field is None or problem["field"] == field, problem
        assert "access-control-allow-origin" not in self.fields, self.fields
        return problem["detail"]


# What they are told, such as faults of libraries to pass over.
SANITIZERS = {name: value for name, value in os.environ.items() if name.endswith("SAN_OPTIONS")}


class Scipd:
    """With these options and a run directory of its own."""

    def __init__(self, program, folder, *options, cwd=None):
        self.process = subprocess.Popen(
            [program, "--pty", "none", "--tcp", "127.0.0.1:0", *options] if "--config" not in options
            else [program, *options],
            env={"XDG_RUNTIME_DIR": str(folder), "PATH": "/usr/bin:/bin", **SANITIZERS}, cwd=cwd or folder,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        self.ready = json.loads(line) if line else None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def end(self):
        """Returns the exit code and the log."""
        self.process.terminate()
        log = self.process.communicate(timeout=60)[1]
        return self.process.returncode, log

    def exchange(self, family, where, method, path, body, fields):
        with contextlib.closing(socket.socket(family)) as client:
            client.settimeout(60)
            client.connect(where)
            lines = [f"{method} {path} HTTP/1.1"] + [f"{key}: {value}" for key, value in fields.items()]
            text = b"" if body is None else body.encode()
            if body is not None:
                lines.append(f"Content-Length: {len(text)}")
            client.sendall("\r\n".join(lines + ["", ""]).encode() + text)
            data = b""
            while b"\r\n\r\n" not in data or len(data) < end_of(data):
                more = client.recv(65536)
                assert more, data
                data += more
            return Answer(data)

    def tcp(self, method, path, body=None, host=None, **fields):
        """`fields`: with _ for the hyphens in their names."""
        where = self.ready["http"]
        fields = {key.replace("_", "-"): value for key, value in fields.items()}
        host = where if host is None else host
        address, _, port = where.rpartition(":")
        return self.exchange(socket.AF_INET, (address, int(port)), method, path, body, {"Host": host, **fields})

    def unix(self, method, path, body=None, **fields):
        return self.exchange(socket.AF_UNIX, self.ready["control"], method, path, body, {"Host": "scipd", **fields})

    def pose(self):
        return json.loads(self.unix("GET", POSE).body)["xyz"]


def end_of(data):
    head, _, _ = data.partition(b"\r\n\r\n")
    length = [int(line.split(b":")[1]) for line in head.split(b"\r\n") if line.lower().startswith(b"content-length:")]
    return len(head) + 4 + (length[0] if length else 0)


def a_foreign_page_neither_reads_nor_writes(scipd):
    """What a browser sends for a page of others: what it may send unasked, and what it asks first."""
    start = scipd.pose()
    scipd.tcp("GET", "/status", Origin=EVIL).refused(403, "Origin")
    scipd.tcp("GET", "/status", Origin="null").refused(403, "Origin")
    plain = {"Content_Type": "text/plain"}
    scipd.tcp("PUT", POSE, MOVED, Origin=EVIL, **plain).refused(403, "Origin")
    scipd.tcp("POST", "/scene/models", "{}", Origin=EVIL, **plain).refused(403, "Origin")
    scipd.tcp("OPTIONS", POSE, Origin=EVIL, Access_Control_Request_Method="PUT").refused(403, "Origin")
    for path in ("/poses", "/stream"):
        scipd.tcp("GET", path, Origin=EVIL, **{key.replace("-", "_"): value for key, value in UPGRADE.items()}
                  ).refused(403, "Origin")
    # An old browser does not say whose page it is.
    scipd.tcp("PUT", POSE, MOVED, **plain).refused(415, "Content-Type")
    scipd.tcp("PUT", POSE, MOVED).refused(415, "Content-Type")
    assert scipd.pose() == start


def a_rebound_name_neither_reads_nor_writes(scipd):
    """For the browser both page and scipd are evil.example: it tells no origin, or this one."""
    start = scipd.pose()
    port = scipd.ready["http"].rpartition(":")[2]
    host = f"evil.example:{port}"
    scipd.tcp("GET", "/status", host=host).refused(403, "Host")
    scipd.tcp("PUT", POSE, MOVED, host=host, Origin=f"http://{host}", Content_Type="application/json").refused(
        403, "Host")
    for path in ("/poses", "/stream"):
        scipd.tcp("GET", path, host=host, Origin=f"http://{host}",
                  **{key.replace("-", "_"): value for key, value in UPGRADE.items()}).refused(403, "Host")
    assert scipd.pose() == start


def its_own_page_reads_and_writes(scipd):
    own = scipd.ready["http"]
    port = own.rpartition(":")[2]
    for host in (own, f"localhost:{port}", f"[::1]:{port}"):
        assert scipd.tcp("GET", "/status", host=host, Origin=f"http://{host}").status == 200
    answer = scipd.tcp("OPTIONS", POSE, Origin=f"http://localhost:{port}", Access_Control_Request_Method="PUT")
    assert answer.status == 204 and answer.fields["access-control-allow-origin"] == f"http://localhost:{port}"
    assert scipd.tcp("PUT", POSE, MOVED, Origin=f"http://{own}", Content_Type="application/json").status == 204
    assert scipd.pose() == [0.5, 0, 0]
    for path in ("/poses", "/stream"):
        assert scipd.tcp("GET", path, Origin=f"http://{own}", **{key.replace("-", "_"): value
                                                               for key, value in UPGRADE.items()}).status == 101


def the_unix_socket_takes_what_curl_sends(scipd):
    answer = scipd.unix("PUT", POSE, json.dumps({"xyz": [0, 0, 0]}),
                        **{"Content-Type": "application/x-www-form-urlencoded"})
    assert answer.status == 204, answer.body
    assert scipd.pose() == [0, 0, 0]


def check_the_web(program, scene, folder):
    with Scipd(program, folder, "--scene", scene, "--http", "127.0.0.1:0") as scipd:
        a_foreign_page_neither_reads_nor_writes(scipd)
        a_rebound_name_neither_reads_nor_writes(scipd)
        its_own_page_reads_and_writes(scipd)
        the_unix_socket_takes_what_curl_sends(scipd)


def configured(folder, scene, text):
    file = folder / "rig.yaml"
    file.write_text(f"scene: {scene}\n{text}\nrobots: {{robot: {{sensors: {{scanner: {{model: UST-10LX, "
                    "tcp: '0.0.0.0:0'}}}}\n")
    return "--config", str(file)


def check_the_token(program, scene, folder):
    """All addresses of this machine, of which the test reaches loopback."""
    token = folder / "token"
    token.write_text("0123456789abcdef\n")
    token.chmod(0o600)
    with Scipd(program, folder, *configured(folder, scene, "http: {listen: '0.0.0.0:0', token_file: token}")) as scipd:
        scipd.ready["http"] = scipd.ready["http"].replace("0.0.0.0", "127.0.0.1")
        answer = scipd.tcp("GET", "/status")
        answer.refused(401, "Authorization")
        assert answer.fields["www-authenticate"] == "Bearer"
        scipd.tcp("PUT", POSE, MOVED, Content_Type="application/json").refused(401)
        upgrade = {key.replace("-", "_"): value for key, value in UPGRADE.items()}
        for path in ("/poses", "/stream"):
            scipd.tcp("GET", path, Authorization="Bearer 0123456789abcdeg", **upgrade).refused(401)
        knows = {"Authorization": "Bearer 0123456789abcdef"}
        assert scipd.tcp("GET", "/status", **knows).status == 200
        assert scipd.tcp("GET", "/poses", **knows, **upgrade).status == 101
        offer = scipd.tcp("GET", "/poses", Sec_WebSocket_Protocol="scipd, bearer.0123456789abcdef", **upgrade)
        assert offer.status == 101 and offer.fields["sec-websocket-protocol"] == "scipd", offer
        scipd.tcp("GET", "/poses", Sec_WebSocket_Protocol="scipd", **upgrade).refused(401)
        assert scipd.tcp("GET", "/").status in (200, 404), "the page asks for the token; this build may have none"
        scipd.tcp("GET", "/", Origin=EVIL).refused(403, "Origin")
        scipd.tcp("GET", "/status", Origin=EVIL, **knows).refused(403, "Origin")
        scipd.tcp("GET", "/status", host="0.0.0.0:" + scipd.ready["http"].rpartition(":")[2], **knows).refused(403)
        assert scipd.unix("GET", "/status").status == 200
        log = scipd.end()[1]
    assert log.count(f"robot/scanner listens on {scipd.ready['sensors'][0]['tcp']}: every machine") == 1, log
    assert "0123456789abcdef" not in log
    # Nothing answers to a Host of all addresses; this one was asked above. This build may have no page.
    assert "http://0.0.0.0" not in log, log
    assert "the page is at" not in log or f"the page is at http://{scipd.ready['http']}/" in log, log
    with Scipd(program, folder, *configured(folder, scene, "http: 0.0.0.0:0")) as scipd:
        code, log = scipd.end()
        assert code == 2 and ":2: http: other machines reach 0.0.0.0:0" in log, (code, log)


def check_the_group(program, scene, folder):
    """A group of which the user of the test is a member; root can take any."""
    group = grp.getgrgid(max(os.getgroups() + [os.getegid()]) if os.geteuid() else 100)
    control = f"control: {{socket: control.sock, group: {group.gr_name}}}"
    with Scipd(program, folder, *configured(folder, scene, control)) as scipd:
        socket_file = os.stat(scipd.ready["control"])
        assert socket_file.st_gid == group.gr_gid and stat.S_IMODE(socket_file.st_mode) == 0o660, socket_file
        assert scipd.unix("GET", "/status").status == 200


def wait_until(holds):
    end = time.monotonic() + 60
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.1)


def try_files(scipd, files):
    """[(file, status)]: as a world, as a model and as a mesh. What may be read and is none of these gets a 400."""
    for file, status in files:
        for method, path, body in (("PUT", "/scene", {"file": str(file)}),
                                   ("POST", "/scene/models", {"name": "m", "file": str(file)}),
                                   ("POST", "/scene/models", {"name": "m", "mesh": str(file)})):
            answer = scipd.unix(method, path, json.dumps(body))
            assert answer.status == status, (file, body, answer.status, answer.body)
            if status == 403:
                assert "`allow`" in answer.refused(403, next(reversed(body))), answer.body


GDAL = sys.argv[3] == "1"
HEIGHTS = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 1\n0 1\n"
TERRAIN = """<sdf version="1.9"><model name="m"><link name="l"><visual name="v"><geometry>
<heightmap><uri>a.asc</uri><size>9 9 1</size></heightmap></geometry></visual></link></model></sdf>"""


def check_an_elevation_model(program, scene, folder):
    """What reads it lies in no folder that `allow` names."""
    (folder / "a.asc").write_text(HEIGHTS)
    (folder / "terrain.sdf").write_text(TERRAIN)
    with Scipd(program, folder, *configured(folder, scene, "seed: 1")) as scipd:
        answer = scipd.unix("PUT", "/scene", json.dumps({"file": str(folder / "terrain.sdf")}))
        if GDAL:
            assert json.loads(answer.body) == {"warnings": []}, answer.body
        else:
            assert b"built without GDAL" in answer.body, answer.body


def check_the_files(program, scene, folder):
    """All are rubbish: a 400 tells that scipd has read them."""
    home, other, away = folder / "home", folder / "other", folder / "away"
    for place in (home, other, away):
        place.mkdir()
        (place / "x.stl").write_text("rubbish")
    (home / "link").symlink_to(other)
    (home / "link.stl").symlink_to(other / "x.stl")
    with Scipd(program, folder, *configured(home, scene, "seed: 1")) as scipd:
        try_files(scipd, [(home / "x.stl", 400), (other / "x.stl", 403), (home / "link.stl", 403),
                          (home / "link/x.stl", 403), (home / "../other/x.stl", 403), (other / "none.stl", 403),
                          ("/proc/self/environ", 403)])
        assert scipd.unix("PUT", "/scene", json.dumps({"file": scene})).status == 200
    with Scipd(program, folder, *configured(home, scene, "allow: [../other]")) as scipd:
        try_files(scipd, [(home / "x.stl", 403), (other / "x.stl", 400), (home / "link/x.stl", 400), (scene, 403)])
        configured(home, scene, "allow: [../away]")
        scipd.process.send_signal(signal.SIGHUP)
        wait_until(lambda: scipd.unix("PUT", "/scene", json.dumps({"file": str(away / "x.stl")})).status == 400)
        try_files(scipd, [(other / "x.stl", 403), (away / "x.stl", 400)])
    with Scipd(program, folder, "--scene", scene, cwd=other) as scipd:
        try_files(scipd, [(other / "x.stl", 400), (away / "x.stl", 403)])


def main():
    program, scene = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3])
    for check in (check_the_web, check_the_token, check_the_group, check_an_elevation_model,
                  check_the_files):
        with tempfile.TemporaryDirectory() as folder:
            check(program, scene, pathlib.Path(folder))
            print(check.__name__, "holds")


main()

# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The recipes of examples/: all steps that need no network run as they are written, and those of ROS 2 with stand-ins.
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import types

import pytest
from conftest import ROOT

from scipd import find_program

yaml = pytest.importorskip("yaml")
CI = ROOT / "examples" / "ci"
NEEDS_NETWORK = ("apt-get", "git clone", "docker")


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A robot's project with the tests of the recipes, on a machine on which the package is installed."""
    shutil.copytree(CI / "tests", tmp_path / "tests")
    monkeypatch.setenv("PYTEST_ADDOPTS", "-p scipd.pytest_plugin -p no:cacheprovider")
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.delenv("SCIPD")
    # What is called pytest is the one that runs this.
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "pytest").write_text(f"#!/bin/sh\nexec {sys.executable} -m pytest \"$@\"\n")
    (tmp_path / "bin" / "pytest").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}:{os.environ['PATH']}")
    return tmp_path


def run(steps, folder):
    """Each as a runner does: a script of bash that ends with its first fault."""
    for step in steps:
        assert not any(word in step for word in NEEDS_NETWORK), f"this needs a network and does not say so: {step}"
        done = subprocess.run(["bash", "-eo", "pipefail", "-c", step], cwd=folder, capture_output=True, text=True,
                              timeout=120, check=False)
        assert done.returncode == 0, f"{step}\n{done.stdout}{done.stderr}"


def test_the_steps_for_github(project):
    workflow = yaml.safe_load((CI / "github.yml").read_text())
    steps = [step for step in workflow["jobs"]["robot"]["steps"] if "run" in step]
    local = [step["run"] for step in steps if "(needs a network)" not in step["name"]]
    assert local and len(local) < len(steps)
    run(local, project)
    assert (project / "report" / "robot.xml").exists()
    kept = next(step for step in workflow["jobs"]["robot"]["steps"] if step.get("if") == "failure()")
    assert kept["with"]["path"] == "report"


def test_the_steps_for_gitlab(project):
    jobs = yaml.safe_load((CI / "gitlab-ci.yml").read_text())
    run(["\n".join(jobs["robot"]["script"])], project)
    assert (project / jobs["robot"]["artifacts"]["reports"]["junit"]).exists()
    assert jobs["robot"]["artifacts"]["paths"] == ["report"]


def test_both_keep_what_a_failed_test_leaves(project):
    test = project / "tests" / "test_robot.py"
    test.write_text(test.read_text().replace('== "stop', '== "fly'))
    jobs = yaml.safe_load((CI / "gitlab-ci.yml").read_text())
    with pytest.raises(AssertionError, match="1 failed"):
        run(jobs["robot"]["script"], project)
    assert list((project / "report").rglob("wire.txt"))


COMPOSED = """
ip link set lo up
cp /etc/hosts {folder}/hosts
echo 127.0.0.1 {names} >> {folder}/hosts
mount --bind {folder}/hosts /etc/hosts
{server} > ready &
trap 'kill $!' EXIT
for i in $(seq 300); do if grep -q ready ready; then break; fi; sleep 0.1; done
{healthy} > healthy
{driver}
"""


def test_the_commands_of_compose(project):
    services = yaml.safe_load((CI / "compose.yaml").read_text())["services"]
    server, driver = services["scipd"], services["driver"]
    programs = pathlib.Path(find_program()).parent
    for tool in ("scipctl", driver["entrypoint"][0]):
        if not (programs / tool).exists():
            pytest.skip(f"there is no {tool} beside scipd")

    def line(words):
        # The container has scipd installed; here its worlds lie in the sources.
        return " ".join(f"'{word}'" for word in words).replace("/usr/share/scipd/scenes", str(ROOT / "scenes"))

    script = COMPOSED.format(folder=project, names=" ".join(services), server=line(["scipd", *server["command"]]),
                             healthy=line(server["healthcheck"]["test"][1:]),
                             driver=line([*driver["entrypoint"], *driver["command"]]))
    alone = ["unshare", "--map-root-user", "--net", "--mount"]
    if subprocess.run([*alone, "true"], capture_output=True, check=False).returncode != 0:
        pytest.skip("this machine lets nobody have namespaces of the network and of mounts")
    done = subprocess.run([*alone, "bash", "-euo", "pipefail", "-c", script], cwd=project, capture_output=True,
                          text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert len((project / "scans.csv").read_text().splitlines()) >= 40
    assert "robot/scanner" in (project / "healthy").read_text()


# From here on: ROS 2.


class Recorded:
    """Stands for whatever class of ROS: it keeps what it was made of."""

    def __init__(self, *values, **named):
        self.values, self.named = values, named

    def perform(self, context):
        return context.get(self.values[0], "")


@pytest.fixture
def launch_file(monkeypatch):
    """The launch file, for which everything of ROS is made of stand-ins."""
    class AnyName(types.ModuleType):
        def __getattr__(self, name):
            if name.startswith("__"):
                raise AttributeError(name)
            return type(name, (Recorded,), {"TRANSITION_CONFIGURE": 1, "TRANSITION_ACTIVATE": 3})

    for name in ("launch", "launch.actions", "launch.event_handlers", "launch.events", "launch.substitutions",
                 "launch_ros", "launch_ros.actions", "launch_ros.event_handlers", "launch_ros.events",
                 "launch_ros.events.lifecycle", "lifecycle_msgs", "lifecycle_msgs.msg"):
        monkeypatch.setitem(sys.modules, name, AnyName(name))
    return loaded(ROOT / "examples" / "ros2" / "urg_node2_with_scipd.launch.py")


def loaded(file):
    spec = importlib.util.spec_from_file_location("loaded", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_driver_starts_when_scipd_is_ready(launch_file, room):
    *arguments, function = launch_file.generate_launch_description().values[0]
    assert {argument.values[0] for argument in arguments} == set(launch_file.OPTIONS)
    handler, process = function.named["function"]({"world": str(room), "model": "UST-20LX"})
    hear = handler.values[0].named["on_stdout"]
    with subprocess.Popen(process.named["cmd"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as scipd:
        line = scipd.stdout.readline()
        scipd.terminate()
    assert hear(types.SimpleNamespace(text=line[:20])) is None
    *handlers, node = hear(types.SimpleNamespace(text=line[20:]))
    assert hear(types.SimpleNamespace(text=b"more\n")) is None
    parameters = node.named["parameters"][0]
    assert f'"tcp":"{parameters["ip_address"]}:{parameters["ip_port"]}"' in line.decode()
    assert b"UST-20LX" in line and len(handlers) == 2


def test_the_robot_stops_for_old_and_for_near_scans():
    speed_of = loaded(ROOT / "examples" / "ros2" / "stopping_robot.py").speed_of
    assert speed_of([1.0, float("inf"), 2.0], 0.1) > 0
    assert speed_of([1.0], 0.6) == speed_of([0.4, 3.0], 0.1) == speed_of([], 0.1) == 0

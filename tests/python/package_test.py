# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What is handed on: a wheel whose plugin pytest finds by itself, of the version of the project, without dependencies.
import ast
import email
import importlib.metadata
import os
import re
import subprocess
import sys
import zipfile

import pytest
from conftest import ROOT

import scipd

USES_IT = """
def test_it(scipd):
    assert scipd(world={room!r}).scan().nearest()
"""


def test_its_version_is_that_of_the_project():
    project = re.search(r"project\(scipd VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
    assert scipd.__version__ == project[1]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    done = subprocess.run([ROOT / "tools" / "wheel", tmp_path_factory.mktemp("wheel")], capture_output=True, text=True,
                          check=False, env={**os.environ, "SCIPD_PYTHON": sys.executable})
    if done.returncode == 2:
        pytest.skip(done.stderr)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_a_wheel_has_all_and_needs_nothing(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        metadata = email.message_from_bytes(archive.read(f"scipd-{scipd.__version__}.dist-info/METADATA"))
    files = (ROOT / "python" / "src" / "scipd").iterdir()
    sources = {f"scipd/{path.name}" for path in files if path.suffix in (".py", ".typed")}
    assert {name for name in names if name.startswith("scipd/")} == sources
    assert metadata.get_all("Requires-Dist") is None
    assert metadata["Requires-Python"].replace(" ", "") == ">=3.9"


def test_pytest_finds_the_plugin_of_a_wheel_by_itself(wheel, tmp_path, room):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "site")
    check_that_pytest_finds_it(tmp_path / "site", tmp_path, room)


def test_pytest_finds_the_plugin_of_the_debian_package_by_itself(tmp_path, room):
    if "SCIPD_BUILD" not in os.environ:
        pytest.skip("SCIPD_BUILD names no build folder")
    subprocess.run(["cmake", "--install", os.environ["SCIPD_BUILD"], "--component", "python3-scipd", "--prefix",
                    tmp_path], check=True, capture_output=True)
    check_that_pytest_finds_it(tmp_path / "lib" / "python3" / "dist-packages", tmp_path, room)


def check_that_pytest_finds_it(site, tmp_path, room):
    names = importlib.metadata.PathDistribution(next(site.glob("*.dist-info")))
    assert (names.metadata["Name"], names.version) == ("scipd", scipd.__version__)
    (tmp_path / "test_it.py").write_text(USES_IT.format(room=str(room)))
    environment = {key: value for key, value in os.environ.items() if key != "PYTEST_DISABLE_PLUGIN_AUTOLOAD"}
    done = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_it.py"], cwd=tmp_path,
                          env={**environment, "PYTHONPATH": str(site)}, capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0 and "1 passed" in done.stdout, done.stdout + done.stderr


def test_its_types_are_sound(tmp_path):
    mypy = next((path for path in ("/usr/bin/mypy",) if os.path.exists(path)), None)
    if mypy is None:
        pytest.skip("there is no mypy (apt-get install mypy)")
    done = subprocess.run([mypy, "--cache-dir", tmp_path, "src/scipd"], cwd=ROOT / "python", capture_output=True,
                          text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_it_is_written_for_python_3_9():
    # Later grammar would be a syntax error there. What the library lacked then, mypy tells.
    for file in (ROOT / "python" / "src" / "scipd").glob("*.py"):
        ast.parse(file.read_text(), feature_version=(3, 9))

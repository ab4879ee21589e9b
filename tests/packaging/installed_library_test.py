#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Installs the libraries and headers into a new folder, builds examples/ against them as somebody who has nothing else,
and runs the programs.

  installed_library_test.py SOURCES BUILD SCIPD
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCES, BUILD, SCIPD = (pathlib.Path(argument) for argument in sys.argv[1:4])

# A user's project that includes every installed header, and asks for a version.
USER = """
cmake_minimum_required(VERSION 3.22)
project(user LANGUAGES CXX)
find_package(scipd {version} REQUIRED COMPONENTS protocol sim testing)
find_package(GTest REQUIRED)
add_library(user OBJECT user.cpp)
target_compile_options(user PRIVATE -Wall -Wextra -Werror)
target_link_libraries(user PRIVATE scipd::protocol scipd::sim scipd::testing GTest::gtest)
"""


def run(*command, fails=False):
    """What it printed. It must succeed, or fail if that is expected."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=300)
    printed = done.stdout + done.stderr
    assert (done.returncode != 0) == fails, f"{command} ended with {done.returncode}:\n{printed}"
    return printed


def build(source, into, prefix):
    run("cmake", "-S", source, "-B", into, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Debug")
    run("cmake", "--build", into)


def check_headers(prefix, scratch):
    include = prefix / "include/scipd"
    headers = sorted(str(path.relative_to(include)) for path in include.rglob("*.h"))
    assert len(headers) > 50, headers
    for header in headers:
        for needed in re.findall(r'#include "([^"]+)"', (include / header).read_text()):
            assert needed in headers, f"{header} is installed and includes {needed}, which is not"
    user = scratch / "user"
    user.mkdir()
    (user / "user.cpp").write_text("".join(f"#include <{header}>\n" for header in headers))
    (user / "CMakeLists.txt").write_text(USER.format(version="0.1"))
    build(user, scratch / "user-build", prefix)
    (user / "CMakeLists.txt").write_text(USER.format(version="0.2"))
    refused = run("cmake", "-S", user, "-B", scratch / "user-new", f"-DCMAKE_PREFIX_PATH={prefix}", fails=True)
    assert 'not accepted' in refused and 'version: 0.1' in refused, refused


def check_nothing_of_the_sources(prefix):
    """An installed file that names the sources works on no other machine."""
    for file in (prefix / "lib").rglob("*.cmake"):
        for place in (SOURCES, BUILD):
            assert str(place) not in file.read_text(), f"{file} names {place}"


def check_asking(program):
    """Against a scipd in a room where 3 m are straight ahead."""
    with tempfile.TemporaryDirectory() as folder:
        daemon = subprocess.Popen(
            [SCIPD, "--scene", SOURCES / "scenes/square_room.sdf", "--mount", "0,0,0.3,0,0,0", "--accuracy", "ideal",
             "--tcp", "127.0.0.1:0", "--pty", "none", "--control", f"{folder}/control.sock"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            host, port = json.loads(daemon.stdout.readline())["sensors"][0]["tcp"].split(":")
            printed = run(program, host, port)
            assert "UST-10LX" in printed and "1081 ranges; 3000 mm straight ahead" in printed, printed
        finally:
            daemon.terminate()
            daemon.wait(timeout=30)
    refused = run(program, host, port, fails=True)
    assert "nobody listens there" in refused, refused


def check_terrain(program, scratch):
    """GDAL, if scipd was built with it, comes beside the program that reads worlds."""
    if not (BUILD / "libexec/scipd/scipd-read-dem.so").exists():
        return
    (scratch / "heights.asc").write_text("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 1\n0 1\n")
    world = scratch / "terrain.sdf"
    world.write_text("""<sdf version="1.9"><model name="m"><link name="l"><visual name="v"><geometry>
<heightmap><uri>heights.asc</uri><size>9 9 1</size></heightmap></geometry></visual></link></model></sdf>""")
    printed = run(program, world)
    assert "terrain.sdf: 1 objects" in printed, printed


def check_testing(program, scratch):
    """The test of docs/testing.md, which is that of the example."""
    code = (SOURCES / "examples/wall_test.cpp").read_text()
    shown = re.search(r"```cpp\n(.*?)```", (SOURCES / "docs/testing.md").read_text(), re.S)[1]
    assert shown in code, "docs/testing.md shows another test than examples/wall_test.cpp"
    os.environ.update(SCIPD=str(SCIPD), SCIPD_KEEP=str(scratch / "kept"))
    done = subprocess.run([program], cwd=SOURCES, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0 and "[  PASSED  ] 1 test." in done.stdout, done.stdout + done.stderr
    assert not (scratch / "kept").exists(), "a test that has passed keeps something"


def main():
    os.environ.pop("CMAKE_PREFIX_PATH", None)
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        prefix = scratch / "prefix"
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", "libscipd-dev")
        check_nothing_of_the_sources(prefix)
        check_headers(prefix, scratch)
        build(SOURCES / "examples", scratch / "examples", prefix)
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", "scipd")
        os.environ["SCIPD_READ"] = str(prefix / "libexec/scipd/scipd-read")
        printed = run(scratch / "examples/scan_a_room", SOURCES / "scenes/square_room.sdf")
        assert "objects, 3.000 m straight ahead" in printed, printed
        check_terrain(scratch / "examples/scan_a_room", scratch)
        check_asking(scratch / "examples/ask_scanner")
        check_testing(scratch / "examples/wall_test", scratch)


if __name__ == "__main__":
    main()

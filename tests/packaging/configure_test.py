#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Configures the sources as people do who have only what the build needs: configure_test.py CMAKE SOURCES FOLDER
import pathlib
import shutil
import subprocess
import sys

CMAKE, SOURCES, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
WITHOUT_GTEST = "-DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON"


def configured(*options):
    """The exit code, all that CMake printed, and whether there are tests."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    done = subprocess.run([CMAKE, "--preset", "release", "-B", FOLDER, *options], cwd=SOURCES, capture_output=True,
                          text=True, check=False)
    output = " ".join((done.stdout + done.stderr).split())
    return done.returncode, output, (FOLDER / "tests" / "cmake_install.cmake").exists()


def check(condition, *shown):
    if not condition:
        sys.exit(f"configure_test: not as expected: {shown}")


code, output, tests = configured(WITHOUT_GTEST)
check(code == 0 and not tests, code, output)
check("No tests: they need GTest, which `tools/install test` installs" in output, output)

code, output, tests = configured(WITHOUT_GTEST, "-DSCIPD_TESTS=ON")
check(code != 0 and "The tests need GTest: run `tools/install test`" in output, code, output)

code, output, tests = configured("-DBUILD_TESTING=OFF", "-DSCIPD_TESTS=ON")
check(code == 0 and not tests, code, output)
shutil.rmtree(FOLDER)

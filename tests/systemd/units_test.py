# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# systemd understands the units and finds them confined: units_test.py BUILD, with what is installed from there.
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
UNITS = ["scipd.service", "scipd@demo.service", "scipd@demo.socket"]
WORST_EXPOSURE = 2.0
NEEDED = ["Type=notify", "StartLimitBurst=15", "RestartPreventExitStatus=2",
          "WatchdogSec=", "Restart=on-failure", "ExecReload=", "OOMPolicy=continue"]


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    said = done.stdout + done.stderr
    assert done.returncode == 0, (command, said)
    return said


def install(build, root):
    """As a package would. What a Debian has besides are stand-ins."""
    subprocess.run(["cmake", "--install", f"{build}/systemd", "--prefix", "/usr", "--component", "scipd"], check=True,
                   env={**os.environ, "DESTDIR": str(root)}, stdout=subprocess.DEVNULL)
    for program in ("usr/bin/scipd", "bin/sh"):
        path = root / program
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/bin/sh\n")
        path.chmod(0o755)
    for unit in ("sysinit.target", "basic.target", "sockets.target", "network-online.target", "multi-user.target",
                 "shutdown.target"):
        (root / "usr/lib/systemd/system" / unit).write_text("[Unit]\nDefaultDependencies=no\n")


def systemd_understands_them(root):
    said = run("systemd-analyze", "verify", "--man=no", f"--root={root}", *UNITS)
    complaints = [line for line in said.splitlines() if "scipd" in line]
    assert not complaints, complaints


def they_are_confined(root):
    for unit in UNITS[:2]:
        said = run("systemd-analyze", "security", "--offline=true", f"--root={root}", unit)
        exposure = float(re.search(r"exposure level for \S+: ([0-9.]+)", said)[1])
        assert exposure <= WORST_EXPOSURE, said


def each_confine_says_why(root):
    for unit in ("scipd.service", "scipd@.service"):
        service = (root / "usr/lib/systemd/system" / unit).read_text()
        confines = service.partition("# What it may touch.")[2].partition("[Install]")[0].splitlines()
        for above, line in zip(confines, confines[1:]):
            assert not line or line.startswith("#") or above.startswith("#"), line
        for needed in NEEDED:
            assert needed in service, (unit, needed)


def instances_keep_apart(root):
    folder = root / "usr/lib/systemd/system"
    one, many = ((folder / unit).read_text() for unit in ("scipd.service", "scipd@.service"))
    assert "\nRuntimeDirectory=scipd\n" in one and "--config /etc/scipd/scipd.yaml\n" in one, one
    assert "\nRuntimeDirectory=scipd/%i\n" in many and "--config /etc/scipd/%i.yaml\n" in many, many
    # A folder that goes with one instance would take the others' along, and the sockets of systemd.
    assert all("\nRuntimeDirectoryPreserve=yes\n" in unit for unit in (one, many))


def users_and_folders_can_be_made(root):
    if os.geteuid() != 0:
        return
    (root / "etc").mkdir(exist_ok=True)
    run("systemd-sysusers", f"--root={root}")
    assert re.search(r"^scipd:x:\d+:\d+:[^:]*:/nonexistent:/usr/sbin/nologin$", (root / "etc/passwd").read_text(), re.M)
    run("systemd-tmpfiles", "--create", f"--root={root}")
    status = (root / "run/scipd").stat()
    user = re.search(r"^scipd:x:(\d+):(\d+):", (root / "etc/passwd").read_text(), re.M)
    assert (oct(status.st_mode), str(status.st_uid), str(status.st_gid)) == ("0o40750", *user.groups()), status


def main():
    if not shutil.which("systemd-analyze"):
        print("there is no systemd-analyze here")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="scipd-units-") as folder:
        root = pathlib.Path(folder)
        install(sys.argv[1], root)
        for test in (systemd_understands_them, they_are_confined, each_confine_says_why, instances_keep_apart,
                     users_and_folders_can_be_made):
            print(test.__name__.replace("_", " "), flush=True)
            test(root)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# A robot in a few lines: it drives while it hears from its scanner, and says so. robot.py HOST PORT
import socket
import sys

scanner = socket.create_connection((sys.argv[1], int(sys.argv[2])))
scanner.settimeout(0.3)
scanner.sendall(b"MD0500058001000\n")
doing = ""
while True:
    try:
        now = "drive" if scanner.recv(65536) else "stop"
    except socket.timeout:
        now = "stop"
    if now != doing:
        print(now, flush=True)
        doing = now

# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What good and hostile clients use to talk to scipd: SCIP messages and their sums, HTTP requests, WebSocket frames,
# ttys.
import base64
import json
import os
import struct
import termios
import tty

UPGRADE = ("Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " +
           base64.b64encode(bytes(16)).decode() + "\r\n")
JSON = "Content-Type: application/json\r\n"
TEXT_FRAME = 0x81  # the frame is the last of its message


def sum_is_right(line):
    return len(line) > 1 and (sum(line[:-1]) & 0x3F) + 0x30 == line[-1]


def decoded(characters):
    value = 0
    for character in characters:
        value = value << 6 | character - 0x30
    return value


def http_request(where, method, path, body=None, fields=""):
    """`where`: the address and the port that it goes to."""
    text = b"" if body is None else body if isinstance(body, bytes) else json.dumps(body).encode()
    length = f"{JSON}Content-Length: {len(text)}\r\n" if body is not None else ""
    return f"{method} {path} HTTP/1.1\r\nHost: {where[0]}:{where[1]}\r\n{fields}{length}\r\n".encode() + text


PING = 9
PONG = bytes([0x8A, 0x80]) + bytes(4)  # as clients answer a ping without data


def text_frame(text):
    """A frame as clients send it, with a mask that changes nothing."""
    size = len(text)
    length = (bytes([0x80 | size]) if size < 126 else
              bytes([0xFE]) + struct.pack("!H", size) if size < 65536 else
              bytes([0xFF]) + struct.pack("!Q", size))
    return bytes([TEXT_FRAME]) + length + bytes(4) + text


def open_tty(path):
    """Opens it raw and non-blocking."""
    descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        tty.setraw(descriptor, termios.TCSANOW)
    except termios.error:
        os.close(descriptor)
        raise
    return descriptor

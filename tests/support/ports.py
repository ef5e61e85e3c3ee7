"""Ports of this machine, for tests of what is sent over the network."""

from __future__ import annotations

import socket
import time
from pathlib import Path


def free_port(kind: socket.SocketKind) -> int:
    """A port that nobody uses now."""
    with socket.socket(socket.AF_INET, kind) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def wait_until_bound(port: int, kind: socket.SocketKind) -> None:
    """Return once a process receives at a port: a minute at most, for busy machines."""
    table = Path("/proc/net") / ("udp" if kind == socket.SOCK_DGRAM else "tcp")
    for _ in range(3000):
        if f":{port:04X} 00000000:0000" in table.read_text(encoding="ascii"):
            return
        time.sleep(0.02)
    raise TimeoutError(f"nobody receives at port {port}")

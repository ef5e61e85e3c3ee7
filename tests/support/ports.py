"""Ports of this machine, for tests of what is sent over the network."""

from __future__ import annotations

import random
import socket
import threading
from pathlib import Path

from processes import wait_until

# Below those that the kernel gives to whoever asks for any: none of these is taken by chance before its user has it.
_OURS = range(10_000, 32_000)


def free_port(kind: socket.SocketKind) -> int:
    """A port that is free now."""
    while True:
        port = random.SystemRandom().choice(_OURS)
        with socket.socket(socket.AF_INET, kind) as one:
            try:
                one.bind(("127.0.0.1", port))
            except OSError:
                continue
        return port


def wait_until_bound(port: int, kind: socket.SocketKind) -> None:
    """Return once a process receives at a port."""
    table = Path("/proc/net") / ("udp" if kind == socket.SOCK_DGRAM else "tcp")
    bound = f":{port:04X} 00000000:0000"
    assert wait_until(lambda: bound in table.read_text(encoding="ascii")), f"no receiver at port {port}"


class Arrivals(threading.Thread):
    """A UDP port of this machine that keeps what arrives. What is sent here has arrived when it is sent."""

    def __init__(self):
        super().__init__(daemon=True)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        self._datagrams: list[bytes] = []
        self.start()

    def run(self):
        """Until an empty datagram."""
        while datagram := self._socket.recv(1 << 16):
            self._datagrams.append(datagram)

    def all(self) -> bytes:
        """Everything that was sent until now; nothing is received afterwards."""
        self._socket.sendto(b"", self._socket.getsockname())
        self.join()
        self._socket.close()
        return b"".join(self._datagrams)

#!/usr/bin/env python3
"""Nodes of a cluster on one machine: network namespaces, and between them links of a set delay and bandwidth.

Messages cost what they would cost between nodes; the processors are those of this machine, which all nodes share. Needs
root, /dev/net/tun, `ip`, `unshare`, a C++ compiler and Open MPI. scaling-report measures on them; as a program it runs
a command with a rank on each.

  tools/bench/nodes.py --nodes 4 --delay 50e-6 --bandwidth 1e9 lore-evolve jobs/tasks/source.toml --out s1
"""

import argparse
import contextlib
import ctypes
import fcntl
import functools
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

from measuring import Refusal, environment, main

SUBNET = "10.77.0"   # of the nodes alone: no packet leaves them
SWITCH = pathlib.Path(__file__).resolve().with_name("node_switch.cpp")
FRAME = 32768        # bytes; long, since a frame takes the switch as much time whatever its length
NEW_NETWORK = 0x40000000                                     # CLONE_NEWNET, of setns
TAP, NO_HEADER, SET_INTERFACE = 0x0002, 0x1000, 0x400454CA   # of linux/if_tun.h


@functools.cache
def why_not():
    """Why this machine cannot have nodes; empty where it can."""
    if os.geteuid() != 0:
        return "network namespaces are root's"
    for name in ("ip", "unshare", "mpirun", "c++"):
        if not shutil.which(name):
            return f"there is no program '{name}'"
    if "Open MPI" not in subprocess.run(["mpirun", "--version"], capture_output=True, text=True, check=False).stdout:
        return "the options that tell MPI of its nodes are Open MPI's"
    name = f"lore-{os.getpid()}-probe"
    try:
        for words in (("netns", "add", name), ("-n", name, "tuntap", "add", "dev", "probe", "mode", "tap")):
            probe = subprocess.run(["unshare", "--uts", "ip", *words], capture_output=True, text=True, check=False)
            if probe.returncode:
                return probe.stderr.strip().split("\n")[-1]
    finally:
        subprocess.run(["ip", "netns", "del", name], capture_output=True, check=False)
    return ""


class Nodes:
    """`with Nodes(8, latency=1e-4, bandwidth=1e9) as nodes`: 8 nodes, a switch between them. latency: of one way [s];
    bandwidth: of each node's link, either way [bit/s]."""

    def __init__(self, count, *, latency, bandwidth):
        self.names = [f"lore-{os.getpid()}-{number}" for number in range(count)]
        self.latency, self.bandwidth = latency, bandwidth
        self.switch = self.scratch = None

    def __enter__(self):
        problem = why_not()
        if problem:
            raise Refusal(f"no nodes can be made here ({problem}). Run it as root on a machine of your own.")
        try:
            with _stops_waiting():
                self._make_all()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        with _stops_waiting():
            if self.switch:
                self.switch.kill()
                self.switch.wait()
            while running := self._processes():   # a killed mpirun leaves its ranks behind, and those may start others
                for process in running:
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(process, signal.SIGKILL)
                time.sleep(0.01)
            for name in self.names:
                subprocess.run(["ip", "netns", "del", name], capture_output=True, check=False)
            if self.scratch:
                self.scratch.cleanup()

    def command(self, command):
        """`command` with one rank on each node, mpirun itself on the first."""
        own = f"{SUBNET}.0/24"
        mpirun = ["mpirun", "-n", str(len(self.names)), "--host", ",".join(f"{name}:1" for name in self.names),
                  "--bind-to", "none"]
        for name, value in (("plm_rsh_agent", self.agent), ("plm_rsh_no_tree_spawn", "1"), ("btl", "tcp,self"),
                            ("btl_tcp_if_include", own), ("oob_tcp_if_include", own)):
            mpirun += ["--mca", name, value]
        mpirun += ["-x", "LORE_WAITING=sleep"]   # those that wait would take the processors from those that evaluate
        first = self.names[0]
        return ["ip", "netns", "exec", first, "unshare", "--uts", "sh", "-c", f'hostname {first}; exec "$@"', "sh",
                *mpirun, *command]

    def bytes_of_first(self):
        """(received, sent) by the first node so far, all headers included."""
        show = subprocess.run(["ip", "netns", "exec", self.names[0], "cat",
                               "/sys/class/net/wire/statistics/rx_bytes", "/sys/class/net/wire/statistics/tx_bytes"],
                              capture_output=True, text=True, check=True)
        return tuple(map(int, show.stdout.split()))

    def _make_all(self):
        self.scratch = tempfile.TemporaryDirectory()
        agent = pathlib.Path(self.scratch.name, "agent")   # in the place of ssh: agent HOST COMMAND...
        agent.write_text('#!/bin/sh\nhost=$1\nshift\n'
                         'exec ip netns exec "$host" unshare --uts sh -c "hostname $host; $*"\n')
        agent.chmod(0o700)
        self.agent = str(agent)
        taps = [self._make(number, name) for number, name in enumerate(self.names)]
        switch = pathlib.Path(self.scratch.name, "switch")
        if subprocess.run(["c++", "-std=c++20", "-O2", "-o", switch, SWITCH], check=False).returncode:
            raise Refusal(f"{SWITCH.name} cannot be compiled (what the compiler says is above). "
                          "Install a C++ compiler that knows C++20.")
        self.switch = subprocess.Popen([switch, *map(str, (self.latency, self.bandwidth, *taps))], pass_fds=taps)
        for tap in taps:
            os.close(tap)

    def _make(self, number, name):
        """A namespace whose only link is a tap device; its other end, a file descriptor."""
        _ip(["netns", "add", name])
        tap = _open_tap(name)
        others = [other for other in range(len(self.names)) if other != number]
        _ip(["-n", name, "-batch", "-"], "\n".join([
            "link set lo up", f"link set wire address {_hardware(number).hex(':')} mtu {FRAME}",
            f"addr add {SUBNET}.{number + 1}/24 dev wire", "link set wire up",
            *(f"neigh replace {SUBNET}.{other + 1} lladdr {_hardware(other).hex(':')} dev wire" for other in others)]))
        return tap

    def _processes(self):
        """Those on the nodes."""
        return [int(word) for name in self.names
                for word in subprocess.run(["ip", "netns", "pids", name], capture_output=True, text=True,
                                           check=False).stdout.split()]


@contextlib.contextmanager
def _stops_waiting():
    """A stop that comes meanwhile is heard at the end: half-made nodes would be left."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _ip(words, lines=None):
    done = subprocess.run(["ip", *words], input=lines, capture_output=True, text=True, check=False)
    if done.returncode:
        raise Refusal(f"'ip {' '.join(words)}' failed ({done.stderr.strip()}). "
                      "Run it as root on a machine of your own.")


def _hardware(number):
    return bytes((2, 0, 0, 0, 0, number))


def _open_tap(namespace):
    """Of a new device `wire` there. The descriptor works from everywhere."""
    libc = ctypes.CDLL(None, use_errno=True)
    with open("/proc/self/ns/net", "rb") as here, open(f"/run/netns/{namespace}", "rb") as there:
        if libc.setns(there.fileno(), NEW_NETWORK):
            raise OSError(ctypes.get_errno(), f"cannot enter the network namespace {namespace}")
        try:
            tap = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
            fcntl.ioctl(tap, SET_INTERFACE, struct.pack("16sH22x", b"wire", TAP | NO_HEADER))
        finally:
            libc.setns(here.fileno(), NEW_NETWORK)
    return tap


def work():
    usage = __doc__.split("\n\n")
    parser = argparse.ArgumentParser(description="\n\n".join(usage[:2]), epilog="example:\n" + usage[2],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nodes", type=int, metavar="N", required=True, help="from 2 to 200")
    parser.add_argument("--delay", type=float, metavar="SECONDS", default=0.0, help="of one way (default 0)")
    parser.add_argument("--bandwidth", type=float, metavar="BIT/S", default=1e12,
                        help="of a node's link, either way (default 1e12)")
    parser.add_argument("command", nargs=argparse.REMAINDER, help="and its arguments")
    options = parser.parse_args()
    if not 2 <= options.nodes <= 200 or options.delay < 0 or options.bandwidth <= 0 or not options.command:
        parser.error("2 to 200 nodes, a delay of at least 0, a bandwidth above 0, and a command")
    with Nodes(options.nodes, latency=options.delay, bandwidth=options.bandwidth) as nodes:
        code = subprocess.run(nodes.command(options.command), env=environment(), check=False).returncode
    sys.exit(code)


if __name__ == "__main__":
    main(work)

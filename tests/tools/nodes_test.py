#!/usr/bin/env python3
"""Runs on nodes in network namespaces: tests/tools/nodes_test.py SOURCE LORE_EVOLVE

Returns 77 where no nodes can be made.
"""
import contextlib
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

source, program = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3])
sys.path.insert(0, f"{source}/tools/bench")
from nodes import Nodes, why_not   # noqa: E402

NODES = [sys.executable, "-B", f"{source}/tools/bench/nodes.py"]
SERVER = """
import socket
server = socket.create_server(("", 5000))
print("ready", flush=True)
client = server.accept()[0]
while True:
    got = client.recv(1 << 20)
    if not got:
        break
    if got.endswith(b"."):
        client.sendall(b"!")
"""
CLIENT = """
import socket, sys, time
to = socket.create_connection((sys.argv[1], 5000))
for count in (1, 1, int(sys.argv[2])):   # the first finds the way
    begin = time.monotonic()
    to.sendall(b"x" * (count - 1) + b".")
    to.recv(1)
    took = time.monotonic() - begin
    print(took, flush=True)
"""


def namespaces():
    listed = subprocess.run(["ip", "netns", "list"], capture_output=True, text=True, check=True).stdout
    return {line.split()[0] for line in listed.splitlines()}


def made(before):
    """How many nodes there are now; not what tries whether any can be made."""
    return sum(not name.endswith("-probe") for name in namespaces() - before)


def processes(command):
    """Those that run it now, by their numbers."""
    found = []
    for words in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):   # it has ended meanwhile
            if words.read_bytes().split(b"\0")[:-1] == [word.encode() for word in command]:
                found.append(int(words.parent.name))
    return found


class NodesOfOneMachine(unittest.TestCase):
    def talk(self, count, **link):
        """Seconds of a byte there and one back, and of `count` bytes there and one back."""
        with Nodes(2, **link) as nodes:
            inside = [["ip", "netns", "exec", name, sys.executable, "-c"] for name in nodes.names]
            with subprocess.Popen([*inside[1], SERVER], stdout=subprocess.PIPE, text=True) as server:
                server.stdout.readline()
                told = subprocess.run([*inside[0], CLIENT, "10.77.0.2", str(count)], capture_output=True, text=True,
                                      check=True, timeout=60).stdout
        return [float(line) for line in told.split()][1:]

    def test_a_message_takes_no_less_than_the_delay_each_way(self):
        there_and_back, _ = self.talk(1, latency=0.05, bandwidth=1e9)
        self.assertGreater(there_and_back, 0.1)

    def test_a_message_takes_no_less_than_the_bandwidth_gives_its_bytes(self):
        _, million = self.talk(1_000_000, latency=0.0, bandwidth=1e7)
        self.assertGreater(million, 0.8)   # 8 million bits at 10 million a second

    def test_a_run_on_nodes_is_the_run_of_one_process(self):
        with tempfile.TemporaryDirectory() as scratch:
            evolve = [program, f"{source}/jobs/tasks/source.toml", "--seed", "5", "-q", "--set", "evolution.generations=2",
                      "--set", "episode.steps=200", "--out"]
            alone = subprocess.run([*evolve, f"{scratch}/alone"], capture_output=True, text=True, check=True)
            apart = subprocess.run([*NODES, "--nodes", "3", "--delay", "1e-4", "--bandwidth", "1e9", *evolve,
                                    f"{scratch}/apart"], capture_output=True, text=True, check=False)
            self.assertEqual(apart.returncode, 0, apart.stderr)
            self.assertEqual(apart.stdout, alone.stdout)
            self.assertIn("signature: ", apart.stdout)

    def test_nothing_is_left_of_them_when_a_command_fails(self):
        before = namespaces()
        failed = subprocess.run([*NODES, "--nodes", "2", "false"], capture_output=True, check=False)
        self.assertEqual(failed.returncode, 1)
        self.assertEqual(namespaces(), before)

    def test_nothing_is_left_of_them_when_they_are_stopped(self):
        before = namespaces()
        for moment, has_come in (
                ("while they are made", lambda _: made(before) == 1),   # not the probe
                ("once they are made", lambda _: made(before) == 2),
                ("while ranks run", lambda command: len(processes(command)) == 2)):
            with self.subTest(moment):
                command = ["sleep", f"600.{time.time_ns()}"]   # told from every other
                with subprocess.Popen([*NODES, "--nodes", "2", *command], stderr=subprocess.DEVNULL) as stopped:
                    limit = time.monotonic() + 60
                    while not has_come(command) and stopped.poll() is None and time.monotonic() < limit:
                        time.sleep(0.001)
                    stopped.send_signal(signal.SIGTERM)
                    self.assertEqual(stopped.wait(60), 143)
                self.assertEqual(namespaces(), before)
                self.assertEqual(processes(command), [])


if __name__ == "__main__":
    if problem := why_not():
        print(f"skipped: no nodes can be made here ({problem})")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)

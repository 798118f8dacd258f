#!/usr/bin/env python3
"""Watches a campaign of fake programs over HTTP: tests/tools/watch_test.py LORE_CAMPAIGN DIRECTORY_OF_FAKES

Prints a line a check and returns 1 if one failed.
"""
import concurrent.futures
import http.client
import json
import os
import pathlib
import pty
import re
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time

program, fakes = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3])
CAMPAIGN = """
title = "A campaign to watch"
generations = 20
[source]
config = "source.toml"
runs = 2
[[treatment]]
name = "none"
runs = 3
config = "target.toml"
"""
LIMIT = 120   # seconds for what takes one, on a machine with other work
failures = 0


def check(holds, what):
    print(("ok     " if holds else "FAILED ") + what, flush=True)
    global failures
    failures += not holds


def until(condition):
    end = time.monotonic() + LIMIT
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.1)
    return False


class Watch:
    """The program at work, with the port that it has printed."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([program, "watch", "campaign.toml", "--dir", "c", *arguments],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.line = self.process.stdout.readline()
        found = re.match(r"http://127\.0\.0\.1:(\d+)/ shows c; Ctrl-C ends it\n", self.line)
        self.port = int(found[1]) if found else 0

    def get(self, path="/facts.json", method="GET", headers=None, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=LIMIT)
        connection.request(method, path, body=body, headers=headers or {})
        answer = connection.getresponse()
        text = answer.read().decode()
        connection.close()
        return answer, text

    def facts(self):
        return json.loads(self.get()[1])

    def raw(self, data):
        """Whatever comes back for these bytes until the connection is closed."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=LIMIT) as connection:
            answer = b""
            try:
                connection.sendall(data)
                connection.shutdown(socket.SHUT_WR)
                while chunk := connection.recv(65536):
                    answer += chunk
            except OSError:
                pass   # closed before all was sent
            return answer

    def end(self, number=signal.SIGTERM):
        self.process.send_signal(number)
        return self.process.wait(LIMIT)


def everything():
    found = {}
    for folder, _, files in os.walk("c"):
        for name in [folder, *(os.path.join(folder, file) for file in files)]:
            status = os.stat(name)
            found[name] = (status.st_size, status.st_mtime_ns, status.st_ino)
    return found


def run_campaign(**environment):
    return subprocess.Popen([program, "run", "-q", "campaign.toml", "--dir", "c", "--programs", fakes, "--jobs", "2"],
                            env={**os.environ, **environment}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def follow_a_campaign(watch):
    facts = watch.facts()
    check("Waiting for c" in facts["notice"] and facts["counts"]["missing"] == 5, "a directory that is not there is waited for")
    check(not pathlib.Path("c").exists(), "and is not made")
    campaign = run_campaign(LORE_FAKE_MS="200", LORE_FAKE_FAIL="none:2:9")
    check(until(lambda: watch.facts()["counts"]["running"] > 0), "runs at work are seen")
    check(until(lambda: watch.facts()["seconds_left"] is not None), "with the time left")
    check(watch.facts()["notice"] == "", "nothing is waited for any more")
    campaign.send_signal(signal.SIGTERM)
    check(campaign.wait(LIMIT) == 75, "the campaign is stopped")
    check(until(lambda: watch.facts()["counts"]["running"] == 0), "and seen to have stopped")
    run_campaign(LORE_FAKE_FAIL="none:2:9").wait(LIMIT)
    check(until(lambda: watch.facts()["counts"]["done"] == 4), "its restart is followed to the end")
    failed = watch.facts()["failures"]
    check([failure["step"] for failure in failed] == ["none/002"] and "the fake fails" in failed[0]["tail"][-1],
          "a failure comes with the end of its log")
    before = everything()
    time.sleep(5)
    watch.facts()
    check(before == everything(), "watching leaves the campaign's directory as it is")


def ask_wrongly(watch):
    for method in ("POST", "HEAD", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "BREW"):
        answer, _ = watch.get("/", method)
        check(answer.status == 405 and answer.getheader("Allow") == "GET", f"{method} is refused")
    check(watch.get("/", "POST", body="a" * 1000)[0].status == 405, "also with a body")
    for host, status in {"example.org": 403, "127.0.0.1.example.org": 403, "localhost:9000": 200, "[::1]": 200}.items():
        check(watch.get("/", headers={"Host": host})[0].status == status, f"host {host}: {status}")
    check(b" 403 " in watch.raw(b"GET / HTTP/1.0\r\n\r\n").split(b"\r\n")[0], "no host: 403")
    for path in ("/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/c/runs", "//", "/facts.json/..", "/\\..\\"):
        answer, text = watch.get(path)
        check(answer.status == 404 and "root:" not in text, f"{path}: 404")
    check(watch.get("/facts.json?a=<script>")[0].status == 200, "a query is ignored")
    long = b"GET / HTTP/1.1\r\nHost: localhost\r\n" + b"".join(b"X-%d: %s\r\n" % (i, b"a" * 1000) for i in range(100)) + b"\r\n"
    for what, data in {"too large a header": b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"a" * 100000 + b"\r\n\r\n",
                       "too many headers": long, "too long a path": b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n",
                       "noise": os.urandom(2000) + b"\r\n\r\n"}.items():
        line = watch.raw(data).split(b"\r\n")[0]
        check(line == b"" or b" 4" in line, f"{what} is refused: {line[:40]}")
    page, _ = watch.get("/")
    check("default-src 'none'" in page.getheader("Content-Security-Policy", ""), "the page may load nothing")
    check(page.getheader("Access-Control-Allow-Origin") is None, "and no other page may read it")
    answer, text = watch.get("/replay.json")
    check(answer.status == 200 and json.loads(text) == [], "fake programs leave no robot to replay")


def crowd(watch):
    slow = []
    for _ in range(100):
        connection = socket.create_connection(("127.0.0.1", watch.port), timeout=LIMIT)
        connection.sendall(b"GET / HTTP/1.1\r\nHost: loc")
        slow.append(connection)
    began = time.monotonic()
    check(watch.get("/")[0].status == 200, "100 clients that do not finish their requests keep nobody waiting")
    check(time.monotonic() - began < 9, "not even until they are given up")
    with concurrent.futures.ThreadPoolExecutor(40) as pool:
        answers = list(pool.map(lambda _: watch.get()[0].status, range(400)))
    check(answers == [200] * 400, "400 requests of 40 clients are answered")
    return slow


def share_the_machine(watch):
    listening = [line.split()[1] for line in pathlib.Path("/proc/net/tcp").read_text().splitlines()[1:]
                 if line.split()[3] == "0A" and line.split()[1].endswith(f":{watch.port:04X}")]
    check(listening == [f"0100007F:{watch.port:04X}"], f"it listens on the loopback address alone: {listening}")
    usual, other = Watch(), Watch()
    check(usual.port not in (0, other.port) and other.port != 0, "two watch at once without a word about ports")
    check(other.facts()["title"] == "A campaign to watch", "the second is answered by itself")
    refused = subprocess.run([program, "watch", "campaign.toml", "--dir", "c", "--port", str(watch.port)],
                             capture_output=True, text=True, timeout=LIMIT)
    check(refused.returncode == 1 and refused.stderr.count("\n") == 1 and "another program has this port" in refused.stderr,
          f"a port that is taken is refused: {refused.stderr.strip()}")
    check(usual.end() == 0 and other.end(signal.SIGHUP) == 0, "both end")
    wrong = subprocess.run([program, "watch", "nothing.toml", "--dir", "c"], capture_output=True, text=True, timeout=LIMIT)
    check(wrong.returncode == 2 and wrong.stderr.count("\n") == 1, f"no campaign: {wrong.stderr.strip()}")


def read_as_text():
    watch = subprocess.Popen([program, "watch", "campaign.toml", "--dir", "c", "--text"], stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, text=True)
    lines = [watch.stdout.readline() for _ in range(5)]
    check(any(" none/001 done: " in line for line in lines) and any(" none/002 failed: exit code 1" in line for line in lines),
          "without a terminal there is a line a change")
    watch.send_signal(signal.SIGINT)
    check(watch.wait(LIMIT) == 0 and watch.stderr.read() == "", "Ctrl-C ends it with 0")
    lost = subprocess.run(f"'{program}' watch campaign.toml --dir c --text > /dev/full", shell=True, capture_output=True,
                          text=True, timeout=LIMIT)
    check(lost.returncode == 1 and "cannot write the result" in lost.stderr, "it ends where nobody can read it")

    pid, terminal = pty.fork()
    if pid == 0:
        os.execv(program, [program, "watch", "campaign.toml", "--dir", "c", "--text"])
    shown, end = b"", time.monotonic() + LIMIT
    while shown.count(b"4 of 5 steps done") < 2 and time.monotonic() < end:
        if select.select([terminal], [], [], 1)[0]:
            shown += os.read(terminal, 65536)
    check(b"A campaign to watch" in shown and re.search(rb"\x1b\[\d+A\x1b\[J", shown) is not None,
          "on a terminal the picture is drawn anew in place")
    os.kill(pid, signal.SIGINT)
    try:
        while os.read(terminal, 65536):
            pass
    except OSError:
        pass   # how a terminal ends
    check(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 0, "and Ctrl-C ends it with 0")


with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    for task in ("source", "target"):
        pathlib.Path(f"{task}.toml").write_text(f'name = "{task}"\ntask = "{task}"\n')
    pathlib.Path("campaign.toml").write_text(CAMPAIGN)
    watch = Watch("--port", "0")
    check(watch.port != 0, f"one line tells the address: {watch.line.strip()}")
    try:
        follow_a_campaign(watch)
        ask_wrongly(watch)
        connections = crowd(watch)
        share_the_machine(watch)
        began = time.monotonic()
        check(watch.end() == 0 and time.monotonic() - began < 30, "TERM ends it with 0, whoever is connected")
        check(watch.process.stderr.read() == "", "and it has complained of nothing")
    finally:
        watch.process.kill()
        watch.process.wait()
    read_as_text()
sys.exit(1 if failures else 0)

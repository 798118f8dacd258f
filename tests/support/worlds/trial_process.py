"""A world in a process for tests, by the page of its frames alone (docs/manual/formats.md), with faults to choose.

Two sensors, "phase" and the binary "flag"; the effector "push", which is the reward; lives end after 700 pushes above
0.75. The setting `fault` names the rule that is broken.
"""
import os
import signal
import struct
import sys
import time
import tomllib

AT_STEP = 17  # where faults of single values show
BAD = {"nan_sensor": (0, float("nan")), "sensor_range": (0, 1.25), "binary": (1, 0.25), "position": (2, -3.0)}


def text(words):
    return struct.pack("<I", len(words)) + words.encode()


def write(data):
    while data:
        data = data[os.write(1, data):]


def frame(tag, batch, payload):
    return struct.pack("<8sII", tag.encode(), batch, len(payload)) + payload


def read(size):
    data = b""
    while len(data) < size:
        more = os.read(0, size - len(data))
        if not more:
            if fault == "hangs_at_the_end":
                time.sleep(600)
            sys.exit(0)
        data += more
    return data


def facts():
    binary, effectors, version, scene, name = 1, 1, 1, "<g/>", "trial"
    if fault == "binary_fact":
        binary = 2
    elif fault == "many_effectors":
        effectors = 17
    elif fault == "version":
        version = 2
    elif fault == "long_scene":
        scene = "<" + "x" * 1000000
    elif fault == "name":
        name = "Trial"
    most_lives = {"max_batch": 0, "huge_batch": 2**31, "wide": 1024}.get(fault, 64)
    names = [(0, "phase"), (binary, "flag"), (0, "push")]
    if fault == "wide":
        effectors = 16
        names += [(0, f"push_{i}") for i in range(15)]
    channels = b"".join(struct.pack("<I", bit) + text(word) for bit, word in names)
    numbers = struct.pack("<5I2f", version, 2, effectors, 1, most_lives, 2, 3)
    if fault == "lying_text":
        return numbers + struct.pack("<I", 2**32 - 1) + b"trial"
    payload = numbers + text(name) + text("plain") + text("pushes") + channels + text(scene)
    return payload[:50] if fault == "short_facts" else payload + b"more" * (fault == "long_facts")


class Lives:
    def __init__(self, n):
        self.n, self.steps = n, 0
        self.pushes, self.over = [0] * n, [0] * n

    def senses(self):
        rows = [[(pushes % 8) / 8, float(pushes % 2), 1.0, 2.0] for pushes in self.pushes]
        if self.steps == AT_STEP and fault in BAD:
            channel, value = BAD[fault]
            rows[-1][channel] = value
        return floats(row[c] for c in range(4) for row in rows)

    def act(self, efforts):
        rewards = []
        for i, push in enumerate(efforts[:self.n]):
            rewards.append(0.0 if self.over[i] else push)
            self.pushes[i] += push > 0.75 and not self.over[i]
            self.over[i] = int(self.pushes[i] >= 700)
        if self.steps == AT_STEP - 1 and fault == "infinite_reward":
            rewards[0] = float("inf")
        if self.steps == AT_STEP - 1 and fault == "over":
            self.over[0] = 2
        self.steps += 1
        return self.senses() + floats(rewards) + bytes(self.over)

    def outcome(self):
        return floats(float("nan") if fault == "outcome" else pushes for pushes in self.pushes)


def floats(values):
    values = list(values)
    return struct.pack(f"<{len(values)}f", *values)


def faulty(batch, payload):
    """What is written in place of the answer at step AT_STEP; the answer where the fault is another one."""
    good = frame("results", batch, payload)
    if fault == "exits":
        sys.exit(3)
    elif fault == "is_killed":
        os.kill(os.getpid(), signal.SIGKILL)
    elif fault == "hangs":
        time.sleep(600)
    elif fault == "closes":
        os.close(1)
        time.sleep(600)
    elif fault == "cut":
        write(good[:26])
        sys.exit(0)
    elif fault == "prints":
        return b"now at step 17\n"
    elif fault == "zeros":
        return bytes(64)
    elif fault == "stammers":  # begins as the answer does
        write(b"res")
        time.sleep(0.05)
        return b"t\0\0\0"
    elif fault == "prints_behind":
        return good + b"done\n"
    elif fault == "short":
        return frame("results", batch, payload[:-1])
    elif fault == "long":
        return frame("results", batch, payload + b"\0")
    elif fault == "endless":
        return struct.pack("<8sII", b"results", batch, 2**32 - 1)
    elif fault == "other_answer":
        return frame("senses", batch, payload)
    elif fault == "other_batch":
        return frame("results", batch + 1, payload)
    elif fault == "fails":
        return frame("failure", batch, text("the pole\nbroke"))
    elif fault == "refuses_late":
        return frame("refused", batch, text("too late"))
    elif fault == "slow":
        for byte in good:
            write(bytes([byte]))
            time.sleep(0.001)
        return b""
    return good


fault = ""
batches = {}
while True:
    tag, batch, size = struct.unpack("<8sII", read(16))
    payload = read(size)
    tag = tag.rstrip(b"\0").decode()
    if tag == "open":
        settings = tomllib.loads(payload[8:].decode())
        fault = settings.pop("fault", "")
        if path := settings.pop("process_file", ""):
            with open(path, "w") as file:
                file.write(str(os.getpid()))
        write(frame("refused", 0, text(f"it does not know\n{settings}")) if settings else frame("facts", 0, facts()))
    elif tag == "begin":
        batches[batch] = Lives(*struct.unpack("<I", payload))
        write(frame("senses", batch, batches[batch].senses()))
    elif tag == "act":
        lives = batches[batch]
        payload = lives.act(struct.unpack(f"<{len(payload) // 4}f", payload))
        write(faulty(batch, payload) if lives.steps == AT_STEP else frame("results", batch, payload))
    elif tag == "outcome":
        write(frame("outcomes", batch, batches[batch].outcome()))
    elif tag == "end":
        del batches[batch]

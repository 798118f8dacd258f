"""lore_world.py: what it answers, as the page of its frames says, and the worlds that lore-world makes of it."""
import importlib.util
import math
import os
import pathlib
import struct
import subprocess
import sys
import textwrap
import unittest
from typing import Any

import numpy as np

import lore_gymnasium
import lore_world
from support import SOURCE_DIR, LoreTest, program

PYTHON = SOURCE_DIR / "tools" / "python"

COUNTER = """
import lore_world

class Counter:
    name = "counter"
    sensors = {"share": float, "odd": bool}
    effectors = ["push", "pull"]
    width = 10

    def __init__(self, last=4):
        if last < 1:
            raise ValueError(f"last is {last}")
        self.last = last

    def reset(self):
        self.steps = 0
        return self.senses(), (0, 1)

    def step(self, effectors):
        self.steps += 1
        return self.senses(), effectors[0] - effectors[1], self.steps == self.last, (self.steps, 1)

    def senses(self):
        return [self.steps / self.last, self.steps % 2]

    def outcome(self):
        return [self.steps, -self.steps, 0.5]
"""


class Lore:
    """The other end of the pipes."""

    def __init__(self, script: pathlib.Path, *arguments: str) -> None:
        environment = {
            **os.environ,
            "PYTHONPATH": str(PYTHON),
            "PYTHONDONTWRITEBYTECODE": "1",
            "LORE_WORLD_PROCESS": "1",
        }
        self.process = subprocess.Popen([sys.executable, *arguments, script], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, env=environment, bufsize=0)  # fmt: skip

    def tell(self, tag: str, batch: int, payload: bytes = b"") -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(struct.pack("<8sII", tag.encode(), batch, len(payload)) + payload)

    def ask(self, tag: str, batch: int, payload: bytes = b"") -> tuple[str, int, bytes]:
        self.tell(tag, batch, payload)
        answer, batch, size = struct.unpack("<8sII", self.read(16))
        return answer.rstrip(b"\0").decode(), batch, self.read(size)

    def read(self, size: int) -> bytes:
        assert self.process.stdout is not None
        data = b""
        while len(data) < size:
            more = self.process.stdout.read(size - len(data))
            assert more, f"the answer ends after {data!r}: {self.end()}"
            data += more
        return data

    def open(self, settings: str = "") -> tuple[str, int, bytes]:
        return self.ask("open", 0, struct.pack("<II", 1, len(settings)) + settings.encode())

    def begin(self, batch: int, n: int) -> list[float]:
        tag, _, payload = self.ask("begin", batch, struct.pack("<I", n))
        assert tag == "senses", payload
        return np.frombuffer(payload, "<f4").tolist()

    def act(
        self, batch: int, effectors: list[list[float]], sensors: int
    ) -> tuple[list[list[float]], list[float], list[int]]:
        """[channel][n] -> sensors, x and y [channel][n], rewards, over"""
        n = len(effectors[0])
        tag, answered, payload = self.ask("act", batch, np.array(effectors, "<f4").tobytes())
        assert (tag, answered) == ("results", batch), payload
        senses = np.frombuffer(payload, "<f4", (sensors + 2) * n).reshape(-1, n)
        rewards = np.frombuffer(payload, "<f4", n, senses.nbytes)
        return senses.tolist(), rewards.tolist(), list(payload[senses.nbytes + rewards.nbytes :])

    def outcome(self, batch: int) -> list[float]:
        return np.frombuffer(self.ask("outcome", batch)[2], "<f4").tolist()

    def end(self) -> tuple[int, str]:
        """Exit code and what it printed, after the end of its input."""
        _, errors = self.process.communicate(timeout=60)
        return self.process.returncode, errors.decode()

    def close(self) -> None:
        self.process.kill()
        self.process.communicate()


def reason_of(answer: tuple[str, int, bytes]) -> tuple[str, str]:
    tag, _, payload = answer
    (size,) = struct.unpack_from("<I", payload)
    assert len(payload) == 4 + size
    return tag, payload[4:].decode()


class WorldTest(LoreTest):
    def start(self, script: str, *arguments: str) -> Lore:
        file = self.scratch / "mine.py"
        file.write_text(textwrap.dedent(script))
        lore = Lore(file, *arguments)
        self.addCleanup(lore.close)
        return lore

    def check(self, script: str, *arguments: str, settings: str = "") -> str:
        """What lore-world check says of a world that keeps its contract."""
        (self.scratch / "mine.py").write_text(textwrap.dedent(script))
        for module in (PYTHON / "lore_world.py", PYTHON / "lore_gymnasium.py", pathlib.Path(__file__).parent / "gymnasium_stub.py"):
            (self.scratch / module.name).write_text(module.read_text())
        config = self.scratch / "mine.toml"
        config.write_text(f'[world]\nprocess = ["{sys.executable}", "-B", "mine.py"]\n[world.settings]\n{settings}')
        return program("lore-world", "check", "--config", config, "--steps", 60, *arguments)


class Serve(WorldTest):
    def test_tells_the_facts_of_the_class(self) -> None:
        lore = self.start(COUNTER + "lore_world.serve(Counter)")
        tag, batch, payload = lore.open("last = 5\n")
        self.assertEqual((tag, batch), ("facts", 0))
        self.assertEqual(struct.unpack_from("<5I2f", payload), (1, 2, 2, 3, 256, 10, 1))

        def text(words: str) -> bytes:
            return struct.pack("<I", len(words)) + words.encode()

        channels = [(0, "share"), (1, "odd"), (0, "push"), (0, "pull")]
        names = b"".join(struct.pack("<I", binary) + text(name) for binary, name in channels)
        self.assertEqual(payload[28:], text("counter") + text("default") + text("reward") + names + text(""))
        self.assertEqual(lore.end(), (0, ""))

    def test_steps_lives_and_leaves_those_that_are_over(self) -> None:
        lore = self.start(COUNTER + "lore_world.serve(Counter)")
        lore.open("last = 2\n")
        self.assertEqual(lore.begin(7, 2), [0, 0, 0, 0, 0, 0, 1, 1])
        lore.begin(8, 1)
        push, pull = [1, 0.5], [0.25, 0.5]
        self.assertEqual(lore.act(7, [push, pull], 2), ([[0.5, 0.5], [1, 1], [1, 1], [1, 1]], [0.75, 0], [0, 0]))
        self.assertEqual(lore.act(7, [push, pull], 2), ([[1, 1], [0, 0], [2, 2], [1, 1]], [0.75, 0], [1, 1]))
        self.assertEqual(lore.act(7, [push, pull], 2), ([[1, 1], [0, 0], [2, 2], [1, 1]], [0, 0], [1, 1]))
        self.assertEqual(lore.outcome(7), [2, 2, -2, -2, 0.5, 0.5])
        self.assertEqual(lore.outcome(8), [0, 0, 0.5])
        lore.tell("end", 7)
        self.assertEqual(lore.begin(9, 2), [0, 0, 0, 0, 0, 0, 1, 1])
        self.assertEqual(lore.end(), (0, ""))

    def test_keeps_what_is_printed_out_of_the_frames(self) -> None:
        noise = """
        import os, sys
        print("while it is imported", flush=True)
        print("to the error stream", file=sys.stderr)
        class Loud(Counter):
            def step(self, effectors):
                print("by print")
                os.system("echo by a child")
                os.write(1, b"by the system\\n")
                print("read:", repr(sys.stdin.read()))
                return super().step(effectors)
        lore_world.serve(Loud)
        """
        lore = self.start(COUNTER + textwrap.dedent(noise))
        lore.open()
        lore.begin(1, 1)
        self.assertEqual(lore.act(1, [[1], [0]], 2)[1], [1])
        code, errors = lore.end()
        self.assertEqual(code, 0)
        for words in ("while it is imported", "by print", "by a child", "by the system", "read: ''"):
            self.assertIn(words, errors)

    def test_tells_an_exception_with_its_place_and_prints_its_traceback(self) -> None:
        lore = self.start(COUNTER.replace("self.steps += 1", "self.steps += missing") + "lore_world.serve(Counter)")
        lore.open()
        lore.begin(1, 1)
        answer = reason_of(lore.ask("act", 1, struct.pack("<2f", 0, 0)))
        self.assertEqual(answer, ("failure", "NameError: name 'missing' is not defined, mine.py:20 in step"))
        code, errors = lore.end()
        self.assertEqual(code, 1)
        self.assertIn("Traceback", errors)

    def test_tells_what_is_wrong_with_a_world(self) -> None:
        for change, told in {
            ("return self.senses(), (0, 1)", "return [1], (0, 1)"): "reset gave 1 sensors, and the world has 2",
            ('name = "counter"', "title = 3"): "the world has no 'name'",
            ('["push", "pull"]', '["push", "push"]'): "two channels have one name",
        }.items():
            lore = self.start(COUNTER.replace(*change) + "lore_world.serve(Counter)")
            self.assertEqual(reason_of(lore.open()), ("failure", told))
            self.assertEqual(lore.end(), (1, ""))
        lore = self.start(
            COUNTER.replace("self.steps == self.last, (self.steps, 1)", "0, 1, 2") + "lore_world.serve(Counter)"
        )
        lore.open()
        lore.begin(1, 1)
        answer = reason_of(lore.ask("act", 1, struct.pack("<2f", 0, 0)))
        self.assertIn("step gave 5 things, and not sensors, reward, over", answer[1])

    def test_refuses_settings_that_the_class_does_not_take(self) -> None:
        for settings, told in {
            "lats = 3\n": "it does not know 'lats'; it knows: last",
            "last = 0\n": "ValueError: last is 0, mine.py:12 in __init__",
            'last = "x"\n': "TypeError: '<' not supported between instances of 'str' and 'int', mine.py:11 in __init__",
        }.items():
            lore = self.start(COUNTER + "lore_world.serve(Counter)")
            self.assertEqual(reason_of(lore.open(settings)), ("refused", told))

    def test_takes_no_frames_of_another_version(self) -> None:
        lore = self.start(COUNTER + "lore_world.serve(Counter)")
        self.assertEqual(lore.ask("open", 0, struct.pack("<II", 2, 0)), ("facts", 0, struct.pack("<I", 1)))
        self.assertEqual(reason_of(lore.ask("dream", 0))[0], "failure")

    def test_outcomes_are_the_last_sensors_where_a_world_has_none(self) -> None:
        lore = self.start(COUNTER.replace("def outcome", "def another") + "lore_world.serve(Counter)")
        self.assertEqual(struct.unpack_from("<4I", lore.open()[2])[3], 2)
        lore.begin(1, 1)
        lore.act(1, [[0], [0]], 2)
        self.assertEqual(lore.outcome(1), [0.25, 1])


TWINS = """
import numpy as np
import lore_world

class Alone:
    name, task = "twins", "alone"
    sensors, effectors = {"phase": float, "late": bool}, ["push"]
    width, height = 100, 2

    def reset(self):
        self.x, self.steps = np.float32(0), 0
        return self.senses()

    def step(self, effectors):
        self.steps += 1
        self.x = self.x * np.float32(0.75) + np.float32(effectors[0])
        return self.senses(), self.x, self.x > 3.5, (self.steps % 100, self.x / 2)

    def senses(self):
        return self.x / 8, self.steps > 10

    def outcome(self):
        return self.x, self.steps

class Together(Alone):
    def reset(self, n):
        self.x, self.steps = np.zeros(n, np.float32), 0
        return self.senses()

    def step(self, effectors):
        self.steps += 1
        self.x *= np.float32(0.75)
        self.x += effectors[0]
        places = np.stack([np.full(self.x.shape, self.steps % 100), self.x / 2])
        return self.senses(), self.x, self.x > 3.5, places

    def senses(self):
        return np.stack([self.x / 8, np.full(self.x.shape, self.steps > 10)])

    def outcome(self):
        return np.stack([self.x, np.full(self.x.shape, self.steps)])

class Bare(Together):
    outcome = property()   # there is none: the last sensors

    def senses(self):
        self.seen = getattr(self, "seen", None)
        if self.seen is None or self.seen.shape[1] != len(self.x):
            self.seen = np.zeros((2, len(self.x)), np.float32)
        self.seen[0], self.seen[1] = self.x / 8, self.steps > 10
        return self.seen
"""


class ServeBatches(WorldTest):
    def test_gives_what_the_same_world_gives_life_by_life(self) -> None:
        draw = np.random.default_rng(1)
        pushes = np.float32(draw.uniform(0.95, 1, (60, 1, 5)) * np.linspace(0.6, 1, 5))
        seen = []
        # Without outcomes of their own, and with arrays that change in place, lives that are over keep their sensors.
        for serve in ("serve(Alone)", "serve_batches(Together)", "serve_batches(Bare)"):
            lore = self.start(TWINS + f"lore_world.{serve}")
            lore.open()
            begun = lore.begin(1, 5)
            steps = [lore.act(1, push.tolist(), 2) for push in pushes]
            seen.append((begun, steps, lore.outcome(1)))
            self.assertTrue(0 < sum(steps[-1][2]) < 5, "some lives are over, and others go on")
            self.assertEqual(lore.end(), (0, ""))
        self.assertEqual(seen[0], seen[1])
        begun, steps, outcome = seen[2]
        self.assertEqual((begun, steps), seen[0][:2])
        self.assertEqual(outcome, [value for row in steps[-1][0][:2] for value in row])

    def test_keeps_the_contract(self) -> None:
        self.assertIn("speed", self.check(TWINS + "lore_world.serve(Alone)"))
        self.assertIn("speed", self.check(TWINS + "lore_world.serve_batches(Together)"))

    def test_tells_shapes_that_are_wrong(self) -> None:
        lore = self.start(
            TWINS.replace("self.x > 3.5, places", "[True], places") + "lore_world.serve_batches(Together)"
        )
        lore.open()
        lore.begin(1, 3)
        answer = reason_of(lore.ask("act", 1, struct.pack("<3f", 0, 0, 0)))
        self.assertEqual(answer, ("failure", "over of step: the shape is (1,), and not (3,)"))


class ServeGymnasium(WorldTest):
    def test_maps_observations_to_the_unit_interval(self) -> None:
        import gymnasium_stub as gymnasium

        infinite, largest = math.inf, 3.4028235e38
        box = gymnasium.Box([-2, 0, -infinite, -largest, 1], [2, infinite, 5, largest, 1])
        kinds, observe = lore_gymnasium._observer(box)
        self.assertEqual(kinds, [float] * 5)
        self.assertEqual(observe(np.array([-1, 3, 2, 1, 1])), [0.25, 0.75, 0.25, 0.75, 0])
        self.assertEqual(observe(np.array([9, 0, 5, -3, 1])), [1, 0, 1, 0.125, 0])
        kinds, observe = lore_gymnasium._observer(gymnasium.Discrete(3, start=5))
        self.assertEqual((kinds, observe(np.int64(6))), ([bool] * 3, [0, 1, 0]))
        kinds, observe = lore_gymnasium._observer(gymnasium.MultiBinary((2, 2)))
        self.assertEqual((kinds, observe(np.array([[1, 0], [1, 1]]))), ([bool] * 4, [1, 0, 1, 1]))
        with self.assertRaisesRegex(lore_world.WorldError, "space Text are not mapped"):
            lore_gymnasium._observer(gymnasium.Text())

    def test_maps_effectors_to_actions(self) -> None:
        import gymnasium_stub as gymnasium

        kinds, action = lore_gymnasium._actor(gymnasium.Box([[-2, 0]], [[2, 10]]))
        self.assertEqual((kinds, action([0.25, 1]).tolist()), ([float] * 2, [[-1, 10]]))
        self.assertEqual(action([0.25, 1]).dtype, np.float32)
        kinds, action = lore_gymnasium._actor(gymnasium.Discrete(2))
        self.assertEqual((kinds, action([0]), action([1])), ([bool], 0, 1))
        kinds, action = lore_gymnasium._actor(gymnasium.Discrete(3, start=-1))
        self.assertEqual((kinds, action([0.5, 0.5, 0.25]), action([0, 0.1, 0.2])), ([float] * 3, -1, 1))
        kinds, action = lore_gymnasium._actor(gymnasium.MultiBinary(3))
        self.assertEqual((kinds, action([1, 0, 1]).tolist()), ([bool] * 3, [1, 0, 1]))
        with self.assertRaisesRegex(lore_world.WorldError, "no bounds"):
            lore_gymnasium._actor(gymnasium.Box([-math.inf], [1]))

    def test_makes_a_world_of_an_environment_that_keeps_the_contract(self) -> None:
        script = """
        import gymnasium_stub, lore_gymnasium
        lore_gymnasium.serve(gymnasium_stub.Walk, sensors=["left", "right"], position=lambda env: (env.place + 8, 1),
                                   size=(16, 2), reward_unit="steps")
        """
        said = self.check(script, settings='task = "steep"\nseed = 3\nslope = 0.5\n')
        self.assertIn("world stub_walk_v0 steep from ", said)
        self.assertNotIn("effectors changed nothing", said)
        lore = self.start(script)
        self.assertEqual(reason_of(lore.open("slopes = 3\n"))[0], "refused")

    def test_serves_the_cart_of_gymnasium_where_that_is_installed(self) -> None:
        if importlib.util.find_spec("gymnasium") is None:
            self.skipTest("gymnasium is not here")
        script = """
        import gymnasium, lore_gymnasium
        lore_gymnasium.serve(lambda **settings: gymnasium.make("CartPole-v1", **settings))
        """
        self.assertIn("world cartpole_v1 default", self.check(script))


def cartpole(length: float) -> Any:
    """The world of the documentation."""
    spec = importlib.util.spec_from_file_location(
        "cartpole", SOURCE_DIR / "docs" / "examples" / "cartpole" / "cartpole.py"
    )
    assert spec is not None and spec.loader is not None
    module: Any = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.CartPole(length=length)


class Example(unittest.TestCase):
    def test_balances_where_it_is_caught(self) -> None:
        for half in (0.5, 0.25):
            world = cartpole(length=half)
            sensors, _ = world.reset()
            for _ in range(1000):
                place, speed, lean, turning = (2 * sensor - 1 for sensor in sensors)
                push = 0.3 * place + 0.6 * speed + 3 * lean + 2 * turning > 0
                sensors, reward, over, (x, y) = world.step([float(push)])
                self.assertEqual((reward, over), (1, False))
                self.assertTrue(0 <= x <= world.width and 0 <= y <= world.height)
            self.assertEqual(world.outcome()[2], 2)

    def test_falls_where_it_is_pushed_to_one_side(self) -> None:
        world = cartpole(length=0.5)
        world.reset()
        over, steps = False, 0
        while not over:
            _, reward, over, _ = world.step([1.0])
            steps += 1
            self.assertEqual(reward, 0 if over else 1)
        self.assertTrue(5 < steps < 20)


class Unit(unittest.TestCase):
    def test_is_a_share_of_the_way_and_clipped(self) -> None:
        self.assertEqual([lore_world.unit(x, -2, 2) for x in (-3, -2, -1, 2, 9)], [0, 0, 0.25, 1, 1])


if __name__ == "__main__":
    unittest.main()

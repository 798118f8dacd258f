"""A pole on a cart that a motor pushes left or right: it must not fall, nor may the cart leave its track.

    lore-world check --config source.toml

The task of A. G. Barto, R. S. Sutton and C. W. Anderson, Neuronlike adaptive elements that can solve difficult learning
control problems, IEEE Transactions on Systems, Man, and Cybernetics 13 (1983), with their constants, but for the pole's
length and the start: a pole that leans a little, so that it must be caught. docs/manual/worlds.md shows its parts.
"""
import math

import lore_world
from lore_world import unit

GRAVITY, CART_MASS, POLE_MASS = 9.8, 1.0, 0.1  # [m/s^2], [kg]
FORCE, STEP = 10.0, 0.02  # of the motor [N]; [s]
TRACK, FALL = 2.4, math.radians(12)  # how far the cart may go [m], and the pole may lean [rad]
LEAN = 0.05  # at the start [rad]


class CartPole:
    name = "cartpole"
    reward_unit = "steps"
    sensors = ["place", "speed", "lean", "turning"]
    effectors = {"rightward": bool}  # the motor pushes to the right; else to the left

    def __init__(self, task="pole", length=0.5):
        """`length`: half of the pole's [m]."""
        if not 0.05 <= length <= 5:
            raise ValueError(f"length is {length}, and lies in 0.05 .. 5")
        self.task = task
        self.half = length
        self.floor = 2 * length + 0.5  # y of the track; y grows downwards
        self.width = 2 * (TRACK + 2 * length)
        self.height = self.floor + 0.5

    def reset(self):
        self.x, self.speed, self.lean, self.turning = 0.0, 0.0, LEAN, 0.0
        self.steps = 0
        return self._senses(), self._tip()

    def step(self, effectors):
        push = FORCE if effectors[0] > 0.5 else -FORCE
        sine, cosine = math.sin(self.lean), math.cos(self.lean)
        mass = CART_MASS + POLE_MASS
        pull = (push + POLE_MASS * self.half * self.turning**2 * sine) / mass
        turn = (GRAVITY * sine - cosine * pull) / (self.half * (4 / 3 - POLE_MASS * cosine**2 / mass))
        drive = pull - POLE_MASS * self.half * turn * cosine / mass
        self.x += STEP * self.speed
        self.speed += STEP * drive
        self.lean += STEP * self.turning
        self.turning += STEP * turn
        self.steps += 1
        over = abs(self.x) > TRACK or abs(self.lean) > FALL
        return self._senses(), 0.0 if over else 1.0, over, self._tip()

    def outcome(self):
        """Where cart and pole ended, and how late."""
        return self.x / TRACK, self.lean / FALL, self.steps / 500

    def scene(self):
        """The track with its ends, in meters."""
        left, right, end = self.width / 2 - TRACK, self.width / 2 + TRACK, self.floor - 0.2
        return (f'<path d="M {left:g} {end:g} V {self.floor:g} H {right:g} V {end:g}" fill="none" stroke="#888" '
                f'stroke-width="0.03"/>')

    def _senses(self):
        return (unit(self.x, -TRACK, TRACK), unit(self.speed, -3, 3), unit(self.lean, -FALL, FALL),
                unit(self.turning, -4, 4))

    def _tip(self):
        """Of the pole, within the picture where the cart has run off."""
        x = self.width / 2 + self.x + 2 * self.half * math.sin(self.lean)
        return min(max(x, 0.0), self.width), self.floor - 2 * self.half * math.cos(self.lean)


if __name__ == "__main__":
    lore_world.serve(CartPole)

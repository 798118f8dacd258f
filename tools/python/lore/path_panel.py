"""The path of a robot in its scene, colored by the values of its windows, and these values over time: a panel of
figures 5 and 6."""
from __future__ import annotations

import io
import shutil
import subprocess
import textwrap
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.image import imread
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Rectangle
from numpy.typing import NDArray

from .report import Scene, WorldScene
from .table import Table

VALUE_COLORS = LinearSegmentedColormap.from_list(
    "lore", ["#deebf7", "#abd0e6", "#6baed6", "#3787c0", "#105ba4", "#08306b"]
)
_GRAY, _WALL = "#8c8c8c", "#3a3a3a"
_STEPS_BETWEEN_ROBOTS = 50


def draw_panel(part: Any, scene: Scene | WorldScene, steps: Table, values: NDArray[np.float64], length: int,
               factors: int, title: str) -> None:  # fmt: skip
    """The plan with the trajectory above, the values over time below. `length`: of a window [steps]."""
    product, arena = factors > 1, isinstance(scene, Scene)
    unit = "balls" if isinstance(scene, Scene) else scene.reward_unit
    found = np.isfinite(values)
    norm = Normalize(*_range(values))
    what = f"product of the values ({unit}$^{factors}$)" if product else f"value ({unit})"
    plan, strip = part.subplots(2, 1, gridspec_kw={"height_ratios": [3.3, 1]})
    part.suptitle(textwrap.fill(title, 80), x=0.01, ha="left", fontsize=11)
    if isinstance(scene, Scene):
        _draw_scene(plan, scene)
        _draw_robots(plan, scene, steps)
        _draw_legend(plan, scene)
    else:
        _draw_world(plan, scene, steps)
    places = np.stack([steps["x"], steps["y"]], axis=1)
    pieces = [places[at : at + length + 1] for at in range(0, len(places) - 1, length)]
    known = np.array([i < len(found) and bool(found[i]) for i in range(len(pieces))])  # not after the last whole window
    _draw_lines(plan, [p for p, k in zip(pieces, known) if not k], color=_GRAY, linewidths=0.8)
    colored = [p for p, k in zip(pieces, known) if k]
    _draw_lines(plan, colored, color="#4d4d4d", linewidths=2.6)
    lines = _draw_lines(plan, colored, array=values[: len(pieces)][known[: len(values)]], cmap=VALUE_COLORS, norm=norm,
                        linewidths=1.7)  # fmt: skip
    part.colorbar(lines, ax=plan, label=what, shrink=0.8)
    not_found = (0.0 if product else -1.0) if arena and norm.vmin == 0 else float(norm.vmin)
    _draw_strip(strip, values, found, length, not_found, max(norm.vmax, 1.0) if arena else float(norm.vmax), what)
    strip.set_xlim(0, max(len(steps), len(values) * length))


def _range(values: NDArray[np.float64]) -> tuple[float, float]:
    """Of the colors: with 0."""
    known = values[np.isfinite(values)]
    least, most = known.min(initial=0.0), known.max(initial=0.0)
    return least, (most if most > least else least + 1)


def _draw_lines(axes: Any, lines: list[NDArray[np.float64]], **style: Any) -> LineCollection:
    collection = LineCollection(lines, zorder=3, capstyle="round", **style)
    axes.add_collection(collection)
    return collection


def _draw_scene(axes: Any, scene: Scene) -> None:
    """Lengths in u, y downwards."""
    axes.set(xlim=(0, scene.size[0]), ylim=(scene.size[1], 0), aspect="equal", xlabel="x (u)", ylabel="y (u)")
    for x0, x1, y0, y1 in scene.walls:
        axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, color=_WALL, zorder=2))
    for x0, x1, y0, y1 in scene.doors:
        axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, facecolor="#f2f2f2", edgecolor=_WALL, ls="--", zorder=2))
    x, y, radius = scene.basket
    axes.add_patch(Circle((x, y), radius, facecolor="#d9f0e5", edgecolor="#2f9e6e", linestyle="--", zorder=1))
    axes.plot(*scene.balls.T, "o", color="#e8a800", mec="#222222", ms=7, zorder=4)
    axes.plot(*scene.basket_lights.T, "o", color="#2f9e6e", mec="#222222", ms=4.5, zorder=4)
    axes.plot(*scene.switch, "s", color="#8e4fb0", mec="#222222", ms=7, zorder=4)


def _draw_world(axes: Any, scene: WorldScene, steps: Table) -> None:
    """The world's own scene below the path, whose start is green and whose end is red."""
    width, height = scene.size
    axes.set(xlim=(0, width), ylim=(height, 0), aspect="equal", xlabel="x (u)", ylabel="y (u)")
    if scene.svg:
        axes.imshow(_rendered(scene), extent=(0, width, height, 0), zorder=0, interpolation="antialiased")
    for step, color, label in ((0, "#2f9e6e", "start"), (-1, "#e0452f", "end")):
        axes.plot(steps["x"][step], steps["y"][step], "o", color=color, mec="#222222", mew=0.8, ms=7, zorder=4, ls="",
                  label=label)  # fmt: skip
    axes.plot([], [], color=_GRAY, lw=1.5, label="not in the knowledge base")
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncol=3, frameon=False, fontsize=8)


def _rendered(scene: WorldScene) -> NDArray[Any]:
    """The scene as pixels. Raises OSError where the program that draws SVG is not there, or cannot draw this one."""
    program = shutil.which("rsvg-convert")
    if program is None:
        raise OSError("the world's scene is SVG, and there is no program rsvg-convert (Debian: package librsvg2-bin)")
    width, height = scene.size
    scale = 1200 / max(width, height)
    document = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width * scale}" height="{height * scale}" '
        f'viewBox="0 0 {width} {height}">{scene.svg}</svg>'
    )
    done = subprocess.run([program, "--format", "png"], input=document.encode(), capture_output=True)
    if done.returncode != 0:
        raise OSError(f"rsvg-convert cannot draw the world's scene: {done.stderr.decode(errors='replace').strip()}")
    return np.asarray(imread(io.BytesIO(done.stdout)))


def _draw_robots(axes: Any, scene: Scene, steps: Table) -> None:
    """Every 50 steps, white or, with a ball, red; not where it stands still, since discs are half transparent."""
    radius, before = scene.robot_radius, None
    for step in range(0, len(steps), _STEPS_BETWEEN_ROBOTS):
        x, y, theta, carrying = (steps[name][step] for name in ("x", "y", "theta", "carrying"))
        if before and before[2] == carrying and np.hypot(x - before[0], y - before[1]) < 0.1 * radius:
            continue
        before = (x, y, carrying)
        color, alpha = ("#e0452f", 0.45) if carrying else ("#ffffff", 0.6)
        axes.add_patch(Circle((x, y), radius, facecolor=color, alpha=alpha, zorder=1.5))
        axes.add_patch(Circle((x, y), radius, fill=False, edgecolor="#555555", lw=0.6, zorder=1.5))
        axes.plot([x, x + radius * np.cos(theta)], [y, y + radius * np.sin(theta)], color="#555555", lw=0.9, zorder=1.5)


def _draw_legend(axes: Any, scene: Scene) -> None:
    def mark(shape: str, color: str, label: str, size: float = 7) -> Line2D:
        return Line2D([], [], ls="", marker=shape, color=color, mec="#222222", mew=0.8, ms=size, label=label)

    when = "at the start" if scene.balls_at_start else "after a press of the switch"
    handles = [
        mark("o", "#ffffff", f"robot, every {_STEPS_BETWEEN_ROBOTS} steps", 9),
        mark("o", "#f0a297", "robot with a ball", 9),
        mark("o", "#e8a800", f"ball, {when}"),
        mark("s", "#8e4fb0", "switch"),
        mark("o", "#2f9e6e", "light of the basket", 5),
        Line2D([], [], color=_GRAY, lw=1.5, label="not in the knowledge base"),
    ]
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncol=3, frameon=False, fontsize=8)


def _draw_strip(axes: Any, values: NDArray[np.float64], found: NDArray[np.bool_], length: int, not_found: float,
                most: float, what: str) -> None:  # fmt: skip
    shown = np.where(found, values, not_found)
    edges = np.arange(len(values) + 1) * length
    axes.stairs(shown, edges, baseline=None, color=VALUE_COLORS(0.85), lw=1)
    missing = [np.array([[edges[i], not_found], [edges[i + 1], not_found]]) for i in np.flatnonzero(~found)]
    _draw_lines(axes, missing, color=_GRAY, linewidths=4)
    least = min(not_found, 0)
    room = 0.06 * (most - least)
    axes.set(ylim=(least - room, most + room), xlabel="time (steps)", ylabel=what)
    axes.grid(axis="y", color="#dddddd", linewidth=0.7)

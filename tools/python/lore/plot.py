"""Figures 3 to 6 of the paper from the tables of a report, with matplotlib; of several target tasks 3 and 4 of each.

    python3 -m lore.plot runs/small --out figures --formats svg png

The functions return matplotlib Figures that belong to no window; save one with figure.savefig("figure3.svg"). Colors
are Okabe and Ito's (2008), told apart by color-blind readers, and one blue from pale to dark for values.
"""
from __future__ import annotations

import argparse
import os
import sys
import textwrap
from typing import Any, Callable, Sequence

import matplotlib
import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .errors import Damaged, FilePath
from .path_panel import VALUE_COLORS as VALUE_COLORS, draw_panel
from .report import Report, Scene
from .table import Table

COLORS = ("#000000", "#56b4e9", "#e69f00", "#d55e00", "#0072b2", "#009e73", "#cc79a7")
_SOURCE_COLOR = "#777777"
_DASHES = ((5, 3), (1.5, 1.5), (7, 2.5, 1.5, 2.5), (7, 1.5, 1.5, 1.5, 1.5, 1.5))


def figure3(report: Report | FilePath, task: str | None = None) -> Figure:
    """Mean reward of the best-of-run by generation, a line a treatment or pool with its 95 % bootstrap band.

    `task`: one of Report.tasks, whose treatments are shown; rewards of several tasks share no axis. Without it
    treatments whose reward has another unit than the first target task's are left out.
    """
    report = _report(report)
    curves, treatments, names = report.curves, report.shown(task), _labels(report, task)
    target_rows = curves["generation"][np.isin(curves["treatment"], treatments)]
    last = target_rows.max() if len(target_rows) else np.inf  # source runs may be longer
    figure = Figure(figsize=(8.5, 4.8), layout="constrained")
    axes = figure.add_subplot(xlabel="generation", ylabel=f"{_reward(report, task)} (mean of best-of-runs)")
    sources = report.sources if task is None else []
    of_sources = [
        (name, {"color": _SOURCE_COLOR, "dashes": _DASHES[place % len(_DASHES)]}) for place, name in enumerate(sources)
    ]
    for treatment, style in [*of_sources, *_styles(treatments)]:
        rows = curves.where(treatment=treatment)
        if len(rows) == 0 or (task is None and not _has_unit(report, treatment)):
            continue
        shown = rows["generation"] <= last
        at = rows["generation"][shown]
        label = f"{textwrap.fill(names.get(treatment, treatment), 28)} (n = {rows['runs'][shown][-1]})"
        axes.fill_between(at, rows["low"][shown], rows["high"][shown], color=style["color"], alpha=0.12, linewidth=0)
        axes.plot(at, rows["mean"][shown], label=label, **style)
    axes.margins(x=0.01)
    if report.reward_word == "balls":
        axes.set_ylim(0, max(1.0, axes.get_ylim()[1]))
    axes.grid(axis="y", color="#dddddd", linewidth=0.7)
    axes.spines[["top", "right"]].set_visible(False)
    if axes.lines:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False)
    return figure


def _labels(report: Report, task: str | None) -> dict[str, str]:
    """Of treatments and pools; those of a task without its own label and a colon, which all of them begin with."""
    labels = report.labels
    if task is None:
        return labels
    before, colon, _ = os.path.commonprefix([labels[name] for name in report.tasks[task]]).partition(": ")
    return {name: label.removeprefix(before + colon) for name, label in labels.items()} if colon else labels


def _reward(report: Report, task: str | None) -> str:
    if report.reward_word == "balls":
        return "collected balls"
    if task is None:
        return f"reward [{report.reward_unit}]"
    final = report.final
    units = final["unit"][np.isin(final["treatment"], report.tasks[task])]
    return f"reward [{units[0]}]" if len(units) else "reward"


def figure4(report: Report | FilePath, task: str | None = None) -> Figure:
    """A boxplot a target treatment or pool at the last generation, every run a point; brackets over pairs with p < 0.01
    (*) and p < 0.001 (**), two-sided Mann-Whitney, uncorrected as in the paper. `task`: as of figure3."""
    report = _report(report)
    final = report.final
    names, styles = _labels(report, task), dict(_styles(report.shown(task)))
    of_all = {
        name: final[report.reward_word][np.isin(final["treatment"], report.members(name))]
        for name in styles
        if task is not None or _has_unit(report, name)
    }
    treatments = [name for name, of_one in of_all.items() if len(of_one)]
    rewards = [of_all[name] for name in treatments]
    figure = Figure(figsize=(max(4.0, 1.1 + 1.05 * len(treatments)), 5.2), layout="constrained")
    axes = figure.add_subplot(ylabel=f"{_reward(report, task)} (best-of-run)")
    for place, (name, of_one) in enumerate(zip(treatments, rewards), 1):
        color = styles[name]["color"]
        axes.boxplot(of_one, positions=[place], widths=0.55, showfliers=False, patch_artist=True,
                     boxprops={"facecolor": (*to_rgb(color), 0.18)},
                     medianprops={"color": "#222222", "linewidth": 2})  # fmt: skip
        axes.plot(place + _side_by_side(of_one), of_one, "o", color=color, markersize=4, alpha=0.75)
    labels = [
        f"{textwrap.fill(names.get(name, name), 15)}\nn = {len(of_one)}" for name, of_one in zip(treatments, rewards)
    ]
    axes.set_xticks(range(1, len(treatments) + 1), labels, fontsize=8)
    counted = report.reward_word == "balls"
    if counted:
        axes.yaxis.get_major_locator().set_params(integer=True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(axis="y", color="#dddddd", linewidth=0.7)
    most = max((of_one.max() for of_one in rewards), default=1)
    step = 1 if counted else (most - min((of_one.min() for of_one in rewards), default=0)) / 8 or 1  # between brackets
    for low, high, mark, level in _brackets(report, treatments):
        y = most + (0.5 + 0.45 * level) * step
        axes.plot([low + 0.05, low + 0.05, high - 0.05, high - 0.05], [y - 0.1 * step, y, y, y - 0.1 * step],
                  color="#222222", lw=0.8)  # fmt: skip
        axes.text((low + high) / 2, y, mark, ha="center", va="center_baseline",
                  bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5})  # fmt: skip
    if counted:
        axes.set_ylim(-0.05, max(1.4, axes.get_ylim()[1]))
    return figure


def figure5(report: Report | FilePath) -> Figure:
    """The trajectory of a source run's best robot, colored by the values of knowledge bases, a panel each, with the
    values over time. Raises FileNotFoundError where the report has no replay, ValueError where it shows no figure 5."""
    return _panels(_report(report), "figure5")


def figure6(report: Report | FilePath) -> Figure:
    """The same, colored by the product of the values of several knowledge bases. Raises likewise."""
    return _panels(_report(report), "figure6")


FIGURES: dict[str, Callable[..., Figure]] = {
    "figure3": figure3,
    "figure4": figure4,
    "figure5": figure5,
    "figure6": figure6,
}


def save_figures(report: Report | FilePath, directory: FilePath, formats: Sequence[str] = ("svg", "png")) -> list[str]:
    """Writes the figures that the report has tables for; returns the files' names. Equal tables make equal files.

    Raises Damaged, FileNotFoundError where no report is, OSError.
    """
    report = _report(report)
    os.makedirs(directory, exist_ok=True)
    written = []
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": "lore"}):
        for name, draw in FIGURES.items():
            if name in ("figure5", "figure6") and not _has_panels(report, name):
                continue
            by_task = name in ("figure3", "figure4") and report.tasks
            drawn = (
                {f"{name}_{task}": draw(report, task) for task in report.tasks} if by_task else {name: draw(report)}
            )
            for stem, figure in drawn.items():
                for kind in formats:
                    path = os.path.join(os.fspath(directory), f"{stem}.{kind}")
                    figure.savefig(path, dpi=150, metadata={"Date": None} if kind == "svg" else None)
                    written.append(path)
    return written


def _report(report: Report | FilePath) -> Report:
    return report if isinstance(report, Report) else Report(report)


def _has_unit(report: Report, treatment: str) -> bool:
    """Whether its rewards have the unit of the (first) target task: others share no axis with them."""
    if report.reward_word == "balls":
        return True
    return set(report.final.where(treatment=report.members(treatment)[0])["unit"].tolist()) <= {report.reward_unit}


def _styles(treatments: Sequence[str]) -> list[tuple[str, dict[str, Any]]]:
    """Color by place, as in the report; dashed from the eighth on."""

    def style(i: int) -> dict[str, Any]:
        color, turn = COLORS[i % len(COLORS)], i // len(COLORS) % (len(_DASHES) + 1)
        return {"color": color, "dashes": _DASHES[turn - 1]} if turn > 0 else {"color": color}

    return [(name, style(i)) for i, name in enumerate(treatments)]


def _side_by_side(rewards: NDArray[Any]) -> NDArray[np.float64]:
    """How far to move each point sideways, so that those of equal reward stand side by side."""
    offsets = np.zeros(len(rewards))
    for value in np.unique(rewards):
        equal = np.flatnonzero(rewards == value)
        offsets[equal] = (np.arange(len(equal)) - (len(equal) - 1) / 2) * min(0.06, 0.8 / len(equal))
    return offsets


def _brackets(report: Report, treatments: Sequence[str]) -> list[tuple[int, int, str, int]]:
    """From, to (places from 1), mark, and the lowest level that is free over all it spans."""
    places = {name: place for place, name in enumerate(treatments, 1)}
    found = []
    for name, pairs in (("pvalues.csv", "comparisons"), ("pools.csv", "planned")):
        if not os.path.exists(os.path.join(report.path, name)):
            continue
        table: Table = getattr(report, pairs)
        for a, b, p in zip(table["a"].tolist(), table["b"].tolist(), table["p"].tolist()):
            if p < 1e-2 and a in places and b in places:
                low, high = sorted((places[a], places[b]))
                found.append((low, high, "**" if p < 1e-3 else "*"))
    placed: list[tuple[int, int, str, int]] = []
    for low, high, mark in sorted(found, key=lambda bracket: bracket[1] - bracket[0]):
        taken = {level for other_low, other_high, _, level in placed if other_low < high and low < other_high}
        placed.append((low, high, mark, next(level for level in range(len(taken) + 1) if level not in taken)))
    return placed


def _has_panels(report: Report, figure: str) -> bool:
    files = [os.path.join(report.path, name) for name in ("replay.csv", "values.csv", "scene.json")]
    return all(map(os.path.exists, files)) and len(report.values.where(figure=figure)) > 0


def _panels(report: Report, figure_name: str) -> Figure:
    scenes, values, names = report.scenes, report.values.where(figure=figure_name), report.knowledge_labels
    name = next(iter(scenes), "")  # the source run that the figures show comes first
    steps = report.replay.where(replay=name)
    if len(steps) == 0:
        raise Damaged(os.path.join(report.path, "replay.csv"), f"it has no step of '{name}'")
    bases = list(dict.fromkeys(values["knowledge"].tolist()))
    if not bases:
        raise ValueError(f"the report shows no figure {figure_name[-1]}: name bases in [report] {figure_name}")
    figure = Figure(figsize=(8.5, 7.4 * len(bases)), layout="constrained")
    parts = figure.subfigures(len(bases), 1, squeeze=False)[:, 0]
    lengths = report.window_lengths
    for place, (part, base) in enumerate(zip(parts, bases)):
        label = " \u00d7 ".join(names.get(one, one) for one in base.split("*"))
        title = (
            f"({chr(ord('a') + place)}) values from {label}"
            if "*" not in base
            else f"product of the values from {label}"
        )
        shown, length = values.where(knowledge=base)["value"], lengths.get((figure_name, base))
        if length is None:
            shown, length = _of_before_1_0_0(shown, len(steps), isinstance(scenes[name], Scene), "*" in base)
        draw_panel(part, scenes[name], steps, shown, length, base.count("*") + 1, title)
    return figure


def _of_before_1_0_0(
    values: NDArray[np.float64], steps: int, arena: bool, product: bool
) -> tuple[NDArray[np.float64], int]:
    """The values with nan for what is not found, and the length of windows: the usual one, if as many whole ones fit
    into the steps, else the longest with which they do."""
    length = 20 if steps // 20 == len(values) else max(1, steps // len(values))
    return np.where(values == (0 if product else -1), np.nan, values) if arena else values, length


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="python3 -m lore.plot", description="Draws figures 3 to 6 from a report's tables."
    )
    parser.add_argument("report", help="directory with the tables of 'lore-campaign report'")
    parser.add_argument("--out", required=True, help="directory for the pictures")
    parser.add_argument("--formats", nargs="+", default=["svg", "png"], choices=["svg", "png", "pdf"])
    options = parser.parse_args(arguments)
    try:
        for path in save_figures(options.report, options.out, options.formats):
            print(f"wrote {path}")
    except (Damaged, OSError) as error:
        print(f"lore.plot: {error}", file=sys.stderr)
        return 2 if isinstance(error, FileNotFoundError) else 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

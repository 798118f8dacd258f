#!/usr/bin/python3
"""Writes reference.txt beside this file: what SciPy (Debian's python3-scipy) says about the samples below.

    /usr/bin/python3 tests/unit/statistics/make_reference.py && git diff tests/unit/statistics/reference.txt
"""
import pathlib
import random

import numpy
import scipy
from scipy.stats import mannwhitneyu

rng = random.Random(20)


def balls(n, center):
    return [min(8, max(0, round(rng.gauss(center, 1.8)))) for _ in range(n)]


def distinct(n, low, high):
    return [round(rng.uniform(low, high), 6) for _ in range(n)]


PAIRS = [
    ([1], [2]),
    ([2, 3], [1]),
    ([1, 2, 3], [4, 5, 6]),
    ([1, 4, 6, 9], [2, 3, 5, 7, 8]),
    ([1, 2, 2, 3], [2, 3, 4, 4]),
    ([4, 4, 4, 5], [4, 4, 4, 4]),
    ([0], [0, 1]),
    (distinct(7, 0, 1), distinct(12, 0.2, 1.2)),
    (distinct(30, 0, 1), distinct(30, 0.1, 1.1)),
    (distinct(30, 0, 1), distinct(30, 0.6, 1.6)),
    (distinct(5, 0, 1), distinct(60, 0, 1)),
    (distinct(101, 0, 1), distinct(20, 0.1, 1.1)),
    (balls(30, 4.8), balls(30, 6.2)),
    (balls(30, 4.8), balls(30, 4.8)),
    (balls(12, 4.5), balls(30, 5.5)),
    (balls(30, 2), balls(29, 7)),
]

lines = [f"# SciPy {scipy.__version__}, NumPy {numpy.__version__}, made by make_reference.py",
         "# u p method lower_quartile median upper_quartile | first sample | second sample (quartiles of the first)"]
for a, b in PAIRS:
    ties = len(set(a + b)) < len(a) + len(b)
    method = "asymptotic" if ties or max(len(a), len(b)) > 100 else "exact"
    result = mannwhitneyu(a, b, alternative="two-sided", method=method, use_continuity=True)
    quartiles = numpy.percentile(a, [25, 50, 75])
    lines.append(f"{result.statistic!r} {result.pvalue!r} {method} " + " ".join(repr(float(q)) for q in quartiles)
                 + " | " + " ".join(map(str, a)) + " | " + " ".join(map(str, b)))
pathlib.Path(__file__).with_name("reference.txt").write_text("\n".join(lines) + "\n")

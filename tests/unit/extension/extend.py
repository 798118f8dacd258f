#!/usr/bin/env python3
"""Adds a sensor and a behavioral distance to copies of Lore's sources, as docs/manual/extending.md says.

    tests/unit/extension/extend.py SOURCE_DIR OUT_DIR
    tests/unit/extension/extend.py --files

Writes the changed files below OUT_DIR; --files lists them. The sensor is a compass, continuous; the distance compares
the rewards, which Descriptors does not hold.
"""
import pathlib
import sys

# file: pairs of a place that occurs once, and what stands there afterwards
SENSOR = {
    "include/lore/collectball/channels.h": [
        ("    carrying,\n", "    carrying,\n    compass,\n"),
        ('    {Channel::carrying, "carrying", ChannelKind::binary},\n',
         '    {Channel::carrying, "carrying", ChannelKind::binary},\n'
         '    {Channel::compass, "compass", ChannelKind::continuous},\n'),
    ],
    "include/lore/collectball/mechanics.h": [
        ("// ---- contact -",
         "/// The heading as a number in [0, 1].\n"
         "template <class F>\n"
         "LORE_INLINE F compass_value(F const& theta) {\n"
         "    return theta / two_pi + 0.5f;\n"
         "}\n\n"
         "// ---- contact -"),
    ],
    "src/collectball/world.cpp": [
        ("on(world.carrying())});", "on(world.carrying()),\n         mechanics::compass_value(robot.pose.theta)});"),
    ],
    "src/collectball/lane_kernel.cpp": [
        ("range(distances[2])};",
         "range(distances[2]),\n"
         "                            mechanics::compass_value(lanes::load<F>(work.theta + at))};"),
    ],
}
DISTANCE = {
    "include/lore/behavior/descriptors.h": [
        ("    friend bool operator==(Descriptors const&",
         "    double delivered = 0;   ///< delivery: Trace::reward\n"
         "    friend bool operator==(Descriptors const&"),
        ("[outcome, channel_bits, path, entropies]", "[outcome, channel_bits, path, entropies, delivered]"),
        ("    visit(entropies);\n", "    visit(entropies);\n    visit(delivered);\n"),
    ],
    "src/behavior/descriptors.cpp": [
        ("    d.channel_bits = trace.channel_bits;\n", "    d.channel_bits = trace.channel_bits;\n    d.delivered = trace.reward;\n"),
    ],
    "src/evaluation/batch.cpp": [
        ("        d.path = now.path;\n", "        d.path = now.path;\n        d.delivered = how.reward;\n"),
    ],
    "include/lore/behavior/distances.h": [
        ("trajectory, entropy };", "trajectory, entropy, delivery };"),
        ("static_cast<int>(DistanceKind::entropy) + 1", "static_cast<int>(DistanceKind::delivery) + 1"),
        ("double distance(DistanceKind,",
         "/// Difference of the rewards.\n"
         "double delivery_distance(Descriptors const&, Descriptors const&);\n\n"
         "double distance(DistanceKind,"),
    ],
    "src/behavior/distances.cpp": [
        ('    {DistanceKind::entropy, "entropy", entropy_distance},\n',
         '    {DistanceKind::entropy, "entropy", entropy_distance},\n'
         '    {DistanceKind::delivery, "delivery", delivery_distance},\n'),
        ("namespace {\n\nstruct Definition {",
         "double delivery_distance(Descriptors const& a, Descriptors const& b) {\n"
         "    return std::abs(a.delivered - b.delivered);\n"
         "}\n\n"
         "namespace {\n\nstruct Definition {"),
    ],
}
CHANGES = SENSOR | DISTANCE

if sys.argv[1:] == ["--files"]:
    print(";".join(CHANGES), end="")
    sys.exit(0)
source, out = map(pathlib.Path, sys.argv[1:])
for file, changes in CHANGES.items():
    text = (source / file).read_text()
    for place, replacement in changes:
        if text.count(place) != 1:
            sys.exit(f"{file} has {text.count(place)} places {place!r}, not one. "
                     "Let this script and docs/manual/extending.md follow the code.")
        text = text.replace(place, replacement)
    (out / file).parent.mkdir(parents=True, exist_ok=True)
    (out / file).write_text(text)

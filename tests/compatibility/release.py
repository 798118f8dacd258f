#!/usr/bin/env python3
"""What a release promised must still be there: command lines, settings, columns, files, lore/world.h, libraries.

    tests/compatibility/release.py record --programs build/release/bin     makes the set of this version in tests/data
    tests/compatibility/release.py check tests/data/release-1.0.0 --programs build/release/bin

A set is made once, when its release is made (docs/manual/versions.md), and never changed. It has lists, a name a line,
of which each must be in what this Lore has (additions are free), and files, which this Lore must read:

    commands.txt         programs, commands, options              settings.txt   configuration keys
    columns.txt          columns of tables, keys of JSON          python.txt     names of the package lore
    headers.txt          of the C++ library                       world_layout.txt   sizes and offsets of lore/world.h
    include/, world.c    lore/world.h and a world: one that was compiled for that release still keeps the contract
    program.cpp          a program for the C++ library    base.lorekb   a knowledge base
    stopped-run/         goes on to the signature in signature.txt
    jobs/                campaigns and tasks, which can still be planned

Prints one line for each thing that went missing, and returns 1, or says what holds.
"""
import argparse
import csv
import inspect
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ("lore", "lore-evolve", "lore-kb", "lore-replay", "lore-campaign", "lore-world")
TINY = """name = "tiny"
arena = "{source}/jobs/tasks/arenas/collectball.toml"
task = "{task}"
[episode]
steps = 120
[evolution]
population = 6
founders = 20
generations = 8
[diversity]
period = 3
[knowledge]
match_threshold = 2.5
[checkpoint]
generations = 2
"""
CAMPAIGN = """title = "tiny"
runs = 2
[source]
config = "source.toml"
runs = 1
[[knowledge]]
name = "base"
run = 1
[[treatment]]
name = "none"
config = "target.toml"
[[treatment]]
name = "clones"
config = "target.toml"
clone_of = "base"
[[treatment]]
name = "policy"
config = "target.toml"
policy_of = "base"
[[pool]]
name = "helped"
treatments = ["clones", "policy"]
against = ["none"]
[report]
trajectory = "base"
figure5 = ["base"]
figure6 = ["base"]
"""

MATRIX = """title = "tiny matrix"
runs = 1
[[source]]
name = "one"
config = "source.toml"
[[target]]
name = "two"
config = "target.toml"
[transfer]
method = "policy"
"""

# Of rewards in another unit than balls, and a scene that the world draws.
MAZE = """title = "tiny maze"
runs = 2
[source]
config = "maze.toml"
[[knowledge]]
name = "base"
run = 1
[[treatment]]
name = "none"
config = "maze.toml"
first_seed = 3
[[treatment]]
name = "clones"
config = "maze.toml"
clone_of = "base"
[[treatment]]
name = "policy"
config = "maze.toml"
policy_of = "base"
[report]
trajectory = "base"
figure5 = ["base"]
"""
TINY_MAZE = """name = "tiny maze"
[world]
library = "maze"
[world.settings]
maze = "medium"
[episode]
steps = 50
[evolution]
population = 6
founders = 20
generations = 4
"""


class Failure(Exception):
    """A command that failed; the text says which, and what it said last."""


def version():
    return re.search(r"^project\(Lore VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]


def run(*command, cwd=None):
    """Standard output of a command. Raises Failure where it does not end with 0."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=cwd)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or [""]
        last = next((line for line in lines if " error: " in line), lines[-1])
        raise Failure(f"'{' '.join(str(word) for word in command)}' ends with {done.returncode} ({last})")
    return done.stdout


# -- lists: what is there

def commands(programs):
    """'lore-kb build --out', a line an option, of every program and command."""
    found = []

    def read(name, *command):
        text = run(programs / name, *command, "--help")
        prefix = " ".join([name, *command])
        found.append(prefix)
        for line in re.findall(r"^  (-\S+)", text, re.M):
            found.extend(f"{prefix} {option.split(':')[0]}" for option in line.split(",") if option.startswith("-"))
        listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.M)
        for one in re.findall(r"^  ([\w-]+)", listed[1], re.M) if listed and not command else []:
            read(name, one)

    for name in PROGRAMS:
        read(name)
    return found


def settings(config):
    """'evolution.population', a line a key of a run's config.toml, commented ones included."""
    found, section = [], ""
    for line in config.read_text().splitlines():
        if table := re.match(r"\[([\w.]+)\]", line):
            section = table[1] + "."
        elif key := re.match(r"(?:# *)?(\w+) *= ", line):
            found.append(section + key[1])
    return found


def keys(value, place):
    """'PLACE.key.key' of a JSON value; the elements of a list are one."""
    if isinstance(value, dict):
        for name, inner in value.items():
            yield f"{place}.{name}"
            yield from keys(inner, f"{place}.{name}")
    elif isinstance(value, list):
        for inner in value:
            yield from keys(inner, place)


def columns(programs, work):
    """'progress.csv generation', 'manifest.json.status': of all tables and JSON that programs write in `work`."""
    for task in ("source", "target"):
        (work / f"{task}.toml").write_text(TINY.format(source=SOURCE, task=task))
    (work / "maze.toml").write_text(TINY_MAZE)
    for name, text in (("c", CAMPAIGN), ("m", MATRIX), ("z", MAZE)):
        (work / f"{name}.toml").write_text(text)
        campaign = (f"{name}.toml", "--dir", name, "-q")
        run(programs / "lore-campaign", "run", *campaign, "--jobs", "1", cwd=work)
        run(programs / "lore-campaign", "report", *campaign, cwd=work)
    one = work / "c/runs/source/001"
    run(programs / "lore-replay", one, "--out", work / "replay", "-q")
    base = work / "c/knowledge/base.lorekb"
    run(programs / "lore-kb", "query", base, "--run", one, "--csv", work / "query.csv", "-q")
    run(programs / "lore-kb", "product", base, base, "--run", one, "--csv", work / "product.csv", "-q")
    run(programs / "lore-kb", "export", base, "--csv", work / "export.csv", "-q")
    found = []
    tables = [one / "progress.csv", work / "replay/trace.csv",
              *sorted(work.glob("*.csv")), *sorted(work.glob("c/*.csv")),
              work / "m/matrix.csv", work / "z/runs/source/001/progress.csv", *sorted(work.glob("z/*.csv"))]
    for table in tables:
        with open(table, newline="") as file:
            found += [f"{table.name} {column}" for column in next(csv.reader(file))
                      if table.name != "export.csv" or not re.search(r"_([1-9]|1\d)$", column)]  # of step 0 alone
    manifests = (one / "manifest.json", work / "z/runs/source/001/manifest.json")
    for document in (*manifests, *sorted(work.glob("[cz]/s*.json"))):
        found += keys(json.loads(document.read_text()), document.name)
    lines = {"individuals": run(programs / "lore-kb", "individuals", one),
             "events": run(programs / "lore-campaign", "events", work / "c")}
    for name, text in lines.items():
        for line in text.splitlines():
            value = json.loads(line)
            place = f"{name}.{value.pop('event')}" if name == "events" else name
            found += [key for key in keys(value, place) if ".config." not in key]
    found += keys(json.loads(run(programs / "lore-kb", "info", base, "--json")), "info")
    return [line for line in dict.fromkeys(found) if ".libraries." not in line]


def python_names():
    """'lore.Run.lineage', a line a public name of the package lore, lore.plot and lore_world."""
    sys.path.insert(0, str(SOURCE / "tools" / "python"))
    import importlib
    found = []
    for module in map(importlib.import_module, ("lore", "lore_world")):
        for name in getattr(module, "__all__", None) or [name for name in vars(module) if not name.startswith("_")]:
            thing = getattr(module, name)
            home = getattr(thing, "__module__", "lore").split(".")[0]
            if inspect.ismodule(thing) or home not in ("lore", "lore_world"):
                continue
            found.append(f"{module.__name__}.{name}")
            members = [*vars(thing), *getattr(thing, "__annotations__", {})] if inspect.isclass(thing) else []
            found += [f"{module.__name__}.{name}.{member}" for member in dict.fromkeys(members)
                      if not member.startswith("_")]
    plot = (SOURCE / "tools/python/lore/plot.py").read_text()
    return found + [f"lore.plot.{name}" for name in re.findall(r"^def ([a-z]\w*)", plot, re.M)]


def headers():
    return [str(file.relative_to(SOURCE / "include")) for file in sorted((SOURCE / "include").rglob("*.h"))]


def world_layout(work):
    """'lore_facts.width 64 4', a line a size and an offset, as the C compiler lays lore/world.h out."""
    run("cc", "-std=c99", "-I", SOURCE / "include", SOURCE / "tests/compatibility/world_layout.c",
        "-o", work / "layout")
    return run(work / "layout").splitlines()


def lists(programs, work):
    """All lists, by the name of their file."""
    found = {"columns.txt": columns(programs, work)}
    return found | {"commands.txt": commands(programs),
                    "settings.txt": settings(work / "c/runs/source/001/config.toml"),
                    "python.txt": python_names(), "headers.txt": headers(), "world_layout.txt": world_layout(work)}


# -- a set

def record(place, programs, work):
    """Fills the new folder `place`."""
    place.mkdir()
    for name, lines in lists(programs, work).items():
        (place / name).write_text("\n".join(lines) + "\n")
    (place / "include/lore").mkdir(parents=True)
    shutil.copy(SOURCE / "include/lore/world.h", place / "include/lore")
    shutil.copy(SOURCE / "docs/examples/pendulum/pendulum.c", place / "world.c")
    shutil.copy(SOURCE / "docs/examples/newcomers/main.cpp", place / "program.cpp")
    for folder in ("campaigns", "tasks"):
        shutil.copytree(SOURCE / "jobs" / folder, place / "jobs" / folder, ignore=shutil.ignore_patterns("*.md"))
    evolve, asked = programs / "lore-evolve", ("source.toml", "--seed", "5", "--archive", "all", "-q")
    run(evolve, *asked, "--out", "whole", cwd=work)
    signature = run(evolve, *asked, "--out", "whole", "--resume", cwd=work).splitlines()[-1]
    (place / "signature.txt").write_text(signature + "\n")
    run(evolve, *asked, "--set", "evolution.generations=3", "--out", "stopped-run", cwd=work)
    stopped = subprocess.run([evolve, *asked, "--resume", "--max-time", "00:00:00", "--out", "stopped-run"], cwd=work,
                             capture_output=True)
    if stopped.returncode != 75:
        raise Failure(f"the run was to stop, and ended with {stopped.returncode}")
    names = [file.name for file in (work / "stopped-run").iterdir()
             if file.name not in ("lock", "checkpoint-older.lore")]
    (place / "stopped-run").mkdir()
    for name in names:
        shutil.copy(work / "stopped-run" / name, place / "stopped-run")
    shutil.copy(work / "source.toml", place / "stopped-run.toml")
    for file in (place / "stopped-run/manifest.json", place / "stopped-run/config.toml", place / "stopped-run.toml"):
        text = re.sub(r'("hosts": \[\s*)"[^"]*"', r'\1"here"', file.read_text())
        file.write_text(text.replace(str(SOURCE) + "/jobs/tasks/", "").replace(str(programs), "/usr/bin"))
    run(programs / "lore-kb", "build", "whole", "--all", "--out", "all.lorekb", "-q", cwd=work)
    run(programs / "lore-kb", "reduce", "all.lorekb", "--top", "12", "--out", "base.lorekb", "-q", cwd=work)
    shutil.copy(work / "base.lorekb", place)


def missing(place, programs, work):
    """A line for each thing of the set that is no longer so."""
    release = place.name.removeprefix("release-")
    now = lists(programs, work)
    for file in sorted(now):
        gone = [line for line in (place / file).read_text().splitlines() if line not in set(now[file])]
        yield from (f"{release} has '{line}' ({file}), and this Lore has not" for line in gone)
    for what, test in (("the world that was compiled for it", old_world),
                       ("its program for the C++ library", old_program), ("its stopped run", old_run),
                       ("its knowledge base", old_base), ("its campaigns", old_campaigns)):
        try:
            test(place, programs, work)
        except Failure as failure:
            yield f"{release}: {what}: {failure}"


def old_world(place, programs, work):
    run("cc", "-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-I", place / "include", place / "world.c",
        "-o", work / "world.so", "-lm")
    run(programs / "lore-world", "check", work / "world.so", "--steps", "50")


def old_program(place, programs, work):
    run(os.environ.get("CXX", "c++"), "-std=c++20", "-fsyntax-only", "-I", SOURCE / "include", place / "program.cpp")


def old_run(place, programs, work):
    shutil.copytree(place / "stopped-run", work / "old-run")
    (work / "arenas").mkdir(exist_ok=True)
    shutil.copy(place / "stopped-run/arena.toml", work / "arenas/collectball.toml")
    shutil.copy(place / "stopped-run.toml", work)
    run(programs / "lore-kb", "verify", work / "old-run")
    said = run(programs / "lore-evolve", "stopped-run.toml", "--seed", "5", "--archive", "all", "-q", "--resume",
               "--out", "old-run", cwd=work).splitlines()[-1]
    expected = (place / "signature.txt").read_text().strip()
    if said != expected:
        raise Failure(f"it ends with '{said}', not '{expected}'")


def old_base(place, programs, work):
    run(programs / "lore-kb", "verify", place / "base.lorekb")
    features = json.loads(run(programs / "lore-kb", "info", place / "base.lorekb", "--json"))["features"]
    if features != 12:
        raise Failure(f"it has {features} features, not 12")


def old_campaigns(place, programs, work):
    for campaign in sorted(place.glob("jobs/campaigns/*.toml")):
        run(programs / "lore-campaign", "plan", campaign, "--dir", work / "planned")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("record", "check"))
    parser.add_argument("set", type=pathlib.Path, nargs="?", default=SOURCE / "tests/data" / f"release-{version()}")
    parser.add_argument("--programs", type=pathlib.Path, required=True)
    given = parser.parse_args()
    place, programs = given.set.resolve(), given.programs.resolve()
    with tempfile.TemporaryDirectory(prefix="lore-release-") as folder:
        work = pathlib.Path(folder)
        try:
            if given.what == "record":
                if place.exists():
                    raise Failure(f"{given.set} is there: what was released stays as it is")
                record(work / place.name, programs, work)
                shutil.move(work / place.name, place)   # whole, or not at all
                print(f"made {given.set}: commit it with the release, and change it no more")
                return 0
            gone = list(missing(place, programs, work))
        except (Failure, ImportError) as failure:
            print(f"release: {failure}")
            return 1
    print("\n".join(gone) if gone else f"all that {place.name} promised is there")
    return 1 if gone else 0


if __name__ == "__main__":
    sys.exit(main())

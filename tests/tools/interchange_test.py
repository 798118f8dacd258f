#!/usr/bin/env python3
"""A small campaign, handed to other programs: tests/tools/interchange_test.py DIRECTORY_OF_PROGRAMS SOURCE_DIR

What lore-campaign writes is checked here by other means than its own: hashlib, tarfile, zipfile, and the rules of
RO-Crate 1.2, Process Run Crate 0.5 and IOHprofiler's data format as their readers have them.
Prints a line a check and returns 1 if one failed.
"""
import csv
import fcntl
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tarfile
import tempfile
import time
import types
import urllib.parse
import zipfile
import zlib

programs, source_dir = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
SMALL = "[evolution]\npopulation = 8\nfounders = 16\ngenerations = 6\n[episode]\nsteps = 400\n"
CAMPAIGN = """
title = "A campaign for others"
runs = 2
[source]
config = "../tasks/source.toml"
[[knowledge]]
name = "kb1"
run = 1
[[knowledge]]
name = "everybody"
all_of = "kb1"
[[treatment]]
name = "none"
config = "../tasks/target.toml"
[[treatment]]
name = "kb1"
label = "with <KB1>"
config = "../tasks/target.toml"
knowledge = "kb1"
"""
failures = 0


# Of Pythons before 3.11.4, such as Debian 12's, tarfile knows no filters.
SAFELY = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}


def check(holds, what):
    print(("ok     " if holds else "FAILED ") + what, flush=True)
    global failures
    failures += not holds


def lore(*arguments, code=0):
    """What it prints on stdout and stderr; ending with another code is a failure."""
    ran = subprocess.run([programs / "lore-campaign", *map(str, arguments)], capture_output=True, text=True)
    if ran.returncode != code:
        check(False, f"lore-campaign {' '.join(map(str, arguments))} ended with {ran.returncode}: {ran.stderr}")
    return ran.stdout, ran.stderr


def make_campaign():
    for folder in ("tasks", "campaigns"):
        os.mkdir(folder)
    for task in ("source", "target"):
        pathlib.Path(f"tasks/{task}.toml").write_text(f'task = "{task}"\n{SMALL}')
    pathlib.Path("campaigns/c.toml").write_text(CAMPAIGN)
    lore("run", "campaigns/c.toml", "--dir", "c", "-q", "--jobs", 2)
    lore("report", "campaigns/c.toml", "--dir", "c", "-q")


def pack(out, *arguments, code=0):
    return lore("pack", "campaigns/c.toml", "--dir", "c", "--out", out, "--license", "CC-BY-4.0", "--author",
                "Ada Lovelace <https://orcid.org/0000-0002-1825-0097>", *arguments, code=code)


# ---- packs ----


def files_below(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def ids(value):
    return [entry["@id"] for entry in (value if isinstance(value, list) else [value] if value else [])]


def check_crate(folder):
    """The rules of RO-Crate 1.2 and Process Run Crate 0.5 that say MUST, and those of the manual."""
    document = json.loads((folder / "ro-crate-metadata.json").read_text())
    check(document["@context"] == "https://w3id.org/ro/crate/1.2/context", "the context is that of RO-Crate 1.2")
    entities = {entity["@id"]: entity for entity in document["@graph"]}
    check(len(entities) == len(document["@graph"]), "no entity is there twice")
    descriptor = entities["ro-crate-metadata.json"]
    check(descriptor["@type"] == "CreativeWork" and descriptor["about"] == {"@id": "./"}
          and descriptor["conformsTo"] == {"@id": "https://w3id.org/ro/crate/1.2"}, "the descriptor names root and version")
    root = entities["./"]
    check(root["@type"] == "Dataset" and all(root[key] for key in ("name", "description", "license")),
          "the root has what it must have")
    check(re.fullmatch(r"\d{4}-\d\d-\d\d", root["datePublished"]) is not None, "its date is one")
    check("Process Run Crate" == entities[root["conformsTo"]["@id"]]["name"]
          and "CreativeWork" in entities[root["conformsTo"]["@id"]]["@type"], "the profile is described")
    check(entities[root["license"]["@id"]]["name"] == "CC-BY-4.0", "the license is the user's")

    def references(value):
        if isinstance(value, dict):
            if set(value) == {"@id"}:
                yield value["@id"]
            else:
                for member in value.values():
                    yield from references(member)
        elif isinstance(value, list):
            for member in value:
                yield from references(member)

    dangling = {id for id in references(document["@graph"])
                if id not in entities and not id.startswith(("https://w3id.org/ro/crate/", "http://schema.org/"))}
    check(not dangling, f"all that is referred to is described {dangling or ''}")
    reached, open_ids = set(), ["./"]
    while open_ids:
        for part in ids(entities[open_ids.pop()].get("hasPart")):
            if part not in reached:
                reached.add(part)
                open_ids.append(part)
    data = {id for id, entity in entities.items()
            if entity["@type"] in ("File", "Dataset") and id not in ("./", "ro-crate-metadata.json")}
    check(data == reached, "the root has every file and folder as a part, and nothing else")

    there = files_below(folder)
    described = {urllib.parse.unquote(id): entities[id] for id in data
                 if entities[id]["@type"] == "File" and not id.startswith("#")}
    check(set(there) == set(described) | {"ro-crate-metadata.json"}, "every file is described, and every one described is there")
    check(all(described[path]["sha256"] == hashlib.sha256(there[path]).hexdigest()
              and described[path]["contentSize"] == str(len(there[path]))
              for path in described if path != "SHA256SUMS"), "lengths and checksums are right")
    check(all(re.fullmatch(r"\w+/[\w.+-]+", entity["encodingFormat"]) and entity["description"] for entity in described.values()),
          "every file has a media type and says what it is")
    sums = dict(reversed(line.split("  ", 1)) for line in there["SHA256SUMS"].decode().splitlines())
    check(sums == {path: hashlib.sha256(text).hexdigest() for path, text in there.items() if path != "SHA256SUMS"},
          "SHA256SUMS is that of all others")
    check(all((folder / urllib.parse.unquote(id)).is_dir() for id in data if entities[id]["@type"] == "Dataset"),
          "folders are there")
    check_actions(entities, root, folder)
    return entities


def check_actions(entities, root, folder):
    actions = {id: entity for id, entity in entities.items() if entity["@type"] == "CreateAction"}
    check(set(ids(root["mentions"])) == set(actions), "the root mentions every action")
    for id, action in actions.items():
        software = entities[action["instrument"]["@id"]]
        if not (software["@type"] == "SoftwareApplication" and software["name"] and software["softwareVersion"]
                and action["name"] and action["description"] and action["result"] and ids(action["agent"])
                and entities[software["license"]["@id"]]["name"] == "BSD-3-Clause"):
            check(False, f"{id} has what an action must have")
    run = actions["#run/kb1/002"]
    manifest = json.loads((folder / "runs/kb1/002/manifest.json").read_text())
    values = {entities[id]["name"]: entities[id]["value"] for id in ids(run["object"]) + ids(run["result"])
              if entities[id]["@type"] == "PropertyValue"}
    check(values == {"seed": "2", "signature": manifest["signature"]}, "a run has its seed and its signature")
    check({"inputs/tasks/target.toml", "knowledge/kb1.lorekb"} < set(ids(run["object"])), "and what it was made from")
    times = [manifest["sessions"][0][key].replace("Z", "+00:00") for key in ("started", "stopped")]
    check([run["startTime"], run["endTime"]] == times, "and its times")
    check("runs/kb1/002/" in ids(run["result"]) and run["actionStatus"]["@id"].endswith("/CompletedActionStatus"), "and its results")
    build = manifest["build"]
    software = entities[run["instrument"]["@id"]]
    check(software["softwareVersion"] == f"{build['version']}+{build['commit']}" and build["compiler"] in software["description"],
          "and version, commit and compiler of its program")
    check(run["description"] == "lore-evolve inputs/tasks/target.toml --seed 2 --out ./runs/kb1/002 --resume "
          "--kb ./knowledge/kb1.lorekb", "and the command as it is typed in the unpacked archive")


def unpacked(archive, name):
    folder = pathlib.Path(name)
    if archive.endswith(".zip"):
        with zipfile.ZipFile(archive) as file:
            file.extractall(folder)
    else:
        with tarfile.open(archive) as file:
            file.extractall(folder, **SAFELY)
    return folder


def packs_are_whole():
    for ending in ("tar.zst", "tar.gz", "zip"):
        pack(f"p.{ending}")
        said = lore("verify", f"p.{ending}")[0]
        check(said.startswith(f"p.{ending}: 'A campaign for others', ") and said.endswith("files, whole; 0 left out\n"),
              f"a pack .{ending} is whole")
    time.sleep(1.1)
    for path in pathlib.Path("c").rglob("*.csv"):
        os.utime(path, (1, 1))
    shutil.copytree("c", "copy")
    for ending in ("tar.zst", "tar.gz", "zip"):
        subprocess.run([programs / "lore-campaign", "pack", "-q", "campaigns/c.toml", "--dir", "copy/", "--out", f"again.{ending}",
                        "--license", "CC-BY-4.0", "--author", "Ada Lovelace <https://orcid.org/0000-0002-1825-0097>"],
                       check=True, env={**os.environ, "TZ": "Asia/Tokyo", "LC_ALL": "C"})
        same = pathlib.Path(f"p.{ending}").read_bytes() == pathlib.Path(f"again.{ending}").read_bytes()
        check(same, f"a copy, packed later and elsewhere, has the same bytes (.{ending})")
    check_crate(unpacked("p.tar.gz", "gz"))
    check(files_below(unpacked("p.zip", "zip")) == files_below(pathlib.Path("gz")), "a zip holds the same files")
    check("whole" in lore("verify", "gz")[0], "a directory that it was unpacked into is whole")


def an_unpacked_pack_goes_on():
    there = os.getcwd()
    os.chdir("gz")
    check("10 done" in lore("status", "-q", "inputs/campaigns/c.toml", "--dir", ".")[0], "the unpacked campaign is at its end")
    lore("report", "inputs/campaigns/c.toml", "--dir", ".", "--out", "../report", "-q")
    lore("pack", "inputs/campaigns/c.toml", "--dir", ".", "-q", "--license", "CC-BY-4.0", "--author",
         "Ada Lovelace <https://orcid.org/0000-0002-1825-0097>")
    lore("verify", ".")
    os.chdir(there)
    check(pathlib.Path("report/final.csv").read_bytes() == pathlib.Path("c/final.csv").read_bytes(), "and is reported again")
    check(files_below(pathlib.Path("gz")) == files_below(pathlib.Path("zip")), "and described again, to the byte")


def what_is_left_out_is_stated():
    said = pack("less.tar.gz", "--leave-out", "individuals", "--leave-out", "checkpoints")[0]
    whole = len(files_below(pathlib.Path("zip"))) - 2
    check(f"{whole - 8} files" in said and "8 left out" in said, "a pack says how much it leaves out")
    check("whole; 8 left out" in lore("verify", "less.tar.gz")[0], "and is whole without it")
    folder = unpacked("less.tar.gz", "less")
    crate = {entity["@id"]: entity for entity in json.loads((folder / "ro-crate-metadata.json").read_text())["@graph"]}
    entity = crate["#left-out/runs/archive/everybody/all.lore"]
    text = pathlib.Path("c/runs/archive/everybody/all.lore").read_bytes()
    check(entity["localPath"] == "runs/archive/everybody/all.lore" and entity["sha256"] == hashlib.sha256(text).hexdigest(),
          "its metadata have the checksum of what is left out")
    check("Left out: individuals (1 files, " in crate["./"]["description"], "and the root says what it is")
    shutil.copy("c/runs/archive/everybody/all.lore", "less/runs/archive/everybody/all.lore")
    check("all.lore: it is described as left out, and is there" in lore("verify", "less", code=1)[1], "it is not to be there")


def damage_is_found():
    whole = pathlib.Path("zip")
    draw = random.Random(1)
    for path in ("runs/kb1/001/lineage.lore", "runs/none/002/progress.csv", "knowledge/kb1.lorekb", "report.html",
                 "inputs/tasks/source.toml", "ro-crate-metadata.json", "SHA256SUMS", "logs/source-001.log"):
        text = (whole / path).read_bytes()
        at = draw.randrange(len(text))
        (whole / path).write_bytes(text[:at] + bytes([text[at] ^ 1]) + text[at + 1:])
        said = lore("verify", "zip", code=1)[1].splitlines()
        check(any(path in line for line in said), f"a flipped bit in {path} is found ({said[0]})")
        (whole / path).write_bytes(text)
    os.rename("zip/final.csv", "zip/last.csv")
    said = lore("verify", "zip", code=1)[1].splitlines()
    check(said[:2] == ["final.csv: it is missing", "last.csv: it is not described"] and len(said) == 3, "so is another name")
    os.rename("zip/last.csv", "zip/final.csv")
    os.symlink("/etc/passwd", "zip/link")
    check("link: it is a link" in lore("verify", "zip", code=1)[1], "and a link")
    os.remove("zip/link")
    lore("verify", "zip")

    for archive in ("p.tar.zst", "p.tar.gz", "p.zip"):
        text = pathlib.Path(archive).read_bytes()
        damaged = pathlib.Path("damaged" + archive[1:])
        for share in (0.1, 0.5, 0.9):
            damaged.write_bytes(text[:int(len(text) * share)])
            check(lore("verify", damaged, code=1)[1] != "", f"{archive} cut at {share} is found")
        missed = 0
        for _ in range(25):
            at = draw.randrange(len(text))
            damaged.write_bytes(text[:at] + bytes([text[at] ^ 1 << draw.randrange(8)]) + text[at + 1:])
            ran = subprocess.run([programs / "lore-campaign", "verify", damaged], capture_output=True)
            if ran.returncode == 0 and not archive.endswith("zst"):
                # Bits that no file depends on: times, the number of the operating system. A zip has each name twice,
                # and libarchive reads one of them; who reads both refuses the archive.
                try:
                    missed += files_below(unpacked(str(damaged), f"bits-{at}")) != files_below(whole)
                except (zipfile.BadZipFile, RuntimeError, EOFError, zlib.error):   # RuntimeError: method, encryption
                    pass
            elif ran.returncode not in (0, 1):
                missed += 1
        check(missed == 0, f"a flipped bit anywhere in {archive} is found, is refused where it is unpacked, or changes no file")


def a_pack_is_of_the_campaign_that_made_its_runs():
    pathlib.Path("campaigns/other.toml").write_text("first_seed = 900\n" + CAMPAIGN)
    _, complaint = lore("pack", "campaigns/other.toml", "--dir", "c", "--out", "other.zip", code=2)
    check("it has seed" in complaint and "Give the campaign" in complaint,
          f"runs of another campaign are not packed ({complaint.strip()})")
    check(not pathlib.Path("other.zip").exists(), "and nothing is written")
    pack("p.zip", "--date", "2026-13-45", code=2)


def a_pack_is_all_or_nothing():
    pack("p.zip", code=2)
    with open("c/notes.bin", "wb") as file:
        file.truncate(400 << 20)
    packing = subprocess.Popen([programs / "lore-campaign", "pack", "campaigns/c.toml", "--dir", "c", "--out", "late.tar.gz"],
                               stderr=subprocess.PIPE, text=True)
    while not list(pathlib.Path(".").glob("late.tar.gz.lore-tmp-*")) and packing.poll() is None:
        time.sleep(0.01)
    packing.send_signal(signal.SIGTERM)
    said = packing.communicate()[1]
    check(packing.returncode == 75 and "stopped" in said, f"a signal stops it ({packing.returncode}, {said.strip()})")
    check(not list(pathlib.Path(".").glob("late*")), "and nothing is left of it")
    os.remove("c/notes.bin")
    with open("c/steps/none-001.lock", "w") as lock:
        # What a step at work holds: OFD locks, whose numbers Python does not know.
        fcntl.fcntl(lock, 37, struct.pack("hhqqi4x", fcntl.F_WRLCK, os.SEEK_SET, 0, 0, 0))
        shutil.move("c/runs/none/001/manifest.json", "manifest.json")
        check("none/001 is at work" in pack("busy.zip", code=1)[1], "a campaign at work is not packed")
        shutil.move("manifest.json", "c/runs/none/001/manifest.json")


# ---- IOHprofiler ----


def check_ioh(folder):
    """As IOHanalyzer's read_index_file__json and read_dat, and iohinspector's Dataset.from_dict and Scenario.load."""
    found = sorted(folder.rglob("*.json"))
    check(len(found) == 3, "a description for each treatment")
    names = []
    for path in found:
        about = json.loads(path.read_text())
        missing = {"version", "suite", "function_id", "function_name", "maximization", "algorithm", "attributes",
                   "scenarios"} - set(about)
        check(not missing, f"{path.name} has what readers ask for {missing or ''}")
        check(tuple(map(int, about["version"].split("."))) >= (0, 3, 3), "a version that IOHanalyzer knows")
        check(about["maximization"] is True and about["attributes"][:2] == ["evaluations", "raw_y"], "rewards are maximized")
        check(path.name == f"IOHprofiler_f{about['function_id']}_{about['function_name']}.json", "its name is the function's")
        names.append(about["algorithm"]["name"])
        for scenario in about["scenarios"]:
            check(isinstance(scenario["dimension"], int) and 0 < scenario["dimension"] < 1 << 16, "a dimension")
            lines = (path.parent / scenario["path"]).read_text().splitlines()
            blocks = []
            for line in lines:
                if line == " ".join(about["attributes"]):
                    blocks.append([])
                else:
                    blocks[-1].append(tuple(map(float, line.split(" "))))
            check(len(blocks) == len(scenario["runs"]) == 2, "a block of data for each run")
            for run, rows in zip(scenario["runs"], blocks):
                evaluations = [row[0] for row in rows]
                check(evaluations[0] == 1 and evaluations == sorted(set(evaluations)), "evaluations grow, from 1")
                check(run["evals"] == evaluations[-1] and {"evals", "y", "x"} == set(run["best"]), "the last is the run's")
                best = max(row[1] for row in rows)
                check(run["best"]["y"] == best and run["best"]["evals"] == next(row[0] for row in rows if row[1] == best),
                      "the best is that of its rows")
                with open(f"c/runs/{about['algorithm']['name']}/{run['instance']:03}/progress.csv") as table:
                    last = list(csv.DictReader(table))[-1]
                check(run["evals"] == int(last["evaluations"]) and run["seed"] == run["instance"], "and of its table")
    check(sorted(names) == ["kb1", "none", "source"], "treatments are algorithms")


def the_export_is_read_by_iohprofiler():
    lore("export", "campaigns/c.toml", "--dir", "c", "--out", "ioh")
    check_ioh(pathlib.Path("ioh"))
    lore("export", "campaigns/c.toml", "--dir", "c", "--out", "ioh", code=2)


# ---- events ----


def events_tell_what_the_files_tell():
    told = [json.loads(line) for line in lore("events", "c")[0].splitlines()]
    check({event["run"] for event in told} == {"source/001", "source/002", "none/001", "none/002", "kb1/001", "kb1/002",
                                               "archive/everybody"}, "events are of all runs")
    rows = [event for event in told if event["run"] == "kb1/002" and event["event"] == "generation"]
    with open("c/runs/kb1/002/progress.csv") as table:
        columns = list(csv.DictReader(table))
    check([{name: str(row[name]) if name == "distance" else float(row[name]) for name in columns[0]} for row in rows]
          == [{name: text if name == "distance" else float(text) for name, text in row.items()} for row in columns],
          "generations are the rows of progress.csv")


def events_follow_a_run_to_its_end():
    follow = subprocess.Popen([programs / "lore-campaign", "events", "live", "--follow"], stdout=subprocess.PIPE, text=True)
    run = subprocess.run([programs / "lore-evolve", "tasks/source.toml", "--seed", "3", "--out", "live", "-q"],
                         capture_output=True, text=True)
    told = [json.loads(line) for line in follow.communicate(timeout=120)[0].splitlines()]
    check(follow.returncode == 0 and told[0]["event"] == "run_begun" and told[-1]["event"] == "run_ended",
          "events follow a run from its beginning to its end")
    check(run.stdout.endswith(f"signature: {told[-1]['signature']}\n"), "with its signature")
    check([event["generation"] for event in told if event["event"] == "generation"] == list(range(7)), "and all generations")
    lore("events", "tasks", code=2)


def the_example_of_the_manual_feeds_a_tracker():
    """With a module in the place of MLflow that keeps what it is told."""
    page = (source_dir / "docs/manual/formats.md").read_text()
    example = re.search(r"This feeds MLflow:\n\n```python\n(.*?)```", page, re.DOTALL)[1].replace(', "--follow"', "")
    metrics, ended, parameters = {}, [], {}

    class Client:
        def create_experiment(self, name):
            return "1"

        def create_run(self, experiment, run_name):
            return types.SimpleNamespace(info=types.SimpleNamespace(run_id="id of " + run_name))

        def log_param(self, run, key, value):
            parameters[run, key] = value

        def log_metric(self, run, key, value, step):
            metrics[run, key, step] = value

        def set_terminated(self, run):
            ended.append(run)

    sys.modules["mlflow"] = types.SimpleNamespace(MlflowClient=Client)
    os.makedirs("runs", exist_ok=True)
    os.symlink(os.path.abspath("c"), "runs/small")
    os.environ["PATH"] = f"{programs}:{os.environ['PATH']}"
    exec(compile(example, "formats.md", "exec"), {})
    check(len(ended) == 7 and parameters["id of kb1/001", "evolution.population"] == 8, "the example tells runs and settings")
    check(metrics["id of kb1/001", "mean_diversity", 6] > 0 and len(metrics) == 7 * 7 * 3, "and generations")


# ---- another world ----


def a_campaign_in_another_world_goes_too():
    """The pendulum is found along LORE_WORLD_PATH, and beside its configuration in the pack."""
    os.mkdir("poles")
    for pole in ("short", "long"):
        pathlib.Path(f"poles/{pole}.toml").write_text(
            f'{SMALL}[world]\nlibrary = "pendulum"\n[world.settings]\ntask = "{pole}_pole"\n')
    pathlib.Path("poles/c.toml").write_text(
        'title = "Poles"\nruns = 2\n[source]\nconfig = "short.toml"\n[[treatment]]\nname = "none"\nconfig = "long.toml"\n'
        '[[treatment]]\nname = "again"\nconfig = "long.toml"\nfirst_seed = 7\n'
        '[[pool]]\nname = "both"\ntreatments = ["none", "again"]\n')
    os.environ["LORE_WORLD_PATH"] = str(programs.parent / "worlds")
    lore("run", "poles/c.toml", "--dir", "poles/runs", "-q", "--jobs", 2)
    lore("report", "poles/c.toml", "--dir", "poles/runs", "-q")
    lore("pack", "poles/c.toml", "--dir", "poles/runs", "--out", "poles.tar.gz", "-q")
    del os.environ["LORE_WORLD_PATH"]
    check("whole" in lore("verify", "poles.tar.gz")[0], "a pack of another world is whole")
    folder = unpacked("poles.tar.gz", "poles-gz")
    crate = {entity["@id"]: entity for entity in json.loads((folder / "ro-crate-metadata.json").read_text())["@graph"]}
    check("inputs/pendulum.so" in ids(crate["#run/none/002"]["object"]), "the library is an input of its runs")
    there = os.getcwd()
    os.chdir(folder)
    check("6 done" in lore("status", "-q", "inputs/c.toml", "--dir", ".")[0], "the unpacked campaign is at its end")
    shutil.rmtree("runs/again/002")
    lore("run", "inputs/c.toml", "--dir", ".", "-q")
    os.chdir(there)
    again = [json.loads((path / "runs/again/002/manifest.json").read_text())["signature"] for path in (folder, pathlib.Path("poles/runs"))]
    check(again[0] == again[1], "and runs again in the library that it holds")
    last = [json.loads(line) for line in lore("events", "poles/runs/runs/none/001")[0].splitlines()][-2:]
    check(isinstance(last[-1]["best_reward"], float) and "best_balls" not in last[-1], "its events have rewards")
    lore("export", "poles/c.toml", "--dir", "poles/runs", "--out", "poles-ioh")
    check(sorted(path.name for path in pathlib.Path("poles-ioh").rglob("*.json")) ==
          ["IOHprofiler_f1_pendulum_short_pole.json", *["IOHprofiler_f2_pendulum_long_pole.json"] * 2], "its tasks are functions")


with tempfile.TemporaryDirectory(prefix="lore-interchange-") as scratch:
    os.chdir(scratch)
    make_campaign()
    packs_are_whole()
    an_unpacked_pack_goes_on()
    what_is_left_out_is_stated()
    damage_is_found()
    the_export_is_read_by_iohprofiler()
    events_tell_what_the_files_tell()
    events_follow_a_run_to_its_end()
    the_example_of_the_manual_feeds_a_tracker()
    a_pack_is_of_the_campaign_that_made_its_runs()
    a_pack_is_all_or_nothing()
    a_campaign_in_another_world_goes_too()
    os.chdir("/")
sys.exit(1 if failures else 0)

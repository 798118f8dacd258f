"""What bench-report, bench-compare and scaling-report share: running Lore's programs and reading what they say."""

import argparse
import csv
import json
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time


class Refusal(Exception):
    """One line: what, why, what to do."""


SOURCE = pathlib.Path(__file__).resolve().parents[2]
_started = []   # runs of lore-evolve, none of which is to outlive main()


# The machine

def processors_at_work(seconds=2.0):
    """How many processors are busy, on average over some seconds."""
    def ticks():
        fields = [int(field) for field in pathlib.Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
        return sum(fields), fields[3] + fields[4]   # all, idle
    all_before, idle_before = ticks()
    time.sleep(seconds)
    all_after, idle_after = ticks()
    return os.cpu_count() * (1 - (idle_after - idle_before) / max(all_after - all_before, 1))


def refuse_if_busy(anyway):
    """A word for the report; throws Refusal where others are at work on this machine."""
    at_work = processors_at_work()
    if at_work < 0.2:
        return ""
    load = os.getloadavg()[0]
    if not anyway:
        raise Refusal(f"the machine is busy ({at_work:.1f} of {os.cpu_count()} processors at work, load average "
                      f"{load:.1f}; figures would say little). Wait until it is idle, or add --busy-anyway.")
    return f"**The machine was busy** ({at_work:.1f} of {os.cpu_count()} processors at work): trust ratios only."


def machine(build):
    """Who measures what on what; from lore-evolve --version."""
    version = run([program(build, "lore-evolve"), "--version"]).stdout
    def find(pattern):
        found = re.search(pattern, version)
        return found.group(1) if found else "unknown"
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return {"commit": find(r"\(commit (.*?)\)"), "compiler": find(r"compiled by (.*)"),
            "isa": find(r"instruction set (\w+)"), "mpi": find(r"(Open MPI .*|MPICH .*)"),
            "cpu": cpu.group(1) if cpu else "unknown processor", "processors": os.cpu_count(),
            "date": time.strftime("%Y-%m-%d")}


def processor_line(where):
    return (f"{where['compiler']}, {where['mpi']}; {where['cpu']}, {where['processors']} processors, instruction set "
            f"{where['isa']}; {where['date']}.")


def described(where):
    commit = where["commit"]
    clean = "with changes that are not committed" if commit.endswith("-dirty") else "clean"
    return f"Commit `{commit.removesuffix('-dirty')}` ({clean}), {processor_line(where)}"


# Programs

def program(build, name):
    path = pathlib.Path(build) / "bin" / name
    if not path.exists():
        raise Refusal(f"there is no {path} (it was not built). Build with -DLORE_BUILD_BENCHMARKS=ON, or "
                      "name the folder with --build.")
    return str(path)


def environment():
    settings = dict(os.environ)
    if os.geteuid() == 0:   # what Open MPI wants as root, and in containers
        for name, value in (("OMPI_ALLOW_RUN_AS_ROOT", "1"), ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
                            ("OMPI_MCA_btl_vader_single_copy_mechanism", "none")):
            settings.setdefault(name, value)
    return settings


def complain_unless_done(command, exit_code, errors):
    if exit_code != 0:
        last = errors.strip().split("\n")[-1]
        raise Refusal(f"{' '.join(command)} failed with exit code {exit_code} ({last}). Run it by hand.")


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, env=environment(), check=False)
    complain_unless_done(command, done.returncode, done.stderr)
    return done


def benchmark_names(build):
    names = set(run([program(build, "lore-bench"), "--benchmark_list_tests"]).stdout.split())
    return names | {name.split("/iterations:")[0] for name in names}


def benchmarks(build, cases, repetitions, seconds):
    """{case: {"time": [s], counter: [..]}}, one value a repetition. Times are of the processor, not of the wall,
    so that they mean something on a machine that is not quite idle. Repetitions of different cases are mixed."""
    command = [program(build, "lore-bench"), f"--benchmark_filter=^({'|'.join(cases)})$",
               f"--benchmark_repetitions={repetitions}", f"--benchmark_min_time={seconds}",
               "--benchmark_enable_random_interleaving=true", "--benchmark_format=json"]
    to_seconds = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
    known = {"name", "run_name", "cpu_time", "real_time", "iterations", "repetitions", "repetition_index", "threads",
             "family_index", "per_family_instance_index"}
    results = {}
    for one in json.loads(run(command).stdout)["benchmarks"]:
        if one["run_type"] != "iteration":
            continue
        case = results.setdefault(re.sub(r"/iterations:\d+", "", one["run_name"]), {})
        case.setdefault("time", []).append(one["cpu_time"] * to_seconds[one["time_unit"]])
        for name, value in one.items():
            if name not in known and isinstance(value, float):
                case.setdefault(name, []).append(value)
    return results


class Resident:
    """The largest resident memory among the lore-evolve below a process, and how much of it is files (shared) [MB]."""

    def __init__(self, root):
        self.root, self.most, self.files = root, 0.0, 0.0

    def look(self):
        waiting = [self.root]
        while waiting:
            pid = waiting.pop()
            try:
                for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
                    waiting += [int(child) for child in (task / "children").read_text().split()]
                status = pathlib.Path(f"/proc/{pid}/status").read_text()
            except OSError:
                continue   # has ended meanwhile
            if not status.startswith("Name:\tlore-evolve"):
                continue
            def size(field):
                found = re.search(rf"{field}:\s*(\d+) kB", status)
                return int(found.group(1)) * 1024 / 1e6 if found else 0.0
            if size("VmHWM") > self.most:
                self.most, self.files = size("VmHWM"), size("RssFile") + size("RssShmem")


def task_file(source, task):
    """The configuration of a task; earlier commits have it in another folder."""
    now, before = source / "jobs" / "tasks" / f"{task}.toml", source / "jobs" / f"{task}.toml"
    return str(before if before.exists() else now)


def start_evolution(build, task, directory, *, source=SOURCE, ranks=1, nodes=None, generations=None, kb=None,
                    settings=(), archive=None, seed=1):
    """Of a run with so many ranks here, or with one on each of `nodes`."""
    command = [program(build, "lore-evolve"), task_file(source, task), "--seed", str(seed), "--out", directory]
    if generations is not None:
        settings = (f"evolution.generations={generations}", *settings)
    for setting in settings:
        command += ["--set", setting]
    if kb:
        command += ["--kb", kb]
    if archive:
        command += ["--archive", archive]
    if nodes:
        command = nodes.command(command)
    elif ranks > 1:
        command = ["mpirun", "-n", str(ranks), "--bind-to", "none", *command]
    with open(f"{directory}.out", "w") as out, open(f"{directory}.err", "w") as err:
        process = subprocess.Popen(command, stdout=out, stderr=err, env=environment())
    _started.append(process)
    return command, process


def read_evolution(command, process, directory):
    """What a run that has ended tells of itself: seconds a generation (the founders' left out), the share of each
    rank's time [%], signature, best balls."""
    errors = pathlib.Path(f"{directory}.err").read_text()
    complain_unless_done(command, process.returncode, errors)
    rows = list(csv.DictReader(open(f"{directory}/progress.csv")))
    seconds = [float(row["seconds"]) for row in rows]
    table = re.search(r"^ *rank +(.*)\n((?: +\d.*\n?)+)", errors, re.MULTILINE)
    shares = []
    if table:
        columns = table.group(1).split()
        shares = [dict(zip(columns, map(float, line.split()[1:]))) for line in table.group(2).strip().split("\n")]
    signature = pathlib.Path(f"{directory}.out").read_text().split()[-1]
    return {"generation": (seconds[-1] - seconds[0]) / (len(rows) - 1), "seconds": seconds[-1],
            "generations": len(rows) - 1, "shares": shares, "signature": signature,
            "best_balls": int(rows[-1]["best_balls"])}


def evolve(build, task, **options):
    """A whole run of lore-evolve. Tells also its largest resident memory, and `attention`: the share of the wall time
    that one rank had a processor for, below 1 on a busy machine."""
    with tempfile.TemporaryDirectory() as scratch:
        directory = f"{scratch}/run"
        begin = time.monotonic()
        command, process = start_evolution(build, task, directory, **options)
        resident = Resident(process.pid)
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            resident.look()
            time.sleep(0.05)   # what looks often takes a processor from the ranks
        process.returncode = os.waitstatus_to_exitcode(status)
        attention = min(1.0, (usage.ru_utime + usage.ru_stime) / (time.monotonic() - begin))
        memory = {"resident": resident.most, "resident_files": resident.files}
        return read_evolution(command, process, directory) | memory | {"attention": attention}


def write_base(build, directory):
    """The knowledge base of the benchmarks, as a file."""
    path = f"{directory}/base.lorekb"
    run([program(build, "lore-bench"), f"--write_knowledge={path}"])
    return path


# Reports

def median(values):
    return statistics.median(values)


def markdown_table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def put_between_marks(path, mark, text, otherwise):
    """Replaces what stands between `<!-- mark: begin ... -->` and `<!-- mark: end -->`. A file without marks gets
    `otherwise`, then marks and text, at its end."""
    path, text = pathlib.Path(path), text.strip("\n")   # not the spaces that make its first line a command
    old = path.read_text() if path.exists() else ""
    block = re.compile(rf"(<!-- {mark}: begin[^\n]*-->\n).*?(<!-- {mark}: end -->)", re.DOTALL)
    if block.search(old):
        new = block.sub(lambda found: f"{found.group(1)}{text}\n{found.group(2)}", old)
    else:
        name = pathlib.Path(sys.argv[0]).name
        marked = f"<!-- {mark}: begin (written by tools/{name}) -->\n{text}\n<!-- {mark}: end -->\n"
        new = f"{old.rstrip()}\n\n{otherwise.strip()}\n\n{marked}"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(new.lstrip())


# Command lines

def whole_number(least):
    """A type of an argument."""
    def read(text):
        if not text.isdigit() or int(text) < least:
            raise argparse.ArgumentTypeError(f"'{text}' is no whole number of at least {least}")
        return int(text)
    return read


def main(work):
    """Runs a program's work; what goes wrong becomes one line and exit code 1. However it ends, nothing that it started
    goes on."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    try:
        work()
    except (Refusal, OSError) as problem:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {problem}")
    except KeyboardInterrupt:
        sys.exit(130)
    finally:
        for process in _started:
            if process.poll() is None:
                process.terminate()
                process.wait()

"""What the comparisons share: other libraries fetched into one directory, programs run by turns, Markdown written.

A program prints one line of JSON: {"cpu": seconds, "wall": seconds, "memory": bytes, "counts": [...]} for the operation
alone. Nothing is written outside the directory that the reader names, but the section of docs/benchmarks.md.
"""

import json
import math
import os
import platform
import re
import statistics
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOCUMENT = HERE.parents[2] / "docs" / "benchmarks.md"

REPETITIONS = 5
# A run that takes longer (in seconds of CPU time) is not repeated, but the first engine's is up to ten times that.
LONG = 2.0
# And a process that takes longer than this, in seconds, is given up.
LIMIT = 100


def call(*command, **options):
    print("+", " ".join(map(str, command)), file=sys.stderr)
    subprocess.run([str(c) for c in command], check=True, stdout=sys.stderr, **options)


def cargo(directory, package):
    """Builds one of the small Rust packages beside this file; returns its program."""
    target = directory / "target"
    manifest = HERE / package / "Cargo.toml"
    call("cargo", "build", "--release", "--locked", "--manifest-path", manifest, "--target-dir", target)
    return target / "release" / package


def python(directory, *packages):
    """A virtual environment with some packages; returns its interpreter."""
    environment = directory / "python"
    if not environment.exists():
        venv.create(environment, with_pip=True)
    call(environment / "bin" / "pip", "install", "-q", *packages)
    return environment / "bin" / "python"


def debian(directory, *packages):
    """Unpacks Debian packages without installing them; returns the directory that stands for /usr."""
    root = directory / "debian"
    archives = directory / "archives"
    archives.mkdir(exist_ok=True)
    if not root.exists():
        call("apt-get", "download", *packages, cwd=archives)
        for archive in archives.glob("*.deb"):
            call("dpkg-deb", "-x", archive, root)
    return root / "usr"


def compile_cpp(source, program, usr, *libraries):
    arch = subprocess.check_output(["dpkg-architecture", "-qDEB_HOST_MULTIARCH"], text=True).strip()
    lib = usr / "lib" / arch
    call("g++", "-O3", "-DNDEBUG", "-w", "-I", usr / "include", "-I", usr / "include" / arch, source, "-o", program,
         "-L", lib, f"-Wl,-rpath,{lib}", *(f"-l{name}" for name in libraries))
    return program


def run(command, limit):
    """What one run prints, or why there is nothing: a word."""
    # A limit of CPU time (RLIMIT_CPU) would make Linux count the CPU time of the process in ticks of milliseconds.
    try:
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return "time"
    lines = done.stdout.strip().splitlines()
    return json.loads(lines[-1]) if done.returncode == 0 and lines else "fails"


def bench(name):
    """Builds a bench target of lar-arrangement; returns its program."""
    command = ["cargo", "bench", "-p", "lar-arrangement", "--bench", name, "--locked", "--no-run", "--message-format=json"]
    print("+", *command, file=sys.stderr)
    lines = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, cwd=HERE).stdout.splitlines()
    return next(Path(m["executable"]) for m in map(json.loads, lines)
                if m.get("executable") and m["target"]["name"] == name)


def by_turns(engines, file, too_large, repetitions=REPETITIONS):
    """Runs all engines on a file or directory by turns: medians of CPU time, wall time and memory for each, and what
    else it prints of its first run.

    `too_large` remembers for engines that took too long how large the first engine's result was: they are not tried on
    larger ones.
    """
    runs = {name: [] for name in engines}
    ours = next(iter(engines))
    for turn in range(repetitions):
        for name, command in engines.items():
            if turn == 0 and name in too_large and size(runs[ours]) > too_large[name]:
                runs[name].append("–")
            elif turn == 0 or is_short(runs[name][0], 10 * LONG if name == ours else LONG):
                runs[name].append(run([*command, file], LIMIT))
    for name, results in runs.items():
        if results[0] == "time":
            too_large[name] = min(size(runs[ours]), too_large.get(name, math.inf))
    print(file.stem, {name: r[0] if isinstance(r[0], str) else f"{r[0]['cpu']:.3f}" for name, r in runs.items()},
          file=sys.stderr, flush=True)
    return {name: merged(results) for name, results in runs.items()}


def turns(commands, repetitions, limit=LIMIT):
    """Runs all commands by turns, however long they take: for each what `by_turns` returns, and the wall times of all turns."""
    runs = {name: [] for name in commands}
    for _ in range(repetitions):
        for name, command in commands.items():
            runs[name].append(run(command, limit))
    print({name: [r if isinstance(r, str) else f"{r['wall']:.3f}" for r in results] for name, results in runs.items()},
          file=sys.stderr, flush=True)
    return {name: with_walls(merged(results), results) for name, results in runs.items()}


def with_walls(result, results):
    return {**result, "walls": [r["wall"] for r in results]} if isinstance(result, dict) else result


def is_short(result, seconds):
    return isinstance(result, dict) and result["cpu"] <= seconds


def size(results):
    return results[0]["counts"][0] if isinstance(results[0], dict) else math.inf


def merged(results):
    if any(isinstance(r, str) for r in results):
        return next(r for r in results if isinstance(r, str))
    median = {key: statistics.median(r[key] for r in results) for key in ("cpu", "wall", "memory")}
    if any(r["counts"] != results[0]["counts"] for r in results):
        return "varies"
    return {**results[0], **median, "n": len(results)}


def machine():
    """Cores and clock, and how busy they were."""
    text = Path("/proc/cpuinfo").read_text()
    clock = max(map(float, re.findall(r"cpu MHz\s*: ([\d.]+)", text)), default=0.0) / 1000
    memory = int(re.search(r"MemTotal:\s*(\d+)", Path("/proc/meminfo").read_text())[1]) / 2**20
    load = os.getloadavg()[2]
    return (f"{os.cpu_count()} cores ({platform.machine()}, {clock:.1f} GHz), {memory:.0f} GB of memory; mean load while "
            f"this ran: {load:.1f}")


def write_section(name, text):
    """Replaces what stands between the section's marks in docs/benchmarks.md, or adds it."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    old = DOCUMENT.read_text() if DOCUMENT.exists() else "# Benchmarks\n"
    section = f"{begin}\n{text.strip()}\n{end}"
    if begin in old:
        new = old[: old.index(begin)] + section + old[old.index(end) + len(end):]
    else:
        new = f"{old.rstrip()}\n\n{section}\n"
    DOCUMENT.write_text(new)

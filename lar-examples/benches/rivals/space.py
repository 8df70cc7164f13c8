#!/usr/bin/env python3
"""Spatial arrangements and Booleans compared with other libraries: `space.py DIRECTORY [--only WORKLOAD ...]`.

Fetches and builds the others in DIRECTORY (which is made; about 1.5 GB), writes the workloads of
lar-arrangement/benches/space there, runs all libraries on them by turns, on one thread and on two, checks that areas,
volumes and cells are the same, and writes the section on space and the picture of docs/benchmarks.md. With `--only` the
other rows are those of the last run in DIRECTORY. trueform's licence allows only non-commercial use: `--without
trueform` leaves it out. Needs Linux with cargo, taskset, and Python with venv.
"""

import argparse
import json
import math
import os
import sys
from pathlib import Path

sys.dont_write_bytecode = True
import harness  # noqa: E402, as its byte code must not land beside it

sys.path.append(str(harness.HERE / "space"))
import report  # noqa: E402

# How our bench is told what to do.
OPERATIONS = {"cells": [], "boolean": ["--boolean"]}
# Turns on one thread, on two threads.
REPETITIONS = {1: 5, 2: 3}
# Turns of what is compared with itself, by size, by position: of what is short, of what is not.
TURNS = {True: 9, False: 3}
# Turns of one thread, two, and two copies, as a machine may change its speed within seconds: many short ones, at most so many, as
# long as they take about so many seconds; and how long what is short is repeated within one, at least.
MOST_TURNS, ALL_TURNS, IN_A_TURN = 25, 100.0, 0.5
# How long, and how often at most, an operation is repeated in one process: the first one touches all its memory for the
# first time, and does not count if there is another.
SECONDS, TIMES = 2.0, 25
PACKAGES = {"trueform": "trueform==0.10.7", "manifold3d": "manifold3d==3.5.4", "meshlib": "meshlib==3.1.4.297"}
RUST = ["manifold-rust", "boolmesh"]
# Nobody else's measure, as there is one operand, or too many to be united two at a time: for threads and growth only.
OURS_ONLY = ["ball-320k", "ball-1M", "scattered-100k", "scattered-1M"]
WORKLOADS = [
    "three-cubes", "cubes-10", "cubes-30", "cubes-100", "cubes-300",
    "spheres-5k", "spheres-20k", "spheres-80k", "spheres-320k", "spheres-1M",
    "shifted-128", "shifted-2", "shifted-welded", "coplanar-128", "coplanar-2", "coplanar-welded",
    "turned-128", "turned-2", "turned-welded", "nested", "holes", "scattered-10k", *OURS_ONLY,
]  # fmt: skip


class Comparison:
    def __init__(self, directory, without):
        self.ours = harness.bench("space")
        self.rust = harness.cargo(directory, "space")
        self.packages = [name for name in PACKAGES if name not in without]
        wanted = [PACKAGES[name] for name in self.packages]
        self.python = harness.python(directory, "numpy==2.4.6", "matplotlib==3.11.2", *wanted)
        self.workloads = directory / "space"
        # What an operation takes too long for is not tried on larger workloads of its family.
        self.too_large = {}

    def pinned(self, threads, *command):
        """The command on the first processors only: the other libraries start as many threads as they may use."""
        return ["taskset", "-c", f"0-{threads - 1}", *command]

    def lar(self, threads, *options):
        return self.pinned(threads, *self.operation(threads, *options))

    def operation(self, threads, *options, seconds=SECONDS):
        return [self.ours, "--threads", threads, "--repeat", TIMES, "--seconds", seconds, *options, "--json"]

    def theirs(self, name, threads, operation):
        if name in RUST:
            return self.pinned(threads, self.rust, name, operation, SECONDS)
        return self.pinned(threads, self.python, harness.HERE / "space" / "engines.py", name, operation, SECONDS)

    def measured(self, workload):
        """For each operation, for one thread and for two: what each library took and gave."""
        directory = self.workloads / workload
        if workload not in OURS_ONLY and not directory.exists():
            harness.call(self.ours, "--json", workload, "--write", self.workloads)
        names = [] if workload in OURS_ONLY else [*self.packages, *RUST]
        boolean = "difference" if workload == "holes" else "union"
        row = {}
        for threads in range(1, min(os.cpu_count(), 2) + 1):
            rivals = {name: self.theirs(name, threads, boolean) for name in names}
            engines = {"lar": self.lar(threads, *OPERATIONS["boolean"]), **rivals}
            row[f"boolean {threads}"] = self.run(engines, workload, "boolean", threads)
            rivals = {name: self.theirs(name, threads, "cells") for name in names if name == "trueform"}
            engines = {"lar": self.lar(threads, *OPERATIONS["cells"]), **rivals}
            row[f"cells {threads}"] = self.run(engines, workload, "cells", threads)
        return row

    def compared(self, workload, row):
        """For each operation, where two threads are to be worth while: one thread, two, and two copies."""
        if os.cpu_count() == 1 or row["cells 1"]["lar"]["facets"] <= report.LARGE:
            return {}
        return {what: self.threads(workload, row, what) for what in OPERATIONS}

    def threads(self, workload, row, what):
        """An operation with one thread, two, and two copies of one, by turns. A turn has room for three repetitions, of which
        the first does not count, except of what is long."""
        wall, options = row[f"{what} 1"]["lar"]["wall"], OPERATIONS[what]
        seconds = max(IN_A_TURN, 3 * wall) if wall < SECONDS else SECONDS
        turns = min(MOST_TURNS, max(TURNS[False], int(ALL_TURNS / (3 * max(seconds, wall)))))
        one, two = (self.operation(threads, *options, seconds=seconds) for threads in (1, 2))
        copies = [sys.executable, harness.HERE / "copies.py", 2, *one]
        commands = {"lar": self.pinned(1, *one), "two threads": self.pinned(2, *two), "two copies": copies}
        return harness.turns({name: [*command, workload] for name, command in commands.items()}, turns)

    def by_turns(self, rows, workloads):
        """Workloads by turns, each in memory that its process has touched before: what is compared has met the same minutes."""
        commands = {}
        is_short = all(rows[workload]["cells 1"]["lar"]["wall"] < SECONDS for workload in workloads)
        for workload in workloads:
            is_long = rows[workload]["cells 1"]["lar"]["repeat"] == 1
            times = ["--repeat", 2, "--seconds", math.inf] if is_long else []
            commands[workload] = [*self.lar(1), workload, *times]
        return harness.turns(commands, TURNS[is_short], 3 * harness.LIMIT)

    def run(self, engines, workload, operation, threads):
        family = self.too_large.setdefault((workload.split("-")[0], operation, threads), {})
        return harness.by_turns(engines, Path(workload), family, REPETITIONS[threads])


def check(workload, row):
    """Stops when we contradict ourselves; marks the others' results that are not the same as ours."""
    for what, results in row.items():
        assert isinstance(results["lar"], dict), f"{workload}: {what}: {results['lar']}"
    one, cells = row["boolean 1"]["lar"], row["cells 1"]["lar"]
    for ours, what in [(one, "boolean 2"), (cells, "cells 2")]:
        assert what not in row or row[what]["lar"]["counts"] == ours["counts"], f"{workload}: threads change the counts"
    if workload != "holes":
        # Operands may enclose pockets, which are cells of the arrangement but no part of the union.
        most = cells["volume"] * (1 + 1e-9)
        assert one["volume"] <= most, f"{workload}: the union is larger than all cells together"
    for what, results in row.items():
        ours = results["lar"]
        for name, result in results.items():
            if name == "lar" or isinstance(result, str):
                continue
            # meshlib computes in 32 bits.
            same = [math.isclose(ours[k], result[k], rel_tol=1e-6) for k in ("area", "volume")]
            if what.startswith("cells"):
                same = [ours["counts"][3] == result["counts"][0], math.isclose(ours["volume"], result["volume"], rel_tol=1e-6)]
            result["agrees"] = all(same)
    rivals = [r for name, r in row["boolean 1"].items() if name != "lar" and isinstance(r, dict)]
    assert not rivals or any(r["agrees"] for r in rivals), f"{workload}: nobody else finds {one['area']}, {one['volume']}"


def check_turns(workload, row, turns):
    """Stops when threads or turns change what is counted; a slow machine may take too long for them."""
    for what, results in turns.items():
        counts = row[f"{what} 1"]["lar"]["counts"]
        for name, ours in results.items():
            same = isinstance(ours, dict) and ours["counts"] == counts
            assert same or ours == "time", f"{workload}: {what}, {name}: {ours}"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--only", nargs="+", choices=WORKLOADS, default=WORKLOADS, metavar="WORKLOAD")
    parser.add_argument("--without", nargs="+", choices=PACKAGES, default=[], metavar="LIBRARY")
    return parser.parse_args()


def main():
    options = arguments()
    directory = options.directory.resolve()
    directory.mkdir(parents=True, exist_ok=True)
    comparison = Comparison(directory, options.without)
    comparison.workloads.mkdir(exist_ok=True)
    os.chdir(comparison.workloads)
    results = directory / "space.json"
    rows = json.loads(results.read_text()) if results.exists() and options.only != WORKLOADS else {}
    for workload in options.only:
        row = comparison.measured(workload)
        check(workload, row)
        compared = comparison.compared(workload, row)
        check_turns(workload, row, compared)
        row["turns"] = compared
        # Turns of a run before stay until there are others.
        turns = {what: result for what, result in rows.get(workload, {}).items() if what == "by turns"}
        rows[workload] = row | turns
        results.write_text(json.dumps(rows, indent=1))
    rows = {workload: rows[workload] for workload in WORKLOADS if workload in rows}
    for workloads in [*report.families(rows), report.grids(rows)]:
        if set(workloads) & set(options.only):
            for workload, result in comparison.by_turns(rows, workloads).items():
                rows[workload]["by turns"] = {"lar": result}
            results.write_text(json.dumps(rows, indent=1))
    harness.write_section("space", report.section(rows))
    picture = harness.DOCUMENT.with_name("benchmarks-space.svg")
    harness.call(comparison.python, harness.HERE / "space" / "picture.py", results, picture)


if __name__ == "__main__":
    main()

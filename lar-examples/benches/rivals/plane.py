#!/usr/bin/env python3
"""Planar arrangements compared with other libraries: `plane.py DIRECTORY [WORKLOAD ...]`.

Fetches and builds the others in DIRECTORY (which is made; about 1 GB), writes the workloads of
lar-arrangement/benches/planar there, runs all libraries on them (or on those that are named; the other rows are then those
of the last run in DIRECTORY) by turns, checks that they count the same cells, and writes the section on the plane of
docs/benchmarks.md. Needs Linux with cargo, g++, Debian's apt-get, and Python with venv.
"""

import json
import math
import sys
from pathlib import Path

sys.dont_write_bytecode = True
import harness  # noqa: E402, as its byte code must not land beside it

OURS = "lar"
EXACT = "CGAL"
# Those that give faces: the same as we do, but for the operators and provenance.
COMPLETE = [EXACT, "i_overlay faces", "spade", "GEOS"]
COLUMNS = [OURS, EXACT, "i_overlay pieces", "i_overlay faces", "spade", "GEOS"]
# Inputs on which the grid decides what touches: the arrangement of the input as given has other counts.
NEAR = {"near-grid", "near-touching"}


def engines(directory):
    plane = harness.cargo(directory, "plane")
    usr = harness.debian(directory, "libcgal-dev", "libboost1.74-dev", "libgmp-dev", "libgmp10", "libmpfr-dev",
                         "libmpfr6")
    cgal = harness.compile_cpp(harness.HERE / "plane" / "cgal.cpp", directory / "cgal", usr, "gmp", "mpfr")
    python = harness.python(directory, "shapely==2.2.0", "numpy")
    return plane, {
        OURS: [plane, "lar"],
        "lar, 2 threads": [plane, "lar-2"],
        EXACT: [cgal],
        "i_overlay pieces": [plane, "i_overlay-pieces"],
        "i_overlay faces": [plane, "i_overlay-faces"],
        "spade": [plane, "spade"],
        "GEOS": [python, harness.HERE / "plane" / "geos.py"],
    }


def agrees(counts, reference):
    """Whether counts are those of the reference as far as both tell."""
    return all(a is None or b is None or a == b for a, b in zip(counts, reference))


def check(name, results):
    """The exact counts, after making sure that ours are."""
    ours = results[OURS]["counts"]
    v, e, f, c = ours
    assert v - e + f == 1 + c, f"{name}: V − E + F = {v - e + f}, but there are {c} components"
    assert results["lar, 2 threads"]["counts"] == ours, f"{name}: threads change the counts"
    if name in NEAR:
        return results[EXACT]["counts"] if isinstance(results[EXACT], dict) else ours
    confirmed = [k for k in COMPLETE if isinstance(results[k], dict) and agrees(results[k]["counts"], ours)]
    assert confirmed, f"{name}: nobody else finds {ours}"
    if isinstance(results[EXACT], dict):
        assert agrees(results[EXACT]["counts"], ours), f"{name}: {ours} instead of {results[EXACT]['counts']}"
    return ours


def fastest(results, exact):
    """The least CPU time of those that give the right faces."""
    times = {k: results[k]["cpu"] for k in COMPLETE
             if isinstance(results[k], dict) and agrees(results[k]["counts"], exact)}
    return min(times, key=times.get), min(times.values())


def cell(result, exact, is_ours):
    if isinstance(result, str):
        return result
    wrong = "" if is_ours or agrees(result["counts"], exact) else " ✗"
    once = "¹" if result["n"] == 1 else ""
    return f"{1000 * result['cpu']:.{1 if result['cpu'] < 0.1 else 0}f}{once}{wrong}"


def number(x):
    return f"{x:,}"


def times(rows):
    yield "| workload | V / E / F / components | " + " | ".join(COLUMNS) + " | CGAL ÷ lar | fastest ÷ lar |"
    yield "|---|---|" + "---:|" * (len(COLUMNS) + 2)
    for name, (results, exact) in rows.items():
        ours = results[OURS]
        counts = " / ".join(map(number, ours["counts"]))
        cells = " | ".join(cell(results[k], exact, k == OURS) for k in COLUMNS)
        cgal = f"{results[EXACT]['cpu'] / ours['cpu']:.1f}" if isinstance(results[EXACT], dict) else "–"
        who, best = fastest(results, exact)
        yield f"| {name} | {counts} | {cells} | {cgal} | {best / ours['cpu']:.1f} ({who}) |"


def costs(rows):
    yield "| workload | ns per vertex | wall ms, 1 thread | 2 threads | ratio | bytes per cell: lar | CGAL |"
    yield "|---|---:|---:|---:|---:|---:|---:|"
    for name, (results, _) in rows.items():
        one, two, cgal = results[OURS], results["lar, 2 threads"], results[EXACT]
        n_cells = sum(one["counts"][:3])
        theirs = f"{cgal['memory'] / sum(cgal['counts'][:3]):.0f}" if isinstance(cgal, dict) else "–"
        yield (f"| {name} | {1e9 * one['cpu'] / one['counts'][0]:.0f} | {1000 * one['wall']:.1f} "
               f"| {1000 * two['wall']:.1f} | {one['wall'] / two['wall']:.2f} | {one['memory'] / n_cells:.0f} "
               f"| {theirs} |")


def mean(ratios):
    ratios = list(ratios)
    return math.exp(sum(map(math.log, ratios)) / len(ratios))


def section(rows):
    to_cgal = [r[EXACT]["cpu"] / r[OURS]["cpu"] for r, _ in rows.values() if isinstance(r[EXACT], dict)]
    to_best = [fastest(r, exact)[1] / r[OURS]["cpu"] for r, exact in rows.values()]
    return f"""## The plane

Written by `lar-examples/benches/rivals/plane.py DIRECTORY`, which fetches the others, builds them, and runs all of them
by turns on the same files: {harness.machine()}.

CPU milliseconds of the operation alone, one thread, arrays in and data structure out, each run in a process of its own;
medians of {harness.REPETITIONS} runs (¹: over {harness.LONG:.0f} s, run once; *time*: over {harness.LIMIT} s; –: not
tried, as something smaller took too long; *fails*: stops with an error). ✗: counts differ from the exact ones. Faces include the exterior; dangling edges are kept.

{chr(10).join(times(rows))}

The least ratio to CGAL is {min(to_cgal):.1f}, the geometric mean {mean(to_cgal):.1f}; to the fastest library that gives
the right faces the least is {min(to_best):.1f}, the geometric mean {mean(to_best):.1f}.

*CGAL*: `Arrangement_2` with exact constructions (5.5.1). *i_overlay* 9.1.0 on 64-bit integers: only the pieces that
segments cut each other into, and the faces of a square sliced by them; neither gives both. *spade* 2.15.1: constrained
triangulation with splitting in floating point, triangles joined to faces. *GEOS* through shapely 2.2.0: union, then
polygonised. *lar* also gives ∂1, ∂2 and, for every input segment, its edges. In the two workloads called *near* lines
meet but for rounding; there lar is exact for the input on its grid, CGAL for the input as it stands, and ✗ compares
with CGAL.

{chr(10).join(costs(rows))}

Cells are vertices, edges and faces; memory is the peak of the process during the operation beyond what it had before,
which includes the program itself: every one has arranged three segments first. With two threads it has arranged some
65,000, so that both are started: they are kept for the next operation.
Wall times tell little when the machine has other work.
"""


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    directory = Path(sys.argv[1]).resolve()
    directory.mkdir(parents=True, exist_ok=True)
    plane, commands = engines(directory)
    workloads = directory / "plane"
    workloads.mkdir(exist_ok=True)
    names = harness.subprocess.check_output([plane, "write", workloads], text=True).split()
    wanted, last = sys.argv[2:] or names, directory / "plane.json"
    rows = json.loads(last.read_text()) if last.exists() and wanted != names else {}
    too_large = {}
    for name in [name for name in names if name in wanted]:
        results = harness.by_turns(commands, workloads / f"{name}.seg", too_large)
        rows[name] = results, check(name, results)
        last.write_text(json.dumps(rows, indent=1))
    harness.write_section("plane", section({name: rows[name] for name in names if name in rows}))


if __name__ == "__main__":
    main()

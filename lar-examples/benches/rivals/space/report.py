"""The section on space of docs/benchmarks.md."""

import math
import statistics

import harness

RIVALS = ["trueform", "manifold3d", "meshlib", "manifold-rust", "boolmesh"]
# Families whose members differ in size only.
GROWTH = {"spheres": ["5k", "20k", "80k", "320k", "1M"], "scattered": ["10k", "100k", "1M"]}
# Two threads are to be worth while for more triangles than this.
LARGE = 100_000
# General position, and the same number of operands in common planes.
GENERAL, ALIGNED, TURNED = "cubes-100", ["shifted-128", "coplanar-128"], ["turned-128"]


def times(result):
    return isinstance(result, dict)


def is_right(result):
    return times(result) and result["agrees"]


def milliseconds(result, key="cpu"):
    if not times(result):
        return result or "–"
    value = 1000 * result[key]
    digits = 2 if value < 1 else 1 if value < 100 else 0
    return f"{value:.{digits}f}" + ("¹" if result["n"] == 1 else "") + ("" if result.get("agrees", True) else " ✗")


def ratio(theirs, ours, key="cpu"):
    return f"{ours[key] / theirs[key]:.2f}" if times(theirs) else "–"


def fastest(results, key="cpu", names=RIVALS):
    """Of those that give the same solid."""
    right = [name for name in names if is_right(results.get(name))]
    return min(right, key=lambda name: results[name][key], default=None)


def table(head, rows):
    yield "| " + " | ".join(head) + " |"
    yield "|---|" + "---:|" * (len(head) - 1)
    for row in rows:
        yield "| " + " | ".join(map(str, row)) + " |"


def with_rivals(rows):
    return {w: row for w, row in rows.items() if len(row["boolean 1"]) > 1}


def booleans(rows, threads, key):
    yield from table(
        ["workload", "triangles in", "lar", *RIVALS, "lar ÷ fastest"],
        (
            [name, f"{ours['facets']:,}", milliseconds(ours, key), *(milliseconds(results.get(r), key) for r in RIVALS),
             f"{ours[key] / results[best][key]:.2f} ({best})" if best else "–"]
            for name, results in ((w, row[f"boolean {threads}"]) for w, row in with_rivals(rows).items())
            for ours, best in [(results["lar"], fastest(results, key))]
        ),
    )  # fmt: skip


def cells(rows):
    yield from table(
        ["workload", "V / E / F / C", "lar", "trueform", "its C", "lar ÷ trueform"],
        (
            [name, " / ".join(f"{n:,}" for n in ours["counts"]), milliseconds(ours), milliseconds(theirs),
             f"{theirs['counts'][0]:,}" if times(theirs) else "–", ratio(theirs, ours)]
            for name, results in ((w, row["cells 1"]) for w, row in rows.items())
            for ours, theirs in [(results["lar"], results.get("trueform"))]
        ),
    )  # fmt: skip


def turns(row, operation):
    """One thread, two, and two copies of one, where these were compared by turns."""
    compared = row.get("turns", {}).get(operation, {})
    return compared if compared and all(times(result) for result in compared.values()) else None


def of_turns(compared, above, below):
    """The median, over all turns, of one wall time over another."""
    return statistics.median(a / b for a, b in zip(compared[above]["walls"], compared[below]["walls"], strict=True))


def halving(compared):
    """How many times as fast two threads are as one."""
    return of_turns(compared, "lar", "two threads")


def copied(compared):
    """How many times as much two processes get done at once as one does alone."""
    return 2 * of_turns(compared, "lar", "two copies")


def halving_beside(compared):
    """How many times as fast two threads are as one that has a copy of itself beside it."""
    return of_turns(compared, "two copies", "two threads")


def halved(row, operation):
    """With one thread and with two; by turns, where these were measured."""
    one, two = row[f"{operation} 1"]["lar"], row[f"{operation} 2"]["lar"]
    compared = turns(row, operation)
    if not compared:
        return milliseconds(one, "wall"), milliseconds(two, "wall"), f"{one['wall'] / two['wall']:.2f}", "–", "–", "–"
    one, two = compared["lar"], compared["two threads"]
    ratios = [f"{ratio(compared):.2f}" for ratio in (halving, copied, halving_beside)]
    return milliseconds(one, "wall"), milliseconds(two, "wall"), ratios[0], one["n"], *ratios[1:]


def threads(rows, operation):
    yield from table(
        ["workload", "1 thread", "2 threads", "ratio", "turns", "two copies", "beside a copy", "fastest other, 2 threads",
         "lar ÷ fastest"],
        (
            [name, *halved(row, operation), f"{milliseconds(results[best], 'wall')} ({best})" if best else "–",
             f"{results['lar']['wall'] / results[best]['wall']:.2f}" if best else "–"]
            for name, row in rows.items() if f"{operation} 2" in row
            for results in [row[f"{operation} 2"]]
            for best in [fastest(results, "wall")]
        ),
    )  # fmt: skip


def families(rows):
    """Of each family what was measured, by sizes."""
    named = ([f"{family}-{size}" for size in sizes] for family, sizes in GROWTH.items())
    return [[w for w in workloads if w in rows] for workloads in named]


def grids(rows):
    """What was measured of operands in general position, and in common planes."""
    return [w for w in [GENERAL, *ALIGNED, *TURNED] if w in rows]


def by_turns(row):
    return row["by turns"]["lar"]


def grown(rows):
    yield from table(
        ["workload", "turns", "ns per each", "times the family's least"],
        (
            [w, by_turns(rows[w])["n"], f"{unit(by_turns(rows[w])):.0f}", f"{unit(by_turns(rows[w])) / least:.2f}"]
            for family in families(rows) if family and all("by turns" in rows[w] for w in family)
            for least in [min(unit(by_turns(rows[w])) for w in family)]
            for w in family
        ),
    )  # fmt: skip


def crowded(rows):
    workloads = [w for w in grids(rows) if "by turns" in rows[w]]
    yield from table(
        ["workload", "turns", "µs per cell", f"times that of {GENERAL}"],
        (
            [w, by_turns(rows[w])["n"], f"{1e6 * per_cell(by_turns(rows[w])):.1f}", f"{per_cell(by_turns(rows[w])) / general:.2f}"]
            for general in ([per_cell(by_turns(rows[GENERAL]))] if GENERAL in workloads else [])
            for w in workloads
        ),
    )  # fmt: skip


def per_cell(result):
    return result["cpu"] / result["counts"][3]


def size(result):
    """Triangles in, pairs of them that cross, cells out."""
    return result["facets"] + result["pairs_crossing"] + result["counts"][3]


def unit(result):
    return 1e9 * result["cpu"] / size(result)


def memory_share(result, n_cells):
    return result["memory"] / (1000 * result["facets"] + 500 * n_cells)


def costs(rows):
    yield from table(
        ["workload", "triangles", "crossing pairs", "cells", "ns per each of these", "MB", "bytes per triangle",
         "share of 1 kB a triangle + 500 B a solid cell", "exact fallbacks per pair tested"],
        (
            [name, f"{r['facets']:,}", f"{r['pairs_crossing']:,}", f"{r['counts'][3]:,}", f"{unit(r):.0f}",
             f"{r['memory'] / 1e6:.1f}", f"{r['memory'] / r['facets']:.0f}", f"{memory_share(r, r['counts'][3]):.2f}",
             f"{r['exact_fallbacks'] / max(r['pairs_tested'], 1):.2f}"]
            for name, r in ((w, row["cells 1"]["lar"]) for w, row in rows.items())
        ),
    )  # fmt: skip


def stages(rows):
    names = list(dict.fromkeys(name for row in rows.values() for name, _ in row["cells 1"]["lar"]["stages"]))
    yield from table(
        ["workload", *names],
        ([w, *(f"{100 * dict(r['stages']).get(name, 0) / sum(t for _, t in r['stages']):.0f}" for name in names)]
         for w, r in ((w, row["cells 1"]["lar"]) for w, row in rows.items())),
    )  # fmt: skip


def targets(rows):
    """What was to be reached, the worst that was measured, and on which workload."""
    def worst(values):
        values = list(values)
        return max(values) if values else None

    def per_rival(workloads, what, names, key="cpu"):
        for w in workloads:
            results = rows.get(w, {}).get(what, {})
            best = fastest(results, key, names)
            if best:
                yield results["lar"][key] / results[best][key], f"{w}, {best}"

    def growth():
        for family in families(rows):
            units = {w: unit(by_turns(rows[w])) for w in family if "by turns" in rows[w]}
            if len(units) > 1:
                yield max(units.values()) / min(units.values()), f"{max(units, key=units.get)}, {min(units, key=units.get)}"

    def memory(n_cells):
        for w, row in rows.items():
            result = row["cells 1"]["lar"]
            if result["facets"] >= 10_000:
                yield memory_share(result, n_cells(result["counts"])), w

    def degenerate(workloads):
        measured = [w for w in grids(rows) if "by turns" in rows[w]]
        for w in workloads if GENERAL in measured else []:
            if w in measured:
                yield per_cell(by_turns(rows[w])) / per_cell(by_turns(rows[GENERAL])), w

    def halves(operation, ratio):
        for w, compared in ((w, turns(row, operation)) for w, row in rows.items()):
            if compared:
                yield 1 / ratio(compared), f"{w}: {ratio(compared):.2f} times as fast, two copies {copied(compared):.2f}"

    three = RIVALS[:3]
    spheres = [f"spheres-{s}" for s in GROWTH["spheres"][1:]]
    trueform = [(rows[w]["cells 1"]["lar"]["cpu"] / rows[w]["cells 1"]["trueform"]["cpu"], w)
                for w in rows if times(rows[w]["cells 1"].get("trueform"))]
    asked = [
        ("all cells ÷ trueform's cells, every workload", 0.5, worst(trueform)),
        ("union ÷ fastest of manifold3d, trueform, meshlib: spheres", 0.8, worst(per_rival(spheres, "boolean 1", three))),
        ("the same: 100 and 300 cubes", 1.0, worst(per_rival(["cubes-100", "cubes-300"], "boolean 1", three))),
        ("union of 300 cubes ÷ manifold3d", 1.0, worst(per_rival(["cubes-300"], "boolean 1", ["manifold3d"]))),
        ("time per triangle, crossing pair and cell: most ÷ least of a family", 1.5, worst(growth())),
        ("memory ÷ (1 kB a triangle + 500 B a solid cell), from 10,000 triangles", 1.0, worst(memory(lambda n: n[3]))),
        ("the same for cells of all dimensions: vertices, edges, faces, solids", 1.0, worst(memory(sum))),
        ("all cells on two threads ÷ on one, above 100,000 triangles", 1 / 1.7, worst(halves("cells", halving))),
        ("the same with a copy beside the one thread: both processors at work", 1 / 1.7, worst(halves("cells", halving_beside))),
        ("a union on two threads ÷ on one, above 100,000 triangles", 1 / 1.7, worst(halves("boolean", halving))),
        ("the same with a copy beside the one thread", 1 / 1.7, worst(halves("boolean", halving_beside))),
        ("time per cell of aligned grids in common planes ÷ of 100 random cubes", 2.0, worst(degenerate(ALIGNED))),
        ("the same for grids that were turned, beyond what was asked", 2.0, worst(degenerate(TURNED))),
    ]  # fmt: skip
    yield from table(
        ["target", "at most", "worst measured", "where", "met"],
        ([text, f"{limit:.2f}", f"{found[0]:.2f}", found[1], "yes" if found[0] <= limit else "**no**"]
         for text, limit, found in asked if found),
    )  # fmt: skip


def text(lines):
    return "\n".join(lines)


def section(rows):
    return f"""## Space

Written by `lar-examples/benches/rivals/space.py DIRECTORY`, which fetches the others, builds them, and runs all of them
by turns on the same arrays: {harness.machine()}.

Milliseconds of the operation alone, arrays in and arrays out, each run in a process of its own that may use one
processor, or two; medians of 5 runs on one, of 3 on two, and within a run of as many repetitions as are begun in 2 s,
at most 25, without the first: what takes less than 2 s is measured in memory that the process has touched before. *lar*
has arranged three cubes first, which starts its threads
(¹: over {harness.LONG:.0f} s, run once; *time*: given up; *fails*: stops with an error; –: not tried). ✗: area, volume
or number of cells differ from ours. *lar* is given triangles as the others are, and
keeps freed memory as the command `lar` does (mimalloc; with the system's allocator it takes up to a quarter longer).

![Time against the number of triangles, spheres and cubes](benchmarks-space.svg)

### One Boolean

The union of all operands (*holes*: the first without the others), CPU time on one thread. *lar* gives the simplified
surface as a chain complex.

{text(booleans(rows, 1, "cpu"))}

### All cells

CPU time on one thread. *lar* gives ∂1, ∂2, ∂3, provenance and membership; *trueform* a mesh for every cell, without
operators. C counts the exterior.

{text(cells(rows))}

The blocks of *turned* are turned by 30°, and rounding puts what was one plane into several; *lar* makes them one again
as far as rounding explains (decision 0008). In *turned-128* and *turned-2* it then finds as many cells as the symmetry of
the scene allows: a multiple of 16, and the exterior. Without that there are slivers between the planes, each of them a
cell.

### Two threads

Wall time. *Two copies*: how many times as much two processes of one thread each get done at once as one of them alone. More than
that no two threads can get out of the machine: often its processors slow down, or share one, while both work. *Beside a copy*: how
many times as fast two threads are as one that has a copy of itself beside it, so that both have the processors at the same speed.
Where these are told, one thread, two, and the copies ran by turns, so many times; ratios are medians over the turns.

All cells:

{text(threads(rows, "cells"))}

One Boolean:

{text(threads(rows, "boolean"))}

### Growth, memory, exact arithmetic

All cells, one thread; memory is the peak of the process during the operation beyond what it had before.

{text(costs(rows))}

Members of a family by turns, each in memory that its process has touched before, so that only their sizes tell
them apart:

{text(grown(rows))}

Operands in general position and in common planes, likewise:

{text(crowded(rows))}

Share of the stages in the time, in per cent:

{text(stages(rows))}

### Targets

{text(targets(rows))}
"""

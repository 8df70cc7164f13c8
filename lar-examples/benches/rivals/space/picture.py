"""The picture of scaling, in logarithms of both: `picture.py RESULTS.json PICTURE.svg`."""

import json
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

# The same bytes for the same numbers.
matplotlib.rcParams.update({"svg.hashsalt": "lar", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 11})
COLORS = {"lar": "#c8372d", "trueform": "#2a6fb0", "manifold3d": "#3f8f4f", "meshlib": "#8a5fb5",
          "manifold-rust": "#b08a2a", "boolmesh": "#7a7a7a"}  # fmt: skip
PANELS = [
    ("Union of two spheres", "boolean 1", ["spheres-5k", "spheres-20k", "spheres-80k", "spheres-320k", "spheres-1M"]),
    ("Union of random cubes", "boolean 1", ["cubes-10", "cubes-30", "cubes-100", "cubes-300"]),
    ("All cells of random cubes", "cells 1", ["cubes-10", "cubes-30", "cubes-100", "cubes-300"]),
]


def curve(rows, what, workloads, name):
    for w in workloads:
        result = rows.get(w, {}).get(what, {}).get(name)
        if isinstance(result, dict):
            yield rows[w][what]["lar"]["facets"], 1000 * result["cpu"]


def draw(axes, rows, title, what, workloads):
    for name, color in COLORS.items():
        points = sorted(curve(rows, what, workloads, name))
        if points:
            is_ours = name == "lar"
            x, y = zip(*points)
            axes.loglog(x, y, marker="o", color=color, label=name, linewidth=2.5 if is_ours else 1.4,
                        markersize=6 if is_ours else 4, zorder=3 if is_ours else 2)  # fmt: skip
    axes.set_title(title)
    axes.set_xlabel("triangles in")
    # Whole decades only: the others overlap.
    axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes.grid(True, which="major", color="#dddddd")
    axes.spines[["top", "right"]].set_visible(False)


def main():
    results, picture = sys.argv[1:]
    with open(results) as file:
        rows = json.load(file)
    figure, panels = plt.subplots(1, len(PANELS), figsize=(12, 4.4), layout="constrained")
    for axes, panel in zip(panels, PANELS):
        draw(axes, rows, *panel)
    panels[0].set_ylabel("CPU milliseconds, one thread")
    handles, labels = panels[0].get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="outside lower center", ncols=len(labels), frameon=False)
    figure.savefig(picture, metadata={"Date": None, "Creator": None})


if __name__ == "__main__":
    main()

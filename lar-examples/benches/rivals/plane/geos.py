"""The arrangement of the segments of a file by GEOS (through shapely): lines noded by their union, then polygonised.
Prints what that took and what came out as JSON."""

import json
import sys
from pathlib import Path

import numpy
import shapely

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))
from measure import measure  # noqa: E402


def arrangement(segments):
    lines = shapely.union_all(shapely.multilinestrings(shapely.linestrings(segments)))
    return lines, shapely.polygonize(shapely.get_parts(lines))


segments = numpy.loadtxt(sys.argv[1]).reshape(-1, 2, 2)
# The program itself is in memory before anything is measured.
arrangement(numpy.array([[[0, 0], [1, 1]], [[0, 1], [1, 0]], [[0.5, 0], [0.6, 1]]]))
(lines, faces), cost = measure(lambda: arrangement(segments))

coordinates = shapely.get_coordinates(lines)
n_vertices = len(numpy.unique(coordinates, axis=0))
n_edges = len(coordinates) - shapely.get_num_geometries(lines)
n_faces = shapely.get_num_geometries(faces) + 1
counts = [int(n_vertices), int(n_edges), int(n_faces), None]
print(json.dumps({**cost, "counts": counts}))

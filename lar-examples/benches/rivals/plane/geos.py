"""The arrangement of the segments of a file by GEOS (through shapely): lines noded by their union, then polygonised.
Prints what that took and what came out as JSON."""

import json
import sys
import time

import numpy
import shapely


def kilobytes(field):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(field))


segments = numpy.loadtxt(sys.argv[1]).reshape(-1, 2, 2)
with open("/proc/self/clear_refs", "w") as refs:
    refs.write("5")
before = kilobytes("VmRSS:")
wall, cpu = time.perf_counter(), time.process_time()
lines = shapely.union_all(shapely.multilinestrings(shapely.linestrings(segments)))
faces = shapely.polygonize(shapely.get_parts(lines))
cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
memory = kilobytes("VmHWM:") - before

coordinates = shapely.get_coordinates(lines)
n_vertices = len(numpy.unique(coordinates, axis=0))
n_edges = len(coordinates) - shapely.get_num_geometries(lines)
n_faces = shapely.get_num_geometries(faces) + 1
counts = [int(n_vertices), int(n_edges), int(n_faces), None]
print(json.dumps({"cpu": cpu, "wall": wall, "memory": 1024 * memory, "counts": counts}))

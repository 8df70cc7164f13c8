"""Runs all Booleans of two meshes in one other program and prints what came out as JSON.

    python3 rival.py manifold3d|meshlib|trueform A.ply B.ply

A process of its own, so that a crash or a hang of the program ends nothing else.
"""

import json
import sys
import time

import numpy as np

import meshes

OPERATIONS = ["union", "intersection", "difference", "reverse"]


def manifold3d(a, b):
    import manifold3d as m

    def solid(points, triangles):
        mesh = m.Mesh64(vert_properties=points, tri_verts=triangles.astype(np.uint64))
        mesh.merge()
        out = m.Manifold(mesh)
        if out.status() != m.Error.NoError:
            raise ValueError(str(out.status()).split(".")[-1])
        return out

    def arrays(solid):
        mesh = solid.to_mesh64()
        return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, np.int64)

    yield
    a, b = solid(*a), solid(*b)
    yield arrays(a + b)
    yield arrays(a ^ b)
    yield arrays(a - b)
    yield arrays(b - a)


def meshlib(a, b):
    from meshlib import mrmeshnumpy, mrmeshpy

    def mesh(points, triangles):
        return mrmeshnumpy.meshFromFacesVerts(triangles.astype(np.int32), points.astype(np.float32))

    def arrays(a, b, operation):
        result = mrmeshpy.boolean(a, b, operation)
        if not result.valid():
            raise ValueError(result.errorString)
        out = result.mesh
        out.pack()
        return np.asarray(mrmeshnumpy.getNumpyVerts(out), float), mrmeshnumpy.getNumpyFaces(out.topology)

    kinds = mrmeshpy.BooleanOperation
    yield
    a, b = mesh(*a), mesh(*b)
    for operation in [kinds.Union, kinds.Intersection, kinds.DifferenceAB, kinds.DifferenceBA]:
        yield arrays(a, b, operation)


def trueform(a, b):
    import trueform as tf

    def mesh(points, triangles):
        return tf.Mesh(triangles.astype(np.int32), points)

    def arrays(operation, a, b):
        faces, points = operation(a, b)[0]
        return np.asarray(points, float), np.asarray(faces, np.int64).reshape(-1, 3)

    yield
    a, b = mesh(*a), mesh(*b)
    yield arrays(tf.boolean_union, a, b)
    yield arrays(tf.boolean_intersection, a, b)
    yield arrays(tf.boolean_difference, a, b)
    yield arrays(tf.boolean_difference, b, a)


def main():
    program, *paths = sys.argv[1:]
    a, b = (meshes.read_ply(path) for path in paths)
    report, seconds = {"volumes": {}, "open": {}}, 0.0
    try:
        results = {"manifold3d": manifold3d, "meshlib": meshlib, "trueform": trueform}[program](a, b)
        next(results)
        for name in OPERATIONS:
            begin = time.perf_counter()
            points, triangles = next(results)
            seconds += time.perf_counter() - begin
            report["volumes"][name] = meshes.volume(points, triangles)
            report["open"][name] = meshes.open_edges(meshes.weld(points, triangles)[1])
    except Exception as error:  # whatever the program throws is its answer
        report["refused"] = str(error).strip().splitlines()[0][:100] if str(error).strip() else repr(error)
    report["seconds"] = seconds
    print(json.dumps(report))


if __name__ == "__main__":
    main()

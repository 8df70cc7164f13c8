"""The solids of a directory by a library with a Python interface: `engines.py ENGINE union|difference|cells SECONDS
DIRECTORY`. Prints what that took and what came out as JSON."""

import json
import sys
from pathlib import Path

import numpy

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))
from measure import measure  # noqa: E402


def read(directory):
    """Points (n × 3) and triangles (m × 3) of each operand."""
    for points in sorted(directory.glob("*.points")):
        triangles = numpy.fromfile(points.with_suffix(".triangles"), "<u4")
        yield numpy.fromfile(points, "<f8").reshape(-1, 3), triangles.astype(numpy.int32).reshape(-1, 3)


def trueform(solids, operation):
    import trueform

    def graph(solids):
        meshes = [trueform.Mesh(triangles, points) for points, triangles in solids]
        # Operands that touch themselves are to be intersected with themselves.
        return trueform.CsgGraph(meshes, within=any(touches_itself(s) for s in solids))

    def boolean(solids):
        expression = trueform.op(0)
        for i in range(1, len(solids)):
            expression = expression | i if operation == "union" else expression - i
        return [graph(solids).mesh(expression)[::-1]]

    def cells(solids):
        return [cell[::-1] for cell in graph(solids).domains(exclude_outer_shell=False)[0]]

    return cells if operation == "cells" else boolean


def touches_itself(solid):
    points, _ = solid
    return len(numpy.unique(points, axis=0)) < len(points)


def manifold3d(solids, operation):
    from manifold3d import Error, Manifold, Mesh64, OpType

    kind = OpType.Add if operation == "union" else OpType.Subtract

    def boolean(solids):
        operands = [Manifold(Mesh64(points, triangles.astype(numpy.uint64))) for points, triangles in solids]
        result = Manifold.batch_boolean(operands, kind)
        assert result.status() == Error.NoError, result.status()
        mesh = result.to_mesh64()
        return [(mesh.vert_properties[:, :3], mesh.tri_verts)]

    return boolean


def meshlib(solids, operation):
    from meshlib import mrmeshnumpy, mrmeshpy

    def united(meshes):
        if len(meshes) == 1:
            return meshes[0]
        if len(meshes) == 2:
            return checked(mrmeshpy.boolean(*meshes, mrmeshpy.BooleanOperation.Union))
        return mrmeshpy.uniteManyMeshes(mrmeshpy.std_vector_Mesh_const_ptr(meshes))

    def checked(result):
        assert result.valid(), result.errorString
        return result.mesh

    def boolean(solids):
        meshes = [mrmeshnumpy.meshFromFacesVerts(triangles, points) for points, triangles in solids]
        if operation == "union":
            mesh = united(meshes)
        else:
            mesh = checked(mrmeshpy.boolean(meshes[0], united(meshes[1:]), mrmeshpy.BooleanOperation.DifferenceAB))
        mesh.pack()
        return [(mrmeshnumpy.getNumpyVerts(mesh), mrmeshnumpy.getNumpyFaces(mesh.topology))]

    return boolean


def measures(points, triangles):
    """Area and volume."""
    a, b, c = (points[triangles[:, k].astype(numpy.int64)] for k in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
    return float(area), float(numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6)


def main():
    engine, operation, seconds, directory = sys.argv[1:]
    solids = list(read(Path(directory)))
    # Libraries keep what they find out about an operand with it: each run is given its own.
    fresh = lambda: [[(points.copy(), triangles.copy()) for points, triangles in solids]]
    surfaces, cost = measure(globals()[engine](solids, operation), float(seconds), fresh)
    areas, volumes = zip(*(measures(*surface) for surface in surfaces))
    result = {"area": sum(areas), "volume": sum(v for v in volumes if v > 0)}
    triangles = sum(len(triangles) for _, triangles in surfaces)
    print(json.dumps({**cost, "counts": [len(surfaces)], "triangles": triangles, **result}))


if __name__ == "__main__":
    main()

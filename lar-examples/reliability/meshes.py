"""Triangle meshes as numpy arrays: reading, placing, writing, and what a result is judged by."""

import numpy as np
import trimesh


def read(path):
    """Points (n × 3) and triangles (m × 3) of an OBJ, OFF, PLY or STL file; equal points are one point."""
    mesh = trimesh.load(path, process=False, maintain_order=True, force="mesh", skip_materials=True)
    if len(mesh.faces) == 0:
        raise ValueError("no triangles")
    return weld(np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int64))


def weld(points, triangles):
    """Equal points unified (exactly, with -0 as 0), triangles with a repeated corner left out."""
    points, place = np.unique(points + 0.0, axis=0, return_inverse=True)
    triangles = place.reshape(-1)[triangles]
    a, b, c = triangles.T
    return points, triangles[(a != b) & (b != c) & (c != a)]


def turned(points):
    """The points turned about the middle of their box by an angle and about an axis of no symmetry, and moved a little."""
    axis, angle = np.array([0.36, 0.48, 0.8]), 0.7
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    low, high = points.min(0), points.max(0)
    middle = (low + high) / 2
    return (points - middle) @ turn.T + middle + (high - low) * [0.031, 0.017, 0.023]


def write_ply(path, points, triangles):
    """Binary PLY with 64-bit coordinates: nothing is rounded."""
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.empty(len(triangles), [("n", "u1"), ("corners", "<i4", 3)])
    rows["n"], rows["corners"] = 3, triangles
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(points.astype("<f8").tobytes())
        file.write(rows.tobytes())


def read_ply(path):
    """What the command writes: 64-bit coordinates and triangles, as `write_ply`."""
    mesh = trimesh.load(path, process=False, maintain_order=True, force="mesh")
    return np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int64)


def open_edges(triangles):
    """Number of edges that are not used as often in one direction as in the other."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    if len(edges) == 0:
        return 0
    _, place = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    balance = np.bincount(place.reshape(-1), np.where(edges[:, 0] < edges[:, 1], 1, -1))
    return int(np.count_nonzero(balance))


def volume(points, triangles):
    """Signed volume, with the middle of the box as origin."""
    if len(triangles) == 0:
        return 0.0
    middle = (points.min(0) + points.max(0)) / 2
    a, b, c = (points[triangles[:, k]] - middle for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)

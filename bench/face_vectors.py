#!/usr/bin/env python3
"""The table of docs/design/unstructured.md: how well vectors at the centres of triangles on
the sphere tell a flow, by five rules of interpolation. Needs numpy and scipy."""
import numpy as np
from scipy.spatial import ConvexHull, cKDTree

PLACES = 40000
random = np.random.default_rng(3)


def unit(points):
    return points / np.linalg.norm(points, axis=1)[:, None]


def icosahedron(divisions, moved):
    """Nodes and triangles; nodes are moved by that part of their mean distance."""
    golden = (1 + 5**0.5) / 2
    corners = [(0, a, b * golden) for a in (-1, 1) for b in (-1, 1)]
    nodes = unit(np.array([np.roll(c, k) for c in corners for k in range(3)], float))
    faces = ConvexHull(nodes).simplices
    for _ in range(divisions):
        edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
        edges, place = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
        middle = len(nodes) + place.reshape(3, -1)
        nodes = np.concatenate([nodes, unit(nodes[edges].sum(axis=1))])
        a, b, c = faces.T
        ab, bc, ca = middle
        faces = np.concatenate([np.c_[a, ab, ca], np.c_[b, bc, ab], np.c_[c, ca, bc], np.c_[ab, bc, ca]])
    if moved > 0:
        step = np.sqrt(4 * np.pi / len(nodes))
        nodes = unit(nodes + random.normal(size=nodes.shape) * moved * step)
        faces = ConvexHull(nodes).simplices
    return nodes, faces


def rotation(at):
    return np.cross([0.48, -0.36, 0.8], at)


def wave(at):
    """Rossby and Haurwitz' of number 4 (Williamson et al. 1992), scaled."""
    longitude, sine = np.arctan2(at[:, 1], at[:, 0]), at[:, 2]
    cosine = np.sqrt(1 - sine**2)
    u = cosine + cosine**3 * (4 * sine**2 - cosine**2) * np.cos(4 * longitude)
    v = -4 * cosine**3 * sine * np.sin(4 * longitude)
    east = np.c_[-np.sin(longitude), np.cos(longitude), 0 * sine]
    return u[:, None] * east + v[:, None] * np.cross(at, east)


def tangent(vectors, at):
    return vectors - (vectors * at).sum(axis=1)[:, None] * at


def locate(triangles, points, places):
    """The triangle at each place, and its corners' weights."""
    near = cKDTree(points[triangles].mean(axis=1)).query(places, 24)[1]
    found, least, weights = near[:, 0].copy(), np.full(len(places), -9.0), np.zeros((len(places), 3))
    for t in near.T:
        a, b, c = points[triangles[t]].transpose(1, 0, 2)
        w = np.c_[[(places * np.cross(p, q)).sum(axis=1) for p, q in ((b, c), (c, a), (a, b))]].T
        w /= (a * np.cross(b, c)).sum(axis=1)[:, None]
        better = w.min(axis=1) > least
        found[better], least[better], weights[better] = t[better], w.min(axis=1)[better], w[better]
    weights = np.clip(weights, 0, None)
    return found, weights / weights.sum(axis=1)[:, None]


def interpolated(triangles, points, vectors, places):
    found, weights = locate(triangles, points, places)
    return (weights[:, :, None] * vectors[triangles[found]]).sum(axis=1)


def at_nodes(rule, nodes, faces, centres, vectors):
    """Means of the faces round each node."""
    node, face = faces.T.ravel(), np.tile(np.arange(len(faces)), 3)
    east = np.cross(np.where(np.abs(nodes[:, 2:]) < 0.9, [[0, 0, 1.0]], [[1.0, 0, 0]]), nodes)
    east = unit(east)
    way = centres[face] - nodes[node]
    x, y = (way * east[node]).sum(axis=1), (way * np.cross(nodes, east)[node]).sum(axis=1)

    def total(values):
        return np.bincount(node, values, len(nodes))

    weight = np.ones(len(node))
    if rule == "inverse":
        weight = 1 / np.linalg.norm(way, axis=1)
    elif rule == "linear":  # Holmes and Connell 1989
        rx, ry, xx, xy, yy = (total(v) for v in (x, y, x * x, x * y, y * y))
        determinant = xx * yy - xy * xy
        lx, ly = (xy * ry - yy * rx) / determinant, (xy * rx - xx * ry) / determinant
        weight = np.clip(1 + lx[node] * x + ly[node] * y, 0, 2)
    sums = np.c_[[total(weight * vectors[face, k]) for k in range(3)]].T
    return tangent(sums / total(weight)[:, None], nodes)


def main():
    places = unit(random.normal(size=(PLACES, 3)))
    print("% of the flow's root mean square: error's root mean square, largest error")
    for moved in (0.0, 0.15):
        for divisions in (4, 5):
            nodes, faces = icosahedron(divisions, moved)
            centres = unit(nodes[faces].sum(axis=1))
            between = ConvexHull(centres).simplices
            number = len(nodes) + np.arange(len(faces))
            fans = np.concatenate([np.c_[number, faces[:, k], faces[:, (k + 1) % 3]] for k in range(3)])
            for flow in (rotation, wave):
                vectors, exact = flow(centres), flow(places)
                read = {"constant": vectors[locate(faces, nodes, places)[0]]}
                for rule in ("mean", "inverse", "linear"):
                    all_vectors = np.concatenate([at_nodes(rule, nodes, faces, centres, vectors), vectors])
                    read["nodes, " + rule] = interpolated(fans, np.concatenate([nodes, centres]), all_vectors, places)
                read["between centres"] = interpolated(between, centres, vectors, places)
                scale = np.sqrt((exact**2).sum(axis=1).mean())
                for rule, got in read.items():
                    error = np.linalg.norm(tangent(got, places) - exact, axis=1) / scale * 100
                    print(f"moved {moved}, {len(faces)} faces, {flow.__name__}, {rule}: "
                          f"{np.sqrt((error**2).mean()):.3f}, {error.max():.2f}", flush=True)


if __name__ == "__main__":
    main()

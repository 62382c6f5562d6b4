"""What lumping on a covering triangle does to a block's inertia."""
import math

import numpy as np


def moments(polygon):
    """Area, centroid and J/M about it, of a simple polygon given counter-clockwise."""
    p = np.asarray(polygon, dtype=float)
    q = np.roll(p, -1, axis=0)
    cross = p[:, 0] * q[:, 1] - q[:, 0] * p[:, 1]
    area = 0.5 * cross.sum()
    centre = ((p + q) * cross[:, None]).sum(axis=0) / (6.0 * area)
    p, q = p - centre, q - centre
    cross = p[:, 0] * q[:, 1] - q[:, 0] * p[:, 1]
    second = ((p * p + p * q + q * q) * cross[:, None]).sum() / (12.0 * area)
    return area, centre, second


def covering_radius(polygon, angles=7200):
    """Circumradius of the least equilateral triangle that is centred on the polygon's centroid and contains it.

    Every side of the triangle supports the polygon or lies outside it, so its inradius is the largest extent in
    three directions; the least over all orientations, to about 1e-7, by trying many and then refining.
    """
    p = np.asarray(polygon, dtype=float) - moments(polygon)[1]

    def inradius(turn):
        directions = turn[:, None] + np.arange(3) * 2.0 * math.pi / 3.0
        extents = np.cos(directions)[..., None] * p[:, 0] + np.sin(directions)[..., None] * p[:, 1]
        return extents.max(axis=(1, 2))

    turn = np.linspace(0.0, 2.0 * math.pi / 3.0, angles, endpoint=False)
    for _ in range(2):
        best = turn[np.argmin(inradius(turn))]
        spread = turn[1] - turn[0]
        turn = np.linspace(best - spread, best + spread, 2001)
    return 2.0 * float(inradius(turn).min())


def excess(polygon):
    """M R_c^2 over J."""
    return covering_radius(polygon) ** 2 / moments(polygon)[2]


def random_polygon(generator):
    """Convex hull of a few random points in a random rectangle, so that slender ones are among them."""
    stretch = generator.uniform(0.2, 1.0)
    pts = generator.uniform(-0.5, 0.5, size=(generator.integers(4, 12), 2)) * (1.0, stretch)
    pts = sorted(map(tuple, pts))

    def chain(sequence):
        out = []
        for r in sequence:
            while len(out) > 1 and _turn(out[-2], out[-1], r) <= 0.0:
                out.pop()
            out.append(r)
        return out[:-1]

    return chain(pts) + chain(pts[::-1])


def _turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])


def weights_of_inverse_mass(polygon, vertex, other=None):
    """M times w^T [mass]^-1 w' of an affine block for two points: 1 + r^T (S/M)^-1 r' with its second moments S.

    With one point it says by how much less than M a spring at that point has to move.
    """
    p = np.asarray(polygon, dtype=float)
    area, centre, _ = moments(polygon)
    p, q = p - centre, np.roll(p, -1, axis=0) - centre
    cross = p[:, 0] * q[:, 1] - q[:, 0] * p[:, 1]
    second = np.zeros((2, 2))
    for i in range(2):
        for j in range(2):
            terms = p[:, i] * p[:, j] + q[:, i] * q[:, j] + 0.5 * (p[:, i] * q[:, j] + q[:, i] * p[:, j])
            second[i, j] = (terms * cross).sum() / (12.0 * area)
    r = np.asarray(vertex, dtype=float) - centre
    s = r if other is None else np.asarray(other, dtype=float) - centre
    return 1.0 + float(r @ np.linalg.solve(second, s))

"""Times SciPy on the same sites: Laguerre tiles of the unit square from the lower convex hull of lifted sites.
   scipy_speed.py SITES box|torus AREAS"""
import resource
import sys
import time

import numpy
from scipy.spatial import ConvexHull


def with_images(x, weight, torus):
    """Sites and those images that can matter: displaced on the torus, reflected at the sides of the box, where the sides
    are walls of equal power then. As far out as twelve mean spacings and two largest disks."""
    margin = min(1.0, 12 / numpy.sqrt(len(x)) + 2 * numpy.sqrt(weight.max()))
    for axis in range(2):
        near_low, near_high = x[:, axis] < margin, x[:, axis] > 1 - margin
        low, high = x[near_low].copy(), x[near_high].copy()
        if torus:
            low[:, axis] += 1
            high[:, axis] -= 1
        else:
            low[:, axis] *= -1
            high[:, axis] = 2 - high[:, axis]
        x = numpy.concatenate([x, low, high])
        weight = numpy.concatenate([weight, weight[near_low], weight[near_high]])
    return x, weight


def tile_areas(x, weight, torus):
    count = len(x)
    x, weight = with_images(x, weight, torus)
    hull = ConvexHull(numpy.column_stack([x, (x**2).sum(axis=1) - weight]))
    lower = hull.equations[:, 2] < 0
    plane, corner, beside = hull.equations, hull.simplices, hull.neighbors
    # Where the plane of a triangle touches the paraboloid: z = 2 v.x + const.
    with numpy.errstate(divide="ignore", invalid="ignore"):
        vertex = -plane[:, :2] / (2 * plane[:, 2:3])
    a, b, c = (x[corner[:, k]] for k in range(3))
    turned = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0] < 0
    area = numpy.zeros(len(x))
    # The edge opposite corner k, from p to q counter-clockwise, is crossed by the wall of p from the triangle beside to this.
    for k in range(3):
        p, q = corner[:, (k + 1) % 3], corner[:, (k + 2) % 3]
        p = numpy.where(turned, q, p)
        other = beside[:, k]
        used = lower & lower[other]
        origin = x[p[used]]
        u, v = vertex[other[used]] - origin, vertex[used] - origin
        area += numpy.bincount(p[used], (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2, minlength=len(x))
    return area[:count]


sites, where, out = sys.argv[1:]
numbers = numpy.fromfile(sites).reshape(-1, 3)
start, calls = time.process_time(), 0
while calls == 0 or time.process_time() - start < 0.1:
    areas = tile_areas(numbers[:, :2], numbers[:, 2] ** 2, where == "torus")
    calls += 1
print(f"seconds {(time.process_time() - start) / calls:.6g}")
print(f"megabytes {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024e-6:.1f}")
areas.tofile(out)

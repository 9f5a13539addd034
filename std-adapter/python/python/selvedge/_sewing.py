"""Rows of vertices that loose edges of a mesh sew together."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import indices


def seam_rows(faces: ArrayLike, edges: ArrayLike) -> list[tuple[list[int], list[int]]]:
    """Finds the seams that loose edges draw, as in Blender and other programs: edges that belong to no face and join the two sides.

    ``faces`` has shape (n, 3) and ``edges`` (k, 2). Edges whose ends are neighbours on both sides belong to one seam. Returns the two rows
    of vertices of each seam, from the same end; a closed row ends with its first vertex. They are `first` and `second` of a seam::

        seams = [{"first": {"vertices": a}, "second": {"vertices": b}} for a, b in seam_rows(faces, edges)]
    """
    joined: set[tuple[int, int]] = set()
    for face in indices(faces, "faces", 3).tolist():
        joined.update(_sorted(face[k], face[k - 1]) for k in range(3))
    loose = [_sorted(*edge) for edge in indices(edges, "edges", 2).tolist()]
    loose = [edge for edge in dict.fromkeys(loose) if edge not in joined and edge[0] != edge[1]]
    of_vertex: dict[int, list[int]] = {}
    for number, edge in enumerate(loose):
        for vertex in edge:
            of_vertex.setdefault(vertex, []).append(number)
    neighbours: dict[int, list[int]] = {}
    for a, b in joined:
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)

    def following(edge: tuple[int, int]) -> Iterable[tuple[int, tuple[int, int]]]:
        """The edges beside this one, turned alike."""
        for a in neighbours.get(edge[0], ()):
            for number in of_vertex.get(a, ()):
                one, other = loose[number]
                b = other if one == a else one
                if _sorted(edge[1], b) in joined:
                    yield number, (a, b)

    rows, taken = [], np.zeros(len(loose), bool)
    for number, edge in enumerate(loose):
        if taken[number]:
            continue
        taken[number] = True
        row, is_closed = [edge], False
        # From the first edge to one end, then to the other.
        for _ in range(2):
            while True:
                beside = list(following(row[-1]))
                free = [(other, turned) for other, turned in beside if not taken[other]]
                if not free:
                    is_closed = len(row) > 2 and any(turned == row[0] for _, turned in beside)
                    break
                taken[free[0][0]] = True
                row.append(free[0][1])
            if is_closed:
                row.append(row[0])
                break
            row.reverse()
        rows.append(([a for a, _ in row], [b for _, b in row]))
    return rows


def _sorted(a: int, b: int) -> tuple[int, int]:
    return (a, b) if a < b else (b, a)

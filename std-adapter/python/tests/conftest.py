"""Meshes for several tests."""

import numpy as np
import pytest
from numpy.typing import NDArray

Frame = NDArray[np.float64]


@pytest.fixture
def falling() -> tuple[NDArray[np.uint32], Frame, Frame]:
    """A small triangle that falls flat onto a large one: faces, start and end of the step."""
    faces = np.array([[0, 1, 2], [3, 4, 5]], np.uint32)
    large = [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]]
    small = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.1], [0.0, 1.0, 1.2]]
    start = np.array(large + small)
    end = start.copy()
    end[3:, 2] -= 2.0
    return faces, start, end


def sheet(size: int) -> tuple[NDArray[np.uint32], Frame]:
    """A square sheet of ``size`` by ``size`` vertices in the unit square."""
    x, y = np.meshgrid(np.linspace(0.0, 1.0, size), np.linspace(0.0, 1.0, size), indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(size * size)], 1)
    corner = (np.arange(size - 1)[:, None] * size + np.arange(size - 1)).ravel()
    lower = np.stack([corner, corner + size, corner + 1], 1)
    upper = np.stack([corner + 1, corner + size, corner + size + 1], 1)
    return np.concatenate([lower, upper]).astype(np.uint32), vertices


def two_sheets(size: int) -> tuple[NDArray[np.uint32], Frame]:
    """Two sheets, one above the other by a tenth."""
    faces, vertices = sheet(size)
    above = vertices + np.array([0.003, 0.007, 0.1])
    return np.concatenate([faces, faces + len(vertices)]).astype(np.uint32), np.concatenate([vertices, above])

"""The steps that all materials stand on, their numbers and cubes."""

from __future__ import annotations

from models.modelling import Mesh, Vector, joined, number, rounded_box

GRID = (7, 4)  # columns, rows
STEP = (1.2, 0.96, 1.0)  # to the next column; up and back to the next row
LOWEST = 0.34


def grid_place(k: int) -> Vector:
    """Where the k-th material stands: from left to right, and from below to above."""
    column, row = k % GRID[0], k // GRID[0]
    return ((column - (GRID[0] - 1) / 2) * STEP[0], LOWEST + row * STEP[1], -row * STEP[2])


def grid_steps() -> Mesh:
    """The steps that materials stand on."""
    width = GRID[0] * STEP[0] + 0.5
    boxes = []
    for row in range(GRID[1]):
        y, z = LOWEST + row * STEP[1], -row * STEP[2]
        boxes.append(rounded_box((width, 3, STEP[2] + 0.4), 0.02, 3).moved(0, y - 1.5, z - 0.2 - 0.05))
    return joined(boxes)


def grid_labels() -> Mesh:
    """Their numbers, on the fronts of the steps."""
    labels = []
    for k in range(GRID[0] * GRID[1]):
        x, y, z = grid_place(k)
        labels.append(number(str(k + 1), 0.17).moved(x, y - 0.17, z + STEP[2] / 2 - 0.049))
    return joined(labels)


def grid_cube(k: int) -> Mesh:
    """The small cube in front of the k-th ball."""
    x, y, z = grid_place(k)
    return rounded_box((0.24, 0.24, 0.24), 0.028, 2).turned("y", 28).moved(x + 0.37, y + 0.12, z + 0.25)


def meshes() -> dict[str, Mesh]:
    """All of them, by the names of their files."""
    return {
        "grid-labels": grid_labels(),
        "grid-steps": grid_steps(),
        **{f"grid-cube-{k + 1}": grid_cube(k) for k in range(GRID[0] * GRID[1])},
    }

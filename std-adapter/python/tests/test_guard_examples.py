"""The examples that put the guard behind other simulators, without these: newton and MuJoCo are large, and compile for minutes."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import sheet

EXAMPLES = Path(__file__).parent.parent / "examples"
sys.path.insert(0, str(EXAMPLES))
import guarded  # noqa: E402


def falling_points(cells: int) -> guarded.Simulator:
    """A simulator of vertices that fall freely and know of no board."""
    faces, positions = sheet(cells + 1)
    state = [guarded.SIDE * (positions - [0.5, 0.5, 0.0]) + [0.013, 0.007, 0.02], np.zeros_like(positions)]
    time_step = 2e-3

    def step() -> None:
        state[1][:, 2] -= 9.81 * time_step
        state[0] = state[0] + time_step * state[1]

    def put(points, before, held) -> None:
        state[0] = points.copy()
        state[1][held] = (points[held] - before[held]) / time_step

    return guarded.Simulator("points", faces, step, lambda: state[0].copy(), put, time_step)


def test_a_simulator_that_knows_no_board_passes_through_it_and_not_if_guarded():
    without = guarded.run(falling_points(8), 60, False, 1e-4)
    assert without.states == 60 and without.crossed > 0 and without.crossings >= without.crossed
    made = falling_points(8)
    behind = guarded.run(made, 60, True, 1e-4)
    assert behind.states == 60 and behind.crossed == behind.crossings == 0
    assert max(behind.held) > 0 and behind.farthest > 0.0
    # It lies on the board and hangs down beside it.
    heights = made.positions()[:, 2]
    assert heights.min() < -0.02 and heights.max() > guarded.BOARD[2]


@pytest.mark.parametrize(("example", "simulator"), [("guard_newton", "newton"), ("guard_mujoco", "mujoco"), ("arm_mujoco", "mujoco")])
def test_an_example_without_its_simulator_says_what_to_install(example, simulator):
    program = f"import sys, runpy; sys.modules[{simulator!r}] = None; runpy.run_path('{example}.py', run_name='__main__')"
    done = subprocess.run([sys.executable, "-B", "-c", program], cwd=EXAMPLES, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout == ""
    assert "skipped" in done.stderr and f"pip install {simulator}==" in done.stderr

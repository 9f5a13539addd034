"""Runs a simulator with and without a guard, and compares: what `guard_newton.py` and `guard_mujoco.py` share.

The scene: a sheet falls on a thin board, wraps around its edges and hangs down. The board has sharp edges and corners, which pass between
the vertices of a cloth.
"""

import argparse
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from selvedge import Detector
from selvedge.guard import Guard

# In metres, seconds and kilograms.
SIDE, HEIGHT, DENSITY, STRETCH, FRICTION = 0.6, 0.03, 0.15, 400.0, 0.3
BOARD = np.array([0.15, 0.10, 0.002])
"""Half the sides of the board; its centre is the origin."""
BOX_FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)

Positions = NDArray[np.floating]


def board_vertices() -> NDArray[np.float64]:
    return np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * BOARD


@dataclass
class Simulator:
    """A simulator, ready to run."""

    name: str
    faces: NDArray[np.integer]
    step: Callable[[], None]
    """Makes one step."""
    positions: Callable[[], Positions]
    """Returns the present positions."""
    put: Callable[[Positions, Positions, NDArray[np.uint32]], None]
    """Puts the cloth to positions, given those before the step and the vertices that were held back, and slows these."""
    time_step: float
    board: Callable[[], NDArray[np.float64]] = board_vertices
    """Returns the present vertices of the board."""


@dataclass
class Tally:
    """What happened in a run."""

    states: int = 0
    crossed: int = 0
    crossings: int = 0
    held: list[int] = field(default_factory=list)
    farthest: float = 0.0
    simulator: float = 0.0
    guard: float = 0.0


def run(made: Simulator, steps: int, guarded: bool, separation: float) -> Tally:
    """Runs the simulator for some steps, and counts the crossings of all states exactly."""
    cloth = made.positions()
    board = made.board().astype(cloth.dtype)
    guard = Guard(made.faces, len(cloth), bodies=[(BOX_FACES, len(board))], separation=separation)
    oracle = Detector(np.concatenate([made.faces, BOX_FACES + len(cloth)]).astype(np.uint32), len(cloth) + len(board))
    tally = Tally()
    before = cloth
    for _ in range(steps):
        started = time.process_time()
        made.step()
        after, moved = made.positions(), made.board().astype(cloth.dtype)
        tally.simulator += time.process_time() - started
        if guarded:
            started = time.process_time()
            step = guard.hold(before, after, bodies_before=[board], bodies_after=[moved])
            tally.guard += time.process_time() - started
            if step.positions is None:
                sys.exit(f"the step is not free: {step.reason}")
            tally.held.append(len(step.held_back))
            tally.farthest = max(tally.farthest, step.distances.max(initial=0.0))
            if len(step.held_back):
                made.put(step.positions, before, step.held_back)
            # The simulator's own state is what counts.
            after = made.positions()
            if after.tobytes() != step.positions.tobytes():
                sys.exit("the simulator changed the guard's positions")
        tally.states += 1
        if not np.isfinite(after).all():
            print(f"{made.name}: positions are not finite after {tally.states} steps", file=sys.stderr)
            break
        # Edges of the board meet its own faces nowhere, so all intersections are of cloth.
        found = len(oracle.intersections(np.concatenate([after, moved])))
        tally.crossed += found > 0
        tally.crossings += found
        before, board = after, moved
    return tally


def compare(make: Callable[[argparse.Namespace], Simulator], description: str, *, can_heave: bool = False) -> None:
    """Runs a simulator without and with the guard, and prints a row for each. Ends with 1 if a guarded state has a crossing."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=20, help="of the sheet, along each side (default: %(default)s)")
    parser.add_argument("--seconds", type=float, default=0.5, help="simulated time (default: %(default)s)")
    parser.add_argument("--separation", type=float, default=1e-4, help="that held vertices keep, in m (default: %(default)s)")
    if can_heave:
        parser.add_argument("--heave", type=float, default=0.0, help="of the board, up and down, in m (default: %(default)s)")
    options = parser.parse_args()
    print("| simulator | states with crossings | crossings | held back a step, mean, most | farthest | simulator a step | guard a step |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    for guarded in (False, True):
        made = make(options)
        steps = round(options.seconds / made.time_step)
        tally = run(made, steps, guarded, options.separation)
        own = f"{1e3 * tally.simulator / tally.states:.2f} ms"
        row = [made.name + (", guarded" if guarded else ""), f"{tally.crossed} of {tally.states}", str(tally.crossings)]
        if guarded:
            vertices = f"{np.mean(tally.held):.1f}, {max(tally.held)}"
            row += [vertices, f"{1e3 * tally.farthest:.2f} mm", own, f"{1e3 * tally.guard / tally.states:.2f} ms"]
        else:
            row += ["", "", own, ""]
        print("| " + " | ".join(row) + " |", flush=True)
        if guarded and tally.crossings:
            sys.exit(1)

"""Certifies the cloth of newton's solver VBD by a guard, and counts crossings with and without it.

    pip install selvedge newton==1.8.0 warp-lang==1.19.0
    python guard_newton.py [--cells 20] [--seconds 0.5] [--separation 1e-4]

Newton runs on the processor, in float32, with contact of the cloth with itself. Without newton the example says so and does nothing.
"""

import argparse
import sys

import numpy as np
from guarded import BOARD, DENSITY, FRICTION, HEIGHT, SIDE, STRETCH, Positions, Simulator, compare
from numpy.typing import NDArray

try:
    import newton
    import warp
except ImportError as error:
    print(f"skipped: {error}; pip install newton==1.8.0 warp-lang==1.19.0", file=sys.stderr)
    sys.exit(0)


def make(options: argparse.Namespace) -> Simulator:
    warp.config.quiet = True
    warp.init()
    warp.set_device("cpu")
    time_step, n = 2e-3, options.cells
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, -9.81))
    builder.add_cloth_grid(
        pos=warp.vec3(-SIDE / 2 + 0.013, -SIDE / 2 + 0.007, HEIGHT),
        rot=warp.quat_identity(),
        vel=warp.vec3(0.0, 0.0, 0.0),
        dim_x=n,
        dim_y=n,
        cell_x=SIDE / n,
        cell_y=SIDE / n,
        mass=DENSITY * SIDE * SIDE / (n + 1) ** 2,
        tri_ke=STRETCH / 2,
        tri_ka=STRETCH / 2,
        tri_kd=2.0e-4,
        edge_ke=1.0e-4,
        edge_kd=1.0e-2,
        particle_radius=0.003,
    )
    board = newton.ModelBuilder.ShapeConfig(ke=1.0e4, kd=1.0e-1, mu=FRICTION)
    builder.add_shape_box(-1, xform=warp.transform_identity(), hx=BOARD[0], hy=BOARD[1], hz=BOARD[2], cfg=board)
    builder.color()
    model = builder.finalize(device="cpu")
    model.soft_contact_ke, model.soft_contact_kd, model.soft_contact_mu = 1.0e4, 1.0e-1, FRICTION
    solver = newton.solvers.SolverVBD(
        model,
        iterations=4,
        particle_enable_self_contact=True,
        particle_self_contact_margin=0.003,
        particle_self_contact_gap=0.002,
        particle_topological_contact_filter_threshold=2,
    )
    pipeline = newton.CollisionPipeline(model)
    contacts = pipeline.contacts()
    states, control, count = [model.state(), model.state()], model.control(), [0]

    def step() -> None:
        if count[0] % 10 == 0:
            solver.rebuild_bvh(states[0])
        states[0].clear_forces()
        pipeline.collide(states[0], contacts)
        solver.step(states[0], states[1], control, contacts, time_step)
        states.reverse()
        count[0] += 1

    def positions() -> Positions:
        return states[0].particle_q.numpy().copy()

    def put(points: Positions, before: Positions, held: NDArray[np.uint32]) -> None:
        velocities = states[0].particle_qd.numpy().copy()
        velocities[held] = (points[held] - before[held]) / time_step
        states[0].particle_q.assign(points)
        states[0].particle_qd.assign(velocities)

    faces = model.tri_indices.numpy().reshape(-1, 3)
    # The first step compiles kernels, which is not timed.
    step()
    return Simulator(f"newton {newton.__version__}, VBD", faces, step, positions, put, time_step)


if __name__ == "__main__":
    compare(make, __doc__)

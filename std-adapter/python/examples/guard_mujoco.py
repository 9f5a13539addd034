"""Certifies a flexible sheet of MuJoCo by a guard, and counts crossings with and without it.

    pip install selvedge mujoco==4.0.0
    python guard_mujoco.py [--cells 20] [--seconds 0.5] [--separation 1e-4] [--heave 0.05]

The sheet collides with the board and with itself, without MuJoCo's experimental ipc. With --heave the board swings up and down, three times
a second. Without MuJoCo the example says so and does nothing.
"""

import argparse
import sys

import numpy as np
from guarded import BOARD, DENSITY, FRICTION, HEIGHT, SIDE, Positions, Simulator, board_vertices, compare
from numpy.typing import NDArray

try:
    import mujoco
except ImportError as error:
    print(f"skipped: {error}; pip install mujoco==4.0.0", file=sys.stderr)
    sys.exit(0)


def make(options: argparse.Namespace) -> Simulator:
    time_step, n = 1e-3, options.cells
    spacing = SIDE / n
    # Young's modulus and a thickness that make a membrane with E·t = 400 N/m, and about as soft in bending as a fabric.
    text = f"""<mujoco>
  <option integrator="discrete" timestep="{time_step}" solver="Newton" tolerance="1e-6" iterations="100"/>
  <size memory="4G"/>
  <worldbody>
    <body name="board" mocap="true"><geom type="box" size="{" ".join(map(str, BOARD))}"/></body>
    <flexcomp name="sheet" type="grid" dim="2" count="{n + 1} {n + 1} 1" spacing="{spacing} {spacing} {spacing}" pos="0.013 0.007 {HEIGHT}"
              radius="0.001" mass="{DENSITY * SIDE * SIDE}">
      <contact selfcollide="auto" condim="3" friction="{FRICTION}"/>
      <elasticity young="6.09e5" poisson="0.2" thickness="0.000657" elastic2d="both"/>
    </flexcomp>
  </worldbody>
</mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    model.dof_damping[:] = 0.5 * model.body_mass[model.dof_bodyid]
    # Each vertex is a body with three slides. From the origin they are its position, so the guard's numbers are not rounded.
    bodies = model.flex_vertbodyid
    slides = model.jnt_qposadr[model.body_jntadr[bodies][:, None] + np.arange(3)]
    speeds = model.jnt_dofadr[model.body_jntadr[bodies][:, None] + np.arange(3)]
    data = mujoco.MjData(model)
    data.qpos[slides] = model.body_pos[bodies]
    model.body_pos[bodies] = 0.0
    mujoco.mj_forward(model, data)

    def step() -> None:
        data.mocap_pos[0, 2] = options.heave * np.sin(6.0 * np.pi * (data.time + time_step))
        mujoco.mj_step(model, data)

    def positions() -> Positions:
        mujoco.mj_kinematics(model, data)
        mujoco.mj_flex(model, data)
        return data.flexvert_xpos.copy()

    def put(points: Positions, before: Positions, held: NDArray[np.uint32]) -> None:
        data.qpos[slides] = points
        data.qvel[speeds[held]] = (points[held] - before[held]) / time_step

    faces = model.flex_elem.reshape(-1, 3).astype(np.uint32)
    name = f"MuJoCo {mujoco.__version__}, flex"
    return Simulator(name, faces, step, positions, put, time_step, lambda: board_vertices() + data.mocap_pos[0])


if __name__ == "__main__":
    compare(make, __doc__, can_heave=True)

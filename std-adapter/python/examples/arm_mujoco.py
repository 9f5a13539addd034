"""An arm in MuJoCo lifts a cloth by pins and feels its weight.

    pip install selvedge mujoco==4.0.0
    python arm_mujoco.py

MuJoCo simulates the arm with its motors, Selvedge the cloth and the table that it lies on. In each step the hand moves the pins, and the
load of the pins acts on the hand in the next step. Such an explicit exchange is stable for a hand that is heavier than half of what hangs
on it. At the end the motors bear the weight of the cloth besides their own arm, which the example checks. Without MuJoCo the example says
so and does nothing.
"""

import sys

import numpy as np

from selvedge import Simulation

try:
    import mujoco
except ImportError as error:
    print(f"skipped: {error}; pip install mujoco==4.0.0", file=sys.stderr)
    sys.exit(0)

TIME_STEP, SECONDS, GRAVITY = 2e-3, 3.0, 9.81
SIDE, DENSITY = 0.4, 0.3
WEIGHT = SIDE * SIDE * DENSITY * GRAVITY

# Gravity is compensated in the arm itself, so that its motors rest at zero without the cloth.
ARM = f"""<mujoco>
  <option timestep="{TIME_STEP}" gravity="0 0 -{GRAVITY}"/>
  <default><joint type="hinge" axis="0 -1 0" damping="0.4" armature="0.01"/><position kp="60" kv="4"/></default>
  <worldbody>
    <body name="upper" pos="-0.55 0 0.35" gravcomp="1">
      <joint name="shoulder"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="0.6"/>
      <body name="fore" pos="0.3 0 0" gravcomp="1">
        <joint name="elbow"/>
        <geom type="capsule" fromto="0 0 0 0.25 0 0" size="0.02" mass="0.4"/>
        <body name="hand" pos="0.25 0 0" gravcomp="1">
          <geom type="box" size="0.02 0.05 0.01" mass="0.2"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><position name="shoulder" joint="shoulder"/><position name="elbow" joint="elbow"/></actuator>
</mujoco>"""

# The cloth lies on a table and reaches from the hand away from the arm.
CELLS = 16
CLOTH = {
    "time_step": TIME_STEP,
    "cloth": {
        "shape": "sheet",
        "corner": [0.0, -SIDE / 2, 0.004],
        "sides": {"first": [SIDE, 0, 0], "second": [0, SIDE, 0]},
        "cells": [CELLS, CELLS],
        "density": DENSITY,
    },
    "body": {
        "name": "table",
        "positions": [[-0.3, -0.5, 0], [0.7, -0.5, 0], [-0.3, 0.5, 0], [0.7, 0.5, 0]],
        "faces": [[0, 1, 2], [1, 3, 2]],
    },
    "effects": {
        "gravity": {"acceleration": [0, 0, -GRAVITY]},
        "air_drag": {"rate": 2.0},
        "stretch": {"stiffness": 400},
        "shear": {"stiffness": 100},
        "bend": {"stiffness": 2e-5},
        "friction": {"coefficient": 0.4},
        "body_contact": {"thickness": 0.003},
        "self_collision": {"thickness": 0.003},
        "pins": {"group": [{"box": {"lower": [-0.01, -0.04, -1], "upper": [0.01, 0.04, 1]}, "driven": True}]},
    },
}


def angles(x: float, z: float) -> tuple[float, float]:
    """Returns the angles of shoulder and elbow that bring the hand to a place, seen from the shoulder; the elbow is up."""
    upper, fore = 0.3, 0.25
    elbow = np.arccos(np.clip((x * x + z * z - upper**2 - fore**2) / (2 * upper * fore), -1.0, 1.0))
    shoulder = np.arctan2(z, x) + np.arctan2(fore * np.sin(elbow), upper + fore * np.cos(elbow))
    return float(shoulder), float(-elbow)


def main() -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    data = mujoco.MjData(model)
    hand = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "hand")
    cloth = Simulation.from_dict(CLOTH)
    start = cloth.positions[: cloth.cloth_vertex_count].copy()
    pins = np.flatnonzero((abs(start[:, 0]) < 0.01) & (abs(start[:, 1]) < 0.04))
    # From the shoulder, the hand is at the cloth's edge at first and lifts it by half a metre.
    low, high = np.array([0.5, -0.346]), np.array([0.4, 0.2])
    data.qpos[:] = data.ctrl[:] = angles(*low)
    mujoco.mj_forward(model, data)
    local = (start[pins] - data.xpos[hand]) @ data.xmat[hand].reshape(3, 3)

    steps = round(SECONDS / TIME_STEP)
    for step in range(steps):
        # It lifts in the first half of the time, and then waits until the cloth hangs at rest.
        share = np.clip(step * TIME_STEP / 1.5, 0.0, 1.0)
        data.ctrl[:] = angles(*(low + (3 - 2 * share) * share * share * (high - low)))
        mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        cloth.move_pins(0, data.xpos[hand] + local @ data.xmat[hand].reshape(3, 3).T)
        cloth.step()
        load = cloth.pin_load(0, data.xipos[hand])
        data.xfrc_applied[hand] = np.concatenate([load.force, load.torque])
        if (step + 1) % (steps // 10) == 0:
            print(
                f"{(step + 1) * TIME_STEP:.1f} s: hand at {data.xpos[hand][2]:.3f} m feels {-load.force[2]:.4f} N of {WEIGHT:.4f} N, "
                f"motors {data.actuator_force[0]:+.4f} and {data.actuator_force[1]:+.4f} N m"
            )
    jacobian = np.zeros((3, model.nv))
    turning = np.zeros((3, model.nv))
    mujoco.mj_jacBodyCom(model, data, jacobian, turning, hand)
    # At rest the motors hold the load: their torques and those of the load at the joints cancel.
    error = np.abs(data.actuator_force + jacobian.T @ load.force + turning.T @ load.torque).max()
    lifted = cloth.positions[: cloth.cloth_vertex_count, 2].min()
    print(f"lowest point of the cloth: {lifted:.3f} m; motors against the load: {error:.2e} N m apart")
    is_right = abs(-load.force[2] - WEIGHT) < 0.01 * WEIGHT and error < 1e-3 and cloth.is_certified
    sys.exit(0 if is_right else 1)


if __name__ == "__main__":
    main()

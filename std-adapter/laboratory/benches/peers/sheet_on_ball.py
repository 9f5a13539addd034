#!/usr/bin/env python3
"""Compares selvedge, MuJoCo, Rapier and newton on a sheet that falls on a ball: processor time, crossings, stretch. See README.md."""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

# One core for all. Libraries read these variables when they are loaded.
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

HERE = Path(__file__).parent
try:
    import meshio
    import numpy as np
except ImportError as error:
    venv = Path(tempfile.gettempdir()) / "selvedge-simulators"
    print(
        f"{error}; install the packages and run again with their Python:\n"
        f"  python3 -m venv {venv} && {venv}/bin/pip install -r {HERE / 'requirements-simulators.txt'}",
        file=sys.stderr,
    )
    sys.exit(1)

# The values of scenes/drop.toml: sizes in m, masses per area in kg/m², stiffnesses in N/m.
SIDE, HEIGHT = 0.8, 0.35
BALL, RADIUS = np.array([0.03, 0.02, 0.0]), 0.2
DENSITY, DRAG, FRICTION = 0.15, 0.5, 0.3
STRETCH = 400.0
# Seconds between states.
INTERVAL = 0.05


@dataclass
class Run:
    """The result of a simulator: states every INTERVAL from the start until its time was used up."""

    what: str
    time_step: float
    steps: int
    seconds: float
    states: list[np.ndarray]
    triangles: np.ndarray


def processor_seconds(who: int = resource.RUSAGE_SELF) -> float:
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def in_states(step: Callable[[], None], points: Callable[[], np.ndarray], time_step: float, options) -> tuple[int, float, list]:
    """Runs steps and times them alone, until the simulated time or the processor time is used up."""
    steps, every = round(options.seconds / time_step), round(INTERVAL / time_step)
    done, taken, states = 0, 0.0, [points()]
    while done < steps and taken < options.most:
        begin = processor_seconds()
        for _ in range(every):
            step()
            done += 1
        taken += processor_seconds() - begin
        states.append(points())
        if not np.isfinite(states[-1]).all():
            break
    return done, taken, states


# Changes that make the scene of selvedge that of MuJoCo with `ipc`: no friction, the shear stiffness of a membrane of E·t = 400
# N/m and a Poisson number of 0.2 (E·t/(2·1.2)), and a shorter step and a smaller limit for less stretch.
AS_MUJOCO = [
    ("\n[effects.friction]\ncoefficient = 0.3\n", ""),
    ('stiffness = "80 N/m"', 'stiffness = "167 N/m"'),
    ('time_step = "1 ms"', 'time_step = "0.625 ms"'),
    ("limit = 1.08", "limit = 1.01"),
]


def selvedge(options: argparse.Namespace, folder: Path, name: str, own: list[tuple[str, str]]) -> Run:
    """Runs the program's scene with changes. The time is that of the whole command, including set-up, report and files."""
    scene = (HERE / "../../../cloth/scenes/drop.toml").read_text()
    changes = [
        *own,
        ("cells = [32, 32]", f"cells = [{options.cells}, {options.cells}]"),
        ("frames_per_second = 40", f"frames_per_second = {1 / INTERVAL:g}"),
        ('duration = "1.5 s"', f'duration = "{options.seconds} s"'),
    ]
    for old, new in changes:
        assert scene.count(old) == 1, "this script knows drop.toml as it came with the program"
        scene = scene.replace(old, new)
    (folder / "drop.toml").write_text(scene)
    command = [options.selvedge.absolute(), "simulate", "drop.toml", "--json", "--frames", "ply", "--output", "out"]
    begin = processor_seconds(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, check=True)
    taken = processor_seconds(resource.RUSAGE_CHILDREN) - begin
    report = json.loads(done.stdout)
    meshes = [meshio.read(path) for path in sorted((folder / "out").glob("drop-*.ply"))]
    vertices = (options.cells + 1) ** 2
    triangles = meshes[0].cells_dict["triangle"].astype(np.int64)
    triangles = triangles[(triangles < vertices).all(axis=1)]
    states = [mesh.points[:vertices].astype(np.float64) for mesh in meshes]
    return Run(name, options.seconds / report["steps"], report["steps"], taken, states, triangles)


def mujoco(options: argparse.Namespace, _: Path, ipc: bool) -> Run:
    """Runs MuJoCo with a flexible sheet of triangles; `ipc`: with incremental potential contact, which has no friction yet."""
    import mujoco as engine

    time_step, n = 1e-3, options.cells
    spacing = SIDE / n
    contact = 'selfcollide="auto" condim="1"' if ipc else f'selfcollide="auto" condim="3" friction="{FRICTION}"'
    # Young's modulus and a thickness that make a membrane as stiff as the fabric, E·t = 400 N/m, and about as soft in bending.
    text = f"""<mujoco>
  <option integrator="discrete" timestep="{time_step}" solver="Newton" tolerance="1e-6" iterations="100">
    <flag ipc="{"enable" if ipc else "disable"}"/>
  </option>
  <size memory="4G"/>
  <worldbody>
    <geom name="ball" type="sphere" size="{RADIUS}" pos="{" ".join(map(str, BALL))}"/>
    <flexcomp name="sheet" type="grid" dim="2" count="{n + 1} {n + 1} 1" spacing="{spacing} {spacing} {spacing}" pos="0 0 {HEIGHT}"
              radius="0.001" mass="{DENSITY * SIDE * SIDE}">
      <contact {contact}/>
      <elasticity young="6.09e5" poisson="0.2" thickness="0.000657" elastic2d="both"/>
    </flexcomp>
  </worldbody>
</mujoco>"""
    model = engine.MjModel.from_xml_string(text)
    model.dof_damping[:] = DRAG * model.body_mass[model.dof_bodyid]
    data = engine.MjData(model)
    engine.mj_forward(model, data)

    def points() -> np.ndarray:
        engine.mj_kinematics(model, data)
        engine.mj_flex(model, data)
        return data.flexvert_xpos.copy()

    done, taken, states = in_states(lambda: engine.mj_step(model, data), points, time_step, options)
    name = f"MuJoCo {engine.__version__}, {'ipc, no friction' if ipc else 'without ipc'}"
    return Run(name, time_step, done, taken, states, model.flex_elem.reshape(-1, 3).astype(np.int64))


def rapier(options: argparse.Namespace, folder: Path, radius: float) -> Run:
    """Runs the program in `rapier/`, with particles of this radius, so that layers are twice as far apart."""
    time_step = 1 / 240
    arguments = [options.cells, radius, time_step, options.seconds, options.most, folder]
    done = subprocess.run([options.rapier.absolute(), *map(str, arguments)], stdout=subprocess.PIPE, check=True)
    steps, taken = done.stdout.split()
    triangles = np.fromfile(folder / "triangles.u32", "<u4").reshape(-1, 3).astype(np.int64)
    states = np.fromfile(folder / "states.f32", "<f4").astype(np.float64).reshape(-1, triangles.max() + 1, 3)
    return Run(f"Rapier 0.36.1, particles of {1e3 * radius:g} mm", time_step, int(steps), float(taken), list(states), triangles)


def newton(options: argparse.Namespace, _: Path) -> Run:
    """Runs newton's vertex block descent on the CPU, with the iterations of newton's own examples; it has no such drag."""
    import newton as engine
    import warp

    warp.config.quiet = True
    warp.init()
    warp.set_device("cpu")
    time_step, n = 1e-3, options.cells
    builder = engine.ModelBuilder(gravity=(0.0, 0.0, -9.81))
    builder.add_cloth_grid(
        pos=warp.vec3(-SIDE / 2, -SIDE / 2, HEIGHT),
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
    ball = engine.ModelBuilder.ShapeConfig(ke=1.0e4, kd=1.0e-1, mu=FRICTION)
    builder.add_shape_sphere(-1, xform=warp.transform(warp.vec3(*BALL), warp.quat_identity()), radius=RADIUS, cfg=ball)
    builder.color()
    model = builder.finalize(device="cpu")
    model.soft_contact_ke, model.soft_contact_kd, model.soft_contact_mu = 1.0e4, 1.0e-1, FRICTION
    solver = engine.solvers.SolverVBD(
        model,
        iterations=options.iterations,
        particle_enable_self_contact=True,
        particle_self_contact_margin=0.003,
        particle_self_contact_gap=0.002,
        particle_topological_contact_filter_threshold=2,
    )
    pipeline = engine.CollisionPipeline(model)
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

    def points() -> np.ndarray:
        return states[0].particle_q.numpy().astype(np.float64)

    # The first step compiles kernels, and is left out.
    step()
    done, taken, found = in_states(step, points, time_step, options)
    name = f"newton {engine.__version__}, CPU, {options.iterations} iterations"
    return Run(name, time_step, done, taken, found, model.tri_indices.numpy().reshape(-1, 3).astype(np.int64))


SIMULATORS: dict[str, Callable[[argparse.Namespace, Path], Run]] = {
    "selvedge": lambda options, folder: selvedge(options, folder, "selvedge", []),
    "selvedge-as-mujoco": lambda options, folder: selvedge(options, folder, "selvedge, no friction, less stretched", AS_MUJOCO),
    "mujoco-ipc": lambda options, folder: mujoco(options, folder, True),
    "mujoco": lambda options, folder: mujoco(options, folder, False),
    "rapier": lambda options, folder: rapier(options, folder, 0.0015),
    "rapier-thick": lambda options, folder: rapier(options, folder, 0.003),
    "newton": newton,
}


def crossings(run: Run, binary: Path, folder: Path) -> list[int]:
    """Returns how many edges pass through a face in each state, by `selvedge check`: exactly, for the given coordinates."""
    paths = [folder / f"state-{index:05}.ply" for index in range(len(run.states))]
    for path, points in zip(paths, run.states, strict=True):
        meshio.write(path, meshio.Mesh(points, [("triangle", run.triangles.astype(np.int32))]))
    done = subprocess.run([binary.absolute(), "check", "--json", *paths], stdout=subprocess.PIPE)
    if done.returncode not in (0, 3):
        sys.exit(f"selvedge check ended with status {done.returncode}")
    return [mesh["edge_face"] for mesh in json.loads(done.stdout)["meshes"]]


def edges_of(triangles: np.ndarray) -> np.ndarray:
    return np.unique(np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1), axis=0)


def table_row(run: Run, options: argparse.Namespace, folder: Path) -> list[str]:
    states = [state for state in run.states if np.isfinite(state).all()]
    crossed = crossings(Run(run.what, run.time_step, run.steps, run.seconds, states, run.triangles), options.selvedge, folder)
    edges = edges_of(run.triangles)
    lengths = [np.linalg.norm(state[edges[:, 0]] - state[edges[:, 1]], axis=1) for state in states]
    stretch = [np.quantile(length / lengths[0], [0.99, 1.0]) for length in lengths]
    most = np.max(stretch, axis=0)
    gap = min(np.linalg.norm(state - BALL, axis=1).min() for state in states) - RADIUS
    simulated = run.steps * run.time_step
    return [
        run.what,
        f"{len(run.triangles):,}",
        f"{1e3 * run.time_step:.3g} ms",
        f"{simulated:.2f} s" + ("" if len(states) == len(run.states) else ", then not finite"),
        f"{run.seconds / simulated:.2f} s",
        f"{sum(count > 0 for count in crossed)} of {len(crossed)} ({sum(crossed)})",
        f"{1e3 * gap:.1f} mm",
        f"{most[0]:.3f}, {most[1]:.3f}",
        f"{stretch[-1][0]:.3f}, {stretch[-1][1]:.3f}",
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--selvedge", type=Path, default=HERE / "../../../../target/release/selvedge", help="the binary")
    parser.add_argument("--rapier", type=Path, default=HERE / "rapier/target/release/selvedge-peer-rapier", help="its program")
    parser.add_argument("--cells", type=int, default=26, help="of the sheet, along each side (default: %(default)s)")
    parser.add_argument("--seconds", type=float, default=1.5, help="simulated time (default: %(default)s)")
    parser.add_argument("--most", type=float, default=120.0, help="processor seconds for each peer (default: %(default)s)")
    parser.add_argument("--iterations", type=int, default=4, help="of newton, each step (default: %(default)s)")
    parser.add_argument("--only", choices=SIMULATORS, action="append", help="this one; may be given several times")
    options = parser.parse_args()
    names = [
        "simulator", "triangles", "step", "simulated", "processor time a simulated second", "states with crossings (crossings)",
        "nearest to the ball", "99 % of the edges, longest: most", "at the end",
    ]  # fmt: skip
    print("| " + " | ".join(names) + " |\n|" + "---|" * len(names))
    for name in options.only or SIMULATORS:
        with tempfile.TemporaryDirectory() as folder:
            try:
                run = SIMULATORS[name](options, Path(folder))
            except (ImportError, FileNotFoundError) as error:
                print(f"{name} is left out: {error}", file=sys.stderr)
                continue
            print("| " + " | ".join(table_row(run, options, Path(folder))) + " |", flush=True)


if __name__ == "__main__":
    main()

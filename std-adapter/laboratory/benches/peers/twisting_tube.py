#!/usr/bin/env python3
"""Compares steps a second of processor time, and crossings, of a twisting tube with self-contact: selvedge and newton (on the CPU).

See README.md.
"""

import argparse
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

# One core for both. Both libraries read these variables when they are loaded.
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

HERE = Path(__file__).parent
try:
    import meshio
    import newton
    import numpy as np
    import warp as wp
except ImportError as error:
    venv = Path(tempfile.gettempdir()) / "selvedge-newton"
    print(
        f"{error}; install the packages and run again with their Python:\n"
        f"  python3 -m venv {venv} && {venv}/bin/pip install newton==1.8.0 warp-lang==1.19.0 meshio==5.3.5",
        file=sys.stderr,
    )
    sys.exit(1)

AROUND, ALONG = 24, 28
TURN_SECONDS = 2.0
ANGLE = np.radians(540.0)
SHIFT = 0.02
THICKNESS = 0.003


def scene_text(scene: str, seconds: float, refinement: int) -> str:
    """Returns the program's scene, refined, with three turns in two seconds instead of ten."""
    text = scene.replace('time = "10 s"', f'time = "{TURN_SECONDS} s"')
    text = text.replace('duration = "10 s"', f'duration = "{seconds} s"')
    text = text.replace("frames_per_second = 12.5", "frames_per_second = 20")
    text, count = re.subn(r"cells = \[24, 28\]", f"cells = [{AROUND * refinement}, {ALONG * refinement}]", text)
    assert count == 1 and TURN_SECONDS < 10, "this script needs the twist.toml of this program"
    return text.replace('"3 mm"', f'"{THICKNESS * 1e3 / refinement} mm"')


def processor_seconds(who: int) -> float:
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def run_selvedge(binary: Path, text: str, folder: Path) -> tuple[dict, list[Path], float]:
    """Returns the report, the frames, and the processor time of the whole command, with set-up and writing files."""
    (folder / "twist.toml").write_text(text)
    begin = processor_seconds(resource.RUSAGE_CHILDREN)
    command = [binary.absolute(), "simulate", "twist.toml", "--json", "--frames", "ply", "--output", "out"]
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if not done.stdout:
        sys.exit(f"{binary} simulate failed: {done.stderr.decode()}")
    seconds = processor_seconds(resource.RUSAGE_CHILDREN) - begin
    return json.loads(done.stdout), sorted((folder / "out").glob("twist-*.ply")), seconds


def pose(t: float, sign: float) -> tuple[float, float]:
    """Returns the end's angle and shift after `t` seconds, smooth between keyframes as in a scene."""
    s = min(max(t / TURN_SECONDS, 0.0), 1.0)
    s = s * s * (3 - 2 * s)
    return sign * ANGLE * s, -sign * SHIFT * s


class Newton:
    """Runs the same tube in newton, by vertex block descent."""

    def __init__(self, points: np.ndarray, triangles: np.ndarray, options: argparse.Namespace):
        wp.config.quiet = True
        wp.init()
        wp.set_device("cpu")
        builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
        builder.add_cloth_mesh(
            pos=wp.vec3(0.0, 0.0, 0.0),
            rot=wp.quat_identity(),
            scale=1.0,
            vertices=[wp.vec3(*point) for point in points],
            indices=triangles.reshape(-1).tolist(),
            vel=wp.vec3(0.0, 0.0, 0.0),
            # The values are those of the scene; bending is that of newton's own example of a twist, which has the same size.
            density=0.2,
            tri_ke=300.0,
            tri_ka=300.0,
            tri_kd=2.0e-4,
            edge_ke=1.0e-3,
            edge_kd=1.0e-2,
        )
        builder.color()
        self.model = builder.finalize(device="cpu")
        self.model.soft_contact_ke = 1.0e3
        self.model.soft_contact_kd = 1.0e-1
        self.model.soft_contact_mu = 0.2
        x = points[:, 0]
        self.ends = [np.flatnonzero(x == x.min()), np.flatnonzero(x == x.max())]
        flags = self.model.particle_flags.numpy()
        for end in self.ends:
            flags[end] &= ~int(newton.ParticleFlags.ACTIVE)
        self.model.particle_flags = wp.array(flags, device="cpu")
        self.rest = points
        thickness = options.margin
        self.solver = newton.solvers.SolverVBD(
            self.model,
            iterations=options.iterations,
            particle_enable_self_contact=True,
            particle_self_contact_margin=thickness,
            particle_self_contact_gap=0.75 * thickness,
            particle_vertex_contact_buffer_size=128,
            particle_edge_contact_buffer_size=256,
            particle_topological_contact_filter_threshold=options.rings,
        )
        self.now, self.next = self.model.state(), self.model.state()
        self.control = self.model.control()
        pipeline = newton.CollisionPipeline(self.model)
        self.contacts = pipeline.contacts()
        pipeline.collide(self.now, self.contacts)
        self.step_count = 0

    def step(self, h: float, rebuild: int) -> None:
        if self.step_count % rebuild == 0:
            self.solver.rebuild_bvh(self.now)
        self.now.clear_forces()
        # On the CPU, NumPy can write to the memory of an array of warp.
        t = (self.step_count + 1) * h
        for end, sign in zip(self.ends, (-1.0, 1.0)):
            angle, shift = pose(t, sign)
            x, y, z = self.rest[end].T
            c, s = np.cos(angle), np.sin(angle)
            moved = np.stack([x + shift, y * c - z * s, y * s + z * c], axis=1)
            for state in (self.now, self.next):
                state.particle_q.numpy()[end] = moved
        self.solver.step(self.now, self.next, self.control, self.contacts, h)
        self.now, self.next = self.next, self.now
        self.step_count += 1

    def points(self) -> np.ndarray:
        return self.now.particle_q.numpy().astype(np.float64)


def crossings(points: np.ndarray, triangles: np.ndarray) -> int:
    """Counts edges that certainly pass through a triangle with which they share no vertex.

    Each of the five signed volumes of an edge and a triangle must exceed the rounding of its evaluation (Shewchuk's bound for
    the determinant of three differences is 8 units of rounding of its permanent; 32 are allowed), so edges that only
    touch are not counted.
    """
    edges = np.unique(np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1), axis=0)
    low, high = points[triangles].min(axis=1), points[triangles].max(axis=1)
    found = 0

    def sign(a, b, c, d):
        u, v, w = b - a, c - a, d - a
        volume = np.einsum("ij,ij->i", u, np.cross(v, w))
        au, av, aw = abs(u), abs(v), abs(w)
        permanent = (
            au[:, 0] * (av[:, 1] * aw[:, 2] + av[:, 2] * aw[:, 1])
            + au[:, 1] * (av[:, 2] * aw[:, 0] + av[:, 0] * aw[:, 2])
            + au[:, 2] * (av[:, 0] * aw[:, 1] + av[:, 1] * aw[:, 0])
        )
        return np.where(abs(volume) > 32 * 2.0**-53 * permanent, np.sign(volume), 0)

    for first, second in edges:
        p, q = points[first], points[second]
        near = (np.minimum(p, q) <= high).all(axis=1) & (np.maximum(p, q) >= low).all(axis=1)
        near &= ~((triangles == first) | (triangles == second)).any(axis=1)
        if not near.any():
            continue
        a, b, c = points[triangles[near]].transpose(1, 0, 2)
        p, q = np.broadcast_to(p, a.shape), np.broadcast_to(q, a.shape)
        sides = sign(a, b, c, p) * sign(a, b, c, q) < 0
        around = np.stack([sign(p, q, a, b), sign(p, q, b, c), sign(p, q, c, a)])
        found += int((sides & (abs(around.sum(axis=0)) == 3)).sum())
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--selvedge", type=Path, default=HERE / "../../../../target/release/selvedge", help="the binary")
    parser.add_argument("--seconds", type=float, default=2.0, help="simulated time; the turns take 2 s (default: %(default)s)")
    parser.add_argument("--newton-from", type=float, default=0.0, help="start timing newton at this simulated time (default: 0)")
    parser.add_argument("--refinement", type=int, default=1, help="this many times the cells, along each side")
    parser.add_argument("--iterations", type=int, default=4, help="of newton, each step (its example: %(default)s)")
    parser.add_argument("--margin", type=float, default=0.002, help="newton's self-contact margin in m (its example: %(default)s)")
    parser.add_argument("--rings", type=int, default=2, help="newton leaves out pairs within this many rings (default: %(default)s)")
    parser.add_argument("--rebuild", type=int, default=10, help="newton rebuilds its hierarchy at this interval of steps (its example: 10)")
    parser.add_argument("--only", choices=["selvedge", "newton"], help="run one side")
    options = parser.parse_args()
    h = 0.001
    scene = (HERE / "../../../cloth/scenes/twist.toml").read_text()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        if options.only == "newton":
            _, frames, _ = run_selvedge(options.selvedge, scene_text(scene, h, options.refinement), folder)
        else:
            text = scene_text(scene, options.seconds, options.refinement)
            report, frames, own = run_selvedge(options.selvedge, text, folder)
        meshes = [meshio.read(frame) for frame in frames]
    triangles = meshes[0].cells_dict["triangle"].astype(np.int64)
    print(f"{len(meshes[0].points)} vertices, {len(triangles)} triangles, steps of {h * 1e3:g} ms, {options.seconds:g} s")
    if options.only != "newton":
        crossed = [crossings(mesh.points.astype(np.float64), triangles) for mesh in meshes]
        print(
            f"selvedge: {report['steps'] / own:.0f} steps a second, blocked in {report['blocked_steps']} steps; "
            f"crossings in {sum(c > 0 for c in crossed)} of {len(crossed)} frames looked at, {sum(crossed)} in all"
        )
    if options.only == "selvedge":
        return

    peer = Newton(meshes[0].points.astype(np.float64), triangles, options)
    steps, every = round(options.seconds / h), 50
    skipped, seconds, timed, crossed = round(options.newton_from / h), 0.0, 0, []
    # The first step compiles kernels.
    peer.step(h, options.rebuild)
    for step in range(1, steps):
        begin = processor_seconds(resource.RUSAGE_SELF)
        peer.step(h, options.rebuild)
        if step >= skipped:
            seconds += processor_seconds(resource.RUSAGE_SELF) - begin
            timed += 1
        if step % every == every - 1:
            points = peer.points()
            if not np.isfinite(points).all():
                print(f"newton: not finite after step {step + 1}")
                break
            crossed.append(crossings(points, triangles))
    print(
        f"newton {newton.__version__}, warp {wp.config.version}, CPU, {options.iterations} iterations, margin {options.margin * 1e3:g} mm, "
        f"{options.rings} rings left out: {timed / seconds:.1f} steps a second ({1e3 * seconds / timed:.2f} ms a step, {timed} steps timed); "
        f"crossings in {sum(c > 0 for c in crossed)} of {len(crossed)} frames looked at, {sum(crossed)} in all"
    )
    if options.only is None:
        print(f"ratio: {report['steps'] / own / (timed / seconds):.1f}")


if __name__ == "__main__":
    main()

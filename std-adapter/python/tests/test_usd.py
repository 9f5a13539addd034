"""Cloth of USD stages."""

import numpy as np
import pytest

from selvedge import Detector, errors, usd

pxr = pytest.importorskip("pxr", reason="usd-core is not installed")
from pxr import Gf, Sdf, Usd, UsdGeom, Vt  # noqa: E402


def mesh(stage, path, points, counts, corners):
    made = UsdGeom.Mesh.Define(stage, path)
    made.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(np.asarray(points, np.float32)))
    made.GetFaceVertexCountsAttr().Set(counts)
    made.GetFaceVertexIndicesAttr().Set(corners)
    return made


def sheet(stage, path, cells=12, size=40.0, height=12.0):
    """A sheet of quads, in centimetres, with y up."""
    along = np.linspace(-size / 2, size / 2, cells + 1)
    points = [(x, height, z) for z in along for x in along]
    corners = []
    for row in range(cells):
        for column in range(cells):
            a = row * (cells + 1) + column
            corners += [a, a + cells + 1, a + cells + 2, a + 1]
    return mesh(stage, path, points, [4] * cells**2, corners)


def cube(stage, path, half=10.0):
    points = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return mesh(stage, path, points, [4] * 6, [corner for quad in quads for corner in quad])


@pytest.fixture
def stage(tmp_path):
    made = Usd.Stage.CreateNew(str(tmp_path / "scene.usda"))
    UsdGeom.SetStageMetersPerUnit(made, 0.01)
    UsdGeom.SetStageUpAxis(made, UsdGeom.Tokens.y)
    made.SetStartTimeCode(1)
    made.SetEndTimeCode(12)
    made.SetTimeCodesPerSecond(24)
    UsdGeom.Xform.Define(made, "/world")
    sheet(made, "/world/sheet")
    body = cube(made, "/world/cube")
    move = body.AddTranslateOp()
    move.Set(Gf.Vec3d(0, 0, 0), 1)
    move.Set(Gf.Vec3d(0, 6, 0), 12)
    made.Save()
    return made


def run(stage, tmp_path, cloth=None, **values):
    path = stage.GetRootLayer().realPath
    cloths = {"/world/sheet": {"material": "cotton"} | (cloth or {})}
    return usd.simulate(path, cloths, ["/world/cube"], out=tmp_path / "result.usda", **values)


def points_at(stage, path, code):
    made = UsdGeom.Mesh(stage.GetPrimAtPath(path))
    matrix = np.array(UsdGeom.XformCache(code).GetLocalToWorldTransform(made.GetPrim()))
    return np.asarray(made.GetPointsAttr().Get(code), float) @ matrix[:3, :3] + matrix[3, :3]


def test_the_result_is_a_layer_over_the_file_and_free_at_every_time_code(stage, tmp_path):
    before = stage.GetRootLayer().ExportToString()
    result = run(stage, tmp_path)
    assert (result.frames, result.uncertified) == (12, [])
    over = Usd.Stage.Open(str(tmp_path / "result.usda"))
    made = UsdGeom.Mesh(over.GetPrimAtPath("/world/sheet"))
    assert made.GetPointsAttr().GetTimeSamples() == list(range(1, 13))
    assert (over.GetStartTimeCode(), UsdGeom.GetStageMetersPerUnit(over), UsdGeom.GetStageUpAxis(over)) == (1, 0.01, "Y")
    faces = np.concatenate([_fans(made), _fans(UsdGeom.Mesh(over.GetPrimAtPath("/world/cube"))) + 169])
    detector = Detector(faces, 177)
    for code in range(1, 13):
        both = np.concatenate([points_at(over, "/world/sheet", code), points_at(over, "/world/cube", code)])
        assert not detector.has_intersections(both), code
        low, high = np.asarray(made.GetExtentAttr().Get(code))
        np.testing.assert_allclose([low, high], [both[:169].min(axis=0), both[:169].max(axis=0)], atol=1e-5)
    # It fell down along y, and lies on the cube, which moved up.
    assert both[:169, 1].min() < 11.5 and both[84, 1] > 15.5
    assert Usd.Stage.Open(stage.GetRootLayer().realPath).GetRootLayer().ExportToString() == before


def _fans(made):
    corners, counts = np.asarray(made.GetFaceVertexIndicesAttr().Get()), np.asarray(made.GetFaceVertexCountsAttr().Get())
    firsts = np.cumsum(counts) - counts
    return np.concatenate([np.stack([corners[firsts], corners[firsts + k], corners[firsts + k + 1]], axis=1) for k in (1, 2)])


def test_pins_follow_the_animation_of_the_mesh(stage, tmp_path):
    made = UsdGeom.Mesh(stage.GetPrimAtPath("/world/sheet"))
    move = made.AddTranslateOp()
    move.Set(Gf.Vec3d(0, 0, 0), 1)
    move.Set(Gf.Vec3d(0, 0, 5), 12)
    weights = np.zeros(169, np.float32)
    weights[:13] = 1.0
    primvar = UsdGeom.PrimvarsAPI(made).CreatePrimvar("pinned", Sdf.ValueTypeNames.FloatArray, UsdGeom.Tokens.vertex)
    primvar.Set(Vt.FloatArray.FromNumpy(weights))
    stage.Save()
    for pins in ("pinned", np.arange(13), weights > 0.5):
        run(stage, tmp_path, {"pins": pins})
        over = Usd.Stage.Open(str(tmp_path / "result.usda"))
        now = points_at(over, "/world/sheet", 12)[:13]
        np.testing.assert_allclose(now, points_at(stage, "/world/sheet", 12)[:13], atol=1e-4)
        # A layer that is still open cannot be created again.
        del over


def test_a_subset_of_faces_is_cloth_and_the_rest_stays(stage, tmp_path):
    made = UsdGeom.Mesh(stage.GetPrimAtPath("/world/sheet"))
    UsdGeom.Subset.CreateGeomSubset(made, "half", UsdGeom.Tokens.face, Vt.IntArray(list(range(72))))
    stage.Save()
    usd.simulate(stage.GetRootLayer().realPath, {"/world/sheet/half": {"material": "cotton"}}, [], out=tmp_path / "result.usda")
    moved = points_at(Usd.Stage.Open(str(tmp_path / "result.usda")), "/world/sheet", 12)[:, 1] < 11.9
    assert moved[: 7 * 13].all() and not moved[7 * 13 :].any()


def test_left_handed_faces_and_stale_normals(stage, tmp_path):
    made = UsdGeom.Mesh(stage.GetPrimAtPath("/world/sheet"))
    made.GetOrientationAttr().Set(UsdGeom.Tokens.leftHanded)
    made.GetNormalsAttr().Set([(0, 1, 0)] * 169)
    stage.Save()
    result = run(stage, tmp_path)
    a, b, c = np.moveaxis(result.simulation.positions[result.simulation.faces], 1, 0)
    assert np.cross(b - a, c - a).sum(axis=0)[1] < 0
    over = Usd.Stage.Open(str(tmp_path / "result.usda"))
    assert UsdGeom.Mesh(over.GetPrimAtPath("/world/sheet")).GetNormalsAttr().Get() is None


def test_what_cannot_be_simulated_is_refused_with_the_remedy(stage, tmp_path):
    path, out = stage.GetRootLayer().realPath, tmp_path / "result.usda"
    with pytest.raises(errors.InputError, match="/world/skirt: the stage has no such prim"):
        usd.simulate(path, {"/world/skirt": {"material": "cotton"}}, out=out)
    with pytest.raises(errors.InputError, match="/world: .* not a Mesh"):
        usd.simulate(path, {"/world": {"material": "cotton"}}, out=out)
    with pytest.raises(errors.InputError, match="no primvar 'waist'"):
        run(stage, tmp_path, {"pins": "waist"})
    body = UsdGeom.Mesh(stage.GetPrimAtPath("/world/cube"))
    body.GetPointsAttr().Set(body.GetPointsAttr().Get(), 5)
    body.GetPointsAttr().Set([(0, 0, 0)] * 9, 6)
    stage.Save()
    with pytest.raises(errors.InputError, match="topology must not change"):
        run(stage, tmp_path)

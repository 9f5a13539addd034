from stage import bpy, grid, main, run


def test(scene):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.2, location=(0, 0, 0))
    sheet = grid("sheet", 1.0, 20, (0.01, 0.02, 0.1))
    scene.selvedge.if_tangled = "REFUSE"
    text = run(bpy.ops.selvedge.simulate)
    assert "Sphere" in text and "edges meet faces" in text, text
    chosen = [polygon.center.length for polygon in sheet.data.polygons if polygon.select]
    assert 4 <= len(chosen) < 60 and max(chosen) < 0.3
    assert "Selvedge" not in sheet.modifiers and not scene.selvedge.is_running


main(test)

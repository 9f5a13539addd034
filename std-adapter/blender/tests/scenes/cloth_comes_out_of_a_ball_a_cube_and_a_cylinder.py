from stage import bad_frames, bpy, grid, main


def test(scene):
    makers = [
        lambda: bpy.ops.mesh.primitive_uv_sphere_add(radius=0.2),
        lambda: bpy.ops.mesh.primitive_cube_add(size=0.4),
        lambda: bpy.ops.mesh.primitive_cylinder_add(radius=0.2, depth=0.4),
    ]
    for make in makers:
        make()
        body = bpy.context.object
        sheet = grid("sheet", 1.0, 30, (0.003, 0.002, 0.1))
        assert bpy.ops.selvedge.untangle() == {"FINISHED"}, scene.selvedge.report
        print(body.name, scene.selvedge.report)
        assert sheet.data.shape_keys.key_blocks["Untangled"].value == 1.0
        assert bad_frames([sheet, body], [1]) == {}
        bpy.data.objects.remove(body)
        bpy.data.objects.remove(sheet)


main(test)

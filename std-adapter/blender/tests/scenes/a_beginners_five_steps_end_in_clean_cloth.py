from stage import bad_frames, bpy, main, positions_of, simulate


def test(scene):
    # The defaults of a new file, but for the number of frames.
    scene.frame_end = 30
    bpy.ops.mesh.primitive_plane_add(size=2)
    plane = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=30)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.mesh.primitive_monkey_add()
    plane.selvedge.fabric = "COTTON"
    report = simulate()
    assert "not certified" not in report and "Stopped" not in report, report
    bad = bad_frames([plane, bpy.data.objects["Suzanne"]])
    assert all("Plane" not in text for text in bad.values()), bad
    scene.frame_set(30)
    print(positions_of(plane)[:, 2].min(), positions_of(plane)[:, 2].max())


main(test)

from stage import bpy, grid, main, np, positions_of, run, simulate


def test(scene):
    scene.use_gravity = False
    scene.selvedge.strain_limit = 0
    sheet = grid("sheet", 1.0, 12, (0, 0, 0))
    sheet.shape_key_add(name="Basis")
    flat = sheet.shape_key_add(name="Flat")
    worn = sheet.shape_key_add(name="Worn")
    for point in worn.data:
        point.co = (0.9 * point.co.x, 0.9 * point.co.y, 0.0)
    worn.value = 1.0
    sheet.selvedge.rest_key = "Flat"
    simulate()
    scene.frame_set(1)
    before = np.ptp(positions_of(sheet)[:, 0])
    scene.frame_set(20)
    after = np.ptp(positions_of(sheet)[:, 0])
    assert abs(before - 0.9) < 1e-3 and after > 0.94, (before, after)
    assert sheet.active_shape_key.name != "" and not sheet.show_only_shape_key
    sheet.selvedge.rest_key = "Gone"
    assert "no shape key 'Gone'" in run(bpy.ops.selvedge.simulate)
    assert flat.value == 0.0


main(test)

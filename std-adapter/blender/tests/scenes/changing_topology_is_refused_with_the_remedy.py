from stage import bpy, grid, main, run, suzanne


def test(scene):
    monkey, sheet = suzanne(levels=0), grid("sheet", 1.2, 16, (0, 0.02, 1.02))
    build = monkey.modifiers.new("Build", "BUILD")
    build.frame_start, build.frame_duration = -20, 60
    text = run(bpy.ops.selvedge.simulate)
    assert "'Suzanne' has" in text and "modifiers that change the mesh in time" in text, text
    assert not scene.selvedge.is_running
    # What was done plays.
    assert "Selvedge" in sheet.modifiers


main(test)

from stage import bad_frames, bpy, grid, main, positions_of, simulate, suzanne


def test(scene):
    scene.frame_end = 40
    monkey, sheet = suzanne(), grid("sheet", 1.2, 60, (0, 0.02, 1.05))
    report = simulate()
    assert "40 frames" in report and "not certified" not in report and "Triangulate" in report
    assert bad_frames([sheet]) == {}
    between = bad_frames([sheet, monkey])
    # Suzanne's eyes go through her head; nothing else meets anything.
    assert all(text.startswith("Suzanne with itself") and "sheet" not in text for text in between.values()), between
    scene.frame_set(40)
    heights = positions_of(sheet)[:, 2]
    assert heights.max() > 0.6 and heights.min() < 0.6
    bpy.ops.selvedge.clear()
    assert "Selvedge" not in sheet.modifiers


main(test)

from stage import bad_frames, grid, main, positions_of, simulate, suzanne


def test(scene):
    scene.unit_settings.scale_length = 0.01
    scene.gravity = (0, 0, -9.81)
    suzanne(50, (0, 0, 50), 0)
    sheet = grid("sheet", 120, 24, (0, 2, 102))
    simulate()
    assert bad_frames([sheet]) == {}
    scene.frame_set(20)
    heights = positions_of(sheet)[:, 2]
    # It falls by metres a second, not by hundredths.
    assert -100 < heights.min() < 80, heights.min()


main(test)

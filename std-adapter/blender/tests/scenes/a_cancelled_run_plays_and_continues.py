from stage import PACKAGE, addon, bad_frames, bpy, grid, importlib, main, np, point_cache, positions_of, simulate, suzanne

job = importlib.import_module(PACKAGE + ".job")


def test(scene):
    monkey, sheet = suzanne(levels=0), grid("sheet", 1.2, 24, (0, 0.02, 1.02))
    begun = job.Job(bpy.context, [sheet], [monkey])
    work = begun.run()
    for frame in work:
        if frame == 8:
            work.close()
            break
    path = point_cache.path_of(scene, sheet)
    assert point_cache.read_sample(path, 8)[1] == 8 and point_cache.read_sample(path, 9) is None
    scene.frame_set(8)
    at_eight = positions_of(sheet)
    assert at_eight[:, 2].min() < 1.0
    scene.frame_set(12)
    np.testing.assert_array_equal(positions_of(sheet), at_eight)
    # Continue a few frames before the end.
    scene.frame_set(6)
    at_six = positions_of(sheet)
    report = simulate(resume=True)
    assert report.startswith("15 frames"), report
    scene.frame_set(6)
    np.testing.assert_allclose(positions_of(sheet), at_six, atol=1e-6)
    scene.frame_set(8)
    # A cache has positions alone: the run goes on with the mean velocity of its last frame, and the sheet falls by 0.1 m a frame.
    np.testing.assert_allclose(positions_of(sheet), at_eight, atol=0.05)
    assert bad_frames([sheet]) == {}
    assert point_cache.read_sample(path, 20)[1] == 20


main(test)

import time

from stage import bad_frames, figure, main, np, positions_of, simulate, skirt


def test(scene):
    scene.frame_end = 60
    rig, body = figure()
    worn = skirt(rig)
    begin = time.perf_counter()
    report = simulate()
    print(f"{time.perf_counter() - begin:.2f} s")
    assert "60 frames" in report and "not certified" not in report, report
    assert bad_frames([worn, body]) == {}
    # The waist follows the spine.
    scene.frame_set(60)
    waist, hip = positions_of(worn)[:72].mean(axis=0), np.array(rig.matrix_world.translation)
    assert abs(waist[1] - hip[1]) < 0.05


main(test)

from stage import bad_frames, figure, main, simulate, skirt


def test(scene):
    scene.frame_end = 30
    rig, body = figure()
    inner = skirt(rig, "lining", 60, 24)
    outer = skirt(rig, "coat", 60, 24, waist=0.185, flare=0.22)
    inner.selvedge.fabric, outer.selvedge.fabric = "SILK", "DENIM"
    report = simulate()
    assert "not certified" not in report, report
    assert bad_frames([inner, outer, body]) == {}


main(test)

from stage import grid, main, np, positions_of, simulate

STIFFNESS = 40.0
# In N: a square metre of cotton of 150 g.
WEIGHT = 0.150 * 9.81


def pinned(name, at, sides):
    """A sheet whose two sides have these weights in its group of pins, and the weights of its vertices."""
    sheet = grid(name, 1.0, 6, at)
    group = sheet.vertex_groups.new(name="pins")
    sheet.selvedge.pin_group, sheet.selvedge.pin_stiffness = "pins", STIFFNESS
    shares = np.array([sides.get(round(vertex.co.x, 3), 0.0) for vertex in sheet.data.vertices])
    for vertex, share in enumerate(shares):
        group.add([vertex], float(share), "REPLACE")
    return sheet, shares


def test(scene):
    scene.frame_end, scene.render.fps = 72, 24
    scene.selvedge.air_drag, scene.selvedge.strain_limit = 8.0, 0
    soft, shares = pinned("soft", (0, 0, 2), {-0.5: 0.5, 0.5: 0.25})
    mixed, shares_of_mixed = pinned("mixed", (0, 3, 2), {-0.5: 1.0, 0.5: 0.25})
    scene.frame_set(scene.frame_start)
    before = [positions_of(soft), positions_of(mixed)]
    simulate()
    scene.frame_set(scene.frame_end)
    moved, moved_of_mixed = positions_of(soft) - before[0], positions_of(mixed) - before[1]
    pull = -STIFFNESS * (shares * moved[:, 2]).sum()
    assert abs(pull / WEIGHT - 1) < 0.01, (pull, WEIGHT)
    assert np.abs(moved_of_mixed[shares_of_mixed == 1]).max() < 1e-5
    assert (moved_of_mixed[shares_of_mixed == 0.25][:, 2] < -1e-3).all()


main(test)

from stage import bad_frames, main, mesh_object, np, positions_of, simulate


def test(scene):
    scene.use_gravity, scene.frame_end = False, 30
    cells, positions, faces = 8, [], []
    for panel in range(2):
        first = len(positions)
        for row in range(cells + 1):
            for column in range(cells + 1):
                positions.append((0.05 * column + 0.5 * panel, 0.05 * row, 0.0))
        for row in range(cells):
            for column in range(cells):
                a = first + row * (cells + 1) + column
                faces.append((a, a + 1, a + cells + 2, a + cells + 1))
    right = [row * (cells + 1) + cells for row in range(cells + 1)]
    left = [len(positions) // 2 + row * (cells + 1) for row in range(cells + 1)]
    cloth = mesh_object("panels", positions, faces, list(zip(right, left)))
    cloth.selvedge.fabric, cloth.selvedge.sew, cloth.selvedge.sewing_frames = "COTTON", True, 20
    simulate()
    assert bad_frames([cloth]) == {}
    scene.frame_set(30)
    now = positions_of(cloth)
    gaps = np.linalg.norm(now[right] - now[left], axis=1)
    assert gaps.max() < 0.02, gaps


main(test)

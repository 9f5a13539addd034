from stage import bad_frames, bpy, grid, main, mesh_object, np, simulate


def test(scene):
    scene.frame_start, scene.frame_end = 101, 112
    angles = 2 * np.pi * np.arange(9) / 9
    ring = [(0.3 * np.cos(a), 0.3 * np.sin(a), 0.0) for a in angles]
    rim = [(0.4 * np.cos(a), 0.4 * np.sin(a), -0.2) for a in angles]
    sides = [(k, (k + 1) % 9, 9 + (k + 1) % 9, 9 + k) for k in range(9)]
    table = mesh_object("table", ring + rim, [tuple(range(9))[::-1], *sides])
    sheet = grid("sheet", 1.2, 24, (0.01, 0.02, 0.03))
    # Vertices and edges without a face stay as they are.
    mesh = sheet.data
    mesh.vertices.add(2)
    mesh.vertices[-1].co, mesh.vertices[-2].co = (3, 3, 3), (3, 3, 4)
    mesh.edges.add(1)
    mesh.edges[-1].vertices = len(mesh.vertices) - 2, len(mesh.vertices) - 1
    mesh.update()
    report = simulate()
    assert report.startswith("12 frames"), report
    assert bad_frames([sheet, table]) == {}
    assert sheet.modifiers["Selvedge"].frame_start == 101
    scene.frame_set(101)
    evaluated = sheet.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    assert tuple(evaluated.vertices[-1].co) == (3, 3, 3)


main(test)

from stage import bad_frames, bpy, grid, main, np, positions_of, simulate, suzanne


def test(scene):
    monkey, plain = suzanne(levels=0), grid("plain", 1.2, 20, (0, 0.02, 1.02))
    simulate()
    scene.frame_set(20)
    expected = positions_of(plain)
    bpy.data.objects.remove(plain)
    parent = bpy.data.objects.new("parent", None)
    scene.collection.objects.link(parent)
    parent.scale, parent.rotation_euler, parent.location = (-2, 1.5, 0.5), (0, 0, 0.3), (1, 2, 3)
    for obj in (monkey, grid("child", 1.2, 20, (0, 0.02, 1.02))):
        scene.frame_set(1)
        bpy.context.view_layer.update()
        world = obj.matrix_world.copy()
        obj.parent = parent
        bpy.context.view_layer.update()
        obj.matrix_parent_inverse = parent.matrix_world.inverted()
        bpy.context.view_layer.update()
        assert np.allclose(np.array(obj.matrix_world), np.array(world), atol=1e-6)
    child = bpy.data.objects["child"]
    simulate()
    assert bad_frames([child]) == {}
    scene.frame_set(20)
    # The rounding of matrices grows where folds fall.
    assert np.median(np.abs(positions_of(child) - expected)) < 0.02


main(test)

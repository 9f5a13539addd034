from stage import bpy, main, suzanne


def test(scene):
    one = suzanne(levels=0)
    assert bpy.ops.selvedge.check() == {"FINISHED"}
    alone = {polygon.index for polygon in one.data.polygons if polygon.select}
    # The eyes go through the head.
    assert alone and "Suzanne with itself" in scene.selvedge.report, scene.selvedge.report
    bpy.ops.mesh.primitive_cube_add(size=0.3, location=(0.3, 0, 0.5))
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.selvedge.check()
    both = {polygon.index for polygon in one.data.polygons if polygon.select}
    assert both > alone
    assert len(scene.selvedge.places) > 0
    bpy.ops.selvedge.next_place()
    assert tuple(scene.cursor.location) == tuple(scene.selvedge.places[0].location)
    bpy.data.objects["Cube"].location.x = 9
    bpy.context.view_layer.update()
    bpy.ops.object.select_all(action="DESELECT")
    bpy.data.objects["Cube"].select_set(True)
    bpy.ops.selvedge.check()
    assert scene.selvedge.report.startswith("No intersections")


main(test)

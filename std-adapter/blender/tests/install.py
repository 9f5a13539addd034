"""Installs the extension's zip as a user does, into an empty user folder and a Python without selvedge: python install.py ZIP."""

import os
import sys
import tempfile

from ending import end_after

folder = tempfile.mkdtemp()
os.environ["BLENDER_USER_RESOURCES"] = folder

import bpy  # noqa: E402


def install(path):
    try:
        import selvedge

        raise AssertionError(f"selvedge is there already: {selvedge.__file__}")
    except ImportError:
        pass
    done = bpy.ops.extensions.package_install_files(filepath=path, repo="user_default", enable_on_install=True)
    assert done == {"FINISHED"}, done
    import selvedge

    assert selvedge.__file__.startswith(folder), selvedge.__file__
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=8, y_subdivisions=8, location=(0, 0, 2))
    bpy.context.object.selvedge.fabric = "COTTON"
    bpy.ops.mesh.primitive_monkey_add()
    bpy.context.scene.frame_end = 3
    assert bpy.ops.selvedge.simulate() == {"FINISHED"}
    assert bpy.context.scene.selvedge.report.startswith("3 frames"), bpy.context.scene.selvedge.report
    print(f"installed and ran in Blender {bpy.app.version_string}")


end_after(lambda: install(os.path.abspath(sys.argv[1])))

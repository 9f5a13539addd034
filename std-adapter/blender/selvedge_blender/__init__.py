"""Selvedge in Blender: finds intersections exactly, and simulates cloth that never intersects."""

import bpy

from . import operators, panels, properties

CLASSES = properties.CLASSES + operators.CLASSES + panels.CLASSES


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.selvedge = bpy.props.PointerProperty(type=properties.SelvedgeObject)
    bpy.types.Scene.selvedge = bpy.props.PointerProperty(type=properties.SelvedgeScene)


def unregister():
    del bpy.types.Scene.selvedge, bpy.types.Object.selvedge
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)

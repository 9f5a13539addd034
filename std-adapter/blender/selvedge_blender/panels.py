"""The panels, beside Blender's own physics."""

import bpy

from .meshes import CACHE


class SELVEDGE_PT_object(bpy.types.Panel):
    bl_label = "Selvedge"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Selvedge"

    def draw(self, context):
        layout, obj, settings = self.layout, context.object, context.scene.selvedge
        layout.use_property_split = True
        if obj is not None and obj.type == "MESH":
            draw_object(layout, obj)
        if settings.is_running:
            layout.progress(factor=settings.progress, text=f"{settings.progress:.0%}  (Esc cancels)")
            return
        row = layout.row(align=True)
        row.scale_y = 1.4
        row.operator("selvedge.simulate", icon="PLAY").resume = False
        row.operator("selvedge.simulate", text="Continue Here").resume = True
        row = layout.row(align=True)
        row.operator("selvedge.check", text="Check Frame").all_frames = False
        row.operator("selvedge.check", text="All Frames").all_frames = True
        row.operator("selvedge.next_place", text="", icon="FORWARD")
        layout.operator("selvedge.untangle")
        for line in settings.report.split("\n")[:8] if settings.report else ():
            layout.label(text=line)


def draw_object(layout, obj):
    own = obj.selvedge
    layout.prop(own, "fabric")
    if own.fabric == "NONE":
        layout.prop(own, "is_collider")
        return
    layout.prop(own, "thickness")
    layout.prop_search(own, "pin_group", obj, "vertex_groups")
    sub = layout.row()
    sub.active = own.pin_group != ""
    sub.prop(own, "pin_stiffness")
    if obj.data.shape_keys is not None:
        layout.prop_search(own, "rest_key", obj.data.shape_keys, "key_blocks")
    row = layout.row(heading="Sewing")
    row.prop(own, "sew", text="")
    sub = row.row()
    sub.active = own.sew
    sub.prop(own, "sewing_frames")


class SELVEDGE_PT_scene(bpy.types.Panel):
    bl_label = "Settings"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Selvedge"
    bl_parent_id = "SELVEDGE_PT_object"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.selvedge
        layout.use_property_split = True
        for name in ("friction", "air_drag", "strain_limit", "settle", "samples", "most_steps", "if_tangled", "if_pinched", "folder"):
            layout.prop(settings, name)
        if any(obj.type == "MESH" and CACHE in obj.modifiers for obj in context.scene.objects):
            layout.operator("selvedge.clear")


CLASSES = (SELVEDGE_PT_object, SELVEDGE_PT_scene)

"""What the user sets, on objects and on the scene."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

FABRICS = [
    ("NONE", "No Cloth", "The object is not cloth"),
    ("COTTON", "Cotton", "Shirts and skirts"),
    ("DENIM", "Denim", "Jeans and jackets: heavy and stiff"),
    ("SILK", "Silk", "Light, with fine folds"),
    ("WOOL", "Wool", "Coats and pullovers: soft and thick"),
    ("LEATHER", "Leather", "Heavy and very stiff"),
    ("LATEX", "Latex", "Stretches easily"),
]


def _shape_keys(self, _context, text):
    keys = self.id_data.data.shape_keys
    return [key.name for key in keys.key_blocks if text.lower() in key.name.lower()] if keys else []


class SelvedgeObject(bpy.types.PropertyGroup):
    fabric: EnumProperty(name="Fabric", items=FABRICS, description="Makes the object cloth of this fabric")
    is_collider: BoolProperty(name="Collider", default=True, description="Cloth does not pass through this object")
    pin_group: StringProperty(
        name="Pin Group",
        description="A vertex group: vertices of weight 1 go where the armature and other modifiers put them. Springs pull vertices of "
        "lower weights there",
    )
    pin_stiffness: FloatProperty(
        name="Pin Stiffness",
        default=20,
        min=1e-3,
        soft_max=1000,
        max=1e6,
        description="How hard springs pull vertices with a pin weight below 1, in N/m for each vertex, times its weight. A vertex yields by "
        "the force on it over that",
    )
    rest_key: StringProperty(
        name="Rest Shape Key",
        description="The shape in which the cloth is not stretched, such as that of the pose in which it was modelled. Without it: its shape "
        "at the first frame",
        search=_shape_keys,
    )
    thickness: FloatProperty(
        name="Thickness", default=0.004, min=1e-4, max=0.1, unit="LENGTH", precision=4, description="The distance that cloth keeps, in metres"
    )
    sew: BoolProperty(name="Sewing", description="Loose edges, which belong to no face, draw their ends together")
    sewing_frames: IntProperty(name="Frames", default=24, min=0, description="Seams are closed after so many frames; 0 holds their length")


class SelvedgePlace(bpy.types.PropertyGroup):
    frame: IntProperty()
    location: FloatVectorProperty(subtype="TRANSLATION")


class SelvedgeScene(bpy.types.PropertyGroup):
    settle: IntProperty(
        name="Settle", default=0, min=0, max=1000, description="Frames in which cloth comes to rest before the first, while colliders stand"
    )
    samples: IntProperty(
        name="Samples", default=1, min=1, max=32, description="Places of fast colliders and pins in each frame, between which they move straight"
    )
    most_steps: IntProperty(name="Most Steps", default=200, min=1, max=10000, description="The most steps of a sample; cloth takes fewer")
    friction: FloatProperty(name="Friction", default=0.3, min=0, max=2, description="0 slides")
    air_drag: FloatProperty(name="Air Drag", default=0.5, min=0, max=100, description="How fast air slows cloth, in 1/s")
    strain_limit: FloatProperty(
        name="Stretch Limit", default=0.08, min=0, max=1, subtype="FACTOR", description="The most that edges become longer; 0 is no limit"
    )
    if_pinched: EnumProperty(
        name="If Pinched",
        items=[
            ("YIELD", "Pass Through", "A collider that pinches cloth passes through it until it is free again"),
            ("HOLD", "Wait", "Colliders and pins wait, and are late from then on"),
            ("STOP", "Stop", "The simulation ends there"),
        ],
    )
    if_tangled: EnumProperty(
        name="If Tangled",
        items=[
            ("UNTANGLE", "Untangle", "Cloth that starts through something is pulled out first"),
            ("REFUSE", "Stop", "Cloth that starts through something is refused, and the faces are selected"),
            ("TOLERATE", "Tolerate", "Pairs that start through each other are not certified until they are apart"),
        ],
    )
    folder: StringProperty(name="Folder", default="//selvedge", subtype="DIR_PATH", description="Of the results")
    progress: FloatProperty(subtype="FACTOR", min=0, max=1, options={"SKIP_SAVE"})
    is_running: BoolProperty(options={"SKIP_SAVE"})
    report: StringProperty()
    places: CollectionProperty(type=SelvedgePlace)
    place: IntProperty(default=-1)


CLASSES = (SelvedgeObject, SelvedgePlace, SelvedgeScene)

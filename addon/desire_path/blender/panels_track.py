"""panels_track.py - what leaves a track along a curve, and the buttons that press it."""

from .compat import prop
from .panels import _column, in_both

STAMPED = ("spacing", "width", "first", "size", "scatter")


def draw(layout, obj):
    settings = obj.desire_path.track
    if not settings.is_track:
        row = layout.row()
        row.scale_y = 1.4
        row.operator("object.desire_path_track_add", icon="MOD_DYNAMICPAINT")
        return
    column = _column(layout)
    prop(column, obj.desire_path, "ground")
    prop(column, settings, "kind")
    if settings.kind == "WHEEL":
        prop(column, settings, "vehicle")
        if settings.vehicle == "none":
            for name in ("radius", "tyre_width", "tread", "gauge"):
                prop(column, settings, name)
    else:
        _draw_stamp(column, settings)
    column = _column(layout)
    prop(column, settings, "depth")
    weight = column.row()
    weight.active = not settings.depth
    prop(weight, settings, "weight")
    prop(column, settings, "speed")
    prop(column, settings, "end_speed")
    row = layout.row()
    row.scale_y = 1.4
    row.operator("object.desire_path_tracks_press", icon="BRUSH_DATA")
    layout.operator("object.desire_path_track_remove", icon="X")


def _draw_stamp(column, settings):
    if settings.kind == "SOLE":
        prop(column, settings, "sole")
    else:
        prop(column, settings, "stamp")
        if settings.stamp == "image":
            column.template_ID(settings, "image", open="image.open")
            prop(column, settings, "image_length")
            prop(column, settings, "image_height")
    for name in STAMPED:
        prop(column, settings, name)
    if settings.scatter:
        prop(column, settings, "seed")


class _Track:
    bl_label = "Desire Path"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "CURVE"

    def draw(self, context):
        draw(self.layout, context.object)


CLASSES = in_both(_Track, "_track")

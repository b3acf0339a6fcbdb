"""The panel in the sidebar of the 3D view."""

import bpy


class VIEW3D_PT_frisure(bpy.types.Panel):
    bl_label = "frisure"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "frisure"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        hair = context.active_object
        if hair is None or hair.type != "CURVES":
            layout.operator("object.frisure_add")
            return
        kept = hair.frisure
        if not kept.scene:
            layout.operator("object.frisure_settle")
            return
        if kept.problem:
            box = layout.box()
            for line in kept.problem.splitlines():
                box.label(text=line, icon="ERROR")
        layout.prop(kept, "head")
        if kept.head is not None:
            layout.prop_search(kept, "scalp", kept.head, "vertex_groups")
        column = layout.column()
        # Settled curves have their own length and curl.
        column.enabled = kept.source is None
        column.template_icon_view(kept, "hair_type", show_labels=True, scale=4.0, scale_popup=6.0)
        for name in ("hair_type", "length", "curl_radius", "curl_pitch", "guides", "hairs", "points", "contact", "seed"):
            column.prop(kept, name)
        steps = layout.column(align=True)
        for name in ("wet", "dry", "cut", "grow", "comb", "step", "take_back"):
            steps.operator(f"object.frisure_{name}")
        layout.operator("object.frisure_export")


def register():
    bpy.utils.register_class(VIEW3D_PT_frisure)


def unregister():
    bpy.utils.unregister_class(VIEW3D_PT_frisure)

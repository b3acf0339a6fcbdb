"""Natural hair from the physics of its fibres, on any head: the extension for Blender.

The hair is a Curves object. It keeps the text of its frisure scene with all steps; whatever is changed, the scene is solved again.
"""

from . import operators, panel, properties, thumbnails

MODULES = (thumbnails, properties, operators, panel)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()

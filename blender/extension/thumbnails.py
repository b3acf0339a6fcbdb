"""Hair types with their pictures, for menus and the panel."""

from pathlib import Path

import bpy.utils.previews
import frisure

# `build.py` puts the pictures of the salon's gallery there.
FOLDER = Path(__file__).parent / "thumbnails"

NAMES = list(frisure.presets.descriptions)

# An enum with items from a function has the number of an item as its default.
DEFAULT = NAMES.index("caucasian-wavy")

# The items must stay in memory: Blender keeps no copy of those that a function returns.
_items: list = []
_pictures = None


def hair_types(_self=None, _context=None) -> list:
    """The items of an enum: name, label, description, icon and number."""
    return _items


def register():
    global _pictures
    _pictures = bpy.utils.previews.new()
    _items.clear()
    for number, (name, text) in enumerate(frisure.presets.descriptions.items()):
        picture = FOLDER / f"{name}.jpg"
        icon = _pictures.load(name, str(picture), "IMAGE").icon_id if picture.is_file() else 0
        _items.append((name, name, text, icon, number))


def unregister():
    global _pictures
    if _pictures is not None:
        bpy.utils.previews.remove(_pictures)
        _pictures = None

#!/usr/bin/env python3
"""Makes icons.ttf and ../src/window/icons.rs: the icons of the salon, cut out of the font of Phosphor Icons.

    npm pack @phosphor-icons/web@2.1.2 && tar xzf phosphor-icons-web-2.1.2.tgz
    pip install fonttools
    python3 crates/frisure-salon/icons/make.py package

To add an icon, add a line to ICONS and run this again. Phosphor Icons are MIT licensed (LICENSE beside this file).
"""

import json
import pathlib
import subprocess
import sys

# The constant, the name among Phosphor's icons, and what it stands for.
ICONS = [
    ("ALL", "selection-all", "All hair."),
    ("BRUSH", "paint-brush", "The brush that selects."),
    ("CLIPPERS", "ruler", "Clippers with a guard."),
    ("COMB", "hand-swipe-right", "The comb."),
    ("COMPARE", "square-split-horizontal", "Before and after."),
    ("CUT", "knife", "The cutting plane."),
    ("DARK", "moon", "The dark theme."),
    ("DELETE", "trash", "Remove from a list."),
    ("DONE", "check-circle", "Something is done."),
    ("DRY", "hair-dryer", "Dry hair."),
    ("EXERCISES", "list-checks", "Exercises."),
    ("EXPORT", "export", "Write a groom."),
    ("GALLERY", "squares-four", "The gallery."),
    ("GOAL", "target", "The goal of an exercise."),
    ("GROW", "plant", "Let hair grow."),
    ("HELP", "question", "Keys and tools."),
    ("HIDDEN", "eye-slash", "Hair that is not shown."),
    ("HOLD", "paperclip", "Hold hair."),
    ("INVERT", "selection-inverse", "The hair that is not selected."),
    ("LANGUAGE", "translate", "The language."),
    ("LASSO", "lasso", "The lasso that selects."),
    ("LIFT", "hand-arrow-up", "Fingers that lift hair."),
    ("LIGHT", "sun", "The light theme."),
    ("LOCKED", "lock-simple", "Hair that steps leave alone."),
    ("MIRROR", "flip-horizontal", "Both sides of the head."),
    ("ONE_HAIR", "spiral", "One hair alone."),
    ("OPEN", "folder-open", "Open a file."),
    ("PARTING", "line-segment", "Draw a parting."),
    ("PICTURE", "camera", "A final picture."),
    ("PLAY", "play", "Show how it is done."),
    ("REDO", "arrow-clockwise", "Redo."),
    ("REFERENCE", "image", "A reference photo."),
    ("RELEASE", "link-break", "Let go of held hair."),
    ("SAVE", "floppy-disk", "Save the scene."),
    ("SCISSORS", "scissors", "Scissors."),
    ("SECTION", "bookmark-simple", "A named section."),
    ("SETTINGS", "sliders-horizontal", "The panels with sliders and the history."),
    ("SHARE", "share-network", "Share the scene."),
    ("SHOWN", "eye", "Hair that is shown."),
    ("SPIN", "arrows-clockwise", "Turn the head slowly."),
    ("STOP", "stop", "Stop."),
    ("TOUR", "graduation-cap", "The tour."),
    ("TURN", "camera-rotate", "Orbit, pan and zoom."),
    ("UNDO", "arrow-counter-clockwise", "Undo."),
    ("UNLOCKED", "lock-simple-open", "Hair that steps apply to."),
    ("WET", "drop", "Wet hair."),
]


def main():
    here, source = pathlib.Path(__file__).parent, pathlib.Path(sys.argv[1]) / "src" / "regular"
    icons = json.loads((source / "selection.json").read_text())["icons"]
    codes = {i["properties"]["name"].split(",")[0].strip(): i["properties"]["code"] for i in icons}
    lines = ["//! Names of the icons in `icons/icons.ttf`. `icons/make.py` makes this file.", ""]
    for name, icon, meaning in ICONS:
        lines += [f"/// {meaning} Phosphor's `{icon}`.", f'pub(super) const {name}: &str = "\\u{{{codes[icon]:x}}}";']
    (here / "../src/window/icons.rs").write_text("\n".join(lines) + "\n")
    unicodes = ",".join(f"{codes[icon]:x}" for _, icon, _ in ICONS)
    options = [f"--unicodes={unicodes}", "--no-hinting", "--desubroutinize", "--layout-features="]
    options.append(f"--output-file={here / 'icons.ttf'}")
    subprocess.run([sys.executable, "-m", "fontTools.subset", source / "Phosphor.ttf", *options], check=True)


main()

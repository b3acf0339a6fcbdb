# The texts of the salon in English. Labels of scene keys, hair types, levels and the like are in the declarations of the library.
# A message of a button may have a help, which is its tooltip.

## Tools and their settings
tool-turn = Turn
    .help = V: orbit, pan and zoom
tool-lasso = Lasso
    .help = L: draw around hair to select it
tool-brush = Brush
    .help = B: paint over the scalp to select hair by its roots
tool-scissors = Scissors
    .help = S: draw across hair, which is cut there
tool-cut = Cut
    .help = C: drag a cutting plane through the selected hair
tool-lift = Lift
    .help = U: paint over the scalp; hair is lifted off it and cut
tool-clippers = Clippers
    .help = J: paint over the scalp; a guard says what is left
tool-comb = Comb
    .help = K: drag in the direction of combing
tool-one-hair = One hair
    .help = H: click to see one hair with its material frames
lasso-hint = Draw around hair. Shift adds, Alt removes.
view-front = Front
view-three-quarter = Three-quarter
view-left = Left
view-back = Back
view-right = Right
view-top = Top
view = View
    .help = Set this view
keep-view = Keep this view
    .help = Save the view as the scene's camera
cut-height = Height
cut-level = { $cm } cm { $side ->
    [below] below
   *[above] above
 } the { $level }
cut-roll = to its left
cut-pitch = to the back
level-plane = Level
    .help = Make the plane level
cut-here = Cut here
    .help = Enter
cut-preview = { $part } % of the hairs lose { $grams } g
cut-held = Held
    .help = How the hair is held: as it hangs; trimmed until it rests at the line; or combed straight down, as in the paper
cut-hanging = as it hangs
cut-resting = until it rests there
cut-down = combed straight down
soft-edge = Soft edge
    .help = Point cutting: each hair ends up to this far before the line, for a soft edge
of-hairs = Of hairs
    .help = Thinning scissors: the fraction of the hairs that is cut
lift-elevation = Elevation
    .help = From flat along the skin: 0 leaves one length, 45 graduates, 90 makes layers
lift-length = Cut at
    .help = How far from the skin lifted hair is cut
guard = Guard
    .help = What is left of the hair
    .put-on = Put on this guard
brush-radius = Radius
comb-forward = Forward
comb-back = Back
comb-down = Down
comb-left = Left
comb-right = Right
comb-side = Side
    .help = Comb the selected hair to this side
wisp = Wisp
one-hair-hint = Click on the head, or enter an index.
show-all-hair = All hair
    .help = Show all hair

## The upper toolbar
panels = Panels
    .help = sliders and history
gallery = Gallery
    .help = hair to start with
open = Open…
    .help = Open a scene, a head or a groom (Ctrl O)
save = Save…
    .help = Save the scene (Ctrl S)
export = Export…
    .help = Write the hair as a groom (Ctrl E)
picture = Picture…
    .help = Render a final picture, a turntable or a film (Ctrl P)
help = Help
    .help = keys and tools (F1)
theme-light = Light
    .help = a light or a dark window
theme-dark = Dark
    .help = a light or a dark window
language = Language
    .help = the language of the salon
undo = Undo
    .help = Ctrl Z
redo = Redo
    .help = Ctrl Shift Z
wet = Wet
    .help = Wet or dry the selected hair (W)
dry = Dry
    .help = Wet or dry the selected hair (W)
grow-month = Grow a month
    .help = Grow the selected hair (G)
compare = Compare
    .help = The hair before the last edit and now, side by side (X)
mirror = Mirror
    .help = Do each step on the other side of the head, too (M)

## The selection
selected = Selected:
selected-count = { $count ->
    [one] { $label } ({ $count } wisp)
   *[other] { $label } ({ $count } wisps)
 }
select-all = All
    .help = Select all hair (A)
select-invert = Invert
    .help = Select the hair that is not selected (I)
place = Part of the scalp
    .help = Select this part of the scalp. Shift adds, Alt removes.
place-fringe = Fringe
    .selected = fringe
place-top = Top
    .selected = top
place-crown = Crown
    .selected = crown
place-sides = Sides
    .selected = sides
place-back = Back
    .selected = back
place-nape = Nape
    .selected = nape
place-left = Left half
    .selected = left half
place-right = Right half
    .selected = right half
all-hair = all hair
selected-and = { $first } and { $second }
selected-without = { $first } without { $second }
selected-all-but = all but { $label }
a-part = a part
a-lasso = a lasso
a-brush-stroke = a brush stroke
hold = Hold
release = Release
    .help = Release held hair (R)
grow-cm = Grow 1 cm
    .help = Grow the selected hair

## The status line and the badge
dismiss = Dismiss
status-hair = { $wisps } wisps · { $hairs } hairs · { $length } cm mean · { $mass } g
jobs-waiting = { $count } more
stop = Stop
    .help = Cancel the background jobs
stopped = Stopped.
badge-empty = No hair yet
badge-settling = Settling…
badge-at-rest = At rest
badge-unstable = { $count ->
    [one] Unstable: { $count } guide
   *[other] Unstable: { $count } guides
 }
badge-refused = Not possible
badge-refused-earlier = Not possible: earlier hair
the-head = The head
before-and-after = Before and after
before = Before: { $label }
computing = Computing…
hair-report =
    Wisp { $wisp }
    length { $length } cm, section { $a } × { $b } µm
    elastic { $elastic } nJ, gravity { $gravity } nJ, contact { $contact } nJ
    { $elements } elements, { $iterations } iterations
    relative gradient { $gradient }: { $stability }
    d1 red, d2 green, tangent blue

## The panels at the side
groom-determines = The groom determines the other parameters.
default = default
as-in-the-file = as in the file
reset = reset
    .help = Use the default of the hair type
reset-of = Reset { $label }
head-is = Head: { $name }
head-is-mannequin = Head: the mannequin
hair-is = Hair: { $name }
hair-is-own = Hair: the scene's own
use-mannequin = Use the mannequin
use-own-hair = Use the scene's own hair
    .help = Compute the hair from fibre, curl, length and implantation
drop-head-or-groom = Drop a head or a groom on the window to use it.
history = History
versus = vs
    .help = Show it beside the current hair
compare-with = Compare with { $label }

## Dialogs
open-title = Open a scene, a head or a groom
open-filter = Scenes, heads and grooms
open-text =
    A scene is a .toml file. A mesh becomes the head of the open scene, curves and lines its hair: USD, Alembic, glTF, .obj, .ply, .hair, .data, .npz. You can also drop files on the window.
open-file = Open file
browse = Browse…
    .help = The system's file dialog
choose-file = Choose a file…
save-title = Save the scene
save-text = The scene is a text file with all edits and steps; the command line reads it, too.
save-scene = Save scene
copy-link = Copy a link
    .help = Whoever opens the link has this scene; nothing is stored on a server
copy-code = Copy a link
    .help = Put it behind the address of a salon in a browser, or after --begin
export-title = Export the hair
export-text = All hairs in their current shape, in metres, z up.
export-groom = Export groom
format = Format
file = File
close = Close
    .help = Escape
picture-title = Render a picture
picture-text = Rendered in the background, from the current view.
final-picture = Final picture
turntable = Turntable
picture-width = Width
picture-height = Height
picture-frames = Pictures
picture-paths = Maximum paths per pixel
picture-noise = Noise
make-turntable = Make turntable
render-picture = Render picture
stop-rendering = Stop rendering
noise-so-far = noise { $noise } %
recover-title = Recover unsaved work?
recover-text = The salon ended before “{ $name }” was saved.
recover = Recover
discard = Discard

## Help
help-title = Keys and tools
keys-orbit = V
    .does = orbit (drag); Shift-drag pans; the wheel zooms
keys-lasso = L
    .does = lasso: draw around hair; Shift adds, Alt removes
keys-brush = B
    .does = brush: paint over the scalp
keys-cut = C
    .does = cutting plane: drag it; Shift-drag tilts it; Enter cuts
keys-scissors = S
    .does = scissors: draw across hair, which is cut there
keys-lift = U
    .does = lift: paint over the scalp; hair is lifted off it and cut
keys-clippers = J
    .does = clippers: paint over the scalp; a guard says what is left
keys-comb = K
    .does = comb: drag in the direction of combing
keys-one-hair = H
    .does = pick one hair, to see its material frames
keys-space = Space
    .does = while held: orbit with every tool
keys-select = A / I
    .does = select all hair / invert the selection
keys-wet = W
    .does = wet or dry the selected hair
keys-grow = G
    .does = grow it by a month
keys-release = R
    .does = release held hair
keys-enter = Enter
    .does = cut at the plane
keys-undo = Ctrl Z / Ctrl Shift Z
    .does = undo / redo
keys-mirror = M
    .does = mirror: do each step on both sides of the head, or no longer
keys-compare = X
    .does = compare with the hair before the last edit
keys-views = 1 … 6
    .does = front, three-quarter, left, back, right, top
keys-frame = F
    .does = frame everything
keys-arrows = Arrows, + / −
    .does = orbit, zoom
keys-files = Ctrl O / S / E / P
    .does = open / save / export / picture
keys-escape = Esc
    .does = orbit tool, all hair selected and shown
keys-help = F1
    .does = this help
mouse-buttons = With every tool the right mouse button orbits and the middle one pans.

## The gallery
gallery-title = Choose hair to start with
gallery-text = Choose a hair type or a hairstyle, open a scene, or drop a file on the window.
back-to-head = Back to the head
    .help = Escape
hair-types = Hair types
hairstyles = Hairstyles
begin-card = Begin: { $title }
computing-first = Computing the first hair…
drop-here = Drop a scene, a head or a groom
no-graphics = The head cannot be drawn without a graphics device.

## The tour
tour = Tour
take-tour = Take the tour
    .help = Five steps on a head of curly hair: turn, wet, select, cut, dry and compare
tour-step = { $at } of { $count }: { $title }
tour-turn = Turn the head
    .text = Drag in the picture, or press the arrow keys. 1 to 6 show the head from the front, from its sides, from behind and from above; F frames all of it.
tour-wet = Wet the hair
    .text = Press Wet (W). Wet hair is heavier and softer: curls hang lower. It takes a moment until all hair rests; the badge in the corner says so.
tour-select = Select the fringe
    .text = Press Fringe below the picture, or draw around hair with the lasso (L). The next steps are done to the selected hair alone, which has a blue tint.
tour-cut = Cut it
    .text = Choose Cut (C) and drag the plane up to the eyes: what is red falls. Then press Cut here (Enter). Scissors (S) cut along a line that you draw.
tour-dry = Dry it, and compare
    .text = Select all hair (A), press Dry (W): the fringe springs up. Compare (X) shows the hair before the last edit; drag the bar. Undo (Ctrl Z) takes any edit back.
tour-over = That was the tour
    .text = Picture… renders a final picture, Save… keeps the scene, Gallery has other hair and exercises. Help (F1) lists all keys.
tour-close = End
    .help = Close the tour
tour-next = Next
    .help = Go to the next step
tour-skip = Skip
    .help = Go to the next step
tour-end = End the tour
tour-done = Done

## Edits in the history
opened = Opened
shared = Shared
from-a-link = From a link
recovered = Recovered
changed = Changed
set-to = { $name }: { $value }
default-of-type = default of the hair type
scene-camera = The scene's camera
file-head = Head of { $name }
file-hair = Hair of { $name }
file-head-and-hair = Head and hair of { $name }
mannequin-head = The mannequin's head
own-hair = The scene's own hair
paths-from-folder = Paths from its folder
operation-grow-by = Grow by { $cm } cm

## Messages
saved = Saved { $path }.
not-saved = cannot save { $path }: { $problem }
    .hint = Nothing was overwritten. Save it under another name.
cut-off = Cut off { $grams } g of hair.
groom-fit = groom: { $report }
    .hint = A stiffer or thicker fibre, or a shorter lock, is stable.
crosses-no-hair = the stroke crosses no hair
    .hint = Draw across hair that you see.
draw-larger = Draw a larger shape.
select-other = Select other hair.
choose-under = Choose another under “{ $panel }”.
file-has-both = { $name } has a head and hair; both are used.
    .hint = “Use the mannequin” under “{ $panel }” keeps only its hair.
unknown-file = { $path } cannot be opened here
    .hint = Scenes are .toml files; heads and grooms are { $known }.
not-text = { $name } is not text
    .hint = A scene is UTF-8 text; `frisure new` prints an example.
no-scene-inside = { $name } has no scene inside
    .hint = Pictures that the salon has rendered have their scene inside.
check-path = Check the path.
not-autosaved = your work cannot be autosaved: { $problem }
    .hint = Save the scene regularly.
autosave-unreadable = the autosaved work of the last run cannot be read
    .hint = The file stays as it is until the next autosave.
not-a-groom = `{ $path }` does not have the extension of a groom
    .hint = The groom formats are { $known }.
link-damaged = the link is damaged: { $problem }
    .hint = Copy all of the link, to its last letter.
no-such-card = there is no hair called `{ $name }`
    .hint = Open the gallery to see the names.
line = line { $line }: {""}
drop-the-file = Drop the file on the window, or open it; or undo.
choose-unit-and-axis = Choose its unit and the axis that points up under “{ $panel }”, or open the head that it was made on.
choose-unit = Choose its unit under “{ $panel }”.
device-lost = the graphics device was lost: { $reason }
    .hint = Your work is still there, in a new window.

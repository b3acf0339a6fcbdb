//! Names of the icons in `icons/icons.ttf`. `icons/make.py` makes this file.

/// All hair. Phosphor's `selection-all`.
pub(super) const ALL: &str = "\u{e746}";
/// The brush that selects. Phosphor's `paint-brush`.
pub(super) const BRUSH: &str = "\u{e6f0}";
/// Clippers with a guard. Phosphor's `ruler`.
pub(super) const CLIPPERS: &str = "\u{e6b8}";
/// The comb. Phosphor's `hand-swipe-right`.
pub(super) const COMB: &str = "\u{ec92}";
/// Before and after. Phosphor's `square-split-horizontal`.
pub(super) const COMPARE: &str = "\u{e870}";
/// The cutting plane. Phosphor's `knife`.
pub(super) const CUT: &str = "\u{e636}";
/// The dark theme. Phosphor's `moon`.
pub(super) const DARK: &str = "\u{e330}";
/// Remove from a list. Phosphor's `trash`.
pub(super) const DELETE: &str = "\u{e4a6}";
/// Something is done. Phosphor's `check-circle`.
pub(super) const DONE: &str = "\u{e184}";
/// Dry hair. Phosphor's `hair-dryer`.
pub(super) const DRY: &str = "\u{ea66}";
/// Exercises. Phosphor's `list-checks`.
pub(super) const EXERCISES: &str = "\u{eadc}";
/// Write a groom. Phosphor's `export`.
pub(super) const EXPORT: &str = "\u{eaf0}";
/// The gallery. Phosphor's `squares-four`.
pub(super) const GALLERY: &str = "\u{e464}";
/// The goal of an exercise. Phosphor's `target`.
pub(super) const GOAL: &str = "\u{e47c}";
/// Let hair grow. Phosphor's `plant`.
pub(super) const GROW: &str = "\u{ebae}";
/// Keys and tools. Phosphor's `question`.
pub(super) const HELP: &str = "\u{e3e8}";
/// Hair that is not shown. Phosphor's `eye-slash`.
pub(super) const HIDDEN: &str = "\u{e224}";
/// Hold hair. Phosphor's `paperclip`.
pub(super) const HOLD: &str = "\u{e39a}";
/// The hair that is not selected. Phosphor's `selection-inverse`.
pub(super) const INVERT: &str = "\u{e744}";
/// The language. Phosphor's `translate`.
pub(super) const LANGUAGE: &str = "\u{e4a2}";
/// The lasso that selects. Phosphor's `lasso`.
pub(super) const LASSO: &str = "\u{edc6}";
/// Fingers that lift hair. Phosphor's `hand-arrow-up`.
pub(super) const LIFT: &str = "\u{ee5a}";
/// The light theme. Phosphor's `sun`.
pub(super) const LIGHT: &str = "\u{e472}";
/// Hair that steps leave alone. Phosphor's `lock-simple`.
pub(super) const LOCKED: &str = "\u{e308}";
/// Both sides of the head. Phosphor's `flip-horizontal`.
pub(super) const MIRROR: &str = "\u{ed6a}";
/// One hair alone. Phosphor's `spiral`.
pub(super) const ONE_HAIR: &str = "\u{e9fa}";
/// Open a file. Phosphor's `folder-open`.
pub(super) const OPEN: &str = "\u{e256}";
/// Draw a parting. Phosphor's `line-segment`.
pub(super) const PARTING: &str = "\u{e6d2}";
/// A final picture. Phosphor's `camera`.
pub(super) const PICTURE: &str = "\u{e10e}";
/// Show how it is done. Phosphor's `play`.
pub(super) const PLAY: &str = "\u{e3d0}";
/// Redo. Phosphor's `arrow-clockwise`.
pub(super) const REDO: &str = "\u{e036}";
/// A reference photo. Phosphor's `image`.
pub(super) const REFERENCE: &str = "\u{e2ca}";
/// Let go of held hair. Phosphor's `link-break`.
pub(super) const RELEASE: &str = "\u{e2e4}";
/// Save the scene. Phosphor's `floppy-disk`.
pub(super) const SAVE: &str = "\u{e248}";
/// Scissors. Phosphor's `scissors`.
pub(super) const SCISSORS: &str = "\u{eae0}";
/// A named section. Phosphor's `bookmark-simple`.
pub(super) const SECTION: &str = "\u{e0ea}";
/// The panels with sliders and the history. Phosphor's `sliders-horizontal`.
pub(super) const SETTINGS: &str = "\u{e434}";
/// Share the scene. Phosphor's `share-network`.
pub(super) const SHARE: &str = "\u{e408}";
/// Hair that is shown. Phosphor's `eye`.
pub(super) const SHOWN: &str = "\u{e220}";
/// Turn the head slowly. Phosphor's `arrows-clockwise`.
pub(super) const SPIN: &str = "\u{e094}";
/// Stop. Phosphor's `stop`.
pub(super) const STOP: &str = "\u{e46c}";
/// The tour. Phosphor's `graduation-cap`.
pub(super) const TOUR: &str = "\u{e62c}";
/// Orbit, pan and zoom. Phosphor's `camera-rotate`.
pub(super) const TURN: &str = "\u{e7a4}";
/// Undo. Phosphor's `arrow-counter-clockwise`.
pub(super) const UNDO: &str = "\u{e038}";
/// Hair that steps apply to. Phosphor's `lock-simple-open`.
pub(super) const UNLOCKED: &str = "\u{e30a}";
/// Wet hair. Phosphor's `drop`.
pub(super) const WET: &str = "\u{e210}";

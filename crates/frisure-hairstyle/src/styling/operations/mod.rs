//! What can be done to a hairstyle: one file per operation.
//!
//! To add one, write its file with a struct that implements [`Apply`] and `Default`, and add a line to
//! the list `operations!` below. Its keys in scene files stand in `frisure-scene`, from which text,
//! errors, schema, documentation and the salon's button follow.

mod apply;
mod cut_line;
mod scissors;
mod trim;

use super::selection::Selection;
use crate::spec::InvalidSpec;
use apply::Apply;

/// Declares the operations: the module and the type of each, and its field with the selected wisps, if
/// it has one. The module's name is the operation's name in scenes.
macro_rules! operations {
    ($($(#[$doc:meta])* $module:ident::$Type:ident($($selection:ident)?),)*) => {
        $(mod $module;
        pub use $module::$Type;)*

        /// One operation on a hairstyle.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Operation {
            $($(#[$doc])* $Type($Type),)*
        }

        $(impl From<$Type> for Operation {
            fn from(operation: $Type) -> Self {
                Self::$Type(operation)
            }
        })*

        impl Operation {
            /// The names of all operations.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($module)),*];

            /// Returns its name, as scenes write it.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$Type(_) => stringify!($module),)*
                }
            }

            /// Returns the wisps that it selects; none if it concerns all hair at once.
            #[must_use]
            pub fn selection(&self) -> Option<&Selection> {
                match self {
                    $(Self::$Type(_operation) => None$(.or(Some(&_operation.$selection)))?,)*
                }
            }

            /// The same, to be changed.
            pub fn selection_mut(&mut self) -> Option<&mut Selection> {
                match self {
                    $(Self::$Type(_operation) => None$(.or(Some(&mut _operation.$selection)))?,)*
                }
            }

            pub(super) fn inner(&self) -> &dyn Apply {
                match self {
                    $(Self::$Type(operation) => operation,)*
                }
            }

            pub(super) fn inner_mut(&mut self) -> &mut dyn Apply {
                match self {
                    $(Self::$Type(operation) => operation,)*
                }
            }
        }
    };
}

operations! {
    /// Wets hair. \[paper\] §3.2
    wet::Wet(selection),
    /// Dries hair: the inverse. \[paper\] §3.2
    dry::Dry(selection),
    /// Leaves hair in damp or dry air.
    humidity::Humidity(),
    /// Puts a styling product on hair.
    product::Product(selection),
    /// Cuts hair. \[paper\] §3.2
    cut::Cut(selection),
    /// Lets hair grow. \[paper\] §3.2, §4.1
    grow::Grow(selection),
    /// Drags hair aside, and lets it go unless it is to be held.
    comb::Comb(selection),
    /// Parts hair anew.
    part::Part(),
    /// Winds hair on rollers, and holds it.
    roll::Roll(selection),
    /// Braids hair in three, and holds it.
    braid::Braid(selection),
    /// Winds two locks round each other, and holds them.
    twist::Twist(selection),
    /// Draws hair straight, and holds it.
    straighten::Straighten(selection),
    /// Holds a place of each wisp at a point.
    clip::Clip(selection),
    /// Gathers hair with a hair tie, and holds it.
    tie::Tie(selection),
    /// Lays hair behind the ears.
    tuck::Tuck(selection),
    /// Lets go of held hair.
    release::Release(selection),
}

pub use comb::Direction;
pub use cut_line::{CutLine, Held};
pub use grow::Growth;
pub use tie::TiePlace;
pub use tuck::Sides;

impl Operation {
    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first field that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        self.selection().map_or(Ok(()), Selection::check)?;
        self.inner().check()
    }

    /// Returns the same operation on other wisps; unchanged if it concerns all hair at once.
    #[must_use]
    pub fn on(mut self, selection: Selection) -> Self {
        if let Some(selected) = self.selection_mut() {
            *selected = selection;
        }
        self
    }
}

//! The paper's sentences on heads of hair.

use crate::Table;

/// Each in French and English, and its criterion.
const SENTENCES: [[&str; 3]; 5] = [
    [
        "« … une chevelure complète composée d’une centaine de mèches » (figure 1)",
        "a whole head of hair made of about a hundred wisps",
        "the guides of figure 1 are in a minimum",
    ],
    [
        "« Remarquer en particulier la différence de volume entre les deux coiffures. » (figure 4)",
        "Note in particular the difference in volume between the two hairstyles.",
        "the volume with all collisions is at least 1.1 of that with the head alone; guides are out of the head",
    ],
    [
        "« Enfin, une chevelure mouillée est beaucoup moins volumineuse qu’à sec, à cause de la nature cohésive de l’eau. »",
        "Lastly, wet hair has much less volume than dry hair, because water makes it cling.",
        "the volume of wet hair is at most 0.95 of that of dry hair",
    ],
    [
        "« … les mèches (sur la frange notamment) ont changé de forme du fait de la coupe : les boucles ont “remonté”, \
         comme dans la réalité. » (figure 5)",
        "the wisps, of the fringe above all, have changed their shape because of the cut: the curls have sprung up, as in \
         reality",
        "the fringe hangs at least 10 mm lower when it is wetted, and springs up by at least 10 mm when it is dried after \
         the cut",
    ],
    [
        "« … images réelles de cheveux (a) raides, (b) bouclés et (c) crépus. À gauche : résultats synthétiques \
         correspondants » (figure 7)",
        "real pictures of (a) straight, (b) curly and (c) frizzy hair; on the left the corresponding synthetic results",
        "hair hangs less and less, and is packed less and less densely, from (a) to (c): our interpretation of the pictures",
    ],
];

pub(super) fn table() -> Table {
    let mut table = Table::new(
        "Sentences of the paper, and their criteria",
        &["the paper", "in English", "criterion"],
    );
    for row in SENTENCES {
        table.row(row.map(str::to_owned));
    }
    table
}

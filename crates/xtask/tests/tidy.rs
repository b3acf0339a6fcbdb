//! The rules about the tree that no compiler checks: `cargo xtask tidy` prints what breaks them.

use std::path::Path;

#[test]
fn the_tree_keeps_the_rules() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let broken = xtask::tidy::broken(&root).expect("the tree can be read");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

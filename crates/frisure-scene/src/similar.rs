//! Similar words, for hints about misspelt ones.

/// Returns the known word that is most similar to an unknown one, if one is similar.
pub(crate) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    near(word, known).map(|(_, known)| known)
}

/// Longest word that is compared (bytes); the longest known one has a third of it.
const LONGEST: usize = 100;

/// The same, with the Damerau–Levenshtein distance between the two.
pub(crate) fn near<'a>(
    word: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<(usize, &'a str)> {
    // The distance takes time and memory in proportion to both lengths.
    if word.len() > LONGEST {
        return None;
    }
    known
        .into_iter()
        .map(|k| (strsim::damerau_levenshtein(word, k), k))
        .min_by_key(|&(distance, _)| distance)
        // With more than a third of its letters wrong, it is another word.
        .filter(|&(distance, k)| distance <= 1 + k.chars().count() / 3)
}

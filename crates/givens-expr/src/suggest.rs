//! The name that was probably meant.

/// Longer names are not compared: their distance would say nothing.
const MAX_LENGTH: usize = 64;

/// The candidate nearest to `name`, if one is near enough to have been meant: equal but for case, or within one
/// exchange, omission, insertion or transposition for each three letters. The first of equals wins.
///
/// ```
/// use givens_expr::suggest;
/// assert_eq!(suggest("bearnig", ["range", "bearing"].into_iter()), Some("bearing"));
/// assert_eq!(suggest("VX", ["x", "vx"].into_iter()), Some("vx"));
/// assert_eq!(suggest("altitude", ["x", "vx"].into_iter()), None);
/// ```
pub fn suggest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = letters(name)?;
    let near = candidates.filter_map(|candidate| {
        let letters = letters(candidate)?;
        let distance = distance(&wanted, &letters);
        (3 * distance <= wanted.len().max(letters.len()).max(3) && distance < letters.len())
            .then_some((distance, candidate))
    });
    near.min_by_key(|&(distance, _)| distance).map(|(_, candidate)| candidate)
}

fn letters(name: &str) -> Option<Vec<char>> {
    let letters: Vec<char> = name.chars().take(MAX_LENGTH + 1).flat_map(char::to_lowercase).collect();
    (letters.len() <= MAX_LENGTH).then_some(letters)
}

/// Exchanges, omissions, insertions and transpositions of neighbours that lead from `a` to `b`.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut before_last: Vec<usize> = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let exchange = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = exchange.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before_last[j - 2] + 1);
            }
        }
        before_last = last;
        last = row;
    }
    last[b.len()]
}

//! Numbers, lists and suggestions in messages.

/// How many valid names a message lists at most.
const LISTED: usize = 24;

/// "did you mean `x`? one of a, b, c", the suggestion only when one is close.
#[must_use]
pub fn one_of<'a>(wrong: &str, names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    let list = list(&names);
    match nearest(wrong, names.iter().copied()) {
        Some(name) => format!("did you mean `{name}`? One of {list}"),
        None if names.is_empty() => "nothing: there are none".to_string(),
        None => format!("one of {list}"),
    }
}

/// "a, b, c", cut when long.
#[must_use]
pub fn list(names: &[&str]) -> String {
    let shown = names[..names.len().min(LISTED)].join(", ");
    if LISTED < names.len() { format!("{shown}, … ({} in all)", names.len()) } else { shown }
}

/// The name closest to a wrong one, if it is close enough to be meant.
#[must_use]
pub fn nearest<'a>(wrong: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // Long junk is nobody's misspelling, and the distance costs the product of the lengths.
    if 64 < wrong.len() {
        return None;
    }
    let plain = |text: &str| text.to_lowercase().replace(['-', ' '], "_");
    let wrong = plain(wrong);
    let most = (wrong.chars().count() / 3).max(1);
    names
        .map(|name| (strsim::damerau_levenshtein(&plain(name), &wrong), name))
        .filter(|(distance, _)| *distance <= most)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// A number with the fewest digits that read back as the same: `60`, `0.5`, `1e300`.
#[must_use]
pub fn number(x: f64) -> String {
    let shown = format!("{x:?}");
    shown.strip_suffix(".0").map_or_else(|| shown.clone(), str::to_string)
}

/// `[0, 0, -9.80665]`.
#[must_use]
pub fn numbers(list: &[f64]) -> String {
    format!("[{}]", list.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", "))
}

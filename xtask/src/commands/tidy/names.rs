//! One name for one thing: what docs/reference/naming.md tells users, as far as a program can check it.

use std::collections::BTreeMap;

use crate::source::{code_only, without_tests};
use crate::workspace::{Workspace, read};

/// Words that have another name here, and that name.
const WORDS: &[(&str, &str)] = &[
    ("NonFinite", "NotFinite"),
    ("DimensionMismatch", "WrongLength"),
    ("moment_of_momentum", "angular_momentum"),
    ("qdot", "v"),
];

/// Public types whose name stands more than once, each with the reason.
const SHARED_NAMES: &[(&str, &str)] = &[
    ("BadPoint", "a bad point with the error of its own crate"),
    ("ConstrainedMotion", "motion under constraints of velocity and of position: modules of one crate"),
    ("Constraints", "constraints of a mechanism and of a material"),
    ("Ending", "how a run and how a quadrature ended"),
    ("Estimate", "a value with its error; in `fit` an estimated parameter"),
    ("Event", "an event of space-time and an event of a run"),
    ("Field", "a field of rates and a field in space"),
    ("Following", "the spatial following of a material field and the following of a history"),
    ("Front", "of characteristics and of rays"),
    ("Generator", "of a cone and of a group"),
    ("Gravitation", "a field for integrators, and its bodies with their names and states"),
    ("History", "of a material, and the record of a run"),
    ("Integral", "a value with its bound; `fluids` adds the law"),
    ("Invariants", "of a strain and of a motion"),
    ("Mode", "of relaxation and of a specimen"),
    ("Motion", "of a body, of a particle and of a system"),
    ("Options", "of a fit and of a recovery"),
    ("Outcome", "of a search and of a run"),
    ("PostNewtonian", "the term of a field, and the request for it"),
    ("Potential", "of forces, and of a circuit of stresses"),
    ("RayField", "of two kinds of characteristics"),
    ("Report", "of a batch, of a run and of a check"),
    ("Residual", "of a balance and of an action"),
    ("RestState", "under a pressure in an oscillation, and of a laminated body without loads"),
    ("SampledMotion", "of a body and of a system"),
    ("Search", "of roots and of counterexamples"),
    ("Separable", "a Hamiltonian and a field of rates"),
    ("Series", "of terms and of points"),
    ("Source", "of values in a batch and of wave fronts"),
    ("Stability", "of a law and of an equilibrium"),
    ("State", "of a run and of a fit"),
    ("Torsion", "the twisting of a tube and the tensor of a connection"),
    ("Weighting", "of solids and of fluids"),
    ("Workspace", "each algorithm has its own"),
];

/// Every violation.
pub(super) fn check(workspace: &Workspace) -> Vec<String> {
    let (mut problems, mut types) = (Vec::new(), BTreeMap::<String, Vec<String>>::new());
    for path in workspace.files() {
        let place = workspace.relative(&path).to_string();
        let parts: Vec<_> = place.split('/').collect();
        let ["crates", folder, "src", ..] = parts[..] else { continue };
        if path.extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        let code = without_tests(&code_only(&read(&path).unwrap_or_default()));
        for (line, text) in (1..).zip(code.lines()) {
            for (word, name) in WORDS.iter().filter(|(word, _)| has_word(text, word)) {
                problems.push(format!("{place}:{line}: `{word}` is called `{name}`"));
            }
            if let Some(name) = public_type(text).filter(|_| {
                !matches!(folder, "testkit" | "document" | "charts" | "measured" | "forward" | "scene" | "cli")
            }) {
                types.entry(name.to_owned()).or_default().push(format!("{place}:{line}"));
            }
        }
    }
    for (name, places) in &types {
        let is_excused = SHARED_NAMES.iter().any(|(shared, _)| shared == name);
        if 1 < places.len() && !is_excused {
            problems.push(format!("public type `{name}` stands more than once: {}", places.join(", ")));
        } else if places.len() == 1 && is_excused {
            problems.push(format!("`{name}` stands once and needs no excuse in `tidy`"));
        }
    }
    problems
}

/// Whether `word` begins a word of the line: `NonFinite` is in `NonFiniteRate`.
fn has_word(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(at, _)| {
        let is_start = !line[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let after = line[at + word.len()..].chars().next();
        is_start && after.is_none_or(|c| !(c.is_lowercase() || c == '_'))
    })
}

/// The name in `pub struct Name`, `pub enum Name` or `pub trait Name`.
fn public_type(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("pub ")?;
    let rest = ["struct ", "enum ", "trait "].iter().find_map(|kind| rest.strip_prefix(kind))?;
    let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
    (0 < end).then(|| &rest[..end])
}

#[cfg(test)]
mod tests {
    use super::{has_word, public_type};

    #[test]
    fn words_are_found_where_they_begin() {
        assert!(has_word("Error::NonFiniteRate { index }", "NonFinite"));
        assert!(has_word("fn rate(qdot: &[f64])", "qdot"));
        assert!(!has_word("let qdots = 1;", "qdot"));
        assert!(!has_word("IsNonFinite", "NonFinite"));
    }

    #[test]
    fn public_types_have_names() {
        assert_eq!(public_type("pub struct Motion<'a> {"), Some("Motion"));
        assert_eq!(public_type("pub enum Role {"), Some("Role"));
        assert_eq!(public_type("pub struct $name"), None);
        assert_eq!(public_type("pub(crate) struct Hidden;"), None);
    }
}

//! Names of columns of measured stresses.

use crate::sheet::Sheet;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Mode,
    Specimen,
    Weight,
    Stretch,
    Strain,
    LogarithmicStrain,
    Shear,
    Stress,
    TrueStress,
    FirstStretch,
    SecondStretch,
    FirstStress,
    SecondStress,
    FirstTrueStress,
    SecondTrueStress,
    /// F, S or the type of the stress of the layout by components.
    Component,
}

const WORDS: [(Quantity, &[&str]); 15] = [
    (Quantity::Mode, &["mode", "test", "test type", "loading", "deformation mode"]),
    (Quantity::Specimen, &["specimen", "sample", "specimen id", "sample id"]),
    (Quantity::Weight, &["weight"]),
    (Quantity::Stretch, &["stretch", "stretch ratio", "extension ratio", "lambda", "λ"]),
    (Quantity::Strain, &["strain", "engineering strain", "nominal strain", "epsilon", "ε"]),
    (Quantity::LogarithmicStrain, &["true strain", "logarithmic strain", "hencky strain", "log strain"]),
    (Quantity::Shear, &["shear", "amount of shear", "shear strain", "gamma", "γ"]),
    (
        Quantity::Stress,
        &["stress", "nominal stress", "engineering stress", "first piola stress", "pk1", "p", "eng stress"],
    ),
    (Quantity::TrueStress, &["true stress", "cauchy stress", "cauchy", "sigma", "σ"]),
    (Quantity::FirstStretch, &["lambda1", "lambda 1", "λ1", "λ₁", "stretch1", "stretch 1"]),
    (Quantity::SecondStretch, &["lambda2", "lambda 2", "λ2", "λ₂", "stretch2", "stretch 2"]),
    (Quantity::FirstStress, &["p1", "p 1", "p₁", "stress1", "stress 1", "nominal stress 1"]),
    (Quantity::SecondStress, &["p2", "p 2", "p₂", "stress2", "stress 2", "nominal stress 2"]),
    (Quantity::FirstTrueStress, &["sigma1", "sigma 1", "σ1", "σ₁", "t1", "true stress 1", "cauchy stress 1"]),
    (Quantity::SecondTrueStress, &["sigma2", "sigma 2", "σ2", "σ₂", "t2", "true stress 2", "cauchy stress 2"]),
];

/// What a plain name means.
pub(super) fn quantity(plain: &str) -> Option<Quantity> {
    let is_component = |plain: &str| {
        let mut letters = plain.chars();
        matches!(letters.next(), Some('f' | 's'))
            && letters.clone().count() == 2
            && letters.all(|c| ('1'..='3').contains(&c))
    };
    let named = WORDS.iter().find(|(_, words)| words.contains(&plain)).map(|(quantity, _)| *quantity);
    named.or_else(|| (plain == "stress type" || is_component(plain)).then_some(Quantity::Component))
}

/// Whether a plain name is that of a known column.
pub(super) fn is_known(plain: &str) -> bool {
    quantity(plain).is_some()
}

/// The first column of a quantity.
pub(super) fn find(sheet: &Sheet, wanted: Quantity) -> Option<usize> {
    sheet.columns(&|plain| quantity(plain) == Some(wanted)).next()
}

/// "columns not used: …", if there are such.
pub(super) fn not_used(sheet: &Sheet, used: &[usize]) -> Option<String> {
    let others =
        sheet.headings.iter().enumerate().filter(|(at, heading)| !used.contains(at) && !heading.written.is_empty());
    let others: Vec<String> = others.map(|(_, heading)| format!("`{}`", heading.written)).collect();
    (!others.is_empty()).then(|| format!("columns not used: {}", others.join(", ")))
}

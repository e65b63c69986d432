//! Measures of stress and tangent, and orders of components.

use piola::tensor::MajorSymmetric;
use piola::tensor::voigt::{Abaqus, Classical, Piola, StiffnessMatrix, VoigtOrder};

/// A measure of stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StressMeasure {
    /// T, Pa: force per area of the deformed body.
    Cauchy,
    /// P, Pa: force per area of the reference.
    FirstPiola,
    /// S = F⁻¹ P, Pa.
    SecondPiola,
}

impl StressMeasure {
    /// The measures by name.
    pub const ALL: [(&'static str, Self); 3] =
        [("cauchy", Self::Cauchy), ("first_piola", Self::FirstPiola), ("second_piola", Self::SecondPiola)];
}

/// A tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TangentMeasure {
    /// ∂P/∂F, Pa: 9×9 numbers, row 3 i + A and column 3 j + B.
    FirstPiola,
    /// ∂S/∂E, Pa: 6×6 numbers.
    Material,
    /// c/J, Pa, which takes D to Truesdell's rate of T: 6×6 numbers.
    Truesdell,
    /// Pa: takes D to Jaumann's rate of τ, over J; the `DDSDDE` of Abaqus: 6×6 numbers.
    Jaumann,
}

impl TangentMeasure {
    /// The tangents by name.
    pub const ALL: [(&'static str, Self); 4] = [
        ("first_piola", Self::FirstPiola),
        ("material", Self::Material),
        ("truesdell", Self::Truesdell),
        ("jaumann", Self::Jaumann),
    ];

    /// Numbers a point.
    #[must_use]
    pub const fn numbers(self) -> usize {
        match self {
            Self::FirstPiola => 81,
            Self::Material | Self::Truesdell | Self::Jaumann => 36,
        }
    }
}

/// The order of the six pairs of indices in 6×6 numbers. These multiply engineering shears 2 `D_ij` as they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VoigtNumbering {
    /// 11, 22, 33, 12, 23, 13; also that of Ansys and of VUMAT.
    Piola,
    /// 11, 22, 33, 12, 13, 23.
    Abaqus,
    /// 11, 22, 33, 23, 13, 12.
    Classical,
}

impl VoigtNumbering {
    /// The orders by name.
    pub const ALL: [(&'static str, Self); 3] =
        [("piola", Self::Piola), ("abaqus", Self::Abaqus), ("classical", Self::Classical)];

    /// Where the 6×6 numbers by rows stand among the 21 components.
    pub(crate) fn places(self) -> [usize; 36] {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers below 21")]
        fn places<O: VoigtOrder>() -> [usize; 36] {
            let numbered = MajorSymmetric { components: core::array::from_fn(|k| k as f64) };
            let entries = StiffnessMatrix::<f64, O>::of(&numbered).entries;
            core::array::from_fn(|k| entries[k / 6][k % 6] as usize)
        }
        match self {
            Self::Piola => places::<Piola>(),
            Self::Abaqus => places::<Abaqus>(),
            Self::Classical => places::<Classical>(),
        }
    }
}

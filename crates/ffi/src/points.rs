//! Stresses and tangents of a law at many points, from and to the caller's memory.
//!
//! The law's own formula gives P and the upper triangle of ∂P/∂F in lanes. A second pass over blocks of points converts them
//! to other measures. Nothing is allocated unless points are bad.
//!
//! ```
//! use piola::solids::SaintVenantKirchhoff;
//! use piola_ffi::points::{StressMeasure, TangentMeasure, stress, tangent};
//! let law = SaintVenantKirchhoff::new(1.0, 2.0)?.into();
//! let f = [[2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; 100]; // E₁₁ = 3/2
//! let mut t = [[0.0; 9]; 100];
//! stress(&law, StressMeasure::Cauchy, &f, &mut t)?;
//! assert_eq!(t[7][0], 15.0); // F₁₁² (λ + 2 μ) E₁₁/J
//! let mut c = vec![0.0; 3600];
//! tangent(&law, TangentMeasure::Material, VoigtNumbering::Piola, &f, &mut c)?;
//! assert_eq!(c[0], 5.0); // λ + 2 μ
//! # use piola_ffi::points::VoigtNumbering;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use piola::batch::{BatchError, Gradients, Quantity, Request, evaluate};
use piola::continuum::DeformationGradient;
use piola::laws::kinds;
use piola::solids::batch::{BadPoint, first_piola, first_piola_and_tangent};
use piola::solids::{AnySolid, Hyperelastic, SolidVisitor, SolidsError, batch};
use piola::tensor::MajorSymmetric;
use piola::tensor::voigt::{Abaqus, Classical, Piola, StiffnessMatrix, VoigtOrder};

use crate::FfiError;
use crate::conversions::{
    CauchyOfFirstPiola, JaumannOfFirstPiola, MaterialOfFirstPiola, SecondPiolaOfFirstPiola, TruesdellOfFirstPiola,
    all_nine, square,
};
use crate::error::check_length;

/// Points of a block of the second pass. Their numbers fit the second-level cache.
const BLOCK: usize = 128;

/// Points of a small block: single points do not pay for a large one.
const SMALL_BLOCK: usize = 4;

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

    /// The 6×6 numbers by rows, of the upper triangle.
    fn matrix(self, components: [f64; 21]) -> [[f64; 6]; 6] {
        fn entries<O: VoigtOrder>(components: [f64; 21]) -> [[f64; 6]; 6] {
            StiffnessMatrix::<f64, O>::of(&MajorSymmetric { components }).entries
        }
        match self {
            Self::Piola => entries::<Piola>(components),
            Self::Abaqus => entries::<Abaqus>(components),
            Self::Classical => entries::<Classical>(components),
        }
    }
}

/// Calls a visitor with the kind of the law: laws of a kind share one kernel, so that twelve are compiled instead of seventeen.
fn visit<V: SolidVisitor<Output = Result<(), SolidsError>>>(law: &AnySolid, visitor: V) -> Result<(), FfiError> {
    let Some(result) = kinds::visit(law, visitor) else {
        // A law that was added to the enum and has no kind yet: no numbers rather than wrong ones.
        let message = "it is not offered to other languages".to_owned();
        return Err(FfiError::Unreadable { what: "law of a solid", message });
    };
    Ok(result?)
}

/// Whether a law is linear elasticity, which knows no difference between the measures: each stress is σ, each tangent of 36
/// numbers ∂σ/∂ε.
const fn is_linear(law: &AnySolid) -> bool {
    matches!(law, AnySolid::LinearElastic(_) | AnySolid::AnisotropicLinear(_))
}

/// P at each point.
struct FirstPiolaAt<'a>(&'a [[f64; 9]], &'a mut [[f64; 9]]);

impl SolidVisitor for FirstPiolaAt<'_> {
    type Output = Result<(), SolidsError>;

    fn visit<L: Hyperelastic + Sync>(self, law: &L) -> Self::Output {
        batch::evaluate(Gradients(self.0), first_piola(law, &mut self.1[..])).map(drop)
    }
}

/// P and the upper triangle of ∂P/∂F at each point.
struct BothAt<'a>(&'a [[f64; 9]], &'a mut [[f64; 9]], &'a mut [[f64; 45]]);

impl SolidVisitor for BothAt<'_> {
    type Output = Result<(), SolidsError>;

    fn visit<L: Hyperelastic + Sync>(self, law: &L) -> Self::Output {
        let request = first_piola_and_tangent(law, &mut self.1[..], &mut self.2[..]);
        batch::evaluate(Gradients(self.0), request).map(drop)
    }
}

/// Bad points of several blocks.
#[derive(Default)]
struct Bad {
    count: usize,
    first: Option<BadPoint>,
}

impl Bad {
    /// Notes bad points of the block that begins at `start`; other errors end the evaluation.
    fn note(&mut self, start: usize, result: Result<(), FfiError>) -> Result<(), FfiError> {
        match result {
            Err(FfiError::Solids(SolidsError::BadPoints { points, .. })) => {
                self.count += points.len();
                let first = points.into_iter().next();
                self.first = self.first.take().or(first.map(|point| BadPoint { index: start + point.index, ..point }));
                Ok(())
            }
            other => other,
        }
    }

    fn finish(self, count: usize) -> Result<(), FfiError> {
        match self.first {
            None => Ok(()),
            Some(BadPoint { index, error, .. }) => Err(FfiError::BadPoints { bad: self.count, count, index, error }),
        }
    }
}

/// Converts the numbers of a block; points that the law refused hold NaN and stay NaN.
fn convert<Q: Quantity<I, K, Input = (), Output = Q>, const I: usize, const K: usize>(
    quantity: Q,
    f: &[[f64; 9]],
    from: &[[f64; I]],
    to: &mut [[f64; K]],
) -> Result<(), SolidsError> {
    match evaluate(Gradients(f), Request::new(quantity, from, to)) {
        Ok(_) | Err(BatchError::BadPoints { .. }) => Ok(()),
        Err(other) => Err(other.into()),
    }
}

/// The stress at each point, nine components by rows. Of a law of linear elasticity it is σ in every measure.
///
/// | argument | meaning | shape | unit |
/// |---|---|---|---|
/// | `f` | F by rows | n × 9 | – |
/// | `out` | the stress by rows | n × 9 | Pa |
///
/// # Errors
/// [`FfiError::WrongLength`] unless `out` has as many points as `f`, before anything is computed;
/// [`FfiError::BadPoints`] where F is not finite, 0 < det F fails or the law has no answer: the numbers of these points are
/// NaN, those of all others are written.
///
/// # Accuracy
/// That of the law's P; T and S add 8 ulp of |P| |F|/J and of |F⁻¹| |P|.
///
/// # Example
/// See the [module](self).
pub fn stress(law: &AnySolid, measure: StressMeasure, f: &[[f64; 9]], out: &mut [[f64; 9]]) -> Result<(), FfiError> {
    check_length("stresses", f.len(), out.len())?;
    let mut bad = Bad::default();
    bad.note(0, visit(law, FirstPiolaAt(f, out)))?;
    if measure != StressMeasure::FirstPiola && !is_linear(law) {
        let mut converted = [[0.0; 6]; BLOCK];
        for (f, out) in f.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
            let converted = &mut converted[..f.len()];
            if measure == StressMeasure::Cauchy {
                convert(CauchyOfFirstPiola, f, out, converted)?;
            } else {
                convert(SecondPiolaOfFirstPiola, f, out, converted)?;
            }
            for (out, converted) in out.iter_mut().zip(converted) {
                *out = all_nine(*converted);
            }
        }
    }
    bad.finish(f.len())
}

/// W(F) − W(1) at each point, J/m³.
///
/// Points are computed one after the other, not in lanes: a sum of energies is wanted once where stresses are wanted often, and
/// energies in lanes would lengthen the build of this library.
///
/// # Errors
/// As [`stress`].
///
/// # Accuracy
/// That of the law's energy.
///
/// # Example
/// ```
/// use piola::solids::SaintVenantKirchhoff;
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?.into();
/// let mut w = [0.0];
/// piola_ffi::points::energy(&law, &[[2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]], &mut w)?;
/// assert_eq!(w[0], 5.625); // ½ (λ + 2 μ) E₁₁², E₁₁ = 3/2
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn energy(law: &AnySolid, f: &[[f64; 9]], out: &mut [f64]) -> Result<(), FfiError> {
    check_length("energies", f.len(), out.len())?;
    let mut bad = Bad::default();
    for (index, (f, out)) in f.iter().zip(out).enumerate() {
        match energy_at(law, f) {
            Ok(energy) => *out = energy,
            Err(error) => {
                *out = f64::NAN;
                bad.count += 1;
                bad.first.get_or_insert(BadPoint { index, error });
            }
        }
    }
    bad.finish(f.len())
}

fn energy_at(law: &AnySolid, f: &[f64; 9]) -> Result<f64, SolidsError> {
    let [a, b, c, d, e, g, h, i, j] = *f;
    let deformation = DeformationGradient::from_rows([[a, b, c], [d, e, g], [h, i, j]])?;
    law.check(&deformation)?;
    let energy = law.energy(&deformation);
    if energy.is_finite() { Ok(energy) } else { Err(SolidsError::Overflow { answer: "energy" }) }
}

/// The tangent at each point, by rows: 81 numbers for ∂P/∂F, 36 in the order of `numbering` for the others. Of a law of linear
/// elasticity it is ∂σ/∂ε in every measure.
///
/// # Errors
/// As [`stress`]; `out` must hold [`TangentMeasure::numbers`] for each point.
///
/// # Accuracy
/// That of the law's ∂P/∂F, and the roundings of the conversions, 24 ulp of |F|⁴ |F⁻¹|² (|∂P/∂F| + |S|)/J.
///
/// # Example
/// See the [module](self).
pub fn tangent(
    law: &AnySolid,
    measure: TangentMeasure,
    numbering: VoigtNumbering,
    f: &[[f64; 9]],
    out: &mut [f64],
) -> Result<(), FfiError> {
    check_length("tangents", f.len().saturating_mul(measure.numbers()), out.len())?;
    let request = Wanted { stress: None, tangent: (measure, numbering) };
    if f.len() <= SMALL_BLOCK {
        in_blocks::<SMALL_BLOCK>(law, request, f, &mut [], out)
    } else {
        in_blocks::<BLOCK>(law, request, f, &mut [], out)
    }
}

/// Stress and tangent at each point, the law evaluated once for both: see [`stress`] and [`tangent`].
///
/// # Errors
/// As theirs.
///
/// # Example
/// See the [module](self).
pub fn stress_and_tangent(
    law: &AnySolid,
    (stress, tangent): (StressMeasure, TangentMeasure),
    numbering: VoigtNumbering,
    f: &[[f64; 9]],
    (stresses, tangents): (&mut [[f64; 9]], &mut [f64]),
) -> Result<(), FfiError> {
    check_length("stresses", f.len(), stresses.len())?;
    check_length("tangents", f.len().saturating_mul(tangent.numbers()), tangents.len())?;
    let request = Wanted { stress: Some(stress), tangent: (tangent, numbering) };
    if f.len() <= SMALL_BLOCK {
        in_blocks::<SMALL_BLOCK>(law, request, f, stresses, tangents)
    } else {
        in_blocks::<BLOCK>(law, request, f, stresses, tangents)
    }
}

/// What is computed beside P and ∂P/∂F.
#[derive(Clone, Copy)]
struct Wanted {
    stress: Option<StressMeasure>,
    tangent: (TangentMeasure, VoigtNumbering),
}

/// The points, N at a time; `stresses` is empty where no stress is wanted.
fn in_blocks<const N: usize>(
    law: &AnySolid,
    wanted: Wanted,
    f: &[[f64; 9]],
    stresses: &mut [[f64; 9]],
    tangents: &mut [f64],
) -> Result<(), FfiError> {
    let mut block = Block::<N>::new();
    let mut bad = Bad::default();
    let (measure, numbering) = wanted.tangent;
    let mut stresses = stresses.chunks_mut(N);
    for (index, (f, tangents)) in f.chunks(N).zip(tangents.chunks_mut(N * measure.numbers())).enumerate() {
        bad.note(index * N, block.law(law, f))?;
        if let (Some(measure), Some(stresses)) = (wanted.stress, stresses.next()) {
            block.stress(measure, f, stresses)?;
        }
        block.tangent(measure, numbering, f, tangents)?;
    }
    bad.finish(f.len())
}

/// Memory for a block of points, on the stack.
struct Block<const N: usize> {
    is_linear: bool,
    stress: [[f64; 9]; N],
    triangle: [[f64; 45]; N],
    both: [[f64; 54]; N],
    six: [[f64; 6]; N],
    tangent: [[f64; 21]; N],
}

impl<const N: usize> Block<N> {
    const fn new() -> Self {
        Self {
            is_linear: false,
            stress: [[0.0; 9]; N],
            triangle: [[0.0; 45]; N],
            both: [[0.0; 54]; N],
            six: [[0.0; 6]; N],
            tangent: [[0.0; 21]; N],
        }
    }

    /// Evaluates the law.
    fn law(&mut self, law: &AnySolid, f: &[[f64; 9]]) -> Result<(), FfiError> {
        let n = f.len();
        let result = visit(law, BothAt(f, &mut self.stress[..n], &mut self.triangle[..n]));
        for (both, (stress, triangle)) in self.both.iter_mut().zip(self.stress.iter().zip(&self.triangle)).take(n) {
            both[..9].copy_from_slice(stress);
            both[9..].copy_from_slice(triangle);
        }
        self.is_linear = is_linear(law);
        if self.is_linear {
            // ∂σ/∂ε is ∂P/∂F itself: there is no stress to take off.
            for both in &mut self.both[..n] {
                both[..9].fill(0.0);
            }
        }
        result
    }

    fn stress(&mut self, measure: StressMeasure, f: &[[f64; 9]], out: &mut [[f64; 9]]) -> Result<(), SolidsError> {
        let n = f.len();
        if self.is_linear {
            out.copy_from_slice(&self.stress[..n]);
            return Ok(());
        }
        match measure {
            StressMeasure::FirstPiola => {
                out.copy_from_slice(&self.stress[..n]);
                return Ok(());
            }
            StressMeasure::Cauchy => convert(CauchyOfFirstPiola, f, &self.stress[..n], &mut self.six[..n])?,
            StressMeasure::SecondPiola => convert(SecondPiolaOfFirstPiola, f, &self.stress[..n], &mut self.six[..n])?,
        }
        for (out, six) in out.iter_mut().zip(&self.six) {
            *out = all_nine(*six);
        }
        Ok(())
    }

    fn tangent(
        &mut self,
        measure: TangentMeasure,
        numbering: VoigtNumbering,
        f: &[[f64; 9]],
        out: &mut [f64],
    ) -> Result<(), SolidsError> {
        let n = f.len();
        let (both, tangent) = (&self.both[..n], &mut self.tangent[..n]);
        let still = [[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; N];
        let f = if self.is_linear { &still[..n] } else { f };
        match measure {
            TangentMeasure::FirstPiola => {
                for (out, both) in out.chunks_mut(81).zip(both) {
                    out.copy_from_slice(&square(both));
                }
                return Ok(());
            }
            TangentMeasure::Material => convert(MaterialOfFirstPiola, f, both, tangent)?,
            TangentMeasure::Truesdell => convert(TruesdellOfFirstPiola, f, both, tangent)?,
            TangentMeasure::Jaumann => convert(JaumannOfFirstPiola, f, both, tangent)?,
        }
        for (out, tangent) in out.chunks_mut(36).zip(tangent) {
            out.copy_from_slice(numbering.matrix(*tangent).as_flattened());
        }
        Ok(())
    }
}

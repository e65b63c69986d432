//! Stress and tangent of any law in stages over blocks of points: what the law says, then a composition for all laws of a kind.
//!
//! ```text
//! F → I₁, I₂, J → slopes, curvatures → P, ∂P/∂F      laws of invariants
//! F → S, ∂S/∂E                       → P, ∂P/∂F      laws of strain
//! F → λ, frames, β, ∂β/∂ ln λ        → P, ∂P/∂F      laws of principal stretches
//! F                                  → P, ∂P/∂F      linear elasticity
//! P, ∂P/∂F → T, S; ∂S/∂E, c/J, Jaumann's tangent     all
//! ```
//! A stage is compiled once for each set of instructions, so that the composition is not compiled into a kernel for each law and
//! request. At most [`MOST`] blocks pass together: their numbers, up to 66 kB, stay in the second-level cache.

use piola::continuum::DeformationGradient;
use piola::laws::internal::composition;
use piola::laws::kinds::{LawOfInvariants, LawOfStrain, LawOfStretches};
use piola::numerics::{LaneKernel, Lanes, Mask, Real, dispatch_lanes};
use piola::solids::internal::composition::{composed, in_frames};
use piola::solids::internal::first_piola_numbers;
use piola::solids::internal::packed::{self, joined};
use piola::solids::invariant::{Curvatures, InvariantEnergy, Invariants, Slopes};
use piola::solids::stretch::StretchEnergy;
use piola::solids::{
    AnisotropicLinear, AnySolid, AnyVolumetric, Hyperelastic, IsochoricOgden, LinearElastic, SolidsError,
};
use piola::tensor::internal::rows::product;
use piola::tensor::{MajorSymmetric, Symmetric};

/// Points of a block: as many as the widest registers have lanes.
pub(crate) const WIDTH: usize = 8;

/// One number of the points of a block.
pub(crate) type Number = [f64; WIDTH];

/// A computation of a stage: from F and I numbers to O numbers at each point.
pub(crate) trait Stage<const I: usize, const O: usize> {
    /// Computes; to be marked `#[cfg_attr(not(debug_assertions), inline(always))]`, as everything that it calls.
    fn at<T: Real>(&self, deformation: &DeformationGradient<T>, given: [T; I]) -> [T; O];
}

/// A stage at the points of blocks.
struct Pass<'a, S, const I: usize, const O: usize> {
    stage: &'a S,
    points: usize,
    deformations: &'a [[Number; 9]],
    given: &'a [Number],
    answers: &'a mut [[Number; O]],
}

impl<S: Stage<I, O>, const I: usize, const O: usize> LaneKernel for Pass<'_, S, I, O> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) {
        let parts = WIDTH / N;
        for part in 0..self.points.div_ceil(N) {
            let (block, part) = (part / parts, part % parts);
            let [a, b, c, d, e, f, g, h, i] = load::<9, N>(&self.deformations[block], part);
            let deformation = DeformationGradient::trusted([[a, b, c], [d, e, f], [g, h, i]]);
            let Some(given) = self.given[block * I..].first_chunk::<I>() else { return };
            let answer = self.stage.at(&deformation, load::<I, N>(given, part));
            store(&answer, &mut self.answers[block], part);
        }
    }
}

/// The lanes of a part of a block.
#[cfg_attr(not(debug_assertions), inline(always))]
fn load<const K: usize, const N: usize>(block: &[Number; K], part: usize) -> [Lanes<f64, N>; K] {
    let mut lanes = [Lanes([0.0; N]); K];
    let mut k = 0;
    while k < K {
        lanes[k] = Lanes(block[k].as_chunks().0[part]);
        k += 1;
    }
    lanes
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn store<const K: usize, const N: usize>(lanes: &[Lanes<f64, N>; K], block: &mut [Number; K], part: usize) {
    let mut k = 0;
    while k < K {
        block[k].as_chunks_mut().0[part] = lanes[k].0;
        k += 1;
    }
}

/// Runs a stage with the lanes of this machine. Buffers hold [`WIDTH`] points a block, I and O numbers each.
pub(crate) fn run<S: Stage<I, O>, const I: usize, const O: usize>(
    stage: &S,
    points: usize,
    deformations: &[[Number; 9]],
    given: &[Number],
    answers: &mut [Number],
) {
    let answers = answers.as_chunks_mut().0;
    dispatch_lanes::<_, 2, 4, 8>(Pass { stage, points, deformations, given, answers });
}

/// Blocks that pass through the stages together.
pub(crate) const MOST: usize = 8;

/// A law by its kind.
pub(crate) enum Kind<'a> {
    Invariants(LawOfInvariants<'a>),
    Strain(LawOfStrain<'a>),
    Stretches(LawOfStretches<'a>),
    Isochoric(&'a IsochoricOgden<AnyVolumetric>),
    Linear(Linear<'a>),
}

impl<'a> Kind<'a> {
    /// None for a law that has no kind yet.
    pub(crate) fn of(solid: &'a AnySolid) -> Option<Self> {
        if let Some(law) = LawOfInvariants::of(solid) {
            return Some(Self::Invariants(law));
        }
        if let Some(law) = LawOfStrain::of(solid) {
            return Some(Self::Strain(law));
        }
        if let Some(law) = LawOfStretches::of(solid) {
            return Some(Self::Stretches(law));
        }
        match solid {
            AnySolid::IsochoricOgden(law) => Some(Self::Isochoric(law)),
            AnySolid::LinearElastic(law) => Some(Self::Linear(Linear::Isotropic(law))),
            AnySolid::AnisotropicLinear(law) => Some(Self::Linear(Linear::Anisotropic(law))),
            _ => None,
        }
    }

    /// P and a number that is zero where the law certainly has an answer: ten numbers a block in `answers`.
    pub(crate) fn stress(&self, points: usize, f: &[[Number; 9]], memory: [&mut [Number]; 3]) {
        let [first, second, answers] = memory;
        match self {
            Self::Invariants(law) => {
                run::<_, 0, 6>(&InvariantsOf, points, f, &[], first);
                run::<_, 6, 5>(&SlopesOf(law), points, f, first, second);
                run::<_, 5, 10>(&StressOfSlopes, points, f, second, answers);
            }
            Self::Strain(law) => {
                run::<_, 0, 7>(&SecondPiolaOf(law), points, f, &[], first);
                run::<_, 7, 10>(&StressOfSecondPiola, points, f, first, answers);
            }
            Self::Stretches(law) => run::<_, 0, 10>(&StressOf(law), points, f, &[], answers),
            Self::Isochoric(law) => run::<_, 0, 10>(&StressOf(*law), points, f, &[], answers),
            Self::Linear(law) => run::<_, 0, 10>(law, points, f, &[], answers),
        }
    }

    /// As [`stress`](Self::stress), with the upper triangle of ∂P/∂F: 55 numbers.
    pub(crate) fn both(&self, points: usize, f: &[[Number; 9]], memory: [&mut [Number]; 3]) {
        let [first, second, answers] = memory;
        match self {
            Self::Invariants(law) => {
                run::<_, 0, 6>(&InvariantsOf, points, f, &[], first);
                run::<_, 6, 11>(&CurvaturesOf(law), points, f, first, second);
                run::<_, 11, 55>(&BothOfCurvatures, points, f, second, answers);
            }
            Self::Strain(law) => {
                run::<_, 0, 28>(&MaterialOf(law), points, f, &[], second);
                run::<_, 28, 55>(&BothOfMaterial, points, f, second, answers);
            }
            Self::Stretches(law) => {
                run::<_, 0, 34>(&FramesOf(law), points, f, &[], second);
                run::<_, 34, 55>(&BothOfFrames, points, f, second, answers);
            }
            Self::Isochoric(law) => {
                run::<_, 0, 34>(&FramesOf(*law), points, f, &[], second);
                run::<_, 34, 55>(&BothOfFrames, points, f, second, answers);
            }
            Self::Linear(law) => run::<_, 0, 55>(law, points, f, &[], answers),
        }
    }
}

/// Zero in lanes that hold a deformation for which the law certainly has an answer, NaN in others.
#[cfg_attr(not(debug_assertions), inline(always))]
fn certain<T: Real>(jacobian: T, checked: Result<(), SolidsError>) -> T {
    let accepted = match checked {
        Ok(()) => true,
        Err(error) => refused(error),
    };
    let exists = T::zero().less_than(jacobian) & jacobian.is_finite() & Mask::splat(accepted);
    T::select(exists, T::zero(), T::lit(f64::NAN))
}

/// An error is dropped by a function of its own, which is not compiled for lanes.
#[cold]
#[inline(never)]
fn refused(error: SolidsError) -> bool {
    core::hint::black_box(error);
    false
}

/// The first K numbers and the last.
#[cfg_attr(not(debug_assertions), inline(always))]
fn apart<T: Real, const K: usize, const L: usize>(all: &[T; L]) -> ([T; K], T) {
    let mut numbers = [all[0]; K];
    let mut k = 0;
    while k < K {
        numbers[k] = all[k];
        k += 1;
    }
    (numbers, all[L - 1])
}

macro_rules! stages {
    ($($(#[$about:meta])* $stage:ty $(, [$($generics:tt)*])? [$i:literal => $o:literal] |$law:ident, $f:ident, $given:ident| $value:expr;)*) => { $(
        $(#[$about])*
        impl $(<$($generics)*>)? Stage<$i, $o> for $stage {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn at<T: Real>(&self, $f: &DeformationGradient<T>, $given: [T; $i]) -> [T; $o] {
                let $law = self;
                $value
            }
        }
    )* };
}

/// I₁ − 3, I₂ − 3, J − 1, J, I₁, I₂.
struct InvariantsOf;
/// ∂W/∂I₁, ∂W/∂I₂, s, J ∂W/∂J.
struct SlopesOf<'a>(&'a LawOfInvariants<'a>);
/// The slopes and the six second derivatives.
struct CurvaturesOf<'a>(&'a LawOfInvariants<'a>);
/// P of slopes.
struct StressOfSlopes;
/// P and ∂P/∂F of slopes and curvatures.
struct BothOfCurvatures;
/// S.
struct SecondPiolaOf<'a>(&'a LawOfStrain<'a>);
/// S and ∂S/∂E.
struct MaterialOf<'a>(&'a LawOfStrain<'a>);
/// P of S.
struct StressOfSecondPiola;
/// P and ∂P/∂F of S and ∂S/∂E.
struct BothOfMaterial;
/// P of a law that gives it at once.
struct StressOf<'a, L>(&'a L);
/// The law in the principal frame, and the frames.
struct FramesOf<'a, L>(&'a L);
/// P and ∂P/∂F of the law in the principal frame.
struct BothOfFrames;

/// A law of linear elasticity.
pub(crate) enum Linear<'a> {
    Isotropic(&'a LinearElastic),
    Anisotropic(&'a AnisotropicLinear),
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn invariants_of<T: Real>([first, second, change, jacobian, first_whole, second_whole]: [T; 6]) -> Invariants<T> {
    Invariants { first, second, change, jacobian, first_whole, second_whole }
}

#[cfg_attr(not(debug_assertions), inline(always))]
const fn slopes<T: Copy>(slopes: &Slopes<T>) -> [T; 4] {
    [slopes.first, slopes.second, slopes.residual, slopes.volume]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn with_curvatures<T: Real>(s: &Slopes<T>, c: &Curvatures<T>, certain: T) -> [T; 11] {
    [
        s.first,
        s.second,
        s.residual,
        s.volume,
        c.first_first,
        c.first_second,
        c.second_second,
        c.first_volume,
        c.second_volume,
        c.volume_volume,
        certain,
    ]
}

stages! {
    InvariantsOf [0 => 6] |_law, f, _given| {
        let Invariants { first, second, change, jacobian, first_whole, second_whole } = composition::invariants(f);
        [first, second, change, jacobian, first_whole, second_whole]
    };
    SlopesOf<'_> [6 => 5] |law, f, given| {
        let certain = certain(given[3], InvariantEnergy::check(law.0, f));
        joined(&slopes(&law.0.slopes(&invariants_of(given))), &[certain])
    };
    CurvaturesOf<'_> [6 => 11] |law, f, given| {
        let certain = certain(given[3], InvariantEnergy::check(law.0, f));
        let (slopes, curvatures) = law.0.slopes_and_curvatures(&invariants_of(given));
        with_curvatures(&slopes, &curvatures, certain)
    };
    StressOfSlopes [5 => 10] |_law, f, given| {
        let (slopes, certain) = apart(&given);
        joined(&composition::first_piola(f, slopes), &[certain])
    };
    BothOfCurvatures [11 => 55] |_law, f, given| {
        let (slopes_and_curvatures, certain) = apart(&given);
        packed::with_one_more(composition::first_piola_and_upper_triangle(f, slopes_and_curvatures), certain)
    };
    SecondPiolaOf<'_> [0 => 7] |law, f, _given| {
        joined(&law.0.second_piola(f).0.components, &[certain(jacobian(f), law.0.check(f))])
    };
    MaterialOf<'_> [0 => 28] |law, f, _given| {
        let (stress, tangent) = law.0.second_piola_and_tangent(f);
        let both: [T; 27] = joined(&stress.0.components, &tangent.0.components);
        joined(&both, &[certain(jacobian(f), law.0.check(f))])
    };
    StressOfSecondPiola [7 => 10] |_law, f, given| {
        let (components, certain) = apart(&given);
        let stress = product(gradient(f), Symmetric { components }.rows());
        joined(&packed::of_stress(stress), &[certain])
    };
    BothOfMaterial [28 => 55] |_law, f, given| {
        let mut components = [given[0]; 21];
        let mut k = 0;
        while k < 21 {
            components[k] = given[6 + k];
            k += 1;
        }
        let (stress, _) = apart::<T, 6, 28>(&given);
        let (stress, tangent) = (Symmetric { components: stress }, MajorSymmetric { components });
        packed::with_one_more(first_piola_numbers(gradient(f), &stress, &tangent), given[27])
    };
    StressOf<'_, L>, [L: Hyperelastic] [0 => 10] |law, f, _given| {
        let stress = packed::of_stress(law.0.first_piola(f).rows());
        joined(&stress, &[certain(jacobian(f), law.0.check(f))])
    };
    FramesOf<'_, L>, [L: StretchEnergy] [0 => 34] |law, f, _given| {
        let certain = certain(jacobian(f), law.0.check(f));
        joined(&in_frames(law.0, f), &[certain])
    };
    BothOfFrames [34 => 55] |_law, _f, given| {
        let (numbers, certain) = apart(&given);
        packed::with_one_more(composed(&numbers), certain)
    };
    Linear<'_> [0 => 10] |law, f, _given| {
        let stress = match law {
            Linear::Isotropic(law) => law.first_piola(f),
            Linear::Anisotropic(law) => law.first_piola(f),
        };
        joined(&packed::of_stress(stress.rows()), &[certain(jacobian(f), Ok(()))])
    };
    Linear<'_> [0 => 55] |law, f, _given| {
        let both = match law {
            Linear::Isotropic(law) => law.first_piola_and_upper_triangle(f),
            Linear::Anisotropic(law) => law.first_piola_and_upper_triangle(f),
        };
        packed::with_one_more(both, certain(jacobian(f), Ok(())))
    };
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn jacobian<T: Real>(deformation: &DeformationGradient<T>) -> T {
    piola::continuum::Deformation::jacobian(deformation)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn gradient<T: Real>(deformation: &DeformationGradient<T>) -> [[T; 3]; 3] {
    piola::continuum::Deformation::gradient_rows(deformation)
}

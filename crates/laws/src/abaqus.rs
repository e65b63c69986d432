//! What user materials of finite-element programs return, at many points in lanes: stress and `DDSDDE`, in the frame of the
//! laboratory or in the corotated one.
//!
//! ```text
//! DDSDDE = c/J + (D ↦ T D + D T)        Jaumann's rate of τ, over J        T = τ/J
//! ```
//! | program | frame | order |
//! |---|---|---|
//! | Abaqus/Standard, UMAT | [`Laboratory`] | [`Abaqus`]: 11, 22, 33, 12, 13, 23 |
//! | Abaqus/Explicit, VUMAT | [`Corotated`]: `Rᵀ T R` with F = R U | [`Piola`]: 11, 22, 33, 12, 23, 13 |
//!
//! Tangents multiply engineering shears. Destinations are views of `piola_batch`: arrays of structures, structures of
//! arrays, strided numbers, blocks of lanes.
//!
//! ```
//! use piola_continuum::DeformationGradient;
//! use piola_laws::abaqus::{Abaqus, Corotated, Laboratory, Piola, jaumann, stress, stress_and_jaumann};
//! use piola_solids::{SaintVenantKirchhoff, batch};
//! let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
//! let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 100]; // E₁₁ = 3/2
//! let (mut t, mut c) = (vec![[0.0; 6]; 100], vec![[0.0; 36]; 100]);
//! batch::evaluate(&f[..], stress_and_jaumann::<Abaqus, _, _, _, _>(&law, Laboratory, &mut t[..], &mut c[..]))?;
//! assert_eq!((t[99][0], c[99][0]), (15.0, 70.0)); // F₁₁² (λ + 2 μ) E₁₁/J; F₁₁⁴ (λ + 2 μ)/J + 2 T₁₁
//! let (mut u, mut d) = (vec![[0.0; 6]; 100], vec![[0.0; 36]; 100]);
//! let requests = (stress::<Piola, _, _, _>(&law, Corotated, &mut u[..]), jaumann::<Piola, _, _, _>(&law, Corotated, &mut d[..]));
//! batch::evaluate(&f[..], requests)?;
//! assert!((u[99][0] - 15.0_f64).abs() < 1e-13); // F = U
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use core::marker::PhantomData;

use piola_batch::{Point, Quantity, Refusal, Request, Together};
use piola_continuum::Deformation;
use piola_numerics::{Mask, Real};
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::Rows;
pub use piola_tensor::voigt::{Abaqus, Piola, VoigtOrder};
use piola_tensor::voigt::{StiffnessMatrix, StressVector};

use crate::varied::lifted;

/// The frame of the components of a stress: [`Laboratory`] or [`Corotated`].
///
/// # Example
/// See the [module](self).
pub trait Frame: Copy + Send + Sync + sealed::OfPoints {}

mod sealed {
    use super::{Deformation, Point, Real};

    /// The deformation that a frame shows to the law.
    pub trait OfPoints {
        const NEEDS_STRETCH: bool;
        fn deformation<T: Real, D: Deformation<T>>(point: &Point<T, D>) -> impl Deformation<T>;
    }
}

/// The frame of the laboratory, in which F is given.
///
/// # Example
/// See the [module](self).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Laboratory;

/// The frame that turns with R of F = R U: components are those of Rᵀ T R, which is T at F = U.
///
/// # Example
/// See the [module](self).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Corotated;

impl Frame for Laboratory {}
impl Frame for Corotated {}

impl sealed::OfPoints for Laboratory {
    const NEEDS_STRETCH: bool = false;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deformation<T: Real, D: Deformation<T>>(point: &Point<T, D>) -> impl Deformation<T> {
        *point
    }
}

impl sealed::OfPoints for Corotated {
    const NEEDS_STRETCH: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deformation<T: Real, D: Deformation<T>>(point: &Point<T, D>) -> impl Deformation<T> {
        let analysis = point.stretch();
        Stretch {
            gradient: analysis.right_stretch().rows(),
            displacement: analysis.right_stretch_less_one().rows(),
            jacobian: point.jacobian(),
            volume_change: point.volume_change(),
        }
    }
}

/// U as a deformation.
#[derive(Clone, Copy)]
struct Stretch<T> {
    gradient: Rows<T>,
    displacement: Rows<T>,
    jacobian: T,
    volume_change: T,
}

impl<T: Real> Deformation<T> for Stretch<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<T> {
        self.gradient
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<T> {
        self.displacement
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        lifted(self.displacement, lift)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        self.jacobian
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        self.volume_change
    }
}

/// The output of [`stress`], [`jaumann`] and [`stress_and_jaumann`].
#[derive(Debug)]
pub struct UserMaterial<'a, L, O, F> {
    law: &'a L,
    frame: PhantomData<fn() -> (O, F)>,
}

impl<L, O, F> Clone for UserMaterial<'_, L, O, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L, O, F> Copy for UserMaterial<'_, L, O, F> {}

/// T at each point, six numbers in the order O, Pa.
#[must_use]
pub fn stress<O: VoigtOrder, L: Hyperelastic + Sync, F: Frame, V>(
    law: &L,
    _frame: F,
    to: V,
) -> Request<UserMaterial<'_, L, O, F>, (), V, 0, 6> {
    Request::new(UserMaterial { law, frame: PhantomData }, (), to)
}

/// `DDSDDE` at each point, 6×6 numbers by rows in the order O, Pa.
#[doc(alias = "DDSDDE")]
#[must_use]
pub fn jaumann<O: VoigtOrder, L: Hyperelastic + Sync, F: Frame, V>(
    law: &L,
    _frame: F,
    to: V,
) -> Request<UserMaterial<'_, L, O, F>, (), V, 0, 36> {
    Request::new(UserMaterial { law, frame: PhantomData }, (), to)
}

/// T to the first destination and `DDSDDE` to the second, their common terms computed once.
#[doc(alias = "DDSDDE")]
#[must_use]
pub fn stress_and_jaumann<O: VoigtOrder, L: Hyperelastic + Sync, F: Frame, V, W>(
    law: &L,
    _frame: F,
    stress: V,
    tangent: W,
) -> Request<UserMaterial<'_, L, O, F>, (), Together<V, W>, 0, 42> {
    Request::new(UserMaterial { law, frame: PhantomData }, (), Together(stress, tangent))
}

impl<L: Hyperelastic, O: VoigtOrder, F: Frame> UserMaterial<'_, L, O, F> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn both<T: Real, D: Deformation<T>>(self, point: &Point<T, D>) -> [T; 42] {
        let (stress, tangent) = self.law.cauchy_and_tangent(&F::deformation(point));
        let six = StressVector::<T, O>::of(&stress.0).components;
        let rows = StiffnessMatrix::<T, O>::of(&tangent.jaumann(&stress).0).entries;
        let mut all = [T::zero(); 42];
        let mut k = 0;
        while k < 6 {
            all[k] = six[k];
            k += 1;
        }
        while k < 42 {
            all[k] = rows[(k - 6) / 6][k % 6];
            k += 1;
        }
        all
    }

    /// Lanes that the law accepts, all or none of a block.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accepts<T: Real>(self, deformation: &impl Deformation<T>) -> T::Mask {
        match self.law.check(deformation) {
            Ok(()) => Mask::splat(true),
            Err(error) => refused(error),
        }
    }
}

#[cold]
#[inline(never)]
fn refused<M: Mask>(error: SolidsError) -> M {
    drop(error);
    M::splat(false)
}

macro_rules! quantities {
    ($($k:literal |$material:ident, $point:ident| $value:expr;)*) => { $(
        impl<L: Hyperelastic + Sync, O: VoigtOrder, F: Frame> Quantity<0, $k> for UserMaterial<'_, L, O, F> {
            type Input = ();
            type Output = UserMaterial<'static, (), O, F>;
            const NEEDS_STRETCH: bool = F::NEEDS_STRETCH;
            const INPUT: &'static str = "";

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, _input: [T; 0]) -> [T; $k] {
                let $material = self;
                $value
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn good<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, value: &[T; $k]) -> T::Mask {
                value[0].is_finite() & self.accepts(point)
            }

            fn check<T: Real, D: Deformation<T>>(&self, deformation: &D) -> Result<(), Refusal> {
                self.law.check(deformation).map_err(Refusal::new)?;
                let finite = |components: [T; 6]| components[0].is_finite().all();
                let stress = finite(self.law.cauchy(deformation).0.components);
                let tangent = $k == 6 || self.law.truesdell_tangent(deformation).0.components[0].is_finite().all();
                if stress && tangent { Ok(()) } else { Err(Refusal::new(SolidsError::Overflow { answer: "stress" })) }
            }
        }
    )* };
}

quantities! {
    6 |material, point| StressVector::<T, O>::of(&material.law.cauchy(&F::deformation(point)).0).components;
    36 |material, point| {
        let both = material.both(point);
        let mut tangent = [both[6]; 36];
        let mut k = 1;
        while k < 36 {
            tangent[k] = both[6 + k];
            k += 1;
        }
        tangent
    };
    42 |material, point| material.both(point);
}

piola_batch::together!([O, F,] UserMaterial<'static, (), O, F>, 42 = UserMaterial<'static, (), O, F>, 6 + UserMaterial<'static, (), O, F>, 36);

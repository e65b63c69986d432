//! Viscometric functions at many shear rates, in lanes.
//!
//! ```
//! use piola_fluids::{CarreauYasuda, batch};
//!
//! let melt = CarreauYasuda::new(8.0, 0.0, 1.0, 0.5, 1.0)?;
//! let rates = [0.0, 3.0, -3.0, 8.0];
//! let mut stresses = [0.0; 4];
//! batch::shear_stress(&melt, &rates, &mut stresses)?; // 8 k/√(1 + |k|)
//! assert!((stresses[1] - 12.0).abs() < 1e-14 && stresses[2] == -stresses[1]);
//! let mut found = [0.0; 4];
//! batch::shear_rate(&melt, &stresses, &mut found)?;
//! assert!((found[3] - 8.0).abs() < 1e-13);
//! # Ok::<(), piola_fluids::FluidsError>(())
//! ```
//!
//! | function | what | in | out |
//! |---|---|---|---|
//! | [`shear_stress`] | τ | 1/s | Pa |
//! | [`sigma1`], [`sigma2`] | σ₁, σ₂ | 1/s | Pa |
//! | [`viscosity`] | τ/k | 1/s | Pa s |
//! | [`shear_rate`] | ζ = τ⁻¹ | Pa | 1/s |
//!
//! Any [`ViscometricFluid`] will do. Each function is one pass over the entries in as many lanes as the machine has, chosen when it runs.
//! Nothing is allocated.
//!
//! # Errors
//! Of every function: [`FluidsError::BadEntries`] where entries are infinite or NaN, or no rate has the stress: their answers are NaN,
//! all others are written; [`FluidsError::WrongLength`], before anything is computed, where there is not one answer for each entry.
//!
//! # Accuracy
//! That of one point, to the last bit where a fluid uses no elementary functions (ln, exp, powers): those of lanes are within 2 ulp of the
//! standard library's.

use core::marker::PhantomData;

use piola_numerics::{LaneKernel, Lanes, Mask, Real, dispatch_lanes};

use super::viscometric::ViscometricFluid;
use crate::FluidsError;

/// A quantity to compute.
trait Quantity {
    /// It, of one entry or of lanes.
    fn of<F: ViscometricFluid + ?Sized, T: Real>(fluid: &F, entry: T) -> Result<T, FluidsError>;
}

/// Declares a quantity, and the function that computes it at many entries.
macro_rules! quantities {
    ($($(#[$about:meta])* $function:ident, $kind:ident: |$fluid:ident, $entry:ident| $answer:expr;)+) => {
        $(
            /// A quantity.
            #[derive(Debug)]
            struct $kind;

            impl Quantity for $kind {
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn of<F: ViscometricFluid + ?Sized, T: Real>($fluid: &F, $entry: T) -> Result<T, FluidsError> {
                    $answer
                }
            }

            $(#[$about])*
            ///
            /// # Errors
            /// As the [module](self) says.
            pub fn $function<F: ViscometricFluid + ?Sized>(
                fluid: &F,
                entries: &[f64],
                answers: &mut [f64],
            ) -> Result<(), FluidsError> {
                each::<F, $kind>(fluid, entries, answers)
            }
        )+
    };
}

quantities! {
    /// τ, Pa, at each shear rate, 1/s.
    shear_stress, ShearStress: |fluid, k| Ok(fluid.shear_stress(k));
    /// σ₁ = T₁₁ − T₃₃, Pa, at each shear rate, 1/s.
    sigma1, Sigma1: |fluid, k| Ok(fluid.sigma1(k));
    /// σ₂ = T₂₂ − T₃₃, Pa, at each shear rate, 1/s.
    sigma2, Sigma2: |fluid, k| Ok(fluid.sigma2(k));
    /// τ/k, Pa s, at each shear rate, 1/s; at rest its limit.
    viscosity, Viscosity: |fluid, k| Ok(fluid.viscosity(k));
    /// ζ = τ⁻¹, 1/s, at each shear stress, Pa; zero up to the yield stress.
    shear_rate, ShearRate: |fluid, stress| fluid.shear_rate(stress);
}

/// Entries that have no answer.
#[derive(Clone, Copy, Debug, Default)]
struct Bad {
    /// The first of them and its index.
    first: Option<(usize, f64)>,
    count: usize,
}

impl Bad {
    fn note(&mut self, index: usize, value: f64) {
        self.first = self.first.or(Some((index, value)));
        self.count += 1;
    }
}

fn each<F: ViscometricFluid + ?Sized, Q: Quantity>(
    fluid: &F,
    entries: &[f64],
    answers: &mut [f64],
) -> Result<(), FluidsError> {
    if entries.len() != answers.len() {
        let (found, expected) = (answers.len(), entries.len());
        return Err(FluidsError::WrongLength { quantity: "answers", found, expected });
    }
    let bad = dispatch_lanes::<_, 2, 4, 8>(Pass { fluid, entries, answers, quantity: PhantomData::<Q> });
    match bad.first {
        None => Ok(()),
        Some((index, value)) => Err(FluidsError::BadEntries { fluid: F::NAME, index, value, count: bad.count }),
    }
}

/// A quantity at all entries.
struct Pass<'a, F: ?Sized, Q> {
    fluid: &'a F,
    entries: &'a [f64],
    answers: &'a mut [f64],
    quantity: PhantomData<Q>,
}

impl<F: ViscometricFluid + ?Sized, Q: Quantity> LaneKernel for Pass<'_, F, Q> {
    type Output = Bad;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) -> Bad {
        let mut bad = Bad::default();
        for (number, (chunk, to)) in self.entries.chunks(N).zip(self.answers.chunks_mut(N)).enumerate() {
            // The last chunk may be short: what it lacks is a copy of what it has.
            let lanes = Lanes::<f64, N>::load(chunk, chunk[0]);
            match if lanes.is_finite().all() { Q::of(self.fluid, lanes).ok() } else { None } {
                Some(answer) => answer.store(to),
                None => one_by_one::<F, Q>(self.fluid, number * N, chunk, to, &mut bad),
            }
        }
        bad
    }
}

/// A chunk in which something is wrong.
#[cold]
#[inline(never)]
fn one_by_one<F: ViscometricFluid + ?Sized, Q: Quantity>(
    fluid: &F,
    start: usize,
    entries: &[f64],
    answers: &mut [f64],
    bad: &mut Bad,
) {
    for (index, (&entry, answer)) in entries.iter().zip(answers).enumerate() {
        *answer = f64::NAN;
        // In lanes of one, so that an entry's neighbours do not change its digits.
        if entry.is_finite()
            && let Ok(Lanes([value])) = Q::of(fluid, Lanes([entry]))
        {
            *answer = value;
        } else {
            bad.note(start + index, entry);
        }
    }
}

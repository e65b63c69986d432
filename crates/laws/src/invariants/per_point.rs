//! Energies of invariants whose parameters differ from point to point, at many points in lanes.
//!
//! The parameters are a [`Source`](piola_batch::Source) beside the deformations: structures of arrays
//! ([`Components`](piola_batch::Components)), an array for each point, or, the fastest, blocks of lanes
//! ([`LaneBlocks`](piola_batch::LaneBlocks)).

use piola_batch::{BatchError, Point, Quantity, Refusal, Request, Together};
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::internal::Lanewise;
use piola_numerics::{Hessian, Mask, Real};
use piola_solids::SolidsError;

use super::excesses::Excesses;
use super::fibres::{AtPoint, Energy, both_numbers, inputs, stress_numbers};
use super::variables::Variables;

/// The most parameters that an energy may have at each point.
pub const MOST_PARAMETERS: usize = 8;

/// F, ∇u, J, J − 1 and the parameters.
const INPUTS: usize = 20 + MOST_PARAMETERS;

/// What a parameter must satisfy.
///
/// # Example
/// ```
/// use piola_laws::per_point::Bound;
/// assert!(Bound::NotNegative.holds(0.0) && !Bound::Positive.holds(0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bound {
    /// Any finite number.
    Finite,
    /// 0 < p.
    Positive,
    /// 0 ≤ p.
    NotNegative,
}

impl Bound {
    /// Whether a number satisfies it.
    #[must_use]
    pub const fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::Positive => 0.0 < value,
                Self::NotNegative => 0.0 <= value,
            }
    }

    /// The bound in words.
    const fn text(self) -> &'static str {
        match self {
            Self::Finite => "finite",
            Self::Positive => "0 < parameter",
            Self::NotNegative => "0 ≤ parameter",
        }
    }
}

/// An energy of invariants with N ≤ 8 parameters that each point has for itself.
///
/// As [`EnergyOfInvariants`](super::EnergyOfInvariants), with the parameters beside the arguments. [`first_piola`] and
/// [`first_piola_and_tangent`] are requests of `piola_batch` for it.
///
/// # Accuracy
/// S has all digits at small strain for an energy whose terms keep theirs, see [`Excesses`]; P = F S.
///
/// # Example
/// W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)² with μ and λ of each point, in structures of arrays.
/// ```
/// use piola_batch::Components;
/// use piola_continuum::{DeformationGradient, FirstPiola};
/// use piola_laws::Excesses;
/// use piola_laws::per_point::{Bound, EnergyOfParameters, first_piola};
/// use piola_numerics::Real;
/// use piola_solids::batch;
///
/// #[derive(Clone, Copy)]
/// struct Graded;
/// impl EnergyOfParameters<2> for Graded {
///     const PARAMETERS: [(&'static str, Bound); 2] = [("shear_modulus", Bound::Positive), ("lambda", Bound::Finite)];
///     #[inline(always)]
///     fn energy<T: Real>(&self, &[mu, lambda]: &[T; 2], at: &impl Excesses<T>) -> T {
///         let volume = at.ln_jacobian();
///         T::lit(0.5) * (mu * at.first_excess() + lambda * volume * volume)
///     }
/// }
///
/// let f = [DeformationGradient::simple_shear(0.5)?; 3];
/// let (mu, lambda) = ([1.0, 2.0, 4.0], [3.0; 3]);
/// let mut stresses = [FirstPiola::zero(); 3];
/// batch::evaluate(&f[..], first_piola(Graded, Components::new([&mu[..], &lambda[..]])?, &mut stresses[..]))?;
/// assert_eq!(stresses.map(|stress| stress.0[(0, 1)]), [0.5, 1.0, 2.0]); // μ k
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait EnergyOfParameters<const N: usize>: Copy + Send + Sync {
    /// The names of the parameters and what they must satisfy.
    const PARAMETERS: [(&'static str, Bound); N];
    /// The number of families of fibres, at most two.
    const FIBRES: usize = 0;
    /// False if W does not depend on I₂: its terms are then not computed. If it does all the same, stresses are NaN.
    const SECOND: bool = true;

    /// W of the parameters and its arguments, J/m³; zero at the reference, where all arguments are.
    ///
    /// For lanes mark it `#[inline(always)]`.
    #[must_use]
    fn energy<T: Real>(&self, parameters: &[T; N], at: &impl Excesses<T>) -> T;

    /// The unit vector along a family of fibres in the reference configuration.
    #[must_use]
    fn fibre(&self, _family: usize) -> [f64; 3] {
        [1.0, 0.0, 0.0]
    }
}

/// An energy with the parameters of a point.
struct Given<'a, E, T, const N: usize> {
    energy: &'a E,
    parameters: [T; N],
}

impl<T: Real, E: EnergyOfParameters<N>, const N: usize> AtPoint<T> for Given<'_, E, T, N> {
    const FIBRES: usize = E::FIBRES;
    const SECOND: bool = E::SECOND;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fibre(&self, family: usize) -> [f64; 3] {
        self.energy.fibre(family)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy(&self, at: &Variables<'_, T>) -> Energy<T> {
        let mut lifted = [Hessian::constant(T::zero()); N];
        let mut k = 0;
        while k < N {
            lifted[k] = Hessian::constant(self.parameters[k]);
            k += 1;
        }
        self.energy.energy(&lifted, at)
    }
}

/// Answers of F, ∇u, J, J − 1 and the parameters.
struct OfParameters<E, const N: usize>(E);

impl<E: EnergyOfParameters<N>, const N: usize> OfParameters<E, N> {
    /// The numbers of a deformation, and the law with its parameters.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parts<T: Real>(&self, all: [T; INPUTS]) -> ([T; 20], Given<'_, E, T, N>) {
        const { assert!(N <= MOST_PARAMETERS, "an energy has at most eight parameters of the point") };
        let (mut numbers, mut parameters) = ([all[0]; 20], [all[0]; N]);
        let mut k = 0;
        while k < 20 {
            numbers[k] = all[k];
            k += 1;
        }
        k = 0;
        while k < N {
            parameters[k] = all[20 + k];
            k += 1;
        }
        (numbers, Given { energy: &self.0, parameters })
    }
}

impl<E: EnergyOfParameters<N>, const N: usize> Lanewise<INPUTS, 9> for OfParameters<E, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, all: [T; INPUTS]) -> [T; 9] {
        let (numbers, law) = self.parts(all);
        stress_numbers(&law, numbers)
    }
}

impl<E: EnergyOfParameters<N>, const N: usize> Lanewise<INPUTS, 54> for OfParameters<E, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, all: [T; INPUTS]) -> [T; 54] {
        let (numbers, law) = self.parts(all);
        both_numbers(&law, numbers)
    }
}

/// The output of [`first_piola`] and [`first_piola_and_tangent`].
///
/// # Example
/// See [`EnergyOfParameters`].
#[derive(Clone, Copy, Debug)]
pub struct OfEnergyOfParameters<E, const N: usize>(E);

/// P at each point, nine numbers by rows, Pa; `parameters` holds N numbers a point.
///
/// Points whose parameters are not finite or violate their bound are bad: their stresses are NaN, those of all others are written.
#[must_use]
pub const fn first_piola<E: EnergyOfParameters<N>, S, V, const N: usize>(
    energy: E,
    parameters: S,
    to: V,
) -> Request<OfEnergyOfParameters<E, N>, S, V, N, 9> {
    Request::new(OfEnergyOfParameters(energy), parameters, to)
}

/// P to the first destination and the 45 entries of ∂P/∂F on and above its diagonal to the second, their common terms computed once.
///
/// The entries are in the order of [`first_piola_tangent`](piola_solids::batch::first_piola_tangent). Bad points as of [`first_piola`].
#[must_use]
pub const fn first_piola_and_tangent<E: EnergyOfParameters<N>, S, V, W, const N: usize>(
    energy: E,
    parameters: S,
    stress: V,
    tangent: W,
) -> Request<OfEnergyOfParameters<E, N>, S, Together<V, W>, N, 54> {
    Request::new(OfEnergyOfParameters(energy), parameters, Together(stress, tangent))
}

impl<E: EnergyOfParameters<N>, const N: usize> OfEnergyOfParameters<E, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inputs<T: Real>(deformation: &impl Deformation<T>, parameters: &[T; N]) -> [T; INPUTS] {
        let numbers = inputs(deformation);
        let mut all = [T::zero(); INPUTS];
        let mut k = 0;
        while k < 20 {
            all[k] = numbers[k];
            k += 1;
        }
        k = 0;
        while k < N {
            all[20 + k] = parameters[k];
            k += 1;
        }
        all
    }

    /// Where all parameters satisfy their bounds.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn within<T: Real>(parameters: &[T; N]) -> T::Mask {
        let (zero, mut good) = (T::zero(), T::Mask::splat(true));
        let mut k = 0;
        while k < N {
            match E::PARAMETERS[k].1 {
                Bound::Finite => {}
                Bound::Positive => good = good & zero.less_than(parameters[k]),
                Bound::NotNegative => good = good & zero.at_most(parameters[k]),
            }
            k += 1;
        }
        good
    }

    fn check<T: Real>(parameters: &[T; N]) -> Result<(), BatchError> {
        for (parameter, (name, bound)) in parameters.iter().zip(E::PARAMETERS) {
            let value = parameter.primal(0);
            if !bound.holds(value) {
                let law = "energy with parameters of the point";
                let error = SolidsError::OutOfBounds { law, parameter: name, value, bound: bound.text() };
                return Err(Refusal::new(error).into());
            }
        }
        Ok(())
    }
}

macro_rules! quantities {
    ($($k:literal $output:ty),+) => { $(
        impl<E: EnergyOfParameters<N>, const N: usize> Quantity<N, $k> for OfEnergyOfParameters<E, N> {
            type Input = Self;
            type Output = $output;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "parameters of the points";

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, parameters: [T; N]) -> [T; $k] {
                T::lanewise(&OfParameters(self.0), Self::inputs(point, &parameters))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn good<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, value: &[T; $k]) -> T::Mask {
                value[0].is_finite()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn admits<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, parameters: &[T; N]) -> T::Mask {
                Self::within(parameters)
            }

            fn check_input<T: Real, D: Deformation<T>>(
                &self,
                deformation: &D,
                parameters: &[T; N],
            ) -> Result<(), BatchError> {
                Self::check(parameters)?;
                let answer: [T; $k] = T::lanewise(&OfParameters(self.0), Self::inputs(deformation, parameters));
                if answer[0].is_finite().all() {
                    Ok(())
                } else {
                    Err(Refusal::new(SolidsError::Overflow { answer: "first_piola" }).into())
                }
            }
        }
    )+ };
}
quantities!(9 FirstPiola, 54 Self);

piola_batch::together!(
    [E, const PARAMETERS: usize,]
    OfEnergyOfParameters<E, PARAMETERS>, 54 = FirstPiola, 9 + piola_solids::batch::FirstPiolaTangentOf<'static, ()>, 45
);

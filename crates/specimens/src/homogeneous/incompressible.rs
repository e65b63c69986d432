//! Incompressible laws in homogeneous tests: the pressure is that of a face free of traction.

use nalgebra::Matrix3;
use piola_continuum::{CauchyStress, Deformation, DisplacementGradient, FirstPiola, Symmetric};
use piola_numerics::{Dual, Real};
use piola_solids::Hyperelastic;
use piola_tensor::internal::rows::Rows;

use super::{Mode, check_stretches, diagonal};
use crate::SpecimensError;

/// A law as an incompressible body in a homogeneous test.
///
/// Every [`Hyperelastic`] law has it: the deformations are isochoric, and what the law says of volumes drops out with the
/// pressure. A law written in principal stretches gives [`energy_of_stretches`](Self::energy_of_stretches), its
/// parameters numbers of the scalar T: over a [`Gradient`](piola_numerics::Gradient) of T the derivatives with
/// respect to parameters come with the stress.
///
/// # Example
/// One term of Ogden's law, and the derivatives of its stress with respect to μ and α in one evaluation.
/// ```
/// use piola_specimens::homogeneous::{Incompressible, Mode, first_piola};
/// use piola_numerics::{Dual, Gradient, Real};
///
/// struct Term<T> { modulus: T, exponent: T }
///
/// impl<T: Real> Incompressible<T> for Term<T> {
///     fn energy_of_stretches(&self, stretches: [Dual<T>; 3]) -> Dual<T> {
///         let (mu, alpha) = (Dual::constant(self.modulus), Dual::constant(self.exponent));
///         let power = |x: Dual<T>| (alpha * x.ln()).exp_m1();
///         mu / alpha * (power(stretches[0]) + power(stretches[1]) + power(stretches[2]))
///     }
/// }
///
/// let term = Term { modulus: Gradient::<f64, 2>::variable(3.0, 0), exponent: Gradient::variable(2.0, 1) };
/// let stress = first_piola(Mode::Planar, Gradient::constant(2.0), &term);
/// assert!((stress.value - 3.0 * (2.0 - 0.125)).abs() < 1e-14); // μ (λ^(α−1) − λ^(−α−1))
/// assert!((stress.partials[0] - 1.875).abs() < 1e-14); // ∂P/∂μ = P/μ
/// assert!((stress.partials[1] - 3.0 * 2.125 * 2.0_f64.ln()).abs() < 1e-14); // ∂P/∂α
/// ```
pub trait Incompressible<T: Real> {
    /// W as a function of the principal stretches, J/m³, up to a constant.
    ///
    /// Their product is 1 and stays 1 along the derivative that the scalar carries.
    #[must_use]
    fn energy_of_stretches(&self, stretches: [Dual<T>; 3]) -> Dual<T>;

    /// See [`first_piola`].
    #[inline]
    #[must_use]
    fn first_piola_of_mode(&self, mode: Mode, stretch: T) -> T {
        let [first, second, third] = mode.elongations(stretch).map(|x| x + T::one());
        // δλ₁ = 1, δλ₃ = −λ₃/λ₁: the volume is kept, and the third face, free of traction, does no work.
        let along = [Dual::variable(first), Dual::constant(second), Dual::new(third, -third / first)];
        let stress = self.energy_of_stretches(along).tangent;
        match mode {
            // dλ/dk = λ/(λ + 1/λ).
            Mode::SimpleShear => stress * first / (first + third),
            _ => stress,
        }
    }
}

impl<T: Real, L: Hyperelastic> Incompressible<T> for L {
    fn energy_of_stretches(&self, stretches: [Dual<T>; 3]) -> Dual<T> {
        let gradient = diagonal(stretches.map(|x| x - Dual::constant(T::one())));
        self.energy(&DisplacementGradient::<T>::zero().lifted(|i, j, _| gradient[i][j]))
    }

    /// From the first Piola–Kirchhoff stress, which keeps its digits at small strain.
    fn first_piola_of_mode(&self, mode: Mode, stretch: T) -> T {
        let stress_at =
            |gradient: Rows<T>| self.first_piola(&DisplacementGradient::<T>::zero().lifted(|i, j, _| gradient[i][j])).0;
        let mut gradient = gradient_of(mode, stretch);
        if mode == Mode::SimpleShear {
            return stress_at(gradient)[(1, 0)];
        }
        let mut stress = stress_at(gradient);
        if mode == Mode::Uniaxial && (0 < T::ORDER || !sides_alike(&stress, &gradient)) {
            let Some(elongations) = free_sides(self, stretch) else { return T::lit(f64::NAN) };
            gradient = diagonal(elongations);
            stress = stress_at(gradient);
        }
        stress[(0, 0)] - stress[(2, 2)] * ((T::one() + gradient[2][2]) / stretch)
    }
}

/// Sides whose stresses differ by less than this share of all are alike.
const ALIKE: f64 = 1e-12;

/// True if τ₂₂ = τ₃₃ in every lane, as they are in a bar of an isotropic solid; derivatives are not looked at.
fn sides_alike<T: Real>(stress: &Matrix3<T>, gradient: &Rows<T>) -> bool {
    (0..T::LANES).all(|lane| {
        let [axial, second, third] =
            [0, 1, 2].map(|k| stress[(k, k)].primal(lane) * (1.0 + gradient[k][k].primal(lane)));
        // Of NaN no sides can be found.
        let different = ALIKE * (axial.abs() + second.abs() + third.abs()) < (second - third).abs();
        !different
    })
}

/// Corrections of a bar's sides, at most.
const CORRECTIONS: usize = 80;
/// The largest change of ln λ₂ in one of them.
const LARGEST_CORRECTION: f64 = 0.5;

/// The elongations of an incompressible bar of stretch λ that leave its sides free, τ₂₂ = τ₃₃: λ₂ = λ^(−½) eᵗ,
/// λ₃ = λ^(−½) e⁻ᵗ. Newton's method for t, which then carries the derivatives of λ. None where it does not converge.
fn free_sides<T: Real>(law: &impl Hyperelastic, stretch: T) -> Option<[T; 3]> {
    let [axial, across, _] = Mode::Uniaxial.elongations(stretch);
    let sides = |t: T| [axial, across + (T::one() + across) * t.exp_m1(), across + (T::one() + across) * (-t).exp_m1()];
    let mut t = T::zero();
    let mut lifts = T::ORDER;
    for _ in 0..CORRECTIONS {
        let varied = {
            let (one, axial, across) = (Dual::constant(T::one()), Dual::constant(axial), Dual::constant(across));
            let t = Dual::variable(t);
            [axial, across + (one + across) * t.exp_m1(), across + (one + across) * (-t).exp_m1()]
        };
        let gradient = diagonal(varied);
        let stress = law.first_piola(&DisplacementGradient::<T>::zero().lifted(|i, j, _| gradient[i][j])).0;
        let [second, third] = [1, 2].map(|k| stress[(k, k)] * (Dual::constant(T::one()) + varied[k]));
        let rest = second - third;
        // A side that nothing holds stays where it is.
        let nothing = rest.value.at_most(T::zero()) & T::zero().at_most(rest.value);
        let still = nothing & rest.tangent.at_most(T::zero()) & T::zero().at_most(rest.tangent);
        let correction = T::select(still, T::zero(), -rest.value / rest.tangent);
        let mut converged = true;
        for lane in 0..T::LANES {
            let size = correction.primal(lane).abs();
            if size.is_nan() {
                return None;
            }
            converged &= size <= ALIKE * t.primal(lane).abs() + 4.0 * f64::EPSILON;
        }
        let most = T::lit(LARGEST_CORRECTION);
        let short = correction.abs().at_most(most);
        t += T::select(short, correction, most.copysign(correction.frozen()));
        if converged {
            if lifts == 0 {
                return Some(sides(t));
            }
            lifts -= 1;
        }
    }
    None
}

/// ∇u of a mode.
#[cfg_attr(not(debug_assertions), inline(always))]
fn gradient_of<T: Real>(mode: Mode, stretch: T) -> Rows<T> {
    match mode {
        Mode::SimpleShear => {
            let o = T::zero();
            [[o, o, o], [stretch, o, o], [o, o, o]]
        }
        _ => diagonal(mode.elongations(stretch)),
    }
}

/// The first Piola–Kirchhoff stress (force per reference area) of an incompressible law in a homogeneous test, Pa.
///
/// ```text
/// P₁₁ = ∂W/∂λ₁ − (λ₃/λ₁) ∂W/∂λ₃        simple shear: P₂₁ = dŴ/dk
/// ```
/// For an isotropic law this is dŴ/dλ of the energy along the path, and half of it in equibiaxial tension.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | λ, or k in simple shear | `stretch`, 0 < λ (trusted: NaN comes back otherwise) | – |
/// | P | returned | Pa |
///
/// A bar of an anisotropic law gets different stretches across, those that leave its sides free of normal traction. Its axes
/// are taken to be along the coordinates: tangential tractions, which would hold the block straight, are not
/// reported here but refused by [`IncompressibleState`].
///
/// # Accuracy
/// For laws with closed forms a relative 1e-13 also near the reference (λ itself is exact there); from an energy of
/// stretches a few ulp of the moduli.
///
/// # Example
/// ```
/// use piola_specimens::homogeneous::{Mode, first_piola};
/// use piola_solids::MooneyRivlin;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// // 2 (λ − λ⁻²)(C₁₀ + C₀₁/λ) at λ = 2.
/// let stress: f64 = first_piola(Mode::Uniaxial, 2.0, &rubber);
/// assert!((stress - 2.0 * 1.75 * 0.625).abs() < 1e-14);
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
///
/// # Source
/// W(20.13), W(21.20).
#[doc(alias = "nominal_stress")]
#[inline]
#[must_use]
pub fn first_piola<T: Real, L: Incompressible<T>>(mode: Mode, stretch: T, law: &L) -> T {
    law.first_piola_of_mode(mode, stretch)
}

/// (P, dP/dλ), as [`first_piola`].
#[inline]
#[must_use]
pub fn first_piola_and_slope<T: Real, L: Incompressible<Dual<T>>>(mode: Mode, stretch: T, law: &L) -> (T, T) {
    let stress = law.first_piola_of_mode(mode, Dual::variable(stretch));
    (stress.value, stress.tangent)
}

/// An incompressible body in a homogeneous test: pressure and all stresses.
///
/// ```text
/// T = T_law(F) − p 1,   p such that T₃₃ = 0        P = T F⁻ᵀ   (J = 1)
/// ```
/// The sides of a bar of an anisotropic law get the two different stretches that leave both free of traction.
///
/// `T_law` is what the law answers without constraint, its formula for volumes included: only T and P are the body's.
///
/// # Example
/// Poynting's effect: a sheared block pushes against the planes that shear it.
/// ```
/// use piola_specimens::homogeneous::{IncompressibleState, Mode};
/// use piola_solids::MooneyRivlin;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// let state = IncompressibleState::of(&rubber, Mode::SimpleShear, 0.5_f64)?;
/// let stress = state.cauchy.0.components;
/// assert!((stress[3] - 0.75).abs() < 1e-15); // T₁₂ = μ k
/// assert!((stress[0] + 2.0 * 0.25 * 0.25).abs() < 1e-15); // T₁₁ = −2 C₀₁ k²
/// assert!((stress[1] - 2.0 * 0.5 * 0.25).abs() < 1e-15); // T₂₂ = 2 C₁₀ k²
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncompressibleState<T: Real = f64> {
    /// The deformation.
    pub deformation: DisplacementGradient<T>,
    /// p, Pa.
    pub pressure: T,
    /// T, Pa.
    pub cauchy: CauchyStress<T>,
    /// P, Pa.
    pub first_piola: FirstPiola<T>,
}

impl<T: Real> IncompressibleState<T> {
    /// Of a mode and its stretch (or amount of shear).
    ///
    /// # Errors
    /// [`SpecimensError::OutOfBounds`] for a stretch that is not positive, [`SpecimensError::NotFinite`];
    /// [`SpecimensError::Solids`] where the law has no answer; [`SpecimensError::TractionOnFreeFace`] where the
    /// law's axes are not those of the test, so that free faces are not free; [`SpecimensError::NotConverged`] where
    /// no stretches across a bar were found.
    pub fn of(law: &impl Hyperelastic, mode: Mode, stretch: T) -> Result<Self, SpecimensError> {
        if mode == Mode::SimpleShear {
            return Self::at(law, DisplacementGradient::simple_shear(stretch)?, &[[0, 2], [1, 2]]);
        }
        check_stretches(&[stretch])?;
        let deformation = DisplacementGradient::diagonal(mode.elongations(stretch))?;
        if mode != Mode::Uniaxial {
            return Self::at(law, deformation, &[[0, 2], [1, 2]]);
        }
        let free = [[1, 1], [0, 1], [0, 2], [1, 2]];
        law.check(&deformation)?;
        let stress = law.first_piola(&deformation).0;
        if T::ORDER == 0 && sides_alike(&stress, &deformation.displacement_rows()) {
            return Self::at(law, deformation, &free);
        }
        let Some(elongations) = free_sides(law, stretch) else {
            let gradient = deformation.gradient_rows().map(|row| row.map(|x| x.primal(0)));
            let rows = law.kirchhoff(&deformation).0.components;
            let residual = (rows[1] - rows[2]).primal(0).abs();
            return Err(SpecimensError::NotConverged { residual, iterations: CORRECTIONS, share: 1.0, gradient });
        };
        Self::at(law, DisplacementGradient::diagonal(elongations)?, &free)
    }

    /// A sheet stretched by λ₁ and λ₂ along the axes, its faces free: λ₃ = 1/(λ₁ λ₂).
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub fn biaxial(law: &impl Hyperelastic, [first, second]: [T; 2]) -> Result<Self, SpecimensError> {
        check_stretches(&[first, second])?;
        let (a, b) = (first - T::one(), second - T::one());
        let third = -(a + b * first) / (first * second);
        Self::at(law, DisplacementGradient::diagonal([a, b, third])?, &[[0, 2], [1, 2]])
    }

    /// With the pressure of a free face 3; the components `free` of T are refused unless they vanish.
    fn at(
        law: &impl Hyperelastic,
        deformation: DisplacementGradient<T>,
        free: &[[usize; 2]],
    ) -> Result<Self, SpecimensError> {
        law.check(&deformation)?;
        let whole = law.kirchhoff(&deformation).0;
        let pressure = whole.components[2];
        let cauchy = CauchyStress(whole - Symmetric::identity() * pressure);
        check_free(law, &deformation, &whole, &cauchy, free)?;
        Ok(Self { deformation, pressure, cauchy, first_piola: cauchy.first_piola(&deformation) })
    }

    /// F.
    #[must_use]
    pub fn gradient(&self) -> Matrix3<T> {
        Matrix3::from(self.deformation.gradient_rows()).transpose()
    }
}

/// Tractions of free faces below this share of the stress are rounding.
const TRACTION: f64 = 1e-9;

/// Refuses tractions on faces that are said to be free.
fn check_free<T: Real>(
    law: &impl Hyperelastic,
    deformation: &DisplacementGradient<T>,
    whole: &Symmetric<T>,
    cauchy: &CauchyStress<T>,
    free: &[[usize; 2]],
) -> Result<(), SpecimensError> {
    let (whole, cauchy) = (whole.rows(), cauchy.0.rows());
    for lane in 0..T::LANES {
        let size = whole.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.primal(lane).abs()));
        for &[i, j] in free {
            let stress = cauchy[i][j].primal(lane);
            if stress.abs() <= TRACTION * size {
                continue;
            }
            // At small strain the stress of a law that is but derived has the rounding of its moduli.
            let tangent = law.first_piola_tangent(deformation).0.components;
            let moduli = tangent.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.primal(lane).abs()));
            if TRACTION * size + 1e-12 * moduli < stress.abs() {
                return Err(SpecimensError::TractionOnFreeFace { component: [i, j], stress });
            }
        }
    }
    Ok(())
}

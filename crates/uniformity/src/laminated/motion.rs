//! Laminated bodies in motion: universal solutions whose acceleration has a potential, W p. 196.
//!
//! ```text
//! ẍ = −grad ζ        T = T_static − ρ ζ 1,   p = p_static + ρ ζ
//! ```
//!
//! Along the laminae the present coordinates are Q(t) times those of the reference; with A = Q̇ Q⁻¹, S = Q̈ Q⁻¹ and Δ = det Q:
//!
//! ```text
//! plane      S₁₂ = S₂₁                                  ζ = −[ẍ₀ ξ + ½ Δ (1/Δ)¨ ξ² + ½ S_ab y^a y^b],   ξ = x − x₀
//! cylinder   A₁₂ = S₁₂ = S₂₁ = 0,  S₁₁ = A₂₂ A₁₁        ζ = −[½ ċ₁ ln r + (¼ ċ₂ + ⅛ c₂²) r² + c₁²/(8 r²) + ½ A₁₁ (c₁ − A₁₁ r²) θ² + ½ S₂₂ z²]
//!                                                       2 r ṙ = c₁ + c₂ r²,  c₂ = −Δ̇/Δ,  c₁ = (r₀²)˙ − c₂ r₀²
//! sphere     any r₀(t)                                  ζ = q̇/r − q²/(2 r⁴),   q = r² ṙ
//! ```

use piola_numerics::{Jet, Real};
use piola_solids::isochoric::Isochoric;

use super::sheet::Image;
use super::{LaminaStress, LaminatedPlate, LaminatedTube, Lamination, SheetState};
use crate::UniformityError;
use crate::error::{check_bound, check_finite};

/// The parameters of a laminated plate or tube as functions of time, stated once over any scalar.
///
/// # Example
/// A plate pulled in its plane.
/// ```
/// use piola_numerics::Real;
/// use piola_uniformity::laminated::SheetHistory;
/// struct Pull;
/// impl SheetHistory for Pull {
///     fn origin<T: Real>(&self, _t: T) -> T {
///         T::zero()
///     }
///     fn matrix<T: Real>(&self, t: T) -> [[T; 2]; 2] {
///         [[T::one() + t * t, T::zero()], [T::zero(), T::one()]]
///     }
/// }
/// assert_eq!(Pull.matrix(2.0)[0][0], 5.0);
/// ```
pub trait SheetHistory {
    /// x₀(t) or r₀(t), m, of the inner face.
    fn origin<T: Real>(&self, t: T) -> T;
    /// Q(t): the present coordinates along the laminae are Q times those of the reference.
    fn matrix<T: Real>(&self, t: T) -> [[T; 2]; 2];
}

/// A laminated plate or tube at one instant of a motion: acceleration, its potential, stress.
///
/// # Example
/// A homogeneous plate pulled along y as y = (1 + t²) Y: x = X/(1 + t²).
/// ```
/// use piola_numerics::Real;
/// use piola_solids::isochoric::NeoHookean;
/// use piola_uniformity::laminated::{HomogeneousPlate, LaminatedPlate, SheetHistory, SheetMotion};
/// struct Pull;
/// impl SheetHistory for Pull {
///     fn origin<T: Real>(&self, _t: T) -> T {
///         T::zero()
///     }
///     fn matrix<T: Real>(&self, t: T) -> [[T; 2]; 2] {
///         [[T::one() + t * t, T::zero()], [T::zero(), T::one()]]
///     }
/// }
/// let plate = LaminatedPlate::new(HomogeneousPlate, [0.0, 1.0])?;
/// let start = SheetMotion::of_flat_plate(&plate, &Pull, 0.0)?;
/// let [across, along, _] = start.acceleration([1.0, 1.0, 0.0])?;
/// assert!((across + 2.0).abs() < 1e-15 && along == 2.0);
/// assert!(start.potential([1.0, 1.0, 0.0])?.abs() < 1e-15); // ½ × 2 (x² − y²)
/// let stress = start.stress(&NeoHookean::new(1.0)?, 8.0, 0.0, [1.0, 0.0, 0.0])?;
/// assert!((stress.cauchy.0.components[0] + 8.0).abs() < 1e-14); // −ρ ζ
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetMotion<A> {
    /// The deformation at the instant.
    pub state: SheetState<A>,
    /// A = Q̇ Q⁻¹ and S = Q̈ Q⁻¹.
    rate: [[f64; 2]; 2],
    second_rate: [[f64; 2]; 2],
    origin: Jet<f64, 0>,
    determinant: Jet<f64, 0>,
}

/// Conditions of a potential hold to this, relative to their terms: what rounding of parameters and their derivatives leaves.
const ROUNDING: f64 = 1e-12;

impl<'a, A: Lamination> SheetMotion<&'a A> {
    /// Family 0 in motion.
    ///
    /// # Errors
    /// [`UniformityError::NoAccelerationPotential`] with the condition; what [`LaminatedPlate::flat`] refuses.
    pub fn of_flat_plate(
        plate: &'a LaminatedPlate<A>,
        history: &impl SheetHistory,
        t: f64,
    ) -> Result<Self, UniformityError> {
        Self::of(history, t, |origin, matrix| plate.flat(origin, matrix))
    }

    /// Family 1 in motion.
    ///
    /// # Errors
    /// [`UniformityError::NoAccelerationPotential`] with the condition; what [`LaminatedPlate::bent`] refuses.
    pub fn of_bent_plate(
        plate: &'a LaminatedPlate<A>,
        history: &impl SheetHistory,
        t: f64,
    ) -> Result<Self, UniformityError> {
        Self::of(history, t, |origin, matrix| plate.bent(origin, matrix))
    }

    /// Family 2 in motion, W(25.35–25.39).
    ///
    /// # Errors
    /// [`UniformityError::NoAccelerationPotential`] with the condition; what [`LaminatedTube::straightened`] refuses.
    pub fn of_straightened_tube(
        tube: &'a LaminatedTube<A>,
        history: &impl SheetHistory,
        t: f64,
    ) -> Result<Self, UniformityError> {
        Self::of(history, t, |origin, matrix| tube.straightened(origin, matrix))
    }

    /// Family 3 in motion.
    ///
    /// # Errors
    /// [`UniformityError::NoAccelerationPotential`] with the condition; what [`LaminatedTube::inflated`] refuses.
    pub fn of_inflated_tube(
        tube: &'a LaminatedTube<A>,
        history: &impl SheetHistory,
        t: f64,
    ) -> Result<Self, UniformityError> {
        Self::of(history, t, |origin, matrix| tube.inflated(origin, matrix))
    }

    fn of(
        history: &impl SheetHistory,
        t: f64,
        state: impl FnOnce(f64, [[f64; 2]; 2]) -> Result<SheetState<&'a A>, UniformityError>,
    ) -> Result<Self, UniformityError> {
        check_finite("t", &[t])?;
        let time = Jet::<f64, 0>::time(t);
        let (origin, q) = (history.origin(time), history.matrix(time));
        let determinant = q[0][0] * q[1][1] - q[0][1] * q[1][0];
        check_finite("rates", &[origin.rate, origin.second_rate, determinant.rate, determinant.second_rate])?;
        let state = state(origin.value, q.map(|row| row.map(|entry| entry.value)))?;
        let value = |i: usize, j: usize| q[i][j].value;
        let inverse = [[value(1, 1), -value(0, 1)], [-value(1, 0), value(0, 0)]];
        let by_inverse = |part: fn(&Jet<f64, 0>) -> f64| {
            let entry = |i: usize, j: usize| {
                (part(&q[i][0]) * inverse[0][j] + part(&q[i][1]) * inverse[1][j]) / determinant.value
            };
            [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
        };
        let (rate, second_rate) = (by_inverse(|q| q.rate), by_inverse(|q| q.second_rate));
        let motion = Self { state, rate, second_rate, origin, determinant };
        motion.check_potential()?;
        Ok(motion)
    }

    fn check_potential(&self) -> Result<(), UniformityError> {
        let (a, s) = (&self.rate, &self.second_rate);
        let entries = a.as_flattened().iter().map(|a| a * a).chain(s.as_flattened().iter().map(|s| s.abs()));
        let scale = entries.fold(0.0, f64::max);
        let equal = |condition: &'static str, left: f64, right: f64, scale: f64| {
            if (left - right).abs() <= ROUNDING * scale {
                Ok(())
            } else {
                Err(UniformityError::NoAccelerationPotential { condition, left, right })
            }
        };
        match self.state.image {
            Image::Plane => equal("S12 = S21", s[0][1], s[1][0], scale),
            Image::Cylinder => {
                equal("A12 = 0", a[0][1], 0.0, scale.sqrt())?;
                equal("S12 = 0", s[0][1], 0.0, scale)?;
                equal("S21 = 0", s[1][0], 0.0, scale)?;
                equal("S11 = A11 A22", s[0][0], a[0][0] * a[1][1], scale)
            }
        }
    }

    /// The acceleration in physical components, m/s², of the particle with given coordinates in the reference.
    ///
    /// # Errors
    /// As [`SheetState::place`].
    pub fn acceleration(&self, particle: [f64; 3]) -> Result<[f64; 3], UniformityError> {
        let [across, first, second] = self.state.place(particle)?;
        let ([[a11, a12], _], [[s11, s12], [s21, s22]]) = (self.rate, self.second_rate);
        let (along, other) = (s11 * first + s12 * second, s21 * first + s22 * second);
        Ok(match self.state.image {
            Image::Plane => {
                let advance = across - self.state.origin;
                [self.origin.second_rate + self.thinning() * advance, along, other]
            }
            Image::Cylinder => {
                let ([c1, c2], [c1_rate, c2_rate]) = self.radial();
                let turn = a11 * first + a12 * second;
                let rate = 0.5 * (c1 / across + c2 * across);
                let radial = 0.5 * c1_rate / across + (0.5 * c2_rate + 0.25 * c2 * c2) * across
                    - 0.25 * c1 * c1 / across.powi(3);
                [radial - across * turn * turn, across * along + 2.0 * rate * turn, other]
            }
        })
    }

    /// ζ with ẍ = −grad ζ, m²/s².
    ///
    /// # Errors
    /// As [`SheetState::place`].
    pub fn potential(&self, particle: [f64; 3]) -> Result<f64, UniformityError> {
        let [across, first, second] = self.state.place(particle)?;
        let ([[a11, _], _], [[s11, s12], [s21, s22]]) = (self.rate, self.second_rate);
        Ok(match self.state.image {
            Image::Plane => {
                let advance = across - self.state.origin;
                let along = s11 * first * first + (s12 + s21) * first * second + s22 * second * second;
                -(self.origin.second_rate * advance + 0.5 * self.thinning() * advance * advance + 0.5 * along)
            }
            Image::Cylinder => {
                let ([c1, c2], [c1_rate, c2_rate]) = self.radial();
                let square = across * across;
                let radial = 0.5 * c1_rate * across.ln()
                    + (0.25 * c2_rate + 0.125 * c2 * c2) * square
                    + 0.125 * c1 * c1 / square;
                let turn = 0.5 * a11 * (c1 - a11 * square) * first * first;
                -(radial + turn + 0.5 * s22 * second * second)
            }
        })
    }

    /// T = `T_static` − ρ ζ 1, Pa, with T₁₁ of the static stress given at the inner face and the density ρ, kg/m³.
    ///
    /// # Errors
    /// As [`SheetState::stress`]; [`UniformityError::OutOfBounds`] for ρ < 0.
    pub fn stress(
        &self,
        law: &impl Isochoric,
        density: f64,
        normal_stress: f64,
        particle: [f64; 3],
    ) -> Result<LaminaStress, UniformityError> {
        check_bound("density", density, "0 ≤ ρ", 0.0 <= density)?;
        let inertia = density * self.potential(particle)?;
        let mut stress = self.state.stress(law, particle[0], normal_stress)?;
        for component in &mut stress.cauchy.0.components[..3] {
            *component -= inertia;
        }
        stress.pressure += inertia;
        Ok(stress)
    }

    /// Δ (1/Δ)¨ = 2 (Δ̇/Δ)² − Δ̈/Δ.
    fn thinning(&self) -> f64 {
        let Jet { value, rate, second_rate, .. } = self.determinant;
        2.0 * (rate / value).powi(2) - second_rate / value
    }

    /// [c₁, c₂] of 2 r ṙ = c₁ + c₂ r², and their rates.
    fn radial(&self) -> ([f64; 2], [f64; 2]) {
        let square = self.origin * self.origin;
        let Jet { value, rate, second_rate, .. } = self.determinant;
        let swelling = rate / value;
        let swelling_rate = second_rate / value - swelling * swelling;
        let first = square.rate + swelling * square.value;
        let first_rate = square.second_rate + swelling_rate * square.value + swelling * square.rate;
        ([first, -swelling], [first_rate, -swelling_rate])
    }
}

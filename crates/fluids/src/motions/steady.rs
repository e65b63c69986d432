//! The steady stress of a mode at any constant velocity gradient.

use nalgebra::{Matrix3, Matrix6, Schur};
use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_numerics::linear::lu;
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::{Rows, product};

use super::stress_rate::{StressRate, carrying};
use crate::{DifferentialFluid, FluidsError};

/// Iterations of Newton's method at one L: from rest, and from a state nearby.
const FROM_REST: usize = 60;
const FROM_NEAR: usize = 12;
/// Steps of L at most, and the smallest beside L where the state may end.
const STEPS: usize = 400;
const SMALLEST: f64 = 1e-4;

/// The equation of a mode without units, along axes that are stretched by powers of two so that L is balanced:
///
/// ```text
/// S E S = R(y) − w y − y wᵀ − 2 w_D = 0      S y S = λ τ/ηₚ,   w = λ S⁻¹ (L − ξ D) S,   w_D = λ S⁻¹ D S⁻¹
/// ```
/// What is nearly nilpotent, such as a fast shear along the axes, so loses nothing to its size.
struct Balanced<'a, M, T> {
    mode: &'a M,
    /// The diagonal of S.
    scale: [f64; 3],
    /// w.
    carrying: Rows<T>,
    /// Twice λ S⁻¹ D S⁻¹.
    drawing: Symmetric<T>,
}

/// A solution of the equation, and the factors of its derivative.
struct Solution {
    stress: Symmetric,
    factors: [f64; 36],
    exchanges: [usize; 6],
}

/// Powers of two by which the axes are stretched, so that of L's components off the diagonal those above are not much larger
/// than those below, or else than the components on it and 1.
fn balance(w: Rows<f64>) -> [f64; 3] {
    let floor = 1.0 + w[0][0].abs().max(w[1][1].abs()).max(w[2][2].abs());
    let mut exponents = [0; 3];
    for _ in 0..64 {
        let mut moved = false;
        for i in 0..3 {
            let entry =
                |row: usize, column: usize| w[row][column].abs() * 2.0_f64.powi(exponents[column] - exponents[row]);
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let row = entry(i, j).max(entry(i, k)).max(floor);
            let column = entry(j, i).max(entry(k, i)).max(floor);
            #[expect(clippy::cast_possible_truncation, reason = "exponents of doubles")]
            let by = (0.5 * (row / column).log2()).round() as i32;
            exponents[i] += by;
            moved |= by != 0;
        }
        if !moved {
            break;
        }
    }
    exponents.map(|exponent| 2.0_f64.powi(exponent))
}

/// S a S.
fn stretched<T: Real>(a: &Symmetric<T>, scale: [f64; 3]) -> Symmetric<T> {
    let [x, y, z] = scale;
    let factors = [x * x, y * y, z * z, x * y, y * z, x * z];
    Symmetric { components: core::array::from_fn(|i| a.components[i] * T::lit(factors[i])) }
}

impl<'a, M: StressRate, T: Real> Balanced<'a, M, T> {
    fn new(mode: &'a M, velocity_gradient: &VelocityGradient<T>) -> Self {
        let time = T::lit(mode.time());
        let l = carrying(mode, velocity_gradient).rows().map(|row| row.map(|x| x * time));
        let scale = balance(l.map(|row| row.map(|x| x.primal(0))));
        let carrying = core::array::from_fn(|i| core::array::from_fn(|j| l[i][j] * T::lit(scale[j] / scale[i])));
        let drawing = stretched(&(velocity_gradient.rate_of_deformation().0 * (time + time)), scale.map(f64::recip));
        Self { mode, scale, carrying, drawing }
    }

    /// S⁻¹ E S⁻¹ at y with L times `share`.
    fn excess<S: Real>(&self, y: &Symmetric<S>, share: f64, lift: impl Fn(T) -> S) -> Symmetric<S> {
        let modulus = self.mode.polymer_viscosity() / self.mode.time();
        let relaxing = self.mode.relaxing(&(stretched(y, self.scale) * S::lit(modulus)));
        let relaxing = stretched(&relaxing, self.scale.map(f64::recip)) * S::lit(modulus.recip());
        let share = S::lit(share);
        let w: Rows<S> = self.carrying.map(|row| row.map(|x| lift(x) * share));
        let drawing = Symmetric { components: self.drawing.components.map(|x| lift(x) * share) };
        relaxing - Symmetric::sum_with_transpose(product(w, y.rows())) - drawing
    }
}

impl<M: StressRate> Balanced<'_, M, f64> {
    /// Newton's method at L times `share`, from y.
    fn newton(&self, mut y: Symmetric, share: f64, iterations: usize) -> Option<Solution> {
        let mut settled = false;
        for _ in 0..iterations {
            let variable = Symmetric { components: core::array::from_fn(|i| Gradient::variable(y.components[i], i)) };
            let excess = self.excess(&variable, share, Gradient::<f64, 6>::constant).components;
            let mut factors = [0.0; 36];
            for (column, entries) in factors.chunks_exact_mut(6).enumerate() {
                entries.copy_from_slice(&excess.map(|e| e.partials[column]));
            }
            let mut exchanges = [0; 6];
            lu::factor_in_place(&mut factors, &mut exchanges).ok()?;
            let mut step = excess.map(|e| e.value);
            lu::solve_in_place(&factors, &exchanges, &mut step).ok()?;
            if settled {
                // In a fast flow along no axes rounding may hide whether it is definite: then whether it is stable tells.
                let derivative = Matrix6::from_fn(|row, column| excess[row].partials[column]);
                let reached = self.is_definite(&y) || is_stable(&derivative);
                return reached.then_some(Solution { stress: y, factors, exchanges });
            }
            let step = Symmetric { components: step };
            y -= step;
            let size = y.norm();
            if !size.is_finite() {
                return None;
            }
            settled = step.norm() <= 1e-9 * size;
        }
        None
    }

    /// Whether S⁻¹ (1 + (1 − ξ) S y S) S⁻¹ is positive definite, beyond rounding.
    fn is_definite(&self, y: &Symmetric) -> bool {
        let rest = stretched(&Symmetric::identity(), self.scale.map(f64::recip));
        let change = *y * (1.0 - self.mode.slip());
        let size = |i: usize| 16.0 * f64::EPSILON * (rest.components[i] + change.components[i].abs());
        let [a, b, c, d, e, f] = (rest + change).components;
        // The pivots of L D Lᵀ.
        let (first, second) = (a, b - d * (d / a));
        let across = e - d * (f / a);
        let third = c - f * (f / a) - across * (across / second);
        size(0) < first && size(1) < second && size(2) < third
    }

    /// From rest, and where that fails along L that grows from zero.
    fn solve(&self) -> Option<Solution> {
        let rest = Symmetric::zero();
        if let Some(solution) = self.newton(rest, 1.0, FROM_REST) {
            return Some(solution);
        }
        let size = self.carrying.as_flattened().iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        let (mut y, mut share, mut step) = (rest, 0.0, 0.05 / size);
        for _ in 0..STEPS {
            let next = (share + step).min(1.0);
            match self.newton(y, next, FROM_NEAR) {
                Some(solution) if 1.0 <= next => return Some(solution),
                Some(solution) => {
                    y = solution.stress;
                    share = next;
                    step *= 2.0;
                }
                None if SMALLEST * share < step => step *= 0.25,
                None => return None,
            }
        }
        None
    }
}

/// Whether the state is stable: all eigenvalues of the derivative have positive real parts.
fn is_stable(derivative: &Matrix6<f64>) -> bool {
    let schur = Schur::try_new(*derivative, f64::EPSILON, 1000);
    schur.is_some_and(|schur| schur.complex_eigenvalues().iter().all(|eigenvalue| 0.0 < eigenvalue.re))
}

/// The stress of a differential fluid in any steady motion.
pub trait SteadyStress: DifferentialFluid<Mode: StressRate> {
    /// T + p 1, Pa, in a steady motion with the velocity gradient L since always; over dual numbers with its derivative.
    ///
    /// ```text
    /// R(τ) − λ (L τ + τ Lᵀ) = 2 ηₚ D      with L − ξ D in the place of L where the polymer slips
    /// ```
    /// The state is the one that a motion started from rest ends in: that of a positive definite conformation
    /// 1 + (1 − ξ) (λ/ηₚ) τ, which is unique and stable. It is found by Newton's method from rest, and where that fails along L that
    /// grows from zero; derivatives are those of the equation. Each state takes steps of its own, so that lanes would wait for the
    /// slowest at every one: a call over lanes does not compile. In shear the viscometric functions of
    /// [`batch`](crate::batch) run in lanes.
    ///
    /// # Errors
    /// [`FluidsError::BeyondLimit`] where there is none: the stress would grow without end.
    ///
    /// # Accuracy
    /// That of a linear system of six equations, balanced; diagonal for a diagonal L.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Giesekus, SteadyStress, ViscometricFluid};
    /// use piola_continuum::rates::VelocityGradient;
    /// use piola_numerics::Dual;
    /// let fluid = Giesekus::new(0.0, 2.0, 0.5, 0.25)?;
    /// let zero = Dual::constant(0.0_f64);
    /// let shear = VelocityGradient::from_rows([[zero; 3], [Dual::variable(4.0_f64), zero, zero], [zero; 3]])?;
    /// let stress = fluid.steady_stress(&shear)?.components[3];
    /// let function = fluid.shear_stress(Dual::variable(4.0));
    /// assert!((stress.value - function.value).abs() < 1e-14);
    /// assert!((stress.tangent - function.tangent).abs() < 1e-14); // dT₁₂/dk
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    fn steady_stress<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> Result<Symmetric<T>, FluidsError> {
        let mut total = velocity_gradient.rate_of_deformation().0 * T::lit(2.0 * self.total_solvent_viscosity());
        for mode in self.modes() {
            total += steady_mode(mode, velocity_gradient)?;
        }
        Ok(total)
    }
}

impl<F: DifferentialFluid<Mode: StressRate> + ?Sized> SteadyStress for F {}

/// τ, Pa, of one mode.
pub(super) fn steady_mode<M: StressRate, T: Real>(
    mode: &M,
    velocity_gradient: &VelocityGradient<T>,
) -> Result<Symmetric<T>, FluidsError> {
    const { assert!(T::LANES == 1, "steady states are found one at a time") };
    let problem = Balanced::new(mode, velocity_gradient);
    let values = Balanced {
        mode,
        scale: problem.scale,
        carrying: problem.carrying.map(|row| row.map(|x| x.primal(0))),
        drawing: Symmetric { components: problem.drawing.components.map(|x| x.primal(0)) },
    };
    let Some(solution) = values.solve() else {
        // Stretching the axes leaves eigenvalues as they are.
        let carrying = Matrix3::from_fn(|row, column| values.carrying[row][column]);
        let largest = carrying.complex_eigenvalues().iter().fold(f64::NEG_INFINITY, |largest, own| largest.max(own.re));
        return Err(FluidsError::BeyondLimit {
            law: M::NAME,
            quantity: "the largest real part of an eigenvalue of 2 λ (L − ξ D)",
            value: 2.0 * largest,
            limit: 1.0,
        });
    };
    let mut y = Symmetric { components: solution.stress.components.map(T::lit) };
    let factors = solution.factors.map(T::lit);
    // Derivatives enter one order a step.
    for _ in 0..T::ORDER {
        let mut step = problem.excess(&y, 1.0, |x| x).components;
        lu::solve_in_place(&factors, &solution.exchanges, &mut step).map_err(|_| FluidsError::NotFinite {
            law: M::NAME,
            parameter: "L",
            value: f64::NAN,
        })?;
        y -= Symmetric { components: step };
    }
    Ok(stretched(&y, problem.scale) * T::lit(mode.polymer_viscosity() / mode.time()))
}

//! The Boltzmann–Hamel equations as they are written, term by term.

use nalgebra::DVector;
use piola_kinematics::Holonomic;
use piola_numerics::Dual;

use super::map::dot;
use super::workspace::Workspace;
use super::{InFrame, QuasiVelocities};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};
use crate::{Forces, Potential};

/// The terms of the Boltzmann–Hamel equations along a motion, one entry for each vector of the frame.
///
/// # Example
/// See [`InFrame`].
#[derive(Clone, Debug, PartialEq)]
pub struct BoltzmannHamel {
    /// d/dt(∂L̄/∂u^A).
    pub momentum_rate: DVector<f64>,
    /// k_A(L̄): the derivative of L̄(q, u, t) along k_A at fixed u.
    pub lagrangian_derivative: DVector<f64>,
    /// (K^C_AB u^B + K^C_A0) ∂L̄/∂u^C.
    pub structure_term: DVector<f64>,
    /// Ω_A.
    pub force: DVector<f64>,
}

impl BoltzmannHamel {
    /// What is left over: zero along a free motion, the reactions along a constrained one.
    #[must_use]
    pub fn residual(&self) -> DVector<f64> {
        &self.momentum_rate - &self.lagrangian_derivative + &self.structure_term - &self.force
    }
}

impl<S: Holonomic, P: Potential, F: Forces, W: QuasiVelocities> InFrame<S, P, F, W> {
    /// The terms of the Boltzmann–Hamel equations at a state (q, u) with given rates u̇.
    ///
    /// ```text
    /// d/dt(∂L̄/∂u^A) − k_A(L̄) + (K^C_AB u^B + K^C_A0) ∂L̄/∂u^C = Ω_A,   L̄(q, u, t) = L(q, k_A u^A + d, t)   W(6.29)
    /// ```
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, u, u̇ | `q`, `u`, `rates` | n | the coordinates' and the frame's own |
    /// | Ω_A | `force` of the result | n | J over the unit of ∫u dt |
    ///
    /// For reading and for checks: [`acceleration`](Self::acceleration) finds the same motion at a fraction of the
    /// cost.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`], [`AnholonomicError::SingularFrame`](crate::AnholonomicError::SingularFrame).
    ///
    /// # Accuracy
    /// A few ulp of the terms, times the condition number of the frame.
    ///
    /// # Source
    /// W(6.13), W(6.21), W(6.29).
    pub fn boltzmann_hamel(
        &self,
        q: &[f64],
        u: &[f64],
        rates: &[f64],
        t: f64,
    ) -> Result<BoltzmannHamel, LagrangianError> {
        let n = q.len();
        check_length("u̇", n, rates.len())?;
        check_finite("u̇", rates)?;
        let v = self.velocities(q, u, t)?;
        let mut map = Workspace::default().map;
        map.evaluate(self.map(), q, t)?;
        let frame = map.frame.clone();
        let vector = |a: usize| &frame[a * n..(a + 1) * n];

        // Along the motion: q̈ and ṗ.
        let mut change = vec![0.0; n];
        map.differentiate(self.map(), q, t, (v.as_slice(), 1.0));
        map.velocity_change_into::<W>(u, v.as_slice(), &mut change)?;
        let mut acceleration = change;
        map.add_combination(rates, &mut acceleration);
        let moving = |x: &[f64], rate: &[f64]| -> Vec<Dual<f64>> {
            x.iter().zip(rate).map(|(&x, &rate)| Dual::new(x, rate)).collect()
        };
        let momenta = self.lagrangian().momenta(
            &moving(q, v.as_slice()),
            &moving(v.as_slice(), &acceleration),
            Dual::variable(t),
        )?;
        let values: Vec<f64> = momenta.iter().map(|p| p.value).collect();

        let (mut momentum_rate, mut lagrangian_derivative) = (DVector::zeros(n), DVector::zeros(n));
        let mut vector_rate = vec![0.0; n];
        for a in 0..n {
            // d/dt (k_A·p) along the motion, by which the frame was last differentiated.
            map.vector_rate_into::<W>(a, &mut vector_rate)?;
            let of_momenta: f64 = vector(a).iter().zip(&momenta).map(|(k, p)| k * p.tangent).sum();
            momentum_rate[a] = of_momenta + dot(&vector_rate, &values);
        }
        for a in 0..n {
            let mut change = vec![0.0; n];
            map.differentiate(self.map(), q, t, (vector(a), 0.0));
            map.velocity_change_into::<W>(u, v.as_slice(), &mut change)?;
            let moved = (moving(q, vector(a)), moving(v.as_slice(), &change));
            let energies = self.lagrangian().energies(&moved.0, &moved.1, Dual::constant(t))?;
            lagrangian_derivative[a] = energies.lagrangian().tangent;
        }

        let mut coefficients = Vec::new();
        map.structure_into(self.map(), q, t, &mut coefficients)?;
        let mut structure_term = DVector::zeros(n);
        let of_frame: Vec<f64> = (0..n).map(|a| dot(vector(a), &values)).collect();
        for a in 0..n {
            for b in 0..=n {
                let start = n * (b + (n + 1) * a);
                let rate = if b == n { 1.0 } else { u[b] };
                structure_term[a] += rate * dot(&coefficients[start..start + n], &of_frame);
            }
        }
        Ok(BoltzmannHamel {
            momentum_rate,
            lagrangian_derivative,
            structure_term,
            force: self.generalised_forces(q, u, t)?,
        })
    }
}

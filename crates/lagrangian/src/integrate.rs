//! The motion in time, with a method chosen for it.

use core::ops::Range;

use piola_integrators::Tolerance;
use piola_kinematics::Holonomic;

use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::Run;
use crate::record::{Certificate, record};

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Integrates the motion from (q, q̇) over a span of time and keeps every step.
    ///
    /// The method is the adaptive one of order eight; its global error is estimated by a second run with a
    /// hundredth of the tolerance, which costs about 1.8 times the first. For a method of your choice, an
    /// observer, dense output or events, give [`motion`](Self::motion) to an integrator.
    ///
    /// # Errors
    /// What [`check`](Self::check) refuses; [`LagrangianError::Unfinished`] when the run fails: it holds the steps
    /// made until then.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_integrators::Tolerance;
    /// # struct Pendulum { mass: f64, length: f64 }
    /// # impl Holonomic for Pendulum {
    /// #     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    /// #         let (s, c) = q[0].sin_cos();
    /// #         let length = T::lit(self.length);
    /// #         bodies.particle(self.mass, Vector3::new(length * s, T::zero(), -length * c));
    /// #     }
    /// # }
    /// let pendulum = Lagrangian::of(Pendulum { mass: 1.0, length: 1.0 }).with_gravity(9.80665);
    /// let run = pendulum.integrate(&[1.0], &[0.0], 0.0..60.0, Tolerance::relative(1e-10)?)?;
    /// assert!(run.energy_drift() < 1e-8 && run.error_estimate() < 1e-7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn integrate(
        &self,
        q: &[f64],
        v: &[f64],
        times: Range<f64>,
        tolerance: Tolerance,
    ) -> Result<Run, LagrangianError> {
        self.check(q, v, times.start)?;
        let n = q.len();
        let (mut work, mut momenta) = (Workspace::default(), vec![0.0; n]);
        record(
            || self.motion(n),
            n,
            &[q, v].concat(),
            times,
            tolerance,
            |time, state| {
                let (q, v) = state.split_at(n);
                let energies = self.energies_with(&mut work, q, v, time)?;
                self.momenta_into(&mut work, q, v, time, &mut momenta)?;
                let h = momenta.iter().zip(v).map(|(p, v)| p * v).sum::<f64>() - energies.lagrangian();
                Ok(Certificate { integral: h, kinetic: energies.kinetic, ..Certificate::default() })
            },
        )
    }
}

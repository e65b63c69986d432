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
            |_| Vec::new(),
        )
    }
}

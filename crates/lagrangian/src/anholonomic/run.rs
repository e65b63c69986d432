//! The motion in time, with a method chosen for it.

use core::ops::Range;

use piola_integrators::Tolerance;
use piola_kinematics::Holonomic;

use super::workspace::Workspace;
use super::{Nonholonomic, QuasiVelocities};
use crate::LagrangianError;
use crate::Run;
use crate::record::{Certificate, record};
use crate::{Forces, Potential};

impl<S: Holonomic, P: Potential, F: Forces, W: QuasiVelocities> Nonholonomic<S, P, F, W> {
    /// Integrates the motion from (q, w) over a span of time and keeps every step.
    ///
    /// The method is the adaptive one of order eight; its global error is estimated by a second run with a
    /// hundredth of the tolerance. For a method of your choice, an observer, dense output or events, give
    /// [`motion`](Self::motion) to an integrator.
    ///
    /// # Errors
    /// What [`Lagrangian::check`](crate::Lagrangian::check) and [`velocities`](Self::velocities)
    /// refuse; [`LagrangianError::Unfinished`] when the run fails: it holds the steps made until then.
    ///
    /// # Example
    /// ```
    /// use piola_lagrangian::anholonomic::rolling::RollingDisc;
    /// use piola_integrators::Tolerance;
    /// let coin = RollingDisc::homogeneous(5.7e-3, 12e-3)?.on_plane([0.0, 0.0, -9.81]);
    /// let (q, w) = ([0.0, 0.0, 0.0, 1.5, 0.0], [0.0, 0.0, -40.0]);
    /// let run = coin.integrate(&q, &w, 0.0..1.0, Tolerance::relative(1e-10)?)?;
    /// assert!(run.energy_drift() < 1e-9 && run.error_estimate() < 1e-7);
    /// assert_eq!(run.velocities(0), Some(&w[..]));
    /// let (end, _) = run.last();
    /// assert!(0.2 < end[1]); // it started along y
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn integrate(
        &self,
        q: &[f64],
        w: &[f64],
        times: Range<f64>,
        tolerance: Tolerance,
    ) -> Result<Run, LagrangianError> {
        let n = q.len();
        let start = self.velocities(q, w, times.start)?;
        self.unconstrained().lagrangian().check(q, start.as_slice(), times.start)?;
        let (mut work, mut v) = (Workspace::default(), vec![0.0; n]);
        record(
            || self.motion(n),
            n,
            &[q, w].concat(),
            times,
            tolerance,
            |time, state| {
                let (q, w) = state.split_at(n);
                self.spread(&mut work, q, w)?;
                work.map.evaluate(self.unconstrained().map(), q, time)?;
                work.map.velocities_into(&work.quasi, &mut v);
                let energies = self.unconstrained().lagrangian().energies_with(&mut work.lagrangian, q, &v, time)?;
                Ok(Certificate { integral: energies.total(), kinetic: energies.kinetic, ..Certificate::default() })
            },
            |_| Vec::new(),
        )
    }
}

//! One pass over the parts along a motion: where each is, how it moves, what acts on it.
//!
//! ```text
//! m a = f_e + f_c        M a^c = F_e + F_c        I ω̇ + ω×Iω = G_e + G_c                      W(5.1–5.3)
//! v = h_Δ q̇^Δ + ∂x/∂t    ω = ω_Δ q̇^Δ + ω_t                                                 W(3.28–3.31)
//! ```

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};
use piola_numerics::{Jet, Real};

use super::collect::{cross, dot, inertia_times, turning};
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::check_length;

/// A part along the motion. The moments of a body are about its centre of mass, in body components.
pub(super) struct PartState<T> {
    pub(super) position: [T; 3],
    pub(super) velocity: [T; 3],
    /// ∂x/∂t at fixed coordinates.
    pub(super) drift: [T; 3],
    /// m a.
    pub(super) inertia_force: [T; 3],
    /// m g.
    pub(super) weight: [T; 3],
    /// The applied force.
    pub(super) force: [T; 3],
    /// What a body has more than a particle.
    pub(super) turning: Option<TurningState<T>>,
}

/// The rotation of a body along the motion.
pub(super) struct TurningState<T> {
    pub(super) attitude: Attitude<T>,
    pub(super) angular_velocity: [T; 3],
    /// ω_t: the angular velocity at fixed coordinates.
    pub(super) drift: [T; 3],
    /// I ω̇ + ω×Iω.
    pub(super) inertia_moment: [T; 3],
    /// The applied moment.
    pub(super) moment: [T; 3],
}

impl<T: Real> PartState<T> {
    /// f_c: the force that is neither weight nor applied.
    pub(super) fn reaction(&self) -> [T; 3] {
        core::array::from_fn(|k| self.inertia_force[k] - self.weight[k] - self.force[k])
    }
}

impl<T: Real> TurningState<T> {
    /// G_c.
    pub(super) fn reaction(&self) -> [T; 3] {
        core::array::from_fn(|k| self.inertia_moment[k] - self.moment[k])
    }
}

/// ∂x/∂t, where it is carried; nothing without.
fn drift<T: Real, const D: usize>(x: Jet<T, D>) -> T {
    x.partials.first().copied().unwrap_or_else(T::zero)
}

/// Shows every part to a visitor. D is one where the time is a direction, or zero.
struct Tour<'a, T, F, V, const D: usize> {
    forces: &'a F,
    gravity: [f64; 3],
    t: T,
    part: usize,
    visit: V,
}

impl<T: Real, F: Forces, V: FnMut(usize, PartState<T>), const D: usize> Tour<'_, T, F, V, D> {
    fn translation(&self, mass: f64, x: &Vector3<Jet<T, D>>) -> PartState<T> {
        let x = [x.x, x.y, x.z];
        let (position, velocity) = (x.map(|x| x.value), x.map(|x| x.rate));
        let force =
            if F::ON_PARTS { self.forces.on_part(self.part, position, velocity, self.t) } else { [T::zero(); 3] };
        PartState {
            position,
            velocity,
            drift: x.map(drift),
            inertia_force: x.map(|x| T::lit(mass) * x.second_rate),
            weight: self.gravity.map(|g| T::lit(mass * g)),
            force,
            turning: None,
        }
    }
    fn show(&mut self, state: PartState<T>) {
        (self.visit)(self.part, state);
        self.part += 1;
    }
}

impl<T: Real, F: Forces, V: FnMut(usize, PartState<T>), const D: usize> Placement<Jet<T, D>> for Tour<'_, T, F, V, D> {
    fn particle(&mut self, mass: f64, position: Vector3<Jet<T, D>>) {
        let state = self.translation(mass, &position);
        self.show(state);
    }

    fn body(&mut self, body: &RigidBody, centre: Vector3<Jet<T, D>>, attitude: Attitude<Jet<T, D>>) {
        let mut state = self.translation(body.mass(), &centre);
        let jets = [attitude.w, attitude.x, attitude.y, attitude.z];
        let q = jets.map(|jet| jet.value);
        let angular_velocity = turning(q, jets.map(|jet| jet.rate));
        // q̇* q̇ has no vector part, so that the second rate alone turns into ω̇.
        let angular_acceleration = turning(q, jets.map(|jet| jet.second_rate));
        let spin_rate = inertia_times(body, angular_acceleration);
        let gyroscopic = cross(angular_velocity, inertia_times(body, angular_velocity));
        let [w, x, y, z] = q;
        let attitude = Attitude { w, x, y, z };
        let moment = if F::MOMENTS {
            self.forces.moment_on_body(self.part, attitude, angular_velocity, self.t)
        } else {
            [T::zero(); 3]
        };
        state.turning = Some(TurningState {
            attitude,
            angular_velocity,
            drift: turning(q, jets.map(drift)),
            inertia_moment: core::array::from_fn(|k| spin_rate[k] + gyroscopic[k]),
            moment,
        });
        self.show(state);
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Shows the parts at (q, q̇, q̈, t) in the order of placement, without drifts; returns how many there are.
    pub(super) fn tour<T: Real>(
        &self,
        work: &mut Workspace<T>,
        state: (&[T], &[T], &[T]),
        t: T,
        visit: impl FnMut(usize, PartState<T>),
    ) -> Result<usize, LagrangianError> {
        let time = if S::TIME_DEPENDENT { Jet::time(t) } else { Jet::constant(t) };
        self.tour_over(&mut work.moving, state, (t, time), visit)
    }

    /// [`tour`](Self::tour) with the drifts of a placement that depends on time; others do not pay for them.
    pub(super) fn tour_with_drift<T: Real>(
        &self,
        work: &mut Workspace<T>,
        state: (&[T], &[T], &[T]),
        t: T,
        visit: impl FnMut(usize, PartState<T>),
    ) -> Result<usize, LagrangianError> {
        if S::TIME_DEPENDENT {
            let time = Jet { value: t, partials: [T::one()], rate: T::one(), second_rate: T::zero() };
            self.tour_over(&mut work.timed, state, (t, time), visit)
        } else {
            self.tour(work, state, t, visit)
        }
    }

    fn tour_over<T: Real, const D: usize>(
        &self,
        jets: &mut Vec<Jet<T, D>>,
        (q, v, a): (&[T], &[T], &[T]),
        (t, time): (T, Jet<T, D>),
        visit: impl FnMut(usize, PartState<T>),
    ) -> Result<usize, LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        check_length("q̈", q.len(), a.len())?;
        let along = |((&value, &rate), &second_rate)| Jet { value, partials: [T::zero(); D], rate, second_rate };
        jets.clear();
        jets.extend(q.iter().zip(v).zip(a).map(along));
        let mut tour = Tour { forces: &self.forces, gravity: self.gravity, t, part: 0, visit };
        self.system.place(jets, time, &mut tour);
        Ok(tour.part)
    }

    /// Runs `body` with the accelerations at (q, q̇, t), in memory lent by the workspace.
    pub(super) fn with_acceleration<T: Real, R>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        body: impl FnOnce(&mut Workspace<T>, &[T]) -> Result<R, LagrangianError>,
    ) -> Result<R, LagrangianError> {
        let mut acceleration = core::mem::take(&mut work.lent);
        acceleration.clear();
        acceleration.resize(q.len(), T::zero());
        let result = self.acceleration_into(work, q, v, t, &mut acceleration).and_then(|()| body(work, &acceleration));
        work.lent = acceleration;
        result
    }
}

/// f·v + G·ω.
pub(super) fn power<T: Real>(force: [T; 3], velocity: [T; 3], moment: [T; 3], angular_velocity: [T; 3]) -> T {
    dot(force, velocity) + dot(moment, angular_velocity)
}

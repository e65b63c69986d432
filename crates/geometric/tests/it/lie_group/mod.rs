//! Integration on Lie groups: the groups, the orders, tops, the damping of generalised-α, failures.

mod adaptive;
mod allocations;
mod generalised_alpha;
mod groups;
mod laws;
mod orders;
mod tops;
mod traps;

use core::convert::Infallible;

use piola_geometric::{DirectProduct, GroupField, GroupMotion, Rotations, Translations};
use piola_integrators::State;
use piola_numerics::Real;
use piola_testkit::golden::{self, number, text, vector};

/// A body about a fixed point, J Ω̇ = J Ω × Ω + w × Rᵀ(0, 0, −1), Ω in body components: as one group (q, Ω) and as a motion.
#[derive(Clone, Debug)]
pub(crate) struct Top {
    group: DirectProduct<Rotations, Translations>,
    pub(crate) inertia: [f64; 3],
    /// Weight times the arm to the centre of mass, N m.
    pub(crate) weight: [f64; 3],
}

pub(crate) fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The third row of R(q): the vertical in body components.
pub(crate) fn vertical<T: Real>(q: &[T]) -> [T; 3] {
    let two = T::lit(2.0);
    let middle = q[0] * q[0] - q[1] * q[1] - q[2] * q[2] + q[3] * q[3];
    [two * (q[1] * q[3] - q[0] * q[2]), two * (q[2] * q[3] + q[0] * q[1]), middle]
}

impl Top {
    pub(crate) const fn new(inertia: [f64; 3], weight: [f64; 3]) -> Self {
        Self { group: DirectProduct(Rotations, Translations(3)), inertia, weight }
    }

    /// J Ω.
    pub(crate) fn angular_momentum<T: Real>(&self, omega: &[T]) -> [T; 3] {
        core::array::from_fn(|i| T::lit(self.inertia[i]) * omega[i])
    }

    fn moment<T: Real>(&self, q: &[T], omega: &[T]) -> [T; 3] {
        let gyroscopic = cross(self.angular_momentum(omega), [omega[0], omega[1], omega[2]]);
        let weight = cross(vertical(q), self.weight.map(T::lit));
        core::array::from_fn(|i| gyroscopic[i] + weight[i])
    }

    /// ½ Ω·J Ω and the height, of a state (q, Ω).
    pub(crate) fn energy(&self, y: &[f64]) -> f64 {
        let momentum = self.angular_momentum(&y[4..]);
        let up = vertical(&y[..4]);
        (0..3).map(|i| 0.5 * momentum[i] * y[4 + i] + self.weight[i] * up[i]).sum()
    }
}

impl<T: Real> GroupField<T> for Top {
    type Error = Infallible;
    type Group = DirectProduct<Rotations, Translations>;
    fn group(&self) -> &Self::Group {
        &self.group
    }
    fn velocity(&mut self, _t: f64, y: &[T], velocity: &mut [T]) -> Result<(), Infallible> {
        let moment = self.moment(&y[..4], &y[4..]);
        for i in 0..3 {
            velocity[i] = y[4 + i];
            velocity[3 + i] = moment[i] * T::lit(1.0 / self.inertia[i]);
        }
        Ok(())
    }
}

impl<T: Real> GroupMotion<T> for Top {
    type Error = Infallible;
    type Group = Rotations;
    fn group(&self) -> &Rotations {
        &Rotations
    }
    fn residual(&mut self, _t: f64, q: &[T], omega: &[T], rate: &[T], residual: &mut [T]) -> Result<(), Infallible> {
        let moment = self.moment(q, omega);
        for i in 0..3 {
            residual[i] = T::lit(self.inertia[i]) * rate[i] - moment[i];
        }
        Ok(())
    }
}

/// A top of `tops.json`: its start and its states (q, Ω) at later times.
pub(crate) fn reference(name: &str) -> (Top, State, Vec<(f64, Vec<f64>)>) {
    let golden = golden::load("tops");
    let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
    let triple = |key: &str| <[f64; 3]>::try_from(vector(&case[key])).unwrap();
    let q = vector(&case["attitude"]);
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    let start = q.iter().map(|x| x / length).chain(triple("angular_velocity")).collect();
    let states = case["states"].as_array().unwrap().iter();
    let states = states.map(|s| (number(&s["t"]), [vector(&s["attitude"]), vector(&s["angular_velocity"])].concat()));
    (Top::new(triple("inertia"), triple("weight_times_arm")), State::new(0.0, start).unwrap(), states.collect())
}

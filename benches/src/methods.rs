//! Methods for one kind of problem each: planets, tops, stiff equations.

use core::convert::Infallible;

use nalgebra::Vector3;
use piola_geometric::{AdaptiveMuntheKaas, DirectProduct, GroupField, MuntheKaas, Rotations, Translations};
use piola_gravitation::Gravitation;
use piola_gravitation::kepler::advance;
use piola_gravitation::wisdom_holman::{Corrector, Splitting, WisdomHolman};
use piola_integrators::{
    Field, GaussLegendre16, Nystrom1210, Order, Report, SecondOrder, State, Tolerance, TurningFrame,
};
use piola_kinematics::{Attitude, FreeRotation, HeavyTop, Inertia};
use piola_numerics::Real;
use piola_stiff::{Differentiable, ExactJacobian, RadauIia};

use crate::problems::{Arenstorf, Attraction, Kepler, Problem, Top};
use crate::work_precision::{Family, Method, Outcome, step_counts};

/// A top as a field on the group of rotations and angular velocities.
#[derive(Clone, Debug)]
pub struct TopOnGroup {
    top: Top,
    group: DirectProduct<Rotations, Translations>,
}

impl TopOnGroup {
    /// The top.
    #[must_use]
    pub const fn new(top: Top) -> Self {
        Self { top, group: DirectProduct(Rotations, Translations(3)) }
    }
}

impl<T: Real> GroupField<T> for TopOnGroup {
    type Error = Infallible;
    type Group = DirectProduct<Rotations, Translations>;
    fn group(&self) -> &Self::Group {
        &self.group
    }
    fn velocity(&mut self, _t: f64, y: &[T], velocity: &mut [T]) -> Result<(), Infallible> {
        let omega = [y[4], y[5], y[6]];
        velocity[..3].copy_from_slice(&omega);
        velocity[3..].copy_from_slice(&self.top.angular_acceleration([y[0], y[1], y[2], y[3]], omega));
        Ok(())
    }
}

fn outcome(report: Report, state: State) -> Outcome {
    Outcome { state: state.values, evaluations: report.evaluations, steps: report.steps }
}

fn begin(start: &[f64]) -> Result<State, String> {
    State::new(0.0, start.to_vec()).map_err(|error| error.to_string())
}

/// Both methods of Munthe-Kaas, adaptive and with a fixed step, on a top.
#[must_use]
pub fn on_the_group(problem: &Problem<Top, 7>, fewest: f64) -> [Method<'_>; 2] {
    let adaptive = move |tolerance: f64| {
        let mut state = begin(&problem.start)?;
        let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
        let mut top = TopOnGroup::new(problem.equations);
        let report = AdaptiveMuntheKaas::new(tolerance).integrate_to(&mut top, &mut state, problem.end);
        Ok(outcome(report.map_err(|error| error.to_string())?, state))
    };
    let fixed = move |steps: f64| {
        let mut state = begin(&problem.start)?;
        let mut top = TopOnGroup::new(problem.equations);
        let mut method = MuntheKaas::new(Order::Eight, problem.end / steps).map_err(|error| error.to_string())?;
        let report = method.integrate_to(&mut top, &mut state, problem.end).map_err(|error| error.to_string())?;
        Ok(outcome(report, state))
    };
    [
        Method::new("Munthe-Kaas 8(5,3)", Family::AdaptiveMuntheKaas, 8, decades(3, 15), adaptive),
        Method::new("Munthe-Kaas 8", Family::MuntheKaas, 8, step_counts(fewest), fixed),
    ]
}

/// A top as an equation of second order of its quaternion: q̈ = ½ q (0, Ω̇) − ¼ |Ω|² q, Ω = 2 q* q̇.
#[derive(Clone, Copy, Debug)]
struct QuaternionOfTop(Top);

/// q p of two quaternions.
#[cfg_attr(not(debug_assertions), inline(always))]
fn product<T: Real>(q: [T; 4], p: [T; 4]) -> [T; 4] {
    [
        q[0] * p[0] - q[1] * p[1] - q[2] * p[2] - q[3] * p[3],
        q[0] * p[1] + q[1] * p[0] + q[2] * p[3] - q[3] * p[2],
        q[0] * p[2] + q[2] * p[0] + q[3] * p[1] - q[1] * p[3],
        q[0] * p[3] + q[3] * p[0] + q[1] * p[2] - q[2] * p[1],
    ]
}

/// Ω = 2 q* q̇.
#[cfg_attr(not(debug_assertions), inline(always))]
fn angular_velocity<T: Real>(q: [T; 4], rate: [T; 4]) -> [T; 3] {
    let [_, a, b, c] = product([q[0], -q[1], -q[2], -q[3]], rate);
    [a + a, b + b, c + c]
}

impl<T: Real> SecondOrder<T> for QuaternionOfTop {
    type Error = Infallible;
    const FREEDOM: Option<usize> = Some(4);
    fn freedom(&self) -> usize {
        4
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, _t: T, q: &[T], v: &[T], out: &mut [T]) -> Result<(), Infallible> {
        let (q, v) = ([q[0], q[1], q[2], q[3]], [v[0], v[1], v[2], v[3]]);
        let omega = angular_velocity(q, v);
        let half = T::lit(0.5);
        let [a, b, c] = self.0.angular_acceleration(q, omega);
        let turned = product(q, [T::zero(), half * a, half * b, half * c]);
        let square = T::lit(0.25) * (omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]);
        for i in 0..4 {
            out[i] = turned[i] - square * q[i];
        }
        Ok(())
    }
}

/// Collocation of order sixteen on the quaternion of a top, an equation of second order.
#[must_use]
pub fn quaternion_gauss_legendre_16(problem: &Problem<Top, 7>) -> Method<'_> {
    let run = move |tolerance: f64| {
        let [q0, q1, q2, q3, a, b, c] = problem.start;
        let rate = product([q0, q1, q2, q3], [0.0, 0.5 * a, 0.5 * b, 0.5 * c]);
        let mut state = begin(&[[q0, q1, q2, q3], rate].concat())?;
        let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
        let mut top = QuaternionOfTop(problem.equations);
        let report = GaussLegendre16::new(tolerance).integrate_to(&mut top, &mut state, problem.end);
        let report = report.map_err(|error| error.to_string())?;
        let y = &state.values;
        let (q, rate) = ([y[0], y[1], y[2], y[3]], [y[4], y[5], y[6], y[7]]);
        let state = q.into_iter().chain(angular_velocity(q, rate)).collect();
        Ok(Outcome { state, evaluations: report.evaluations, steps: report.steps })
    };
    Method::new("Gauss–Legendre 16, quaternion", Family::GaussLegendre16, 16, decades(1, 16), run)
}

/// The attraction of Earth and Moon alone, for the frame at rest.
#[derive(Clone, Copy, Debug)]
struct AttractionOfArenstorf(Arenstorf);

impl<T: Real> SecondOrder<T> for AttractionOfArenstorf {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    const FREEDOM: Option<usize> = Some(2);
    fn freedom(&self) -> usize {
        2
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, _t: T, q: &[T], _v: &[T], out: &mut [T]) -> Result<(), Infallible> {
        self.0.attraction(q, out);
        Ok(())
    }
}

/// Arenstorf's orbit in the frame at rest, where forces do not depend on velocities.
#[must_use]
pub fn at_rest(problem: &Problem<Arenstorf, 4>) -> [Method<'_>; 2] {
    fn run<T: Real>(
        problem: &Problem<Arenstorf, 4>,
        integrate: impl FnOnce(&mut TurningFrame<AttractionOfArenstorf, T>, &mut State) -> Result<Report, String>,
    ) -> Result<Outcome, String> {
        let text = |error: piola_integrators::IntegratorsError| error.to_string();
        let mut frame = TurningFrame::in_plane(AttractionOfArenstorf(problem.equations), 1.0).map_err(text)?;
        let mut state = begin(&problem.start)?;
        frame.to_rest(&mut state).map_err(text)?;
        let report = integrate(&mut frame, &mut state)?;
        frame.to_turning(&mut state).map_err(text)?;
        Ok(outcome(report, state))
    }
    let collocation = move |tolerance: f64| {
        let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
        run(problem, |frame, state| {
            let report = GaussLegendre16::new(tolerance).integrate_to(frame, state, problem.end);
            report.map_err(|error| error.to_string())
        })
    };
    let nystrom = move |tolerance: f64| {
        let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
        run(problem, |frame, state| {
            let report = Nystrom1210::new(tolerance).integrate_to(frame, state, problem.end);
            report.map_err(|error| error.to_string())
        })
    };
    [
        Method::new("Gauss–Legendre 16, frame at rest", Family::GaussLegendre16, 16, decades(1, 16), collocation),
        Method::new("Nyström 12(10), frame at rest", Family::Nystrom1210, 12, decades(1, 16), nystrom),
    ]
}

/// The closed form of a symmetric top, which has no parameter: one evaluation at the end.
#[must_use]
pub fn closed_form_of_top(problem: &Problem<Top, 7>) -> Method<'_> {
    let run = move |_parameter: f64| {
        let [w, x, y, z, a, b, c] = problem.start;
        let motion = || {
            let inertia = Inertia::principal(problem.equations.inertia)?;
            let attitude = Attitude::from_quaternion([w, x, y, z])?;
            HeavyTop::new(&inertia, problem.equations.weight.into(), attitude, [a, b, c].into())
        };
        let state = motion().map_err(|error| error.to_string())?.at(problem.end);
        Ok(near(problem, state))
    };
    Method::new("closed form", Family::ClosedForm, 8, vec![f64::EPSILON], run)
}

/// The closed form of a free top, likewise.
#[must_use]
pub fn closed_form(problem: &Problem<Top, 7>) -> Method<'_> {
    let run = move |_parameter: f64| {
        let [w, x, y, z, a, b, c] = problem.start;
        let motion = || {
            let inertia = Inertia::principal(problem.equations.inertia)?;
            FreeRotation::new(&inertia, Attitude::from_quaternion([w, x, y, z])?, [a, b, c].into())
        };
        let state = motion().map_err(|error| error.to_string())?.at(problem.end);
        Ok(near(problem, state))
    };
    Method::new("closed form", Family::ClosedForm, 8, vec![f64::EPSILON], run)
}

/// A state of a top with that of both quaternions of its attitude which is near the reference.
fn near(problem: &Problem<Top, 7>, (attitude, omega): (Attitude<f64>, Vector3<f64>)) -> Outcome {
    let found = [attitude.w, attitude.x, attitude.y, attitude.z];
    let along: f64 = found.iter().zip(&problem.reference).map(|(a, b)| a * b).sum();
    let sign = 1.0_f64.copysign(along);
    let state = found.iter().map(|x| sign * x).chain(omega.iter().copied()).collect();
    Outcome { state, evaluations: 1, steps: 1 }
}

/// The closed form of Kepler's motion in universal variables, likewise.
#[must_use]
pub fn universal_variables(problem: &Problem<Kepler, 4>) -> Method<'_> {
    let run = move |_parameter: f64| {
        let [x, y, u, v] = problem.start;
        let gained = advance(problem.equations.parameter, [x, y, 0.0], [u, v, 0.0], problem.end);
        let ([dx, dy, _], [du, dv, _]) = (gained.position, gained.velocity);
        Ok(Outcome { state: vec![x + dx, y + dy, u + du, v + dv], evaluations: 1, steps: 1 })
    };
    Method::new("closed form", Family::ClosedForm, 8, vec![f64::EPSILON], run)
}

/// The map of Wisdom and Holman in Jacobi's coordinates, by its splitting of order (10, 6, 4) and by the leapfrog with the
/// corrector of order 17.
#[must_use]
pub fn wisdom_holman<const N: usize, const D: usize>(
    problem: &Problem<Attraction<N, 3>, D>,
    fewest: f64,
) -> [Method<'_>; 2] {
    let run = move |splitting: Splitting, steps: f64| {
        let bodies = Gravitation::new(problem.equations.parameters.to_vec()).map_err(|error| error.to_string())?;
        let mut state = begin(&problem.start)?;
        let method = WisdomHolman::new(problem.end / steps, splitting).map_err(|error| error.to_string())?;
        let report = method.integrate_to(&bodies, &mut state, problem.end).map_err(|error| error.to_string())?;
        Ok(outcome(report, state))
    };
    let corrected = Splitting::Corrected(Corrector::Seventeen);
    [
        Method::new("Wisdom–Holman (10, 6, 4)", Family::WisdomHolman, 4, step_counts(fewest), move |steps| {
            run(Splitting::TenSixFour, steps)
        }),
        Method::new("Wisdom–Holman 2, corrector 17", Family::WisdomHolman, 2, step_counts(fewest), move |steps| {
            run(corrected, steps)
        }),
    ]
}

/// Radau IIA of variable order, with exact Jacobians.
#[must_use]
pub fn radau_iia<F, const D: usize>(problem: &Problem<F, D>) -> Method<'_>
where
    F: Field<f64, Error = Infallible> + Field<Differentiable, Error = Infallible> + Copy,
{
    let run = move |tolerance: f64| {
        let mut state = begin(&problem.start)?;
        let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
        let mut field = ExactJacobian::new(problem.equations);
        let report = RadauIia::new(tolerance).integrate_to(&mut field, &mut state, problem.end);
        Ok(outcome(report.map_err(|error| error.to_string())?.run, state))
    };
    Method::new("Radau IIA 5, 9, 13", Family::RadauIia, 13, decades(1, 13), run)
}

/// Tolerances from one power of ten to another.
fn decades(first: i32, last: i32) -> Vec<f64> {
    (first..=last).map(|k| 10.0_f64.powi(-k)).collect()
}

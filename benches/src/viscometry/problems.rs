//! Profiles, discharges and torques of three fluids: ours, plain quadrature, closed forms, and the truth.

use std::error::Error;
use std::f64::consts::PI;
use std::hint::black_box;

use piola_fluids::{HerschelBulkley, PowerLaw, ViscometricFluid};
use piola_numerics::Real;
use piola_testkit::DoubleDouble;
use piola_viscometry::{Channel, Couette, Estimate, Poiseuille};

use super::{carreau_yasuda, herschel_bulkley, plain, power_law, truth};

/// Radius of the pipe and its pressure gradient.
pub const PIPE: [f64; 2] = [1.0, 3.0];
/// Half of the width of the channel and its pressure gradient.
pub const CHANNEL: [f64; 2] = [1.25, 2.0];
/// Radii of the cylinders.
pub const CYLINDERS: [f64; 2] = [0.75, 1.25];
/// The torque near which that of the cylinders is.
const TORQUE: f64 = 6.0;
/// Places of a profile.
pub const PLACES: usize = 33;

/// Room for the answers of any problem.
pub type Answers = [f64; PLACES];

/// Computes the answers.
pub type Run = Box<dyn Fn(&mut Answers)>;

/// Computes the answers to a relative tolerance.
pub type RunTo = Box<dyn Fn(f64, &mut Answers)>;

/// What is asked of a flow.
pub struct Problem {
    /// `profile`, `discharge` or `torque`.
    pub what: &'static str,
    /// The flow.
    pub flow: &'static str,
    /// The fluid.
    pub fluid: &'static str,
    /// Ours.
    pub ours: Run,
    /// The bound that ours states, relative as [`Problem::error`] is; NaN where it states none.
    pub bound: f64,
    /// The textbook's formula by plain quadrature to a relative tolerance.
    pub plain: RunTo,
    /// The closed form, where there is one.
    pub closed: Option<Run>,
    /// The answers to 25 digits.
    pub truth: Vec<DoubleDouble>,
}

impl core::fmt::Debug for Problem {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        formatter.debug_struct("Problem").field("name", &self.name()).finish_non_exhaustive()
    }
}

impl Problem {
    /// The largest error of answers, relative to the largest of them.
    #[must_use]
    pub fn error(&self, answers: &Answers) -> f64 {
        let size = self.truth.iter().map(|truth| truth.primal(0).abs()).fold(0.0, f64::max);
        let errors = self.truth.iter().zip(answers).map(|(truth, answer)| truth.rounding_of(*answer).abs());
        // A NaN is the worst of all.
        errors.fold(0.0, |worst: f64, error| if error <= worst { worst } else { error.max(worst) }) / size
    }

    /// `what/flow_fluid`.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}/{}_{}", self.what, self.flow, self.fluid)
    }
}

/// Distances from the axis of the pipe.
#[must_use]
pub fn places() -> Answers {
    core::array::from_fn(|i| PIPE[0] * i as f64 / (PLACES - 1) as f64)
}

/// All problems.
///
/// # Errors
/// None: fluids and flows are within bounds.
pub fn problems() -> Result<Vec<Problem>, Box<dyn Error>> {
    let (thinning, paste) = (power_law()?, herschel_bulkley()?);
    let mut all = of_fluid("carreau_yasuda", carreau_yasuda()?)?;
    all.extend(of_fluid("power_law", thinning)?.into_iter().zip(closed_power_law(thinning)?).map(with));
    all.extend(of_fluid("herschel_bulkley", paste)?.into_iter().zip(closed_herschel_bulkley(paste)).map(with));
    Ok(all)
}

fn with((problem, closed): (Problem, Option<Run>)) -> Problem {
    Problem { closed, ..problem }
}

fn of_fluid<F: ViscometricFluid + Clone + 'static>(
    name: &'static str,
    fluid: F,
) -> Result<Vec<Problem>, Box<dyn Error>> {
    Ok(vec![
        profile(name, fluid.clone())?,
        discharge(name, fluid.clone())?,
        channel(name, fluid.clone())?,
        torque(name, fluid)?,
    ])
}

/// Where nothing is known the answer is NaN.
fn value(answer: Result<Estimate, piola_viscometry::ViscometryError>) -> f64 {
    answer.map_or(f64::NAN, |answer| answer.value)
}

/// ζ, or NaN.
fn rate<F: ViscometricFluid>(fluid: &F, stress: f64) -> f64 {
    fluid.shear_rate(stress).unwrap_or(f64::NAN)
}

fn profile<F: ViscometricFluid + Clone + 'static>(name: &'static str, fluid: F) -> Result<Problem, Box<dyn Error>> {
    let [radius, gradient] = PIPE;
    let pipe = Poiseuille::new(radius, gradient)?;
    let r = places();
    let truth: Vec<_> = r.iter().map(|r| truth::pipe_velocity(&fluid, radius, gradient, *r)).collect();
    let mut speeds = [Estimate::ZERO; PLACES];
    pipe.profile_into(&fluid, &r, &mut speeds)?;
    let bound = speeds.iter().map(|speed| speed.error).fold(0.0, f64::max) / speeds[0].value;
    let theirs = fluid.clone();
    Ok(Problem {
        what: "profile",
        flow: "pipe",
        fluid: name,
        ours: Box::new(move |answers| {
            let mut speeds = [Estimate::ZERO; PLACES];
            let outcome = black_box(pipe).profile_into(black_box(&fluid), &r, &mut speeds);
            *answers = if outcome.is_ok() { speeds.map(|speed| speed.value) } else { [f64::NAN; PLACES] };
        }),
        bound,
        plain: Box::new(move |tolerance, answers| {
            let fluid = black_box(&theirs);
            // The plug moves as its edge does.
            let plug = 2.0 * fluid.yield_stress() / gradient;
            for (r, answer) in r.iter().zip(answers) {
                *answer = plain::integrate(r.max(plug), radius, tolerance, |xi| rate(fluid, 0.5 * gradient * xi)).0;
            }
        }),
        closed: None,
        truth,
    })
}

fn discharge<F: ViscometricFluid + Clone + 'static>(name: &'static str, fluid: F) -> Result<Problem, Box<dyn Error>> {
    let [radius, gradient] = PIPE;
    let pipe = Poiseuille::new(radius, gradient)?;
    let truth = vec![truth::pipe_discharge(&fluid, radius, gradient)];
    let answer = pipe.discharge(&fluid)?;
    let theirs = fluid.clone();
    Ok(Problem {
        what: "discharge",
        flow: "pipe",
        fluid: name,
        ours: Box::new(move |answers| answers[0] = value(black_box(pipe).discharge(black_box(&fluid)))),
        bound: answer.error / answer.value,
        plain: Box::new(move |tolerance, answers| {
            let fluid = black_box(&theirs);
            let plug = 2.0 * fluid.yield_stress() / gradient;
            let moment = plain::integrate(plug, radius, tolerance, |xi| xi * xi * rate(fluid, 0.5 * gradient * xi)).0;
            answers[0] = PI * moment;
        }),
        closed: None,
        truth,
    })
}

fn channel<F: ViscometricFluid + Clone + 'static>(name: &'static str, fluid: F) -> Result<Problem, Box<dyn Error>> {
    let [half_width, gradient] = CHANNEL;
    let channel = Channel::new(half_width, gradient)?;
    let truth = vec![truth::channel_discharge(&fluid, half_width, gradient)];
    let answer = channel.discharge(&fluid)?;
    let theirs = fluid.clone();
    Ok(Problem {
        what: "discharge",
        flow: "channel",
        fluid: name,
        ours: Box::new(move |answers| answers[0] = value(black_box(channel).discharge(black_box(&fluid)))),
        bound: answer.error / answer.value,
        plain: Box::new(move |tolerance, answers| {
            let fluid = black_box(&theirs);
            let plug = fluid.yield_stress() / gradient;
            let moment = plain::integrate(plug, half_width, tolerance, |xi| xi * rate(fluid, gradient * xi)).0;
            answers[0] = 2.0 * moment;
        }),
        closed: None,
        truth,
    })
}

/// ΔΩ of a fluid under [`TORQUE`]: what the torque is sought for.
fn speed_difference<F: ViscometricFluid>(fluid: &F) -> Result<f64, Box<dyn Error>> {
    Ok(Couette::new(CYLINDERS[0], CYLINDERS[1], TORQUE)?.speed_difference(fluid)?.value)
}

fn torque<F: ViscometricFluid + Clone + 'static>(name: &'static str, fluid: F) -> Result<Problem, Box<dyn Error>> {
    let [inner, outer] = CYLINDERS;
    let speed = speed_difference(&fluid)?;
    let truth = vec![truth::couette_torque(&fluid, CYLINDERS, speed, TORQUE)];
    let theirs = fluid.clone();
    Ok(Problem {
        what: "torque",
        flow: "couette",
        fluid: name,
        ours: Box::new(move |answers| {
            let flow = Couette::with_speed_difference(inner, outer, black_box(speed), black_box(&fluid));
            answers[0] = flow.map_or(f64::NAN, |flow| flow.moment());
        }),
        bound: f64::NAN,
        plain: Box::new(move |tolerance, answers| {
            let fluid = black_box(&theirs);
            let difference = |torque: f64| {
                let edge = outer.min((torque / (2.0 * PI * fluid.yield_stress())).sqrt());
                let share = |xi: f64| rate(fluid, torque / (2.0 * PI * xi * xi)) / xi;
                plain::integrate(inner, edge, tolerance, share).0
            };
            // As a Newtonian fluid with the stress of the rate at the inner wall.
            let wall = fluid.shear_stress(2.0 * speed / (1.0 - (inner / outer).powi(2)));
            answers[0] = plain::inverse(speed, 2.0 * PI * inner * inner * wall, tolerance, difference);
        }),
        closed: None,
        truth,
    })
}

/// As the textbooks print them.
fn closed_power_law(fluid: PowerLaw) -> Result<[Option<Run>; 4], Box<dyn Error>> {
    let r = places();
    let speed = speed_difference(&fluid)?;
    Ok([
        Some(Box::new(move |answers| {
            let (k, n, [radius, gradient]) = (fluid.consistency(), fluid.exponent(), black_box(PIPE));
            let fastest = n * radius / (n + 1.0) * (0.5 * gradient * radius / k).powf(1.0 / n);
            *answers = r.map(|r| fastest * (1.0 - (r / radius).powf((n + 1.0) / n)));
        })),
        Some(Box::new(move |answers| {
            let (k, n, [radius, gradient]) = (fluid.consistency(), fluid.exponent(), black_box(PIPE));
            let wall = (0.5 * gradient * radius / k).powf(1.0 / n);
            answers[0] = PI * radius.powi(3) * n / (3.0 * n + 1.0) * wall;
        })),
        Some(Box::new(move |answers| {
            let (k, n, [half_width, gradient]) = (fluid.consistency(), fluid.exponent(), black_box(CHANNEL));
            let wall = (gradient * half_width / k).powf(1.0 / n);
            answers[0] = 2.0 * half_width.powi(2) * n / (2.0 * n + 1.0) * wall;
        })),
        Some(Box::new(move |answers| {
            let (k, n, [inner, outer]) = (fluid.consistency(), fluid.exponent(), black_box(CYLINDERS));
            let wall_rate = 2.0 * black_box(speed) / (n * (1.0 - (inner / outer).powf(2.0 / n)));
            answers[0] = 2.0 * PI * inner * inner * k * wall_rate.powf(n);
        })),
    ])
}

/// As the textbooks print them; there is none for the torque.
fn closed_herschel_bulkley(fluid: HerschelBulkley) -> [Option<Run>; 4] {
    let r = places();
    let parts = move || (fluid.yield_stress(), fluid.consistency(), fluid.exponent());
    [
        Some(Box::new(move |answers| {
            let ((yields, k, n), [radius, gradient]) = (parts(), black_box(PIPE));
            let power = |stress: f64| (stress - yields).max(0.0).powf((n + 1.0) / n);
            let wall = 0.5 * gradient * radius;
            let scale = n * radius / ((n + 1.0) * wall * k.powf(1.0 / n));
            *answers = r.map(|r| scale * (power(wall) - power(0.5 * gradient * r)));
        })),
        Some(Box::new(move |answers| {
            let ((yields, k, n), [radius, gradient]) = (parts(), black_box(PIPE));
            let wall = 0.5 * gradient * radius;
            let beyond = wall - yields;
            let sum = beyond * beyond / (3.0 * n + 1.0)
                + 2.0 * yields * beyond / (2.0 * n + 1.0)
                + yields * yields / (n + 1.0);
            answers[0] = PI * (radius / wall).powi(3) * n * beyond * (beyond / k).powf(1.0 / n) * sum;
        })),
        Some(Box::new(move |answers| {
            let ((yields, k, n), [half_width, gradient]) = (parts(), black_box(CHANNEL));
            let wall = gradient * half_width;
            let beyond = wall - yields;
            let sum = beyond / (2.0 * n + 1.0) + yields / (n + 1.0);
            answers[0] = 2.0 * (half_width / wall).powi(2) * n * beyond * (beyond / k).powf(1.0 / n) * sum;
        })),
        None,
    ]
}

#[cfg(test)]
mod tests {
    use super::{PLACES, problems};

    #[test]
    fn all_ways_equal_the_truth_and_ours_is_within_its_bound() {
        let problems = problems().expect("within bounds");
        assert_eq!(problems.len(), 12);
        for problem in problems {
            let mut answers = [0.0; PLACES];
            (problem.ours)(&mut answers);
            let error = problem.error(&answers);
            let bound = if problem.bound.is_nan() { 1e-13 } else { problem.bound };
            assert!(error <= bound && bound <= 1e-12, "{}: {error:e}, {bound:e}", problem.name());
            (problem.plain)(1e-12, &mut answers);
            assert!(problem.error(&answers) < 1e-11, "{} plain: {:e}", problem.name(), problem.error(&answers));
            if let Some(closed) = &problem.closed {
                closed(&mut answers);
                assert!(problem.error(&answers) < 1e-14, "{} closed: {:e}", problem.name(), problem.error(&answers));
            }
        }
    }
}

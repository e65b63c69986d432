//! Error against time: many methods with many parameters on one problem, measured in turn.

use std::hint::black_box;
use std::time::{Duration, Instant};

use piola_integrators::{
    Composition, DormandPrince853, Field, GaussLegendre, GaussLegendre16, GaussRadau15, Nystrom86, Nystrom1210, Order,
    Report, SecondOrder, State, Tolerance, Verner98, separable,
};
use piola_numerics::{Lanes, Real};
use serde_json::{Value, json};

use crate::peers;
use crate::problems::{Accelerations, Equations, Force, Problem};

/// The end of one run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The state at the end, as the problem lists it.
    pub state: Vec<f64>,
    /// Evaluations of the equations.
    pub evaluations: u64,
    /// Accepted steps.
    pub steps: u64,
}

impl Outcome {
    fn of(report: Report, state: State) -> Self {
        Self { state: state.values, evaluations: report.evaluations, steps: report.steps }
    }
}

/// What a method looks like in a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Explicit symplectic compositions.
    Composition,
    /// Collocation in positions and velocities.
    GaussLegendre,
    /// Collocation in positions and momenta.
    CanonicalGaussLegendre,
    /// Collocation of order sixteen, adaptive, its stages in lanes.
    GaussLegendre16,
    /// Collocation of order fifteen at Radau's nodes, adaptive, one stage after the other.
    GaussRadau15,
    /// The explicit Nyström pair of order eight.
    Nystrom86,
    /// The explicit Nyström pair of order twelve.
    Nystrom1210,
    /// The explicit Runge–Kutta pair of order nine.
    Verner,
    /// The adaptive method on the equations written by hand.
    DormandPrince,
    /// The adaptive method on equations that Piola derives.
    DerivedDormandPrince,
    /// The map of Wisdom and Holman for planets.
    WisdomHolman,
    /// The adaptive method of Munthe-Kaas on a group.
    AdaptiveMuntheKaas,
    /// The same with a fixed step.
    MuntheKaas,
    /// A closed form instead of a method.
    ClosedForm,
    /// Collocation for stiff equations.
    RadauIia,
    /// The first peer.
    OdeSolvers,
    /// The second peer.
    DifferentialEquations,
    /// The third peer, as the fourth measured from a crate of its own in `benches/peers/integration`.
    Diffsol,
    /// The fourth peer.
    Russell,
}

/// A method of some order, to be run with a parameter: the number of steps or the tolerance.
pub struct Method<'a> {
    /// The name in records.
    pub name: String,
    /// The family.
    pub family: Family,
    /// The order.
    pub order: u32,
    /// The parameters, towards smaller errors.
    parameters: Vec<f64>,
    run: Box<dyn Fn(f64) -> Result<Outcome, String> + 'a>,
}

impl<'a> Method<'a> {
    /// A method of an order with its parameters, towards smaller errors, and its run with one of them.
    pub fn new(
        name: impl Into<String>,
        family: Family,
        order: u32,
        parameters: Vec<f64>,
        run: impl Fn(f64) -> Result<Outcome, String> + 'a,
    ) -> Self {
        Self { name: name.into(), family, order, parameters, run: Box::new(run) }
    }
}

impl std::fmt::Debug for Method<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Method").field("name", &self.name).field("parameters", &self.parameters).finish()
    }
}

/// One point of a curve.
#[derive(Clone, Debug)]
pub struct Point {
    /// The step (s) or the tolerance.
    pub parameter: f64,
    /// The error at the end: see [`Problem::error`].
    pub error: f64,
    /// The time of a run, s: the least of all samples.
    pub seconds: f64,
    /// Evaluations of the equations.
    pub evaluations: u64,
}

/// The points of one method.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The name in records.
    pub name: String,
    /// The family.
    pub family: Family,
    /// The order.
    pub order: u32,
    /// The points, towards smaller errors.
    pub points: Vec<Point>,
}

impl Curve {
    /// The records of this curve: `{problem, method, peer, parameter, error, seconds, evaluations}`.
    #[must_use]
    pub fn records(&self, problem: &str) -> Vec<Value> {
        let peer = self.family.is_peer();
        let record = |point: &Point| {
            json!({
                "problem": problem, "method": self.name, "peer": peer, "parameter": point.parameter,
                "error": point.error, "seconds": point.seconds, "evaluations": point.evaluations,
            })
        };
        self.points.iter().map(record).collect()
    }
}

/// A sample repeats short runs until it lasts this long: short beside the time slices of the scheduler, so that
/// most samples of a short run are not interrupted.
const SHORTEST_SAMPLE: Duration = Duration::from_micros(200);
/// Samples of each point, one in every round over all methods.
const ROUNDS: usize = 15;
/// Samples of a run that is longer than [`LONG_RUN`].
const ROUNDS_OF_LONG_RUNS: usize = 5;
/// The machine's changes within so long a run already even out.
const LONG_RUN: Duration = Duration::from_millis(20);
/// Larger errors are not of interest.
const LARGEST_ERROR: f64 = 0.1;
/// Only below this error can rounding be what stops a curve.
const FLOOR: f64 = 1e-9;

/// Measures all methods on a problem, one after the other in every round, so that a slow minute of the
/// machine slows all of them. The least time counts: other programs can only lengthen a run. Runs that fail are told to `complain` and left out.
pub fn measure<E: Equations<D>, const D: usize>(
    problem: &Problem<E, D>,
    methods: &[Method<'_>],
    mut complain: impl FnMut(&str),
) -> Vec<Curve> {
    let mut curves = Vec::new();
    let mut samples = Vec::new();
    for (index, method) in methods.iter().enumerate() {
        let mut curve =
            Curve { name: method.name.clone(), family: method.family, order: method.order, points: Vec::new() };
        let (mut best, mut in_vain) = (f64::INFINITY, 0);
        for &parameter in &method.parameters {
            let start = Instant::now();
            let outcome = match (method.run)(parameter) {
                Ok(outcome) => outcome,
                Err(problem) => {
                    complain(&format!("{} with {parameter:e}: {problem}", method.name));
                    continue;
                }
            };
            let duration = start.elapsed();
            if problem.longest_run < duration {
                break;
            }
            let error = problem.error(&outcome.state);
            if error.is_nan() || LARGEST_ERROR < error {
                continue;
            }
            samples.push((index, curve.points.len(), parameter, duration, duration.as_secs_f64()));
            curve.points.push(Point { parameter, error, seconds: 0.0, evaluations: outcome.evaluations });
            // The floor of rounding is reached when smaller steps no longer help.
            in_vain = if error < 0.7 * best { 0 } else { in_vain + 1 };
            best = best.min(error);
            if best < FLOOR && 3 <= in_vain {
                break;
            }
        }
        curves.push(curve);
    }
    for round in 0..ROUNDS {
        for (method, _, parameter, duration, seconds) in &mut samples {
            if ROUNDS_OF_LONG_RUNS <= round && LONG_RUN < *duration {
                continue;
            }
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
            let runs = (SHORTEST_SAMPLE.as_secs_f64() / duration.as_secs_f64()).ceil().clamp(1.0, 1e4) as u32;
            let start = Instant::now();
            for _ in 0..runs {
                let _outcome = black_box((methods[*method].run)(black_box(*parameter)));
            }
            *seconds = seconds.min(start.elapsed().as_secs_f64() / f64::from(runs));
        }
    }
    for (method, point, _, _, seconds) in samples {
        curves[method].points[point].seconds = seconds;
    }
    for curve in &mut curves {
        // Of what lies beyond the smallest error one point shows that there is a floor.
        let errors = curve.points.iter().map(|point| point.error).enumerate();
        let best = errors.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index);
        curve.points.truncate(best + 2);
        if curve.family.is_fixed() {
            for point in &mut curve.points {
                point.parameter = problem.end / point.parameter;
            }
        }
    }
    curves
}

impl Family {
    /// Whether the parameter is a step, not a tolerance.
    #[must_use]
    pub const fn is_fixed(self) -> bool {
        matches!(
            self,
            Self::Composition
                | Self::GaussLegendre
                | Self::CanonicalGaussLegendre
                | Self::WisdomHolman
                | Self::MuntheKaas
        )
    }

    /// Whether the method is one of another library.
    #[must_use]
    pub const fn is_peer(self) -> bool {
        matches!(self, Self::OdeSolvers | Self::DifferentialEquations | Self::Diffsol | Self::Russell)
    }
}

/// Tolerances from 1e-4 to rounding, one to a decade.
#[must_use]
pub fn tolerances() -> Vec<f64> {
    (4..=15).map(|k| 10.0_f64.powi(-k)).collect()
}

/// Numbers of steps from `fewest` on, four to a factor of ten.
#[must_use]
pub fn step_counts(fewest: f64) -> Vec<f64> {
    (0..=24).map(|k| (fewest * 10.0_f64.powf(0.25 * f64::from(k))).round()).collect()
}

/// The explicit symplectic composition of an order, for equations that separate.
#[must_use]
pub fn composition<E: Force, const D: usize>(problem: &Problem<E, D>, order: Order, fewest: f64) -> Method<'_> {
    let run = move |steps: f64| {
        let mut equations = separable(D / 2, |_t, q: &[f64], force: &mut [f64]| problem.equations.force(q, force));
        let mut state = State::new(0.0, problem.start.to_vec()).map_err(|error| error.to_string())?;
        let mut method = Composition::new(order, problem.end / steps).map_err(|error| error.to_string())?;
        let report = method.integrate_to(&mut equations, &mut state, problem.end).map_err(|error| error.to_string())?;
        Ok(Outcome::of(report, state))
    };
    let name = format!("composition {}", order.value());
    let parameters = step_counts(fewest);
    Method { name, family: Family::Composition, order: order.value(), parameters, run: Box::new(run) }
}

/// Collocation of an order in positions and velocities.
#[must_use]
pub fn gauss_legendre<E: Equations<D>, const D: usize>(
    problem: &Problem<E, D>,
    order: Order,
    fewest: f64,
) -> Method<'_> {
    let run = move |steps: f64| collocate(order, &mut by_hand(problem), &problem.start, problem.end, steps);
    let name = format!("Gauss–Legendre {}", order.value());
    let parameters = step_counts(fewest);
    Method { name, family: Family::GaussLegendre, order: order.value(), parameters, run: Box::new(run) }
}

/// Collocation of an order on a field in positions and momenta; `back` makes velocities of the momenta.
#[must_use]
pub fn canonical_gauss_legendre<'a, F: Field, const D: usize>(
    start: [f64; D],
    end: f64,
    field: impl Fn() -> F + 'a,
    back: impl Fn(&mut [f64]) + 'a,
    order: Order,
    fewest: f64,
) -> Method<'a>
where
    F::Error: std::error::Error + 'static,
{
    let run = move |steps: f64| {
        let mut outcome = collocate(order, &mut field(), &start, end, steps)?;
        back(&mut outcome.state);
        Ok(outcome)
    };
    let name = format!("Gauss–Legendre {}, canonical, by placement", order.value());
    let parameters = step_counts(fewest);
    Method { name, family: Family::CanonicalGaussLegendre, order: order.value(), parameters, run: Box::new(run) }
}

/// The equations of a problem of D components, over any scalar.
pub(crate) struct Accelerated<'a, E, const D: usize>(pub(crate) &'a E);

impl<T: Real, E: Accelerations, const D: usize> SecondOrder<T> for Accelerated<'_, E, D> {
    type Error = std::convert::Infallible;
    const VELOCITY_DEPENDENT: bool = E::VELOCITY_DEPENDENT;
    const FREEDOM: Option<usize> = Some(D / 2);
    fn freedom(&self) -> usize {
        D / 2
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, _t: T, q: &[T], v: &[T], acceleration: &mut [T]) -> Result<(), Self::Error> {
        self.0.accelerations(q, v, acceleration);
        Ok(())
    }
}

/// Collocation of order sixteen, adaptive, on equations written by hand.
#[must_use]
pub fn gauss_legendre_16<E: Equations<D> + Accelerations, const D: usize>(problem: &Problem<E, D>) -> Method<'_> {
    let field = || Accelerated::<_, D>(&problem.equations);
    Method { name: "Gauss–Legendre 16".into(), ..derived_gauss_legendre_16("", problem.start, problem.end, field) }
}

/// Collocation of order sixteen, adaptive, on a system that Piola derives.
#[must_use]
pub fn derived_gauss_legendre_16<'a, F: SecondOrder<Lanes<f64, 8>>, const D: usize>(
    name: &str,
    start: [f64; D],
    end: f64,
    field: impl Fn() -> F + 'a,
) -> Method<'a>
where
    F::Error: std::error::Error + 'static,
{
    let run = move |tolerance: f64| {
        let mut state = State::new(0.0, start.to_vec()).map_err(|error| error.to_string())?;
        let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
        let mut method = GaussLegendre16::new(tolerance);
        let report = method.integrate_to(&mut field(), &mut state, end).map_err(|error| error.to_string())?;
        Ok(Outcome::of(report, state))
    };
    let name = format!("Gauss–Legendre 16, {name}");
    let parameters = (1..=16).map(|k| 10.0_f64.powi(-k)).collect();
    Method { name, family: Family::GaussLegendre16, order: 16, parameters, run: Box::new(run) }
}

/// Collocation of order fifteen, adaptive, on equations written by hand.
#[must_use]
pub fn gauss_radau_15<E: Equations<D> + Accelerations, const D: usize>(problem: &Problem<E, D>) -> Method<'_> {
    let field = || Accelerated::<_, D>(&problem.equations);
    Method { name: "Gauss–Radau 15".into(), ..derived_gauss_radau_15("", problem.start, problem.end, field) }
}

/// Collocation of order fifteen, adaptive, on a system that Piola derives.
#[must_use]
pub fn derived_gauss_radau_15<'a, F: SecondOrder, const D: usize>(
    name: &str,
    start: [f64; D],
    end: f64,
    field: impl Fn() -> F + 'a,
) -> Method<'a>
where
    F::Error: std::error::Error + 'static,
{
    let run = move |tolerance: f64| {
        let mut state = State::new(0.0, start.to_vec()).map_err(|error| error.to_string())?;
        let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
        let mut method = GaussRadau15::new(tolerance);
        let report = method.integrate_to(&mut field(), &mut state, end).map_err(|error| error.to_string())?;
        Ok(Outcome::of(report, state))
    };
    let name = format!("Gauss–Radau 15, {name}");
    let parameters = (1..=16).map(|k| 10.0_f64.powi(-k)).collect();
    Method { name, family: Family::GaussRadau15, order: 15, parameters, run: Box::new(run) }
}

/// The adaptive method on equations written by hand.
#[must_use]
pub fn dormand_prince<E: Equations<D>, const D: usize>(problem: &Problem<E, D>) -> Method<'_> {
    let run = move |tolerance: f64| adapt(&mut by_hand(problem), &problem.start, problem.end, tolerance);
    let name = "Dormand–Prince 8(5,3)".into();
    Method { name, family: Family::DormandPrince, order: 8, parameters: tolerances(), run: Box::new(run) }
}

/// The explicit pair of order nine on equations written by hand.
#[must_use]
pub fn verner<E: Equations<D>, const D: usize>(problem: &Problem<E, D>) -> Method<'_> {
    let run = move |tolerance: f64| {
        let mut state = State::new(0.0, problem.start.to_vec()).map_err(|error| error.to_string())?;
        let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
        let report = Verner98::new(tolerance).integrate_to(&mut by_hand(problem), &mut state, problem.end);
        Ok(Outcome::of(report.map_err(|error| error.to_string())?, state))
    };
    Method {
        name: "Verner 9(8)".into(),
        family: Family::Verner,
        order: 9,
        parameters: tolerances(),
        run: Box::new(run),
    }
}

/// Both explicit Nyström pairs on equations written by hand whose accelerations depend on positions alone.
#[must_use]
pub fn nystrom<E: Force, const D: usize>(problem: &Problem<E, D>) -> [Method<'_>; 2] {
    let field = || Forced::<'_, E, D>(&problem.equations);
    let [eighth, twelfth] = derived_nystrom("", problem.start, problem.end, field);
    [Method { name: "Nyström 8(6)".into(), ..eighth }, Method { name: "Nyström 12(10)".into(), ..twelfth }]
}

/// Both explicit Nyström pairs on a system that Piola derives, whose accelerations depend on positions alone.
#[must_use]
pub fn derived_nystrom<'a, F: SecondOrder, const D: usize>(
    name: &str,
    start: [f64; D],
    end: f64,
    field: impl Fn() -> F + Copy + 'a,
) -> [Method<'a>; 2]
where
    F::Error: std::error::Error + 'static,
{
    macro_rules! method {
        ($method:ident, $name:literal, $order:literal) => {{
            let run = move |tolerance: f64| {
                let mut state = State::new(0.0, start.to_vec()).map_err(|error| error.to_string())?;
                let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
                let report = $method::new(tolerance).integrate_to(&mut field(), &mut state, end);
                Ok(Outcome::of(report.map_err(|error| error.to_string())?, state))
            };
            let parameters = (2..=16).map(|k| 10.0_f64.powi(-k)).collect();
            Method::new(format!("{}, {name}", $name), Family::$method, $order, parameters, run)
        }};
    }
    [method!(Nystrom86, "Nyström 8(6)", 8), method!(Nystrom1210, "Nyström 12(10)", 12)]
}

/// The force of a problem of D components.
pub(crate) struct Forced<'a, E, const D: usize>(pub(crate) &'a E);

impl<E: Force, const D: usize> SecondOrder for Forced<'_, E, D> {
    type Error = std::convert::Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    const FREEDOM: Option<usize> = Some(D / 2);
    fn freedom(&self) -> usize {
        D / 2
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, _t: f64, q: &[f64], _v: &[f64], acceleration: &mut [f64]) -> Result<(), Self::Error> {
        self.0.force(q, acceleration);
        Ok(())
    }
}

/// The adaptive method on a field that Piola derives.
#[must_use]
pub fn derived_dormand_prince<'a, F: Field, const D: usize>(
    name: &str,
    start: [f64; D],
    end: f64,
    field: impl Fn() -> F + 'a,
) -> Method<'a>
where
    F::Error: std::error::Error + 'static,
{
    let run = move |tolerance: f64| adapt(&mut field(), &start, end, tolerance);
    let name = format!("Dormand–Prince 8(5,3), {name}");
    Method { name, family: Family::DerivedDormandPrince, order: 8, parameters: tolerances(), run: Box::new(run) }
}

/// Both peers.
#[must_use]
pub fn peer_methods<E: Equations<D>, const D: usize>(problem: &Problem<E, D>) -> [Method<'_>; 2] {
    let first = move |tolerance: f64| peers::ode_solvers(problem, tolerance, None);
    let second = move |tolerance: f64| peers::differential_equations(problem, tolerance, None);
    [
        Method {
            name: format!("{}, Dop853", peers::ODE_SOLVERS),
            family: Family::OdeSolvers,
            order: 8,
            parameters: tolerances(),
            run: Box::new(first),
        },
        Method {
            name: format!("{}, DOP853", peers::DIFFERENTIAL_EQUATIONS),
            family: Family::DifferentialEquations,
            order: 8,
            parameters: tolerances(),
            run: Box::new(second),
        },
    ]
}

/// The equations of a problem as a field whose size the compiler knows.
pub fn by_hand<E: Equations<D>, const D: usize>(
    problem: &Problem<E, D>,
) -> impl Field<f64, Error = std::convert::Infallible> {
    ByHand(&problem.equations)
}

/// Equations written by hand.
struct ByHand<'a, E, const D: usize>(&'a E);

impl<E: Equations<D>, const D: usize> Field for ByHand<'_, E, D> {
    type Error = std::convert::Infallible;
    const DIMENSION: Option<usize> = Some(D);
    fn dimension(&self) -> usize {
        D
    }
    fn is_second_order(&self) -> bool {
        E::SECOND_ORDER
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
        if let (Some(y), Some(rate)) = (y.first_chunk(), rate.first_chunk_mut()) {
            self.0.rate(y, rate);
        }
        Ok(())
    }
}

fn collocate<F: Field>(order: Order, field: &mut F, start: &[f64], end: f64, steps: f64) -> Result<Outcome, String>
where
    F::Error: std::error::Error + 'static,
{
    let mut state = State::new(0.0, start.to_vec()).map_err(|error| error.to_string())?;
    let mut method = GaussLegendre::new(order, end / steps).map_err(|error| error.to_string())?;
    let report = method.integrate_to(field, &mut state, end).map_err(|error| error.to_string())?;
    Ok(Outcome::of(report, state))
}

fn adapt<F: Field>(field: &mut F, start: &[f64], end: f64, tolerance: f64) -> Result<Outcome, String>
where
    F::Error: std::error::Error + 'static,
{
    let mut state = State::new(0.0, start.to_vec()).map_err(|error| error.to_string())?;
    let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
    let report =
        DormandPrince853::new(tolerance).integrate_to(field, &mut state, end).map_err(|error| error.to_string())?;
    Ok(Outcome::of(report, state))
}

//! Motions of several systems at once, one in each lane of a vector of numbers.

use piola_gravitation::Gravitation;
use piola_integrators::{Composition, Ending, Report, State};
use piola_numerics::{Kernel, Lanes, dispatch};

use super::checkpoint::Part;
use super::drive::Reading as _;
use super::{History, Method, MotionRun, System, Timetable, system as model, systems::gravitating};

/// The most systems that are integrated together.
pub const TOGETHER: usize = 8;

/// From fourteen bodies on the sum of attractions of one system is in lanes itself.
const MOST_BODIES: usize = 13;

type Number = Lanes<f64, TOGETHER>;

/// [`simulate`](super::simulate) of up to [`TOGETHER`] systems at once, each with the same record to the last bit.
///
/// Nothing where they cannot go together, where one of them fails, or where `stop` says so after a step: then each goes by itself. They go
/// together if they are 2 to 8 systems of at most 13 bodies that attract each other, with the same Gm and softening and without
/// post-Newtonian term, by a composition: all take the same steps.
///
/// # Example
/// ```
/// use piola_integrators::Order;
/// use piola_simulation::motion::{Gravitation, MassPoint, Method, System, TimeSpan, Timetable, simulate, simulate_together};
/// use std::ops::ControlFlow;
/// let pair = |speed: f64| {
///     let body = |name: &str, side: f64| {
///         MassPoint { name: name.into(), gm: 1.0, position: [side, 0.0, 0.0], velocity: [0.0, speed * side, 0.0] }
///     };
///     let bodies = vec![body("right", 1.0), body("left", -1.0)];
///     System::Gravitation(Gravitation { bodies, softening: 0.0, post_newtonian: None })
/// };
/// let (circle, ellipse) = (pair(0.5), pair(0.6));
/// let timetable = Timetable::new(TimeSpan { start: 0.0, end: 6.0 }, 3, &[]);
/// let method = Method::Composition { order: Order::Eight, step: 0.1 };
/// let both = simulate_together(&[&circle, &ellipse], method, &timetable, &|| false).expect("they go together");
/// let alone = simulate(&ellipse, method, &timetable, &mut |_| ControlFlow::Continue(()));
/// assert_eq!(both[1].history, alone.history);
/// ```
#[must_use]
pub fn simulate_together(
    systems: &[&System],
    method: Method,
    timetable: &Timetable,
    stop: &dyn Fn() -> bool,
) -> Option<Vec<MotionRun>> {
    let Method::Composition { order, step } = method else { return None };
    let systems = fitting(systems)?;
    let mut bodies = gravitating(systems.first()?).ok()?;
    let mut method = Composition::new(order, step).ok()?;
    let mut values = vec![Number::splat(0.0); 6 * bodies.bodies()];
    // Lanes without a system follow the last one.
    for lane in 0..TOGETHER {
        let start = start(&bodies, systems[lane.min(systems.len() - 1)])?;
        for (value, start) in values.iter_mut().zip(start) {
            value.0[lane] = start;
        }
    }
    let span = timetable.span();
    let mut state = State::new(span.start, values).ok()?;
    let mut histories: Vec<History> = systems.iter().map(|system| history(system)).collect();
    record(&mut bodies, &state, &mut histories);
    let mut report = Report::begin();
    let later = timetable.instants().iter().filter(|t| span.order(**t, span.start).is_gt());
    for &instant in later {
        let (steps, taken) = state.begin_equal_steps::<core::convert::Infallible>(instant, step).ok()?;
        method.begin(3 * bodies.bodies());
        for number in taken + 1..=steps.count {
            let end = steps.time(number);
            let one =
                OneStep { method: &mut method, bodies: &mut bodies, state: &mut state, length: steps.length, end };
            report.evaluations += dispatch(one)?;
            report.steps += 1;
            state.set_time(end);
            if stop() {
                return None;
            }
        }
        record(&mut bodies, &state, &mut histories);
    }
    report.ending = Ending::Reached;
    let run = |history| MotionRun::of(Part { history, report, time: state.time }, Ok(()));
    Some(histories.into_iter().map(run).collect())
}

/// The systems as bodies that attract each other, if all have the same equations.
fn fitting<'s>(systems: &[&'s System]) -> Option<Vec<&'s model::Gravitation>> {
    let bodies = |system: &&'s System| match system {
        System::Gravitation(system) if system.post_newtonian.is_none() => Some(system),
        _ => None,
    };
    let systems: Vec<&model::Gravitation> = systems.iter().map(bodies).collect::<Option<_>>()?;
    let parameters = |system: &model::Gravitation| -> Vec<u64> {
        let own = system.bodies.iter().map(|body| body.gm.to_bits());
        own.chain([system.softening.to_bits()]).collect()
    };
    let first = parameters(systems.first()?);
    let fits = 2 <= systems.len()
        && systems.len() <= TOGETHER
        && (2..=MOST_BODIES + 1).contains(&first.len())
        && systems.iter().all(|system| parameters(system) == first);
    fits.then_some(systems)
}

/// The values of a system at its start.
fn start(bodies: &Gravitation, system: &model::Gravitation) -> Option<Vec<f64>> {
    let positions: Vec<_> = system.bodies.iter().map(|body| body.position).collect();
    let velocities: Vec<_> = system.bodies.iter().map(|body| body.velocity).collect();
    bodies.state(&positions, &velocities).ok()
}

fn history(system: &model::Gravitation) -> History {
    History { names: system.bodies.iter().map(|body| body.name.clone()).collect(), ..History::default() }
}

/// Records the state of each system.
fn record(bodies: &mut Gravitation, state: &State<Number>, histories: &mut [History]) {
    for (lane, history) in histories.iter_mut().enumerate() {
        let values: Vec<f64> = state.values.iter().map(|value| value.0[lane]).collect();
        bodies.record(state.time, &values, history);
        let invariants = super::drive::Reading::invariants(bodies, state.time, &values);
        history.invariants.push(invariants);
    }
}

/// One step of all lanes, in the widest instructions of the machine.
struct OneStep<'a> {
    method: &'a mut Composition<Number>,
    bodies: &'a mut Gravitation,
    state: &'a mut State<Number>,
    length: f64,
    end: f64,
}

impl Kernel for OneStep<'_> {
    /// Evaluations of the forces; none where a lane fails.
    type Output = Option<u64>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Option<u64> {
        self.method.advance(self.bodies, self.state, self.length, self.end).ok()
    }
}

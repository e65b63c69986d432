//! Nanoseconds of one step: our methods and the peers', on the double pendulum and the Pleiades.
//!
//! Every benchmark is a whole run; an item is an accepted step of that run. Adaptive methods run with
//! tolerance 1e-10, so that their steps differ a little in number and all have about the same error, which
//! the notes hold. The equations are written by hand, the same for all, unless a name says otherwise.

use std::error::Error;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_benches::chain::Chain;
use piola_benches::notes::Notes;
use piola_benches::peers;
use piola_benches::problems::{self, Equations, Force, Problem};
use piola_benches::work_precision::{Outcome, by_hand};
use piola_integrators::{Composition, DormandPrince853, GaussLegendre, Order, Report, State, Tolerance, separable};
use piola_lagrangian::Lagrangian;

const TOLERANCE: f64 = 1e-10;

type Group<'a> = BenchmarkGroup<'a, WallTime>;
type Run = Result<Outcome, String>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut notes = Notes::of("integrators");
    let mut group = criterion.benchmark_group("integrators");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));

    let pendulum = problems::double_pendulum()?;
    adaptive(&mut group, &mut notes, "double pendulum", &pendulum)?;
    derived(&mut group, &mut notes, &pendulum)?;
    collocation(&mut group, &mut notes, "double pendulum", &pendulum, 1000.0)?;
    let pleiades = problems::pleiades()?;
    adaptive(&mut group, &mut notes, "Pleiades", &pleiades)?;
    collocation(&mut group, &mut notes, "Pleiades", &pleiades, 3000.0)?;
    compositions(&mut group, &mut notes, "Pleiades", &pleiades, 3000.0)?;

    group.finish();
    criterion.final_summary();
    Ok(notes.write()?)
}

/// Measures one kind of run and notes its error.
fn bench<E: Equations<D>, const D: usize>(
    group: &mut Group<'_>,
    notes: &mut Notes,
    name: &str,
    problem: &Problem<E, D>,
    mut run: impl FnMut() -> Run,
) -> Result<(), String> {
    let outcome = run()?;
    notes.error(name, problem.error(&outcome.state));
    group.throughput(Throughput::Elements(outcome.steps));
    group.bench_function(name, |bencher| bencher.iter(|| black_box(run())));
    Ok(())
}

fn outcome<E: std::fmt::Display>(run: Result<Report, E>, state: State) -> Run {
    let report = run.map_err(|error| error.to_string())?;
    Ok(Outcome { state: state.values, evaluations: report.evaluations, steps: report.steps })
}

fn start<E, const D: usize>(problem: &Problem<E, D>) -> Result<State, String> {
    State::new(0.0, problem.start.to_vec()).map_err(|error| error.to_string())
}

/// Our adaptive method beside the peers': bare, watched at every step, and with a table of dense output.
fn adaptive<E: Equations<D>, const D: usize>(
    group: &mut Group<'_>,
    notes: &mut Notes,
    title: &str,
    problem: &Problem<E, D>,
) -> Result<(), Box<dyn Error>> {
    let spacing = problem.end / 1000.0;
    let mut method = DormandPrince853::new(Tolerance::relative(TOLERANCE)?);
    let mut equations = by_hand(problem);

    bench(group, notes, &format!("{title} Dormand-Prince 8(5,3)"), problem, || {
        let mut state = start(problem)?;
        outcome(method.integrate_to(&mut equations, &mut state, problem.end), state)
    })?;
    bench(group, notes, &format!("{title} Dormand-Prince 8(5,3) observed"), problem, || {
        let mut state = start(problem)?;
        let mut furthest = 0.0_f64;
        let run = method.integrate(&mut equations, &mut state, problem.end, |step| {
            furthest = furthest.max(step.values()[0]);
            ControlFlow::Continue(())
        });
        black_box(furthest);
        outcome(run, state)
    })?;
    bench(group, notes, &format!("{title} Dormand-Prince 8(5,3) dense 1000"), problem, || {
        let mut state = start(problem)?;
        let mut table = Vec::with_capacity(1001);
        let mut next = 0.0;
        let run = method.integrate(&mut equations, &mut state, problem.end, |step| {
            while next <= step.time() {
                let mut row = [0.0; D];
                if step.at(next, &mut row).is_err() {
                    return ControlFlow::Break(());
                }
                table.push(row);
                next += spacing;
            }
            ControlFlow::Continue(())
        });
        black_box(table);
        outcome(run, state)
    })?;

    for (name, spacing) in [("", None), (" dense 1000", Some(spacing))] {
        let full = format!("{title} {}{name}", peers::ODE_SOLVERS);
        notes.peer(&full, peers::ODE_SOLVERS);
        bench(group, notes, &full, problem, || peers::ode_solvers(problem, TOLERANCE, spacing))?;
        let full = format!("{title} {}{name}", peers::DIFFERENTIAL_EQUATIONS);
        notes.peer(&full, peers::DIFFERENTIAL_EQUATIONS);
        bench(group, notes, &full, problem, || peers::differential_equations(problem, TOLERANCE, spacing))?;
    }
    Ok(())
}

/// The double pendulum with the equations that Piola derives from its placement.
fn derived(
    group: &mut Group<'_>,
    notes: &mut Notes,
    problem: &Problem<problems::DoublePendulum, 4>,
) -> Result<(), Box<dyn Error>> {
    let pendulum = problem.equations;
    let chain = Chain::<2> { masses: pendulum.masses, lengths: pendulum.lengths };
    let lagrangian = Lagrangian::of(chain).with_gravity(pendulum.gravity);
    let mut method = DormandPrince853::new(Tolerance::relative(TOLERANCE)?);
    let mut motion = lagrangian.motion(2);
    bench(group, notes, "double pendulum by placement Dormand-Prince 8(5,3)", problem, || {
        let mut state = start(problem)?;
        outcome(method.integrate_to(&mut motion, &mut state, problem.end), state)
    })?;
    for order in [Order::Four, Order::Six, Order::Eight] {
        let mut method = GaussLegendre::new(order, problem.end / 1000.0)?;
        let mut motion = lagrangian.canonical_motion(2);
        let name = format!("double pendulum by placement, canonical Gauss-Legendre {}", order.value());
        bench(group, notes, &name, problem, || {
            let mut state = start(problem)?;
            let run = method.integrate_to(&mut motion, &mut state, problem.end);
            if let Some(&[q1, q2, p1, p2]) = state.values.first_chunk() {
                state.values[2..].copy_from_slice(&pendulum.velocities([q1, q2], [p1, p2]));
            }
            outcome(run, state)
        })?;
    }
    Ok(())
}

fn collocation<E: Equations<D>, const D: usize>(
    group: &mut Group<'_>,
    notes: &mut Notes,
    title: &str,
    problem: &Problem<E, D>,
    steps: f64,
) -> Result<(), Box<dyn Error>> {
    for order in [Order::Four, Order::Six, Order::Eight] {
        let mut method = GaussLegendre::new(order, problem.end / steps)?;
        let mut equations = by_hand(problem);
        bench(group, notes, &format!("{title} Gauss-Legendre {}", order.value()), problem, || {
            let mut state = start(problem)?;
            outcome(method.integrate_to(&mut equations, &mut state, problem.end), state)
        })?;
    }
    Ok(())
}

fn compositions<E: Equations<D> + Force, const D: usize>(
    group: &mut Group<'_>,
    notes: &mut Notes,
    title: &str,
    problem: &Problem<E, D>,
    steps: f64,
) -> Result<(), Box<dyn Error>> {
    let mut equations = separable(D / 2, |_t, q: &[f64], force: &mut [f64]| problem.equations.force(q, force));
    for order in Order::ALL {
        let mut method = Composition::new(order, problem.end / steps)?;
        bench(group, notes, &format!("{title} composition {}", order.value()), problem, || {
            let mut state = start(problem)?;
            outcome(method.integrate_to(&mut equations, &mut state, problem.end), state)
        })?;
        let name = format!("{title} composition {} observed", order.value());
        bench(group, notes, &name, problem, || {
            let mut state = start(problem)?;
            let mut furthest = 0.0_f64;
            let run = method.integrate(&mut equations, &mut state, problem.end, |step| {
                furthest = furthest.max(step.values[0]);
                ControlFlow::Continue(())
            });
            black_box(furthest);
            outcome(run, state)
        })?;
    }
    Ok(())
}

//! The choice of a method and its step.

use piola_integrators::{Advice, AdvisedMethod, Character, Order, advise};

use super::Method;
use crate::model::{Central, Gravitation, PhaseSystem, ReferenceKind, Scene, System};
use piola_gravitation::kepler::KeplerMotion;

/// Steps a method of order 8 takes for each turn of the fastest motion: errors near rounding on mild ellipses.
const STEPS_PER_TURN: f64 = 100.0;
/// Up to so many turns about a body that dominates an adaptive method of order 12 takes less time for the same error than a symplectic
/// one: the errors of the one grow with the square of the time, those of the other with the time.
const FEW_TURNS: f64 = 500.0;
/// Relative tolerance when none is asked for.
const TOLERANCE: f64 = 1e-12;
/// Relative tolerance for errors near rounding: the least that methods take.
const FINE_TOLERANCE: f64 = 2.0 * f64::EPSILON;
/// Relative tolerances at which the errors of a method are about those of rounding, on measured mechanisms and Hamiltonians: a smaller one
/// takes longer and errs no less.
const FINE_VERNER: f64 = 1e-13;
const FINE_NYSTROM_86: f64 = 1e-12;
const FINE_NYSTROM_1210: f64 = 1e-14;
/// Tolerances of a step from which Dormand's and Prince's pair takes less time for the same error than Verner's, on measured mechanisms.
const COARSE: f64 = 1e-12;

/// The method and why.
pub(super) fn method(scene: &Scene) -> (Method, String) {
    let request = &scene.integrator;
    let (family, order) = match request.method.rsplit_once('-') {
        Some((family, order)) => (family, Order::ALL.into_iter().find(|known| known.value().to_string() == order)),
        None => ("auto", None),
    };
    match (family, order) {
        ("composition", Some(order)) => {
            let (step, why) = step(scene, order);
            (Method::Composition { order, step }, format!("integrator.method asks for it; {why}"))
        }
        ("gauss-legendre", Some(order)) => {
            let (step, why) = step(scene, order);
            (Method::GaussLegendre { order, step }, format!("integrator.method asks for it; {why}"))
        }
        ("dormand-prince" | "verner" | "nystrom", _) => {
            let tolerance = scene.integrator.tolerance.unwrap_or(TOLERANCE);
            let method = match request.method.as_str() {
                "verner-98" => Method::Verner { tolerance },
                "nystrom-86" => Method::Nystrom86 { tolerance },
                "nystrom-1210" => Method::Nystrom1210 { tolerance },
                _ => Method::DormandPrince { tolerance },
            };
            (method, "integrator.method asks for it; the step adapts".to_string())
        }
        ("closed", _) => (Method::ClosedForm, "integrator.method asks for it".to_string()),
        _ => automatic(scene),
    }
}

/// The adaptive method that takes the least time on measured problems, and why.
fn adaptive(scene: &Scene, tolerance: f64, why: &str) -> (Method, String) {
    /// The error at the end of a run, in tolerances of a step.
    const AT_THE_END: f64 = 10.0;
    let tolerance = scene.integrator.tolerance.unwrap_or(tolerance);
    let character = match &scene.system {
        System::Phase(system) if system.has_constant_inertia() => Character::of_positions(),
        // The equations of a mechanism are given as rates of first order.
        System::Mechanism(_) | System::Phase(_) => return first_order(tolerance, why),
        System::Gravitation(system) if system.post_newtonian.is_some() => {
            Character::of_first_order().with_uneven_steps()
        }
        System::Gravitation(_) | System::Central(_) => Character::of_positions().with_uneven_steps(),
    };
    let turns = turns(scene);
    let character = turns.and_then(|turns| character.for_turns(turns).ok()).unwrap_or(character);
    let positions_alone = depends_on_positions_alone(&scene.system);
    match advise(&character, (AT_THE_END * tolerance).clamp(1e-15, 0.1)) {
        Ok(Advice { method, reason, evaluations, .. }) => {
            let method = match method {
                AdvisedMethod::DormandPrince853 => Method::DormandPrince { tolerance },
                AdvisedMethod::Nystrom86 => Method::Nystrom86 { tolerance },
                AdvisedMethod::Nystrom1210 => Method::Nystrom1210 { tolerance },
                // Scenes have no other adaptive method; of theirs these have the highest orders.
                _ if positions_alone => Method::Nystrom1210 { tolerance },
                _ => Method::Verner { tolerance },
            };
            (method, format!("{why}; {reason}{}", expected(turns.and(evaluations))))
        }
        Err(_) => (Method::DormandPrince { tolerance }, why.to_string()),
    }
}

/// The adaptive method for equations of first order.
fn first_order(tolerance: f64, why: &str) -> (Method, String) {
    if tolerance < COARSE {
        let reason = "of order 9: below a tolerance of 1e-12 it takes less time for the same error than one of order 8";
        return (Method::Verner { tolerance }, format!("{why}; {reason}"));
    }
    let reason = "of order 8: from a tolerance of 1e-12 it takes less time for the same error than one of order 9";
    (Method::DormandPrince { tolerance }, format!("{why}; {reason}"))
}

/// Whether the forces depend on positions alone.
fn depends_on_positions_alone(system: &System) -> bool {
    match system {
        System::Gravitation(system) => system.post_newtonian.is_none(),
        System::Central(_) => true,
        System::Phase(system) => system.has_constant_inertia(),
        System::Mechanism(_) => false,
    }
}

/// The length of the run in revolutions: about a fixed centre of the fastest body, among attracting bodies of the fastest pair.
fn turns(scene: &Scene) -> Option<f64> {
    let turn = match &scene.system {
        System::Gravitation(system) => fastest_turn(system),
        System::Central(system) => shortest_period(system),
        System::Phase(system) => system.fastest_turn(scene.time),
        System::Mechanism(_) => None,
    };
    turn.map(|turn| scene.time.length() / turn)
}

/// The predicted cost, where it is known.
fn expected(evaluations: Option<f64>) -> String {
    evaluations.map(|count| format!("; about {count:.1e} evaluations")).unwrap_or_default()
}

fn automatic(scene: &Scene) -> (Method, String) {
    let request = &scene.integrator;
    match &scene.system {
        System::Gravitation(system) if system.post_newtonian.is_some() => {
            let depends = "the post-Newtonian force depends on velocity, which no explicit composition allows";
            if request.tolerance.is_some() || (request.step.is_none() && !hierarchical(system)) {
                return adaptive(scene, TOLERANCE, &format!("{depends}; the step adapts"));
            }
            let (step, why) = step(scene, Order::Eight);
            (
                Method::GaussLegendre { order: Order::Eight, step },
                format!("{depends}: implicit, symplectic in canonical variables; {why}"),
            )
        }
        System::Gravitation(system) => {
            let few = turns(scene).is_some_and(|turns| turns <= FEW_TURNS);
            if request.tolerance.is_some() || (request.step.is_none() && (few || !hierarchical(system))) {
                let why = if request.tolerance.is_some() {
                    "integrator.tolerance asks for an adaptive step"
                } else if !hierarchical(system) {
                    "no body dominates, so that close encounters may come: the step adapts"
                } else {
                    "over so few turns the energy of an adaptive method does not drift by more than rounding"
                };
                let tolerance = if hierarchical(system) { FINE_NYSTROM_1210 } else { TOLERANCE };
                return adaptive(scene, tolerance, why);
            }
            let (step, why) = step(scene, Order::Eight);
            (
                Method::Composition { order: Order::Eight, step },
                format!(
                    "forces depend on positions alone and one body dominates: explicit, symplectic, energy does not drift; {why}"
                ),
            )
        }
        System::Central(system) => {
            let compares = matches!(scene.reference.as_ref().map(|reference| &reference.kind), Some(ReferenceKind::ClosedForm(_)));
            let free = request.step.is_none() && request.tolerance.is_none() && are_ellipses(system);
            let few = shortest_period(system).is_some_and(|period| scene.time.length() / period <= KeplerMotion::MOST_TURNS);
            if free && few && !compares {
                let why = "every body moves on an ellipse of its own, which has a closed form; errors do not grow with steps";
                return (Method::ClosedForm, why.to_string());
            }
            let because = match (free, compares) {
                (true, true) => "integrated because the reference is the closed form itself; ".to_string(),
                (true, false) => {
                    format!("integrated because the closed form takes at most {:e} turns; ", KeplerMotion::MOST_TURNS)
                }
                (false, _) => String::new(),
            };
            let e = eccentricity(system);
            if request.step.is_some() || (request.tolerance.is_none() && e <= 0.2) {
                let (step, why) = step(scene, Order::Eight);
                return (
                    Method::Composition { order: Order::Eight, step },
                    format!(
                        "{because}forces depend on positions alone and the orbit is near a circle: explicit, symplectic; {why}"
                    ),
                );
            }
            let why = format!("{because}the eccentricity {e:.4} needs steps of very different lengths: the step adapts");
            adaptive(scene, FINE_TOLERANCE, &why)
        }
        System::Phase(system) => phase(scene, system),
        System::Mechanism(system) => match request.step {
            None if request.tolerance.is_none() && system.has_closed_form() => (
                Method::ClosedForm,
                "a symmetric top about a fixed point under its weight, which has a closed form; errors do not grow with steps"
                    .to_string(),
            ),
            Some(step) => (
                Method::GaussLegendre { order: Order::Eight, step },
                "integrator.step asks for a fixed step, and the inertia metric depends on the coordinates: implicit, symplectic"
                    .to_string(),
            ),
            None => adaptive(
                scene,
                FINE_VERNER,
                "the inertia metric depends on the coordinates, so that no explicit symplectic method applies; the step adapts",
            ),
        },
    }
}

/// The method for a Hamiltonian.
fn phase(scene: &Scene, system: &PhaseSystem) -> (Method, String) {
    if scene.integrator.step.is_none() {
        if !system.has_constant_inertia() {
            let why = "H is no sum of V(q) and a T(p) of second degree, which methods for accelerations need; the step adapts";
            return adaptive(scene, FINE_VERNER, why);
        }
        let why = "H = T(p) + V(q) with T of second degree: accelerations depend on coordinates alone; the step adapts";
        if scene.integrator.tolerance.is_some() {
            return adaptive(scene, TOLERANCE, why);
        }
        let reason = match turns(scene) {
            Some(turns) if FEW_TURNS < turns => {
                "its errors grow with the square of the time; integrator.step asks for a symplectic method, whose errors grow with the time"
            }
            _ => "at this tolerance its errors are about those of rounding, between its steps too",
        };
        return (Method::Nystrom86 { tolerance: FINE_NYSTROM_86 }, format!("{why}; {reason}"));
    }
    let (step, why) = step(scene, Order::Eight);
    if system.hamiltonian.0.is_separable() {
        let why = format!("H = T(p) + V(q): explicit, symplectic, energy does not drift; {why}");
        return (Method::Composition { order: Order::Eight, step }, why);
    }
    let why =
        format!("integrator.step asks for a fixed step, and H is no sum T(p) + V(q): implicit, symplectic; {why}");
    (Method::GaussLegendre { order: Order::Eight, step }, why)
}

/// The step asked for, or one made from the fastest motion at the start.
fn step(scene: &Scene, order: Order) -> (f64, String) {
    let span = scene.time.length();
    if let Some(step) = scene.integrator.step {
        return (step.min(span), "the step is integrator.step".to_string());
    }
    let turn = turn(scene);
    let per_turn = STEPS_PER_TURN * if order == Order::Eight { 1.0 } else { 4.0 };
    match turn {
        Some(turn) if turn.is_finite() && 0.0 < turn => (
            (turn / per_turn).min(span),
            if matches!(scene.system, System::Phase(_)) {
                format!("the step is 1/{per_turn} of the fastest small turn along a trial of the motion, {turn:.4} s")
            } else {
                format!("the step is 1/{per_turn} of the fastest turn, {:.4} d", turn / 86_400.0)
            },
        ),
        _ => (span / 10_000.0, "the step is 1/10000 of the time, for want of a better measure".to_string()),
    }
}

/// The time of the fastest turn at the start, under a Hamiltonian along a trial, s.
fn turn(scene: &Scene) -> Option<f64> {
    match &scene.system {
        System::Gravitation(system) => fastest_turn(system),
        System::Central(system) => turn_at_pericentre(system),
        System::Phase(system) => system.fastest_turn(scene.time),
        System::Mechanism(_) => None,
    }
}

/// Whether one body has most of the mass.
fn hierarchical(system: &Gravitation) -> bool {
    let total: f64 = system.bodies.iter().map(|body| body.gm).sum();
    let largest = system.bodies.iter().map(|body| body.gm).fold(0.0, f64::max);
    0.9 * total < largest
}

/// The shortest period that any pair would have on a circle at its distance, s.
fn fastest_turn(system: &Gravitation) -> Option<f64> {
    /// More pairs than this are not looked through.
    const MOST: usize = 3000;
    let bodies = &system.bodies[..system.bodies.len().min(MOST)];
    let softening = system.softening * system.softening;
    let mut fastest = f64::INFINITY;
    for (i, one) in bodies.iter().enumerate() {
        for other in &bodies[i + 1..] {
            let square: f64 = one.position.iter().zip(other.position).map(|(a, b)| (a - b) * (a - b)).sum();
            let cube = (square + softening).powf(1.5);
            fastest = fastest.min(core::f64::consts::TAU * (cube / (one.gm + other.gm)).sqrt());
        }
    }
    (fastest < f64::INFINITY).then_some(fastest)
}

/// The period of a circle through the nearest pericentre, s.
fn turn_at_pericentre(system: &Central) -> Option<f64> {
    system
        .bodies
        .iter()
        .filter_map(|body| KeplerMotion::new(system.gm, body.position, body.velocity).ok())
        .map(|motion| motion.period() * (1.0 - motion.eccentricity()).powf(1.5))
        .reduce(f64::min)
}

/// The shortest period of a revolution, s.
fn shortest_period(system: &Central) -> Option<f64> {
    let motions =
        system.bodies.iter().filter_map(|body| KeplerMotion::new(system.gm, body.position, body.velocity).ok());
    motions.map(|motion| motion.period()).reduce(f64::min)
}

/// Whether Kepler's closed form holds for every body.
fn are_ellipses(system: &Central) -> bool {
    system.bodies.iter().all(|body| KeplerMotion::new(system.gm, body.position, body.velocity).is_ok())
}

fn eccentricity(system: &Central) -> f64 {
    let motions = system.bodies.iter().map(|body| KeplerMotion::new(system.gm, body.position, body.velocity));
    motions.map(|motion| motion.map_or(1.0, |motion| motion.eccentricity())).fold(0.0, f64::max)
}

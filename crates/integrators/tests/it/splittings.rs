//! Splittings other than the compositions of the orders two to eight: their conditions, orders, laws and costs.

use core::ops::ControlFlow;

use piola_integrators::{Composition, Order, SplittingScheme, SplittingStage, State, separable};
use piola_numerics::Real;
use piola_testkit::{DoubleDouble, Tol, allocations_in, assert_each_close, assert_order};

use crate::problems::{FIGURE_EIGHT, kepler, kepler_at, three_bodies};

const NYSTROM: [SplittingScheme; 3] =
    [SplittingScheme::Nystrom4, SplittingScheme::Nystrom6, SplittingScheme::Nystrom6Long];

fn lit(x: f64) -> DoubleDouble {
    DoubleDouble::lit(x)
}

/// The lists of odd numbers whose sum is at most `most`.
fn words(most: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    let mut from = 0;
    while from < all.len() {
        let word = all[from].clone();
        let used: usize = word.iter().sum();
        all.extend((1..=most - used).step_by(2).map(|letter| [&word[..], &[letter]].concat()));
        from += 1;
    }
    all
}

/// A symmetric step of second order is exp(γh A₁ + γ³h³ A₃ + γ⁵h⁵ A₅ + …), where the A do not commute. A product of such
/// exponentials is a sum over words; a method of order ten has that of exp(h A₁): 1/n! for Aₙ…A₁ of n letters one, and nothing
/// for all others, up to the degree ten.
#[test]
fn compositions_of_order_ten_obey_all_conditions() {
    let words = words(10);
    let factorial = |n: usize| (1..=n).fold(lit(1.0), |product, k| product * lit(k as f64));
    let mut sums: Vec<DoubleDouble> = words.iter().map(|word| lit(if word.is_empty() { 1.0 } else { 0.0 })).collect();
    let gammas: Vec<f64> =
        SplittingScheme::Composition10.stages().map(|stage| stage.kick).filter(|kick| 0.0 < kick.abs()).collect();
    assert_eq!(gammas.len(), 35);
    for &gamma in &gammas {
        let before = sums.clone();
        for (sum, word) in sums.iter_mut().zip(&words) {
            *sum = (0..=word.len()).fold(lit(0.0), |total, split| {
                let (first, rest) = word.split_at(split);
                let index = words.iter().position(|other| other == first).unwrap();
                let degree: usize = rest.iter().sum();
                let power = (0..degree).fold(lit(1.0), |product, _| product * lit(gamma));
                total + before[index] * power / factorial(rest.len())
            });
        }
    }
    let mut compared = 0;
    for (sum, word) in sums.iter().zip(&words) {
        let expected = if word.iter().all(|&letter| letter == 1) { lit(1.0) / factorial(word.len()) } else { lit(0.0) };
        let rest = (*sum - expected).primal(0);
        assert!(rest.abs() < 2e-15, "{word:?}: {rest:e}");
        compared += 1;
    }
    // One and the Fibonacci numbers 1, 1, 2, …, 55.
    assert_eq!(compared, 1 + 143);
}

/// A child of a root f of Nyström's trees: the velocity, or a tree.
#[derive(Clone, PartialEq, PartialOrd, Debug)]
enum Child {
    Velocity,
    Tree(Vec<Child>),
}

fn size(tree: &[Child]) -> usize {
    1 + tree.iter().map(room).sum::<usize>()
}

fn room(child: &Child) -> usize {
    match child {
        Child::Velocity => 1,
        Child::Tree(tree) => size(tree) + 1,
    }
}

/// Lists of children in falling order that fill so much room.
fn forests(room_left: usize, most: Option<&Child>) -> Vec<Vec<Child>> {
    if room_left == 0 {
        return vec![Vec::new()];
    }
    let mut children = vec![Child::Velocity];
    for order in 1..room_left {
        children.extend(forests(order - 1, None).into_iter().map(Child::Tree));
    }
    let mut found = Vec::new();
    for child in children.into_iter().filter(|child| most.is_none_or(|most| child <= most)) {
        for rest in forests(room_left - room(&child), Some(&child)) {
            found.push([core::slice::from_ref(&child), &rest[..]].concat());
        }
    }
    found
}

/// The derivative of a tree along the exact solution at the time s is this times a power of s.
fn exact(tree: &[Child]) -> DoubleDouble {
    tree.iter().fold(lit(1.0), |product, child| match child {
        Child::Velocity => product,
        Child::Tree(tree) => product * exact(tree) / lit((size(tree) * (size(tree) + 1)) as f64),
    })
}

/// The elementary weights of a tree at the kicks (b, c).
fn weights(tree: &[Child], kicks: &[(f64, DoubleDouble)]) -> Vec<DoubleDouble> {
    let mut product = vec![lit(1.0); kicks.len()];
    for child in tree {
        match child {
            Child::Velocity => product.iter_mut().zip(kicks).for_each(|(product, &(_, c))| *product *= c),
            Child::Tree(tree) => {
                let inner = weights(tree, kicks);
                for (i, product) in product.iter_mut().enumerate() {
                    *product *=
                        (0..i).fold(lit(0.0), |sum, j| sum + lit(kicks[j].0) * (kicks[i].1 - kicks[j].1) * inner[j]);
                }
            }
        }
    }
    product
}

/// Asserts Σ bᵢ Φᵢ(tree) = ∫ exact(tree)(s) ds for all trees of Nyström's up to the order; positions follow, because
/// a splitting is symplectic. The next order fails.
pub(crate) fn assert_conditions(name: &str, stages: impl Iterator<Item = SplittingStage>, order: usize, bound: f64) {
    let mut at = lit(0.0);
    let kicks: Vec<(f64, DoubleDouble)> = stages
        .map(|stage| {
            at += lit(stage.drift);
            (stage.kick, at)
        })
        .collect();
    assert!((at - lit(1.0)).primal(0).abs() < 1e-15, "{name}");
    let (mut compared, mut largest_beyond) = (0, 0.0_f64);
    for size in 1..=order + 1 {
        for tree in forests(size - 1, None) {
            let values = weights(&tree, &kicks);
            let sum = kicks.iter().zip(&values).fold(lit(0.0), |sum, (&(b, _), &value)| sum + lit(b) * value);
            let rest = (sum - exact(&tree) / lit(size as f64)).primal(0);
            if size <= order {
                assert!(rest.abs() < bound, "{name}, {tree:?}: {rest:e}");
                compared += 1;
            } else {
                largest_beyond = largest_beyond.max(rest.abs());
            }
        }
    }
    // 1, 1, 2, 3, 6, 10 trees.
    assert_eq!(compared, if order == 4 { 7 } else { 23 });
    assert!(1e-6 < largest_beyond, "{name}: {largest_beyond:e}");
}

#[test]
fn nystrom_splittings_obey_all_conditions() {
    for scheme in NYSTROM {
        assert_conditions(&scheme.to_string(), scheme.stages(), scheme.order() as usize, 1e-15);
    }
}

#[test]
fn schemes_are_symmetric_and_cost_what_they_say() {
    for scheme in SplittingScheme::ALL {
        let stages: Vec<_> = scheme.stages().collect();
        let kicks: Vec<f64> = stages.iter().map(|stage| stage.kick).take(stages.len() - 1).collect();
        let drifts: Vec<f64> = stages.iter().map(|stage| stage.drift).collect();
        assert_eq!(kicks, kicks.iter().rev().copied().collect::<Vec<_>>());
        assert_eq!(drifts, drifts.iter().rev().copied().collect::<Vec<_>>());
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let report =
            Composition::with_scheme(scheme, 0.01).unwrap().integrate_to(&mut kepler(), &mut state, 1.0).unwrap();
        let first = u64::from(drifts[0].abs() <= 0.0);
        assert_eq!(report.evaluations, 100 * scheme.forces() + first, "{scheme:?}");
    }
}

/// The phase of an oscillator after a hundred radians, over two decades of errors and more, within a tenth.
#[test]
fn phase_errors_fall_with_the_order_of_each_scheme() {
    let mut oscillator = separable(1, |_t, q: &[f64], force: &mut [f64]| force[0] = -q[0]);
    for scheme in SplittingScheme::ALL {
        let steps: &[f64] = match scheme {
            SplittingScheme::Composition10 => &[1.25, 1.0, 0.8, 0.625, 0.5, 0.4],
            SplittingScheme::Composition(Order::Two) => &[0.01, 0.005, 0.0025, 0.001],
            SplittingScheme::Composition(Order::Four) => &[0.1, 0.05, 0.025, 0.02],
            SplittingScheme::Nystrom4 => &[0.2, 0.1, 0.05, 0.025],
            _ => &[0.5, 0.4, 0.25, 0.2],
        };
        let errors: Vec<f64> = steps
            .iter()
            .map(|&h| {
                let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
                Composition::with_scheme(scheme, h).unwrap().integrate_to(&mut oscillator, &mut state, 100.0).unwrap();
                (state.values[0] - 100.0_f64.cos()).abs().max((state.values[1] + 100.0_f64.sin()).abs())
            })
            .collect();
        assert!(99.0 * errors[errors.len() - 1] < errors[0]);
        assert_order(&format!("{scheme:?}"), steps, &errors, f64::from(scheme.order()), 0.1);
    }
}

/// On an ellipse, where all conditions count.
#[test]
fn errors_on_an_ellipse_fall_with_the_order_of_each_scheme() {
    for (scheme, steps) in [
        (SplittingScheme::Nystrom4, [0.1, 0.05, 0.025, 0.0125]),
        (SplittingScheme::Nystrom6, [0.25, 0.2, 0.125, 0.1]),
        (SplittingScheme::Nystrom6Long, [0.25, 0.2, 0.125, 0.1]),
    ] {
        let errors = steps.map(|h| {
            let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
            Composition::with_scheme(scheme, h).unwrap().integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
            piola_testkit::relative_error(&state.values, &kepler_at(0.3, 5.0))
        });
        assert_order(&format!("{scheme:?}"), &steps, &errors, f64::from(scheme.order()), 0.5);
    }
}

/// A force that depends on time, too: its time is that of the positions.
#[test]
fn driven_oscillator_has_the_order_of_each_scheme() {
    for (scheme, steps) in [
        (SplittingScheme::Nystrom4, [0.2, 0.1, 0.05]),
        (SplittingScheme::Nystrom6, [0.4, 0.3, 0.2]),
        (SplittingScheme::Nystrom6Long, [0.4, 0.3, 0.2]),
    ] {
        // q̈ = −q + cos 2t: q = cos t + (cos t − cos 2t)/3 from q = 1, q̇ = 0.
        let mut driven = separable(1, |t: f64, q: &[f64], force: &mut [f64]| force[0] = -q[0] + (2.0 * t).cos());
        let end = 6.0_f64;
        let exact = end.cos() + (end.cos() - (2.0 * end).cos()) / 3.0;
        let errors = steps.map(|h| {
            let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
            Composition::with_scheme(scheme, h).unwrap().integrate_to(&mut driven, &mut state, end).unwrap();
            (state.values[0] - exact).abs()
        });
        assert_order(&format!("{scheme:?}"), &steps, &errors, f64::from(scheme.order()), 0.5);
    }
}

#[test]
fn steps_there_and_back_end_at_the_start() {
    for scheme in SplittingScheme::ALL {
        let start = kepler_at(0.5, 0.0);
        let mut state = State::new(0.0, start.to_vec()).unwrap();
        let mut method = Composition::with_scheme(scheme, 0.05).unwrap();
        method.integrate_to(&mut kepler(), &mut state, 10.0).unwrap();
        method.integrate_to(&mut kepler(), &mut state, 0.0).unwrap();
        let tol = Tol::stated(1e-12, "rounding of 400 steps, grown by the shear of neighbouring orbits");
        assert_each_close(&format!("{scheme:?}"), &state.values[..1], &start[..1], tol);
        assert!(state.values[1].abs() < 1e-12, "{scheme:?}");
    }
}

/// With as many forces, Runge–Kutta–Nyström splittings err less in energy than the compositions of their order: measured 34, 11 and
/// 9 times less.
#[test]
fn nystrom_splittings_err_less_in_energy_than_compositions_of_equal_cost() {
    let energy = |y: &[f64]| 0.5 * (y[2] * y[2] + y[3] * y[3]) - 1.0 / y[0].hypot(y[1]);
    let worst = |scheme: SplittingScheme| {
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let (before, mut worst) = (energy(&state.values), 0.0_f64);
        // 200 forces a revolution.
        let step = scheme.forces() as f64 * core::f64::consts::TAU / 200.0;
        Composition::with_scheme(scheme, step)
            .unwrap()
            .integrate(&mut kepler(), &mut state, 600.0, |step| {
                worst = worst.max((energy(step.values) - before).abs());
                ControlFlow::Continue(())
            })
            .unwrap();
        worst
    };
    let [four, six] = [Order::Four, Order::Six].map(|order| worst(SplittingScheme::Composition(order)));
    assert!(20.0 * worst(SplittingScheme::Nystrom4) < four);
    assert!(6.0 * worst(SplittingScheme::Nystrom6) < six);
    assert!(6.0 * worst(SplittingScheme::Nystrom6Long) < six);
}

#[test]
fn a_force_that_fails_leaves_the_last_good_state() {
    for scheme in SplittingScheme::ALL {
        let mut bounded = separable(1, |t: f64, _q: &[f64], force: &mut [f64]| {
            force[0] = if t < 1.0 { 0.0 } else { f64::NAN };
        });
        let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
        let error =
            Composition::with_scheme(scheme, 0.3).unwrap().integrate_to(&mut bounded, &mut state, 3.0).unwrap_err();
        assert!(matches!(
            error,
            piola_integrators::IntegratorsError::NotFinite { quantity: "rate", index: 0, t: Some(_), .. }
        ));
        assert!(
            0.5 < state.time && state.time < 1.0 && (state.values[0] - state.time).abs() < 1e-15,
            "{scheme:?}: {state:?}"
        );
    }
}

#[test]
fn steps_of_all_schemes_allocate_nothing() {
    for scheme in SplittingScheme::ALL {
        let mut state = State::new(0.0, FIGURE_EIGHT.to_vec()).unwrap();
        let mut method = Composition::with_scheme(scheme, 0.01).unwrap();
        method.integrate_to(&mut three_bodies(), &mut state, 0.1).unwrap();
        let (count, _) = allocations_in(|| method.integrate_to(&mut three_bodies(), &mut state, 1.1).unwrap());
        assert_eq!(count, 0, "{scheme:?}");
    }
}

//! Identities of attracting bodies.

use piola_gravitation::{Gravitation, PostNewtonian, attraction, post_newtonian_acceleration};
use piola_integrators::{Composition, Field, Order, State};
use piola_numerics::Dual;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, difference_quotient, strategies};
use proptest::prelude::*;

/// Numbers that look random and are always the same.
fn scattered(n: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..n).map(|_| next()).collect()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}

/// Bodies, some of them without mass, with positions and accelerations.
fn crowd(n: usize, seed: u64) -> (Gravitation, Vec<f64>, Vec<f64>) {
    let parameters = scattered(n, seed + 1).iter().map(|x| (x + 0.3).max(0.0)).collect();
    let mut bodies = Gravitation::new(parameters).unwrap();
    let positions = scattered(3 * n, seed);
    let mut accelerations = vec![0.0; 3 * n];
    bodies.accelerations_into(&positions, &mut accelerations).unwrap();
    (bodies, positions, accelerations)
}

/// Each body over all others in their order, written plainly.
fn plain(bodies: &Gravitation, positions: &[f64]) -> Vec<f64> {
    let n = bodies.bodies();
    let mut sums = vec![0.0; 3 * n];
    for i in 0..n {
        let x = bodies.position(positions, i);
        for (j, &parameter) in bodies.parameters().iter().enumerate() {
            if i != j && 0.0 < parameter {
                let y = bodies.position(positions, j);
                let a = attraction([y[0] - x[0], y[1] - x[1], y[2] - x[2]], parameter, bodies.softening().powi(2));
                for k in 0..3 {
                    sums[k * n + i] += a[k];
                }
            }
        }
    }
    sums
}

#[test]
fn sum_in_lanes_equals_plain_sum_bit_for_bit() {
    for n in (0..40).chain([63, 64, 65, 130, 600]) {
        let (bodies, positions, lanes) = crowd(n, n as u64);
        let mut scalar = vec![0.0; 3 * n];
        bodies.accelerations_over(&positions, &mut scalar).unwrap();
        assert_eq!(bits(&lanes), bits(&scalar), "{n} bodies");
        assert_eq!(bits(&lanes), bits(&plain(&bodies, &positions)), "{n} bodies");
    }
}

#[cfg(feature = "rayon")]
#[test]
fn sum_on_any_number_of_threads_equals_sum_on_one_bit_for_bit() {
    let n = 1500;
    let (mut bodies, positions, _) = crowd(n, 7);
    let mut on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut accelerations = vec![0.0; 3 * n];
        pool.install(|| bodies.accelerations_into(&positions, &mut accelerations)).unwrap();
        bits(&accelerations)
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(3));
    assert_eq!(one, bits(&plain(&bodies, &positions)));
}

#[cfg(feature = "rayon")]
#[test]
fn run_on_any_number_of_threads_equals_run_on_one_bit_for_bit() {
    let n = 1030;
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut bodies = Gravitation::new(vec![1e-3; n]).unwrap().with_softening(0.05).unwrap();
            let mut state = State::new(0.0, scattered(6 * n, 3)).unwrap();
            Composition::new(Order::Four, 0.01).unwrap().integrate_to(&mut bodies, &mut state, 0.05).unwrap();
            bits(&state.values)
        })
    };
    assert_eq!(run(1), run(3));
}

/// |Σ Gm a| against Σ Gm |a|.
fn assert_balanced(parameters: &[f64], accelerations: &[f64], what: &str) {
    let n = parameters.len();
    for component in accelerations.chunks(n) {
        let forces: Vec<f64> = parameters.iter().zip(component).map(|(m, a)| m * a).collect();
        let scale = forces.iter().map(|f| f.abs()).sum::<f64>();
        assert_close_at_scale(what, &[forces.iter().sum()], &[0.0], scale, Tol::ulps(4.0 * n as f64));
    }
}

proptest! {
    #[test]
    fn action_equals_reaction(n in 2_usize..40, seed in 0_u64..1000) {
        let (bodies, _, accelerations) = crowd(n, seed);
        assert_balanced(bodies.parameters(), &accelerations, "Σ m a");
    }

    #[test]
    fn post_newtonian_reaction_balances_the_term(centre in 0_usize..5, seed in 0_u64..1000) {
        let parameters: Vec<f64> = (0..5).map(|i| if i == centre { 2.0 } else { 0.25 * i as f64 }).collect();
        let y = scattered(30, seed);
        let rates = |bodies: &mut Gravitation| {
            let mut rate = vec![0.0; 30];
            bodies.rate(0.0, &y, &mut rate).unwrap();
            rate[15..].to_vec()
        };
        let mut newton = Gravitation::new(parameters.clone()).unwrap();
        let mut einstein =
            newton.clone().with_post_newtonian(PostNewtonian { centre, speed_of_light: 3.0 }).unwrap();
        let (before, after) = (rates(&mut newton), rates(&mut einstein));
        assert_balanced(&parameters, &after, "Σ m (a + Δa)");
        // On every other body it is the formula's.
        let other = (centre + 1) % 5;
        let relative = |block: usize| {
            core::array::from_fn(|k| y[(block + k) * 5 + other] - y[(block + k) * 5 + centre])
        };
        let term = post_newtonian_acceleration(relative(0), relative(3), 2.0, 3.0);
        let change: Vec<f64> = (0..3).map(|k| after[k * 5 + other] - before[k * 5 + other]).collect();
        let size = before.iter().chain(&after).fold(0.0_f64, |m, a| m.max(a.abs()));
        assert_close_at_scale("Δa", &change, &term, size, Tol::ulps(4.0));
    }

    #[test]
    fn accelerations_move_and_turn_with_the_bodies(
        n in 2_usize..20,
        seed in 0_u64..1000,
        q in strategies::rotation(),
        shift in strategies::vector(3, -2.0..2.0),
    ) {
        let (mut bodies, positions, accelerations) = crowd(n, seed);
        let r = strategies::rotation_matrix(q);
        let turn = |values: &[f64], shift: &[f64]| -> Vec<f64> {
            let component = |k: usize, body: usize| (0..3).map(|j| r[k][j] * values[j * n + body]).sum::<f64>() + shift[k];
            (0..3).flat_map(|k| (0..n).map(move |body| (k, body))).map(|(k, body)| component(k, body)).collect()
        };
        let mut turned = vec![0.0; 3 * n];
        bodies.accelerations_into(&turn(&positions, &shift), &mut turned).unwrap();
        // Rounding of the moved positions counts as much as they are nearer to each other than to the origin.
        let nearest = (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| {
            let (x, y) = (bodies.position(&positions, i), bodies.position(&positions, j));
            (0..3).map(|k| (x[k] - y[k]).powi(2)).sum::<f64>().sqrt()
        }).fold(f64::INFINITY, f64::min);
        let tol = Tol::ulps(64.0).times(4.0 / nearest);
        assert_close("R a", &turned, &turn(&accelerations, &[0.0; 3]), tol);
    }

    #[test]
    fn rate_over_duals_equals_differences(seed in 0_u64..200) {
        let mut bodies = Gravitation::new(vec![1.0, 0.5, 0.0]).unwrap().with_softening(0.25).unwrap()
            .with_post_newtonian(PostNewtonian { centre: 0, speed_of_light: 10.0 }).unwrap();
        // Bodies about three apart.
        let mut y = scattered(18, seed);
        y[1] += 3.0;
        y[5] += 3.0;
        let direction: Vec<f64> = scattered(18, seed + 1);
        let along: Vec<_> = y.iter().zip(&direction).map(|(&y, &d)| Dual::new(y, d)).collect();
        let mut exact = vec![Dual::constant(0.0); 18];
        bodies.rate(0.0, &along, &mut exact).unwrap();
        let exact: Vec<f64> = exact.iter().map(|x| x.tangent).collect();
        let at = |y: &[f64]| {
            let mut rate = vec![0.0; 18];
            bodies.clone().rate(0.0, y, &mut rate).unwrap();
            rate
        };
        assert_close("tangent", &exact, &difference_quotient(at, &y, &direction), Tol::stated(1e-9, "sixth-order differences"));
    }

    #[test]
    fn attraction_equals_gradient_of_energy(seed in 0_u64..200) {
        let parameters = vec![1.0, 0.5, 0.25, 2.0];
        let mut bodies = Gravitation::new(parameters.clone()).unwrap().with_softening(0.5).unwrap();
        let y = [scattered(12, seed), vec![0.0; 12]].concat();
        let mut accelerations = vec![0.0; 12];
        bodies.accelerations_into(&y[..12], &mut accelerations).unwrap();
        let direction = [scattered(12, seed + 1), vec![0.0; 12]].concat();
        let slope = difference_quotient(|y| vec![bodies.invariants(y).energy], &y, &direction);
        let work: f64 = (0..12).map(|i| parameters[i % 4] * accelerations[i] * direction[i]).sum();
        assert_close_at_scale("−dV", &[-slope[0]], &[work], 10.0, Tol::stated(1e-10, "sixth-order differences"));
    }
}

#[test]
fn post_newtonian_energy_is_kept_where_newtons_is_not() {
    // A light body about a heavy one, at a third of a percent of the speed of light.
    let term = PostNewtonian { centre: 0, speed_of_light: 300.0 };
    let mut bodies = Gravitation::new(vec![1.0, 0.0]).unwrap().with_post_newtonian(term).unwrap();
    let start = bodies.state(&[[0.0; 3], [1.0, 0.0, 0.0]], &[[0.0; 3], [0.0, 1.2, 0.0]]).unwrap();
    // A test particle has no energy of its own here: it is given the least mass that does not move the centre.
    let light = Gravitation::new(vec![1.0, 1e-30]).unwrap().with_post_newtonian(term).unwrap();
    let before = light.invariants(&start);
    let mut state = State::new(0.0, start).unwrap();
    let mut method = piola_integrators::GaussLegendre::new(Order::Eight, 0.02).unwrap();
    let (mut newton, mut einstein) = (0.0_f64, 0.0_f64);
    method
        .integrate(&mut bodies, &mut state, 20.0, |step| {
            let now = light.invariants(step.values);
            newton = newton.max((now.energy / before.energy - 1.0).abs());
            einstein = einstein.max((now.post_newtonian_energy / before.post_newtonian_energy - 1.0).abs());
            core::ops::ControlFlow::Continue(())
        })
        .unwrap();
    // The neglected terms are smaller by 1/c², 1e-5, than the term itself.
    assert!(einstein < 1e-4 * newton, "{newton:e} {einstein:e}");
}

#[test]
fn single_precision_equals_double_to_its_precision() {
    let (bodies, positions, expected) = crowd(12, 5);
    #[expect(clippy::cast_possible_truncation, reason = "rounding to single precision is the point")]
    let rounded: Vec<f32> = positions.iter().map(|&x| x as f32).collect();
    let mut accelerations = vec![0.0_f32; 36];
    bodies.accelerations_over(&rounded, &mut accelerations).unwrap();
    let actual: Vec<f64> = accelerations.iter().map(|&a| f64::from(a)).collect();
    assert_close("a", &actual, &expected, Tol::ulps32(64.0));
}

//! Identities at random states.

use piola_lagrangian::Reaction;
use piola_numerics::Jet;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

use crate::systems::{Mechanism, System, Ties, bar_angles, loop_angles, mechanism};

/// The angles, rates and accelerations of a motion of one parameter.
fn follow<const N: usize>(
    independent: &Mechanism,
    angles: impl Fn(Jet<f64, 1>) -> [Jet<f64, 1>; N],
    (s, rate): (f64, f64),
) -> [[f64; N]; 4] {
    let second = independent.acceleration(&[s], &[rate], 0.0).unwrap()[0];
    let jets = angles(Jet::coordinate(s, rate, 0));
    [
        jets.map(|q| q.value),
        jets.map(|q| q.rate),
        jets.map(|q| q.partials[0] * second + q.second_rate),
        jets.map(|q| q.partials[0]),
    ]
}

fn check<const N: usize>(implicit: &Mechanism, ties: Ties, again: Option<Ties>, [q, v, a, tangent]: [[f64; N]; 4]) {
    let tol = Tol::stated(1e-11, "ulps by the condition of the gradients");
    let system = implicit.clone().with_constraints(ties);
    let found = system.acceleration(&q, &v, 0.0).unwrap();
    assert_close("q̈", found.as_slice(), &a, tol);
    // R = M q̈ − f does no work along the motion that is left.
    let reactions = system.reactions(&q, &v, 0.0).unwrap();
    let work: f64 = reactions.iter().zip(&tangent).map(|(r, t)| r * t).sum();
    let scale: f64 = reactions.iter().zip(&tangent).map(|(r, t)| (r * t).abs()).sum();
    assert_close_at_scale("virtual work", &[work], &[0.0], scale, tol);
    let (mut mass_matrix, mut forcing) = (vec![0.0; N * N], vec![0.0; N]);
    let mut work = piola_lagrangian::Workspace::default();
    implicit.equations_into(&mut work, &q, &v, 0.0, &mut mass_matrix, &mut forcing).unwrap();
    let inertia = |i: usize| (0..N).map(|j| mass_matrix[i + j * N] * found[j]).sum::<f64>();
    let needed: Vec<f64> = (0..N).map(|i| inertia(i) - forcing[i]).collect();
    let largest = (0..N).map(|i| inertia(i).abs().max(forcing[i].abs())).fold(0.0, f64::max);
    assert_close_at_scale("M q̈ − f", reactions.as_slice(), &needed, largest, tol);
    if let Some(ties) = again {
        let redundant = implicit.clone().with_constraints(ties);
        assert_close("q̈", redundant.acceleration(&q, &v, 0.0).unwrap().as_slice(), &a, tol);
        let twice = redundant.reactions(&q, &v, 0.0).unwrap();
        assert_close_at_scale("reactions", twice.as_slice(), reactions.as_slice(), largest, tol);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn accelerations_of_four_bar_in_three_angles_equal_those_in_one(
        crank in strategies::finite(-10.0..10.0),
        rate in strategies::finite(-20.0..20.0),
        gravity in strategies::vector(3, -10.0..10.0),
        drive in strategies::finite(-5.0..5.0),
    ) {
        let gravity = [gravity[0], gravity[1], gravity[2]];
        let independent = mechanism(System::FourBarCrank, gravity, drive);
        let state = follow(&independent, bar_angles, (crank, rate));
        let implicit = mechanism(System::FourBar, gravity, drive);
        check(&implicit, Ties::FourBar, Some(Ties::FourBarThrice), state);
    }

    #[test]
    fn accelerations_of_bricard_loop_in_six_angles_equal_those_in_one_parameter(
        psi in strategies::finite(-7.0..7.0),
        rate in strategies::finite(-5.0..5.0),
        gravity in strategies::vector(3, -10.0..10.0),
    ) {
        let gravity = [gravity[0], gravity[1], gravity[2]];
        let state = follow(&mechanism(System::BricardSymmetric, gravity, 0.0), loop_angles, (psi, rate));
        check(&mechanism(System::Bricard { sixth: false }, gravity, 0.0), Ties::Bricard, None, state);
    }
}

#[test]
fn equal_constraints_share_the_multiplier() {
    let twice = Ties::Linear(vec![vec![1.0, 0.0, 0.0, 1.0, 0.0], vec![1.0, 0.0, 0.0, 1.0, 0.0]]);
    let bead = mechanism(System::Particles { last_has_mass: true }, [0.0, -10.0, 0.0], 0.0).with_constraints(twice);
    let multipliers = bead.multipliers(&[0.0, 1.0, 0.0], &[0.0; 3], 0.0).unwrap();
    assert_close("λ", multipliers.as_slice(), &[-5.0, -5.0], Tol::ulps(4.0));
    // In other units, of twice the gradient, the second carries the same force.
    let other = Ties::Linear(vec![vec![1.0, 0.0, 0.0, 1.0, 0.0], vec![2.0, 0.0, 0.0, 2.0, 0.0]]);
    let bead = mechanism(System::Particles { last_has_mass: true }, [0.0, -10.0, 0.0], 0.0).with_constraints(other);
    let multipliers = bead.multipliers(&[0.0, 1.0, 0.0], &[0.0; 3], 0.0).unwrap();
    assert_close("λ", multipliers.as_slice(), &[-5.0, -2.5], Tol::ulps(4.0));
}

#[test]
fn radius_held_in_polar_coordinates_is_held_by_the_centripetal_force() {
    let bead = mechanism(System::Polar, [0.0; 3], 0.0).with_constraints(Ties::Radius(3.0));
    let (q, v) = ([3.0, 0.0], [0.0, 2.0]);
    let reactions = bead.reactions(&q, &v, 0.0).unwrap();
    assert_close("−m r φ̇²", reactions.as_slice(), &[-24.0, 0.0], Tol::ulps(4.0));
    let Reaction::Particle { force, .. } = bead.part_reactions(&q, &v, 0.0).unwrap()[0] else { unreachable!() };
    assert_close("force", force.as_slice(), &[-24.0, 0.0, 0.0], Tol::ulps(4.0));
}

#[test]
fn coordinate_without_inertia_follows_its_constraint() {
    // z = 2 x + 1 + 3 t, with a mass along x and y only; γ = 0 and z̈ = 2 ẍ.
    let tied = Ties::Linear(vec![vec![1.0, 3.0, -2.0, 0.0, 1.0]]);
    let bead = mechanism(System::Particles { last_has_mass: false }, [5.0, -10.0, 7.0], 0.0).with_constraints(tied);
    let start = bead.assemble(&[1.0, 2.0, 7.0], &[0.5, 0.0, 0.0], 1.0).unwrap();
    let [x, _, z] = start.coordinates[..] else { unreachable!() };
    assert_close("z", &[z], &[2.0 * x + 4.0], Tol::ulps(4.0));
    assert_close("ż", &[start.velocities[2]], &[2.0 * start.velocities[0] + 3.0], Tol::ulps(4.0));
    let acceleration = bead.acceleration(&start.coordinates, &start.velocities, 1.0).unwrap();
    assert_close("q̈", acceleration.as_slice(), &[5.0, -10.0, 10.0], Tol::ulps(8.0));
}

#[test]
fn drifting_constraint_takes_the_particle_with_it() {
    // x = 2 t: 1 kg at rest is brought to 2 m/s, and y falls freely.
    let belt = Ties::Linear(vec![vec![0.0, 2.0, 1.0, 0.0, 0.0]]);
    let particle = mechanism(System::Particles { last_has_mass: true }, [0.0, -10.0, 0.0], 0.0).with_constraints(belt);
    let tolerance = piola_integrators::Tolerance::relative(1e-12).unwrap();
    let run = particle.integrate(&[0.25, 0.0, 1.0], &[0.0; 3], 0.0..3.0, tolerance).unwrap();
    let (q, v) = run.last();
    assert_close("q", q, &[6.0, -45.0, 1.0], Tol::stated(1e-14, "rounding of a few steps"));
    assert_close("v", v, &[2.0, -30.0, 0.0], Tol::stated(1e-14, "rounding of a few steps"));
}

/// n₁·x = 0 and (n₁ + δ n₂)·x = 0 hold a particle to the line along n₁×n₂, where gravity moves it. However small δ is, both
/// hold to rounding; the direction of the line is known to rounding over δ.
#[test]
fn nearly_dependent_constraints_are_both_satisfied_to_rounding() {
    let gravity = [1.0, -2.0, -9.8];
    let (first, second, along) = ([0.6, 0.48, 0.64], [-0.8, 0.36, 0.48], [0.0, -0.8, 0.6]);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for share in [1e-2, 1e-4, 1e-6] {
        let near: Vec<f64> = first.iter().zip(&second).map(|(a, b)| a + share * b).collect();
        let rows = [&first[..], &near].map(|row| [&[0.0; 2], row].concat());
        let free = mechanism(System::Particles { last_has_mass: true }, gravity, 0.0);
        let system = free.with_constraints(Ties::Linear(rows.to_vec()));
        let found = system.acceleration(&[0.0; 3], &[0.0; 3], 0.0).unwrap();
        let across = [dot(&first, found.as_slice()), dot(&near, found.as_slice())];
        assert_close_at_scale("∂²g/∂t²", &across, &[0.0; 2], 10.0, Tol::ulps(8.0));
        let fall = dot(&along, &gravity);
        assert_close_at_scale(
            "fall",
            &[dot(&along, found.as_slice())],
            &[fall],
            10.0,
            Tol::ulps(8.0).times(1.0 / share),
        );
    }
}

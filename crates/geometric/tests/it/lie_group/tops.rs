//! Tops: references of 36 digits, closed forms, what the motion keeps.

use piola_geometric::{
    CommutatorFree, DirectProduct, GeneralisedAlpha, GroupField, LieGroup, MuntheKaas, RigidMotions, Rotations,
    Translations, group_field,
};
use piola_integrators::{Order, State};
use piola_numerics::{Dual, Real};
use piola_testkit::{Tol, assert_close, assert_each_close_at_scales, assert_order};

use super::{Top, cross, reference, vertical};

/// Attitudes are compared with one, angular velocities with the largest of them.
fn compare(what: &str, found: &[f64], expected: &[f64], tol: Tol) {
    assert_close(&format!("{what}: attitude"), &found[..4], &expected[..4], tol);
    assert_close(&format!("{what}: angular velocity"), &found[4..], &expected[4..], tol);
}

fn follow(name: &str, step: f64, tol: Tol) {
    let (mut top, mut state, states) = reference(name);
    let mut method = MuntheKaas::new(Order::Eight, step).unwrap();
    for (t, expected) in states {
        method.integrate_to(&mut top, &mut state, t).unwrap();
        compare(name, &state.values, &expected, tol);
    }
}

#[test]
fn order_eight_follows_the_references() {
    follow("free asymmetric top", 0.025, Tol::ulps(16.0));
    follow("free top about its middle axis", 0.025, Tol::ulps(16.0));
    follow("heavy top, asymmetric", 0.0125, Tol::ulps(16.0));
    let tol = Tol::ulps_because(256.0, "8000 steps in which the top turns by 300 rad");
    follow("heavy top of the test set", 0.000_25, tol);
}

#[test]
fn lagrange_top_of_the_test_set_keeps_energy_spin_and_vertical_momentum() {
    let (mut top, mut state, _) = reference("heavy top of the test set");
    let kept = |top: &Top, y: &[f64]| {
        let (momentum, up) = (top.angular_momentum(&y[4..]), vertical(&y[..4]));
        [top.energy(y), y[5], (0..3).map(|i| momentum[i] * up[i]).sum()]
    };
    let before = kept(&top, &state.values);
    MuntheKaas::new(Order::Eight, 0.000_25).unwrap().integrate_to(&mut top, &mut state, 2.0).unwrap();
    let after = kept(&top, &state.values);
    // The vertical momentum is the sum of parts of 70 N m s.
    let tol = Tol::ulps_because(1024.0, "8000 steps, 96,000 evaluations, each of which rounds");
    assert_each_close_at_scales("kept", &after, &before, &[0.0, 0.0, 70.0], tol);
    // By other methods the same motion, to their errors.
    for (what, error) in [("commutator-free", 0), ("generalised-α", 1)] {
        let (mut top, start, states) = reference("heavy top of the test set");
        let (t, expected) = &states[0];
        let steps = [0.0005, 0.000_25, 0.000_125];
        let errors = steps.map(|h| {
            let mut state = start.clone();
            match error {
                0 => CommutatorFree::new(h).unwrap().integrate_to(&mut top, &mut state, *t).unwrap(),
                _ => GeneralisedAlpha::new(0.8, h).unwrap().integrate_to(&mut top, &mut state, *t).unwrap(),
            };
            state.values[..4].iter().zip(expected).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
        });
        assert_order(what, &steps, &errors, if error == 0 { 4.0 } else { 2.0 }, 0.1);
    }
}

/// The attitude of a free symmetric top, J = diag(A, A, C): a turn about the angular momentum after one about the axis.
///
/// ```text
/// q = exp(t l/A) q₀ exp(t (1 − C/A) Ω₃ e₃),    l the angular momentum in space
/// ```
fn symmetric<T: Real>(a: f64, c: f64, q: [T; 4], omega: [T; 3], t: f64) -> Vec<T> {
    let t_lit = T::lit(t);
    // exp(t q l q*/A) q = q exp(t l/A) with l in the body.
    let spin = omega[2] * T::lit(1.0 - c / a);
    let (mut element, mut carry) = (q.to_vec(), vec![T::zero(); 4]);
    let momentum = [omega[0], omega[1], omega[2] * T::lit(c / a)].map(|x| x * t_lit);
    Rotations.advance(&mut element, &mut carry, &momentum);
    Rotations.advance(&mut element, &mut carry, &[T::zero(), T::zero(), spin * t_lit]);
    let (s, cosine) = (spin * t_lit).sin_cos();
    element.extend([cosine * omega[0] + s * omega[1], cosine * omega[1] - s * omega[0], omega[2]]);
    element
}

#[test]
fn free_symmetric_top_equals_its_closed_form_and_so_do_derivatives() {
    let (a, c, q, omega) = (1.0, 1.75, [0.5, -0.5, 0.5, 0.5], [0.5, 0.25, 2.0]);
    let mut top = Top::new([a, a, c], [0.0; 3]);
    let tol = Tol::ulps_because(128.0, "400 steps, 4800 evaluations, each of which rounds");
    for direction in 0..3 {
        let omega: [Dual<f64>; 3] =
            core::array::from_fn(|i| Dual::new(omega[i], if i == direction { 1.0 } else { 0.0 }));
        let q = q.map(Dual::constant);
        let mut state = State::new(0.0, [&q[..], &omega].concat()).unwrap();
        MuntheKaas::new(Order::Eight, 0.025).unwrap().integrate_to(&mut top, &mut state, 10.0).unwrap();
        let expected = symmetric(a, c, q, omega, 10.0);
        let parts = |y: &[Dual<f64>], part: fn(&Dual<f64>) -> f64| y.iter().map(part).collect::<Vec<_>>();
        compare("value", &parts(&state.values, |x| x.value), &parts(&expected, |x| x.value), tol);
        // Derivatives grow as 10 s times the frequencies.
        compare("derivative", &parts(&state.values, |x| x.tangent), &parts(&expected, |x| x.tangent), tol.times(4.0));
    }
}

#[test]
fn free_top_keeps_its_angular_momentum_in_space_and_its_energy() {
    let (mut top, mut state, _) = reference("free asymmetric top");
    let kept = |top: &Top, y: &[f64]| {
        let l = top.angular_momentum(&y[4..]);
        let u = [y[1], y[2], y[3]];
        let twice = cross(u, l).map(|x| 2.0 * x);
        let beside = cross(u, twice);
        [
            l[0] + y[0] * twice[0] + beside[0],
            l[1] + y[0] * twice[1] + beside[1],
            l[2] + y[0] * twice[2] + beside[2],
            top.energy(y),
        ]
    };
    let before = kept(&top, &state.values);
    MuntheKaas::new(Order::Eight, 0.05).unwrap().integrate_to(&mut top, &mut state, 200.0).unwrap();
    let tol = Tol::ulps_because(512.0, "4000 steps, 48,000 evaluations, each of which rounds");
    assert_close("kept", &kept(&top, &state.values), &before, tol);
}

/// A free body on SE(3): its centre of mass goes straight on in space, its attitude is that of the free top.
#[test]
fn free_body_on_rigid_motions_goes_straight_while_it_tumbles() {
    let (mut top, start, states) = reference("free asymmetric top");
    let (t, expected) = &states[2];
    let velocity = [0.25, -0.5, 1.0];
    let steps = [0.1, 0.05, 0.025, 0.01, 0.005];
    let errors = steps.map(|h| {
        // (q, x), then Ω and v in body components: v̇ = v × Ω.
        let mut body = group_field(DirectProduct(RigidMotions, Translations(6)), |t, y: &[f64], rate: &mut [f64]| {
            let inner = [&y[..4], &y[7..10]].concat();
            let mut moving = [0.0; 6];
            let Ok(()) = GroupField::velocity(&mut top, t, &inner, &mut moving);
            let (omega, v) = ([y[7], y[8], y[9]], [y[10], y[11], y[12]]);
            rate[..3].copy_from_slice(&omega);
            rate[3..6].copy_from_slice(&v);
            rate[6..9].copy_from_slice(&moving[3..]);
            rate[9..].copy_from_slice(&cross(v, omega));
        });
        let y = [&start.values[..4], &[1.0, 2.0, 3.0], &start.values[4..], &velocity].concat();
        let mut state = State::new(0.0, y).unwrap();
        MuntheKaas::new(Order::Four, h).unwrap().integrate_to(&mut body, &mut state, *t).unwrap();
        let straight: Vec<f64> = (0..3).map(|i| f64::from([1_u8, 2, 3][i]) + velocity[i] * t).collect();
        let whole = [&expected[..4], &straight, &expected[4..]].concat();
        state.values.iter().zip(&whole).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
    });
    assert_order("SE(3)", &steps, &errors, 4.0, 0.1);
    assert!(errors[4] < 1e-8, "{errors:?}");
}

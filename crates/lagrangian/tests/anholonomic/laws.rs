//! Identities of quasi-velocities.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_kinematics::EulerSequence;
use piola_lagrangian::anholonomic::{
    AnholonomicFrame, BodyAngularVelocity, ByCoframe, ByFrame, Coframe, InFrame, Nonholonomic, QuasiVelocities,
    drift_coefficients, structure_coefficients,
};
use piola_lagrangian::{Holonomic, Lagrangian, Placement, Workspace};
use piola_numerics::{Dual, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

use crate::systems::{All, Applied, Forms, Frame, Height, Inverted, Moving, System, all, body};

/// Sums of some dozens of terms, of frames whose condition number is below ten or so.
fn rounding() -> Tol {
    Tol::ulps(64.0).times(10.0)
}

/// A curved system with all kinds of forces: a particle in bent coordinates, or a top.
fn driven(top: bool) -> All {
    let system = if top { System::Top(body(1.0, [1.0, 1.5, 2.0])) } else { System::Bent(1.25) };
    all(system, [1.0, -2.0, -9.8], 3.0, Applied { constant: [0.5, -1.0, 0.75], drag: 0.25 })
}

/// A state where neither the angles nor the bent coordinates are singular.
fn state() -> impl Strategy<Value = (Vec<f64>, Vec<f64>, [f64; 9], f64, bool)> {
    let place = strategies::vector(3, -0.75..0.75).prop_map(|q| vec![q[0], q[1] + 1.25, q[2]]);
    let weights = strategies::vector(9, -0.5..0.5).prop_map(|w| core::array::from_fn(|i| w[i]));
    (place, strategies::vector(3, -2.0..2.0), weights, -1.0..1.0_f64, any::<bool>())
}

type Driven<W> = InFrame<System, Height, Applied, W>;

fn check_against_coordinates<W: QuasiVelocities>(what: &str, system: &Driven<W>, q: &[f64], u: &[f64], t: f64) {
    let v = system.velocities(q, u, t).unwrap();
    let expected = system.lagrangian().acceleration(q, v.as_slice(), t).unwrap();
    let found = system.coordinate_acceleration(q, u, t).unwrap();
    // Both are differences of terms as large as the frame's rate times u.
    let scale = 10.0 + found.amax();
    let condition = system.lagrangian().inertia_metric(q, t).unwrap().singular_values();
    let condition = condition.max() / condition.min();
    assert_close_at_scale(what, found.as_slice(), expected.as_slice(), scale, rounding().times(condition));
}

fn check_boltzmann_hamel<W: QuasiVelocities>(what: &str, system: &Driven<W>, q: &[f64], u: &[f64], t: f64) {
    let rates = system.acceleration(q, u, t).unwrap();
    let terms = system.boltzmann_hamel(q, u, rates.as_slice(), t).unwrap();
    let scale = terms.momentum_rate.amax().max(terms.lagrangian_derivative.amax()).max(terms.structure_term.amax());
    assert_close_at_scale(what, terms.residual().as_slice(), &[0.0; 3], scale, rounding());
}

/// `K^k_ij` of a Lie algebra that has the cross product as its bracket.
fn epsilon(k: usize, i: usize, j: usize) -> f64 {
    match (k, i, j) {
        (0, 1, 2) | (1, 2, 0) | (2, 0, 1) => 1.0,
        (0, 2, 1) | (1, 0, 2) | (2, 1, 0) => -1.0,
        _ => 0.0,
    }
}

fn flat(k: &[DMatrix<f64>]) -> Vec<f64> {
    k.iter().flat_map(|k| k.as_slice().to_vec()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn anholonomic_equals_holonomic_accelerations((q, u, weights, t, top) in state()) {
        let system = || driven(top);
        check_against_coordinates("frame", &system().in_frame(Frame::Random(weights)), &q, &u, t);
        check_against_coordinates("coframe", &system().in_coframe(Forms::Random(weights)), &q, &u, t);
        check_against_coordinates("moving frame", &system().in_frame(Moving(weights)), &q, &u, t);
        check_against_coordinates("moving coframe", &system().in_coframe(Moving(weights)), &q, &u, t);
    }

    #[test]
    fn production_rates_satisfy_boltzmann_hamel_equations((q, u, weights, t, top) in state()) {
        let system = || driven(top);
        check_boltzmann_hamel("frame", &system().in_frame(Frame::Random(weights)), &q, &u, t);
        check_boltzmann_hamel("coframe", &system().in_coframe(Forms::Random(weights)), &q, &u, t);
        check_boltzmann_hamel("moving frame", &system().in_frame(Moving(weights)), &q, &u, t);
        check_boltzmann_hamel("moving coframe", &system().in_coframe(Moving(weights)), &q, &u, t);
    }

    #[test]
    fn structure_coefficients_of_frame_equal_those_of_its_coframe((q, _, weights, t, _) in state()) {
        let (frame, forms) = (ByFrame(Moving(weights)), ByCoframe(Inverted(Moving(weights))));
        let (of_frame, of_forms) =
            (structure_coefficients(&frame, &q, t).unwrap(), structure_coefficients(&forms, &q, t).unwrap());
        assert_close_at_scale("K^C_AB", &flat(&of_frame), &flat(&of_forms), 1.0, rounding());
        let (of_frame, of_forms) =
            (drift_coefficients(&frame, &q, t).unwrap(), drift_coefficients(&forms, &q, t).unwrap());
        assert_close_at_scale("K^C_A0", of_frame.as_slice(), of_forms.as_slice(), 1.0, rounding());
        for k in structure_coefficients(&frame, &q, t).unwrap() {
            prop_assert_eq!(k.transpose(), -k);
        }
    }

    #[test]
    fn bracket_equals_structure_coefficients_times_frame((q, _, weights, _, _) in state()) {
        // [k_A, k_B]f = k_A(k_B f) − k_B(k_A f) for f = q^D, with nested dual numbers.
        let frame = Frame::Random(weights);
        let matrix = driven(false).in_frame(frame).frame_matrix(&q, 0.0).unwrap();
        let k = structure_coefficients(&ByFrame(frame), &q, 0.0).unwrap();
        for a in 0..3 {
            for b in 0..3 {
                let along = |x: usize, y: usize| -> Vec<f64> {
                    let moving: Vec<Dual<f64>> = (0..3).map(|c| Dual::new(q[c], matrix[(x, c)])).collect();
                    let mut rows = [Dual::constant(0.0); 9];
                    ByFrame(frame).matrix(&moving, Dual::constant(0.0), &mut rows);
                    (0..3).map(|d| rows[3 * y + d].tangent).collect()
                };
                let (ab, ba) = (along(a, b), along(b, a));
                let bracket: Vec<f64> = ab.iter().zip(&ba).map(|(x, y)| x - y).collect();
                let sum: Vec<f64> = (0..3).map(|d| (0..3).map(|c| k[c][(a, b)] * matrix[(c, d)]).sum()).collect();
                assert_close_at_scale("[k_A, k_B]", &sum, &bracket, 1.0, rounding());
            }
        }
    }

    #[test]
    fn bracket_with_drift_and_time_equals_drift_coefficients_times_frame((q, _, weights, t, _) in state()) {
        // [k_A, ∂_t + d]f = k_A(d f) − (∂_t + d)(k_A f) for f = q^D, with dual numbers along k_A and along ∂_t + d.
        let moving = Moving(weights);
        let along = |direction: &[f64], rate: f64| {
            let q: Vec<Dual<f64>> = q.iter().zip(direction).map(|(&q, &v)| Dual::new(q, v)).collect();
            let (mut rows, mut drift) = ([Dual::constant(0.0); 9], [Dual::constant(0.0); 3]);
            AnholonomicFrame::frame(&moving, &q, Dual::new(t, rate), &mut rows);
            AnholonomicFrame::drift(&moving, &q, Dual::new(t, rate), &mut drift);
            (rows, drift)
        };
        let (rows, drift) = along(&[0.0; 3], 0.0);
        let (rows, drift) = (rows.map(|x| x.value), drift.map(|x| x.value));
        let k = drift_coefficients(&ByFrame(moving), &q, t).unwrap();
        let carried = along(&drift, 1.0).0;
        for a in 0..3 {
            let slipped = along(&rows[3 * a..3 * a + 3], 0.0).1;
            let bracket: Vec<f64> = (0..3).map(|d| slipped[d].tangent - carried[3 * a + d].tangent).collect();
            let sum: Vec<f64> = (0..3).map(|d| (0..3).map(|c| k[(c, a)] * rows[3 * c + d]).sum()).collect();
            assert_close_at_scale("[k_A, ∂_t + d]", &sum, &bracket, 1.0, rounding());
        }
    }

    #[test]
    fn structure_coefficients_satisfy_jacobi_identity((q, _, weights, _, _) in state()) {
        // Cyclic sum of k_A(K^D_BC) + K^D_AE K^E_BC.
        let map = ByFrame(Frame::Random(weights));
        let matrix = driven(false).in_frame(map.0).frame_matrix(&q, 0.0).unwrap();
        let k: Vec<Vec<DMatrix<Dual<f64>>>> = (0..3)
            .map(|a| {
                let moving: Vec<Dual<f64>> = (0..3).map(|c| Dual::new(q[c], matrix[(a, c)])).collect();
                structure_coefficients(&map, &moving, Dual::constant(0.0)).unwrap()
            })
            .collect();
        for d in 0..3 {
            let term = |a: usize, b: usize, c: usize| -> f64 {
                let products: f64 = (0..3).map(|e| k[0][d][(a, e)].value * k[0][e][(b, c)].value).sum();
                k[a][d][(b, c)].tangent + products
            };
            let sum = term(0, 1, 2) + term(1, 2, 0) + term(2, 0, 1);
            assert_close_at_scale("Jacobi identity", &[sum], &[0.0], 1.0, rounding());
        }
    }

    #[test]
    fn rates_of_functions_have_no_structure_coefficients((q, _, _, _, _) in state()) {
        let k = structure_coefficients(&ByCoframe(Forms::Rates), &q, 0.0).unwrap();
        assert_close_at_scale("K", &flat(&k), &[0.0; 27], 1.0, rounding());
    }

    #[test]
    fn curl_of_rate_matrix_equals_permutation_symbol((q, _, _, _, _) in state()) {
        for sequence in EulerSequence::ALL {
            // Away from the gimbal points of either kind: θ² near 0.6 or so.
            let theta = [q[0], 0.7 + 0.2 * q[2], q[2]];
            let k = structure_coefficients(&ByCoframe(BodyAngularVelocity { sequence }), &theta, 0.0).unwrap();
            let expected: Vec<f64> =
                (0..27).map(|n| epsilon(n / 9, n % 3, n / 3 % 3)).collect();
            assert_close(&format!("{sequence:?}"), &flat(&k), &expected, rounding());
        }
    }

    #[test]
    fn anholonomic_form_on_rotations_equals_euler_equations(
        (q, u, _, _, _) in state(),
        moments in strategies::positive_definite(1.0..1.9),
    ) {
        let inertia = Matrix3::from_fn(|i, j| moments[i][j]);
        let top = piola_kinematics::RigidBody::new(3.0, piola_kinematics::Inertia::new(inertia).unwrap()).unwrap();
        let free = all(System::Top(top), [0.0; 3], 0.0, Applied { constant: [0.0; 3], drag: 0.0 });
        let spin = free.in_coframe(Forms::Body(BodyAngularVelocity::default()));
        let rates = spin.acceleration(&q, &u, 0.0).unwrap();
        let omega = Vector3::new(u[0], u[1], u[2]);
        let euler = -omega.cross(&(inertia * omega));
        let found = inertia * Vector3::new(rates[0], rates[1], rates[2]);
        let condition = 1.0 / q[1].sin().powi(2);
        assert_close_at_scale("I ω̇", found.as_slice(), euler.as_slice(), 4.0, rounding().times(condition));
    }

    #[test]
    fn reactions_do_no_virtual_work_and_equal_multipliers(
        (q, u, weights, t, top) in state(),
        held in proptest::sample::subsequence(vec![0_usize, 1, 2], 1..3),
    ) {
        check_reactions(driven(top).in_frame(Moving(weights)), &q, &u, t, &held);
        check_reactions(driven(top).in_coframe(Moving(weights)), &q, &u, t, &held);
    }

    #[test]
    fn locked_coordinate_rate_equals_system_with_one_coordinate_less((q, u, _, _, _) in state()) {
        // The plane pendulum of two rods, its elbow locked at q₁, is one body.
        let rates = u[0];
        let constrained = Lagrangian::of(Elbow { angle: None }).with_gravity(9.8).in_coframe(Own(2)).holding(&[1]).unwrap();
        let single = Lagrangian::of(Elbow { angle: Some(q[1]) }).with_gravity(9.8);
        let found = constrained.acceleration(&q[..2], &[rates], 0.0).unwrap();
        let expected = single.acceleration(&q[..1], &[rates], 0.0).unwrap();
        assert_close_at_scale("locked elbow", found.as_slice(), expected.as_slice(), 10.0, rounding());
    }
}

/// A planar pendulum with an elbow, free or at a fixed angle.
struct Elbow {
    angle: Option<f64>,
}

impl Holonomic for Elbow {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let bend = self.angle.map_or_else(|| q[1], T::lit);
        let ((s, c), (far_s, far_c)) = (q[0].sin_cos(), (q[0] + bend).sin_cos());
        bodies.particle(1.0, Vector3::new(s, T::zero(), -c));
        bodies.particle(0.5, Vector3::new(s + far_s, T::zero(), -c - far_c));
    }
}

/// The coordinates' own rates.
struct Own(usize);

impl Coframe for Own {
    fn coframe<T: Real>(&self, _q: &[T], _t: T, rows: &mut [T]) {
        rows.fill(T::zero());
        rows.iter_mut().step_by(self.0 + 1).for_each(|diagonal| *diagonal = T::one());
    }
}

/// No work along the free vectors; the same motion as with multipliers, M q̈ − Aᵀ λ = f, A q̈ = −Ȧ q̇ − ȧ.
fn check_reactions<W: QuasiVelocities>(system: Driven<W>, q: &[f64], u: &[f64], t: f64, held: &[usize]) {
    let values: Vec<(usize, f64)> = held.iter().map(|&h| (h, u[h])).collect();
    let w: Vec<f64> = (0..3).filter(|a| !held.contains(a)).map(|a| u[a]).collect();
    let frame = system.frame_matrix(q, t).unwrap();
    let coframe = system.coframe_matrix(q, t).unwrap();
    let v = system.velocities(q, u, t).unwrap();
    // The rates of all u at q̈ = 0 are Ȧ q̇ + ȧ: u over coordinates that move.
    let moving = |x: &[f64], rate: &[f64]| -> Vec<Dual<f64>> {
        x.iter().zip(rate).map(|(&x, &rate)| Dual::new(x, rate)).collect()
    };
    let at_rest = moving(v.as_slice(), &[0.0; 3]);
    let change = system.quasi_velocities(&moving(q, v.as_slice()), &at_rest, Dual::variable(t)).unwrap();

    let (mut mass_matrix, mut forcing) = ([0.0; 9], [0.0; 3]);
    let mut work = Workspace::default();
    let lagrangian = system.lagrangian();
    lagrangian.equations_into(&mut work, q, v.as_slice(), t, &mut mass_matrix, &mut forcing).unwrap();
    let m = held.len();
    let mut matrix = DMatrix::zeros(3 + m, 3 + m);
    let mut right = DVector::zeros(3 + m);
    for i in 0..3 {
        right[i] = forcing[i];
        for j in 0..3 {
            matrix[(i, j)] = mass_matrix[i + 3 * j];
        }
        for (h, &held) in held.iter().enumerate() {
            matrix[(i, 3 + h)] = -coframe[(held, i)];
            matrix[(3 + h, i)] = coframe[(held, i)];
            right[3 + h] = -change[held].tangent;
        }
    }
    let condition = mass_matrix.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    let solution = matrix.lu().solve(&right).unwrap();
    let scale = 10.0 + solution.amax();
    let tolerance = rounding().times(10.0 * condition);

    let constrained: Nonholonomic<_, _, _, _> = system.holding_at(&values).unwrap();
    let rates = constrained.acceleration(q, &w, t).unwrap();
    let reactions = constrained.reactions(q, &w, t).unwrap();
    assert_close_at_scale("λ", reactions.as_slice(), &solution.as_slice()[3..], scale, tolerance);
    let accelerations = constrained.coordinate_acceleration(q, &w, t).unwrap();
    assert_close_at_scale("q̈", accelerations.as_slice(), &solution.as_slice()[..3], scale, tolerance);
    let works = frame * constrained.coordinate_reactions(q, &w, t).unwrap();
    let mut of_held = reactions.iter();
    for a in 0..3 {
        let expected = if held.contains(&a) { *of_held.next().unwrap() } else { 0.0 };
        assert_close_at_scale("k_A·R", &[works[a]], &[expected], scale, tolerance);
    }
    let full = constrained.quasi_velocities(q, &w).unwrap();
    assert_eq!(full.as_slice(), u);

    // The Boltzmann–Hamel equations of the vectors that are held leave the reactions over.
    let mut all_rates = [0.0; 3];
    for (a, &rate) in (0..3).filter(|a| !held.contains(a)).zip(rates.iter()) {
        all_rates[a] = rate;
    }
    let left = constrained.unconstrained().boltzmann_hamel(q, u, &all_rates, t).unwrap().residual();
    assert_close_at_scale("left over", left.as_slice(), works.as_slice(), scale, tolerance);

    // Energy changes at the power of applied forces and of reactions, which is not zero where what is held moves.
    let moved = (moving(q, v.as_slice()), moving(v.as_slice(), accelerations.as_slice()));
    let lagrangian = constrained.unconstrained().lagrangian();
    let rate = lagrangian.energies(&moved.0, &moved.1, Dual::constant(t)).unwrap().total().tangent;
    let applied = lagrangian.generalised_forces(q, v.as_slice(), t).unwrap();
    let power = v.dot(&(applied + constrained.coordinate_reactions(q, &w, t).unwrap()));
    assert_close_at_scale("power", &[rate], &[power], scale * (1.0 + v.amax()), tolerance);
}

#[test]
fn motion_in_quasi_velocities_equals_motion_in_velocities() {
    let spin = driven(true).in_coframe(Forms::Body(BodyAngularVelocity::default()));
    let (q, u) = ([0.25, 1.0, -0.5], [1.0, -0.5, 2.0]);
    let v = spin.velocities(&q, &u, 0.0).unwrap();
    let mut method = DormandPrince853::new(Tolerance::relative(1e-13).unwrap());
    let mut in_quasi = State::new(0.0, [q, u].concat()).unwrap();
    method.integrate_to(&mut spin.motion(3), &mut in_quasi, 1.0).unwrap();
    let mut in_rates = State::new(0.0, [&q[..], v.as_slice()].concat()).unwrap();
    method.integrate_to(&mut spin.lagrangian().motion(3), &mut in_rates, 1.0).unwrap();
    let tolerance = Tol::stated(1e-11, "hundred times the tolerance of a step");
    assert_close("angles", &in_quasi.values[..3], &in_rates.values[..3], tolerance);
    let end = spin.velocities(&in_quasi.values[..3], &in_quasi.values[3..], 1.0).unwrap();
    assert_close("rates", end.as_slice(), &in_rates.values[3..], tolerance);
}

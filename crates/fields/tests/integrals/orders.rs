//! Convergence: of rules with their degree and the size of elements, of elements, of explicit motion.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{Deformation, DisplacementGradient, FirstPiola};
use piola_fields::Motion;
use piola_fields::integral::{
    AdaptiveQuadrature, Ball, Cuboid, EstimatedQuadrature, ExplicitMotion, LinearTetrahedra, MaterialPoint,
    MovedRegion, QuadraticTetrahedra, Quadrature, TetrahedralElements, TetrahedralMesh,
};
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Dual, Gradient, Real};
use piola_testkit::{Tol, assert_close, assert_order};

use super::manufactured::SaintVenant;
use super::weak::{patch, stress};

#[test]
fn errors_of_mesh_rules_fall_with_the_size_of_elements() {
    let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a box");
    let exact = 1.0_f64.exp_m1().powi(3);
    // Odd powers cancel by symmetry on such meshes only for odd degrees: h^(d+1) for odd d, h^(d+2) for even d ≥ 2.
    for (degree, order) in [(0, 2.0), (2, 4.0), (4, 6.0)] {
        let rules = Quadrature::of_degree(degree).expect("rules");
        let (mut steps, mut errors) = (Vec::new(), Vec::new());
        for cells in [2_u8, 4, 8] {
            let mesh = TetrahedralMesh::of_cuboid(&unit, [usize::from(cells); 3]).expect("a mesh");
            let found = rules.volume_integral(&mesh, |x: &Vector3<f64>| x.sum().exp()).expect("finite");
            steps.push(1.0 / f64::from(cells));
            errors.push((found - exact).abs());
        }
        assert_order("rule", &steps, &errors, order, 0.35);
    }
}

#[test]
fn estimates_bound_errors_and_both_fall_exponentially() {
    let ball = Ball::new(Vector3::zeros(), 1.0).expect("a ball");
    let exact = 4.0 * core::f64::consts::PI * (2.0_f64.cosh() / 4.0 - 2.0_f64.sinh() / 8.0);
    let mut last = f64::INFINITY;
    for degree in [2, 6, 10, 14] {
        let rules = EstimatedQuadrature::of_degree(degree).expect("rules");
        let found = rules.volume_integral(&ball, |x: &Vector3<f64>| (2.0 * x.x).exp()).expect("finite");
        let error = (found.value - exact).abs();
        let rounding = Tol::ulps(8.0).times(exact).value();
        assert!(error <= found.error + rounding && found.error < 0.02 * last, "{found:?} {error:e}");
        last = found.error;
    }
}

#[test]
fn adaptive_volume_of_a_bent_ball_equals_that_of_an_isochoric_motion() {
    /// x = (X, Y + sin X, Z + e^Y): det F = 1.
    struct Bend;
    impl Motion for Bend {
        fn place<T: Real>(&self, x: &Vector3<T>, time: T) -> Vector3<T> {
            Vector3::new(x.x, x.y + (x.x * time).sin(), x.z + x.y.exp())
        }
    }
    let ball = Ball::new(Vector3::zeros(), 1.0).expect("a ball");
    let rules = AdaptiveQuadrature::up_to_degree(80).expect("rules");
    let moved = MovedRegion { region: &ball, motion: &Bend, time: 2.0 };
    // The flux of the place through the deformed surface is three times the volume.
    let flux = rules.surface_integral(&moved, 1e-13, |point| point.position.dot(&point.normal)).expect("converged");
    let volume = 4.0 / 3.0 * core::f64::consts::PI;
    assert_close("volume", &[flux.value / 3.0], &[volume], Tol::stated(1e-13, "the tolerance asked for"));
    assert!(flux.degree < 80);
}

/// u = (sin 2x sin y, cos x sin 2z, sin(x + y + z)) / 100: not a polynomial, not divergence free.
fn exact<T: Real>(x: &Vector3<T>) -> Vector3<T> {
    let two = T::lit(2.0);
    let u = [(two * x.x).sin() * x.y.sin(), x.x.cos() * (two * x.z).sin(), (x.x + x.y + x.z).sin()];
    Vector3::from(u.map(|u| u * T::lit(0.01)))
}

fn exact_gradient<T: Real>(x: &Vector3<T>) -> Matrix3<T> {
    let u = exact(&Vector3::from_fn(|i, _| Gradient::<T, 3>::variable(x[i], i)));
    Matrix3::from_fn(|i, j| u[i].partials[j])
}

const LAMBDA: f64 = 1.5;
const MU: f64 = 1.0;

/// P = λ tr ε 1 + 2 μ ε.
fn linear_stress<T: Real>(gradient: &Matrix3<T>) -> Matrix3<T> {
    let pressure = T::lit(LAMBDA) * (gradient[(0, 0)] + gradient[(1, 1)] + gradient[(2, 2)]);
    Matrix3::from_fn(|i, j| {
        let shear = T::lit(MU) * (gradient[(i, j)] + gradient[(j, i)]);
        if i == j { shear + pressure } else { shear }
    })
}

/// −Div P of the exact displacement.
fn balancing_force(x: &Vector3<f64>) -> Vector3<f64> {
    let x = Vector3::from_fn(|i, _| Gradient::<f64, 3>::variable(x[i], i));
    -super::manufactured::divergence(&linear_stress(&exact_gradient(&x)))
}

/// The equilibrium displacement with the exact one on the boundary, by conjugate gradients with tangents from duals.
fn equilibrium<const N: usize>(body: &TetrahedralElements<N>) -> Vec<f64> {
    let on_boundary = |x: &Vector3<f64>| x.iter().any(|&x| x <= 0.0 || 1.0 <= x);
    let is_free: Vec<bool> = body.nodes().iter().flat_map(|x| [!on_boundary(x); 3]).collect();
    let law = |_: &MaterialPoint, gradient: &DisplacementGradient<Dual<f64>>| {
        Ok(FirstPiola(linear_stress(&piola_numerics::linear::matrix3::from_rows(gradient.displacement_rows()))))
    };
    let product = |direction: &[f64]| -> Vec<f64> {
        let along: Vec<_> = direction.iter().map(|&v| Dual::new(0.0, v)).collect();
        let mut forces = vec![Dual::lit(0.0); body.components()];
        body.add_stress_forces(&along, law, &mut forces).expect("regular");
        forces.iter().zip(&is_free).map(|(f, &free)| if free { -f.tangent } else { 0.0 }).collect()
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut u = vec![0.0; body.components()];
    body.sample_into(exact, &mut u).expect("lengths");
    for (u, &free) in u.iter_mut().zip(&is_free) {
        if free {
            *u = 0.0;
        }
    }
    let mut load = vec![0.0; body.components()];
    body.add_forces_per_volume(|point| balancing_force(&point.position), &mut load).expect("lengths");
    let held = product(&u);
    let mut residual: Vec<f64> = (0..u.len()).map(|k| if is_free[k] { load[k] - held[k] } else { 0.0 }).collect();
    let mut direction = residual.clone();
    let (start, mut square) = (dot(&residual, &residual), dot(&residual, &residual));
    while Tol::ulps(1.0).value() * Tol::ulps(1.0).value() * start < square {
        let image = product(&direction);
        let step = square / dot(&direction, &image);
        for k in 0..u.len() {
            u[k] += step * direction[k];
            residual[k] -= step * image[k];
        }
        let next = dot(&residual, &residual);
        for k in 0..u.len() {
            direction[k] = residual[k] + next / square * direction[k];
        }
        square = next;
    }
    u
}

/// `(‖u_h − u‖, ‖∇u_h − ∇u‖)`.
fn errors<const N: usize>(body: &TetrahedralElements<N>, u: &[f64]) -> (f64, f64) {
    let squares = body.integral(u, |point: &MaterialPoint, u: &Vector3<f64>, gradient: &Matrix3<f64>| {
        let slope = gradient - exact_gradient(&point.position);
        Ok([(u - exact(&point.position)).norm_squared(), slope.norm_squared()])
    });
    let [value, slope] = squares.expect("finite");
    (value.sqrt(), slope.sqrt())
}

#[test]
fn errors_of_equilibrium_fall_as_the_shape_functions_say() {
    // The same shape of mesh at every size: unskewed cells.
    let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a box");
    let mesh = |cells: usize| TetrahedralMesh::of_cuboid(&unit, [cells; 3]).expect("a mesh");
    let (mut values, mut slopes) = (Vec::new(), Vec::new());
    for cells in [2, 4, 8] {
        let body = LinearTetrahedra::new(mesh(cells), 4).expect("a body");
        let (value, slope) = errors(&body, &equilibrium(&body));
        values.push(value);
        slopes.push(slope);
    }
    assert_order("linear, u", &[4.0, 2.0, 1.0], &values, 2.0, 0.15);
    assert_order("linear, ∇u", &[4.0, 2.0, 1.0], &slopes, 1.0, 0.1);
    values.clear();
    slopes.clear();
    for cells in [1, 2, 4] {
        let body = QuadraticTetrahedra::new(mesh(cells), 4).expect("a body");
        let (value, slope) = errors(&body, &equilibrium(&body));
        values.push(value);
        slopes.push(slope);
    }
    assert_order("quadratic, u", &[4.0, 2.0, 1.0], &values, 3.0, 0.2);
    assert_order("quadratic, ∇u", &[4.0, 2.0, 1.0], &slopes, 2.0, 0.15);
}

/// A free block, stretched and let go: (energies over the run, displacement at the end, energy taken by damping).
fn vibrate(steps: u32, damping: f64) -> (Vec<f64>, Vec<f64>, f64) {
    let body = LinearTetrahedra::new(patch(2), 1).expect("a body");
    let energy = SaintVenant { lambda: 1.0, mu: 1.0 };
    let mut masses = vec![0.0; body.nodes().len()];
    body.lumped_mass_into(|_| 1.0, &mut masses).expect("positive");
    let coefficients: Vec<f64> = masses.iter().map(|mass| damping * mass).collect();
    let mut motion = ExplicitMotion::new(&masses, &coefficients).expect("masses");
    let mut velocity = vec![0.0; body.components()];
    body.sample_into(|x| Vector3::new(0.1 * x.x, -0.05 * x.y, 0.1 * x.x * x.z), &mut velocity).expect("lengths");
    motion.set_state(0.0, &vec![0.0; velocity.len()], &velocity).expect("finite");
    let law = stress(energy);
    let stored = |u: &[f64]| {
        body.strain_energy(u, |point, gradient: &DisplacementGradient| {
            use piola_fields::integral::StoredEnergy;
            let f = Matrix3::from_fn(|i, j| gradient.gradient_rows()[i][j]);
            Ok(energy.density(&point.position, &f))
        })
        .expect("regular")
    };
    let step = 1.0 / f64::from(steps);
    let mut energies = vec![motion.kinetic_energy()];
    let mut taken = 0.5 * step * motion.dissipation();
    for number in 1..=steps {
        motion.step(step, |_, u, forces| body.add_stress_forces(u, &law, forces)).expect("regular");
        energies.push(motion.kinetic_energy() + stored(motion.displacement()));
        taken += step * motion.dissipation() * if number == steps { 0.5 } else { 1.0 };
    }
    (energies, motion.displacement().to_vec(), taken)
}

#[test]
fn energy_of_a_vibrating_block_stays_to_second_order() {
    let (mut steps, mut changes) = (Vec::new(), Vec::new());
    for count in [40, 80, 160] {
        let (energies, ..) = vibrate(count, 0.0);
        let change = energies.iter().map(|energy| (energy - energies[0]).abs()).fold(0.0, f64::max);
        steps.push(1.0 / f64::from(count));
        changes.push(change / energies[0]);
    }
    assert!(changes[2] < Tol::stated(1e-4, "(ω h)² with ω h ≈ 0.1").value(), "{changes:?}");
    assert_order("energy", &steps, &changes, 2.0, 0.1);
}

#[test]
fn energy_lost_by_a_damped_block_equals_what_the_damping_takes() {
    let (mut steps, mut errors) = (Vec::new(), Vec::new());
    for count in [40, 80, 160] {
        let (energies, _, taken) = vibrate(count, 1.0);
        let lost = energies[0] - energies[energies.len() - 1];
        assert!(0.2 * energies[0] < lost);
        steps.push(1.0 / f64::from(count));
        errors.push((lost - taken).abs());
    }
    assert_order("lost energy", &steps, &errors, 2.0, 0.2);
}

#[test]
fn explicit_motion_converges_with_second_order() {
    let (_, reference, _) = vibrate(1280, 0.5);
    let (mut steps, mut errors) = (Vec::new(), Vec::new());
    for count in [40, 80, 160] {
        let (_, found, _) = vibrate(count, 0.5);
        steps.push(1.0 / f64::from(count));
        errors.push(found.iter().zip(&reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max));
    }
    assert_order("displacement", &steps, &errors, 2.0, 0.1);
}

#[test]
fn damped_oscillator_equals_its_closed_form_to_second_order() {
    // ü + 0.4 u̇ + u = 0 from u = 1 at rest.
    let (mut steps, mut errors) = (Vec::new(), Vec::new());
    for count in [100_u32, 200, 400] {
        let step = 3.0 / f64::from(count);
        let mut motion = ExplicitMotion::new(&[2.0], &[0.8]).expect("a node");
        motion.set_state(0.0, &[0.0, 1.0, 0.0], &[0.0; 3]).expect("finite");
        let spring = |_: f64, u: &[f64], forces: &mut [f64]| {
            forces[1] -= 2.0 * u[1];
            Ok(())
        };
        for _ in 0..count {
            motion.step(step, spring).expect("finite");
        }
        let frequency = (1.0_f64 - 0.04).sqrt();
        let (s, c) = (3.0 * frequency).sin_cos();
        let exact = (-0.6_f64).exp() * (c + 0.2 / frequency * s);
        let rate = -(-0.6_f64).exp() * s / frequency;
        steps.push(step);
        errors.push((motion.displacement()[1] - exact).abs().max((motion.velocity()[1] - rate).abs()));
        // The accelerations for any other integrator are those of the equation.
        let mut acceleration = [0.0; 3];
        motion.accelerations_into(0.0, &[0.0, 1.0, 0.0], &[0.0, 5.0, 0.0], spring, &mut acceleration).expect("ok");
        assert_close("acceleration", &acceleration, &[0.0, -3.0, 0.0], Tol::ulps(1.0));
    }
    assert_order("oscillator", &steps, &errors, 2.0, 0.05);
}

#[test]
fn deformation_at_the_points_of_elements_converges_to_the_motion() {
    // Interpolated gradients are first order for linear elements: the constant is the second gradient's.
    let (mut steps, mut errors) = (Vec::new(), Vec::new());
    for cells in [2_u8, 4, 8] {
        let body = LinearTetrahedra::new(patch(usize::from(cells)), 1).expect("a body");
        let mut u = vec![0.0; body.components()];
        body.sample_into(exact, &mut u).expect("lengths");
        let worst = body
            .integral(&u, |point: &MaterialPoint, _: &Vector3<f64>, gradient: &Matrix3<f64>| {
                let difference = rows_of(&(gradient - exact_gradient(&point.position)));
                Ok(difference.as_flattened().iter().map(|x| x * x).sum::<f64>())
            })
            .expect("finite");
        steps.push(1.0 / f64::from(cells));
        errors.push(worst.sqrt());
    }
    assert_order("gradient", &steps, &errors, 1.0, 0.15);
}

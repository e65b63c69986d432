//! Balances at points: manufactured motions and exact solutions leave nothing but rounding.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{CauchyStress, FirstPiola, Symmetric};
use piola_fields::balance::{cofactor_divergence, piola_identity_residual};
use piola_fields::{
    AffineHistory, Body, Cartesian, Coordinates, Cylindrical, Field, Flow, Homogeneous, Material, Motion, Spatial,
    Spherical, Uniform, equilibrium_residual, symmetry_residual,
};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::fixtures::{ByHand, Column, Physical, Stress, Tensor, point, tensor, wave};

/// A tensor as a first Piola–Kirchhoff stress.
#[derive(Clone, Copy)]
struct MaterialStress(Tensor);

impl Field for MaterialStress {
    type Value = FirstPiola;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> FirstPiola<T> {
        FirstPiola(self.0.at(place, time))
    }
}

/// det of a 3×3 matrix by Sarrus.
fn determinant(f: &Matrix3<f64>) -> f64 {
    let plus =
        f[(0, 0)] * f[(1, 1)] * f[(2, 2)] + f[(0, 1)] * f[(1, 2)] * f[(2, 0)] + f[(0, 2)] * f[(1, 0)] * f[(2, 1)];
    let minus =
        f[(0, 2)] * f[(1, 1)] * f[(2, 0)] + f[(0, 0)] * f[(1, 2)] * f[(2, 1)] + f[(0, 1)] * f[(1, 0)] * f[(2, 2)];
    plus - minus
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn momentum_of_a_manufactured_motion_leaves_nothing(
        motion in wave(), x in point(), t in -2.0..2.0_f64, f in tensor(), rho in 0.5..4.0_f64
    ) {
        let body = Body { motion, reference_density: Uniform(rho) };
        let ((u, h), (v, _), (a, _)) = (motion.by_hand(&x, t, 0), motion.by_hand(&x, t, 1), motion.by_hand(&x, t, 2));
        let jacobian = determinant(&(Matrix3::identity() + h));
        let tol = Tol::ulps(32.0).value();

        // b = a − div T/ρ with ρ = ρ_κ/J, W(17.12), everything by hand.
        let place = x + u;
        let spatial_force = a - Stress(f).divergence(&place, t) * (jacobian / rho);
        let residual =
            body.spatial_momentum_residual(&Spatial(Stress(f)), &Spatial(Uniform(spatial_force)), &x, t)?;
        prop_assert!(residual.relative() <= tol, "{residual:?}");
        prop_assert!((body.density(&x, t)? - rho / jacobian).abs() <= 32.0 * f64::EPSILON * rho / jacobian);

        // b = a − Div P/ρ_κ, W(17.29), B(4.54).
        let force = a - f.divergence(&x, t) / rho;
        let residual = body.momentum_residual(&Material(MaterialStress(f)), &Material(Uniform(force)), &x, t)?;
        prop_assert!(residual.relative() <= tol, "{residual:?}");

        // f = ρ_κ ü + c u̇ − Div P, B(4.58).
        let force = a * rho + v * 0.7 - f.divergence(&x, t);
        let (stress, damping) = (Material(MaterialStress(f)), Material(Uniform(0.7)));
        let residual = body.damped_residual(&stress, &Material(Uniform(force)), &damping, &x, t)?;
        prop_assert!(residual.relative() <= tol, "{residual:?}");

        // f = −Div P, B(4.59).
        let force = Material(Uniform(-f.divergence(&x, t)));
        prop_assert!(body.equilibrium_residual(&stress, &force, &x, t)?.relative() <= tol);
        prop_assert!(equilibrium_residual(&Cartesian, &MaterialStress(f), &force.0, &x, t)?.relative() <= tol);
    }

    #[test]
    fn divergence_of_piola_stress_equals_volume_ratio_times_that_of_cauchy_stress(
        motion in wave(), x in point(), t in -2.0..2.0_f64, f in tensor()
    ) {
        let residual = piola_identity_residual(&motion, &Spatial(Stress(f)), &x, t)?;
        prop_assert!(residual.relative() <= Tol::ulps(64.0).value(), "{residual:?}");
        let cofactor = cofactor_divergence(&motion, &x, t)?;
        prop_assert!(cofactor.relative() <= Tol::ulps(16.0).value(), "{cofactor:?}");
        // J div T by hand is not zero: the identity says something.
        prop_assert!(residual.scale.amax() > 0.1 * Stress(f).divergence(&motion.place(&x, t), t).amax());
    }

    #[test]
    fn piola_stress_of_a_symmetric_stress_leaves_no_moment(
        motion in wave(), x in point(), t in -2.0..2.0_f64, f in tensor()
    ) {
        let deformation = motion.deformation_gradient(&x, t)?;
        let stress = Stress(f).at(&motion.place(&x, t), t);
        let piola = stress.first_piola(&deformation);
        let body = Body { motion, reference_density: Uniform(1.0) };
        let residual = body.symmetry_residual(&Material(Uniform(piola)), &x, t)?;
        prop_assert!(residual.relative() <= Tol::ulps(16.0).value(), "{residual:?}");
        let bare = piola.moment_residual(&deformation);
        assert_close_at_scale("P Fᵀ − F Pᵀ", residual.value.as_slice(), bare.as_slice(), residual.scale.amax(), Tol::ulps(8.0));
        prop_assert!(symmetry_residual(&stress.matrix()).value == Vector3::zeros());
    }

    #[test]
    fn spatial_momentum_equals_cartesian_momentum_in_every_system(
        f in tensor(), g in tensor(), q in [0.3..2.0_f64, -3.0..3.0, 0.2..2.9], t in -1.0..1.0_f64, rho in 0.5..4.0_f64
    ) {
        check_flow(Cylindrical, f, g, &Vector3::from(q), t, rho)?;
        check_flow(Spherical, f, g, &Vector3::from(q), t, rho)?;
        check_flow(Cartesian, f, g, &Vector3::from(q), t, rho)?;
    }
}

/// b = ∂v/∂t + (grad v) v − div T/ρ by hand in Cartesian components, turned into those of the system.
fn check_flow<C: ByHand>(
    system: C,
    f: Tensor,
    g: Tensor,
    q: &Vector3<f64>,
    t: f64,
    rho: f64,
) -> Result<(), TestCaseError> {
    let (x, e) = (system.place(q), system.directions(q));
    let velocity = Column(g);
    let v = velocity.at(&x, t);
    // vᵢ = c (xᵢ x₀ + sin(xᵢ + t)) + …, whose rate is c cos(xᵢ + t).
    let local = Vector3::from_fn(|i, _| g.coefficients[3 * i] * (x[i] + t).cos());
    let slopes = Matrix3::from_fn(|i, j| g.slope(&x, t, i, 0, j));
    let acceleration = local + slopes * v;
    let force = acceleration - Stress(f).divergence(&x, t) / rho;
    let flow = Flow { coordinates: system, density: Uniform(rho), velocity: Physical { system, field: velocity } };
    let stress = Physical { system, field: Stress(f) };
    let residual = flow.momentum_residual(&stress, &Uniform(e * force), q, t)?;
    prop_assert!(residual.relative() <= Tol::ulps(64.0).value(), "{residual:?}");
    let there = e.transpose() * flow.acceleration(q, t)?;
    let scale = residual.scale.amax() / rho;
    assert_close_at_scale("a", there.as_slice(), acceleration.as_slice(), scale, Tol::ulps(64.0));
    // ρ̇ + ρ div v of a uniform steady density.
    let continuity = flow.continuity_residual(q, t)?;
    assert_close_at_scale("ρ div v", &[continuity.value], &[rho * slopes.trace()], continuity.scale, Tol::ulps(64.0));
    Ok(())
}

/// A gas that expands as x = (1 + kt) X, with p = A ρ^γ and ε = A ρ^(γ−1)/(γ − 1).
#[derive(Clone, Copy, Debug)]
struct Gas {
    rate: f64,
    density: f64,
    constant: f64,
    exponent: f64,
}

impl Gas {
    fn stretch<T: Real>(&self, time: T) -> T {
        T::one() + T::lit(self.rate) * time
    }
    fn density<T: Real>(&self, time: T) -> T {
        T::lit(self.density) / self.stretch(time).powi(3)
    }
    fn pressure<T: Real>(&self, time: T) -> T {
        T::lit(self.constant) * self.density(time).powf(T::lit(self.exponent))
    }
}

impl AffineHistory for Gas {
    fn gradient<T: Real>(&self, time: T) -> Matrix3<T> {
        Matrix3::from_diagonal(&Vector3::repeat(self.stretch(time)))
    }
}

/// ρ(t) of the gas.
struct Density(Gas);
impl Field for Density {
    type Value = f64;
    fn at<T: Real>(&self, _place: &Vector3<T>, time: T) -> T {
        self.0.density(time)
    }
}

/// ε(t) of the gas.
struct Energy(Gas);
impl Field for Energy {
    type Value = f64;
    fn at<T: Real>(&self, _place: &Vector3<T>, time: T) -> T {
        self.0.pressure(time) / (self.0.density(time) * T::lit(self.0.exponent - 1.0))
    }
}

/// −p 1.
struct Pressure(Gas);
impl Field for Pressure {
    type Value = CauchyStress;
    fn at<T: Real>(&self, _place: &Vector3<T>, time: T) -> CauchyStress<T> {
        CauchyStress(Symmetric::diagonal([-self.0.pressure(time); 3]))
    }
}

/// P = J T F⁻ᵀ of the gas.
struct MaterialPressure(Gas);
impl Field for MaterialPressure {
    type Value = FirstPiola;
    fn at<T: Real>(&self, _place: &Vector3<T>, time: T) -> FirstPiola<T> {
        let stretch = self.0.stretch(time);
        FirstPiola(Matrix3::from_diagonal(&Vector3::repeat(-self.0.pressure(time) * stretch * stretch)))
    }
}

/// v = k x/(1 + kt) in the components of a system: `x = r eᵣ (+ z e_z)`.
struct Outflow {
    gas: Gas,
    components: [f64; 3],
    cartesian: bool,
}
impl Field for Outflow {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, q: &Vector3<T>, time: T) -> Vector3<T> {
        let rate = T::lit(self.gas.rate) / self.gas.stretch(time);
        if self.cartesian {
            return q * rate;
        }
        Vector3::from_fn(|i, _| q[i] * rate * T::lit(self.components[i]))
    }
}

fn gas() -> impl Strategy<Value = Gas> {
    (-0.3..2.0_f64, 0.1..10.0_f64, 0.1..10.0_f64, 1.1..3.0_f64).prop_map(|(rate, density, constant, exponent)| Gas {
        rate,
        density,
        constant,
        exponent,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn expanding_gas_balances_mass_momentum_and_energy(
        gas in gas(), q in [0.3..2.0_f64, -3.0..3.0, 0.2..2.9], t in 0.0..2.0_f64
    ) {
        let q = Vector3::from(q);
        let tol = Tol::ulps(128.0).value();
        let body = Body { motion: Homogeneous(gas), reference_density: Uniform(gas.density) };
        let density = Spatial(Density(gas));
        prop_assert!(body.density_residual(&density, &q, t)?.relative() <= tol);
        prop_assert!(body.continuity_residual(&density, &q, t)?.relative() <= tol);
        let (energy, stress) = (Material(Energy(gas)), Material(MaterialPressure(gas)));
        prop_assert!(body.energy_residual(&energy, &stress, &q, t)?.relative() <= tol);
        let none = Uniform(Vector3::zeros());
        // No term at all is left: the pressure is uniform and the particles move uniformly.
        prop_assert!(body.momentum_residual(&stress, &Material(none), &q, t)?.value == Vector3::zeros());

        let cylinder = Outflow { gas, components: [1.0, 0.0, 1.0], cartesian: false };
        let sphere = Outflow { gas, components: [1.0, 0.0, 0.0], cartesian: false };
        let space = Outflow { gas, components: [1.0; 3], cartesian: true };
        check_gas(&Flow { coordinates: Cylindrical, density: Density(gas), velocity: cylinder }, gas, &q, t, tol)?;
        check_gas(&Flow { coordinates: Spherical, density: Density(gas), velocity: sphere }, gas, &q, t, tol)?;
        check_gas(&Flow { coordinates: Cartesian, density: Density(gas), velocity: space }, gas, &q, t, tol)?;
    }
}

fn check_gas<C: Coordinates>(
    flow: &Flow<C, Density, Outflow>,
    gas: Gas,
    q: &Vector3<f64>,
    t: f64,
    tol: f64,
) -> Result<(), TestCaseError> {
    let continuity = flow.continuity_residual(q, t)?;
    prop_assert!(continuity.relative() <= tol, "{continuity:?}");
    let momentum = flow.momentum_residual(&Pressure(gas), &Uniform(Vector3::zeros()), q, t)?;
    prop_assert!(momentum.relative() <= tol, "{momentum:?}");
    let energy = flow.energy_residual(&Energy(gas), &Pressure(gas), q, t)?;
    prop_assert!(energy.relative() <= tol, "{energy:?}");
    Ok(())
}

/// Water that turns with a vessel about the vertical, in spherical components: `v = ω r sin φ e_θ`.
struct Turning {
    rate: f64,
}
impl Field for Turning {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> Vector3<T> {
        Vector3::new(T::zero(), T::lit(self.rate) * q[0] * q[2].sin(), T::zero())
    }
}
/// p = p₀ + ½ρω²r² sin²φ − ρ g r cos φ.
struct Vessel {
    rate: f64,
    weight: f64,
    density: f64,
}
impl Field for Vessel {
    type Value = CauchyStress;
    fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> CauchyStress<T> {
        let (s, c) = q[2].sin_cos();
        let speed = T::lit(self.rate) * q[0] * s;
        let head = T::lit(0.5) * speed * speed - T::lit(self.weight) * q[0] * c;
        CauchyStress(Symmetric::diagonal([-(T::lit(self.density) * (head + T::lit(7.0))); 3]))
    }
}
/// `−g e_z` in spherical components.
struct Weight(f64);
impl Field for Weight {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> Vector3<T> {
        let (s, c) = q[2].sin_cos();
        Vector3::new(-(T::lit(self.0) * c), T::zero(), T::lit(self.0) * s)
    }
}
/// Lamé's thick sphere, `T_rr = a − 2b/r³`, `T_θθ = T_φφ = a + b/r³`, and tube, `T_rr = a − b/r²`, `T_θθ = a + b/r²`.
struct Lame {
    a: f64,
    b: f64,
    sphere: bool,
}
impl Field for Lame {
    type Value = CauchyStress;
    fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> CauchyStress<T> {
        let (a, b, r) = (T::lit(self.a), T::lit(self.b), q[0]);
        let hoop = if self.sphere { b / (r * r * r) } else { b / (r * r) };
        let components =
            if self.sphere { [a - T::lit(2.0) * hoop, a + hoop, a + hoop] } else { [a - hoop, a + hoop, a] };
        CauchyStress(Symmetric::diagonal(components))
    }
}
/// The wave e^(−αt) cos(ωt) sin(kX) along the first axis, which a damped bar carries: c = 2αρ, E k² = ρ(α² + ω²).
#[derive(Clone, Copy)]
struct DampedWave {
    decay: f64,
    frequency: f64,
    number: f64,
}
impl DampedWave {
    fn envelope<T: Real>(&self, time: T) -> T {
        T::lit(1e-3) * (-(T::lit(self.decay) * time)).exp() * (T::lit(self.frequency) * time).cos()
    }
}
impl Motion for DampedWave {
    fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
        let wave = self.envelope(time) * (T::lit(self.number) * reference.x).sin();
        reference + Vector3::new(wave, T::zero(), T::zero())
    }
}
/// P₁₁ = E ∂u/∂X of the wave.
struct BarStress {
    wave: DampedWave,
    modulus: f64,
}
impl Field for BarStress {
    type Value = FirstPiola;
    fn at<T: Real>(&self, reference: &Vector3<T>, time: T) -> FirstPiola<T> {
        let k = T::lit(self.wave.number);
        let slope = self.wave.envelope(time) * k * (k * reference.x).cos();
        FirstPiola(Matrix3::from_diagonal(&Vector3::new(T::lit(self.modulus) * slope, T::zero(), T::zero())))
    }
}
/// ε = c e^(−t) sin x, and its heat flux −k grad (e^(−t) sin x).
struct Heat {
    capacity: f64,
}
impl Field for Heat {
    type Value = f64;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> T {
        T::lit(self.capacity) * (-time).exp() * place.x.sin()
    }
}
struct Flux {
    conductivity: f64,
}
impl Field for Flux {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> Vector3<T> {
        Vector3::new(-(T::lit(self.conductivity) * (-time).exp() * place.x.cos()), T::zero(), T::zero())
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn exact_solutions_leave_nothing(
        q in [0.3..2.0_f64, -3.0..3.0, 0.2..2.9], rate in 0.1..5.0_f64, weight in 0.1..10.0_f64,
        a in -3.0..3.0_f64, b in -3.0..3.0_f64, t in 0.0..2.0_f64
    ) {
        let q = Vector3::from(q);
        let tol = Tol::ulps(64.0).value();
        let density = 3.0;
        let flow = Flow { coordinates: Spherical, density: Uniform(density), velocity: Turning { rate } };
        let residual = flow.momentum_residual(&Vessel { rate, weight, density }, &Weight(weight), &q, t)?;
        prop_assert!(residual.relative() <= tol, "{residual:?}");
        prop_assert!(flow.continuity_residual(&q, t)?.value == 0.0);

        let none = Uniform(Vector3::zeros());
        let tube = equilibrium_residual(&Cylindrical, &Lame { a, b, sphere: false }, &none, &q, t)?;
        prop_assert!(tube.relative() <= tol, "{tube:?}");
        let sphere = equilibrium_residual(&Spherical, &Lame { a, b, sphere: true }, &none, &q, t)?;
        prop_assert!(sphere.relative() <= tol, "{sphere:?}");
    }

    #[test]
    fn damped_wave_in_a_bar_leaves_nothing(
        x in point(), decay in 0.0..2.0_f64, frequency in 0.5..5.0_f64, number in 0.5..5.0_f64, t in 0.0..2.0_f64
    ) {
        let wave = DampedWave { decay, frequency, number };
        let density = 2.0;
        let modulus = density * (decay * decay + frequency * frequency) / (number * number);
        let bar = Body { motion: wave, reference_density: Uniform(density) };
        let (stress, damping) = (Material(BarStress { wave, modulus }), Material(Uniform(2.0 * decay * density)));
        let residual = bar.damped_residual(&stress, &Material(Uniform(Vector3::zeros())), &damping, &x, t)?;
        // What cancels is of the size of the terms at the crest, ρ (α + ω)².
        let crest = 1e-3 * density * (decay + frequency).powi(2) * (-decay * t).exp();
        assert_close_at_scale("ρü + cu̇ − Div P", residual.value.as_slice(), &[0.0; 3], crest, Tol::ulps(64.0));
    }

    #[test]
    fn conducted_and_supplied_heat_leave_nothing(
        x in point(), capacity in 0.5..5.0_f64, conductivity in 0.5..5.0_f64, t in 0.0..2.0_f64
    ) {
        // ρε̇ = −div q + r with r = (k − ρc) e^(−t) sin x; at rest.
        let density = 3.0;
        let supply = (conductivity - density * capacity) * (-t).exp() * x.x.sin();
        let flow = Flow { coordinates: Cartesian, density: Uniform(density), velocity: Uniform(Vector3::zeros()) };
        let (energy, flux) = (Heat { capacity }, Flux { conductivity });
        let stress = Uniform(CauchyStress::zero());
        let residual = flow.heated_energy_residual(&energy, &stress, &flux, &Uniform(supply), &x, t)?;
        prop_assert!(residual.relative() <= Tol::ulps(16.0).value(), "{residual:?}");
        let body = Body { motion: Homogeneous(Rest), reference_density: Uniform(density) };
        let piola = Material(Uniform(FirstPiola::zero()));
        let supply = Material(Uniform(supply));
        let residual = body.heated_energy_residual(&Material(energy), &piola, &Material(flux), &supply, &x, t)?;
        prop_assert!(residual.relative() <= Tol::ulps(16.0).value(), "{residual:?}");
    }
}

/// No motion.
struct Rest;
impl AffineHistory for Rest {
    fn gradient<T: Real>(&self, _time: T) -> Matrix3<T> {
        let (o, l) = (T::zero(), T::one());
        Matrix3::new(l, o, o, o, l, o, o, o, l)
    }
}

//! Histories: what every simple fluid says to other observers, from other references and in a plane; motions of constant stretch
//! history and viscometric ones; the equation of Navier and Stokes.

use nalgebra::{Matrix3, Vector3};
use piola_constitutive::fluids::{
    AnyFluid, CarreauYasuda, ConstantStretchHistory, GeneralisedNewtonian, LinearViscous, SecondOrder, SimpleFluid,
    ViscometricFluid, ViscousStress, fluid_indifference, navier_stokes_residual, plane_history, reference_indifference,
    steady_turn, stretch_history, viscometric_motion,
};
use piola_constitutive::{ConstitutiveError, memory};
use piola_continuum::fields::{Cartesian, Cylindrical, Field, Flow, Uniform};
use piola_continuum::rates::{ExponentialMotion, HomogeneousMotion};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_testkit::{Tol, strategies};
use proptest::prelude::*;

use super::elastic::elastic;
use super::responses::all;

/// A motion of everything: F is a product of shears and a stretch that change with time, det F = 1; in the plane of 1 and 2 where
/// `across` is zero.
#[derive(Clone, Debug)]
struct Wandering {
    shears: [f64; 3],
    rates: [f64; 3],
    across: f64,
}

impl HomogeneousMotion for Wandering {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        let at = |i: usize| T::lit(self.shears[i]) * (T::lit(self.rates[i]) * t).sin();
        let one = Matrix3::from_diagonal_element(T::one());
        let (mut first, mut second, mut third) = (one, one, one);
        first[(1, 0)] = at(0);
        second[(0, 1)] = at(1);
        third[(0, 2)] = T::lit(self.across) * at(1);
        third[(2, 1)] = T::lit(self.across) * at(0);
        third[(2, 2)] = T::one() + third[(2, 1)] * T::zero();
        let stretch = at(2).exp();
        let diagonal = Matrix3::from_diagonal(&Vector3::new(stretch, stretch.recip(), T::one()));
        first * diagonal * second * third
    }
}

fn wandering(across: f64) -> impl Strategy<Value = Wandering> {
    let numbers = || proptest::array::uniform3(-0.8..0.8_f64);
    (numbers(), proptest::array::uniform3(0.3..1.5_f64)).prop_map(move |(shears, rates)| Wandering {
        shears,
        rates,
        across,
    })
}

/// What a fluid may differ by: followed and integrated ones by their tolerance.
fn tolerance(fluid: &AnyFluid) -> f64 {
    // What is barely thinning at rest knows the stress of a rate of 1e-16 badly.
    if fluid.viscosity(0.0_f64).is_finite() { 1e-7 } else { 1e-6 }
}

/// The other fluids, cheap.
fn instant() -> Vec<AnyFluid> {
    all().into_iter().filter(|fluid| !elastic().contains(fluid)).collect()
}

fn integrated() -> Vec<AnyFluid> {
    elastic()
}

/// Each of the three statements of a fluid.
fn fluid_statements(
    fluids: &[AnyFluid],
    motion: &Wandering,
    flat: &Wandering,
    spin: &Vector3<f64>,
    reference: &Matrix3<f64>,
    time: f64,
) -> Result<(), TestCaseError> {
    let observer = steady_turn(spin).expect("finite");
    for fluid in fluids {
        let what = fluid.name();
        // The second-order fluid of samples is a steady one, but of motions any.
        let seen = fluid_indifference(fluid, motion.clone(), observer, time, 1e-10).expect("runs");
        prop_assert!(seen <= tolerance(fluid), "{what} seen by others: {seen:e}");
        let referred = reference_indifference(fluid, motion.clone(), reference, time, 1e-10).expect("runs");
        prop_assert!(referred <= tolerance(fluid), "{what} from another reference: {referred:e}");
        let plane = plane_history(fluid, flat, &Vector3::new(0.0, 0.0, 2.0), time, 1e-10).expect("runs");
        prop_assert!(plane.history < 1e-14 && plane.stress < 1e-9, "{what} in a plane: {plane:?}");
    }
    Ok(())
}

fn unimodular(entries: &[f64]) -> Matrix3<f64> {
    let mut lower = Matrix3::identity();
    let mut upper = Matrix3::identity();
    (lower[(1, 0)], lower[(2, 0)], lower[(2, 1)]) = (entries[0], entries[1], entries[2]);
    (upper[(0, 1)], upper[(0, 2)], upper[(1, 2)]) = (entries[3], entries[4], entries[5]);
    lower * upper
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn fluids_of_the_present_rate_are_simple_fluids(
        motion in wandering(0.5), flat in wandering(0.0), spin in strategies::vector(3, -2.0..2.0),
        entries in strategies::vector(6, -1.0..1.0), time in 0.2..2.0_f64,
    ) {
        fluid_statements(&instant(), &motion, &flat, &Vector3::from_column_slice(&spin), &unimodular(&entries), time)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn fluids_with_memory_are_simple_fluids(
        motion in wandering(0.5), flat in wandering(0.0), spin in strategies::vector(3, -2.0..2.0),
        entries in strategies::vector(6, -1.0..1.0), time in 0.2..2.0_f64,
    ) {
        fluid_statements(&integrated(), &motion, &flat, &Vector3::from_column_slice(&spin), &unimodular(&entries), time)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn turned_exponential_motions_have_constant_stretch_histories_and_others_none(
        entries in strategies::vector(9, -1.0..1.0), spin in strategies::vector(3, -2.0..2.0),
        h in strategies::vector(6, -1.0..1.0), motion in wandering(0.5),
    ) {
        let mut generator = Matrix3::from_row_slice(&entries);
        generator -= Matrix3::from_diagonal_element(generator.trace() / 3.0);
        let turning = steady_turn(&Vector3::from_column_slice(&spin)).expect("finite");
        let constant = ConstantStretchHistory { turning, reference: unimodular(&h), generator };
        let times = [0.0, 0.3, 1.0];
        let change = stretch_history(&constant, &times, 1.0).expect("a motion");
        // cond H and exp(K) to the third power, of each of three factors.
        prop_assert!(change < 1e-8, "{change:e}");
        let shape = motion.shears.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        prop_assume!(0.3 < shape);
        let other = stretch_history(&motion, &times, 1.0).expect("a motion");
        prop_assert!(1e-4 < other, "{other:e} of {motion:?}");
    }

    #[test]
    fn turned_shears_are_viscometric_and_their_stress_is_that_of_the_functions(
        log in -3.0..3.0_f64, spin in strategies::vector(3, -2.0..2.0), q in strategies::rotation(), time in 0.0..3.0_f64,
    ) {
        let k = 10.0_f64.powf(log);
        let r = strategies::rotation_matrix(q);
        let axes = Matrix3::from_fn(|i, j| r[i][j]);
        let shear = Matrix3::new(0.0, 0.0, 0.0, k, 0.0, 0.0, 0.0, 0.0, 0.0);
        let turning = steady_turn(&(Vector3::from_column_slice(&spin) * k)).expect("finite");
        let motion = ConstantStretchHistory {
            turning, reference: axes.transpose(), generator: Matrix3::zeros(),
        };
        // H exp(K t) with K = H⁻¹ shear H is the shear along turned axes.
        let motion = ConstantStretchHistory { generator: axes * shear * axes.transpose(), ..motion };
        let found = viscometric_motion(&motion, time / k).expect("a motion").expect("it flows");
        let tolerance = Tol::ulps(4096.0).value() * (1.0 + time).powi(4);
        prop_assert!((found.shear_rate / k - 1.0).abs() < tolerance, "{found:?}");
        prop_assert!(found.residual < tolerance, "{found:?}");
        // A₁ = k (e₁e₂ + e₂e₁) with e₁ in the turned gradient.
        let turn = motion.turning.gradient(time / k);
        prop_assert!((found.axes[0].dot(&(turn * Vector3::x())).abs() - 1.0).abs() < tolerance);
    }

    #[test]
    fn stretching_motions_are_not_viscometric(
        entries in strategies::vector(9, -1.0..1.0),
    ) {
        let mut l = Matrix3::from_row_slice(&entries);
        l -= Matrix3::from_diagonal_element(l.trace() / 3.0);
        // det of a nilpotent L, and the sum of its principal minors, are zero.
        let (d, second) = (l.determinant(), -0.5 * (l * l).trace());
        prop_assume!(0.05 < d.abs() || 0.05 < second.abs());
        let motion = ExponentialMotion::new(l, Matrix3::identity()).expect("a motion");
        let found = viscometric_motion(&motion, 0.5).expect("a motion").expect("it flows");
        prop_assert!(1e-4 < found.residual, "{found:?}");
    }
}

/// A functional of the whole of F, as solids have: refuted.
struct Solid;
impl SimpleFluid for Solid {
    fn response_to_motion(
        &self,
        motion: &impl HomogeneousMotion,
        time: f64,
        _tolerance: f64,
    ) -> Result<Symmetric, ConstitutiveError> {
        let deformation: DeformationGradient = motion.deformation(time)?;
        let f = deformation.matrix();
        Symmetric::from_matrix(&(f * f.transpose() - Matrix3::identity())).map_err(ConstitutiveError::from)
    }
    fn response_to_steady(&self, _: &piola_continuum::rates::VelocityGradient) -> Result<Symmetric, ConstitutiveError> {
        Ok(Symmetric::zero())
    }
    fn response_to_samples(&self, _: &[(f64, DeformationGradient)], _: f64) -> Result<Symmetric, ConstitutiveError> {
        Ok(Symmetric::zero())
    }
    fn response_to_start(
        &self,
        _: f64,
        _: f64,
        _: f64,
    ) -> Result<piola_constitutive::fluids::ShearStresses, ConstitutiveError> {
        Ok(piola_constitutive::fluids::ShearStresses::default())
    }
    fn response_to_stop(
        &self,
        _: f64,
        _: f64,
        _: f64,
    ) -> Result<piola_constitutive::fluids::ShearStresses, ConstitutiveError> {
        Ok(piola_constitutive::fluids::ShearStresses::default())
    }
    fn response_to_small_oscillation(&self, _: f64) -> Result<piola_constitutive::fluids::Moduli, ConstitutiveError> {
        Ok(piola_constitutive::fluids::Moduli::default())
    }
    fn response_to_oscillation(
        &self,
        _: f64,
        _: f64,
        _: usize,
        _: f64,
    ) -> Result<piola_constitutive::fluids::Oscillation, ConstitutiveError> {
        Err(ConstitutiveError::NoTests)
    }
    fn response_to_extension(
        &self,
        _: piola_constitutive::fluids::Extension,
        _: f64,
    ) -> Result<f64, ConstitutiveError> {
        Ok(0.0)
    }
}

#[test]
fn solids_are_refuted_as_fluids_and_anisotropic_stress_in_a_plane() {
    let motion = Wandering { shears: [0.5, -0.3, 0.2], rates: [1.0, 0.5, 0.7], across: 0.5 };
    let observer = steady_turn(&Vector3::new(0.5, 1.0, -0.25)).expect("finite");
    // An isotropic solid looks the same to all observers, but it remembers its reference.
    assert!(fluid_indifference(&Solid, motion.clone(), observer, 1.0, 0.0).expect("runs") < 1e-12);
    let other = unimodular(&[0.5, 0.0, 0.1, 0.2, 0.0, 0.3]);
    assert!(0.1 < reference_indifference(&Solid, motion.clone(), &other, 1.0, 0.0).expect("runs"));
    let volume = Matrix3::from_diagonal_element(2.0);
    assert!(reference_indifference(&Solid, motion.clone(), &volume, 1.0, 0.0).is_err());
    // Out of the plane the history has no common proper vector, and neither has the stress.
    let fluid = SecondOrder::new(1.0, -0.5, 0.25).expect("bounds");
    let report = plane_history(&fluid, &motion, &Vector3::z(), 1.0, 0.0).expect("runs");
    assert!(1e-2 < report.history && 1e-2 < report.stress, "{report:?}");
    assert!(plane_history(&fluid, &motion, &Vector3::zeros(), 1.0, 0.0).is_err());
    assert!(stretch_history(&motion, &[0.0], 1.0).is_err());
    assert!(viscometric_motion(&observer, 1.0).expect("a motion").is_none());
    // The same theorem through the general functional of simple materials.
    let reduced = memory::Reduced(OfFluid(fluid));
    let search = piola_constitutive::checks::Search { samples: 20, ..Default::default() };
    assert!(memory::history_indifference(&reduced, 1.0, &search).passes());
}

/// A fluid of the present rate as a functional of F(t − s), by differences.
struct OfFluid(SecondOrder);
impl memory::SimpleMaterial for OfFluid {
    fn cauchy(&self, history: &dyn memory::History) -> Matrix3<f64> {
        let (now, then) = (history.gradient(0.0), history.gradient(1e-3));
        let l = (now - then) * 1e3 * now.try_inverse().unwrap_or_else(Matrix3::identity);
        piola_continuum::rates::VelocityGradient::new(l).map_or_else(
            |_| Matrix3::zeros(),
            |l| piola_constitutive::fluids::ViscousFluid::extra_stress(&self.0, &l).matrix(),
        )
    }
}

/// A flow of everything: of polynomials, that changes with time.
#[derive(Clone, Debug)]
struct Polynomial([f64; 9]);
impl Field for Polynomial {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, x: &Vector3<T>, t: T) -> Vector3<T> {
        let c = |i: usize| T::lit(self.0[i]);
        Vector3::new(
            c(0) * x[1] * x[1] * x[0] + c(1) * (x[2] * t).sin(),
            c(2) * x[0] * x[2] + c(3) * x[1] * x[1] + c(4) * t * x[0],
            c(5) * x[0] * x[1] * x[2] + c(6) * x[2].exp() + c(7) * x[1],
        )
    }
}
struct Pressure(f64);
impl Field for Pressure {
    type Value = f64;
    fn at<T: Real>(&self, x: &Vector3<T>, t: T) -> T {
        T::lit(self.0) * (x[0] * x[1] + t * x[2] * x[2])
    }
}
struct Density;
impl Field for Density {
    type Value = f64;
    fn at<T: Real>(&self, x: &Vector3<T>, _: T) -> T {
        T::lit(2.0) + x[0] * x[0]
    }
}
/// f per mass from f per volume.
struct PerMass(Vector3<f64>);
impl Field for PerMass {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, x: &Vector3<T>, t: T) -> Vector3<T> {
        self.0.map(T::lit) / Density.at(x, t)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn navier_stokes_residual_equals_the_balance_of_momentum_of_the_viscous_stress(
        entries in strategies::vector(9, -2.0..2.0), place in strategies::vector(3, -1.0..1.0), time in -1.0..1.0_f64,
        force in strategies::vector(3, -2.0..2.0), second in -0.4..2.0_f64, pressure in -2.0..2.0_f64,
    ) {
        let velocity = Polynomial(core::array::from_fn(|i| entries[i]));
        let fluid = LinearViscous::new(second, 0.75).expect("bounds");
        let flow = Flow { coordinates: Cartesian, density: Density, velocity: velocity.clone() };
        let (place, force) = (Vector3::from_column_slice(&place), Vector3::from_column_slice(&force));
        let found = navier_stokes_residual(&fluid, &flow, &Pressure(pressure), &Uniform(force), &place, time);
        let found = found.expect("finite");
        let stress = ViscousStress { fluid, coordinates: Cartesian, velocity, pressure: Pressure(pressure) };
        let balance = flow.momentum_residual(&stress, &PerMass(force), &place, time).expect("finite");
        let error = (found.value + balance.value).norm();
        prop_assert!(error <= Tol::ulps(64.0).value() * found.scale.norm(), "{error:e}");
    }
}

/// The decaying vortex of Lamb and Oseen in cylindrical coordinates; its pressure balances it radially.
struct Vortex;
impl Field for Vortex {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, q: &Vector3<T>, t: T) -> Vector3<T> {
        // Γ = 2 π, ν = ¼: v = (1 − exp(−r²/t))/r.
        let r = q[0];
        Vector3::new(T::zero(), -(-(r * r) / t).exp_m1() / r, T::zero())
    }
}

#[test]
fn decaying_vortex_satisfies_the_azimuthal_balance_in_cylindrical_coordinates() {
    let fluid = LinearViscous::new(0.5, 0.25).expect("bounds");
    let stress = ViscousStress { fluid, coordinates: Cylindrical, velocity: Vortex, pressure: Uniform(0.0) };
    let flow = Flow { coordinates: Cylindrical, density: Uniform(1.0), velocity: Vortex };
    for (r, time) in [(0.25, 0.5), (1.0, 1.0), (2.0, 0.75)] {
        let q = Vector3::new(r, 0.5, 0.25);
        let residual = flow.momentum_residual(&stress, &Uniform(Vector3::zeros()), &q, time).expect("finite");
        assert!(residual.value.y.abs() <= Tol::ulps(64.0).value() * residual.scale.y, "{residual:?}");
        // Radially −ρ v²/r is left for the pressure.
        let v = -(-r * r / time).exp_m1() / r;
        assert!((residual.value.x - v * v / r).abs() <= 1e-14, "{residual:?}");
    }
    // Channel flow of a thinning fluid: the stress field is that of its own law, and div T is −c only where it is the solution's.
    let thinning = GeneralisedNewtonian::new(CarreauYasuda::new(2.0, 0.5, 1.0, 0.5, 2.0).expect("bounds"));
    let stress = ViscousStress { fluid: thinning, coordinates: Cylindrical, velocity: Vortex, pressure: Uniform(0.0) };
    let t = stress.at(&Vector3::new(1.0, 0.0, 0.0), 1.0);
    // T_rθ = τ(r (v/r)′), r (v/r)′ = 2 e⁻¹ − 2 (1 − e⁻¹) at r = t = 1.
    let e = (-1.0_f64).exp();
    let k = 2.0 * e - 2.0 * (1.0 - e);
    assert!((t.0.components[3] - thinning.fluid().shear_stress(k)).abs() < 1e-14);
    let nowhere = stress.at::<f64>(&Vector3::new(0.0, 0.0, 0.0), 1.0);
    assert!(nowhere.0.components[0].is_nan());
}

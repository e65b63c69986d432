//! Histories: what every simple fluid says to other observers, from other references and in a plane.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::rates::{HomogeneousMotion, steady_turn};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_fluids::{
    AnyFluid, FluidsError, SecondOrder, SimpleFluid, ViscometricFluid, fluid_indifference, plane_history,
    reference_indifference,
};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale, strategies};
use proptest::prelude::*;

use super::elastic::{all, elastic};

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

const FOLLOWED: Tol = Tol::stated(1e-7, "tolerance 1e-10 of each of some hundred steps, and derivatives of the motion");
/// What flows like a power knows the stress of a rate of 1e-16 badly: (1e-16)^0.05 of it.
const POWERS: Tol = Tol::stated(1e-6, "derivatives of the motion, to a power");

/// What a fluid may differ by: followed and integrated ones by their tolerance.
fn tolerance(fluid: &AnyFluid) -> Tol {
    if fluid.viscosity(0.0_f64).is_finite() { FOLLOWED } else { POWERS }
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
) {
    let observer = steady_turn(spin).expect("finite");
    for fluid in fluids {
        let what = fluid.name();
        // The second-order fluid of samples is a steady one, but of motions any.
        let seen = fluid_indifference(fluid, motion.clone(), observer, time, 1e-10).expect("runs");
        assert_close_at_scale(&format!("{what} seen by others"), &[seen], &[0.0], 1.0, tolerance(fluid));
        let referred = reference_indifference(fluid, motion.clone(), reference, time, 1e-10).expect("runs");
        assert_close_at_scale(&format!("{what} from another reference"), &[referred], &[0.0], 1.0, tolerance(fluid));
        let plane = plane_history(fluid, flat, &Vector3::new(0.0, 0.0, 2.0), time, 1e-10).expect("runs");
        // F is a block: what is outside of it is the rounding of a polar decomposition, and what a fluid makes of that.
        assert_close_at_scale(what, &[plane.history], &[0.0], 1.0, Tol::ulps(45.0));
        let left = Tol::stated(1e-9, "tolerance 1e-10 of each step");
        assert_close_at_scale(what, &[plane.stress], &[0.0], 1.0, left);
    }
}

fn unimodular(entries: &[f64]) -> Matrix3<f64> {
    let mut lower = Matrix3::identity();
    let mut upper = Matrix3::identity();
    (lower[(1, 0)], lower[(2, 0)], lower[(2, 1)]) = (entries[0], entries[1], entries[2]);
    (upper[(0, 1)], upper[(0, 2)], upper[(1, 2)]) = (entries[3], entries[4], entries[5]);
    lower * upper
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(2_000)))]

    #[test]
    fn fluids_of_the_present_rate_are_simple_fluids(
        motion in wandering(0.5), flat in wandering(0.0), spin in strategies::vector(3, -2.0..2.0),
        entries in strategies::vector(6, -1.0..1.0), time in 0.2..2.0_f64,
    ) {
        fluid_statements(&instant(), &motion, &flat, &Vector3::from_column_slice(&spin), &unimodular(&entries), time);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn fluids_with_memory_are_simple_fluids(
        motion in wandering(0.5), flat in wandering(0.0), spin in strategies::vector(3, -2.0..2.0),
        entries in strategies::vector(6, -1.0..1.0), time in 0.2..2.0_f64,
    ) {
        fluid_statements(&integrated(), &motion, &flat, &Vector3::from_column_slice(&spin), &unimodular(&entries), time);
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
    ) -> Result<Symmetric, FluidsError> {
        let deformation: DeformationGradient = motion.deformation(time)?;
        let f = deformation.matrix();
        Symmetric::from_matrix(&(f * f.transpose() - Matrix3::identity()))
            .map_err(|error| FluidsError::from(piola_continuum::ContinuumError::from(error)))
    }
    fn response_to_steady(&self, _: &piola_continuum::rates::VelocityGradient) -> Result<Symmetric, FluidsError> {
        Ok(Symmetric::zero())
    }
    fn response_to_samples(&self, _: &[(f64, DeformationGradient)], _: f64) -> Result<Symmetric, FluidsError> {
        Ok(Symmetric::zero())
    }
    fn response_to_start(&self, _: f64, _: f64, _: f64) -> Result<piola_fluids::ShearStresses, FluidsError> {
        Ok(piola_fluids::ShearStresses::default())
    }
    fn response_to_stop(&self, _: f64, _: f64, _: f64) -> Result<piola_fluids::ShearStresses, FluidsError> {
        Ok(piola_fluids::ShearStresses::default())
    }
    fn response_to_small_oscillation(&self, _: f64) -> Result<piola_fluids::Moduli, FluidsError> {
        Ok(piola_fluids::Moduli::default())
    }
    fn response_to_oscillation(
        &self,
        _: f64,
        _: f64,
        _: usize,
        _: f64,
    ) -> Result<piola_fluids::Oscillation, FluidsError> {
        Err(FluidsError::WrongLength { quantity: "harmonics", expected: 0, found: 1 })
    }
    fn response_to_extension(&self, _: piola_fluids::Extension, _: f64) -> Result<f64, FluidsError> {
        Ok(0.0)
    }
}

#[test]
fn solids_are_refuted_as_fluids_and_anisotropic_stress_in_a_plane() {
    let motion = Wandering { shears: [0.5, -0.3, 0.2], rates: [1.0, 0.5, 0.7], across: 0.5 };
    let observer = steady_turn(&Vector3::new(0.5, 1.0, -0.25)).expect("finite");
    // An isotropic solid looks the same to all observers, but it remembers its reference.
    let seen = fluid_indifference(&Solid, motion.clone(), observer, 1.0, 0.0).expect("runs");
    let products = Tol::stated(1e-12, "F, its inverse and a rotation of a stress of some ten times its size");
    assert_close_at_scale("seen by others", &[seen], &[0.0], 1.0, products);
    let other = unimodular(&[0.5, 0.0, 0.1, 0.2, 0.0, 0.3]);
    assert!(0.1 < reference_indifference(&Solid, motion.clone(), &other, 1.0, 0.0).expect("runs"));
    let volume = Matrix3::from_diagonal_element(2.0);
    assert!(reference_indifference(&Solid, motion.clone(), &volume, 1.0, 0.0).is_err());
    // Out of the plane the history has no common proper vector, and neither has the stress.
    let fluid = SecondOrder::new(1.0, -0.5, 0.25).expect("bounds");
    let report = plane_history(&fluid, &motion, &Vector3::z(), 1.0, 0.0).expect("runs");
    assert!(1e-2 < report.history && 1e-2 < report.stress, "{report:?}");
    assert!(plane_history(&fluid, &motion, &Vector3::zeros(), 1.0, 0.0).is_err());
}

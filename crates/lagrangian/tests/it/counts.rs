//! Nothing is computed that was not asked for: what is called, how often, with which scalars.

use std::any::type_name;
use std::cell::{Cell, RefCell};

use nalgebra::Vector3;
use piola_lagrangian::{Holonomic, Lagrangian, NoPotential, Placement, Potential};
use piola_numerics::Real;

/// Particles on lines, one for each coordinate, that note how they are placed.
#[derive(Default)]
struct Counted<const TIME_DEPENDENT: bool> {
    places: Cell<usize>,
    scalars: RefCell<Vec<&'static str>>,
    time: Cell<f64>,
}

impl<const TIME_DEPENDENT: bool> Holonomic for Counted<TIME_DEPENDENT> {
    const TIME_DEPENDENT: bool = TIME_DEPENDENT;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        self.places.set(self.places.get() + 1);
        self.scalars.borrow_mut().push(type_name::<T>());
        self.time.set(t.primal(0));
        for &q in q {
            // A time with a rate would move the particle.
            bodies.particle(1.0, Vector3::new(q, T::lit(2.0) * t, T::zero()));
        }
    }
}

/// A potential that notes its calls and whether it was given velocities.
#[derive(Default)]
struct CountedPotential<const VELOCITY_DEPENDENT: bool> {
    calls: Cell<usize>,
    velocities: Cell<usize>,
}

impl<const VELOCITY_DEPENDENT: bool> Potential for CountedPotential<VELOCITY_DEPENDENT> {
    const VELOCITY_DEPENDENT: bool = VELOCITY_DEPENDENT;
    fn potential<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        self.calls.set(self.calls.get() + 1);
        self.velocities.set(self.velocities.get() + v.len());
        q[0] * q[0]
    }
}

/// There is none, so nobody may ask.
struct Forbidden;
impl Potential for Forbidden {
    const PRESENT: bool = false;
    fn potential<T: Real>(&self, _q: &[T], _v: &[T], _t: T) -> T {
        unreachable!("an absent potential was evaluated")
    }
}

#[test]
fn acceleration_places_the_system_once_over_jets() {
    for n in 1..=8 {
        let lagrangian = Lagrangian::of(Counted::<false>::default());
        lagrangian.acceleration(&vec![0.5; n], &vec![1.0; n], 0.0).unwrap();
        assert_eq!(lagrangian.system().places.get(), 1, "{n} coordinates");
        let scalars = lagrangian.system().scalars.borrow();
        assert!(scalars[0].contains("Jet"), "no Christoffel work, which needs nested derivatives: {scalars:?}");
    }
    // Beyond eight coordinates, eight at a time.
    for n in [9, 16, 17] {
        let lagrangian = Lagrangian::of(Counted::<false>::default());
        lagrangian.acceleration(&vec![0.5; n], &vec![1.0; n], 0.0).unwrap();
        assert_eq!(lagrangian.system().places.get(), n.div_ceil(8), "{n} coordinates");
    }
}

#[test]
fn absent_potential_is_never_evaluated() {
    for n in [2, 9] {
        let (q, v) = (vec![0.5; n], vec![1.0; n]);
        let lagrangian = Lagrangian::of(Counted::<false>::default()).with_potential(Forbidden);
        lagrangian.acceleration(&q, &v, 0.0).unwrap();
        lagrangian.energies(&q, &v, 0.0).unwrap();
        lagrangian.momenta(&q, &v, 0.0).unwrap();
        lagrangian.coordinate_gradient(&q, &v, 0.0).unwrap();
    }
    const { assert!(!NoPotential::PRESENT) }
}

#[test]
fn potential_of_coordinates_is_evaluated_once_and_without_velocities() {
    let lagrangian = |n: usize| {
        let with = Lagrangian::of(Counted::<false>::default()).with_potential(CountedPotential::<false>::default());
        with.acceleration(&vec![0.5; n], &vec![1.0; n], 0.0).unwrap();
        with
    };
    for n in [1, 2, 5, 8] {
        let potential = lagrangian(n);
        assert_eq!(calls(&potential), (1, 0), "{n} coordinates");
    }
    assert_eq!(calls(&lagrangian(17)), (3, 0));
}

fn calls<const V: bool>(lagrangian: &Lagrangian<Counted<false>, CountedPotential<V>>) -> (usize, usize) {
    (lagrangian.potential().calls.get(), lagrangian.potential().velocities.get())
}

#[test]
fn generalised_potential_is_evaluated_twice() {
    let lagrangian = Lagrangian::of(Counted::<false>::default()).with_potential(CountedPotential::<true>::default());
    lagrangian.acceleration(&[0.5; 2], &[1.0; 2], 0.0).unwrap();
    // The rate of ∂V/∂q̇ with ∂V/∂q, and ∂²V/∂q̇∂q̇: two velocities each time.
    assert_eq!(calls(&lagrangian), (2, 4));
}

#[test]
fn time_has_a_rate_only_where_it_is_declared() {
    let still = Lagrangian::of(Counted::<false>::default());
    let energy = still.energies(&[0.0], &[3.0], 0.0).unwrap().kinetic;
    assert!((energy - 4.5).abs() < f64::EPSILON, "{energy}"); // ½ 3²
    let moving = Lagrangian::of(Counted::<true>::default());
    let energy = moving.energies(&[0.0], &[3.0], 0.0).unwrap().kinetic;
    assert!((energy - 6.5).abs() < f64::EPSILON, "{energy}"); // ½ (3² + 2²)
    // What is not declared is found out by the check.
    assert!(still.check(&[0.0], &[3.0], 0.0).is_err());
    assert!(moving.check(&[0.0], &[3.0], 0.0).is_ok());
}

#[test]
fn momenta_and_energies_place_the_system_once() {
    let lagrangian = Lagrangian::of(Counted::<false>::default());
    lagrangian.momenta(&[0.5; 3], &[1.0; 3], 0.0).unwrap();
    lagrangian.energies(&[0.5; 3], &[1.0; 3], 0.0).unwrap();
    assert_eq!(lagrangian.inertia_metric(&[0.5; 3], 0.0).unwrap().nrows(), 3);
    assert_eq!(lagrangian.system().places.get(), 3);
}

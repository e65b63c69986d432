//! Evaluations that must not allocate.

use piola_hamiltonian::hamilton_jacobi::{Candidate, CharacteristicStrip, ExtremalField, RayField};
use piola_integrators::Field;
use piola_testkit::allocations_in;

use super::systems::{Bowl, PolarBowl};

/// U = x y − t.
#[derive(Debug)]
struct Saddle;

impl piola_hamiltonian::hamilton_jacobi::PrincipalFunction for Saddle {
    fn value<T: piola_numerics::Real>(&self, q: &[T], t: T) -> T {
        q[0] * q[1] - t
    }
}

#[test]
fn evaluations_do_not_allocate() {
    let mut rate = [0.0; 13];
    let y = [0.3; 13];
    let mut ray = RayField::new(&Bowl, 2, 2);
    let mut strip = CharacteristicStrip::new(&PolarBowl, 2);
    let mut field = ExtremalField::new(&Bowl, &Saddle, 2);
    let mut candidate = Candidate::new(&Bowl, &Saddle);
    let mut all = || {
        ray.rate(0.0, &y, &mut rate).unwrap();
        strip.rate(0.0, &y[..7], &mut rate[..7]).unwrap();
        field.rate(0.0, &y[..3], &mut rate[..3]).unwrap();
        candidate.residual(&y[..2], 0.5).unwrap();
    };
    all();
    assert_eq!(allocations_in(all).0, 0);
}

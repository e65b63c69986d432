//! Evaluations allocate nothing.

use piola_continuum::DisplacementGradient;
use piola_solids::Hyperelastic;
use piola_solids::SolidsError;
use piola_testkit::allocations_in;

use super::zoo::{self, Visitor};

struct Counted(DisplacementGradient);

impl Visitor for Counted {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L) {
        let f = &self.0;
        let (count, _) = allocations_in(|| (law.energy(f), law.second_piola(f), law.first_piola_and_tangent(f)));
        assert_eq!(count, 0, "{name}");
    }
}

#[test]
fn allocations_of_an_evaluation_equal_zero() -> Result<(), SolidsError> {
    zoo::stress_free(&mut Counted(DisplacementGradient::simple_shear(0.5).expect("finite")))
}

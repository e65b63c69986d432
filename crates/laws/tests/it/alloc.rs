//! No law of one's own allocates in an evaluation.

use core::error::Error;
use core::hint::black_box;

use piola_continuum::DeformationGradient;
use piola_solids::Hyperelastic;
use piola_testkit::allocations_in;

use super::zoo::{self, Visit};

struct Counts(DeformationGradient);

impl Visit for Counts {
    fn pair<O: Hyperelastic + Sync, B: Hyperelastic + Sync>(
        &mut self,
        name: &'static str,
        way: &'static str,
        own: &O,
        _built_in: &B,
    ) -> Result<(), Box<dyn Error>> {
        let f = self.0;
        let (count, ()) = allocations_in(|| {
            let _ = black_box((own.energy_first_piola_and_tangent(&f), own.second_piola(&f), own.kirchhoff(&f)));
        });
        assert_eq!(count, 0, "{name} by {way}");
        Ok(())
    }
}

#[test]
fn allocations_in_evaluations_of_own_laws_equal_zero() -> Result<(), Box<dyn Error>> {
    zoo::each(&mut Counts(DeformationGradient::simple_shear(0.25)?))
}

//! What the bench of laws states as their error is the error of the law with those parameters.

use std::error::Error;

use piola_benches::constitutive::laws::{self, Visit};
use piola_constitutive::solids::Hyperelastic;

struct Accurate(usize);

impl Visit for Accurate {
    fn law<L: Hyperelastic + Sync>(
        &mut self,
        name: &'static str,
        model: Option<&'static str>,
        law: &L,
    ) -> Result<(), Box<dyn Error>> {
        let [stress, tangent] = laws::errors_near_identity(model, law)?;
        assert!(stress <= 1e-13, "{name}: P within {stress:e} near the identity");
        assert!(tangent <= 1e-12, "{name}: ∂P/∂F within {tangent:e} near the identity");
        self.0 += 1;
        Ok(())
    }
}

#[test]
fn laws_that_are_measured_are_accurate_near_the_identity() -> Result<(), Box<dyn Error>> {
    let mut visited = Accurate(0);
    laws::each(&mut visited)?;
    laws::each_incompressible(&mut visited)?;
    assert_eq!(visited.0, 25);
    Ok(())
}

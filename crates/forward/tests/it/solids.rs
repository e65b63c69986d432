//! Solids read from the files of fits.

use core::fmt::Write as _;

use piola_forward::solid;
use piola_measured::sides::{SidesMeasurements, SidesModel, SidesOptions, compare_sides};
use piola_testkit::{Tol, assert_close};

#[test]
fn a_fitted_foam_is_the_solid_that_its_summary_names() -> Result<(), Box<dyn std::error::Error>> {
    // μ = 0.4 MPa, α = 6, ν = 0.2: λₜ = λ^(−ν), P = (2 μ/α)(λ^α − λₜ^α)/λ.
    let mut rows = String::from("mode;stretch;stress [MPa];lateral strain [%]\n");
    for x in [0.4_f64, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1] {
        let side = x.powf(-0.2);
        let stress = 0.8 / 6.0 * (x.powi(6) - side.powi(6)) / x;
        writeln!(rows, "uniaxial;{x};{stress};{}", 100.0 * (side - 1.0))?;
    }
    let found = SidesMeasurements::parse("foam.csv", &rows)?;
    let model: SidesModel = "hyperfoam:1".parse()?;
    let comparison = compare_sides(&found, &[model], &SidesOptions::default());
    let path = std::env::temp_dir().join(format!("piola-foam-summary-{}.json", std::process::id()));
    std::fs::write(&path, comparison.summary(&found))?;
    let read = solid(&format!("{}#hyperfoam:1", path.display()), None)?;
    std::fs::remove_file(&path)?;
    let named = solid("hyperfoam:1:mu1=0.4 MPa,alpha1=6,nu1=0.2", None)?;
    let modulus = |solid: &piola_laws::rubber::AnyRubber| match solid {
        piola_laws::rubber::AnyRubber::Hyperfoam(foam) => foam.shear_modulus(),
        _ => f64::NAN,
    };
    let tol = Tol::stated(1e-6, "the root of the rounding of the sum of squares");
    assert_close("Σ μ", &[modulus(&read), modulus(&named)], &[4e5; 2], tol);
    Ok(())
}

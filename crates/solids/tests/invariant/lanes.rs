//! Four points in lanes, small and large strains mixed, beside the points one by one.

use piola_continuum::{Deformation, DisplacementGradient};
use piola_numerics::Lanes;
use piola_solids::Hyperelastic;
use piola_solids::SolidsError;
use piola_testkit::{Tol, assert_close};

use super::zoo::{self, Visitor};

const LANES: Tol = Tol::stated(1e-13, "elementary functions of lanes and of single numbers");

struct LanesEqualPoints;

impl Visitor for LanesEqualPoints {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L) {
        let scales = [1e-14, 1e-3, 0.2, 0.6];
        let entries = [[0.3, -0.2, 0.5], [0.4, 0.7, -0.1], [-0.6, 0.2, 0.9]];
        let single =
            |scale: f64| DisplacementGradient::from_rows(entries.map(|row| row.map(|x| x * scale))).expect("0 < det F");
        let unit = single(0.1);
        let lanes = unit.lifted(|i, j, _| Lanes(scales.map(|scale| entries[i][j] * scale)));
        let (energy, stress) = (law.energy(&lanes), law.first_piola(&lanes));
        let tangent = law.first_piola_tangent(&lanes);
        for (lane, scale) in scales.into_iter().enumerate() {
            let point = single(scale);
            assert_close(&format!("{name}: W"), &[energy.0[lane]], &[law.energy(&point)], LANES);
            let actual = stress.0.map(|x| x.0[lane]);
            assert_close(&format!("{name}: P"), actual.as_slice(), law.first_piola(&point).0.as_slice(), LANES);
            let actual = tangent.0.components.map(|row| row.map(|x| x.0[lane]));
            let expected = law.first_piola_tangent(&point).0.components;
            assert_close(&format!("{name}: ∂P/∂F"), actual.as_flattened(), expected.as_flattened(), LANES);
        }
    }
}

#[test]
fn answers_in_lanes_equal_those_of_single_points() -> Result<(), SolidsError> {
    zoo::stress_free(&mut LanesEqualPoints)
}

//! The energy of a body, and its rate.

use nalgebra::Vector3;
use piola_continuum::DeformationGradient;
use piola_fields::Motion;
use piola_fields::integral::{Ball, Quadrature, strain_energy};
use piola_numerics::{Dual, Real};
use piola_solids::{Hyperelastic, MooneyRivlin};
use piola_specimens::UniformBody;
use piola_testkit::{Tol, assert_close};

/// x = (1 + t) X₁ + t X₂, X₂, X₃.
struct StretchAndShear;

impl Motion for StretchAndShear {
    fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
        let growth = T::lit(1.0) + time;
        Vector3::new(growth * reference.x + time * reference.y, reference.y, reference.z)
    }
}

#[test]
fn strain_energy_of_a_ball_equals_density_times_volume_and_its_rate_the_power_of_the_stress() {
    let law = MooneyRivlin::stress_free(0.5, 0.25, 1.0).expect("bounds");
    let ball = Ball::new(Vector3::zeros(), 2.0).expect("positive");
    let quadrature = Quadrature::of_degree(2).expect("degree");
    let total = strain_energy(&quadrature, &ball, &StretchAndShear, &UniformBody(law), Dual::variable(0.5));
    let total = total.expect("0 < det F");
    let f = DeformationGradient::from_rows([[1.5, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).expect("0 < det F");
    let volume = 4.0 / 3.0 * core::f64::consts::PI * 8.0;
    let stress = law.first_piola(&f).0;
    let power = stress[(0, 0)] + stress[(0, 1)];
    assert_close("∫ W dV", &[total.value], &[volume * law.energy(&f)], Tol::ulps(64.0));
    assert_close("∫ P : Ḟ dV", &[total.tangent], &[volume * power], Tol::ulps(64.0));
}

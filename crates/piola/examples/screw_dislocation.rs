//! A screw dislocation: its Burgers vector, a crystal that is perfect everywhere else, and the stress around the line.
#![expect(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};
use piola::continuum::DeformationGradient;
use piola::integrators::Tolerance;
use piola::numerics::Real;
use piola::solids::NeoHookeanLogarithmic;
use piola::uniformity::{
    BurgersVector, Flatness, InverseMap, LieAlgebra, MaterialConnection, MateriallyUniformBody, RoundCircuit,
    TransportedFrame, UniformityMap,
};

/// The dual basis of a lattice with one screw of Burgers vector b along e₃: the third row of K⁻¹ is (0, 0, 1) + b grad φ/2π.
#[derive(Clone, Copy)]
struct Screw {
    burgers: f64,
}

impl UniformityMap for Screw {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        let [x, y, _] = (*reference).into();
        let factor = T::lit(self.burgers / TAU) / (x * x + y * y);
        let mut dual = Matrix3::identity();
        (dual[(2, 0)], dual[(2, 1)]) = (-(factor * y), factor * x);
        dual
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Lengths in nanometres.
    let lattice = InverseMap(Screw { burgers: 0.25 });

    // Off the line the crystal is perfect: neither torsion nor curvature.
    let places = [Vector3::new(1.0, 0.5, 0.0), Vector3::new(-3.0, 2.0, 1.0)];
    let report = Flatness::of_body(&lattice, LieAlgebra::trivial(), &places, 1.0, 1e-12)?;
    println!("largest torsion {:.1e}, curvature {:.1e}", report.torsion.value, report.curvature.value);
    assert!(report.is_flat());

    // A circuit around the line fails to close in the crystal by b, whatever its shape; one beside it closes.
    for (centre, radius, expected) in [(0.0, 1.5, 0.25), (0.5, 3.0, 0.25), (3.0, 1.0, 0.0)] {
        let circuit = RoundCircuit::new(Vector3::new(centre, 0.0, 0.0), Vector3::z(), radius)?;
        let burgers = BurgersVector::of(&lattice, &circuit, 1e-13)?;
        println!("about ({centre}, 0), radius {radius}: b = {:.15}", burgers.value.z);
        assert!((burgers.value - Vector3::new(0.0, 0.0, expected)).norm() < 1e-13);
    }

    // The same by transport: the frame returns unturned, and the developed circuit is open by b.
    let circuit = RoundCircuit::new(Vector3::zeros(), Vector3::z(), 1.5)?;
    let start = lattice.value(&Vector3::new(1.5, 0.0, 0.0))?;
    let connection = MaterialConnection::of_crystal(lattice);
    let round = TransportedFrame::around(&connection, &circuit, &start, Tolerance::relative(1e-12)?)?;
    println!("development open by {:.12}", round.development.z);
    assert!((round.development.z - 0.25).abs() < 1e-10 && (round.holonomy() - Matrix3::identity()).norm() < 1e-10);

    // Held in the reference, the stress is Volterra's, T_θz = −μ b/2πr of the strain that the lattice lacks, to first order in b/r.
    let body = MateriallyUniformBody { law: NeoHookeanLogarithmic::with_constants(40e9, 60e9)?, map: lattice };
    for radius in [2.5, 25.0, 250.0] {
        let stress = body.cauchy(&DeformationGradient::identity(), &Vector3::new(radius, 0.0, 0.0))?.0.components;
        let volterra = 40e9 * 0.25 / (2.0 * PI * radius);
        println!("r = {radius:5.1} nm: |T_θz| = {:.6e} Pa, μ b/2πr = {volterra:.6e} Pa", stress[4].abs());
        assert!((stress[4].abs() / volterra - 1.0).abs() < 1e-12);
    }
    Ok(())
}

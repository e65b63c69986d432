//! Two fluids in shear: one that thins above its yield stress, and one that remembers and pushes plates apart.
#![expect(clippy::print_stdout, reason = "an example prints")]

use piola::fluids::{HerschelBulkley, UpperConvectedMaxwell, ViscometricFluid};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ketchup = HerschelBulkley::new(15.0, 20.0, 0.5)?; // yield stress, Pa; consistency, Pa s^½; exponent
    let polymer = UpperConvectedMaxwell::new(100.0, 2.0)?; // viscosity, Pa s; relaxation time, s
    println!("rate 1/s   ketchup τ/Pa   polymer τ/Pa   polymer N₁/Pa");
    for rate in [0.25, 1.0, 4.0, 25.0_f64] {
        let (thin, thick) = (ketchup.shear_stress(rate), polymer.shear_stress(rate));
        let normal = polymer.first_normal_stress_difference(rate);
        println!("{rate:8} {thin:14.3} {thick:14.3} {normal:15.3}");
        assert!((thin - (15.0 + 20.0 * rate.sqrt())).abs() < 1e-12 * thin); // τ_y + K √k
        assert!((thick - 100.0 * rate).abs() < 1e-12 * thick); // η k
        assert!((normal - 400.0 * rate * rate).abs() < 1e-12 * normal); // 2 η λ k²
    }
    // The other way round: no flow up to the yield stress, and the rate of a stress beyond it.
    assert!(ketchup.shear_rate(14.0_f64)?.abs() < 1e-300);
    assert!((ketchup.shear_rate(55.0_f64)? - 4.0).abs() < 1e-12);
    Ok(())
}

//! Ketchup through a pipe: discharge, plug, the pressure for a wanted discharge, and the fluid back from the table.
#![expect(clippy::print_stdout, reason = "an example prints")]

use core::f64::consts::PI;

use piola::fluids::{Bingham, Newtonian};
use piola::viscometry::Poiseuille;
use piola::viscometry::recover::{self, FlowTable};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Newton's fluid: Q = π R⁴ c/(8 μ), Hagen and Poiseuille.
    let (radius, gradient) = (0.01_f64, 10.0e3);
    let pipe = Poiseuille::new(radius, gradient)?;
    let discharge = pipe.discharge(&Newtonian::new(2.0)?)?;
    println!("oil     {:.6e} m³/s", discharge.value);
    assert!((discharge.value / (PI * radius.powi(4) * gradient / 16.0) - 1.0).abs() < 1e-13);

    // Bingham's fluid: times 1 − 4/3 x + 1/3 x⁴ with x = 2 τ_y/(c R), Buckingham and Reiner; x R is the plug's radius.
    let paste = Bingham::new(25.0, 2.0)?; // yield stress, Pa; viscosity, Pa s
    let slow = pipe.discharge(&paste)?;
    println!("paste   {:.6e} m³/s, plug {:.1} mm", slow.value, 1e3 * pipe.plug_radius(&paste));
    assert!((slow.value / discharge.value - (1.0 - 2.0 / 3.0 + 1.0 / 48.0)).abs() < 1e-12);
    assert!((pipe.plug_radius(&paste) - 0.005).abs() < 1e-16);
    let wanted = Poiseuille::with_discharge(radius, slow.value, &paste)?;
    assert!((wanted.pressure_gradient() / gradient - 1.0).abs() < 1e-12);

    // Back from a table of pressure gradients and discharges, after Weissenberg, Rabinowitsch and Mooney.
    let rows = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0].map(|c| [c, PI * c / 16.0]);
    let curve = recover::pipe(&FlowTable::pipe(1.0, &rows)?)?.with_band(0.95)?;
    println!("the fluid of the table has the viscosity {:.12} Pa s", curve.viscosity(2.0)?);
    assert!((curve.viscosity(2.0)? - 2.0).abs() < 1e-10);
    Ok(())
}

//! A disc is registered to the letter C: a linear elastic body cannot follow, a viscous fluid can.
#![expect(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use piola::registration::{Image, ImageGrid, Interpolant, Registration, RegistrationModel};

/// Samples along each side; the picture is 128 mm wide.
const SIZE: usize = 128;

/// An image with edges some two samples wide, from a distance to the edge in m, positive inside.
fn shape(distance: impl Fn(f64, f64) -> f64) -> Result<Image<2, f64>, Box<dyn Error>> {
    let grid = ImageGrid::new([SIZE, SIZE], [1e-3, 1e-3])?;
    let soft = |inside: f64| 1.0 / (1.0 + (-inside / 0.5e-3).exp());
    Ok(Image::from_fn(grid, |[y, x]| soft(distance(x - 0.064, y - 0.064)))?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let disc = shape(|x, y| 0.032 - x.hypot(y))?;
    let letter = shape(|x, y| {
        let ring = 0.0115 - (x.hypot(y) - 0.031).abs();
        let mouth = x.min(0.010 - y.abs());
        ring.min(-mouth)
    })?;
    println!("before: Dice {:.3}", disc.dice(&letter, 0.5)?);

    let models =
        [("elastic", RegistrationModel::elastic(0.0, 0.1)?), ("fluid", RegistrationModel::viscous_fluid(0.0, 1.0)?)];
    for (name, model) in models {
        let found = Registration::new(model).run(&letter, &disc)?;
        let dice = found.map.warp(&disc, Interpolant::Linear)?.dice(&letter, 0.5)?;
        let least = found.map.least_jacobian();
        println!("{name}: Dice {dice:.3}, least Jacobian {least:.4}");
        if name == "fluid" {
            let inverse = found.map.inverse()?;
            let defect = found.map.after(&inverse)?.largest_displacement();
            println!("{name}: the map after its inverse moves no sample by more than {defect:.0e} m");
            assert!(0.98 < dice && 0.0 < least && defect < 0.5e-3);
        } else {
            assert!(dice < 0.93);
        }
    }
    Ok(())
}

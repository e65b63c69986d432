//! Probe.
use piola_registration::*;
use std::time::Instant;
fn main() -> Result<(), RegistrationError> {
    let args: Vec<String> = std::env::args().collect();
    let n: usize = args.get(2).map_or(128, |s| s.parse().unwrap());
    let model = if args.get(1).is_some_and(|s| s.starts_with('e')) {
        RegistrationModel::elastic(0.0, 0.1)?
    } else {
        RegistrationModel::viscous_fluid(0.0, 1.0)?
    };
    let h = 1.0 / n as f64;
    let grid = ImageGrid::new([n, n], [h, h])?;
    let soft = |d: f64| 1.0 / (1.0 + (d / (0.5 * h)).exp());
    let disc = Image::from_fn(grid, |[y, x]| soft((x - 0.5).hypot(y - 0.5) - 0.25))?;
    let letter = Image::from_fn(grid, |[y, x]| {
        let (x, y) = (x - 0.5, y - 0.5);
        let r = x.hypot(y);
        let ring = (r - 0.24).abs() - 0.09;
        let mouth = (y.abs() - 0.08).max(-x);
        soft(ring.max(-mouth))
    })?;
    let mut registration = Registration::new(model);
    if args.iter().any(|a| a == "sym") {
        registration = registration.symmetric();
    }
    if args.iter().any(|a| a == "ncc") {
        registration = registration.with_measure(SimilarityMeasure::CrossCorrelation);
    }
    if args.iter().any(|a| a == "mi") {
        registration = registration.with_measure(SimilarityMeasure::MutualInformation);
    }
    if args.iter().any(|a| a == "cubic") {
        registration = registration.with_interpolant(Interpolant::CubicSpline);
    }
    if let Some(s) = args.iter().find_map(|a| a.strip_prefix("step=")) {
        registration = registration.with_largest_step(s.parse().unwrap());
    }
    if let Some(s) = args.iter().find_map(|a| a.strip_prefix("steps=")) {
        registration = registration.with_steps(s.parse().unwrap());
    }
    if let Some(s) = args.iter().find_map(|a| a.strip_prefix("tol=")) {
        registration = registration.with_tolerance(s.parse().unwrap());
    }
    let start = Instant::now();
    let found = registration.run_observed(&letter, &disc, |p| {
        if p.step % 20 == 0 {
            println!("{p:?}");
        }
        std::ops::ControlFlow::Continue(())
    })?;
    println!("time {:?}", start.elapsed());
    for l in &found.levels {
        println!("{l:?}");
    }
    let warped = found.map.warp(&disc, Interpolant::Linear)?;
    println!(
        "dice before {} after {} least {}",
        disc.dice(&letter, 0.5)?,
        warped.dice(&letter, 0.5)?,
        found.map.least_jacobian()
    );
    let inverse = found.map.inverse()?;
    let one = found.map.after(&inverse)?.largest_displacement() / h;
    let two = inverse.after(&found.map)?;
    let mean = two.displacements().iter().map(|u| u[0].hypot(u[1])).sum::<f64>() / (n * n) as f64 / h;
    println!(
        "inverse: h(g) {one}  g(h) largest {} mean {mean} time {:?}",
        two.largest_displacement() / h,
        start.elapsed()
    );
    Ok(())
}

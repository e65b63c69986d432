//! Probe.
use piola_registration::*;
use std::time::Instant;
fn phantom<const D: usize>(args: &[String], n: usize) -> Result<(), RegistrationError> {
    let h = 1.0 / n as f64;
    let grid = ImageGrid::new([n; D], [h; D])?;
    let texture = |x: [f64; D]| -> f64 {
        use std::f64::consts::PI;
        let mut v = 0.0;
        for k in 1..=4 {
            let k = k as f64;
            v += (0..D)
                .map(|a| {
                    ((2.0 * k + 1.0) * PI * x[a] + 1.3 * k * (a as f64 + 1.0) + 0.7 * x[(a + 1) % D] * k * PI).sin()
                })
                .product::<f64>();
        }
        v
    };
    let amplitude: f64 = args.iter().find_map(|a| a.strip_prefix("amp=")).map_or(3.0, |s| s.parse().unwrap());
    let truth = |x: [f64; D]| -> [f64; D] {
        use std::f64::consts::PI;
        std::array::from_fn(|a| amplitude * h * (PI * x[a]).sin() * (PI * x[(a + 1) % D] * 2.0 + 0.4 * a as f64).cos())
    };
    let moving = Image::from_fn(grid, texture)?;
    let fixed = Image::from_fn(grid, |x| {
        let u = truth(x);
        texture(std::array::from_fn(|a| x[a] - u[a]))
    })?;
    for (name, model) in
        [("elastic", RegistrationModel::elastic(0.0, 0.1)?), ("fluid", RegistrationModel::viscous_fluid(0.0, 1.0)?)]
    {
        for measure in
            [SimilarityMeasure::SumOfSquares, SimilarityMeasure::CrossCorrelation, SimilarityMeasure::MutualInformation]
        {
            if args.iter().any(|a| a == "quick") && measure != SimilarityMeasure::SumOfSquares {
                continue;
            }
            let mut registration = Registration::new(model).with_measure(measure);
            if args.iter().any(|a| a == "sym") {
                registration = registration.symmetric();
            }
            if args.iter().any(|a| a == "cubic") {
                registration = registration.with_interpolant(Interpolant::CubicSpline);
            }
            if let Some(s) = args.iter().find_map(|a| a.strip_prefix("steps=")) {
                registration = registration.with_steps(s.parse().unwrap());
            }
            let start = Instant::now();
            let found = registration.run(&fixed, &moving)?;
            let time = start.elapsed();
            let errors: Vec<f64> = (0..grid.len())
                .map(|p| {
                    let t = truth(grid.place(p));
                    found.map.displacements()[p].iter().zip(t).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt() / h
                })
                .collect();
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            let worst = errors.iter().copied().fold(0.0, f64::max);
            println!(
                "{name} {measure:?} D={D} n={n} mean {mean:.4} worst {worst:.3} time {time:?} steps {:?} {:?} least {:.3}",
                found.levels.iter().map(|l| l.steps).collect::<Vec<_>>(),
                found.ending(),
                found.map.least_jacobian()
            );
        }
    }
    Ok(())
}
fn main() -> Result<(), RegistrationError> {
    let args: Vec<String> = std::env::args().collect();
    let n: usize = args.get(2).map_or(128, |s| s.parse().unwrap());
    if args.get(1).is_some_and(|s| s == "p2") {
        return phantom::<2>(&args, n);
    }
    if args.get(1).is_some_and(|s| s == "p3") {
        return phantom::<3>(&args, n);
    }
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
    let back = registration.run(&disc, &letter)?;
    for m in [found.map.after(&back.map)?, back.map.after(&found.map)?] {
        let mean = m.displacements().iter().map(|u| u[0].hypot(u[1])).sum::<f64>() / (n * n) as f64 / h;
        println!("both ways: largest {} mean {mean}", m.largest_displacement() / h);
    }
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

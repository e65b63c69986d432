use std::f64::consts::PI;

use piola_testkit::{Tol, assert_close_at_scale};

use super::{Direction, Line, LinePlan, TransformMemory, WIDTH};
use crate::grid::PointLocation;
use crate::walls::Parity;

/// Σ of products with cosines or sines, in slot i.
fn sums(x: &[f64], parity: Parity, location: PointLocation) -> Vec<f64> {
    let n = x.len();
    let last = n - 1;
    let entry = |i: usize, m: usize| match (location, parity) {
        (PointLocation::Cells, Parity::Cosine) => (PI * ((2 * m + 1) * i % (4 * n)) as f64 / (2 * n) as f64).cos(),
        (PointLocation::Cells, Parity::Sine) => {
            let i = if i == 0 { n } else { i };
            (PI * ((2 * m + 1) * i % (4 * n)) as f64 / (2 * n) as f64).sin()
        }
        (PointLocation::Nodes, Parity::Cosine) => {
            let weight = if m == 0 || m == last { 0.5 } else { 1.0 };
            weight * (PI * ((i * m) % (2 * last)) as f64 / last as f64).cos()
        }
        (PointLocation::Nodes, Parity::Sine) if m == 0 || m == last || i == 0 || i == last => 0.0,
        (PointLocation::Nodes, Parity::Sine) => (PI * ((i * m) % (2 * last)) as f64 / last as f64).sin(),
    };
    (0..n).map(|i| x.iter().enumerate().map(|(m, x)| x * entry(i, m)).sum()).collect()
}

#[test]
fn transforms_of_lines_equal_sums() {
    let mut compared = 0;
    for n in (2..=49).chain([60, 64, 65, 81, 100, 101, 127, 128, 129, 160, 257]) {
        for location in [PointLocation::Cells, PointLocation::Nodes] {
            if n == 2 && location == PointLocation::Nodes {
                continue;
            }
            for parity in [Parity::Cosine, Parity::Sine] {
                let lines: Vec<Vec<f64>> = (0..WIDTH)
                    .map(|lane| (0..n).map(|m| ((7 * m + 3 * lane) as f64 * 0.37).sin() + 0.1 * lane as f64).collect())
                    .collect();
                let mut panel: Vec<Line<f64>> =
                    (0..n).map(|m| piola_numerics::Lanes(std::array::from_fn(|lane| lines[lane][m]))).collect();
                let plan = LinePlan::<f64>::new(n, location);
                let mut memory = TransformMemory::new();
                plan.prepare(&mut memory);
                plan.run(Direction::ToModes, parity, &mut panel, &mut memory);
                let intervals = if location == PointLocation::Cells { n } else { n - 1 };
                let what = format!("{n} {location:?} {parity:?}");
                // The sums in the test have n terms each.
                let tol = Tol::ulps(16.0);
                for (lane, line) in lines.iter().enumerate() {
                    let actual: Vec<f64> = panel.iter().map(|entry| entry.0[lane]).collect();
                    assert_close_at_scale(&what, &actual, &sums(line, parity, location), (n as f64).sqrt(), tol);
                }
                plan.run(Direction::ToSamples, parity, &mut panel, &mut memory);
                for (lane, line) in lines.iter().enumerate() {
                    let actual: Vec<f64> = panel.iter().map(|entry| entry.0[lane] * 2.0 / intervals as f64).collect();
                    let mut expected = line.clone();
                    if location == PointLocation::Nodes && parity == Parity::Sine {
                        (expected[0], expected[n - 1]) = (0.0, 0.0);
                    }
                    assert_close_at_scale(&what, &actual, &expected, (n as f64).sqrt(), tol);
                }
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 2 * (2 * 59) - 2);
}

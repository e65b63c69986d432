//! Time and true error of static solutions on a cube: lines of JSON, and a figure of error against time.
//!
//! Options: `--out FOLDER` for `box-accuracy.svg` (default: no figure), `--largest N` cells along an axis (default 256).

use std::error::Error;
use std::path::PathBuf;

use piola_benches::boxes::measure::{Measured, differences, other_transforms, ours};
use piola_charts::{LogPanel, colour, figure, legend};

#[expect(clippy::print_stdout, reason = "the answer, for the script that sets it in tables")]
fn main() -> Result<(), Box<dyn Error>> {
    let (mut folder, mut largest) = (None, 256);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match (argument.as_str(), arguments.next()) {
            ("--out", Some(value)) => folder = Some(PathBuf::from(value)),
            ("--largest", Some(value)) => largest = value.parse()?,
            _ => return Err(format!("{argument}: there are --out FOLDER and --largest N").into()),
        }
    }
    let mut all = Vec::new();
    let mut keep = |measured: Measured| {
        println!("{}", measured.record());
        all.push(measured);
    };
    for points in [4, 6, 8, 10, 12, 16, 20, 24, 32, 64, 128, 256].into_iter().filter(|points| *points <= largest) {
        keep(ours::<f64>("piola f64", points, 1)?);
        if 32 <= points {
            keep(ours::<f64>("piola f64", points, 2)?);
            keep(ours::<f32>("piola f32", points, 1)?);
            keep(ours::<f32>("piola f32", points, 2)?);
        }
        if [32, 64, 128].contains(&points) {
            other_transforms(points)?.into_iter().for_each(&mut keep);
        }
        if [8, 16, 32, 64, 128].contains(&points) {
            keep(differences(points)?);
        }
    }
    if let Some(folder) = folder {
        std::fs::create_dir_all(&folder)?;
        std::fs::write(folder.join("box-accuracy.svg"), chart(&all))?;
    }
    Ok(())
}

/// Error against time of ours in double precision and of differences, on one thread.
fn chart(all: &[Measured]) -> String {
    let curve = |way: &str| -> Vec<(f64, f64)> {
        let points = all.iter().filter(|measured| measured.way == way && measured.threads == 1);
        points.map(|measured| (measured.seconds, measured.error)).collect()
    };
    let curves = vec![curve("piola f64"), curve("differences")];
    let names = [("eigenfunctions", colour(0)), ("differences and conjugate gradients", colour(1))];
    let panel =
        LogPanel { title: "", axes: ["time, s", "relative error"], marks: curves.concat(), curves, band: Vec::new() };
    figure((760, 480), "A smooth displacement of a cube: error against time, one core", &|area| {
        panel.draw(area)?;
        legend(area, &names)
    })
}

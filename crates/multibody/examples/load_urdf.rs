//! Loads a robot from its URDF file and prints the torques that hold it.
//!
//! ```sh
//! cargo run -p piola-multibody --features urdf --example load_urdf -- robot.urdf
//! ```
#![expect(clippy::print_stdout, reason = "it prints the torques")]

use piola_multibody::{FileInertias, Urdf, UrdfOptions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/../../testdata/golden/ur5.urdf");
    let path = std::env::args().nth(1).unwrap_or_else(|| default.to_owned());
    let options = UrdfOptions { inertias: FileInertias::AsGiven, ..UrdfOptions::default() };
    let robot = Urdf::read(path.as_ref(), options)?;
    let mut q = vec![0.0; robot.tree.coordinates()];
    robot.tree.neutral_configuration(&mut q)?;
    let mut torques = vec![0.0; robot.tree.freedoms()];
    robot.tree.gravity_forces(&mut robot.tree.workspace(), &q, &mut torques)?;
    println!("{}: {torques:?} N m", robot.name);
    Ok(())
}

//! Known deformations of real pictures are recovered within half a sample.

use std::f64::consts::PI;

use piola_images::{ImagesError, Picture};
use piola_registration::{DisplacementMap, Image, ImageGrid, Interpolant, Registration, RegistrationModel};

use crate::fixtures::data;

/// A smooth field that vanishes at the walls: `amplitude` samples, one to two periods along each side.
fn known<const D: usize>(grid: ImageGrid<D>, amplitude: f64) -> Result<DisplacementMap<D, f64>, ImagesError> {
    let sides = grid.sides();
    let spacing = grid.spacing();
    Ok(DisplacementMap::from_fn(grid, |place| {
        let share: [f64; D] = std::array::from_fn(|axis| place[axis] / sides[axis]);
        let bump: f64 = share.iter().map(|share| (PI * share).sin()).product();
        std::array::from_fn(|axis| {
            amplitude * spacing[axis] * bump * (2.0 * PI * share[(axis + 1) % D] + axis as f64).cos()
        })
    })?)
}

/// The mean error of the displacement over the samples, in samples, before and after.
fn errors<const D: usize>(
    moving: &Image<D, f64>,
    amplitude: f64,
    model: RegistrationModel,
) -> Result<[f64; 2], ImagesError> {
    let known = known(*moving.grid(), amplitude)?;
    let fixed = known.warp(moving, Interpolant::CubicSpline)?;
    let found = Registration::new(model).run(&fixed, moving)?;
    let spacing = moving.grid().spacing();
    let mean = |map: &DisplacementMap<D, f64>| {
        let distances =
            map.displacements().iter().zip(known.displacements()).map(|(u, exact)| {
                (0..D).map(|axis| ((u[axis] - exact[axis]) / spacing[axis]).powi(2)).sum::<f64>().sqrt()
            });
        distances.sum::<f64>() / moving.grid().len() as f64
    };
    assert!(0.0 < found.map.least_jacobian());
    Ok([mean(&DisplacementMap::identity(*moving.grid())), mean(&found.map)])
}

fn models() -> Result<[RegistrationModel; 2], ImagesError> {
    Ok([RegistrationModel::elastic(0.0, 0.05)?, RegistrationModel::viscous_fluid(0.0, 1.0)?])
}

#[test]
fn deformation_of_a_retina_is_recovered() -> Result<(), ImagesError> {
    let retina = Picture::<2>::read(data("microaneurysms.png"))?.to_image()?;
    for model in models()? {
        let [before, after] = errors(&retina, 4.0, model)?;
        assert!(1.0 < before && after < 0.5, "{model:?}: {before} {after}");
    }
    Ok(())
}

#[test]
fn deformation_of_a_head_is_recovered() -> Result<(), ImagesError> {
    let head = Picture::<3>::read(data("anatomical.nii.gz"))?.to_image()?;
    for model in models()? {
        let [before, after] = errors(&head, 3.0, model)?;
        assert!(0.7 < before && after < 0.5, "{model:?}: {before} {after}");
    }
    Ok(())
}

//! Rotations in the header of `NIfTI`: the quaternion and the affine map say the same.

use piola_images::{ImagesError, Picture, PicturePlacement, SampleType};
use piola_testkit::{Tol, assert_close};

use crate::fixtures::{Folder, content};

const SINGLE: Tol = Tol::stated(1e-6, "NIfTI places samples in single precision");

/// x turned about the unit vector n (Rodrigues), by the sine and cosine of half the angle.
fn turned(n: [f64; 3], [sin, cos]: [f64; 2], x: [f64; 3]) -> [f64; 3] {
    let along: f64 = n.iter().zip(x).map(|(n, x)| n * x).sum();
    let across = [n[1] * x[2] - n[2] * x[1], n[2] * x[0] - n[0] * x[2], n[0] * x[1] - n[1] * x[0]];
    std::array::from_fn(|k| {
        (cos * cos - sin * sin) * x[k] + 2.0 * sin * cos * across[k] + 2.0 * sin * sin * along * n[k]
    })
}

/// The directions of a picture whose file has its axes along the turned x, y and z of RAS, the third one perhaps the other way.
fn placement(n: [f64; 3], half: [f64; 2], handedness: f64) -> PicturePlacement<3> {
    let axis = |k: usize| {
        let mut unit = [0.0; 3];
        unit[k] = if k == 2 { handedness } else { 1.0 };
        let [right, anterior, superior] = turned(n, half, unit);
        [-right, -anterior, superior]
    };
    PicturePlacement { origin: [-12.5, 3.25, 40.0], directions: [axis(2), axis(1), axis(0)] }
}

fn single(bytes: &[u8], at: usize) -> f64 {
    f64::from(f32::from_le_bytes([0, 1, 2, 3].map(|k| bytes[at + k])))
}

/// Each of the four components of the quaternion is the largest once. b, c, d = n sin φ/2; without the affine map they place the picture.
#[test]
fn quaternion_is_that_of_the_rotation_and_places_the_picture_alone() -> Result<(), ImagesError> {
    let folder = Folder::new("quaternions");
    let axes = [[6.0, 2.0, -3.0], [2.0, -6.0, 3.0], [-3.0, 2.0, 6.0]].map(|n| n.map(|part| part / 7.0));
    let halves = [[0.6, 0.8], [-0.6, 0.8], [0.96, 0.28], [-0.96, 0.28]];
    let mut compared = 0;
    for (n, half) in axes.into_iter().flat_map(|n| halves.map(|half| (n, half))) {
        for handedness in [1.0, -1.0] {
            let expected = placement(n, half, handedness);
            let picture =
                Picture::new([2, 3, 4], [2.5, 0.5, 1.25], vec![7.0; 24], SampleType::U8)?.with_placement(expected)?;
            picture.write(folder.file("a.nii"))?;
            let name = format!("{half:?} about {n:?}, {handedness}");
            // Spacings are those of the header, although the columns of the affine map are rounded.
            let spacing = Picture::<3>::read(folder.file("a.nii"))?.spacing();
            assert_close(&name, &spacing, &[2.5, 0.5, 1.25], Tol::ulps(0.0));
            let mut bytes = content(&folder.file("a.nii"));
            let found = [76, 256, 260, 264].map(|at| single(&bytes, at));
            assert_close(&name, &found, &[handedness, half[0] * n[0], half[0] * n[1], half[0] * n[2]], SINGLE);
            // No affine map.
            bytes[254..256].copy_from_slice(&[0, 0]);
            let again = Picture::<3>::read(folder.with("b.nii", &bytes))?;
            assert_close(&name, &again.spacing(), &[2.5, 0.5, 1.25], Tol::ulps(1.0));
            assert_close(&name, &again.placement().origin, &expected.origin, Tol::ulps(1.0));
            let directions = [again.placement().directions, expected.directions];
            assert_close(&name, directions[0].as_flattened(), directions[1].as_flattened(), SINGLE);
            compared += 1;
        }
    }
    assert_eq!(compared, 24);
    Ok(())
}

/// The third axis of a plane is its normal, in both forms of the header.
#[test]
fn quaternion_of_a_plane_turns_the_third_axis_to_its_normal() -> Result<(), ImagesError> {
    let folder = Folder::new("turned-planes");
    let (n, half) = ([2.0 / 7.0, 6.0 / 7.0, 3.0 / 7.0], [0.6, 0.8]);
    let PicturePlacement { origin, directions: [_, directions @ ..] } = placement(n, half, 1.0);
    let expected = PicturePlacement { origin, directions };
    let picture = Picture::new([3, 4], [0.5, 1.25], vec![7.0; 12], SampleType::U8)?.with_placement(expected)?;
    picture.write(folder.file("a.nii"))?;
    let mut bytes = content(&folder.file("a.nii"));
    let found = [76, 256, 260, 264].map(|at| single(&bytes, at));
    assert_close("quaternion", &found, &[1.0, half[0] * n[0], half[0] * n[1], half[0] * n[2]], SINGLE);
    // The third of four numbers in each row of the affine map.
    let normal = [288, 304, 320].map(|at| single(&bytes, at));
    assert_close("normal", &normal, &turned(n, half, [0.0, 0.0, 1.0]), SINGLE);
    bytes[254..256].copy_from_slice(&[0, 0]);
    let again = Picture::<2>::read(folder.with("b.nii", &bytes))?;
    let directions = [again.placement().directions, expected.directions];
    assert_close("directions", directions[0].as_flattened(), directions[1].as_flattened(), SINGLE);
    Ok(())
}

/// Half a turn about x, y and z is exact.
#[test]
fn half_turns_come_back_from_the_quaternion() -> Result<(), ImagesError> {
    let folder = Folder::new("half-turns");
    for axis in 0..3 {
        let mut n = [0.0; 3];
        n[axis] = 1.0;
        let expected = placement(n, [1.0, 0.0], 1.0);
        let picture = Picture::new([2; 3], [1.0; 3], vec![7.0; 8], SampleType::U8)?.with_placement(expected)?;
        picture.write(folder.file("a.nii"))?;
        let mut bytes = content(&folder.file("a.nii"));
        bytes[254..256].copy_from_slice(&[0, 0]);
        let again = Picture::<3>::read(folder.with("b.nii", &bytes))?;
        let directions = [again.placement().directions, expected.directions];
        assert_close("directions", directions[0].as_flattened(), directions[1].as_flattened(), Tol::ulps(1.0));
    }
    Ok(())
}

/// The lengths of directions do not matter, whichever they are.
#[test]
fn directions_become_unit_vectors() -> Result<(), ImagesError> {
    let directions = [[0.0, 3.0, 4.0], [0.0, -0.08, 0.06], [200.0, 0.0, 0.0]];
    let long = PicturePlacement { directions, ..PicturePlacement::default() };
    let picture = Picture::new([2; 3], [1.0; 3], vec![7.0; 8], SampleType::U8)?.with_placement(long)?;
    let expected = [0.0, 0.6, 0.8, 0.0, -0.8, 0.6, 1.0, 0.0, 0.0];
    assert_close("directions", picture.placement().directions.as_flattened(), &expected, Tol::ulps(2.0));
    // Two samples further along the second axis.
    assert_close("point", &picture.point([0.0, 2.0, 0.0]), &[0.0, -1.6, 1.2], Tol::ulps(2.0));
    Ok(())
}

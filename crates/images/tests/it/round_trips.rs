//! What is written comes back.

use piola_images::{AnyPicture, ImagesError, Picture, PicturePlacement, SampleType};
use piola_testkit::{Tol, assert_close, assert_each_close};

use crate::fixtures::{Folder, oblique, plane, space};

const SINGLE: Tol = Tol::stated(1e-6, "NIfTI places samples in single precision");

const ALL: [SampleType; 8] = [
    SampleType::U8,
    SampleType::I8,
    SampleType::U16,
    SampleType::I16,
    SampleType::U32,
    SampleType::I32,
    SampleType::F32,
    SampleType::F64,
];

#[test]
fn pictures_in_two_dimensions_come_back() -> Result<(), ImagesError> {
    let folder = Folder::new("planes");
    let mut compared = 0;
    for (name, types) in [
        ("a.png", &[SampleType::U8, SampleType::U16][..]),
        ("a.tif", &ALL[..]),
        ("a.TIFF", &ALL[..]),
        ("a.nii", &ALL[..]),
        ("a.nii.gz", &ALL[..]),
        ("a.nrrd", &ALL[..]),
    ] {
        for &sample_type in types {
            let picture =
                plane(sample_type)?.with_values(plane(sample_type)?.values().iter().map(|v| v / 2.0).collect())?;
            picture.write(folder.file(name))?;
            let again = Picture::<2>::read(folder.file(name))?;
            let expected: Vec<_> = picture.values().iter().map(|value| sample_type.nearest(*value)).collect();
            assert_eq!((again.values(), again.sample_type()), (&expected[..], sample_type), "{name}");
            assert_eq!((again.sizes(), again.spacing()), ([4, 5], [1.0; 2]), "{name}");
            assert_each_close(
                name,
                again.placement().directions.as_flattened(),
                &[0.0, 1.0, 0.0, 1.0, 0.0, 0.0],
                SINGLE,
            );
            assert!(matches!(AnyPicture::read(folder.file(name))?, AnyPicture::Plane(_)));
            compared += 1;
        }
    }
    assert_eq!(compared, 42);
    assert_eq!(folder.names().len(), 6, "no file besides: {:?}", folder.names());
    Ok(())
}

#[test]
fn pictures_in_three_dimensions_come_back_with_their_places() -> Result<(), ImagesError> {
    let folder = Folder::new("spaces");
    for name in ["a.nii", "a.nii.gz", "a.nrrd"] {
        for sample_type in ALL {
            let picture = space(sample_type)?;
            picture.write(folder.file(name))?;
            let again = Picture::<3>::read(folder.file(name))?;
            let expected: Vec<_> = picture.values().iter().map(|value| sample_type.nearest(*value)).collect();
            assert_eq!((again.values(), again.sample_type()), (&expected[..], sample_type), "{name}");
            assert_close(name, &again.spacing(), &picture.spacing(), SINGLE);
            assert_close(name, &again.placement().origin, &oblique().origin, SINGLE);
            let directions = oblique().directions;
            assert_close(name, again.placement().directions.as_flattened(), directions.as_flattened(), SINGLE);
            assert!(matches!(AnyPicture::read(folder.file(name))?, AnyPicture::Space(_)));
        }
    }
    Ok(())
}

#[test]
fn nrrd_keeps_every_digit_of_the_place() -> Result<(), ImagesError> {
    let folder = Folder::new("digits");
    let thirds = PicturePlacement { origin: [1.0 / 3.0, -2.0 / 7.0, 1e-17], ..PicturePlacement::default() };
    let picture =
        Picture::new([2, 2, 2], [0.1, 1.0 / 3.0, 1e7 / 3.0], vec![0.1; 8], SampleType::F64)?.with_placement(thirds)?;
    picture.write(folder.file("a.nrrd"))?;
    let again = Picture::<3>::read(folder.file("a.nrrd"))?;
    assert_eq!((again.spacing(), again.placement()), (picture.spacing(), picture.placement()));
    assert_eq!(again.values(), picture.values());
    Ok(())
}

/// A plane that stands upright in space.
#[test]
fn plane_in_space_keeps_its_place() -> Result<(), ImagesError> {
    let folder = Folder::new("upright");
    let upright = PicturePlacement { origin: [1.0, 2.0, 3.0], directions: [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]] };
    let picture = plane(SampleType::U8)?.with_spacing([2.0, 3.0])?.with_placement(upright)?;
    for name in ["a.nii.gz", "a.nrrd"] {
        picture.write(folder.file(name))?;
        let again = Picture::<2>::read(folder.file(name))?;
        assert_close(name, again.placement().directions.as_flattened(), upright.directions.as_flattened(), SINGLE);
        assert_eq!((again.spacing(), again.placement().origin), ([2.0, 3.0], [1.0, 2.0, 3.0]), "{name}");
        assert!(again.distance_of_corners(&picture) < 1e-5);
    }
    Ok(())
}

#[test]
fn values_beyond_the_type_become_its_end() -> Result<(), ImagesError> {
    let folder = Folder::new("clamped");
    let picture = Picture::new([2, 2], [1.0; 2], vec![-3.0, 0.4, 0.6, 300.0], SampleType::U8)?;
    picture.write(folder.file("a.png"))?;
    assert_eq!(Picture::<2>::read(folder.file("a.png"))?.values(), [0.0, 0.0, 1.0, 255.0]);
    Ok(())
}

#[test]
fn formats_refuse_what_they_cannot_hold() -> Result<(), ImagesError> {
    let folder = Folder::new("refused");
    let signed = plane(SampleType::I16)?.write(folder.file("a.png"));
    assert!(matches!(signed, Err(ImagesError::Unsupported { .. })), "{signed:?}");
    for name in ["a.png", "a.tif"] {
        let solid = space(SampleType::U8)?.write(folder.file(name));
        assert!(matches!(solid, Err(ImagesError::Dimension { found: 3, .. })), "{solid:?}");
    }
    for name in ["a.jpg", "a", "a.npy"] {
        let unknown = plane(SampleType::U8)?.write(folder.file(name));
        assert!(matches!(unknown, Err(ImagesError::UnknownFormat { .. })), "{unknown:?}");
    }
    plane(SampleType::U8)?.write(folder.file("a.nii"))?;
    let solid = Picture::<3>::read(folder.file("a.nii"));
    assert!(matches!(solid, Err(ImagesError::Dimension { found: 2, .. })), "{solid:?}");
    assert_eq!(folder.names(), ["a.nii"]);
    Ok(())
}

/// A picture on another grid of the same place has the same values there.
#[test]
fn resampled_picture_equals_the_function_it_samples() -> Result<(), ImagesError> {
    let place = |x: [f64; 3]| 3.0 * x[0] - 2.0 * x[1] + 0.5 * x[2];
    let sampled = |sizes: [usize; 3], spacing, placement| -> Result<Picture<3>, ImagesError> {
        let empty = Picture::new(sizes, spacing, vec![0.0; sizes.iter().product()], SampleType::F64)?
            .with_placement(placement)?;
        let [_, n1, n2] = sizes;
        let index = |position: usize| [position / (n1 * n2), position / n2 % n1, position % n2].map(|i| i as f64);
        empty.with_values((0..empty.values().len()).map(|position| place(empty.point(index(position)))).collect())
    };
    let tilted =
        PicturePlacement { origin: [4.0, 5.0, 4.0], directions: [[0.0, 0.6, 0.8], [0.0, 0.8, -0.6], [1.0, 0.0, 0.0]] };
    let coarse = sampled([3, 4, 5], [1.5, 1.0, 2.0], tilted)?;
    // The same box from two of its corners.
    let mirrored = PicturePlacement {
        origin: [15.0, 0.0, 11.0],
        directions: [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
    };
    for placement in [PicturePlacement::default(), mirrored] {
        let fine = sampled([12, 14, 16], [1.0, 1.0, 1.0], placement)?;
        let found = fine.resampled(&coarse)?;
        assert_close("resampled", found.values(), coarse.values(), Tol::ulps(64.0));
        assert_eq!(found.placement(), coarse.placement());
    }
    Ok(())
}

#[test]
fn sheared_axes_are_refused_by_registration_alone() -> Result<(), ImagesError> {
    let sheared = PicturePlacement { directions: [[0.0, 1.0, 0.0], [0.8, 0.6, 0.0]], ..PicturePlacement::default() };
    let refused = plane(SampleType::U8)?.with_placement(sheared)?.to_image::<f64>();
    assert!(matches!(refused, Err(ImagesError::NotPerpendicular { axes: [0, 1], .. })), "{refused:?}");
    Ok(())
}

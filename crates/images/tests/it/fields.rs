//! Displacement fields in files.

use piola_images::{Bitmap, DisplacementField, ImagesError, Picture, PicturePlacement, SampleType, write_npy};
use piola_registration::{DisplacementMap, ImageGrid};
use piola_testkit::{Tol, assert_close};

use crate::fixtures::{Folder, content, oblique};

const SINGLE: Tol = Tol::stated(1e-6, "the directions of NIfTI are in single precision");

fn map() -> Result<DisplacementMap<3, f64>, ImagesError> {
    let grid = ImageGrid::new([3, 4, 5], [2.5, 0.5, 1.25])?;
    Ok(DisplacementMap::from_fn(grid, |[z, y, x]| [0.1 * y * x, 0.2 - z, 0.03 * x * x])?)
}

#[test]
fn field_comes_back_from_every_format() -> Result<(), ImagesError> {
    let folder = Folder::new("fields");
    let picture = Picture::new([3, 4, 5], [2.5, 0.5, 1.25], vec![0.0; 60], SampleType::U8)?.with_placement(oblique())?;
    for name in ["a.nii", "a.nii.gz", "a.nrrd"] {
        DisplacementField::of(&map()?, &picture)?.write(folder.file(name))?;
        let again = DisplacementField::<3>::read(folder.file(name))?;
        let (found, expected) = (again.map.displacements(), map()?);
        assert_close(name, found.as_flattened(), expected.displacements().as_flattened(), SINGLE);
        assert_close(name, &again.placement.origin, &oblique().origin, SINGLE);
    }
    Ok(())
}

/// In the plane vectors have two components; in a plane upright in space, three.
#[test]
fn field_of_a_plane_comes_back() -> Result<(), ImagesError> {
    let folder = Folder::new("plane-fields");
    let grid = ImageGrid::new([3, 4], [1.0, 2.0])?;
    let map = DisplacementMap::from_fn(grid, |[y, x]| [0.1 * y * x, 0.2 * x])?;
    let flat = Picture::new([3, 4], [1.0, 2.0], vec![0.0; 12], SampleType::U8)?;
    let upright = PicturePlacement { origin: [1.0, 2.0, 3.0], directions: [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]] };
    for picture in [flat.clone(), flat.with_placement(upright)?] {
        for name in ["a.nii", "a.nrrd"] {
            DisplacementField::of(&map, &picture)?.write(folder.file(name))?;
            let again = DisplacementField::<2>::read(folder.file(name))?;
            assert_close(name, again.map.displacements().as_flattened(), map.displacements().as_flattened(), SINGLE);
        }
    }
    Ok(())
}

/// d = −u along the directions: u = 2 mm along the last axis, which points to −x.
#[test]
fn vectors_are_minus_u_in_lps() -> Result<(), ImagesError> {
    let folder = Folder::new("signs");
    let mirrored = PicturePlacement {
        directions: [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
        ..PicturePlacement::default()
    };
    let picture = Picture::new([2; 3], [1.0; 3], vec![0.0; 8], SampleType::U8)?.with_placement(mirrored)?;
    let map = DisplacementMap::new(ImageGrid::new([2; 3], [1.0; 3])?, vec![[0.0, 0.0, 2.0]; 8])?;
    DisplacementField::of(&map, &picture)?.write(folder.file("a.nii"))?;
    let bytes = content(&folder.file("a.nii"));
    assert_eq!(&bytes[68..70], 1007_i16.to_le_bytes());
    let dim: Vec<u8> = [5_i16, 2, 2, 2, 1, 3].into_iter().flat_map(i16::to_le_bytes).collect();
    assert_eq!(&bytes[40..52], dim);
    // The x components of all eight samples come first.
    assert_eq!(&bytes[352..360], 2_f64.to_le_bytes());
    assert_eq!(&bytes[352 + 64..360 + 64], 0_f64.to_le_bytes());
    // The code of displacement vectors means RAS: x and y change their signs.
    let mut turned = bytes;
    turned[68..70].copy_from_slice(&1006_i16.to_le_bytes());
    let again = DisplacementField::<3>::read(folder.with("ras.nii", &turned))?;
    assert_close("RAS", &again.map.displacements()[0], &[0.0, 0.0, -2.0], Tol::ulps(4.0));
    Ok(())
}

#[test]
fn npy_has_the_header_that_numpy_reads() -> Result<(), ImagesError> {
    let folder = Folder::new("npy");
    let path = folder.file("a.npy");
    write_npy(&path, &[2, 3], &[0.0, 1.0, 2.0, 3.0, 4.0, 5.5])?;
    let bytes = content(&path);
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    assert_eq!(usize::from(u16::from_le_bytes([bytes[8], bytes[9]])), 128 - 10);
    let header = String::from_utf8_lossy(&bytes[10..128]);
    assert_eq!(header.trim_end(), "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3,), }");
    assert_eq!(&bytes[bytes.len() - 8..], 5.5_f64.to_le_bytes());
    let wrong = write_npy(&path, &[2, 2], &[0.0; 6]);
    assert!(matches!(wrong, Err(ImagesError::Malformed { .. })), "{wrong:?}");
    assert!(matches!(write_npy(folder.file("a.txt"), &[1], &[0.0]), Err(ImagesError::UnknownFormat { .. })));
    let picture = Picture::new([3, 4, 5], [2.5, 0.5, 1.25], vec![0.0; 60], SampleType::U8)?;
    DisplacementField::of(&map()?, &picture)?.write(&path)?;
    assert_eq!(content(&path).len(), 128 + 8 * 180);
    Ok(())
}

#[test]
fn map_of_other_sizes_is_refused() -> Result<(), ImagesError> {
    let picture = Picture::new([3, 4, 6], [1.0; 3], vec![0.0; 72], SampleType::U8)?;
    let refused = DisplacementField::of(&map()?, &picture);
    assert!(matches!(refused, Err(ImagesError::UnequalSizes { axis: 2, found: 5, expected: 6 })), "{refused:?}");
    Ok(())
}

#[test]
fn colours_become_luminance() -> Result<(), ImagesError> {
    let folder = Folder::new("colours");
    let colours = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]];
    Bitmap { width: 2, height: 2, pixels: colours.to_vec() }.write(folder.file("a.png"))?;
    let picture = Picture::<2>::read(folder.file("a.png"))?;
    assert!(picture.is_luminance());
    assert_eq!(picture.values(), [54.0, 182.0, 18.0, 255.0]);
    Ok(())
}

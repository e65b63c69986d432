//! Files that other programs wrote.

use piola_images::{DisplacementField, ImagesError, Picture, SampleType};
use piola_testkit::{Tol, assert_close};

use crate::fixtures::{Folder, content, data};

/// Written by SPM with the most significant byte first; RAS, with x to the left.
#[test]
fn head_of_nibabel_is_read_with_its_place_and_written_back_with_both_forms() -> Result<(), ImagesError> {
    let folder = Folder::new("head");
    let head = Picture::<3>::read(data("anatomical.nii.gz"))?;
    assert_eq!((head.sizes(), head.spacing(), head.sample_type()), ([25, 41, 33], [2.0; 3], SampleType::I16));
    // nibabel's affine map: rows (−2, 0, 0, 32), (0, 2, 0, −40), (0, 0, 2, −16) in RAS.
    assert_close("place", &head.placement().origin, &[-32.0, 40.0, -16.0], Tol::ulps(1.0));
    assert_eq!(head.placement().directions, [[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]]);
    // nibabel: sum and the sample at (16, 20, 12).
    assert_close("sum", &[head.values().iter().sum()], &[284_166_082.0], Tol::ulps(1.0));
    assert_close("sample", &[head.values()[(12 * 41 + 20) * 33 + 16]], &[11_881.0], Tol::ulps(1.0));
    head.write(folder.file("again.nii"))?;
    let again = Picture::<3>::read(folder.file("again.nii"))?;
    assert_eq!(again, head);
    let bytes = content(&folder.file("again.nii"));
    // Both codes are 2, as in the original.
    assert_eq!(&bytes[252..256], [2, 0, 2, 0]);
    Ok(())
}

/// Scaled samples, two forms with different codes, one sform that disagrees with the qform; most significant byte first.
#[test]
fn forms_and_scaling_are_kept() -> Result<(), ImagesError> {
    let folder = Folder::new("forms");
    let mut header = vec![0_u8; 352];
    let mut put = |at: usize, bytes: &[u8]| header[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, &348_i32.to_be_bytes());
    for (number, size) in [3_i16, 2, 3, 2].into_iter().enumerate() {
        put(40 + 2 * number, &size.to_be_bytes());
    }
    put(70, &4_i16.to_be_bytes());
    put(72, &16_i16.to_be_bytes());
    for (number, spacing) in [-1.0_f32, 1.5, 2.5, 3.5].into_iter().enumerate() {
        put(76 + 4 * number, &spacing.to_be_bytes());
    }
    for (at, number) in [(108, 352.0_f32), (112, 0.5), (116, -7.0), (256, 0.6), (268, 11.0), (272, 12.0), (276, 13.0)] {
        put(at, &number.to_be_bytes());
    }
    put(123, &[2]);
    put(252, &1_i16.to_be_bytes());
    put(254, &4_i16.to_be_bytes());
    let rows = [[1.5_f32, 0.0, 0.0, 1.0], [0.0, 0.0, -3.5, 2.0], [0.0, 2.5, 0.0, 3.0]];
    for (number, value) in rows.as_flattened().iter().enumerate() {
        put(280 + 4 * number, &value.to_be_bytes());
    }
    put(344, b"n+1\0");
    for value in 0..12_i16 {
        header.extend(value.to_be_bytes());
    }
    let picture = Picture::<3>::read(folder.with("a.nii", &header))?;
    assert_eq!((picture.spacing(), picture.values()[3]), ([3.5, 2.5, 1.5], -5.5));
    assert_close("place", &picture.placement().origin, &[-1.0, -2.0, 3.0], Tol::ulps(1.0));
    assert_eq!(picture.placement().directions, [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]]);
    picture.write(folder.file("b.nii"))?;
    let bytes = content(&folder.file("b.nii"));
    let turned = |range: std::ops::Range<usize>| -> Vec<u8> {
        header[range].as_chunks::<4>().0.iter().flat_map(|chunk| chunk.iter().rev().copied()).collect()
    };
    assert_eq!(bytes[256..328], turned(256..328), "quaternion, offsets and rows");
    assert_eq!(bytes[76..92], turned(76..92), "handedness and spacings");
    assert_eq!(bytes[112..120], turned(112..120), "slope and offset");
    assert_eq!((&bytes[252..256], &bytes[352..360]), (&[1, 0, 4, 0][..], &[0, 0, 1, 0, 2, 0, 3, 0][..]));
    assert_eq!(Picture::<3>::read(folder.file("b.nii"))?, picture);
    // Without the affine map the quaternion counts: half a turn's share about x, and a mirrored third axis.
    header[254..256].copy_from_slice(&[0, 0]);
    let picture = Picture::<3>::read(folder.with("c.nii", &header))?;
    let (s, c) = (2.0 * 0.6 * 0.8, 0.64 - 0.36);
    assert_close("origin", &picture.placement().origin, &[-11.0, -12.0, 13.0], Tol::ulps(4.0));
    let expected = [[0.0, -s, -c], [0.0, -c, s], [-1.0, 0.0, 0.0]];
    let rounding = Tol::stated(1e-7, "the quaternion is in single precision");
    assert_close("directions", picture.placement().directions.as_flattened(), expected.as_flattened(), rounding);
    Ok(())
}

/// The header that `SimpleITK` 2.5 writes for a vector image.
#[test]
fn vectors_in_the_header_of_simpleitk_are_read() -> Result<(), ImagesError> {
    let folder = Folder::new("itk");
    let header = "NRRD0004\n# Complete NRRD file format specification at:\n# http://teem.sourceforge.net/nrrd/format.html\n\
                  type: double\ndimension: 4\nspace: left-posterior-superior\nsizes: 3 2 2 2\n\
                  space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: vector domain domain domain\n\
                  endian: little\nencoding: raw\nspace origin: (10,20,30)\n\n";
    let mut bytes = header.as_bytes().to_vec();
    for sample in 0..8_u8 {
        for component in [1.0, 2.0, 0.25 * f64::from(sample)] {
            bytes.extend(component.to_le_bytes());
        }
    }
    let field = DisplacementField::<3>::read(folder.with("a.nrrd", &bytes))?;
    assert_close("place", &field.placement.origin, &[10.0, 20.0, 30.0], Tol::ulps(1.0));
    assert_close("place", &field.map.displacements()[3], &[-0.75, -2.0, -1.0], Tol::ulps(1.0));
    Ok(())
}

/// A TIFF file of four pixels by hand: three bytes each, in one strip without compression.
#[test]
fn colours_of_tiff_become_their_luminance() -> Result<(), ImagesError> {
    let folder = Folder::new("tiff-colours");
    let mut bytes = b"II*\0\x08\0\0\0\x09\0".to_vec();
    // Width, height, bits (three numbers at 122), compression, RGB, the strip at 128, samples, rows of a strip, bytes of it.
    let entries = [
        (256_u16, 1_u32, 2_u32),
        (257, 1, 2),
        (258, 3, 122),
        (259, 1, 1),
        (262, 1, 2),
        (273, 1, 128),
        (277, 1, 3),
        (278, 1, 2),
        (279, 1, 12),
    ];
    for (tag, count, value) in entries {
        bytes.extend(tag.to_le_bytes());
        // Short whole numbers.
        bytes.extend(3_u16.to_le_bytes());
        bytes.extend(count.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0; 4]);
    bytes.extend([8, 0, 8, 0, 8, 0]);
    bytes.extend([255, 0, 0, 0, 255, 0, 0, 0, 255, 100, 100, 100]);
    let picture = Picture::<2>::read(folder.with("a.tif", &bytes))?;
    assert!(picture.is_luminance());
    // 255 times 0.2126, 0.7152 and 0.0722, to whole numbers; grey stays as it is.
    assert_eq!(picture.values(), [54.0, 182.0, 18.0, 100.0]);
    Ok(())
}

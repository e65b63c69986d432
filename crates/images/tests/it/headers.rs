//! Headers that announce impossible things are refused by name, before memory is allocated.

use piola_images::{AnyPicture, ImagesError, Picture, SampleType};

use crate::fixtures::{Folder, content, space};

fn nrrd(fields: &str) -> Vec<u8> {
    format!("NRRD0004\n{fields}\n\n").into_bytes()
}

#[test]
fn huge_sizes_are_refused_without_allocation() -> Result<(), ImagesError> {
    let folder = Folder::new("huge");
    for (sizes, dimension) in
        [("10000 10000 10000", 3), ("18446744073709551615 18446744073709551615 2", 3), ("0 99999999999", 2)]
    {
        let text = format!("type: double\ndimension: {dimension}\nsizes: {sizes}\nencoding: raw\nendian: little");
        let refused = AnyPicture::read(folder.with("huge.nrrd", &nrrd(&text)));
        assert!(matches!(refused, Err(ImagesError::TooLarge { .. })), "{refused:?}");
    }
    // 600³ samples are allowed, but this file does not hold them; nor can it when packed.
    for encoding in ["raw", "gzip", "ascii"] {
        let text = format!("type: double\ndimension: 3\nsizes: 600 600 600\nencoding: {encoding}\nendian: little");
        let refused = AnyPicture::read(folder.with("announced.nrrd", &nrrd(&text)));
        assert!(matches!(refused, Err(ImagesError::Truncated { .. })), "{refused:?}");
    }
    space(SampleType::U8)?.write(folder.file("a.nii"))?;
    let mut bytes = content(&folder.file("a.nii"));
    for axis in 1..=3 {
        bytes[40 + 2 * axis..42 + 2 * axis].copy_from_slice(&32_000_i16.to_le_bytes());
    }
    let refused = AnyPicture::read(folder.with("huge.nii", &bytes));
    assert!(matches!(refused, Err(ImagesError::TooLarge { .. })), "{refused:?}");
    Ok(())
}

/// The fields of a good header with one exchanged, and the error that names it.
#[test]
fn bad_nrrd_headers_are_named() {
    let folder = Folder::new("nrrd-headers");
    let good = ["type: uint8", "dimension: 2", "sizes: 2 3", "encoding: ascii", "spacings: 0.5 2"];
    let read = |fields: &[&str]| {
        let mut bytes = nrrd(&fields.join("\n"));
        bytes.extend_from_slice(b"1 2 3\n4 5 6");
        AnyPicture::read(folder.with("a.nrrd", &bytes))
    };
    let Ok(AnyPicture::Plane(picture)) = read(&good) else { panic!("{:?}", read(&good)) };
    assert_eq!((picture.sizes(), picture.spacing()), ([3, 2], [2.0, 0.5]));
    assert_eq!(picture.values(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    for (at, field, what) in [
        (0, "type: block", "samples of type `block`"),
        (0, "type: longlong", "samples of type `longlong`"),
        (0, "kind: uint8", "the field `type` is missing"),
        (1, "dimension: 0", "dimension: 0; 1 to 16 are valid"),
        (1, "dimension: 99999999999999999999", "1 to 16 are valid"),
        (1, "dimension: 3", "3 whole numbers are expected"),
        (2, "sizes: 2 -3", "2 whole numbers are expected"),
        (2, "sizes: 6 1", "size 1 along axis 1"),
        (2, "sizes: 2 0", "size 0 along axis 1"),
        (2, "sizes: 2 4", "is truncated"),
        (3, "encoding: bzip2", "the encoding `bzip2`"),
        (4, "spacings: 0 2", "spacing 0 along axis 0"),
        (4, "spacings: inf 2", "spacing inf along axis 0"),
        (4, "spacings: 1", "2 numbers are expected"),
        (4, "space directions: (1,0)", "2 vectors are expected"),
        (4, "space directions: (1,0) (0,nan)", "along axis 1"),
        (4, "space directions: (0,0) (0,1)", "spacing 0 along axis 0"),
        (4, "space origin: (nan,0)", "is not finite"),
        (4, "space: inferior-left-posterior", "the space `inferior-left-posterior`"),
        (4, "data file: b.raw", "samples in another file"),
        (4, "byte skip: -1", "byte skip"),
        (4, "kinds: domain RGB-color", "of kind `RGB-color`"),
        (4, "kinds: RGB-color domain", "2 numbers at each sample"),
    ] {
        let mut fields = good;
        fields[at] = field;
        match read(&fields) {
            // Leaving out components leaves one axis; either error is right.
            Err(error) if field.starts_with("kinds: RGB") => assert!(error.to_string().contains("a.nrrd"), "{error}"),
            Err(error) => assert!(error.to_string().contains(what), "{field}: {error}"),
            Ok(picture) => panic!("{field}: {picture:?}"),
        }
    }
}

#[test]
fn bad_nifti_headers_are_named() -> Result<(), ImagesError> {
    let folder = Folder::new("nifti-headers");
    space(SampleType::I16)?.write(folder.file("a.nii"))?;
    let good = content(&folder.file("a.nii"));
    let (nan, zero) = (f32::NAN.to_le_bytes(), 0_f32.to_le_bytes());
    let patches: [(usize, &[u8], &str); 14] = [
        (0, &540_i32.to_le_bytes(), "NIfTI-2"),
        (0, &7_i32.to_le_bytes(), "7 bytes, not 348"),
        (40, &0_i16.to_le_bytes(), "dim[0] = 0"),
        (42, &1_i16.to_le_bytes(), "size 1 along axis 0"),
        (44, &0_i16.to_le_bytes(), "size 0 along axis 1"),
        (44, &(-4_i16).to_le_bytes(), "bytes of samples"),
        (70, &128_i16.to_le_bytes(), "datatype 128"),
        (108, &nan, "vox_offset = NaN"),
        (108, &1e30_f32.to_le_bytes(), "vox_offset"),
        (112, &nan, "scl_slope = NaN"),
        (280, &nan, "NaN"),
        (344, b"ni1\0", "in another file"),
        (344, b"abc\0", "NIfTI"),
        (280, &zero, "spacing"),
    ];
    for (at, bytes, what) in patches {
        let mut spoiled = good.clone();
        spoiled[at..at + bytes.len()].copy_from_slice(bytes);
        if what == "spacing" {
            // The first column of the affine map.
            for row in 0..3 {
                spoiled[280 + 16 * row..284 + 16 * row].copy_from_slice(&zero);
            }
        }
        match Picture::<3>::read(folder.with("bad.nii", &spoiled)) {
            Err(error) => assert!(error.to_string().contains(what), "{at} {what}: {error}"),
            Ok(picture) => panic!("{at} {what}: {picture:?}"),
        }
    }
    Ok(())
}

#[test]
fn values_that_are_not_finite_are_named() {
    let folder = Folder::new("nan");
    let mut bytes = nrrd("type: float\ndimension: 2\nsizes: 2 2\nencoding: raw\nendian: little");
    for value in [1.0_f32, 2.0, f32::NAN, 4.0] {
        bytes.extend(value.to_le_bytes());
    }
    let refused = AnyPicture::read(folder.with("a.nrrd", &bytes));
    assert!(matches!(refused, Err(ImagesError::NotFinite { index: 2, .. })), "{refused:?}");
}

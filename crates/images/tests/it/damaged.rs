//! Truncated and spoiled files are refused, and never panic.

use piola_images::{AnyPicture, DisplacementField, ImagesError, Picture, SampleType};
use piola_registration::{DisplacementMap, ImageGrid};

use crate::fixtures::{Folder, content, plane, space};

/// Files of every format, small.
fn files(folder: &Folder) -> Result<Vec<&'static str>, ImagesError> {
    plane(SampleType::U16)?.write(folder.file("a.png"))?;
    plane(SampleType::F32)?.write(folder.file("a.tif"))?;
    space(SampleType::I16)?.write(folder.file("a.nii"))?;
    space(SampleType::I16)?.write(folder.file("a.nii.gz"))?;
    space(SampleType::I16)?.write(folder.file("a.nrrd"))?;
    folder.with("text.nrrd", b"NRRD0004\ntype: uint8\ndimension: 2\nsizes: 2 2\nencoding: ascii\n\n1 2 3 4");
    Ok(vec!["a.png", "a.tif", "a.nii", "a.nii.gz", "a.nrrd", "text.nrrd"])
}

/// Of gzip and PNG a few bytes at the end are checksums, without which every sample is there.
#[test]
fn every_prefix_is_refused() -> Result<(), ImagesError> {
    let folder = Folder::new("prefixes");
    let mut compared = 0;
    for name in files(&folder)? {
        let whole = content(&folder.file(name));
        let intact = AnyPicture::read(folder.file(name))?;
        for length in 0..whole.len() {
            let path = folder.with(&format!("cut-{name}"), &whole[..length]);
            match AnyPicture::read(&path) {
                Err(
                    ImagesError::Malformed { .. } | ImagesError::Truncated { .. } | ImagesError::Unsupported { .. },
                ) => compared += 1,
                Ok(picture) if whole.len() - 25 <= length => assert_eq!(picture, intact, "{name} cut to {length}"),
                other => panic!("{name} cut to {length} of {}: {other:?}", whole.len()),
            }
        }
    }
    assert!(1500 < compared, "{compared}");
    Ok(())
}

#[test]
fn every_spoiled_byte_is_refused_or_read_without_panic() -> Result<(), ImagesError> {
    let folder = Folder::new("spoiled");
    let mut compared = 0;
    for name in files(&folder)? {
        let whole = content(&folder.file(name));
        for at in 0..whole.len() {
            for spoiled in [0xff, whole[at] ^ 0x01] {
                let mut bytes = whole.clone();
                bytes[at] = spoiled;
                let path = folder.with(&format!("spoiled-{name}"), &bytes);
                // Either answer is right; a picture that is read is valid.
                if let Ok(AnyPicture::Space(picture)) = AnyPicture::read(&path) {
                    assert!(picture.values().iter().all(|value| value.is_finite()));
                }
                compared += 1;
            }
        }
    }
    assert!(3000 < compared, "{compared}");
    Ok(())
}

#[test]
fn every_prefix_of_a_field_is_refused() -> Result<(), ImagesError> {
    let folder = Folder::new("field-prefixes");
    let picture = Picture::new([2, 2, 2], [1.0; 3], vec![0.0; 8], SampleType::U8)?;
    let map = DisplacementMap::new(ImageGrid::new([2; 3], [1.0; 3])?, vec![[0.5, 0.25, 0.125]; 8])?;
    for name in ["a.nii", "a.nrrd"] {
        DisplacementField::of(&map, &picture)?.write(folder.file(name))?;
        let whole = content(&folder.file(name));
        for length in 0..whole.len().saturating_sub(9) {
            let path = folder.with(&format!("cut-{name}"), &whole[..length]);
            assert!(DisplacementField::<3>::read(&path).is_err(), "{name} cut to {length}");
        }
        let scalar = Picture::<3>::read(folder.file(name));
        assert!(matches!(scalar, Err(ImagesError::Unsupported { .. })), "{scalar:?}");
    }
    Ok(())
}

#[test]
fn what_is_no_file_is_refused() {
    let folder = Folder::new("no-files");
    let missing = AnyPicture::read(folder.file("missing.png"));
    assert!(matches!(missing, Err(ImagesError::Unreadable { .. })), "{missing:?}");
    std::fs::create_dir_all(folder.file("folder.nii")).unwrap_or_else(|error| panic!("{error}"));
    let directory = AnyPicture::read(folder.file("folder.nii"));
    assert!(matches!(directory, Err(ImagesError::Unreadable { .. })), "{directory:?}");
    let nameless = AnyPicture::read("/");
    assert!(matches!(nameless, Err(ImagesError::UnknownFormat { .. })), "{nameless:?}");
}

/// The place cannot be written: no such folder, or it is a folder. Nothing is left.
#[test]
fn unwritable_place_is_named_and_nothing_is_left() -> Result<(), ImagesError> {
    let folder = Folder::new("unwritable");
    let picture = plane(SampleType::U8)?;
    let refused = picture.write(folder.file("none/a.png"));
    assert!(matches!(refused, Err(ImagesError::Unwritable { .. })), "{refused:?}");
    std::fs::create_dir_all(folder.file("taken.png/inside")).unwrap_or_else(|error| panic!("{error}"));
    let refused = picture.write(folder.file("taken.png"));
    assert!(matches!(refused, Err(ImagesError::Unwritable { .. })), "{refused:?}");
    assert_eq!(folder.names(), ["taken.png"]);
    Ok(())
}

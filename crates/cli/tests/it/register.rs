//! The command `register`.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A folder of its own for each test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("piola-register-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
        Self(path)
    }

    fn register(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
        command.arg("register").args(arguments).current_dir(&self.0).stdin(Stdio::null());
        command.output().unwrap_or_else(|error| panic!("{error}"))
    }

    fn has(&self, name: &str) -> bool {
        Path::new(&self.0).join(name).exists()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[cfg(not(feature = "register"))]
#[test]
fn program_without_the_feature_says_how_to_build_it() {
    let folder = Folder::new("absent");
    for arguments in [&["a.png", "b.png", "--out", "results"][..], &[], &["--help"]] {
        let output = folder.register(arguments);
        assert_eq!(output.status.code(), Some(2), "{}", err(&output));
        assert!(err(&output).contains("--features register"), "{}", err(&output));
    }
    assert!(!folder.has("results"));
}

#[cfg(feature = "register")]
mod with_the_feature {
    use piola_images::{DisplacementField, Picture, SampleType};

    use super::{Folder, err};

    const ALL: [&str; 12] = [
        "displacement.nii.gz",
        "displacement.npy",
        "inverse.nii.gz",
        "inverse.npy",
        "jacobian.nii.gz",
        "jacobian.npy",
        "registration.svg",
        "before.png",
        "after.png",
        "difference.png",
        "jacobian.png",
        "summary.json",
    ];

    /// An ellipsoid whose centre lies `shift` samples along the last axis from the middle.
    fn phantom<const D: usize>(shift: f64, name: &str, folder: &Folder) -> Picture<D> {
        let sizes = [20; D];
        let values = (0..sizes.iter().product::<usize>()).map(|position| {
            let mut rest = position;
            let mut square = 0.0;
            for axis in (0..D).rev() {
                let centre = if axis == D - 1 { 9.5 + shift } else { 9.5 };
                square += (((rest % 20) as f64 - centre) / (5.0 + axis as f64)).powi(2);
                rest /= 20;
            }
            200.0 / (1.0 + (4.0 * (square - 1.0)).exp())
        });
        let picture = Picture::new(sizes, [1.5; D], values.collect(), SampleType::U8);
        let picture = picture.unwrap_or_else(|error| panic!("{error}"));
        picture.write(folder.0.join(name)).unwrap_or_else(|error| panic!("{error}"));
        picture
    }

    fn json(folder: &Folder, name: &str) -> serde_json::Value {
        let text = std::fs::read_to_string(folder.0.join(name)).unwrap_or_else(|error| panic!("{error}"));
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn phantom_in_two_dimensions_is_registered_by_every_measure() {
        let folder = Folder::new("plane");
        phantom::<2>(1.0, "fixed.png", &folder);
        phantom::<2>(-1.0, "moving.png", &folder);
        for (model, measure) in [("fluid", "squares"), ("elastic", "correlation"), ("fluid", "information")] {
            let arguments = [
                "fixed.png",
                "moving.png",
                "--spacing",
                "1.5",
                "--model",
                model,
                "--measure",
                measure,
                "--out",
                "results",
            ];
            let output = folder.register(&arguments);
            assert_eq!(output.status.code(), Some(0), "{}", err(&output));
            for name in ALL.into_iter().chain(["warped.png"]) {
                assert!(folder.has(&format!("results/{name}")), "{name}");
            }
            let summary = json(&folder, "results/summary.json");
            let number = |key: &str| summary[key].as_f64().unwrap_or(f64::NAN);
            assert!(number("measure_after") < number("measure_before"), "{summary}");
            assert!(0.0 < number("least_jacobian") && number("inverse_error_mm") < 1e-9, "{summary}");
            // The middle moves by two samples of 1.5 mm.
            let field = DisplacementField::<2>::read(folder.0.join("results/displacement.nii.gz"));
            let field = field.unwrap_or_else(|error| panic!("{error}"));
            let [down, right] = field.map.displacement([15.0, 16.5]);
            assert!((right - 3.0).abs() < 0.75 && down.abs() < 0.75, "{down} {right}");
        }
    }

    #[test]
    fn phantom_in_three_dimensions_is_registered_symmetrically() {
        let folder = Folder::new("space");
        phantom::<3>(0.5, "fixed.nii.gz", &folder);
        phantom::<3>(-0.5, "moving.nrrd", &folder);
        let output =
            folder.register(&["fixed.nii.gz", "moving.nrrd", "--symmetric", "--levels", "2", "--single", "--json"]);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        for name in ALL.into_iter().chain(["warped.nrrd"]) {
            assert!(folder.has(&format!("out/register-moving/{name}")), "{name}");
        }
        let shown: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        assert_eq!(shown, json(&folder, "out/register-moving/summary.json"));
        assert_eq!(shown["sizes"], serde_json::json!([20, 20, 20]));
    }

    #[test]
    fn bad_input_exits_with_2_and_writes_nothing() {
        let folder = Folder::new("bad");
        phantom::<2>(1.0, "fixed.png", &folder);
        phantom::<2>(-1.0, "moving.png", &folder);
        phantom::<3>(0.0, "solid.nii", &folder);
        std::fs::write(folder.0.join("text.png"), "text").unwrap_or_else(|error| panic!("{error}"));
        let flat = Picture::new([20; 2], [1.0; 2], vec![7.0; 400], SampleType::U8);
        let small = Picture::new([19, 20], [1.0; 2], (0..380).map(|i| f64::from(i % 50)).collect(), SampleType::U8);
        for (name, picture) in [("flat.png", flat), ("small.png", small)] {
            picture.and_then(|picture| picture.write(folder.0.join(name))).unwrap_or_else(|error| panic!("{error}"));
        }
        for (arguments, what) in [
            (&["fixed.png", "none.png"][..], "cannot read `none.png`"),
            (&["fixed.png", "text.png"], "`text.png` is no valid PNG file"),
            (&["fixed.png", "moving.jpg"], "needs a name that ends in"),
            (&["fixed.png", "solid.nii"], "one has two dimensions"),
            (&["fixed.png", "flat.png"], "constant value"),
            (&["fixed.png", "small.png"], "--resample"),
            (&["fixed.png", "moving.png", "--spacing", "0"], "spacing"),
            (&["fixed.png", "moving.png", "--mu", "-1"], "0 < μ"),
            (&["fixed.png", "moving.png", "--model", "glass"], "elastic"),
        ] {
            let output = folder.register(&[arguments, &["--out", "results"]].concat());
            assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", err(&output));
            assert!(err(&output).contains(what), "{arguments:?}: {}", err(&output));
        }
        assert!(!folder.has("results"));
        let output = folder.register(&["fixed.png", "moving.png", "--out", "fixed.png/results"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).contains("cannot write to the output folder"), "{}", err(&output));
    }
}

//! What is refused, by name and number, through the functions of C.

#![expect(unsafe_code, reason = "the functions are those of C")]

use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

use piola_ffi::c::PiolaStatus;
use piola_ffi::c::fluids::{
    PiolaFluid, piola_fluid_free, piola_fluid_from_json, piola_pipe_discharge, piola_viscometric,
};
use piola_ffi::c::solids::{
    PiolaSolid, piola_solid_free, piola_solid_from_json, piola_solid_from_values, piola_stress, piola_tangent,
};
use piola_ffi::c::status::{piola_last_error, piola_last_error_padded, piola_version};

const IDENTITY: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

fn message() -> String {
    // SAFETY: the text ends with a zero byte and no call follows before it is copied.
    unsafe { CStr::from_ptr(piola_last_error()) }.to_string_lossy().into_owned()
}

fn made(json: &str) -> (PiolaStatus, *mut PiolaSolid) {
    let text = CString::new(json).unwrap();
    let mut solid = null_mut();
    // SAFETY: a text and a place.
    let status = unsafe { piola_solid_from_json(text.as_ptr(), &raw mut solid) };
    (status, solid)
}

fn rubber() -> *mut PiolaSolid {
    let (status, solid) =
        made(r#"{"law": "saint_venant_kirchhoff", "first_lame_parameter": 1.0, "shear_modulus": 2.0}"#);
    assert_eq!(status, PiolaStatus::Ok);
    solid
}

#[test]
fn outputs_that_overlap_are_refused_by_name() {
    let mut both = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0].repeat(2);
    let (solid, place) = (rubber(), both.as_mut_ptr());
    // SAFETY: eighteen numbers; overlapping arrays are what is tried.
    unsafe {
        assert_eq!(piola_stress(solid, 0, place, 9, place, 9), PiolaStatus::BadPointer);
        assert_eq!(message(), "`out` overlaps `f`; they must be different memory");
        assert_eq!(piola_stress(solid, 0, place.add(8), 9, place, 9), PiolaStatus::BadPointer);
        assert_eq!(piola_stress(solid, 0, place.add(9), 9, place, 9), PiolaStatus::Ok);
        piola_solid_free(solid);
    }
}

#[test]
fn null_pointers_are_refused_by_name() {
    let mut out = [0.0; 9];
    let (solid, mut none) = (rubber(), null_mut());
    // SAFETY: null pointers are what is tried; all others lead to nine numbers.
    unsafe {
        assert_eq!(piola_stress(null(), 0, IDENTITY.as_ptr(), 9, out.as_mut_ptr(), 9), PiolaStatus::BadPointer);
        assert_eq!(message(), "`solid` is a null pointer");
        assert_eq!(piola_stress(solid, 0, null(), 9, out.as_mut_ptr(), 9), PiolaStatus::BadPointer);
        assert_eq!(message(), "`f` is a null pointer");
        assert_eq!(piola_stress(solid, 0, IDENTITY.as_ptr(), 9, null_mut(), 9), PiolaStatus::BadPointer);
        assert_eq!(piola_stress(solid, 0, null(), 0, null_mut(), 0), PiolaStatus::Ok);
        let odd = IDENTITY.as_ptr().byte_add(1);
        assert_eq!(piola_stress(solid, 0, odd, 9, out.as_mut_ptr(), 9), PiolaStatus::BadPointer);
        assert_eq!(message(), "`f` does not lead to the boundary of a number");
        assert_eq!(piola_solid_from_json(null(), &raw mut none), PiolaStatus::BadPointer);
        let text = c"{}";
        assert_eq!(piola_solid_from_json(text.as_ptr(), null_mut()), PiolaStatus::BadPointer);
        piola_solid_free(solid);
        piola_solid_free(null_mut());
        piola_fluid_free(null_mut());
    }
}

#[test]
fn wrong_lengths_and_choices_are_refused_before_anything_is_written() {
    let mut out = [7.0; 81];
    let solid = rubber();
    let f = IDENTITY.as_ptr();
    // SAFETY: all arrays are as long as said, or shorter lengths are said.
    unsafe {
        assert_eq!(piola_stress(solid, 0, f, 8, out.as_mut_ptr(), 9), PiolaStatus::WrongLength);
        assert_eq!(message(), "`f` has length 8; length 9 is needed");
        assert_eq!(piola_stress(solid, 0, f, 9, out.as_mut_ptr(), 18), PiolaStatus::WrongLength);
        assert_eq!(piola_stress(solid, 3, f, 9, out.as_mut_ptr(), 9), PiolaStatus::UnknownChoice);
        assert_eq!(message(), "`3` is no stress; there are 0 (cauchy), 1 (first_piola), 2 (second_piola)");
        assert_eq!(piola_tangent(solid, 1, 0, f, 9, out.as_mut_ptr(), 81), PiolaStatus::WrongLength);
        assert_eq!(message(), "`tangents` has length 81; length 36 is needed");
        assert_eq!(piola_tangent(solid, -1, 0, f, 9, out.as_mut_ptr(), 36), PiolaStatus::UnknownChoice);
        assert_eq!(piola_tangent(solid, 1, 9, f, 9, out.as_mut_ptr(), 36), PiolaStatus::UnknownChoice);
        assert_eq!(piola_stress(solid, 0, f, usize::MAX, out.as_mut_ptr(), 9), PiolaStatus::WrongLength);
        piola_solid_free(solid);
    }
    assert_eq!(out, [7.0; 81]);
}

#[test]
fn bad_points_are_counted_and_the_others_written() {
    let solid = rubber();
    let mut f = [[0.0; 9]; 200];
    f.fill(IDENTITY);
    f[131] = [0.0; 9];
    f[150][4] = f64::NAN;
    f[160][0] = -1.0;
    let mut out = [[9.0_f64; 9]; 200];
    for stress in 0..3 {
        // SAFETY: both arrays hold 200 points.
        let status = unsafe { piola_stress(solid, stress, f.as_ptr().cast(), 1800, out.as_mut_ptr().cast(), 1800) };
        assert_eq!(status, PiolaStatus::BadPoints);
        assert!(message().starts_with("3 of 200 points failed: at point 131, "), "{}", message());
        for (index, point) in out.iter().enumerate() {
            let is_bad = matches!(index, 131 | 150 | 160);
            assert!(point.iter().all(|x| x.is_nan() == is_bad && (is_bad || x.abs() <= 0.0)), "{index}: {point:?}");
        }
    }
    let mut tangents = vec![0.0_f64; 200 * 36];
    // SAFETY: as above.
    let status = unsafe { piola_tangent(solid, 3, 1, f.as_ptr().cast(), 1800, tangents.as_mut_ptr(), 7200) };
    assert_eq!(status, PiolaStatus::BadPoints);
    assert!(message().starts_with("3 of 200 points failed: at point 131, "));
    for (index, point) in tangents.chunks(36).enumerate() {
        assert_eq!(point.iter().any(|x| x.is_nan()), matches!(index, 131 | 150 | 160), "{index}");
    }
    // SAFETY: made above.
    unsafe { piola_solid_free(solid) };
}

#[test]
fn laws_that_are_none_say_why_and_leave_a_null_pointer() {
    for (json, says) in [
        ("", "EOF"),
        ("{}", "law"),
        (r#"{"law": "cheese"}"#, "cheese"),
        (r#"{"law": "blatz_ko", "shear_modulus": 1.0}"#, "poisson_ratio"),
        (
            r#"{"law": "saint_venant_kirchhoff", "first_lame_parameter": 1.0, "shear_modulus": -2.0}"#,
            "violates 0 < 3 λ + 2 μ",
        ),
        (r#"{"law": "saint_venant_kirchhoff", "first_lame_parameter": 1e999, "shear_modulus": 2.0}"#, "range"),
    ] {
        let (status, solid) = made(json);
        assert_eq!(status, PiolaStatus::BadLaw);
        assert!(solid.is_null() && message().contains(says), "{json}: {}", message());
    }
    let not_text = CString::new([b'{', 0xff]).unwrap();
    let mut solid = null_mut();
    // SAFETY: a text and a place.
    let status = unsafe { piola_solid_from_json(not_text.as_ptr(), &raw mut solid) };
    assert_eq!((status, message().as_str()), (PiolaStatus::BadLaw, "`json` is not UTF-8: byte 1 is wrong"));
    // SAFETY: a name, one number and a place.
    let status = unsafe { piola_solid_from_values(c"blatz_ko".as_ptr(), [f64::INFINITY].as_ptr(), 1, &raw mut solid) };
    assert_eq!(status, PiolaStatus::NotFinite);
    assert_eq!(message(), "`parameters`, entry 0: inf is not finite");
}

#[test]
fn fluids_refuse_what_has_no_answer() {
    let mut fluid: *mut PiolaFluid = null_mut();
    let (mut value, mut out) = (7.0, [7.0; 2]);
    // SAFETY: texts, handles and arrays are as promised.
    unsafe {
        let text = c"{\"fluid\": \"newtonian\", \"viscosity_coefficient\": 0.5}";
        assert_eq!(piola_fluid_from_json(text.as_ptr(), &raw mut fluid), PiolaStatus::Ok);
        assert_eq!(piola_pipe_discharge(fluid, -1.0, 1.0, &raw mut value, null_mut()), PiolaStatus::BadFlow);
        assert!(message().contains("0 < R"), "{}", message());
        assert_eq!(piola_pipe_discharge(fluid, 1.0, 1.0, null_mut(), null_mut()), PiolaStatus::BadPointer);
        let rates = [1.0, f64::NAN];
        assert_eq!(piola_viscometric(fluid, 0, rates.as_ptr(), 2, out.as_mut_ptr(), 2), PiolaStatus::NotFinite);
        assert_eq!(message(), "`entries`, entry 1: NaN is not finite");
        assert_eq!(piola_viscometric(fluid, 5, rates.as_ptr(), 1, out.as_mut_ptr(), 1), PiolaStatus::UnknownChoice);
        piola_fluid_free(fluid);
    }
    assert_eq!((value, out), (7.0, [7.0; 2]));
}

#[test]
fn a_panic_ends_at_the_border() {
    let status = piola_ffi::internal::answer(|| std::panic::resume_unwind(Box::new("of a test")));
    assert_eq!(status, PiolaStatus::Fault);
    assert_eq!(message(), "a fault of Piola, please report it: of a test");
}

#[test]
fn messages_belong_to_their_thread() {
    assert_eq!(made("{}").0, PiolaStatus::BadLaw);
    let mine = message();
    let theirs = std::thread::spawn(|| {
        let before = message();
        let _ = made(r#"{"law": "cheese"}"#);
        (before, message())
    });
    let (before, after) = theirs.join().unwrap();
    assert_eq!(before, "");
    assert!(after.contains("cheese") && message() == mine && mine != after);
    let mut padded = [0; 400];
    // SAFETY: 400 characters.
    let length = unsafe { piola_last_error_padded(padded.as_mut_ptr(), 400) };
    assert_eq!((length, padded[399].cast_unsigned()), (mine.len(), b' '));
    // SAFETY: the text is constant.
    assert_eq!(unsafe { CStr::from_ptr(piola_version()) }.to_str(), Ok(env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_law_is_shared_by_threads() {
    let solid = rubber() as usize;
    let expected = {
        let mut out = [0.0; 9];
        // SAFETY: nine numbers each.
        unsafe {
            piola_stress(
                solid as *const PiolaSolid,
                0,
                [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0].as_ptr(),
                9,
                out.as_mut_ptr(),
                9,
            )
        };
        out
    };
    assert_eq!(expected[0], 15.0);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..100 {
                    let mut out = [0.0; 9];
                    let f = [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
                    // SAFETY: nine numbers each; the law outlives the threads.
                    unsafe { piola_stress(solid as *const PiolaSolid, 0, f.as_ptr(), 9, out.as_mut_ptr(), 9) };
                    assert_eq!(out, expected);
                }
            });
        }
    });
    // SAFETY: no thread uses it any more.
    unsafe { piola_solid_free(solid as *mut PiolaSolid) };
}

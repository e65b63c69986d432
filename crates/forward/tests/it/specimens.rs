//! Specimens along paths: closed forms, two controls of one state, and what is refused.

use core::f64::consts::PI;

use piola_forward::ForwardError;
use piola_forward::{LoadedSpecimen, SpecimenRequest, solid, specimen};
use piola_testkit::{Tol, assert_close};

use crate::written;

const SOLVED: Tol = Tol::stated(1e-11, "Newton's iteration ends at 1e-12 of the tangent");
const MOONEY: &str = "mooney-rivlin:c10=0.3 MPa,c01=50 kPa";

fn request(test: &str, text: &str, path: (&str, &str), held: &[(&str, &str)]) -> SpecimenRequest {
    SpecimenRequest::new(test, solid(text, None).unwrap_or_else(|error| panic!("{error}")), path, held)
}

fn loaded(request: &SpecimenRequest) -> LoadedSpecimen {
    let found = specimen(request).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(found.ended, None);
    found
}

fn last(found: &LoadedSpecimen, name: &str) -> f64 {
    *found.column(name).and_then(|column| column.last().copied()).as_ref().unwrap_or_else(|| panic!("{name}"))
}

/// P = 2 (λ − λ⁻²)(C₁₀ + C₀₁/λ) and its fellows.
#[test]
fn mooney_rivlin_specimens_have_their_closed_forms() {
    let (a, b) = (3e5, 5e4);
    let bar = loaded(&request("uniaxial", MOONEY, ("stretch", "1..2"), &[]));
    assert_close("P of a bar", &[last(&bar, "P11")], &[2.0 * (2.0 - 0.25) * (a + 0.5 * b)], SOLVED);
    assert_close("sides", &[last(&bar, "F22"), last(&bar, "F33")], &[0.5_f64.sqrt(); 2], SOLVED);
    let sheet = loaded(&request("equibiaxial", MOONEY, ("strain", "0..100 %"), &[]));
    assert_close("P of a sheet", &[last(&sheet, "P11")], &[2.0 * (2.0 - 2.0_f64.powi(-5)) * (a + 4.0 * b)], SOLVED);
    let wide = loaded(&request("planar", MOONEY, ("stretch", "1..2"), &[]));
    assert_close("P of a wide sheet", &[last(&wide, "P11")], &[2.0 * (2.0 - 0.125) * (a + b)], SOLVED);
    let block = loaded(&request("simple-shear", MOONEY, ("shear", "0..0.5"), &[]));
    assert_close("T of a block", &[last(&block, "T12")], &[2.0 * 0.5 * (a + b)], SOLVED);
    // W of the bar: C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3) with I₁ = 5, I₂ = 4.25.
    assert_close("W", &[last(&bar, "energy")], &[2.0 * a + 1.25 * b], SOLVED);
}

#[test]
fn a_path_of_loads_is_the_path_of_stretches_read_the_other_way() {
    let by_stretch = loaded(&request("uniaxial", MOONEY, ("stretch", "1..2"), &[]));
    let most = format!("0..{:?} Pa", last(&by_stretch, "P11"));
    let by_stress = loaded(&request("uniaxial", MOONEY, ("stress", &most), &[]));
    assert_close("λ", &[last(&by_stress, "F11")], &[2.0], SOLVED);
    let most = format!("0..{:?} kPa", 1e-3 * last(&by_stretch, "T11"));
    let by_true_stress = loaded(&request("uniaxial", MOONEY, ("true_stress", &most), &[]));
    assert_close("λ", &[last(&by_true_stress, "F11")], &[2.0], SOLVED);
    let shear = loaded(&request("simple-shear", MOONEY, ("shear_stress", "0..70 kPa"), &[]));
    assert_close("k", &[last(&shear, "F21")], &[0.1], SOLVED);
}

/// A bar that is also squeezed: the same state as a biaxial sheet with the stretch that it finds.
#[test]
fn mixed_controls_meet_biaxial_ones() {
    let held = [("P22", "-40 kPa"), ("P33", "0 Pa")];
    let squeezed = loaded(&request("mixed", MOONEY, ("F11", "1..1.5"), &held));
    assert_close("P22", &[last(&squeezed, "P22")], &[-4e4], SOLVED);
    let second = format!("{:?}", last(&squeezed, "F22"));
    let sheet = loaded(&request("biaxial", MOONEY, ("stretch", "1..1.5"), &[("second_stretch", &second)]));
    let of = |found: &LoadedSpecimen| ["P11", "P22", "F33", "energy"].map(|name| last(found, name));
    assert_close("state", &of(&squeezed), &of(&sheet), SOLVED);
}

#[test]
fn a_bulk_modulus_makes_volumes_change() {
    let soft = solid("neo-hookean:mu=1 MPa", Some("10 MPa")).unwrap_or_else(|error| panic!("{error}"));
    let pressed = loaded(&SpecimenRequest::new("volumetric", soft.clone(), ("volume", "1..0.9"), &[]));
    // −p = U′(J) = ½ K (J − 1/J).
    assert_close("T", &[last(&pressed, "T11")], &[0.5e7 * (0.9 - 1.0 / 0.9)], SOLVED);
    assert_close("J", &[last(&pressed, "J")], &[0.9], SOLVED);
    let pressure = format!("0..{:?} Pa", -last(&pressed, "T11"));
    let by_pressure = loaded(&SpecimenRequest::new("volumetric", soft, ("pressure", &pressure), &[]));
    assert_close("J", &[last(&by_pressure, "J")], &[0.9], SOLVED);
}

/// λ³ = 1 + ¼ ψ² R² and M = ½ π μ R⁴ ψ/λ of a neo-Hookean rod without axial force; M = ½ π μ R⁴ ψ and
/// N = −¼ π μ ψ² R⁴ at a fixed length.
#[test]
fn twisted_rods_have_their_closed_forms() {
    let rod = request("torsion", "neo-hookean:mu=1 MPa", ("twist", "0..100 rad/m"), &[]).with_size("radius", "5 mm");
    let free = loaded(&rod);
    let stretch = (1.0_f64 + 0.0625).cbrt();
    let torque = 0.5 * PI * 1e6 * 0.005_f64.powi(4) * 100.0;
    assert_close("λ", &[last(&free, "axial_stretch")], &[stretch], SOLVED);
    assert_close("M", &[last(&free, "torque")], &[torque / stretch], SOLVED);
    let mut held = rod;
    held.held = vec![("stretch".to_owned(), "1".to_owned())];
    let held = loaded(&held);
    assert_close("M", &[last(&held, "torque")], &[torque], SOLVED);
    assert_close("N", &[last(&held, "axial_force")], &[-0.25 * PI * 1e6 * 1e4 * 0.005_f64.powi(4)], SOLVED);
}

#[test]
fn a_table_for_a_reader_has_eleven_rows_from_the_first_to_the_last() {
    let found = loaded(&request("uniaxial", MOONEY, ("stretch", "1..2"), &[]));
    let table = found.table();
    let first = |line: &str| line.split_whitespace().next().and_then(|field| field.parse().ok());
    let stretches: Vec<f64> = table.lines().skip(3).filter_map(first).collect();
    let expected: Vec<f64> = (0..11).map(|k| 1.0 + 0.1 * f64::from(k)).collect();
    assert_close("stretches", &stretches, &expected, Tol::stated(1e-6, "six digits are written"));
}

/// Gent's chains end at I₁ − 3 = Jₘ: λ² + 2/λ = 4 at λ = 1.675.
#[test]
fn a_path_that_cannot_go_on_keeps_what_it_has() {
    let gent = request("uniaxial", "gent:mu=1 MPa,jm=1", ("stretch", "1..2"), &[]);
    let found = specimen(&gent).unwrap_or_else(|error| panic!("{error}"));
    let (value, why) = found.ended.clone().unwrap_or_default();
    assert!(1.6 < value && value < 1.7 && !why.is_empty(), "{value}: {why}");
    assert!(60 < found.rows.len() && found.rows.len() < 70, "{}", found.rows.len());
    assert!(found.rows.iter().flatten().all(|x| x.is_finite()));
    assert!(found.table().contains("The path ends before stretch"), "{}", found.table());
    let files = ["specimen.csv", "specimen.svg", "summary.json"];
    let [csv, svg, json] = written("specimen", files, |folder| found.write(folder));
    assert!(csv.starts_with("stretch,F11,F12") && csv.contains("energy [J/m^3]"));
    assert!(svg.contains("P11 (Pa)") && svg.contains("energy (J/m³)"), "{svg}");
    assert!(json.contains("\"ended\": {"), "{json}");
}

#[test]
fn the_law_of_a_fit_is_loaded_in_pascal() -> Result<(), Box<dyn std::error::Error>> {
    use piola_measured::fitting::{Measurements, Request, compare};
    let text =
        "mode,stretch,stress_MPa\nuniaxial,2,1.75\nuniaxial,3,2.8888888888888889\nuniaxial,1.5,1.0555555555555556\n"; // μ = 1 MPa
    let measurements = Measurements::parse("rubber.csv", text)?;
    let comparison = compare(&measurements, &Request::of(vec!["neo-hookean".parse()?]))?;
    let path = std::env::temp_dir().join(format!("piola-specimen-{}.json", std::process::id()));
    std::fs::write(&path, comparison.summary(&measurements))?;
    let named = solid(&format!("{}#neo-hookean", path.display()), None);
    let none = solid(&format!("{}#yeoh", path.display()), None);
    let _ = std::fs::remove_file(&path);
    let bar = specimen(&SpecimenRequest::new("uniaxial", named?, ("stretch", "1..2"), &[]))?;
    assert_close("P", &[last(&bar, "P11")], &[1.75e6], Tol::stated(1e-9, "a fit to nine digits of the data"));
    assert!(none.is_err_and(|error| error.to_string().contains("it has neo-hookean")));
    Ok(())
}

#[test]
fn what_does_not_go_together_is_refused_by_name() {
    let refused = |test: &str, path: (&str, &str), held: &[(&str, &str)]| {
        specimen(&request(test, MOONEY, path, held)).map_or_else(|error| error.to_string(), |_| String::new())
    };
    assert!(
        refused("bend", ("stretch", "1..2"), &[]).starts_with("`bend` is not accepted; valid: uniaxial, equibiaxial")
    );
    assert!(refused("uniaxial", ("shear", "0..1"), &[]).contains("valid: stretch, strain, stress"));
    assert!(refused("uniaxial", ("stretch", "1"), &[]).contains("a path as 1..3"));
    assert!(refused("uniaxial", ("stress", "0..1"), &[]).contains("a path as 0..2 MPa"));
    assert!(refused("uniaxial", ("stress", "0..1 mm"), &[]).contains("stresses with a unit"));
    assert!(refused("uniaxial", ("stretch", "1..2"), &[("F11", "1")]).contains("each component once"));
    assert!(refused("uniaxial", ("stretch", "-1..2"), &[]).contains("stretches and volumes are above 0"));
    assert!(refused("uniaxial", ("strain", "-100..0 %"), &[]).contains("strains above -100 %"));
    assert!(refused("uniaxial", ("stretch", "1..nan"), &[]).contains("a path as 1..3"));
    assert!(!refused("volumetric", ("volume", "1..0.9"), &[]).is_empty());
    let mut many = request("uniaxial", MOONEY, ("stretch", "1..2"), &[]);
    many.points = 1;
    assert!(specimen(&many).is_err_and(|error| error.to_string().contains("from 2 to 100000 points")));
    let torsion = request("torsion", MOONEY, ("twist", "0..1 rad/m"), &[]);
    assert!(matches!(specimen(&torsion), Err(ForwardError::MissingSize { .. })));
    let ogden =
        request("torsion", "ogden:1:mu1=1 MPa,alpha1=2", ("twist", "0..1 rad/m"), &[]).with_size("radius", "1 mm");
    assert!(specimen(&ogden).is_err_and(|error| error.to_string().contains("without a bulk modulus")));
    let terms = solid("hyperfoam:9:mu1=1 MPa", None).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(terms.contains("must be 1 to 6"), "{terms}");
    let other = request("torsion", MOONEY, ("twist", "0..1 rad/m"), &[]).with_size("length", "1 mm");
    assert!(specimen(&other).is_err_and(|error| error.to_string().contains("radius or inner_radius")));
    for wrong in [
        "rubber",
        "neo-hookean",
        "neo-hookean:mu",
        "neo-hookean:mu=1 m",
        "neo-hookean:mu=1,mu=2",
        "neo-hookean:nu=1",
        "mooney-rivlin:c10=1",
        "gent:mu=1 MPa,jm=-1",
        "ogden:2:mu1=1 MPa,alpha1=2",
    ] {
        assert!(solid(wrong, None).is_err(), "{wrong}");
    }
    assert!(solid("neo-hookean:mu=1", Some("1 m")).is_err() && solid("neo-hookean:mu=1", Some("-1 MPa")).is_err());
}

/// P of a bar by the closed forms of Carroll's law and of the extended tube, at a stretch of 2; a foam named in a file.
#[test]
fn specimens_of_laws_of_rubber_have_the_stresses_of_their_formulas() {
    let stress = |text: &str| {
        let bar =
            specimen(&request("uniaxial", text, ("stretch", "1..2"), &[])).unwrap_or_else(|error| panic!("{error}"));
        bar.column("P11").unwrap_or_default()[100]
    };
    // I₁ = 5, I₂ = 4.25: 2 (λ − λ⁻²)(A + 4 B I₁³ + C/(2 λ √I₂)).
    let expected = 3.5 * (0.15e6 + 4.0 * 0.3 * 125.0 + 0.1e6 / (4.0 * 4.25_f64.sqrt()));
    let tol = Tol::stated(1e-10, "the sides are found by Newton's method");
    assert_close("Carroll", &[stress("carroll:A=0.15 MPa,B=0.3 Pa,C=0.1 MPa")], &[expected], tol);
    // δ² = 0.01, x = 2: ½ Gc (0.99/0.98² − 0.01/0.98), and 2 Ge/β (λ^(β/2) − λ^(−β))/λ with β = 1.
    let slope = 0.5 * 0.2e6 * (0.99 / (0.98 * 0.98) - 0.01 / 0.98);
    let expected = 3.5 * slope + 2.0 * 0.2e6 * (2.0_f64.sqrt() - 0.5) / 2.0;
    assert_close("tube", &[stress("extended-tube:Gc=0.2 MPa,delta=0.1,Ge=0.2 MPa,beta=1")], &[expected], tol);
    let rod = request("torsion", "carroll:A=0.15 MPa,B=0.3 Pa,C=0.1 MPa", ("twist", "0..10 rad/m"), &[]);
    assert!(specimen(&rod.with_size("radius", "5 mm")).is_ok());
    let path = std::env::temp_dir().join(format!("piola-foam-{}.json", std::process::id()));
    let text = r#"{"law":"hyperfoam","terms":[{"modulus":1e6,"exponent":2.0,"poisson_ratio":0.0}]}"#;
    std::fs::write(&path, text).unwrap_or_else(|error| panic!("{error}"));
    let pressed = specimen(&request("uniaxial", &path.display().to_string(), ("stretch", "1..0.5"), &[]));
    let removed = std::fs::remove_file(&path);
    let pressed = pressed.unwrap_or_else(|error| panic!("{error}"));
    // (2 μ/α)(λ^α − 1)/λ, the sides stay.
    assert_close("foam", &[pressed.column("P11").unwrap_or_default()[100]], &[-1.5e6], tol);
    assert!(removed.is_ok());
}

//! Relaxation spectra from tables: units, temperatures, cards, and what is refused.

use core::f64::consts::TAU;
use core::fmt::Write as _;

use piola_measured::fitting::Program;
use piola_measured::spectra::{MeasuredSpectrum, Response, SpectrumRequest, SpectrumTable, prony, spectrum};
use piola_testkit::{Tol, assert_close};

use crate::newtonian::written;

/// Moduli, Pa, and times, s.
const MODES: [[f64; 2]; 3] = [[1e5, 0.01], [2e4, 0.2], [3e3, 4.0]];
const SEARCHED: Tol = Tol::stated(1e-5, "the search ends at about 1e-7 of ln g and ln τ");

fn moduli(angular_frequency: f64) -> [f64; 2] {
    MODES.iter().fold([0.0; 2], |[storage, loss], [g, time]| {
        let x = angular_frequency * time;
        [storage + g * x * x / (1.0 + x * x), loss + g * x / (1.0 + x * x)]
    })
}

/// log₁₀ aₜ = −6 (θ − 443.15 K)/(110 K + θ − 443.15 K).
fn shift(temperature: f64) -> f64 {
    let above = temperature - 443.15;
    10.0_f64.powf(-6.0 * above / (110.0 + above))
}

/// Oscillations at temperatures in °C, with frequencies in Hz and moduli in kPa.
fn melt(temperatures: &[f64], points: u32) -> String {
    let mut text = String::from("temperature [°C],frequency [Hz],G' [kPa],G'' [kPa]\n");
    for temperature in temperatures {
        for k in 0..points {
            let frequency = 10.0_f64.powf(0.125 * f64::from(k) - 1.5);
            let [storage, loss] = moduli(TAU * frequency * shift(temperature + 273.15)).map(|g| 1e-3 * g);
            let _ = writeln!(text, "{temperature},{frequency:?},{storage:?},{loss:?}");
        }
    }
    text
}

fn found(text: &str, request: &SpectrumRequest) -> MeasuredSpectrum {
    let table = SpectrumTable::parse("melt.csv", text).unwrap_or_else(|error| panic!("{error}"));
    spectrum(&table, request).unwrap_or_else(|error| panic!("{error}"))
}

/// Exact data would take more modes, down to rounding.
fn three() -> SpectrumRequest {
    let mut request = SpectrumRequest::default();
    request.modes = Some(3);
    request
}

fn modes(found: &MeasuredSpectrum) -> Vec<f64> {
    found.fit.spectrum.modes().iter().flat_map(|mode| [mode.modulus, mode.relaxation_time]).collect()
}

#[test]
fn oscillation_gives_back_the_modes_that_made_it() {
    let found = found(&melt(&[170.0], 29), &three());
    assert_eq!((found.response, found.rows.len()), (Response::Oscillation, 29));
    assert_close("g, τ", &modes(&found), MODES.as_flattened(), SEARCHED);
    assert!(found.superposition.is_none() && found.is_settled());
    // η₀ = Σ g τ.
    let viscosity = found.fit.spectrum.zero_shear_viscosity().unwrap_or(f64::NAN);
    assert_close("η₀", &[viscosity], &[1e3 + 4e3 + 12e3], SEARCHED);
}

#[test]
fn relaxation_of_a_solid_gives_back_its_modes_and_its_equilibrium() -> Result<(), Box<dyn std::error::Error>> {
    let mut text = String::from("time [min];G(t) [MPa]\n");
    for k in 0..49 {
        let t = 10.0_f64.powf(f64::from(k) / 12.0 - 2.5);
        let modulus = 2.0 + MODES.iter().map(|[g, time]| 1e-5 * g * (-t / time).exp()).sum::<f64>();
        writeln!(text, "{:?};{:?}", t / 60.0, 1e-6 * modulus)?;
    }
    let mut request = three();
    request.equilibrium = true;
    let table = SpectrumTable::parse("gel.csv", &text)?;
    let found = spectrum(&table, &request)?;
    assert_eq!(found.response, Response::Relaxation);
    let expected: Vec<f64> = MODES.iter().flat_map(|[g, time]| [1e-5 * g, *time]).collect();
    assert_close("g, τ", &modes(&found), &expected, SEARCHED);
    assert_close("G₀", &[found.fit.spectrum.glassy_modulus()], &[2.0 + 1.23], SEARCHED);
    assert!(found.continuous.is_err() && found.table(&table).contains("no continuous spectrum"));
    // The shares of a Prony series: g/G₀.
    let card = prony(Program::Abaqus, &found.fit.spectrum)?;
    let first: Vec<f64> = card.lines().nth(2).unwrap_or_default().split(", ").flat_map(str::parse).collect();
    assert_close("Abaqus", &first, &[1.0 / 3.23, 0.0, 0.01], SEARCHED);
    let card = prony(Program::FeBio, &found.fit.spectrum)?;
    let rest = card.split("<g0>").nth(1).and_then(|text| text.split('<').next()).map(str::parse::<f64>);
    assert_close("FEBio", &[rest.transpose()?.unwrap_or(f64::NAN)], &[2.0 / 3.23], SEARCHED);
    let card = prony(Program::Ansys, &found.fit.spectrum)?;
    assert!(card.contains("TB,PRONY,1,1,3,SHEAR\nTBDATA,1,0.3095") && card.matches("TBDATA").count() == 1, "{card}");
    assert!(prony(Program::LsDyna, &found.fit.spectrum).is_err());
    Ok(())
}

#[test]
fn isotherms_are_shifted_by_the_law_that_made_them() -> Result<(), Box<dyn std::error::Error>> {
    let table = SpectrumTable::parse("melt.csv", &melt(&[190.0, 150.0, 170.0, 210.0], 33))?;
    let request = three().at_temperature("170 °C")?;
    let found = spectrum(&table, &request)?;
    let superposition = found.superposition.as_ref().ok_or("no shifts")?;
    assert_close("θ₀", &[superposition.reference_temperature], &[443.15], Tol::ulps(1.0));
    let expected: Vec<f64> = superposition.shifts.iter().map(|[t, _]| shift(*t).ln()).collect();
    let shifts: Vec<f64> = superposition.shifts.iter().map(|[_, shift]| *shift).collect();
    let interpolated = Tol::stated(0.01, "curves are linear in logarithms between their points, eight a decade");
    assert_close("ln a", &shifts, &expected, interpolated);
    let law = &superposition.williams_landel_ferry.as_ref().map_err(Clone::clone)?.law;
    let constants = Tol::stated(0.02, "the interpolation of the shifts");
    assert_close("C₁, C₂", &[law.strength(), law.width()], &[6.0, 110.0], constants);
    assert_close(
        "g, τ",
        &modes(&found),
        MODES.as_flattened(),
        Tol::stated(0.03, "the shifts, and what they do to the modes"),
    );
    let files = ["summary.json", "shifts.csv", "response.csv", "spectrum.svg", "modes.csv"];
    let [json, shifts, response, svg, modes] = written("spectrum", files, |folder| found.write(folder, &table, &[]));
    assert!(json.contains("\"reference_temperature\": 443.15") && json.contains("\"c1\""), "{json}");
    assert_eq!((shifts.lines().count(), response.lines().count(), modes.lines().count()), (5, 1 + 4 * 33, 4));
    assert!(svg.contains("H(τ)") && svg.contains("ln aₜ") && svg.contains("measured and fitted"));
    Ok(())
}

#[test]
fn mistakes_of_tables_of_moduli_are_named_with_their_line() {
    for (text, expected) in [
        ("omega [rad/s],G' [Pa]\n1,2\n", "no column is a loss modulus"),
        ("frequency,G' [Pa],G'' [Pa]\n1,2,3\n", "has no unit"),
        ("omega [rad/s],G' [Pa],G'' [mPa s]\n1,2,3\n", "another unit"),
        ("omega [rad/s],G' [Pa],G'' [Pa]\n1,2,3\n2,-1,3\n", "melt.csv:3: `G' [Pa]` is `-1`"),
        ("omega [rad/s],G' [Pa],G'' [Pa]\n", "no rows"),
        ("temperature [°R],omega [rad/s],G' [Pa],G'' [Pa]\n1,1,2,3\n", "valid: °C, K or °F"),
        ("# temperature: warm\nomega [rad/s],G' [Pa],G'' [Pa]\n1,2,3\n", "the temperature is `warm`"),
        ("angular frequency [Hz],G' [Pa],G'' [Pa]\n1,2,3\n", "`angular frequency [Hz]` is in Hz"),
        ("omega [rad/s],E' [Pa],E'' [Pa]\n1,2,3\n", "no column is a modulus"),
        ("stretch,stress\n1,2\n", "melt.csv"),
    ] {
        let found = SpectrumTable::parse("melt.csv", text).map_or_else(|error| error.to_string(), |_| String::new());
        assert!(found.contains(expected), "{text}{found}");
    }
    let table = SpectrumTable::parse("melt.csv", &melt(&[150.0, 170.0], 9)).unwrap_or_else(|error| panic!("{error}"));
    let asked = SpectrumRequest::default().at_temperature("200 °C").unwrap_or_else(|error| panic!("{error}"));
    assert!(spectrum(&table, &asked).is_err_and(|error| error.to_string().contains("a temperature that was measured")));
    assert!(SpectrumRequest::default().at_temperature("hot").is_err());
}

#[test]
fn files_of_a_measured_melt_make_one_curve() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/rheology");
    let paths = ["190", "130", "175"].map(|name| folder.join(format!("polystyrene-{name}.csv")));
    let table = SpectrumTable::load(&paths)?;
    assert_eq!(table.isotherms.iter().map(|isotherm| isotherm.rows.len()).collect::<Vec<_>>(), [32; 3]);
    let found = spectrum(&table, &SpectrumRequest::default())?;
    let superposition = found.superposition.as_ref().ok_or("no shifts")?;
    // Colder is slower; free volume tells it better than one energy.
    assert!(superposition.shifts[0][1] > 4.0 && superposition.shifts[2][1] < -1.0);
    // Two shifts beside the reference determine two constants, and tell nothing of their errors.
    let law = superposition.williams_landel_ferry.as_ref().map_err(Clone::clone)?;
    assert!(law.intervals == [None; 2] && (6.0..8.0).contains(&law.law.strength()), "{law:?}");
    assert!(found.is_at_most && found.table(&table).contains("the most modes that were tried"));
    assert!(found.fit.relative_error < 0.05, "{}", found.fit.relative_error);
    let viscosity = found.fit.spectrum.zero_shear_viscosity().ok_or("a liquid")?;
    assert!((3e5..4e5).contains(&viscosity), "{viscosity}");
    Ok(())
}

//! Relaxation spectra from tables: units, temperatures, cards, and what is refused.

use core::f64::consts::TAU;
use core::fmt::Write as _;
use core::ops::ControlFlow;

use piola_measured::fitting::Program;
use piola_measured::spectra::{
    MeasuredSpectrum, RelaxationMode, RelaxationSpectrum, Response, RetardationSpectrum, SpectrumRequest,
    SpectrumTable, general_viscoelastic, prony, spectrum, spectrum_until,
};
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

fn material(equilibrium: f64) -> RelaxationSpectrum {
    let modes = MODES.map(|[modulus, relaxation_time]| RelaxationMode { modulus, relaxation_time });
    RelaxationSpectrum::new(modes.to_vec(), equilibrium).unwrap_or_else(|error| panic!("{error}"))
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
    // A smooth spectrum, where three lines were: its rest is near.
    let resting = found.continuous.as_ref().map_err(Clone::clone)?.equilibrium_modulus.ok_or("a solid")?;
    assert_close("Gₑ", &[resting], &[2.0], Tol::stated(0.02, "three lines are no smooth spectrum"));
    // The shares of a Prony series: g/G₀.
    let card = prony(Program::Abaqus, &found.fit.spectrum)?;
    let first: Vec<f64> = card.lines().nth(2).unwrap_or_default().split(", ").flat_map(str::parse).collect();
    assert_close("Abaqus", &first, &[1.0 / 3.23, 0.0, 0.01], SEARCHED);
    let card = prony(Program::FeBio, &found.fit.spectrum)?;
    let rest = card.split("<g0>").nth(1).and_then(|text| text.split('<').next()).map(str::parse::<f64>);
    assert_close("FEBio", &[rest.transpose()?.unwrap_or(f64::NAN)], &[2.0 / 3.23], SEARCHED);
    let card = prony(Program::Ansys, &found.fit.spectrum)?;
    assert!(card.contains("TB,PRONY,1,1,3,SHEAR\nTBDATA,1,0.3095") && card.matches("TBDATA").count() == 1, "{card}");
    assert!(prony(Program::LsDyna, &found.fit.spectrum).is_err_and(|error| error.to_string().contains("--density")));
    assert!(prony(Program::CalculiX, &found.fit.spectrum).is_err_and(|error| error.to_string().contains("no Prony")));
    // LS-DYNA's G(t) = Σ g e^(−β t), evaluated from the lines of the card.
    let card = general_viscoelastic(&found.fit.spectrum, 1e9, 1100.0)?;
    let (head, terms) = card.split_once("\n\n").ok_or("a blank second card")?;
    assert!(head.ends_with("*MAT_GENERAL_VISCOELASTIC\n1,1100.0,1000000000.0"), "{head}");
    let term = |line: &str| line.split_once(',').and_then(|(g, b)| Some((g.parse().ok()?, b.parse().ok()?)));
    let terms: Vec<(f64, f64)> = terms.lines().filter_map(term).collect();
    assert_eq!(terms.len(), 4);
    for t in [0.0, 0.01, 0.3, 5.0] {
        let modulus: f64 = terms.iter().map(|(g, rate)| g * (-rate * t).exp()).sum();
        let expected = found.fit.spectrum.relaxation_modulus(t);
        assert_close("G(t)", &[modulus], &[expected], Tol::ulps(16.0));
    }
    assert!(general_viscoelastic(&found.fit.spectrum, 1e9, f64::NAN).is_err());
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
        (
            "omega [rad/s],G' [Pa],storage modulus [kPa],G'' [Pa]\n1,2,3,4\n",
            "melt.csv:1: 2 columns are the storage modulus: `G' [Pa]`, `storage modulus [kPa]`; valid: one such column",
        ),
        ("time [s],t [s],J [1/Pa]\n1,1,2\n", "2 columns are the time: `time [s]`, `t [s]`"),
        ("time [s],J [1/Pa],G [Pa]\n1,1,2\n", "columns of relaxation and of creep"),
        ("time [s],J(t) [Pa]\n1,1\n", "`Pa` is another unit; valid: 1/Pa"),
        ("time [s],J(t) [1/Pa]\n1,-1\n", "melt.csv:2: `J(t) [1/Pa]` is `-1`"),
        (
            "temperature [°C],omega [rad/s],G' [Pa],G'' [Pa]\n20,1,1,1\n20.4,1,1,1\n20.8,1,1,1\n21.2,1,1,1\n21.6,1,1,1\n\
             22,1,1,1\n22.4,1,1,1\n22.8,1,1,1\n23.2,1,1,1\n",
            "without a gap; valid: isotherms",
        ),
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
    // The optimum of independent searches, by `benches/peers/spectra_fits.py`: 40 of 40 starts of SciPy, and RheoJAX.
    let single = SpectrumTable::load(&[folder.join("polystyrene-175.csv")])?;
    for (modes, squares) in [(4, 0.287_502_691_617), (6, 0.014_178_469_614_3)] {
        let mut request = SpectrumRequest::default();
        (request.modes, request.equilibrium) = (Some(modes), true);
        let found = spectrum(&single, &request)?;
        let own = found.fit.relative_error * found.fit.relative_error * 64.0;
        assert_close("S", &[own], &[squares], Tol::stated(1e-11, "digits of the reference"));
    }
    let viscosity = found.fit.spectrum.zero_shear_viscosity().ok_or("a liquid")?;
    assert!((3e5..4e5).contains(&viscosity), "{viscosity}");
    Ok(())
}

#[test]
fn creep_gives_back_the_modes_of_a_liquid_and_of_a_solid() -> Result<(), Box<dyn std::error::Error>> {
    for equilibrium in [0.0, 500.0] {
        let material = material(equilibrium);
        let creep = RetardationSpectrum::of(&material);
        let mut text = String::from("Step time (min)\tCreep compliance (1/kPa)\n");
        for k in 0..57 {
            let t = 10.0_f64.powf(f64::from(k) / 12.0 - 3.2);
            writeln!(text, "{:?}\t{:?}", t / 60.0, 1e3 * creep.compliance(t))?;
        }
        let mut request = SpectrumRequest::default();
        (request.modes, request.equilibrium) = (Some(creep.modes().len()), 0.0 < equilibrium);
        let table = SpectrumTable::parse("gel.csv", &text)?;
        let found = spectrum(&table, &request)?;
        assert_eq!(found.response, Response::Creep);
        assert_close("g, τ", &modes(&found), MODES.as_flattened(), SEARCHED);
        assert_close("Gₑ", &[found.fit.spectrum.equilibrium_modulus()], &[equilibrium], SEARCHED);
        let told = found.table(&table);
        assert!(told.contains("rows of J(t)") && told.contains("relaxation, converted exactly"), "{told}");
        assert_eq!(told.contains("η₀ = 1.700000e4 Pa s"), equilibrium <= 0.0, "{told}");
        // The cards are those of the relaxation spectrum.
        let card = prony(Program::Abaqus, &found.fit.spectrum)?;
        let first: Vec<f64> = card.lines().nth(2).unwrap_or_default().split(", ").flat_map(str::parse).collect();
        assert_close("Abaqus", &first, &[1e5 / (1.23e5 + equilibrium), 0.0, 0.01], SEARCHED);
        let files = ["summary.json", "retardation.csv", "continuous.csv", "response.csv", "spectrum.svg", "modes.csv"];
        let [json, retardation, continuous, response, svg, modes] =
            written("creep", files, |folder| found.write(folder, &table, &[]));
        assert!(json.contains("\"response\": \"creep\"") && json.contains("\"retardation_time\""), "{json}");
        assert_eq!((retardation.lines().count(), modes.lines().count(), response.lines().count()), (5, 4, 58));
        assert!(continuous.starts_with("retardation_time [s],L [1/Pa]") && svg.contains("J (1/Pa)"));
    }
    Ok(())
}

#[test]
fn creep_at_several_temperatures_is_shifted_by_the_law_that_made_it() -> Result<(), Box<dyn std::error::Error>> {
    let creep = RetardationSpectrum::of(&material(0.0));
    let mut text = String::from("temperature [°C],time [s],J [1/Pa]\n");
    for temperature in [150.0, 170.0, 190.0] {
        for k in 0..33 {
            let t = 10.0_f64.powf(0.1 * f64::from(k) - 2.0);
            writeln!(text, "{temperature},{t:?},{:?}", creep.compliance(t / shift(temperature + 273.15)))?;
        }
    }
    let mut request = SpectrumRequest::default();
    request.modes = Some(2);
    let found = found(&text, &request);
    let superposition = found.superposition.ok_or("no shifts")?;
    let expected: Vec<f64> = superposition.shifts.iter().map(|[t, _]| shift(*t).ln()).collect();
    let shifts: Vec<f64> = superposition.shifts.iter().map(|[_, shift]| *shift).collect();
    assert_close("ln a", &shifts, &expected, Tol::stated(0.01, "curves are linear in logarithms between their points"));
    Ok(())
}

#[test]
fn vertical_shifts_equal_those_that_made_the_moduli() -> Result<(), Box<dyn std::error::Error>> {
    let mut text = String::from("temperature [°C],angular frequency [rad/s],G' [Pa],G'' [Pa]\n");
    for temperature in [150.0, 170.0, 190.0] {
        for k in 0..33 {
            let w = 10.0_f64.powf(0.125 * f64::from(k) - 1.0);
            // Rubber elasticity: b = θ₀/θ.
            let b = 443.15 / (temperature + 273.15);
            let [storage, loss] = moduli(w * shift(temperature + 273.15)).map(|g| g / b);
            writeln!(text, "{temperature},{w:?},{storage:?},{loss:?}")?;
        }
    }
    let mut request = three().at_temperature("170 °C")?;
    request.vertical = true;
    let table = SpectrumTable::parse("melt.csv", &text)?;
    let found = spectrum(&table, &request)?;
    let superposition = found.superposition.as_ref().ok_or("no shifts")?;
    let across = superposition.vertical.as_ref().ok_or("no vertical shifts")?;
    let expected: Vec<f64> = superposition.shifts.iter().map(|[t, _]| (443.15 / t).ln()).collect();
    assert_close("ln b", across, &expected, Tol::stated(0.05, "the largest is 0.05; curves are linear between points"));
    assert!(found.fit.relative_error < 0.01 && found.table(&table).contains("ln bₜ = "), "{}", found.table(&table));
    let [shifts] = written("vertical", ["shifts.csv"], |folder| found.write(folder, &table, &[]));
    assert!(shifts.starts_with("temperature [K],ln a,ln b,ln a low,ln a high,ln b low,ln b high\n"), "{shifts}");
    // Without them the curves do not meet.
    request.vertical = false;
    assert!(0.01 < spectrum(&table, &request)?.fit.relative_error);
    Ok(())
}

#[test]
fn wandering_temperatures_repeats_and_sweeps_are_told() -> Result<(), Box<dyn std::error::Error>> {
    let head = "temperature [°C],omega [rad/s],G' [Pa],G'' [Pa]\n";
    let wandering = format!("{head}150.2,1,1,1\n149.8,2,2,2\n150.3,3,3,3\n170,1,1,1\n");
    let table = SpectrumTable::parse("melt.csv", &wandering)?;
    let temperatures: Vec<f64> = table.isotherms.iter().filter_map(|isotherm| isotherm.temperature).collect();
    assert_close("θ", &temperatures, &[150.1 + 273.15, 170.0 + 273.15], Tol::ulps(4.0));
    let expected = "temperatures from 149.80 to 150.30 °C are one isotherm at their mean, 150.10 °C";
    assert_eq!(table.notes, [expected]);
    let repeated = format!("{head}150,1,1,1\n150,1,1.02,1\n150,2,2,2\n");
    let table = SpectrumTable::parse("melt.csv", &repeated)?;
    // Two numbers, ln 1.02 apart: s = 0.0198/√2.
    let expected =
        "at 150.0 °C 1 frequency is measured more than once, and all rows count: repeats of G′ scatter by 1.40 %";
    assert_eq!(table.notes, [expected]);
    let swept = "omega [rad/s],G' [Pa],G'' [Pa]\n1,1,1\n2,2,2\n4,4,4\n4,3.6,4\n2,1.8,2\n1,0.9,1\n";
    let table = SpectrumTable::parse("melt.csv", swept)?;
    let expected = "frequencies rise and fall: both sweeps are fitted together; falling G′ are 0.900 times rising ones in the mean";
    assert_eq!(table.notes, [expected]);
    assert_eq!(table.isotherms[0].rows.len(), 6);
    Ok(())
}

/// Sweeps of a file stay sweeps beside other files; repeats between files are told of the isotherm that they share.
#[test]
fn notes_of_several_files_are_told_once() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::temp_dir().join(format!("piola-notes-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let written = |name: &str, temperature: f64, rows: &str| {
        let path = folder.join(name);
        let text = format!("# temperature: {temperature} °C\nomega [rad/s],G' [Pa],G'' [Pa]\n{rows}");
        std::fs::write(&path, text).map(|()| path)
    };
    let swept = written("swept.csv", 150.0, "1,1,1\n2,2,2\n4,4,4\n4,3.6,4\n2,1.8,2\n1,0.9,1\n")?;
    let other = written("other.csv", 170.0, "1,1,1\n2,2,2\n4,4,4\n")?;
    let again = written("again.csv", 170.0, "1,1.02,1\n8,8,8\n")?;
    let sweeps = "at 150.0 °C frequencies rise and fall: both sweeps are fitted together; falling G′ are 0.900 times rising ones in the mean";
    let repeats =
        "at 170.0 °C 1 frequency is measured more than once, and all rows count: repeats of G′ scatter by 1.40 %";
    let two = SpectrumTable::load(&[swept.clone(), other.clone()]);
    let three = SpectrumTable::load(&[swept, other, again]);
    std::fs::remove_dir_all(&folder)?;
    assert_eq!(two?.notes, [sweeps]);
    let three = three?;
    assert_eq!(three.notes, [sweeps, repeats]);
    let at: Vec<f64> = three.isotherms[1].rows.iter().map(|row| row.at).collect();
    assert_eq!(at, [1.0, 1.0, 2.0, 4.0, 8.0]);
    Ok(())
}

#[test]
fn stopped_spectrum_is_written_with_what_was_found() -> Result<(), Box<dyn std::error::Error>> {
    let table = SpectrumTable::parse("melt.csv", &melt(&[170.0], 29))?;
    let mut calls = 0;
    let mut watch = |fraction: f64| {
        assert!((0.0..=1.0).contains(&fraction));
        calls += 1;
        if calls < 50 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let found = spectrum_until(&table, &SpectrumRequest::default(), &mut watch)?;
    assert!(found.interrupted && !found.is_settled());
    assert!(found.table(&table).contains("interrupted: the best until then"));
    assert!(found.summary(&table).contains("\"interrupted\": true"));
    Ok(())
}

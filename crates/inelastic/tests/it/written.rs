//! Laws written by serde and read again are the same; what no constructor takes is refused by name.

use core::error::Error;
use core::fmt::Debug;

use piola_continuum::DeformationGradient;
use piola_inelastic::{
    BergstromBoyce, DrivenGrowth, GivenGrowth, Grown, InSeries, InelasticPoint, Kinematic, Mullins, ReeseGovindjee,
    StepControl, Thermal, ThermalExpansion, Viscoplastic,
};
use piola_solids::{Hencky, NeoHookeanCiarlet};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::paths::{bergstrom_boyce, kinematic, mullins, reese_govindjee, viscoplastic};

type Fallible = Result<(), Box<dyn Error>>;
type Spring = NeoHookeanCiarlet;

/// The law read from its text, which must equal it.
fn again<L: Serialize + DeserializeOwned + PartialEq + Debug>(law: &L) -> Result<String, Box<dyn Error>> {
    let text = serde_json::to_string(law)?;
    assert_eq!(serde_json::from_str::<L>(&text)?, *law, "{text}");
    Ok(text)
}

/// Why the text with another number is refused.
fn refused<L: DeserializeOwned>(text: &str, [from, to]: [&str; 2]) -> String {
    let changed = text.replace(from, to);
    assert_ne!(changed, text, "{from} is in the text");
    serde_json::from_str::<L>(&changed).err().map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn laws_written_and_read_again_equal_themselves_and_bad_ones_are_refused_by_name() -> Fallible {
    let text = again(&bergstrom_boyce()?)?;
    let error = refused::<BergstromBoyce<Spring, Spring>>(&text, ["\"rate\":0.25", "\"rate\":-1.0"]);
    assert!(error.contains("rate"), "{error}");
    let text = again(&reese_govindjee()?)?;
    let error = refused::<ReeseGovindjee<Spring, Spring>>(&text, ["\"viscosity\":0.75", "\"viscosity\":0.0"]);
    assert!(error.contains("0 < η"), "{error}");
    let text = again(&viscoplastic(0.5)?)?;
    let error = refused::<Viscoplastic<Hencky>>(&text, ["\"saturation\":0.5", "\"saturation\":0.125"]);
    assert!(error.contains("σ₀ ≤ σ∞"), "{error}");
    let error = refused::<Viscoplastic<Hencky>>(&text, ["\"hardening\"", "\"softening\""]);
    assert!(error.contains("softening"), "{error}");
    let text = again(&kinematic(0.5)?)?;
    let error = refused::<Kinematic<Hencky, Spring>>(&text, ["\"recovery\":", "\"recovery\":-"]);
    assert!(error.contains("0 ≤ β"), "{error}");
    let text = again(&mullins()?)?;
    assert!(refused::<Mullins<Spring>>(&text, ["\"softening\":", "\"softening\":-"]).contains("1 ≤ r"));
    let spring = Spring::with_constants(1.0, 2.0)?;
    let text = again(&InSeries::new(spring, spring, 0.25)?)?;
    assert!(refused::<InSeries<Spring, Spring>>(&text, ["0.25", "-0.25"]).contains("0 ≤ η"));
    let text = again(&DrivenGrowth::new(spring, 0.5, [0.5, 2.0], 3.0)?)?;
    assert!(refused::<DrivenGrowth<Spring>>(&text, ["[0.5,2.0]", "[0.5,0.75]"]).contains("1 < ϑ⁺"));
    let text = again(&GivenGrowth::new(spring))?;
    assert!(refused::<GivenGrowth<Spring>>(&text, ["\"elastic\"", "\"law\""]).contains("unknown field"));
    let text = again(&Thermal::new(spring, ThermalExpansion { coefficient: 0.5, reference_temperature: 300.0 })?)?;
    assert!(refused::<Thermal<Spring>>(&text, ["\"coefficient\"", "\"expansivity\""]).contains("expansivity"));
    let text = again(&Grown::new(spring, &nalgebra::Matrix3::from_diagonal(&[1.5, 1.0, 1.25].into()))?)?;
    assert!(refused::<Grown<Spring>>(&text, ["[1.5,", "[-1.5,"]).contains("0 < det G"));
    Ok(())
}

/// A state goes to a file and comes back as an array.
#[test]
fn a_state_read_again_continues_the_path() -> Fallible {
    let law = viscoplastic(0.5)?;
    let (shear, control) = (DeformationGradient::simple_shear(0.3)?, StepControl::one_step());
    let mut point = InelasticPoint::new(&law);
    point.advance(&shear, 1.0, &control)?;
    let text = serde_json::to_string(point.state().as_slice())?;
    let state: Vec<f64> = serde_json::from_str(&text)?;
    let mut other = InelasticPoint::with_state(&law, &state, &point.deformation())?;
    let back = DeformationGradient::simple_shear(-0.1)?;
    assert_eq!(other.advance(&back, 1.0, &control)?, point.advance(&back, 1.0, &control)?);
    Ok(())
}

//! Laws read by serde go through the constructors that check their parameters.

use piola_numerics::linear::matrix3::from_rows;
use piola_solids::Hyperelastic;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

use crate::{
    BergstromBoyce, DrivenGrowth, Grown, Hardening, InSeries, InelasticError, Kinematic, Mullins, PowerFlow,
    ReeseGovindjee, Thermal, ThermalExpansion, Viscoplastic,
};

/// Reads the fields of a law and makes it of them.
macro_rules! validated {
    ($($law:ident [$($part:ident),*] { $($field:ident: $type:ty),+ } $make:expr;)+) => { $(
        impl<'de, $($part: Hyperelastic + Deserialize<'de>),*> Deserialize<'de> for $law<$($part),*> {
            fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
                #[derive(Deserialize)]
                #[serde(deny_unknown_fields)]
                struct Written<$($part),*> {
                    $($field: $type),+
                }
                let Written { $($field),+ } = Written::<$($part),*>::deserialize(reader)?;
                let made: Result<Self, InelasticError> = $make;
                made.map_err(D::Error::custom)
            }
        }
    )+ };
}

validated! {
    PowerFlow [] { rate: f64, stress: f64, stress_exponent: f64, stretch_exponent: f64, perturbation: f64 }
        Self { rate, stress, stress_exponent, stretch_exponent, perturbation }.checked();
    BergstromBoyce [A, B] { equilibrium: A, overstress: B, flow: PowerFlow } Self::new(equilibrium, overstress, flow);
    ReeseGovindjee [A, B] { equilibrium: A, overstress: B, viscosity: f64, bulk_fluidity: f64 }
        Self::new(equilibrium, overstress, viscosity).and_then(|law| law.with_bulk_fluidity(bulk_fluidity));
    InSeries [A, B] { first: A, second: B, viscosity: f64 } Self::new(first, second, viscosity);
    Mullins [L] { elastic: L, softening: f64, energy: f64, share: f64 } Self::new(elastic, softening, energy, share);
    DrivenGrowth [L] { elastic: L, rate: f64, bounds: [f64; 2], exponent: f64 } Self::new(elastic, rate, bounds, exponent);
    Grown [L] { law: L, growth: [[f64; 3]; 3] } Self::new(law, &from_rows(growth));
    Hardening [] { yield_stress: f64, linear: f64, saturation: f64, saturation_exponent: f64 }
        Self { yield_stress, linear, saturation, saturation_exponent }.checked();
    Kinematic [L, K] { elastic: L, back: K, hardening: Hardening, recovery: f64, viscosity: f64 }
        Self::new(elastic, back, hardening, recovery, viscosity);
    Thermal [L] { elastic: L, expansion: ThermalExpansion } Self::new(elastic, expansion);
    Viscoplastic [L] { elastic: L, hardening: Hardening, viscosity: f64 } Self::new(elastic, hardening, viscosity);
}

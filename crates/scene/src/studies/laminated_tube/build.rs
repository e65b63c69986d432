//! Tubes of layers from checked records.

use super::{Layer, LayeredTube, Layers};
use crate::model::Builder;
use piola_document::Mistake;
use piola_document::Record;
use piola_studies::internal::{HeldTube, PressureRefusal};

impl Builder<'_> {
    pub(in crate::studies) fn layered_tube(&mut self, scene: &Record, table: &Record) -> Option<LayeredTube> {
        let law = self.law(scene, "laminated_tube");
        let records = scene.records("layer");
        if records.is_empty() && !scene.has("layer") {
            self.refuse(
                table.place.clone(),
                "[laminated_tube] without a layer",
                "at least one [[layer]], as thickness = \"1 mm\"",
            );
        }
        let layers: Option<Vec<Layer>> = records.iter().map(layer).collect();
        let layers = layers.filter(|layers| !layers.is_empty())?;
        let layers = Layers::new(table.number("inner_radius")?, layers);
        let (pressure, stretch) = (table.number("inner_pressure")?, table.number("stretch")?);
        if stretch <= 1.0 {
            return self.refused(
                table.place_of("stretch"),
                format!("a largest stretch of {stretch}"),
                "a number greater than 1",
            );
        }
        let tube = LayeredTube { layers, law: law?, pressure, stretch };
        let homogeneous = tube.layers.homogeneous();
        for (layers, name) in [(&tube.layers, "the tube"), (&homogeneous, "the homogeneous tube")] {
            let held = match HeldTube::at_rest(layers, &tube.law) {
                Ok(held) => held,
                Err(error) => {
                    let place = records.first().map_or(&table.place, |record| &record.place).clone();
                    return self.refused(
                        place,
                        format!("{name} has no state without loads: {error}"),
                        "growths nearer to 1",
                    );
                }
            };
            if let Err(refusal) = held.stretch_at(pressure, stretch) {
                self.wrong(refused(table, name, pressure, &refusal));
                return None;
            }
        }
        Some(tube)
    }
}

fn layer(record: &Record) -> Option<Layer> {
    let growth = [record.number("radial_growth")?, record.number("hoop_growth")?, record.number("axial_growth")?];
    Some(Layer { thickness: record.number("thickness")?, growth })
}

fn refused(table: &Record, name: &str, pressure: f64, refusal: &PressureRefusal) -> Mistake {
    match refusal {
        PressureRefusal::Beyond { most, stretch, is_end: false } => Mistake::new(
            table.place_of("inner_pressure"),
            format!(
                "{name} does not carry {pressure} Pa: it is beyond the limit point {most:.6e} Pa, at the stretch \
                 {stretch:.6}"
            ),
        )
        .valid(format!("at most {most:.6e} Pa")),
        PressureRefusal::Beyond { most, stretch, is_end: true } => Mistake::new(
            table.place_of("inner_pressure"),
            format!("{name} does not carry {pressure} Pa up to the stretch {stretch}: it comes to {most:.6e} Pa"),
        )
        .valid(format!("at most {most:.6e} Pa, or a larger `stretch`")),
        PressureRefusal::Refused(error) => {
            Mistake::new(table.place_of("stretch"), format!("{name}: {error}")).valid("a smaller largest stretch")
        }
    }
}

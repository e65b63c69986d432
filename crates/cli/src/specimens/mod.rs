//! The command `specimen`.

use std::path::{Path, PathBuf};

use clap::Args;
use piola_charts::Folder;
use piola_forward::{ForwardError, SpecimenRequest};

use crate::Exit;
use crate::commands::{note, refused_forward};
use crate::flows::show;

#[derive(Debug, Args)]
pub(crate) struct SpecimenArguments {
    /// The test: uniaxial, equibiaxial, biaxial, planar, simple-shear, volumetric, mixed or torsion.
    pub(crate) test: String,
    /// The solid, as `yeoh:c10=0.3 MPa,c20=-1 kPa,c30=50 Pa`, a JSON file of a solid, or the summary.json of a fit, with #NAME for
    /// one of its laws.
    #[arg(long, value_name = "SOLID")]
    pub(crate) solid: String,
    /// The path: a quantity with its first and last value, as `stretch=1..3`, `stress='0..2 MPa'`, `shear=0..1` or `F12=0..0.5`.
    #[arg(long, value_name = "NAME=FROM..TO", allow_hyphen_values = true)]
    pub(crate) path: String,
    /// Another prescribed quantity with its value, as `second_stretch=1.2` or `P22='10 kPa'`; several times for several.
    #[arg(long = "with", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub(crate) held: Vec<String>,
    /// Bulk modulus of a solid that would keep its volume otherwise.
    #[arg(long, value_name = "PRESSURE")]
    pub(crate) bulk_modulus: Option<String>,
    /// Radius of the rod, for torsion.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) radius: Option<String>,
    /// Inner radius of a tube, for torsion.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) inner_radius: Option<String>,
    /// Points of the path, from 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = 101)]
    pub(crate) points: u32,
    /// Folder of the results instead of out/specimen-TEST.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON to standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

pub(crate) fn load(arguments: &SpecimenArguments) -> Exit {
    let prepared = piola_forward::solid(&arguments.solid, arguments.bulk_modulus.as_deref()).and_then(|solid| {
        let path = pair("path", &arguments.path)?;
        let held = arguments.held.iter().map(|text| pair("with", text)).collect::<Result<Vec<_>, _>>()?;
        let mut request = SpecimenRequest::new(&arguments.test, solid, path, &held);
        request.points = arguments.points;
        for (name, size) in [("radius", &arguments.radius), ("inner_radius", &arguments.inner_radius)] {
            if let Some(size) = size {
                request = request.with_size(name, size);
            }
        }
        let loaded = piola_forward::specimen(&request)?;
        let beside = || Path::new("out").join(format!("specimen-{}", arguments.test));
        let folder = Folder::prepare(&arguments.out.clone().unwrap_or_else(beside))?;
        Ok((loaded, folder))
    });
    match prepared {
        Ok((loaded, folder)) => {
            let written = loaded.write(&folder);
            let text = if arguments.json { loaded.summary() } else { format!("{}\n", loaded.table()) };
            show(&text, arguments.json, &folder, &written);
            if let Some((value, why)) = &loaded.ended {
                note(&format!("error: no state at {} = {value:?}: {why}", loaded.columns[0].0));
            }
            if loaded.ended.is_none() && written.failures.is_empty() { Exit::Done } else { Exit::Failed }
        }
        Err(error) => refused_forward(&error, arguments.json),
    }
}

/// `NAME=VALUE`.
fn pair<'t>(option: &str, text: &'t str) -> Result<(&'t str, &'t str), ForwardError> {
    text.split_once('=').map(|(name, value)| (name.trim(), value.trim())).ok_or_else(|| ForwardError::Argument {
        argument: format!("--{option} {text}"),
        valid: "NAME=VALUE, as stretch=1..3 or P22='10 kPa'",
    })
}

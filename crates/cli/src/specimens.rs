//! The command `specimen`.

use std::path::Path;

use piola_charts::Folder;
use piola_measured::MeasuredError;
use piola_measured::forward::{self, SpecimenRequest};

use crate::Exit;
use crate::arguments::SpecimenArguments;
use crate::commands::{note, refused};
use crate::flows::show;

pub(crate) fn load(arguments: &SpecimenArguments) -> Exit {
    let prepared = forward::solid(&arguments.solid, arguments.bulk_modulus.as_deref()).and_then(|solid| {
        let path = pair("path", &arguments.path)?;
        let held = arguments.held.iter().map(|text| pair("with", text)).collect::<Result<Vec<_>, _>>()?;
        let mut request = SpecimenRequest::new(&arguments.test, solid, path, &held);
        request.points = arguments.points;
        for (name, size) in [("radius", &arguments.radius), ("inner_radius", &arguments.inner_radius)] {
            if let Some(size) = size {
                request = request.with_size(name, size);
            }
        }
        let loaded = forward::specimen(&request)?;
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
        Err(error) => refused(&error, arguments.json),
    }
}

/// `NAME=VALUE`.
fn pair<'t>(option: &str, text: &'t str) -> Result<(&'t str, &'t str), MeasuredError> {
    text.split_once('=').map(|(name, value)| (name.trim(), value.trim())).ok_or_else(|| MeasuredError::Argument {
        argument: format!("--{option} {text}"),
        valid: "NAME=VALUE, as stretch=1..3 or P22='10 kPa'",
    })
}

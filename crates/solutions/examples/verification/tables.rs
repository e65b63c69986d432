//! Files of a state: nodes, elements and faces as CSV, all of it with the loads as JSON.

use core::fmt::Write as _;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use nalgebra::{Matrix3, Vector3};
use piola_fields::Coordinates;
use piola_solutions::ResponseFunctions;
use piola_solutions::families::Family;
use serde_json::{Map, Value, json};

use super::cases::{Case, LAWS, Visitor, about_law, visit_law};
use super::mesh;

/// The columns of nodes.csv after the number of the node.
pub(crate) const NODE_COLUMNS: [&str; 37] = [
    "Q1", "Q2", "Q3", "q1", "q2", "q3", "X", "Y", "Z", "ux", "uy", "uz", "F11", "F12", "F13", "F21", "F22", "F23",
    "F31", "F32", "F33", "p", "T11", "T22", "T33", "T12", "T23", "T13", "P11", "P12", "P13", "P21", "P22", "P23",
    "P31", "P32", "P33",
];

/// The columns of faces.csv after the name of the side and the four nodes.
pub(crate) const FACE_COLUMNS: [&str; 9] = ["X", "Y", "Z", "N1", "N2", "N3", "t1", "t2", "t3"];

/// A particle in Cartesian components.
struct Particle {
    reference: Vector3<f64>,
    displacement: Vector3<f64>,
    gradient: Matrix3<f64>,
    pressure: f64,
    cauchy: Matrix3<f64>,
    first_piola: Matrix3<f64>,
    /// The deformed coordinates.
    place: [f64; 3],
    /// Unit vectors of the reference coordinates, one a row.
    frame: Matrix3<f64>,
}

fn particle<F: Family, L: ResponseFunctions>(case: &Case<'_, F, L>, at: [f64; 3]) -> Result<Particle, Box<dyn Error>> {
    let (reference, current) = (F::Reference::default(), F::Current::default());
    let place = case.family.place(at);
    let rows = |rows: [[f64; 3]; 3]| Matrix3::from(rows).transpose();
    let frame = rows(reference.physical_frame(&at.into())?.directions);
    let turned = rows(current.physical_frame(&place.into())?.directions);
    let physical = rows(case.family.deformation(at)?.gradient);
    let stress = case.family.stress(case.law, &case.datum, at)?;
    let gradient = turned.transpose() * physical * frame;
    let cauchy = turned.transpose() * stress.cauchy.0.matrix() * turned;
    // P = J T F⁻ᵀ with det F = 1: the inverse is the transposed cofactor.
    let inverse = gradient.try_inverse().ok_or("a deformation gradient is singular")?;
    let place_of_reference = reference.place(&at.into());
    Ok(Particle {
        reference: place_of_reference,
        displacement: current.place(&place.into()) - place_of_reference,
        gradient,
        pressure: stress.pressure,
        cauchy,
        first_piola: cauchy * inverse.transpose(),
        place,
        frame,
    })
}

impl Particle {
    fn row(&self, at: [f64; 3]) -> Vec<f64> {
        let by_rows = |m: &Matrix3<f64>| m.transpose().as_slice().to_vec();
        let t = &self.cauchy;
        let mut row = [at, self.place].concat();
        row.extend(self.reference.iter().chain(&self.displacement));
        row.extend(by_rows(&self.gradient));
        row.push(self.pressure);
        row.extend([t[(0, 0)], t[(1, 1)], t[(2, 2)], t[(0, 1)], t[(1, 2)], t[(0, 2)]]);
        row.extend(by_rows(&self.first_piola));
        row
    }
}

/// Numbers as they are read back exactly, in the order of the columns.
fn line(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| format!("{x:e}")).collect();
    texts.join(",")
}

struct Writer {
    folder: PathBuf,
    law: &'static str,
    count: usize,
}

impl Visitor for Writer {
    fn visit<F: Family, L: ResponseFunctions>(&mut self, case: &Case<'_, F, L>) -> Result<(), Box<dyn Error>> {
        let folder = self.folder.join(case.name).join(self.law);
        fs::create_dir_all(&folder)?;
        let mut nodes = format!("node,{}\n", NODE_COLUMNS.join(","));
        let mut rows = Vec::new();
        for (index, at) in mesh::nodes(&case.ranges).into_iter().enumerate() {
            let row = particle(case, at)?.row(at);
            writeln!(nodes, "{index},{}", line(&row))?;
            rows.push(json!(row));
        }
        fs::write(folder.join("nodes.csv"), nodes)?;

        let mut elements = String::from("element,n1,n2,n3,n4,n5,n6,n7,n8\n");
        for (index, corners) in mesh::elements().iter().enumerate() {
            let corners: Vec<String> = corners.iter().map(ToString::to_string).collect();
            writeln!(elements, "{index},{}", corners.join(","))?;
        }
        fs::write(folder.join("elements.csv"), elements)?;

        let mut faces = format!("side,n1,n2,n3,n4,{}\n", FACE_COLUMNS.join(","));
        let mut sides = Vec::new();
        for face in mesh::faces() {
            let middle = particle(case, face.middle(&case.ranges))?;
            let sign = if face.upper { 1.0 } else { -1.0 };
            let normal = middle.frame.row(face.axis).transpose() * sign;
            let traction = middle.first_piola * normal;
            let side = format!("Q{}_{}", face.axis + 1, if face.upper { "upper" } else { "lower" });
            let [a, b, c, d] = face.nodes;
            let numbers: Vec<f64> = middle.reference.iter().chain(&normal).chain(&traction).copied().collect();
            writeln!(faces, "{side},{a},{b},{c},{d},{}", line(&numbers))?;
            sides.push(json!({ "side": side, "nodes": face.nodes, "values": numbers }));
        }
        fs::write(folder.join("faces.csv"), faces)?;

        let (formula, parameters) = about_law(self.law);
        let parameters: Map<String, Value> = parameters.iter().map(|&(name, x)| (name.to_owned(), json!(x))).collect();
        let loads: Map<String, Value> = case.loads.iter().map(|&(name, x)| (name.to_owned(), json!(x))).collect();
        let document = json!({
            "case": case.name,
            "about": case.about,
            "constants": case.constants,
            "reference_coordinates": case.coordinates[0],
            "deformed_coordinates": case.coordinates[1],
            "law": { "name": self.law, "formula": formula, "parameters": parameters },
            "datum": { "reference": case.datum.reference, "T11_Pa": case.datum.stress },
            "ranges": case.ranges,
            "loads": loads,
            "node_columns": NODE_COLUMNS[..],
            "nodes": rows,
            "elements": mesh::elements(),
            "face_columns": FACE_COLUMNS[..],
            "faces": sides,
        });
        fs::write(folder.join("case.json"), serde_json::to_string(&document)?)?;
        self.count += 1;
        Ok(())
    }
}

/// Writes all cases of all laws and the README; returns their number.
pub(crate) fn write_all(folder: &Path) -> Result<usize, Box<dyn Error>> {
    let mut writer = Writer { folder: folder.to_path_buf(), law: "", count: 0 };
    for law in LAWS {
        writer.law = law;
        visit_law(law, &mut writer)?;
    }
    fs::create_dir_all(folder)?;
    fs::write(folder.join("README.md"), include_str!("README.md"))?;
    Ok(writer.count)
}

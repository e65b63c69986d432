//! The motion as an animation in glTF 2.0, for viewers.
//!
//! Bodies are the shapes of the file, or thin boxes from joint to joint where it has none. z is up in a robot's file and y in
//! glTF: the root node turns one into the other. All data stand in the file itself.
//!
//! Reference: Khronos Group, *glTF 2.0 Specification*, 2021 (ISO/IEC 12113:2022).

use core::f64::consts::{PI, TAU};

use nalgebra::Matrix3;
use piola_kinematics::Attitude;
use piola_multibody::{BodyIndex, RigidTree, VisualShape};
use serde_json::{Value, json};

use super::{RobotMotion, RobotStudy};

/// Frames of an animation at most.
const MOST_FRAMES: usize = 2000;
/// Segments around a cylinder or a sphere.
const SEGMENTS: usize = 24;

/// What the accessors see.
const FLOAT: u32 = 5126;
const INDEX: u32 = 5123;

/// A buffer with its views and accessors.
#[derive(Default)]
struct Data {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Data {
    /// An accessor with bytes of its own; its index.
    fn accessor(&mut self, bytes: &[u8], target: Option<u32>, mut accessor: Value) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        accessor["bufferView"] = self.views.len().into();
        self.views.push(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Rows of `width` numbers; the accessor.
    #[expect(clippy::cast_possible_truncation, reason = "glTF stores single precision")]
    fn floats(&mut self, numbers: &[f64], width: usize, target: Option<u32>) -> usize {
        let single: Vec<f32> = numbers.iter().map(|&x| x as f32).collect();
        let bytes: Vec<u8> = single.iter().flat_map(|x| x.to_le_bytes()).collect();
        let extreme = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..width).filter_map(|k| single.iter().skip(k).step_by(width).copied().reduce(pick)).collect()
        };
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][width - 1];
        let accessor = json!({
            "componentType": FLOAT,
            "count": numbers.len() / width,
            "type": kind,
            "min": extreme(f32::min),
            "max": extreme(f32::max),
        });
        self.accessor(&bytes, target, accessor)
    }

    fn indices(&mut self, corners: &[u16]) -> usize {
        let bytes: Vec<u8> = corners.iter().flat_map(|x| x.to_le_bytes()).collect();
        let accessor = json!({ "componentType": INDEX, "count": corners.len(), "type": "SCALAR" });
        self.accessor(&bytes, Some(34963), accessor)
    }
}

/// A surface: places, normals, triangles.
#[derive(Default)]
struct Surface {
    places: Vec<f64>,
    normals: Vec<f64>,
    corners: Vec<u16>,
}

impl Surface {
    fn corner(&mut self, place: [f64; 3], normal: [f64; 3]) {
        self.places.extend(place);
        self.normals.extend(normal);
    }

    /// A grid of corners that were added row by row, as triangles: counterclockwise where rows go to the right and downwards.
    #[expect(clippy::cast_possible_truncation, reason = "some thousand corners at most")]
    fn grid(&mut self, first: usize, rows: usize, columns: usize) {
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let a = (first + row * columns + column) as u16;
                let below = a + columns as u16;
                self.corners.extend([a, below, a + 1, a + 1, below, below + 1]);
            }
        }
    }

    /// A surface about z: radius and height of each row, with the normal's.
    fn turned(&mut self, rows: &[[f64; 4]]) {
        let first = self.places.len() / 3;
        for &[radius, height, across, up] in rows {
            for segment in 0..=SEGMENTS {
                let (s, c) = (TAU * segment as f64 / SEGMENTS as f64).sin_cos();
                self.corner([radius * c, radius * s, height], [across * c, across * s, up]);
            }
        }
        self.grid(first, rows.len(), SEGMENTS + 1);
    }

    /// A cube of sides of 1 m.
    fn cube() -> Self {
        let mut cube = Self::default();
        for axis in 0..3 {
            for side in [-0.5, 0.5] {
                let first = cube.places.len() / 3;
                for (u, v) in [(-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5)] {
                    let (mut place, mut normal) = ([0.0; 3], [0.0; 3]);
                    // Counterclockwise from outside.
                    let turned = if side < 0.0 { u } else { -u };
                    (place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]) = (side, turned, v);
                    normal[axis] = 2.0 * side;
                    cube.corner(place, normal);
                }
                cube.grid(first, 2, 2);
            }
        }
        cube
    }

    /// A cylinder of radius and length 1 m.
    fn cylinder() -> Self {
        let mut cylinder = Self::default();
        cylinder.turned(&[[0.0, 0.5, 0.0, 1.0], [1.0, 0.5, 0.0, 1.0]]);
        cylinder.turned(&[[1.0, 0.5, 1.0, 0.0], [1.0, -0.5, 1.0, 0.0]]);
        cylinder.turned(&[[1.0, -0.5, 0.0, -1.0], [0.0, -0.5, 0.0, -1.0]]);
        cylinder
    }

    /// A sphere of radius 1 m.
    fn sphere() -> Self {
        let mut sphere = Self::default();
        let rows: Vec<[f64; 4]> = (0..=SEGMENTS / 2)
            .map(|row| {
                let (s, c) = (PI * row as f64 / (SEGMENTS / 2) as f64).sin_cos();
                [s, c, s, c]
            })
            .collect();
        sphere.turned(&rows);
        sphere
    }
}

/// The file; nothing where there are no instants.
pub(super) fn animation(found: &RobotMotion, robot: &RobotStudy, title: &str) -> Option<String> {
    let tree = robot.closed.tree();
    let stride = found.samples.len().div_ceil(MOST_FRAMES).max(1);
    let frames: Vec<_> = found.samples.iter().step_by(stride).collect();
    let start = frames.first()?.t;
    let mut data = Data::default();
    let shapes: Vec<Vec<Shape>> = tree.joints().iter().map(|place| shapes(robot, tree, place.child)).collect();
    let mut used: Vec<Form> = shapes.iter().flatten().map(|shape| shape.form).collect();
    used.sort_unstable();
    used.dedup();
    let mut meshes = Vec::new();
    for form in &used {
        let surface = match form {
            Form::Cube => Surface::cube(),
            Form::Cylinder => Surface::cylinder(),
            Form::Sphere => Surface::sphere(),
        };
        let places = data.floats(&surface.places, 3, Some(34962));
        let normals = data.floats(&surface.normals, 3, Some(34962));
        let indices = data.indices(&surface.corners);
        let attributes = json!({ "POSITION": places, "NORMAL": normals });
        meshes.push(json!({ "primitives": [{ "attributes": attributes, "indices": indices, "material": 0 }] }));
    }
    let times: Vec<f64> = frames.iter().map(|frame| (frame.t - start).abs()).collect();
    let times = data.floats(&times, 1, None);

    let half = 0.5_f64.sqrt();
    let mut nodes = vec![json!({ "name": title, "rotation": [-half, 0.0, 0.0, half] })];
    let (mut bodies, mut channels, mut samplers) = (Vec::new(), Vec::new(), Vec::new());
    let mut work = tree.workspace();
    let mut poses = vec![(Vec::new(), Vec::<f64>::new()); shapes.len()];
    for frame in &frames {
        tree.forward_kinematics(&mut work, &frame.q).ok()?;
        for (place, (places, turns)) in tree.joints().iter().zip(&mut poses) {
            let pose = tree.place_of(&work, place.child).ok()?;
            places.extend(pose.origin);
            let turn = quaternion(pose.rotation)?;
            let before = turns.last_chunk().copied().unwrap_or(turn);
            // Of the two quaternions of an attitude the nearer one.
            let sign = if turn.iter().zip(before).map(|(a, b)| a * b).sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
            turns.extend(turn.map(|x| sign * x));
        }
    }
    for ((place, shapes), (places, turns)) in tree.joints().iter().zip(&shapes).zip(&poses) {
        let node = nodes.len();
        bodies.push(node);
        let children: Vec<usize> = (node + 1..=node + shapes.len()).collect();
        nodes.push(json!({
            "name": tree.body_name(place.child),
            "translation": places[..3],
            "rotation": turns[..4],
            "children": children,
        }));
        nodes.extend(shapes.iter().map(|shape| shape.node(used.binary_search(&shape.form).unwrap_or_default())));
        for (path, numbers, width) in [("translation", places, 3), ("rotation", turns, 4)] {
            let output = data.floats(numbers, width, None);
            channels.push(json!({ "sampler": samplers.len(), "target": { "node": node, "path": path } }));
            samplers.push(json!({ "input": times, "output": output, "interpolation": "LINEAR" }));
        }
    }
    nodes[0]["children"] = bodies.into();
    let Data { bytes, views, accessors } = data;
    let file = json!({
        "asset": { "version": "2.0", "generator": "piola" },
        "scene": 0,
        "scenes": [{ "name": title, "nodes": [0] }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [{
            "name": "bodies",
            "pbrMetallicRoughness": { "baseColorFactor": [0.35, 0.55, 0.75, 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.6 },
        }],
        "animations": [{ "name": "motion", "channels": channels, "samplers": samplers }],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{}", base64(&bytes)) }],
    });
    serde_json::to_string(&file).ok()
}

/// The kinds of surfaces.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Form {
    Cube,
    Cylinder,
    Sphere,
}

/// A surface on a body.
struct Shape {
    form: Form,
    scale: [f64; 3],
    origin: [f64; 3],
    turn: Attitude<f64>,
}

impl Shape {
    fn node(&self, mesh: usize) -> Value {
        let Attitude { w, x, y, z } = self.turn;
        json!({ "mesh": mesh, "scale": self.scale, "translation": self.origin, "rotation": [x, y, z, w] })
    }
}

/// The shapes of a body: those of the file, or thin boxes to its joints; at least one.
fn shapes(robot: &RobotStudy, tree: &RigidTree, body: BodyIndex) -> Vec<Shape> {
    let mut shapes = Vec::new();
    let name = tree.body_name(body);
    for visual in robot.visuals.iter().filter(|visual| visual.body == name) {
        let (form, scale) = match visual.shape {
            VisualShape::Box { sides } => (Form::Cube, sides),
            VisualShape::Cylinder { radius, length } => (Form::Cylinder, [radius, radius, length]),
            VisualShape::Sphere { radius } => (Form::Sphere, [radius; 3]),
            _ => continue,
        };
        shapes.push(Shape { form, scale, origin: visual.origin, turn: visual.attitude });
    }
    if !shapes.is_empty() {
        return shapes;
    }
    for child in tree.joints().iter().filter(|child| tree.parent_of(child.child) == Ok(body)) {
        let [x, y, z] = child.joint.origin;
        let length = (x * x + y * y + z * z).sqrt();
        if 1e-6 < length {
            // From x to the direction, by half the angle between them.
            let (w, across) = (1.0 + x / length, [-z / length, y / length]);
            let size = (w * w + across[0] * across[0] + across[1] * across[1]).sqrt();
            let turn = if 1e-6 < size {
                Attitude { w: w / size, x: 0.0, y: across[0] / size, z: across[1] / size }
            } else {
                Attitude { w: 0.0, x: 0.0, y: 0.0, z: 1.0 }
            };
            let scale = [length, 0.08 * length, 0.08 * length];
            shapes.push(Shape { form: Form::Cube, scale, origin: [0.5 * x, 0.5 * y, 0.5 * z], turn });
        }
    }
    shapes.push(Shape { form: Form::Cube, scale: [0.05; 3], origin: [0.0; 3], turn: Attitude::identity() });
    shapes
}

/// (x, y, z, w) of a rotation by its rows.
fn quaternion(rows: [[f64; 3]; 3]) -> Option<[f64; 4]> {
    let turn = Attitude::from_matrix(&Matrix3::from_fn(|row, column| rows[row][column])).ok()?;
    Some([turn.x, turn.y, turn.z, turn.w])
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let bits = three.iter().fold(0_u32, |bits, &byte| bits << 8 | u32::from(byte)) << (8 * (3 - three.len()));
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k)) as usize & 63];
            text.push(if k <= three.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

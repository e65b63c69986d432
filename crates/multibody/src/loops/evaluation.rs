//! Residuals of the closures, their gradients, and what their second rates need.

use super::closure::coordinate;
use super::{BodyPoint, ClosedTree, LoopClosure, LoopWorkspace};
use crate::error::MultibodyError;
use crate::kinematics::arm;
use crate::mass_matrix::dots;
use crate::space::{Runs, SUBSPACE, pass_subspaces, reference};
use crate::spatial::{add, cross, dot, product, scaled, sub, times, transposed};
use crate::tree::Mounted;
use crate::workspace::TreeWorkspace;

/// A frame in motion, with its place from the reference point.
struct Moving {
    link: usize,
    point: [f64; 3],
    axes: [[f64; 3]; 3],
    w: [f64; 3],
    velocity: [f64; 3],
    /// At v̇ = 0.
    alpha: [f64; 3],
    acceleration: [f64; 3],
}

impl Moving {
    fn of(work: &TreeWorkspace<f64>, mounted: &Mounted) -> Self {
        let link = &work.space[mounted.link];
        let arm = arm(link.axes, mounted);
        let carried = add(cross(link.alpha, arm), cross(link.w, cross(link.w, arm)));
        Self {
            link: mounted.link,
            point: sub(add(link.origin, arm), reference(&work.space)),
            axes: product(link.axes, mounted.axes),
            w: link.w,
            velocity: add(link.velocity, cross(link.w, arm)),
            alpha: link.alpha,
            acceleration: add(link.acceleration, carried),
        }
    }
}

impl ClosedTree {
    /// Fills residuals, gradients, rates that are prescribed, and γ, of a state that is valid.
    pub(super) fn evaluate(
        &self,
        work: &mut LoopWorkspace,
        q: &[f64],
        v: &[f64],
        zero: &[f64],
        t: f64,
    ) -> Result<(), MultibodyError> {
        let tree = &self.tree;
        tree.forward_accelerations(&mut work.tree, q, v, zero)?;
        pass_subspaces(tree, &work.tree.space, &mut work.tree.rows);
        work.gradients.fill(0.0);
        let mut condition = 0;
        for (_, closure) in &self.closures {
            match *closure {
                LoopClosure::Point { first, second } => {
                    let [a, b] = self.moving(work, first, second)?;
                    self.points(work, condition, &a, &b);
                }
                LoopClosure::Axis { first, first_axis, second, second_axis } => {
                    let [a, b] =
                        self.moving(work, BodyPoint::new(first, [0.0; 3]), BodyPoint::new(second, [0.0; 3]))?;
                    let [x, y] = across(first_axis);
                    let axis = times(b.axes, second_axis);
                    self.right_angle(work, condition, (&a, times(a.axes, x)), (&b, axis));
                    self.right_angle(work, condition + 1, (&a, times(a.axes, y)), (&b, axis));
                }
                LoopClosure::Frame { first, second } => {
                    let a = Moving::of(&work.tree, tree.mounted_frame(first)?);
                    let b = Moving::of(&work.tree, tree.mounted_frame(second)?);
                    self.points(work, condition, &a, &b);
                    let (of_a, of_b) = (transposed(a.axes), transposed(b.axes));
                    for k in 0..3 {
                        self.right_angle(work, condition + 3 + k, (&a, of_a[k]), (&b, of_b[(k + 1) % 3]));
                    }
                }
                LoopClosure::Distance { first, second, length } => {
                    let [a, b] = self.moving(work, first, second)?;
                    let d = sub(a.point, b.point);
                    let rate = sub(a.velocity, b.velocity);
                    // (|d|² − l²)/2l
                    work.residuals[condition] = (dot(d, d) - length * length) / (2.0 * length);
                    let second_rate = dot(rate, rate) + dot(d, sub(a.acceleration, b.acceleration));
                    work.gamma[condition] = -second_rate / length;
                    let u = scaled(length.recip(), d);
                    self.gradient(work, condition, a.link, (cross(a.point, u), u), 1.0);
                    self.gradient(work, condition, b.link, (cross(b.point, u), u), -1.0);
                }
                LoopClosure::Gear { follower, leader, ratio, offset } => {
                    let (i, j) = (coordinate(tree, follower)?, coordinate(tree, leader)?);
                    work.residuals[condition] = q[i] - ratio * q[j] - offset;
                    work.gamma[condition] = 0.0;
                    work.gradients[condition * tree.freedoms + follower] += 1.0;
                    work.gradients[condition * tree.freedoms + leader] -= ratio;
                }
                LoopClosure::Prescribed { freedom, motion } => {
                    let [value, rate, second_rate] = motion(t);
                    crate::error::check_finite("prescribed motion", &[value, rate, second_rate])?;
                    work.residuals[condition] = q[coordinate(tree, freedom)?] - value;
                    work.gamma[condition] = second_rate;
                    work.rates[condition] = rate;
                    work.gradients[condition * tree.freedoms + freedom] = 1.0;
                }
            }
            condition += closure.conditions();
        }
        Ok(())
    }

    fn moving(&self, work: &LoopWorkspace, first: BodyPoint, second: BodyPoint) -> Result<[Moving; 2], MultibodyError> {
        let at = |point: BodyPoint| -> Result<Moving, MultibodyError> {
            let body = self.tree.mounted(point.body)?;
            let origin = add(body.origin, times(body.axes, point.at));
            let mounted = Mounted { name: String::new(), link: body.link, origin, axes: body.axes };
            Ok(Moving::of(&work.tree, &mounted))
        };
        Ok([at(first)?, at(second)?])
    }

    /// x_a − x_b = 0 in space axes.
    fn points(&self, work: &mut LoopWorkspace, condition: usize, a: &Moving, b: &Moving) {
        let difference = sub(a.point, b.point);
        let second_rate = sub(a.acceleration, b.acceleration);
        for k in 0..3 {
            let mut u = [0.0; 3];
            u[k] = 1.0;
            work.residuals[condition + k] = difference[k];
            work.gamma[condition + k] = -second_rate[k];
            self.gradient(work, condition + k, a.link, (cross(a.point, u), u), 1.0);
            self.gradient(work, condition + k, b.link, (cross(b.point, u), u), -1.0);
        }
    }

    /// x·y = 0 for a vector x of body a and y of body b, both in space axes.
    fn right_angle(
        &self,
        work: &mut LoopWorkspace,
        condition: usize,
        (a, x): (&Moving, [f64; 3]),
        (b, y): (&Moving, [f64; 3]),
    ) {
        let normal = cross(x, y);
        let normal_rate = add(cross(cross(a.w, x), y), cross(x, cross(b.w, y)));
        let (w, alpha) = (sub(a.w, b.w), sub(a.alpha, b.alpha));
        work.residuals[condition] = dot(x, y);
        work.gamma[condition] = -(dot(alpha, normal) + dot(w, normal_rate));
        self.gradient(work, condition, a.link, (normal, [0.0; 3]), 1.0);
        self.gradient(work, condition, b.link, (normal, [0.0; 3]), -1.0);
    }

    /// Adds what a moment and a force on a link do on the freedoms.
    fn gradient(
        &self,
        work: &mut LoopWorkspace,
        condition: usize,
        link: usize,
        (moment, force): ([f64; 3], [f64; 3]),
        sign: f64,
    ) {
        let n = self.tree.freedoms;
        for (first, end) in Runs::of(&self.tree, link) {
            let part = &mut work.part[first..end];
            dots(&work.tree.rows, SUBSPACE, first, moment, force, part);
            for (sum, part) in work.gradients[condition * n + first..condition * n + end].iter_mut().zip(part) {
                *sum += sign * *part;
            }
        }
    }
}

/// Two unit vectors across an axis and each other.
fn across(axis: [f64; 3]) -> [[f64; 3]; 2] {
    let least = (0..3).fold(0, |least, k| if axis[k].abs() < axis[least].abs() { k } else { least });
    let mut unit = [0.0; 3];
    unit[least] = 1.0;
    let x = cross(axis, unit);
    let x = scaled(dot(x, x).sqrt().recip(), x);
    [x, cross(axis, x)]
}

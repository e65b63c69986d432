//! What is collected from one pass of the placement map.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Placement, RigidBody};
use piola_numerics::{Gradient, Jet, Real};

use super::directions::CHUNK;
use super::{Forces, Lagrangian, Potential};

/// The vector part of 2 q* r: the angular velocity, in body components, that belongs to the rate r of the
/// unit quaternion q.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn turning<T: Real>(q: [T; 4], r: [T; 4]) -> [T; 3] {
    // Doubled before and not after, exactly: once for all rates of one attitude.
    let [w, x, y, z] = q.map(|q| q + q);
    [
        w * r[1] - x * r[0] - y * r[3] + z * r[2],
        w * r[2] + x * r[3] - y * r[0] - z * r[1],
        w * r[3] - x * r[2] + y * r[1] - z * r[0],
    ]
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    piola_numerics::linear::matrix3::cross(a, b)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    piola_numerics::linear::matrix3::dot(a, b)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn attitude_of<T: Real>([w, x, y, z]: [T; 4]) -> Attitude<T> {
    Attitude { w, x, y, z }
}

/// I a, with the body's inertia tensor as constants.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn inertia_times<T: Real>(body: &RigidBody, a: [T; 3]) -> [T; 3] {
    let i = body.inertia().matrix();
    core::array::from_fn(|row| T::lit(i[(row, 0)]) * a[0] + T::lit(i[(row, 1)]) * a[1] + T::lit(i[(row, 2)]) * a[2])
}

/// What acts on one part, given where it is and how it moves.
#[cfg_attr(not(debug_assertions), inline(always))]
fn applied<T: Real, S, P: Potential, F: Forces>(
    lagrangian: &Lagrangian<S, P, F>,
    part: usize,
    mass: f64,
    position: [T; 3],
    velocity: [T; 3],
    t: T,
) -> [T; 3] {
    let mut force = lagrangian.gravity.map(|g| T::lit(mass * g));
    if F::ON_PARTS {
        let more = lagrangian.forces.on_part(part, position, velocity, t);
        for (force, more) in force.iter_mut().zip(more) {
            *force += more;
        }
    }
    force
}

/// The metric and the right-hand side of g q̈ = f, for at most N coordinates, in one pass.
///
/// ```text
/// g_ΔΓ = Σ m ∂x/∂q^Δ·∂x/∂q^Γ + Σ ω_Δ·I ω_Γ                                                W(3.16)
/// f_Δ  = Σ ∂x/∂q^Δ·(f − m ẍ₀) + Σ ω_Δ·(G − I ω̇₀ − ω×Iω)                                    W(5.4)
/// ```
///
/// where ẍ₀ and ω̇₀ are the accelerations at q̈ = 0: no derivative of the metric is formed.
pub(super) struct Equations<'a, T, S, P, F, const N: usize> {
    pub(super) lagrangian: &'a Lagrangian<S, P, F>,
    pub(super) metric: [[T; N]; N],
    pub(super) force: [T; N],
    pub(super) t: T,
    pub(super) part: usize,
}

impl<'a, T: Real, S, P: Potential, F: Forces, const N: usize> Equations<'a, T, S, P, F, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(lagrangian: &'a Lagrangian<S, P, F>, t: T) -> Self {
        Self { lagrangian, metric: [[T::zero(); N]; N], force: [T::zero(); N], t, part: 0 }
    }

    /// Adds the part of one rate: its derivatives, the same times their inertia, and what is left of the force
    /// at q̈ = 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: [T; N], weigh: impl FnOnce([T; N]) -> [T; N], residual: T) {
        // Nothing moves across the plane of a plane system. A force that is not a number is not lost with it.
        if 2 < N && row.iter().all(T::is_zero) {
            self.force[0] += T::zero() * residual;
            return;
        }
        add_products(&mut self.metric, row, weigh(row));
        for (force, partial) in self.force.iter_mut().zip(row) {
            *force += partial * residual;
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn translation(&mut self, mass: f64, x: Vector3<Jet<T, N>>) {
        let m = T::lit(mass);
        let x = [x.x, x.y, x.z];
        let (position, velocity) = (x.map(|x| x.value), x.map(|x| x.rate));
        let force = applied(self.lagrangian, self.part, mass, position, velocity, self.t);
        for k in 0..3 {
            self.add(x[k].partials, |row| row.map(|p| m * p), force[k] - m * x[k].second_rate);
        }
    }
}

impl<T: Real, S, P: Potential, F: Forces, const N: usize> Placement<Jet<T, N>> for Equations<'_, T, S, P, F, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn particle(&mut self, mass: f64, position: Vector3<Jet<T, N>>) {
        self.translation(mass, position);
        self.part += 1;
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn body(&mut self, body: &RigidBody, centre: Vector3<Jet<T, N>>, attitude: Attitude<Jet<T, N>>) {
        self.translation(body.mass(), centre);
        let jets = [attitude.w, attitude.x, attitude.y, attitude.z];
        let q = jets.map(|jet| jet.value);
        let angular_velocity = turning(q, jets.map(|jet| jet.rate));
        let bias = turning(q, jets.map(|jet| jet.second_rate));
        let mut rows = [[T::zero(); N]; 3];
        let mut weighted = [[T::zero(); N]; 3];
        for i in 0..N {
            let row = turning(q, jets.map(|jet| jet.partials[i]));
            let inertia = inertia_times(body, row);
            for k in 0..3 {
                rows[k][i] = row[k];
                weighted[k][i] = inertia[k];
            }
        }
        let gyroscopic = cross(angular_velocity, inertia_times(body, angular_velocity));
        let bias = inertia_times(body, bias);
        let mut residual: [T; 3] = core::array::from_fn(|k| -(bias[k] + gyroscopic[k]));
        if F::MOMENTS {
            let moment = self.lagrangian.forces.moment_on_body(self.part, attitude_of(q), angular_velocity, self.t);
            for (residual, moment) in residual.iter_mut().zip(moment) {
                *residual += moment;
            }
        }
        for k in 0..3 {
            self.add(rows[k], |_| weighted[k], residual[k]);
        }
        self.part += 1;
    }
}

/// The inertia metric alone, for at most N coordinates, in one pass; its lower triangle by columns.
pub(super) struct Metric<T, const N: usize>(pub(super) [[T; N]; N]);

/// Adds the products of a row with itself, weighted, to the lower triangle of a metric, by columns. Columns begin
/// at even rows, so that they are added in pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn add_products<T: Real, const N: usize>(metric: &mut [[T; N]; N], row: [T; N], weighted: [T; N]) {
    for j in 0..N {
        let first = if N <= 3 { j } else { j & !1 };
        for i in first..N {
            metric[j][i] += weighted[i] * row[j];
        }
    }
}

impl<T: Real, const N: usize> Placement<Gradient<T, N>> for Metric<T, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn particle(&mut self, mass: f64, position: Vector3<Gradient<T, N>>) {
        let m = T::lit(mass);
        for x in [position.x, position.y, position.z] {
            if !x.partials.iter().all(T::is_zero) {
                add_products(&mut self.0, x.partials, x.partials.map(|p| m * p));
            }
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn body(&mut self, body: &RigidBody, centre: Vector3<Gradient<T, N>>, attitude: Attitude<Gradient<T, N>>) {
        self.particle(body.mass(), centre);
        let quaternion = [attitude.w, attitude.x, attitude.y, attitude.z];
        let q = quaternion.map(|q| q.value);
        let mut rows = [[T::zero(); N]; 3];
        let mut weighted = [[T::zero(); N]; 3];
        for i in 0..N {
            let row = turning(q, quaternion.map(|q| q.partials[i]));
            let inertia = inertia_times(body, row);
            for k in 0..3 {
                rows[k][i] = row[k];
                weighted[k][i] = inertia[k];
            }
        }
        for (row, weighted) in rows.into_iter().zip(weighted) {
            add_products(&mut self.0, row, weighted);
        }
    }
}

/// Rows of the placement Jacobian with their inertia, for any number of coordinates: then g = JᵀmJ and f = Jᵀr.
/// The rows of a body are Lᵀω_Δ with I = LLᵀ and weight one.
///
/// They are filled in passes of [`CHUNK`] directions, and kept by passes: of each pass only the rows that are
/// not zero. The parts of a chain do not move with the coordinates of the links behind them, so that half of
/// its rows are; a plane system has no rows across its plane.
#[derive(Clone, Debug)]
pub(super) struct Rows<T> {
    /// The rows that are not zero, one pass after the other.
    pub(super) entries: Vec<[T; CHUNK]>,
    /// The number of the row that each entry is part of.
    pub(super) numbers: Vec<usize>,
    /// Where the entries of each pass begin.
    pub(super) starts: Vec<usize>,
    /// The inertia of each row.
    pub(super) weights: Vec<f64>,
    /// What is left of the force at q̈ = 0.
    pub(super) residual: Vec<T>,
    /// Entries of two passes that belong to one row.
    pub(super) pairs: Vec<[usize; 2]>,
}

impl<T> Rows<T> {
    pub(super) fn clear(&mut self) {
        self.entries.clear();
        self.numbers.clear();
        self.starts.clear();
        self.weights.clear();
        self.residual.clear();
    }

    /// The entries of pass number `pass`.
    pub(super) fn entries_of(&self, pass: usize) -> core::ops::Range<usize> {
        self.starts[pass]..self.starts.get(pass + 1).copied().unwrap_or(self.entries.len())
    }
}

impl<T: Real> Rows<T> {
    /// Leaves in `pairs` the entries of two passes that belong to one row.
    fn pair(&mut self, first: usize, second: usize) {
        let (mut one, mut other) = (self.entries_of(first), self.entries_of(second));
        self.pairs.clear();
        while one.start < one.end && other.start < other.end {
            let (a, b) = (self.numbers[one.start], self.numbers[other.start]);
            if a == b {
                self.pairs.push([one.start, other.start]);
            }
            one.start += usize::from(a <= b);
            other.start += usize::from(b <= a);
        }
    }

    /// The lower triangle of JᵀmJ, down the columns.
    pub(super) fn form_metric(&mut self, n: usize, metric: &mut [T]) {
        for left in 0..self.starts.len() {
            for below in left..self.starts.len() {
                self.pair(left, below);
                for (first_column, first_row) in TILES {
                    if left == below && first_row < first_column {
                        continue;
                    }
                    let tile = self.tile(first_column, first_row);
                    let (column, row) = (left * CHUNK + first_column, below * CHUNK + first_row);
                    for (j, entries) in (column..n).zip(tile) {
                        for (i, entry) in (row..n).zip(entries) {
                            metric[i + j * n] = entry;
                        }
                    }
                }
            }
        }
    }

    /// Σ m J_j J_i over the paired rows, for a few columns j and rows i of the metric.
    fn tile(&self, first_column: usize, first_row: usize) -> [[T; TILE]; TILE] {
        let mut sums = [[T::zero(); TILE]; TILE];
        for &[left, below] in &self.pairs {
            let weight = T::lit(self.weights[self.numbers[left]]);
            let (left, below) = (&self.entries[left], &self.entries[below]);
            let columns: [T; TILE] = core::array::from_fn(|j| weight * left[first_column + j]);
            let rows: [T; TILE] = core::array::from_fn(|i| below[first_row + i]);
            for (sums, column) in sums.iter_mut().zip(columns) {
                for (sum, row) in sums.iter_mut().zip(rows) {
                    *sum += column * row;
                }
            }
        }
        sums
    }

    /// Row number `number`; `out` is zero.
    pub(super) fn row_into(&self, number: usize, out: &mut [T]) {
        for (pass, out) in out.chunks_mut(CHUNK).enumerate() {
            let entries = self.entries_of(pass);
            if let Ok(found) = self.numbers[entries.clone()].binary_search(&number) {
                for (out, &partial) in out.iter_mut().zip(&self.entries[entries.start + found]) {
                    *out = partial;
                }
            }
        }
    }

    /// Adds Jᵀr.
    pub(super) fn add_forces(&self, force: &mut [T]) {
        // A force that is not a number is not lost with a row that is zero.
        if let Some(first) = force.first_mut() {
            *first += self.residual.iter().fold(T::zero(), |sum, &residual| sum + T::zero() * residual);
        }
        for (pass, force) in force.chunks_mut(CHUNK).enumerate() {
            for entry in self.entries_of(pass) {
                let residual = self.residual[self.numbers[entry]];
                for (force, &partial) in force.iter_mut().zip(&self.entries[entry]) {
                    *force += partial * residual;
                }
            }
        }
    }
}

/// Columns and rows of the metric that are summed at once: their sums fit into the registers of any machine.
const TILE: usize = 4;
/// Where the tiles of a pair of passes begin.
const TILES: [(usize, usize); 4] = [(0, 0), (0, TILE), (TILE, 0), (TILE, TILE)];
const _: () = assert!(2 * TILE == CHUNK, "four tiles make a pair of passes");

impl<T> Default for Rows<T> {
    fn default() -> Self {
        Self {
            entries: Vec::new(),
            numbers: Vec::new(),
            starts: Vec::new(),
            weights: Vec::new(),
            residual: Vec::new(),
            pairs: Vec::new(),
        }
    }
}

/// One pass over [`CHUNK`] directions.
pub(super) struct Pass<'a, T, S, P, F> {
    lagrangian: &'a Lagrangian<S, P, F>,
    rows: &'a mut Rows<T>,
    row: usize,
    part: usize,
    t: T,
}

impl<'a, T: Real, S, P: Potential, F: Forces> Pass<'a, T, S, P, F> {
    pub(super) fn new(lagrangian: &'a Lagrangian<S, P, F>, rows: &'a mut Rows<T>, t: T) -> Self {
        rows.starts.push(rows.entries.len());
        Self { lagrangian, rows, row: 0, part: 0, t }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn store(&mut self, partials: [T; CHUNK], weight: f64) {
        if !partials.iter().all(T::is_zero) {
            self.rows.entries.push(partials);
            self.rows.numbers.push(self.row);
        }
        if self.rows.starts.len() == 1 {
            self.rows.weights.push(weight);
        }
        self.row += 1;
    }
}

/// The lower Cholesky factor of an inertia tensor, which is positive definite by construction.
fn root(body: &RigidBody) -> [[f64; 3]; 3] {
    let i = body.inertia().matrix();
    let l00 = i[(0, 0)].sqrt();
    let (l10, l20) = (i[(1, 0)] / l00, i[(2, 0)] / l00);
    let l11 = (i[(1, 1)] - l10 * l10).sqrt();
    let l21 = (i[(2, 1)] - l20 * l10) / l11;
    let l22 = (i[(2, 2)] - l20 * l20 - l21 * l21).sqrt();
    [[l00, 0.0, 0.0], [l10, l11, 0.0], [l20, l21, l22]]
}

/// Lᵀ a.
#[cfg_attr(not(debug_assertions), inline(always))]
fn upper_times<T: Real>(l: &[[f64; 3]; 3], a: [T; 3]) -> [T; 3] {
    core::array::from_fn(|k| {
        let mut sum = T::zero();
        for row in k..3 {
            sum += T::lit(l[row][k]) * a[row];
        }
        sum
    })
}

/// The solution of L y = b.
#[cfg_attr(not(debug_assertions), inline(always))]
fn lower_solve<T: Real>(l: &[[f64; 3]; 3], b: [T; 3]) -> [T; 3] {
    let y0 = b[0] / T::lit(l[0][0]);
    let y1 = (b[1] - T::lit(l[1][0]) * y0) / T::lit(l[1][1]);
    let y2 = (b[2] - T::lit(l[2][0]) * y0 - T::lit(l[2][1]) * y1) / T::lit(l[2][2]);
    [y0, y1, y2]
}

impl<T: Real, S, P: Potential, F: Forces> Placement<Gradient<T, CHUNK>> for Pass<'_, T, S, P, F> {
    fn particle(&mut self, mass: f64, position: Vector3<Gradient<T, CHUNK>>) {
        for x in [position.x, position.y, position.z] {
            self.store(x.partials, mass);
        }
        self.part += 1;
    }

    fn body(&mut self, body: &RigidBody, centre: Vector3<Gradient<T, CHUNK>>, attitude: Attitude<Gradient<T, CHUNK>>) {
        for x in [centre.x, centre.y, centre.z] {
            self.store(x.partials, body.mass());
        }
        let quaternion = [attitude.w, attitude.x, attitude.y, attitude.z];
        let rows = turning_rows(body, quaternion.map(|q| q.value), |i| quaternion.map(|q| q.partials[i]));
        for row in rows {
            self.store(row, 1.0);
        }
        self.part += 1;
    }
}

/// Lᵀ ω_Δ for the directions of one pass.
#[cfg_attr(not(debug_assertions), inline(always))]
fn turning_rows<T: Real>(body: &RigidBody, q: [T; 4], partials: impl Fn(usize) -> [T; 4]) -> [[T; CHUNK]; 3] {
    let l = root(body);
    let mut rows = [[T::zero(); CHUNK]; 3];
    for i in 0..CHUNK {
        let column = upper_times(&l, turning(q, partials(i)));
        for k in 0..3 {
            rows[k][i] = column[k];
        }
    }
    rows
}

impl<T: Real, S, P: Potential, F: Forces> Pass<'_, T, S, P, F> {
    fn translation(&mut self, mass: f64, x: [Jet<T, CHUNK>; 3]) {
        let m = T::lit(mass);
        let (position, velocity) = (x.map(|x| x.value), x.map(|x| x.rate));
        let force = applied(self.lagrangian, self.part, mass, position, velocity, self.t);
        for k in 0..3 {
            self.store(x[k].partials, mass);
            self.rows.residual.push(force[k] - m * x[k].second_rate);
        }
    }
}

impl<T: Real, S, P: Potential, F: Forces> Placement<Jet<T, CHUNK>> for Pass<'_, T, S, P, F> {
    fn particle(&mut self, mass: f64, position: Vector3<Jet<T, CHUNK>>) {
        self.translation(mass, [position.x, position.y, position.z]);
        self.part += 1;
    }

    fn body(&mut self, body: &RigidBody, centre: Vector3<Jet<T, CHUNK>>, attitude: Attitude<Jet<T, CHUNK>>) {
        self.translation(body.mass(), [centre.x, centre.y, centre.z]);
        let jets = [attitude.w, attitude.x, attitude.y, attitude.z];
        let q = jets.map(|jet| jet.value);
        let angular_velocity = turning(q, jets.map(|jet| jet.rate));
        let bias = inertia_times(body, turning(q, jets.map(|jet| jet.second_rate)));
        let gyroscopic = cross(angular_velocity, inertia_times(body, angular_velocity));
        let mut moment: [T; 3] = core::array::from_fn(|k| -(bias[k] + gyroscopic[k]));
        if F::MOMENTS {
            let more = self.lagrangian.forces.moment_on_body(self.part, attitude_of(q), angular_velocity, self.t);
            for (moment, more) in moment.iter_mut().zip(more) {
                *moment += more;
            }
        }
        let l = root(body);
        for row in turning_rows(body, q, |i| jets.map(|jet| jet.partials[i])) {
            self.store(row, 1.0);
        }
        self.rows.residual.extend(lower_solve(&l, moment));
        self.part += 1;
    }
}

/// The kinetic energy, and the potential energy of uniform gravity, from rates along the motion.
pub(super) struct EnergySums<T> {
    pub(super) kinetic: T,
    pub(super) gravitational: T,
    pub(super) gravity: [f64; 3],
}

impl<T: Real> EnergySums<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(gravity: [f64; 3]) -> Self {
        Self { kinetic: T::zero(), gravitational: T::zero(), gravity }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn translation(&mut self, mass: f64, x: [T; 3], v: [T; 3]) {
        let m = T::lit(mass);
        self.kinetic += T::lit(0.5) * m * dot(v, v);
        self.gravitational -= m * dot(self.gravity.map(T::lit), x);
    }
}

impl<T: Real> Placement<piola_numerics::Dual<T>> for EnergySums<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn particle(&mut self, mass: f64, x: Vector3<piola_numerics::Dual<T>>) {
        let x = [x.x, x.y, x.z];
        self.translation(mass, x.map(|x| x.value), x.map(|x| x.tangent));
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn body(
        &mut self,
        body: &RigidBody,
        centre: Vector3<piola_numerics::Dual<T>>,
        attitude: Attitude<piola_numerics::Dual<T>>,
    ) {
        self.particle(body.mass(), centre);
        let q = [attitude.w, attitude.x, attitude.y, attitude.z];
        let angular_velocity = turning(q.map(|q| q.value), q.map(|q| q.tangent));
        self.kinetic += T::lit(0.5) * dot(angular_velocity, inertia_times(body, angular_velocity));
    }
}

/// Q_Δ of the forces on parts and the moments on bodies.
pub(super) struct AppliedSums<'a, T, F, const D: usize> {
    pub(super) forces: &'a F,
    pub(super) generalised: [T; D],
    pub(super) t: T,
    pub(super) part: usize,
}

impl<T: Real, F: Forces, const D: usize> AppliedSums<'_, T, F, D> {
    fn translation(&mut self, x: [Jet<T, D>; 3]) {
        if F::ON_PARTS {
            let force = self.forces.on_part(self.part, x.map(|x| x.value), x.map(|x| x.rate), self.t);
            for (i, sum) in self.generalised.iter_mut().enumerate() {
                *sum += dot(force, x.map(|x| x.partials[i]));
            }
        }
    }
}

impl<T: Real, F: Forces, const D: usize> Placement<Jet<T, D>> for AppliedSums<'_, T, F, D> {
    fn particle(&mut self, _mass: f64, position: Vector3<Jet<T, D>>) {
        self.translation([position.x, position.y, position.z]);
        self.part += 1;
    }

    fn body(&mut self, _body: &RigidBody, centre: Vector3<Jet<T, D>>, attitude: Attitude<Jet<T, D>>) {
        self.translation([centre.x, centre.y, centre.z]);
        if F::MOMENTS {
            let jets = [attitude.w, attitude.x, attitude.y, attitude.z];
            let q = jets.map(|jet| jet.value);
            let angular_velocity = turning(q, jets.map(|jet| jet.rate));
            let moment = self.forces.moment_on_body(self.part, attitude_of(q), angular_velocity, self.t);
            for (i, sum) in self.generalised.iter_mut().enumerate() {
                *sum += dot(moment, turning(q, jets.map(|jet| jet.partials[i])));
            }
        }
        self.part += 1;
    }
}

//! What the linearised equations make of numbers in the cells of a contact, and the transpose of that: the same few sums in every cell, whatever it
//! does, with coefficients that say what it does, field by field. So whole registers of cells go through each of them.
//!
//! With the unknowns `p`, `a`, `b` of a cell, its equations `e`, and tractions and displacements along the normal, x and y:
//!
//! ```text
//! traction:  t_z = p                t_x = X a + s_x p                  t_y = Y a + Z b + s_y p
//! equation:  e_z = u_z / unit       e_a = R_x u_x + R_y u_y + o_a a    e_b = Z u_y / unit + o_b b
//! ```

use super::cell::{Cell, MOTIONS, Shear};
use super::fields::{Fields, zeros};
use crate::fields::{CellRule, Reals, each_cell};

/// The coefficients of the cells of a contact, packed.
pub(super) struct CellRows {
    /// Influence of a cell on itself: the unit of the equations [length/pressure].
    unit: f64,
    /// X, Y and Z [-].
    shear: [Vec<f64>; 3],
    /// `s_x` and `s_y` [-].
    slope: [Vec<f64>; 2],
    /// `R_x` and `R_y` [pressure/length].
    row: [Vec<f64>; 2],
    /// `o_a` and `o_b` [-].
    own: [Vec<f64>; 2],
    /// What the first equation along the surface is multiplied by for the approximate inverse [length/pressure], and how far its unknown is the equation
    /// itself [-].
    inverse: [Vec<f64>; 2],
    /// Place along x and y over the length of the positions.
    place: [Vec<f64>; 2],
}

/// Three fields, one after the other, of a vector that may hold more.
fn three(values: &[f64], cells: usize) -> [&[f64]; 3] {
    [0, 1, 2].map(|field| &values[field * cells..(field + 1) * cells])
}

/// The same, to be changed.
fn three_mut(values: &mut [f64], cells: usize) -> [&mut [f64]; 3] {
    let (first, rest) = values.split_at_mut(cells);
    let (second, rest) = rest.split_at_mut(cells);
    [first, second, &mut rest[..cells]]
}

impl CellRows {
    /// Those of cells; `own`: influence of a cell on itself, normal and tangential [length/pressure].
    pub fn new(cells: &[Cell], [unit, tangential]: [f64; 2]) -> Self {
        let field = || vec![0.0; cells.len()];
        let mut rows = Self {
            unit,
            shear: [(); 3].map(|()| field()),
            slope: [field(), field()],
            row: [field(), field()],
            own: [field(), field()],
            inverse: [vec![unit; cells.len()], field()],
            place: [field(), field()],
        };
        for (place, cell) in cells.iter().enumerate() {
            let [x, y, z] = &mut rows.shear;
            match cell.shear {
                Shear::Held => {
                    (x[place], z[place]) = (1.0, 1.0);
                    rows.row[0][place] = 1.0 / unit;
                }
                Shear::HeldAlong(axis) => {
                    [x, y][axis][place] = 1.0;
                    rows.row[axis][place] = 1.0 / unit;
                    rows.own[1][place] = 1.0;
                }
                Shear::Turns { row, compliance } => {
                    let weight = slip_weight(compliance, tangential);
                    [x[place], y[place]] = cell.across();
                    for (to, row) in rows.row.iter_mut().zip(row) {
                        to[place] = row * weight / unit;
                    }
                    (rows.own[0][place], rows.own[1][place]) = (compliance * weight / unit, 1.0);
                    rows.inverse[0][place] = unit / weight;
                }
                Shear::Follows => {
                    (rows.own[0][place], rows.own[1][place]) = (1.0, 1.0);
                    rows.inverse[1][place] = 1.0;
                }
            }
            for axis in 0..2 {
                rows.slope[axis][place] = cell.slope * cell.along[axis];
                rows.place[axis][place] = cell.place[axis];
            }
        }
        rows
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.place[0].len()
    }

    /// Tractions of unknowns [pressure], and their sums that go with the motions.
    pub fn tractions(&self, unknowns: &[f64], [z, x, y]: &mut Fields) -> [f64; MOTIONS] {
        let ([p, a, b], [tx, ty, tz], [sx, sy]) = (three(unknowns, self.len()), &self.shear, &self.slope);
        each_cell(&Tractions, [p, a, b, tx, ty, tz, sx, sy, &self.place[0], &self.place[1]], [z, x, y])
    }

    /// Sums of tractions that go with the motions [pressure].
    pub fn resultants(&self, tractions: &Fields) -> [f64; MOTIONS] {
        sums_with(&self.place, tractions.each_ref().map(Vec::as_slice))
    }

    /// The transpose of that: adds the tractions of amounts of them.
    pub fn add_resultants(&self, amounts: [f64; MOTIONS], tractions: &mut Fields) {
        add_sums_with(&self.place, amounts, tractions);
    }

    /// The left sides of the cells from displacements less motions [length], and the unknowns.
    pub fn equations(&self, [z, x, y]: &Fields, motions: [f64; MOTIONS], unknowns: &[f64], to: &mut [f64]) {
        let ([_, a, b], cells) = (three(unknowns, self.len()), self.len());
        let ([rx, ry], [oa, ob], [px, py]) = (&self.row, &self.own, &self.place);
        let rule = Equations { motions, per_unit: 1.0 / self.unit };
        each_cell(&rule, [z, x, y, a, b, rx, ry, &self.shear[2], oa, ob, px, py], three_mut(to, cells));
    }

    /// Displacements whose removal is the approximate inverse of equations [length].
    pub fn to_remove(&self, equations: &[f64], [z, x, y]: &mut Fields) {
        let ([ez, ea, eb], [tx, ty, tz]) = (three(equations, self.len()), &self.shear);
        each_cell(&ToRemove { unit: self.unit }, [ez, ea, eb, tx, ty, tz, &self.inverse[0]], [z, x, y]);
    }

    /// Unknowns of the tractions that remove them [pressure].
    pub fn removed(&self, [z, x, y]: &Fields, equations: &[f64], unknowns: &mut [f64]) {
        let ([_, ea, eb], [tx, ty, tz]) = (three(equations, self.len()), &self.shear);
        let [_, known] = &self.inverse;
        let read = [z, x, y, ea, eb, tx, ty, tz, known, &self.own[1]];
        each_cell(&Removed, read, three_mut(unknowns, self.len()));
    }

    /// The transpose of [`equations`](Self::equations): displacements that the cells see, and their sums that go with the motions.
    pub fn seen(&self, equations: &[f64], [z, x, y]: &mut Fields) -> [f64; MOTIONS] {
        let ([ez, ea, eb], [rx, ry]) = (three(equations, self.len()), &self.row);
        let rule = Seen { per_unit: 1.0 / self.unit };
        each_cell(&rule, [ez, ea, eb, rx, ry, &self.shear[2], &self.place[0], &self.place[1]], [z, x, y])
    }

    /// The transpose of [`tractions`](Self::tractions), of tractions and of those by amounts of the motions' resultants; and `factor` times what equations
    /// make of the unknowns themselves, where there are any.
    pub fn unknowns(
        &self,
        ([z, x, y], amounts): (&Fields, [f64; MOTIONS]),
        (equations, factor): (&[f64], f64),
        to: &mut [f64],
    ) {
        let [ea, eb] = if equations.is_empty() {
            [&[][..]; 2]
        } else {
            let [_, ea, eb] = three(equations, self.len());
            [ea, eb]
        };
        let ([tx, ty, tz], [sx, sy], [oa, ob]) = (&self.shear, &self.slope, &self.own);
        let read = [z, x, y, tx, ty, tz, sx, sy, oa, ob, &self.place[0], &self.place[1], ea, eb];
        each_cell(&Unknowns { amounts, factor }, read, three_mut(to, self.len()));
    }

    /// The transpose of [`removed`](Self::removed), of unknowns less those of the tractions by amounts of resultants: displacements to be removed, and what
    /// is left along the surface for [`to_remove_transposed`](Self::to_remove_transposed).
    pub fn removed_transposed(
        &self,
        (unknowns, amounts): (&[f64], [f64; MOTIONS]),
        [z, x, y]: &mut Fields,
        [left_a, left_b]: &mut [Vec<f64>; 2],
    ) {
        let ([p, a, b], [tx, ty, tz], [sx, sy]) = (three(unknowns, self.len()), &self.shear, &self.slope);
        let read = [p, a, b, tx, ty, tz, sx, sy, &self.place[0], &self.place[1]];
        each_cell(&RemovedTransposed { amounts }, read, [z, x, y, left_a, left_b]);
    }

    /// The transpose of [`to_remove`](Self::to_remove), of tractions, with what was left along the surface: equations.
    pub fn to_remove_transposed(&self, [z, x, y]: &Fields, [left_a, left_b]: &[Vec<f64>; 2], to: &mut [f64]) {
        let ([tx, ty, tz], [weight, known]) = (&self.shear, &self.inverse);
        let read: [&[f64]; 11] = [z, x, y, left_a, left_b, tx, ty, tz, weight, known, &self.own[1]];
        each_cell(&ToRemoveTransposed { unit: self.unit }, read, three_mut(to, self.len()));
    }

    /// Packed fields of zeros.
    pub fn no_fields(&self) -> Fields {
        zeros(self.len())
    }
}

/// Sums of fields that go with the motions, over cells at places along x and y.
pub(super) fn sums_with(places: &[Vec<f64>; 2], [z, x, y]: [&[f64]; 3]) -> [f64; MOTIONS] {
    each_cell(&Resultants, [z, x, y, &places[0], &places[1]], [])
}

/// The transpose of that: adds to the fields what amounts of these sums count in each cell.
pub(super) fn add_sums_with(places: &[Vec<f64>; 2], amounts: [f64; MOTIONS], [z, x, y]: &mut Fields) {
    each_cell(&AddResultants(amounts), [&places[0], &places[1]], [z, x, y]);
}

/// Weight of the equation of a cell that slips: then a residual means a traction.
pub(super) fn slip_weight(compliance: f64, tangential: f64) -> f64 {
    1.0 / (1.0 + compliance / tangential)
}

/// Sums that go with the motions, of tractions or displacements at a place.
#[inline(always)]
fn summed<R: Reals>([z, x, y]: [R; 3], [px, py]: [R; 2]) -> [R; MOTIONS] {
    [z, z * px, z * py, x, y, y * px - x * py]
}

/// What amounts of motions make at a place.
#[inline(always)]
fn spread<R: Reals>(amounts: &[f64; MOTIONS], [px, py]: [R; 2]) -> [R; 3] {
    let [even, tilt_x, tilt_y, x, y, turned] = *amounts;
    [px * tilt_x + py * tilt_y + even, px.all(x) - py * turned, px * turned + y]
}

struct Tractions;

impl CellRule<10, 3, MOTIONS> for Tractions {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [p, a, b, tx, ty, tz, sx, sy, px, py]: [R; 10],
        [z, x, y]: &mut [R; 3],
    ) -> [R; MOTIONS] {
        *z = p;
        *x = tx * a + sx * p;
        *y = ty * a + tz * b + sy * p;
        summed([*z, *x, *y], [px, py])
    }
}

struct Resultants;

impl CellRule<5, 0, MOTIONS> for Resultants {
    #[inline(always)]
    fn at<R: Reals>(&self, [z, x, y, px, py]: [R; 5], _: &mut [R; 0]) -> [R; MOTIONS] {
        summed([z, x, y], [px, py])
    }
}

struct AddResultants([f64; MOTIONS]);

impl CellRule<2, 3, 0> for AddResultants {
    #[inline(always)]
    fn at<R: Reals>(&self, place: [R; 2], [z, x, y]: &mut [R; 3]) -> [R; 0] {
        let [mz, mx, my] = spread(&self.0, place);
        (*z, *x, *y) = (*z + mz, *x + mx, *y + my);
        []
    }
}

struct Equations {
    motions: [f64; MOTIONS],
    per_unit: f64,
}

impl CellRule<12, 3, 0> for Equations {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [z, x, y, a, b, rx, ry, tz, oa, ob, px, py]: [R; 12],
        [ez, ea, eb]: &mut [R; 3],
    ) -> [R; 0] {
        let [mz, mx, my] = spread(&self.motions, [px, py]);
        let (z, x, y) = (z - mz, x - mx, y - my);
        *ez = z * self.per_unit;
        *ea = rx * x + ry * y + oa * a;
        *eb = tz * y * self.per_unit + ob * b;
        []
    }
}

struct ToRemove {
    unit: f64,
}

impl CellRule<7, 3, 0> for ToRemove {
    #[inline(always)]
    fn at<R: Reals>(&self, [ez, ea, eb, tx, ty, tz, weight]: [R; 7], [z, x, y]: &mut [R; 3]) -> [R; 0] {
        let first = weight * ea;
        *z = ez * self.unit;
        *x = tx * first;
        *y = ty * first + tz * eb * self.unit;
        []
    }
}

struct Removed;

impl CellRule<10, 3, 0> for Removed {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [z, x, y, ea, eb, tx, ty, tz, known, ob]: [R; 10],
        [p, a, b]: &mut [R; 3],
    ) -> [R; 0] {
        *p = z;
        *a = tx * x + ty * y + known * ea;
        *b = tz * y + ob * eb;
        []
    }
}

struct Seen {
    per_unit: f64,
}

impl CellRule<8, 3, MOTIONS> for Seen {
    #[inline(always)]
    fn at<R: Reals>(&self, [ez, ea, eb, rx, ry, tz, px, py]: [R; 8], [z, x, y]: &mut [R; 3]) -> [R; MOTIONS] {
        *z = ez * self.per_unit;
        *x = rx * ea;
        *y = ry * ea + tz * eb * self.per_unit;
        summed([*z, *x, *y], [px, py])
    }
}

struct Unknowns {
    amounts: [f64; MOTIONS],
    factor: f64,
}

impl CellRule<14, 3, 0> for Unknowns {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [z, x, y, tx, ty, tz, sx, sy, oa, ob, px, py, ea, eb]: [R; 14],
        [p, a, b]: &mut [R; 3],
    ) -> [R; 0] {
        let [mz, mx, my] = spread(&self.amounts, [px, py]);
        let (z, x, y) = (z + mz, x + mx, y + my);
        *p = z + sx * x + sy * y;
        *a = tx * x + ty * y + oa * ea * self.factor;
        *b = tz * y + ob * eb * self.factor;
        []
    }
}

struct RemovedTransposed {
    amounts: [f64; MOTIONS],
}

impl CellRule<10, 5, 0> for RemovedTransposed {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [p, a, b, tx, ty, tz, sx, sy, px, py]: [R; 10],
        [z, x, y, left_a, left_b]: &mut [R; 5],
    ) -> [R; 0] {
        let [mz, mx, my] = spread(&self.amounts, [px, py]);
        *left_a = a - (tx * mx + ty * my);
        *left_b = b - tz * my;
        *z = p - (mz + sx * mx + sy * my);
        *x = tx * *left_a;
        *y = ty * *left_a + tz * *left_b;
        []
    }
}

struct ToRemoveTransposed {
    unit: f64,
}

impl CellRule<11, 3, 0> for ToRemoveTransposed {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [z, x, y, left_a, left_b, tx, ty, tz, weight, known, ob]: [R; 11],
        [ez, ea, eb]: &mut [R; 3],
    ) -> [R; 0] {
        *ez = z * self.unit;
        *ea = weight * (tx * x + ty * y) + known * left_a;
        *eb = tz * y * self.unit + ob * left_b;
        []
    }
}

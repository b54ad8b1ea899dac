//! Contacts of a few cells, and what the equations leave of them, written down a second time.

use super::super::contact_problem::{ContactProblem, Pressure};
use super::super::laws::friction::FrictionLaw;
use super::super::laws::rigid_motions::CellPositions;
use super::super::laws::slip_path::SlipPath;
use super::super::operators::RegionOperators;
use super::super::prescribed::{NormalLoad, TangentialLoads};
use super::super::region::Region;
use super::super::tractions::{Displacements, Tractions};
use crate::compliance::{DirectCompliance, OperatorSet, SharedWorkspace, SurfaceCompliance, SurfaceResponse};
use crate::kernel::{Components, InfluenceCoefficients, influence_coefficients};
use crate::model::{
    Base, Body, CellValues, ContactPair, CoulombFriction, ElasticMaterial, HalfSpace, TangentialField,
};
use crate::random::Random;

/// A few cells of side 1 on a half-space of E = 1 under a rigid body.
pub struct Cells {
    pub shape: [usize; 2],
    pub coefficients: InfluenceCoefficients,
    /// Displacement `3 to + l` by a unit of traction `3 from + k`, by the plain double sum [length/pressure].
    pub matrix: Vec<Vec<f64>>,
}

impl Cells {
    pub fn new(shape: [usize; 2], poisson: f64) -> Self {
        let material = ElasticMaterial::new(1.0, poisson).unwrap();
        let lower = HalfSpace::new(Vec::new(), Base::Elastic(material)).unwrap();
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(lower)).unwrap();
        let coefficients = influence_coefficients(&pair, shape, [1.0; 2], Components::ALL);
        let mut direct = DirectCompliance::new(coefficients.clone(), shape).unwrap();
        let count = shape[0] * shape[1];
        let mut matrix = vec![vec![0.0; 3 * count]; 3 * count];
        for column in 0..3 * count {
            let (mut tractions, mut displacements) = (Tractions::zeros(count), Displacements::zeros(count));
            let [x, y] = tractions.shear.parts_mut();
            [&mut tractions.pressure[..], x, y][column % 3][column / 3] = 1.0;
            direct.full(tractions.parts(), displacements.parts_mut());
            for cell in 0..count {
                for part in 0..3 {
                    matrix[3 * cell + part][column] = displacements.parts()[part][cell];
                }
            }
        }
        Self { shape, coefficients, matrix }
    }

    pub fn count(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    /// Self-influence, normal and tangential.
    pub fn own(&self) -> [f64; 2] {
        [self.matrix[0][0], self.matrix[1][1]]
    }

    pub fn response(&self) -> SurfaceResponse {
        SurfaceResponse::FreeSpace(self.coefficients.clone())
    }

    pub fn operators(&self) -> RegionOperators {
        let (response, shape) = (self.response(), self.shape);
        let wanted = OperatorSet { normal: true, tangential: true, full: true, ..OperatorSet::default() };
        let workspace = SharedWorkspace::default();
        RegionOperators::new(&response, None, Region::whole(shape), wanted, &workspace).unwrap()
    }

    /// Displacements of tractions, cell by cell.
    pub fn displacements(&self, tractions: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let sum = |row: usize| -> f64 {
            tractions.as_flattened().iter().zip(&self.matrix[row]).map(|(t, k)| t * k).sum()
        };
        (0..self.count()).map(|cell| [0, 1, 2].map(|part| sum(3 * cell + part))).collect()
    }

    /// Middle of a cell.
    pub fn middle(&self, cell: usize) -> [f64; 2] {
        let [nx, ny] = self.shape;
        let from_middle = |index: usize, count: usize| index as f64 - 0.5 * (count as f64 - 1.0);
        [from_middle(cell / ny, nx), from_middle(cell % ny, ny)]
    }
}

/// What is asked for, by numbers that the tests read themselves.
pub struct Asked {
    pub gap: Vec<f64>,
    pub friction: Vec<f64>,
    /// Shear strength; infinite where there is none.
    pub strength: f64,
    pub total: Option<f64>,
    pub approach: f64,
    pub give: f64,
    pub before: TangentialField,
    pub path: SlipPath,
    pub rotates: bool,
    pub by_force: [bool; 3],
    pub spring: [f64; 3],
    pub motion: [f64; 3],
    pub resultant: [f64; 3],
}

impl Asked {
    /// By approach and shift, with friction.
    pub fn drawn(random: &mut Random, cells: &Cells) -> Self {
        let count = cells.count();
        let mut field = |size: f64| -> Vec<f64> { (0..count).map(|_| random.between(-size, size)).collect() };
        let before = TangentialField { x: field(0.2), y: field(0.2) };
        Self {
            gap: field(0.5),
            before,
            friction: (0..count).map(|_| random.between(0.1, 0.8)).collect(),
            strength: f64::INFINITY,
            total: None,
            approach: random.between(0.3, 1.5),
            give: 0.0,
            path: SlipPath::default(),
            rotates: false,
            by_force: [false; 3],
            spring: [0.0; 3],
            motion: [random.between(-0.5, 0.5), random.between(-0.5, 0.5), 0.0],
            resultant: [0.0; 3],
        }
    }

    /// The same with lengths and tractions so many times as large: without turned paths.
    pub fn in_units(mut self, unit: f64) -> Self {
        let fields = [&mut self.gap, &mut self.before.x, &mut self.before.y];
        fields.into_iter().flatten().for_each(|value| *value *= unit);
        self.strength *= unit;
        self.total = self.total.map(|total| total * unit);
        self.approach *= unit;
        for mode in 0..3 {
            self.motion[mode] *= unit;
            self.resultant[mode] *= unit;
        }
        self
    }

    pub fn positions(&self, cells: &Cells) -> CellPositions {
        let [nx, ny] = cells.shape;
        let x = (0..nx).map(|i| cells.middle(i * ny)[0]).collect();
        let y = (0..ny).map(|j| cells.middle(j)[1]).collect();
        CellPositions::new(x, y, self.rotates)
    }

    pub fn law(&self, cells: &Cells) -> FrictionLaw {
        let values = ndarray::Array2::from_shape_vec(cells.shape, self.friction.clone()).unwrap();
        let mut law = CoulombFriction::map(values).unwrap();
        if self.strength.is_finite() {
            law = law.with_max_shear(CellValues::Uniform(self.strength)).unwrap();
        }
        FrictionLaw::in_region(&law, Region::whole(cells.shape))
    }

    /// Hands the problem on as the solver takes it.
    pub fn problem<T>(&self, cells: &Cells, then: impl FnOnce(&ContactProblem<'_>) -> T) -> T {
        let (law, positions) = (self.law(cells), self.positions(cells));
        then(&ContactProblem {
            pressure: Pressure::Unknown,
            undeformed: &self.gap,
            friction: &law,
            normal: NormalLoad {
                total: self.total,
                approach: self.approach,
                give: self.give,
                moment: [None; 2],
                hardness: None,
            },
            tangential: TangentialLoads {
                motion: self.motion,
                resultant: self.resultant,
                by_force: self.by_force,
                spring: self.spring,
            },
            before: &self.before,
            path: &self.path,
            positions: &positions,
        })
    }

    /// The rotation field over its length in a cell.
    pub fn around(&self, cells: &Cells, cell: usize) -> [f64; 2] {
        let [nx, ny] = cells.shape;
        let length = (0.5 * (nx as f64 - 1.0)).max(0.5 * (ny as f64 - 1.0));
        let [x, y] = cells.middle(cell);
        if self.rotates { [-y / length, x / length] } else { [0.0; 2] }
    }

    /// Augmented pressure, trial shear and bound of every cell.
    pub fn trials(
        &self,
        cells: &Cells,
        (tractions, approach, motion): Unknowns<'_>,
    ) -> Vec<(f64, [f64; 2], f64)> {
        let own = cells.own();
        let moved = cells.displacements(tractions);
        (0..cells.count())
            .map(|cell| {
                let ([p, qx, qy], [normal, x, y]) = (tractions[cell], moved[cell]);
                let augmented = p - (self.gap[cell] + normal - approach) / own[0];
                let around = self.around(cells, cell);
                let before = self.before.at(cell);
                let slip =
                    [0, 1].map(|axis| motion[axis] + motion[2] * around[axis] + before[axis] - [x, y][axis]);
                let end = self.path.end_of(cell, slip);
                let bound = (self.friction[cell] * augmented.max(0.0)).min(self.strength);
                (augmented, [qx + end[0] / own[1], qy + end[1] / own[1]], bound)
            })
            .collect()
    }

    /// What the equations leave: three of every cell [pressure], then those of the approach and of the motions, in the units that
    /// the merit function has.
    pub fn left(&self, cells: &Cells, unknowns: Unknowns<'_>) -> Vec<f64> {
        let (tractions, approach, motion) = unknowns;
        let mut left = Vec::new();
        let mut sums = [0.0; 4];
        for (cell, (augmented, trial, bound)) in self.trials(cells, unknowns).into_iter().enumerate() {
            let [p, qx, qy] = tractions[cell];
            let size = trial[0].hypot(trial[1]);
            let part = if size > bound { bound / size } else { 1.0 };
            left.extend([p - augmented.max(0.0), qx - part * trial[0], qy - part * trial[1]]);
            let around = self.around(cells, cell);
            let turning = qx * around[0] + qy * around[1];
            sums = [sums[0] + p, sums[1] + qx, sums[2] + qy, sums[3] + turning];
        }
        let loaded = tractions.iter().filter(|[p, ..]| *p > 0.0).count().max(1) as f64;
        let asked = match self.total {
            Some(total) => Some(total),
            None if self.give > 0.0 => Some((self.approach - approach) / self.give),
            None => None,
        };
        left.push(asked.map_or(0.0, |asked| (sums[0] - asked) / loaded.sqrt()));
        for mode in 0..3 {
            let carried = sums[1 + mode] + self.spring[mode] * motion[mode];
            let off = if self.by_force[mode] { carried - self.resultant[mode] } else { 0.0 };
            left.push(off / loaded.sqrt());
        }
        left
    }
}

/// Tractions, approach and motions.
pub type Unknowns<'a> = (&'a [[f64; 3]], f64, [f64; 3]);

pub fn by_cell(fields: [&[f64]; 3]) -> Vec<[f64; 3]> {
    (0..fields[0].len()).map(|cell| fields.map(|field| field[cell])).collect()
}

pub fn tractions_of(cells: &[[f64; 3]]) -> Tractions {
    let part = |k: usize| cells.iter().map(|traction| traction[k]).collect();
    Tractions { pressure: part(0), shear: TangentialField { x: part(1), y: part(2) } }
}

pub fn size(vector: &[f64]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Every kind of load: by force or motion, with and without a machine that gives, a shear strength, turned paths.
pub fn kinds(random: &mut Random, cells: &Cells, kind: usize) -> Asked {
    let mut asked = Asked::drawn(random, cells);
    match kind {
        1 => asked.total = Some(random.between(0.5, 2.0)),
        2 => asked.give = random.between(0.1, 2.0),
        3 => {
            asked.by_force = [true, true, false];
            asked.resultant = [random.between(-0.1, 0.1), random.between(-0.1, 0.1), 0.0];
        }
        4 => {
            asked.total = Some(random.between(0.5, 2.0));
            asked.rotates = true;
            asked.by_force = [false, true, true];
            asked.resultant = [0.0, random.between(-0.1, 0.1), random.between(-0.1, 0.1)];
            asked.motion[2] = random.between(-0.3, 0.3);
        }
        5 => {
            asked.give = random.between(0.1, 2.0);
            asked.rotates = true;
            asked.motion[2] = random.between(-0.3, 0.3);
            asked.by_force = [true, false, false];
            asked.spring = [random.between(0.1, 2.0), 0.0, 0.0];
            asked.resultant[0] = random.between(-0.2, 0.2);
        }
        6 => asked.strength = random.between(0.1, 0.3),
        7 => {
            asked.path = SlipPath::straight(cells.count());
            for cell in 0..cells.count() {
                let last = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
                asked.path.go_on(cell, last, (1.0, 0.0, 1.0));
            }
        }
        8 => asked.friction[0] = 0.0,
        9 => {
            asked.strength = random.between(0.1, 0.3);
            asked.rotates = true;
            asked.by_force = [true; 3];
            asked.resultant = [0, 1, 2].map(|_| random.between(-0.1, 0.1));
        }
        _ => {}
    }
    for mode in 0..3 {
        if asked.by_force[mode] {
            asked.motion[mode] = 0.0;
        }
    }
    asked
}

pub const KINDS: usize = 10;

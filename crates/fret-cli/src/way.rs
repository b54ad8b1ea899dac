//! The way of a loading, increment by increment: force and shift sideways, moment and twist; which of them moves, and in which direction.

use fret_core::history::StepRecord;
use fret_results::Table;

/// The way of a loading.
#[derive(Debug)]
pub struct Way {
    /// Tangential forces along x and y.
    pub forces: Vec<[f64; 2]>,
    /// Shifts along x and y.
    pub shifts: Vec<[f64; 2]>,
    /// Moments about z.
    pub moments: Vec<f64>,
    /// Rotations about z.
    pub rotations: Vec<f64>,
}

impl Way {
    /// Through some increments.
    pub fn through(steps: &[StepRecord]) -> Self {
        Self {
            forces: steps.iter().map(|step| step.tangential_force).collect(),
            shifts: steps.iter().map(|step| step.shift).collect(),
            moments: steps.iter().map(|step| step.twist_moment).collect(),
            rotations: steps.iter().map(|step| step.twist).collect(),
        }
    }

    /// Through a whole history.
    pub fn of(table: &Table) -> Self {
        Self {
            forces: table.vectors("tangential_force"),
            shifts: table.vectors("shift"),
            moments: table.column("twist_moment").to_vec(),
            rotations: table.column("twist").to_vec(),
        }
    }

    /// Whether torsion is what moves: moment times rotation is more than force times shift along either axis, range by range.
    pub fn twists(&self) -> bool {
        let sideways = |axis: usize| {
            let [forces, shifts] =
                [&self.forces, &self.shifts].map(|all| range(all.iter().map(|of| of[axis])));
            forces * shifts
        };
        let of_torsion = range(self.moments.iter().copied()) * range(self.rotations.iter().copied());
        of_torsion > sideways(0).max(sideways(1))
    }

    /// Direction of the largest force, or else of the largest shift, with the sign of the first push; none where they are not above the least ones
    /// that count.
    pub fn direction(&self, [least_force, least_shift]: [f64; 2]) -> Option<[f64; 2]> {
        towards(&self.forces, least_force).or_else(|| towards(&self.shifts, least_shift))
    }
}

fn towards(vectors: &[[f64; 2]], least: f64) -> Option<[f64; 2]> {
    let longest = vectors.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    let first = vectors.iter().find(|[x, y]| x.hypot(*y) > 0.5 * longest)?;
    (longest > least).then(|| first.map(|part| part / first[0].hypot(first[1])))
}

/// From the lowest to the highest value, and to zero.
fn range(values: impl Iterator<Item = f64>) -> f64 {
    let [low, high] = values.fold([0.0_f64; 2], |[low, high], value| [low.min(value), high.max(value)]);
    high - low
}

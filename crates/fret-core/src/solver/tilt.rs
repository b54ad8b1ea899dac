//! Tilt of the upper body: a plane taken off the gap; and the tilt that a prescribed moment asks for, found by Broyden's method around
//! the increment, whose moment rises with the tilt.

use super::settings::{IterationCallback, SolveError};
use super::{ContactSolver, Increment, SolverMemory, Work};
use crate::model::{ContactState, Control, LoadStep};

/// Solutions of one increment on the way to its tilt, at the most.
const MOST_SOLUTIONS: usize = 60;
/// The increments on the way are solved to this fraction of the tolerance.
const FINER: f64 = 0.1;
/// Change of the tilt by which its stiffness is found first, relative to that which moves an edge by the displacement under the load.
const SMALL: f64 = 1e-2;
/// Longest step, relative to the same.
const LONGEST: f64 = 2.0;
/// Shortest one, relative to the same: below it there is no such tilt.
const SHORTEST: f64 = 1e-14;

/// A solution at a tilt.
struct Tried {
    increment: Increment,
    memory: SolverMemory,
    /// Moment less the prescribed one along each axis [force x length]; 0 where the tilt is prescribed.
    off: [f64; 2],
    /// Normal force times the radius of gyration of the pressure along each axis [force x length].
    arm: [f64; 2],
    /// Slope that moves the edge by the mean displacement under the load, along each axis.
    slope: [f64; 2],
}

impl Tried {
    /// The largest moment that is off, relative.
    fn worst(&self) -> f64 {
        (0..2).fold(0.0, |worst: f64, axis| {
            let off = self.off[axis].abs();
            if off == 0.0 { worst } else { worst.max(off / self.arm[axis]) }
        })
    }
}

impl ContactSolver<'_> {
    /// The same solver whose upper body is tilted: what a state that it goes on from says.
    pub fn set_tilt(&mut self, tilt: [f64; 2]) {
        if tilt == self.tilt {
            return;
        }
        let level = self.level.get_or_insert_with(|| self.undeformed.clone());
        let (grid, middle) = (self.grid, self.middle);
        let [x, y] = [0, 1].map(|axis| {
            let at = |index| tilt[axis] * (middle[axis] + grid.centre(axis, index));
            (0..grid.cells()[axis]).map(at).collect::<Vec<f64>>()
        });
        for ((i, j), gap) in self.undeformed.indexed_iter_mut() {
            *gap = level[[i, j]] - (x[i] + y[j]);
        }
        self.tilt = tilt;
        self.coarse = None;
    }

    /// Solves one increment of the part in front of the mirrors, and finds the tilt that its moments ask for.
    pub(super) fn solve_tilted(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        work: &mut Work,
        callback: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        let by_moment = load.tilt.map(|control| matches!(control, Control::Force(_)));
        let tilt = [0, 1].map(|axis| match load.tilt[axis] {
            Control::Motion(slope) | Control::FarEnd(slope) => slope,
            Control::Force(_) => state.tilt[axis],
        });
        if by_moment == [false; 2] {
            self.set_tilt(tilt);
            return self.solve(state, load, work, callback);
        }
        let tolerance = self.settings.tolerance;
        let memory = self.memory.clone();
        self.settings.tolerance = FINER * tolerance;
        let found = self.tilt_by_moment((state, load), tilt, (&memory, tolerance), work, callback);
        self.settings.tolerance = tolerance;
        match found {
            Ok(Tried { mut increment, memory, arm, off, .. }) => {
                self.set_tilt(increment.state.tilt);
                self.memory = memory;
                let off = (0..2).fold(0.0, |worst: f64, axis| {
                    if off[axis] == 0.0 { worst } else { worst.max(off[axis].abs() / arm[axis]) }
                });
                increment.outcome.residual.equilibrium = increment.outcome.residual.equilibrium.max(off);
                increment.work = *work;
                Ok(increment)
            }
            Err(error) => {
                self.set_tilt(state.tilt);
                self.memory = memory;
                Err(error)
            }
        }
    }

    fn tilt_by_moment(
        &mut self,
        (state, load): (&ContactState, &LoadStep),
        start: [f64; 2],
        (memory, tolerance): (&SolverMemory, f64),
        work: &mut Work,
        callback: IterationCallback<'_>,
    ) -> Result<Tried, SolveError> {
        let axes: Vec<usize> = (0..2).filter(|axis| matches!(load.tilt[*axis], Control::Force(_))).collect();
        let mut tilt = start;
        let mut here = self.at_tilt((state, load), tilt, memory, work, callback)?;
        let mut solutions = 1;
        let mut stiffness = memory.tilt_stiffness;
        while here.worst() > tolerance {
            if here.arm == [0.0; 2] {
                break; // bodies apart carry no moment
            }
            // First along each axis alone; the memory of the last increment does where there is one.
            for &axis in &axes {
                if stiffness[axis][axis] > 0.0 {
                    continue;
                }
                let change = SMALL * here.slope[axis] * if here.off[axis] > 0.0 { -1.0 } else { 1.0 };
                let mut beside = tilt;
                beside[axis] += change;
                let there = self.at_tilt((state, load), beside, memory, work, callback)?;
                solutions += 1;
                for &row in &axes {
                    stiffness[row][axis] = (there.off[row] - here.off[row]) / change;
                }
            }
            let Some(step) = newton_step(&stiffness, &axes, &here) else { break };
            let mut fraction = 1.0;
            let next = loop {
                let change = step.map(|step| step * fraction);
                let to = [tilt[0] + change[0], tilt[1] + change[1]];
                let there = self.at_tilt((state, load), to, memory, work, callback);
                solutions += 1;
                match there {
                    Ok(there) if there.arm != [0.0; 2] => {
                        learn(&mut stiffness, &axes, change, &here, &there);
                        if there.worst() < here.worst() {
                            break Some((to, there));
                        }
                    }
                    Ok(_) | Err(SolveError::NotConverged { .. } | SolveError::ContactAtEdge) => {}
                    Err(error) => return Err(error),
                }
                let small = axes.iter().all(|axis| change[*axis].abs() < SHORTEST * here.slope[*axis]);
                if small || solutions >= MOST_SOLUTIONS {
                    break None;
                }
                fraction *= 0.3;
            };
            let Some((to, there)) = next else { break };
            (tilt, here) = (to, there);
        }
        if here.worst() <= tolerance {
            here.memory.tilt_stiffness = stiffness;
            return Ok(here);
        }
        let worst = axes.iter().copied().max_by(|a, b| here.off[*a].abs().total_cmp(&here.off[*b].abs()));
        let axis = worst.unwrap_or(0);
        let Control::Force(asked) = load.tilt[axis] else { return Ok(here) };
        Err(SolveError::NoTilt { asked, reached: asked + here.off[axis] })
    }

    /// The solution at a tilt, from the memory before the increment.
    fn at_tilt(
        &mut self,
        (state, load): (&ContactState, &LoadStep),
        tilt: [f64; 2],
        memory: &SolverMemory,
        work: &mut Work,
        callback: IterationCallback<'_>,
    ) -> Result<Tried, SolveError> {
        self.memory = memory.clone();
        self.set_tilt(tilt);
        let at_it = LoadStep { tilt: tilt.map(Control::Motion), ..*load };
        let increment = self.solve(state, &at_it, work, callback)?;
        let memory = std::mem::take(&mut self.memory);
        let mut tried = self.tried(increment, memory);
        for axis in 0..2 {
            if let Control::Force(asked) = load.tilt[axis] {
                tried.off[axis] = tried.increment.outcome.resultants.tilt_moment[axis] - asked;
            }
        }
        Ok(tried)
    }

    fn tried(&self, increment: Increment, memory: SolverMemory) -> Tried {
        let (grid, middle, area) = (self.grid, self.middle, self.grid.cell_area());
        let pressure = &increment.state.pressure;
        let (mut force, mut work, mut second) = (0.0, 0.0, [0.0; 2]);
        for ((i, j), p) in pressure.indexed_iter().filter(|(_, p)| **p > 0.0) {
            let at = [middle[0] + grid.centre(0, i), middle[1] + grid.centre(1, j)];
            force += p;
            work += p * (increment.state.approach - self.undeformed[[i, j]]);
            for axis in 0..2 {
                second[axis] += p * at[axis] * at[axis];
            }
        }
        let spacing = grid.spacing();
        let radius = [0, 1].map(|axis| {
            if force > 0.0 { (second[axis] / force).sqrt().max(0.5 * spacing[axis]) } else { 0.0 }
        });
        let displacement = if force > 0.0 { (work / force).abs() } else { 0.0 };
        Tried {
            arm: radius.map(|radius| radius * force * area),
            slope: radius.map(|radius| if radius > 0.0 { displacement / radius } else { 0.0 }),
            off: [0.0; 2],
            increment,
            memory,
        }
    }
}

/// The step that would end at the moments, no longer than a stiff contact allows.
fn newton_step(stiffness: &[[f64; 2]; 2], axes: &[usize], here: &Tried) -> Option<[f64; 2]> {
    let mut step = [0.0; 2];
    if let [axis] = axes {
        step[*axis] = -here.off[*axis] / stiffness[*axis][*axis];
    } else {
        let [[xx, xy], [yx, yy]] = *stiffness;
        let determinant = xx * yy - xy * yx;
        step[0] = -(yy * here.off[0] - xy * here.off[1]) / determinant;
        step[1] = -(xx * here.off[1] - yx * here.off[0]) / determinant;
    }
    let longest =
        axes.iter().fold(0.0, |longest: f64, &axis| longest.max(step[axis].abs() / here.slope[axis]));
    if !longest.is_finite() {
        return None;
    }
    Some(if longest > LONGEST { step.map(|step| step * LONGEST / longest) } else { step })
}

/// Broyden's update of the stiffness.
fn learn(stiffness: &mut [[f64; 2]; 2], axes: &[usize], change: [f64; 2], here: &Tried, there: &Tried) {
    // In units in which both axes count alike.
    let unit = here.slope.map(|slope| if slope > 0.0 { slope } else { 1.0 });
    let scaled = [change[0] / unit[0], change[1] / unit[1]];
    let square = axes.iter().map(|&axis| scaled[axis] * scaled[axis]).sum::<f64>();
    if square == 0.0 {
        return;
    }
    for &row in axes {
        let expected: f64 = axes.iter().map(|&column| stiffness[row][column] * change[column]).sum();
        let missing = there.off[row] - here.off[row] - expected;
        for &column in axes {
            stiffness[row][column] += missing * scaled[column] / (square * unit[column]);
        }
    }
}

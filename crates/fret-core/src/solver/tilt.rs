//! Tilt of the upper body: a plane taken off the gap; and the tilt that a prescribed moment asks for.
//!
//! Of a given normal load the moments of the pressure are the gradient of a convex function of the tilts. So along any direction the moment
//! about it only rises, and a bracket closes: Newton steps by Broyden's stiffness give the direction, a search along it the length.

use super::settings::{IterationCallback, SolveError};
use super::{ContactSolver, Increment, SolverMemory};
use crate::model::{ContactState, Control, LoadStep};

/// Solutions of one increment on the way to its tilt, at the most.
const MOST_SOLUTIONS: usize = 240;
/// The increments on the way are solved to this fraction of the tolerance.
const FINER: f64 = 0.1;
/// Change of the tilt by which its stiffness is found first, relative to that which moves an edge by the displacement under the load.
const SMALL: f64 = 1e-2;
/// Longest first step, relative to the same.
const LONGEST: f64 = 2.0;
/// Farthest a search goes, relative to the same: a contact that is moved across the finest grid has tilted less.
const FARTHEST: f64 = 1e5;
/// By so much a step grows that did not reach the moment.
const GROWTH: f64 = 4.0;
/// A bracket narrower than this, relative to the tilt at its end, is closed.
const CLOSED: f64 = 4.0 * f64::EPSILON;
/// With two moments a search along a direction ends where what is off along it fell to this fraction.
const ENOUGH: f64 = 0.3;

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
        callback: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        let tilt = [0, 1].map(|axis| load.tilt[axis].motion().unwrap_or(state.tilt[axis]));
        if load.tilt.iter().all(|control| control.motion().is_some()) {
            self.set_tilt(tilt);
            return self.solve(state, load, callback);
        }
        let tolerance = self.settings.tolerance;
        let memory = self.memory.clone();
        self.settings.tolerance = FINER * tolerance;
        let found = self.tilt_by_moment((state, load), tilt, (&memory, tolerance), callback);
        self.settings.tolerance = tolerance;
        match found {
            Ok(tried) => {
                let off = tried.worst();
                let Tried { mut increment, memory, .. } = tried;
                self.set_tilt(increment.state.tilt);
                self.memory = memory;
                let residual = &mut increment.outcome.residual;
                residual.equilibrium = residual.equilibrium.max(off);
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
        callback: IterationCallback<'_>,
    ) -> Result<Tried, SolveError> {
        let axes: Vec<usize> = (0..2).filter(|&axis| load.tilt[axis].force().is_some()).collect();
        let mut here = self.at_tilt((state, load), start, memory, callback)?;
        let mut search =
            Search { axes, stiffness: memory.tilt_stiffness, tolerance, solutions: 1, stopped: None };
        while here.worst() > tolerance && here.arm != [0.0; 2] {
            // First along each axis alone; the memory of the last increment does where there is one.
            for axis in search.unknown_axes() {
                let change = SMALL * here.slope[axis] * if here.off[axis] > 0.0 { -1.0 } else { 1.0 };
                let mut beside = here.increment.state.tilt;
                beside[axis] += change;
                let there = self.at_tilt((state, load), beside, memory, callback)?;
                search.solutions += 1;
                for row in 0..2 {
                    search.stiffness[row][axis] = (there.off[row] - here.off[row]) / change;
                }
            }
            let mut at = |tilt: [f64; 2]| self.at_tilt((state, load), tilt, memory, callback);
            match search.along_newton(&here, &mut at)? {
                Some(there) => here = there,
                None => break,
            }
        }
        if here.worst() <= tolerance {
            here.memory.tilt_stiffness = search.stiffness;
            return Ok(here);
        }
        if let Some(error) = search.stopped {
            return Err(error);
        }
        let worst =
            search.axes.iter().copied().max_by(|a, b| here.off[*a].abs().total_cmp(&here.off[*b].abs()));
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
        callback: IterationCallback<'_>,
    ) -> Result<Tried, SolveError> {
        self.memory = memory.clone();
        self.set_tilt(tilt);
        let at_it = LoadStep { tilt: tilt.map(Control::Motion), ..*load };
        let increment = self.solve(state, &at_it, callback)?;
        let (grid, middle, area) = (self.grid, self.middle, self.grid.cell_area());
        let (mut force, mut work, mut second) = (0.0, 0.0, [0.0; 2]);
        for ((i, j), p) in increment.state.pressure.indexed_iter().filter(|(_, p)| **p > 0.0) {
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
        let moment = increment.outcome.resultants.tilt_moment;
        Ok(Tried {
            off: [0, 1].map(|axis| load.tilt[axis].force().map_or(0.0, |asked| moment[axis] - asked)),
            arm: radius.map(|radius| radius * force * area),
            slope: radius.map(|radius| if radius > 0.0 { displacement / radius } else { 0.0 }),
            memory: std::mem::take(&mut self.memory),
            increment,
        })
    }
}

/// Solves the increment at a tilt.
type Attempt<'a> = &'a mut dyn FnMut([f64; 2]) -> Result<Tried, SolveError>;

/// The way to the tilts of prescribed moments.
struct Search {
    /// Axes along which a moment is prescribed.
    axes: Vec<usize>,
    /// Moment by tilt, as far as it is known.
    stiffness: [[f64; 2]; 2],
    tolerance: f64,
    /// Increments solved so far.
    solutions: usize,
    /// Why the last search along a direction got no further, where that was not its moments.
    stopped: Option<SolveError>,
}

/// What bounds a search along a direction from above.
enum Above {
    /// Nothing so far.
    Nothing,
    /// Moment along the direction, beyond the prescribed one.
    Moment(f64),
    /// No contact, or no solution.
    Barrier,
}

impl Search {
    /// Axes whose stiffness is not known.
    fn unknown_axes(&self) -> Vec<usize> {
        self.axes.iter().copied().filter(|&axis| !(self.stiffness[axis][axis] > 0.0)).collect()
    }

    /// The direction of Newton's step, no longer than a stiff contact allows; straight against the moments where the stiffness is of no
    /// use.
    fn direction(&self, here: &Tried) -> [f64; 2] {
        let newton = newton_step(&self.stiffness, &self.axes, here);
        let falls = |step: &[f64; 2]| step[0] * here.off[0] + step[1] * here.off[1] < 0.0;
        newton.filter(falls).unwrap_or_else(|| {
            let steepest = |axis: usize| {
                if here.arm[axis] > 0.0 { -here.slope[axis] * (here.off[axis] / here.arm[axis]) } else { 0.0 }
            };
            [steepest(0), steepest(1)]
        })
    }

    /// A solution nearer to the moments along Newton's step. With one moment the bracket is closed until it is met; with two, until what is
    /// off along the step is a fraction of what it was, which lowers the convex function whose gradient the moments are.
    fn along_newton(&mut self, here: &Tried, at: Attempt<'_>) -> Result<Option<Tried>, SolveError> {
        let step = self.direction(here);
        let from = here.increment.state.tilt;
        let along = |tried: &Tried| step[0] * tried.off[0] + step[1] * tried.off[1];
        let first = along(here);
        if !(first < 0.0) {
            return Ok(None);
        }
        self.stopped = None;
        let enough = if self.axes.len() == 1 { 0.0 } else { ENOUGH * -first };
        let (mut low, mut at_low, mut high, mut above) = (0.0, first, 0.0, Above::Nothing);
        let mut best: Option<Tried> = None;
        let mut fraction = 1.0;
        let mut sides = 0_i32;
        while self.solutions < MOST_SOLUTIONS {
            let to = [0, 1].map(|axis| from[axis] + fraction * step[axis]);
            self.solutions += 1;
            match at(to) {
                Ok(there) if there.arm != [0.0; 2] => {
                    let before = best.as_ref().unwrap_or(here);
                    let change = [0, 1].map(|axis| to[axis] - before.increment.state.tilt[axis]);
                    learn(&mut self.stiffness, &self.axes, change, before, &there);
                    let moment = along(&there);
                    if there.worst() <= self.tolerance || moment.abs() <= enough {
                        return Ok(Some(there));
                    }
                    // Illinois: an end that stays twice counts half, so that both ends move
                    if moment < 0.0 {
                        (low, at_low) = (fraction, moment);
                        sides = sides.min(0) - 1;
                        if let (Above::Moment(value), true) = (&mut above, sides < -1) {
                            *value *= 0.5;
                        }
                    } else {
                        (high, above) = (fraction, Above::Moment(moment));
                        sides = sides.max(0) + 1;
                        if sides > 1 {
                            at_low *= 0.5;
                        }
                    }
                    if best.as_ref().is_none_or(|best| there.worst() < best.worst()) {
                        best = Some(there);
                    }
                }
                Ok(_) => (high, above) = (fraction, Above::Barrier),
                Err(error @ (SolveError::NotConverged { .. } | SolveError::ContactAtEdge)) => {
                    (high, above) = (fraction, Above::Barrier);
                    self.stopped = Some(error);
                }
                Err(error) => return Err(error),
            }
            fraction = match above {
                Above::Nothing => GROWTH * fraction,
                Above::Barrier => low + 0.3 * (high - low),
                Above::Moment(value) => {
                    self.stopped = None;
                    let ratio = at_low / (at_low - value);
                    low + (high - low) * if ratio.is_finite() { ratio.clamp(0.02, 0.98) } else { 0.5 }
                }
            };
            let width = (0..2).fold(0.0, |width: f64, axis| width.max(((high - low) * step[axis]).abs()));
            let end = (0..2).fold(0.0, |end: f64, axis| end.max((from[axis] + high * step[axis]).abs()));
            let far =
                self.axes.iter().any(|&axis| (fraction * step[axis]).abs() > FARTHEST * here.slope[axis]);
            if far || !fraction.is_finite() || !matches!(above, Above::Nothing) && width <= CLOSED * end {
                break;
            }
        }
        Ok(best.filter(|best| best.worst() < 0.5 * here.worst()))
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

//! Exploration: semismooth Newton on the projection equations with iterates that need not be feasible, matrix-free.

use super::contact_problem::ContactProblem;
use super::contact_set::ContactSet;
use super::contact_vector::ContactVector;
use super::laws::active_sets::ActiveSets;
use super::laws::rigid_motions::RigidMotions;
use super::laws::slip::{SlipIncrement, TangentialProblem};
use super::linear::problem::Linearised;
use super::operators::RegionOperators;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;

fn env(name: &str, default: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

#[derive(Clone)]
struct Point {
    tractions: Tractions,
    displacements: Displacements,
    approach: f64,
    motion: [f64; 3],
}

impl Point {
    fn towards(&self, other: &Self, fraction: f64) -> Self {
        let between = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + fraction * (b - a)).collect();
        let [p, qx, qy] = [0, 1, 2].map(|k| between(self.tractions.parts()[k], other.tractions.parts()[k]));
        let [normal, x, y] =
            [0, 1, 2].map(|k| between(self.displacements.parts()[k], other.displacements.parts()[k]));
        Self {
            tractions: Tractions { pressure: p, shear: TangentialField { x: qx, y: qy } },
            displacements: Displacements { normal, tangential: TangentialField { x, y } },
            approach: self.approach + fraction * (other.approach - self.approach),
            motion: [0, 1, 2].map(|k| self.motion[k] + fraction * (other.motion[k] - self.motion[k])),
        }
    }
}

struct Attempt<'a> {
    problem: &'a ContactProblem<'a>,
    motions: RigidMotions,
    own: [f64; 2],
    weight: f64,
}

/// Solves to a residual `goal`; true when reached.
pub fn solve(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    goal: f64,
    callback: IterationCallback<'_>,
) -> Result<bool, SolveError> {
    let verbose = env("VERBOSE", 0.0) > 0.0;
    let cells = problem.undeformed.len();
    let own = operators.compliance.self_influence();
    let all = ContactSet::of(cells, |_| true);
    let steepest = {
        let p = tractions.pressure.iter().map(|p| p.max(0.0)).collect::<Vec<_>>();
        problem.friction.bound(&p).slope.iter().fold(0.0_f64, |a, b| a.max(*b))
    };
    let attempt = Attempt {
        problem,
        motions: problem.motions_of(&all),
        own: [own.normal, own.tangential],
        weight: if steepest > 0.0 { 1.0 / steepest } else { 1.0 },
    };
    let mut here = attempt.start(tractions, displacements);
    let mut merit = attempt.merit(&here);
    let eta0 = env("ETA", 0.03);
    let mut eta = eta0;
    operators.linear.begin();
    let stiff = operators.preconditioner.is_stiff();
    let eta0 = if stiff { env("ETASTIFF", 0.003) } else { eta0 };
    eta = eta.min(eta0);
    let most = env("MOSTB", 40.0) as usize;
    let mut reached = false;
    let grow = env("GROW", 0.0);
    let gamma = env("GAMMA", 0.5);
    let power = env("POWER", 1.5);
    for iteration in 0..most {
        let residual = attempt.residual(&here);
        if verbose {
            eprintln!("   it {iteration} merit {merit:.2e} residual {residual:.2e} apps {}", operators.compliance.applications);
        }
        if callback(iteration, residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if residual < goal {
            reached = true;
            break;
        }
        if !residual.is_finite() { break; }
        let Some(next) = attempt.newton_point(&here, operators, settings, eta) else { break };
        let mut fraction = 1.0;
        let mut best: Option<(f64, Point, f64)> = None;
        for _ in 0..10 {
            let trial = here.towards(&next, fraction);
            let there = attempt.merit(&trial);
            let enough = there < merit * (1.0 - 0.1 * fraction) || there < grow * merit;
            if best.as_ref().is_none_or(|b| there < b.0) {
                best = Some((there, trial, fraction));
            }
            if enough { break; }
            fraction *= 0.5;
        }
        let Some((there, trial, taken)) = best else { break };
        if verbose { eprintln!("      step {taken} eta {eta:.1e}"); }
        eta = if there < merit { eta0.min((gamma * (there / merit).powf(power)).max(1e-4)).max((0.5 * goal / attempt.residual(&trial)).min(eta0)) } else { eta0 };
        merit = there;
        here = trial;
    }
    attempt.project(&mut here);
    *tractions = here.tractions;
    *displacements = here.displacements;
    operators.compliance.full(tractions.parts(), displacements.parts_mut());
    Ok(reached)
}

impl Attempt<'_> {
    fn start(&self, tractions: &Tractions, displacements: &Displacements) -> Point {
        let Self { problem, own, .. } = self;
        let mut here = Point {
            tractions: tractions.clone(),
            displacements: displacements.clone(),
            approach: problem.normal.approach_under(&tractions.pressure).unwrap_or(0.0),
            motion: problem.tangential.motion,
        };
        let contact = ContactSet::loaded(&here.tractions.pressure);
        if problem.normal.total.is_some() && contact.len() > 0 {
            let heights = contact.cells().map(|c| here.displacements.normal[c] + problem.undeformed[c]);
            here.approach = heights.sum::<f64>() / contact.len() as f64;
        }
        let bound = problem.friction.packed(&contact).bound(&contact.packed(&here.tractions.pressure));
        let equations = TangentialProblem {
            bound: &bound.bound,
            before: &contact.packed_tangential(problem.before),
            path: &problem.path.packed(&contact),
            motions: &problem.motions_of(&contact),
            self_influence: own[1],
        };
        let shear = contact.packed_tangential(&here.tractions.shear);
        let displacement = contact.packed_tangential(&here.displacements.tangential);
        let found = SlipIncrement::default().find(&equations, &shear, &displacement, [0.0; 3]).motion;
        here.motion = self.motion_under(&here.tractions.shear, found);
        here
    }

    /// Motions: prescribed, those of springs under shear, or as given.
    fn motion_under(&self, shear: &TangentialField, free: [f64; 3]) -> [f64; 3] {
        let loads = self.problem.tangential;
        let sums = [shear.x.iter().sum::<f64>(), shear.y.iter().sum::<f64>(), 0.0];
        [0, 1, 2].map(|mode| {
            if !loads.by_force[mode] {
                loads.motion[mode]
            } else if loads.spring[mode] > 0.0 {
                (loads.resultant[mode] - sums[mode]) / loads.spring[mode]
            } else {
                free[mode]
            }
        })
    }

    fn slip(&self, point: &Point, cell: usize) -> [f64; 2] {
        let [u, before] = [point.displacements.tangential.at(cell), self.problem.before.at(cell)];
        let rigid = self.motions.at(point.motion, cell);
        [0, 1].map(|axis| rigid[axis] + before[axis] - u[axis])
    }

    /// Gap, augmented pressure, trial shear.
    fn cell(&self, point: &Point, cell: usize) -> (f64, f64, [f64; 2]) {
        let Self { problem, own: [normal, tangential], .. } = self;
        let gap = problem.undeformed[cell] + point.displacements.normal[cell] - point.approach;
        let slip = problem.path.end_of(cell, self.slip(point, cell));
        let q = point.tractions.shear.at(cell);
        let trial = [0, 1].map(|axis| q[axis] + slip[axis] / tangential);
        (gap, point.tractions.pressure[cell] - gap / normal, trial)
    }

    fn merit(&self, point: &Point) -> f64 {
        let problem = self.problem;
        let mut square = 0.0;
        let mut sums = [0.0; 4];
        let w2 = self.weight * self.weight;
        let mut count = 0.0_f64;
        for cell in 0..problem.undeformed.len() {
            let p = point.tractions.pressure[cell];
            let q = point.tractions.shear.at(cell);
            let (_, augmented, trial) = self.cell(point, cell);
            let (bound, _) = problem.friction.at(cell, augmented.max(0.0));
            let size = trial[0].hypot(trial[1]);
            let fraction = if size > bound { bound / size } else { 1.0 };
            square += (p - augmented.max(0.0)).powi(2);
            for axis in 0..2 {
                square += w2 * (q[axis] - fraction * trial[axis]).powi(2);
            }
            if p > 0.0 { count += 1.0; }
            sums[0] += p;
            sums[1] += q[0];
            sums[2] += q[1];
            if self.motions.rotates {
                let around = self.motions.rotation.at(cell);
                sums[3] += q[0] * around[0] + q[1] * around[1];
            }
        }
        let cells = count.max(1.0);
        if let Some(total) = problem.normal.total {
            square += (sums[0] - total).powi(2) / cells;
        }
        let held = problem.tangential.held();
        for mode in 0..3 {
            if held[mode] {
                square += w2 * (sums[1 + mode] - problem.tangential.resultant[mode]).powi(2) / cells;
            }
        }
        square.sqrt()
    }

    /// The documented residuals.
    fn residual(&self, point: &Point) -> f64 {
        let Self { problem, own: [normal, _], .. } = self;
        let (mut work, mut load, mut worst) = (0.0, 0.0, 0.0_f64);
        let (mut off, mut bounds2, mut bounds) = (0.0, 0.0, 0.0);
        let mut sums = [0.0; 4];
        for cell in 0..problem.undeformed.len() {
            let p = point.tractions.pressure[cell];
            let q = point.tractions.shear.at(cell);
            let (gap, _, trial) = self.cell(point, cell);
            worst = worst.max(gap.min(p * normal).abs());
            work += p * point.displacements.normal[cell];
            load += p;
            if p > 0.0 || gap < 0.0 {
                let (bound, _) = problem.friction.at(cell, p.max(0.0));
                let size = trial[0].hypot(trial[1]);
                let fraction = if size > bound { bound / size } else { 1.0 };
                off += (q[0] - fraction * trial[0]).powi(2) + (q[1] - fraction * trial[1]).powi(2);
                bounds2 += bound * bound;
                bounds += bound;
            } else {
                off += q[0] * q[0] + q[1] * q[1];
            }
            sums[0] += p;
            sums[1] += q[0];
            sums[2] += q[1];
            if self.motions.rotates {
                let around = self.motions.rotation.at(cell);
                sums[3] += q[0] * around[0] + q[1] * around[1];
            }
        }
        let mut residual = worst / (work / load).abs();
        if bounds2 > 0.0 {
            residual = residual.max((off / bounds2).sqrt());
        }
        if let Some(total) = problem.normal.total {
            residual = residual.max((sums[0] / total - 1.0).abs());
        }
        let held = problem.tangential.held();
        for mode in 0..3 {
            if held[mode] && bounds > 0.0 {
                residual = residual.max((sums[1 + mode] - problem.tangential.resultant[mode]).abs() / bounds);
            }
        }
        residual
    }

    fn project(&self, here: &mut Point) {
        let Self { problem, own: [_, tangential], .. } = self;
        let cells = problem.undeformed.len();
        let mut trial = TangentialField::zeros(cells);
        for cell in 0..cells {
            trial.set(cell, self.cell(here, cell).2);
        }
        super::laws::projection::project_pressure(&mut here.tractions.pressure, problem.normal.total);
        let contact = ContactSet::loaded(&here.tractions.pressure);
        let bound = problem.friction.packed(&contact).bound(&contact.packed(&here.tractions.pressure));
        let sets = ActiveSets::of_trial(&contact.packed_tangential(&trial), &bound, *tangential);
        let mut shear = contact.packed_tangential(&here.tractions.shear);
        let (motions, resultant) = (problem.motions_of(&contact), problem.to_restore(&shear, &bound.bound));
        super::laws::projection::ShearProjection::default().project(&mut shear, &sets, &bound.bound, &motions, resultant);
        here.tractions.shear.clear();
        contact.scatter_tangential(&shear, &mut here.tractions.shear);
    }

    fn newton_point(
        &self,
        here: &Point,
        operators: &mut RegionOperators,
        settings: &SolverSettings,
        eta: f64,
    ) -> Option<Point> {
        let Self { problem, own: [unit, tangential], .. } = self;
        let cells = problem.undeformed.len();
        let (mut augmented, mut trial) = (vec![0.0; cells], TangentialField::zeros(cells));
        let mut chord = TangentialField::zeros(cells);
        for cell in 0..cells {
            let (_, y, w) = self.cell(here, cell);
            augmented[cell] = y;
            trial.set(cell, w);
            chord.set(cell, self.slip(here, cell));
        }
        let contact = ContactSet::of(cells, |cell| augmented[cell] > 0.0);
        if contact.len() == 0 { return None; }
        let law = problem.friction.packed(&contact);
        let y = contact.packed(&augmented);
        let bound = law.bound(&y);
        let w = contact.packed_tangential(&trial);
        let chord = contact.packed_tangential(&chord);
        let path = problem.path.packed(&contact);
        let motions = problem.motions_of(&contact);
        let mut sets = ActiveSets::of_trial(&w, &bound, *tangential);
        sets.turn(&path, &chord);
        // The particular point.
        let n = contact.len();
        let mut p = contact.packed(&here.tractions.pressure);
        if let Some(total) = problem.normal.total {
            let missing = total - p.iter().sum::<f64>();
            let positive: f64 = p.iter().map(|p| p.max(0.0)).sum();
            if !(positive > 0.0) { return None; }
            for p in &mut p { *p += missing * p.max(0.0) / positive; }
        }
        let q = contact.packed_tangential(&here.tractions.shear);
        let mut shear = TangentialField::zeros(n);
        for c in 0..n {
            let old = q.at(c);
            if sets.stick[c] > 0.0 {
                shear.set(c, old);
                continue;
            }
            let along = sets.direction.at(c);
            let size = bound.bound[c] + bound.slope[c] * (p[c] - y[c]);
            let turned = if sets.slip[c] > 0.0 { along[0] * old[1] - along[1] * old[0] } else { 0.0 };
            shear.set(c, [size * along[0] - along[1] * turned, size * along[1] + along[0] * turned]);
        }
        let held = problem.tangential.held();
        if held.contains(&true) {
            let mut gram = [0.0; 6];
            let mut missing = problem.tangential.resultant;
            let modes = |c: usize| -> [[f64; 2]; 3] {
                [motions.at([1.0, 0.0, 0.0], c), motions.at([0.0, 1.0, 0.0], c), motions.at([0.0, 0.0, 1.0], c)]
            };
            let free = |c: usize, v: [f64; 2]| -> [f64; 2] {
                if sets.stick[c] > 0.0 { return v; }
                if sets.slip[c] > 0.0 {
                    let a = sets.direction.at(c);
                    let turn = a[0] * v[1] - a[1] * v[0];
                    return [-a[1] * turn, a[0] * turn];
                }
                [0.0; 2]
            };
            for c in 0..n {
                let m = modes(c);
                let here = shear.at(c);
                for k in 0..3 {
                    missing[k] -= here[0] * m[k][0] + here[1] * m[k][1];
                }
                let f = m.map(|v| free(c, v));
                let b = bound.bound[c];
                for (slot, (k, l)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
                    gram[slot] += b * (f[k][0] * f[l][0] + f[k][1] * f[l][1]);
                }
            }
            let missing = [0, 1, 2].map(|k| if held[k] { missing[k] } else { 0.0 });
            let amounts = RigidMotions::solve_of(held, gram, missing);
            for c in 0..n {
                let push = free(c, motions.at(amounts, c));
                let b = bound.bound[c];
                let here = shear.at(c);
                shear.set(c, [here[0] + b * push[0], here[1] + b * push[1]]);
            }
        }
        let mut point = Tractions::zeros(cells);
        let mut u = here.displacements.clone();
        let mut gap = vec![0.0; n];
        let mut slip = TangentialField::zeros(n);
        let rows = sets.rows();
        let size = p.iter().fold(0.0_f64, |a, b| a.max(*b));
        let mut step = ContactVector::default();
        let mut first_size = 0.0;
        let rounds = if env("MERGE", 1.0) > 0.0 { 0..2 } else { 1..2 };
        for round in rounds {
            if round == 1 {
                contact.scatter(&p, 1.0, &mut point.pressure);
                contact.scatter_tangential(&shear, &mut point.shear);
                operators.compliance.full(point.parts(), u.parts_mut());
            }
            let approach = problem.normal.approach_under(&p).unwrap_or(0.0);
            let fixed = self.motion_under(&shear, [0.0; 3]);
            for (c, cell) in contact.cells().enumerate() {
                gap[c] = problem.undeformed[cell] + u.normal[cell] - approach;
                let (m, before, moved) = (motions.at(fixed, c), problem.before.at(cell), u.tangential.at(cell));
                let v = [0, 1].map(|k| m[k] + before[k] - moved[k]);
                if sets.slip[c] > 0.0 {
                    let row = [rows[0][c], rows[1][c]];
                    let a = sets.direction.at(c);
                    let s = shear.at(c);
                    let tau = a[0] * s[1] - a[1] * s[0];
                    let across = row[0] * v[1] - row[1] * v[0] - sets.slip_compliance[c] * tau;
                    let square = row[0] * row[0] + row[1] * row[1];
                    slip.set(c, [-row[1] * across / square, row[0] * across / square]);
                } else {
                    slip.set(c, v);
                }
            }
            let linearised = Linearised {
                contact: &contact,
                sets: &sets,
                motions: &motions,
                slope: &bound.slope,
                gap: &gap,
                slip: slip.parts(),
                holds_force: problem.normal.total.is_some(),
                weight: self.weight,
                give: problem.give(),
                forcing: eta,
                floor: (0.02 * settings.tolerance * size * unit).max(eta * first_size),
            };
            let RegionOperators { compliance, preconditioner, linear, .. } = operators;
            if round == 0 {
                first_size = linear.precondition(&linearised, preconditioner, &mut step);
            } else {
                let linearised = Linearised { forcing: if first_size > 0.0 { 0.0 } else { eta }, ..linearised };
                linear.solve(&linearised, compliance, preconditioner, &mut step);
            }
            let (dp, [dx, dy]) = step.parts();
            for c in 0..n {
                p[c] += dp[c];
                let s = shear.at(c);
                shear.set(c, [s[0] + dx[c], s[1] + dy[c]]);
            }
        }
        contact.scatter(&p, 1.0, &mut point.pressure);
        contact.scatter_tangential(&shear, &mut point.shear);
        operators.compliance.full(point.parts(), u.parts_mut());
        // Approach and motions of the new point.
        let approach = problem.normal.approach_under(&point.pressure).unwrap_or_else(|| {
            contact.cells().map(|cell| problem.undeformed[cell] + u.normal[cell]).sum::<f64>() / n as f64
        });
        let mut motion = self.motion_under(&point.shear, [0.0; 3]);
        if held.contains(&true) {
            let mut gram = [0.0; 6];
            let mut right = [0.0; 3];
            for (c, cell) in contact.cells().enumerate() {
                let m = [motions.at([1.0, 0.0, 0.0], c), motions.at([0.0, 1.0, 0.0], c), motions.at([0.0, 0.0, 1.0], c)];
                let (fixed, before, moved) = (motions.at(motion, c), problem.before.at(cell), u.tangential.at(cell));
                let v = [0, 1].map(|k| moved[k] - before[k] - fixed[k]);
                if sets.stick[c] > 0.0 {
                    for k in 0..3 {
                        right[k] += v[0] * m[k][0] + v[1] * m[k][1];
                    }
                    for (slot, (k, l)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
                        gram[slot] += m[k][0] * m[l][0] + m[k][1] * m[l][1];
                    }
                } else if sets.slip[c] > 0.0 {
                    let row = [rows[0][c], rows[1][c]];
                    let a = sets.direction.at(c);
                    let s = shear.at(c);
                    let tau = a[0] * s[1] - a[1] * s[0];
                    let wt = sets.slip_weight[c] * sets.slip_weight[c];
                    let value = row[0] * v[1] - row[1] * v[0] + sets.slip_compliance[c] * tau;
                    let rm = m.map(|m| row[0] * m[1] - row[1] * m[0]);
                    for k in 0..3 {
                        right[k] += wt * value * rm[k];
                    }
                    for (slot, (k, l)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
                        gram[slot] += wt * rm[k] * rm[l];
                    }
                }
            }
            let right = [0, 1, 2].map(|k| if held[k] { right[k] } else { 0.0 });
            let found = RigidMotions::solve_of(held, gram, right);
            motion = [0, 1, 2].map(|k| if held[k] { found[k] } else { motion[k] });
        }
        Some(Point { tractions: point, displacements: u, approach, motion })
    }
}

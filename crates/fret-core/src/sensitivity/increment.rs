//! One increment of a history, linearised: how all that it leaves behind changes with all that it found, and with the numbers of the case. Each of
//! its terms goes forward, from changes to changes, and backwards, by its transpose: loads, the rule of slip, what the equations ask for, their
//! solution, and what follows from that.

use super::after::After;
use super::cell::{MOTIONS, Prescribed};
use super::change::{Change, Solution};
use super::contact::{Asked, Contact, Drive};
use super::error::SensitivityError;
use super::fields::{Fields, zeros};
use super::krylov;
use super::linearised::Linearised;
use super::loads::Load;
use super::operators::Operators;
use super::rule::{Cells, PathChange, Rule};
use super::scene::Scene;
use super::solved::Solved;
use super::transposed::Transposed;
use crate::fields::{add_scaled, dot, norm};
use crate::model::Zone;
use crate::model::controls::FREEDOMS;

/// Relative residual of the linear equations that is good enough.
pub(super) const ENOUGH: f64 = 1e-9;

/// Relative residual of the linear equations that is aimed at, of a history solved to a tolerance: what that leaves open is more.
fn target(tolerance: f64) -> f64 {
    (0.1 * tolerance).clamp(1e-13, 1e-9)
}

/// The same backwards, where a residual is measured by what it can change of a derivative, which it changes by a hundredth of that: a millionth of the
/// largest derivative is left at the tolerance that a case has by itself. One below that asks for more.
fn target_backwards(tolerance: f64) -> f64 {
    if tolerance < 1e-8 { target(tolerance) } else { 1e-8 }
}

/// An increment.
pub(super) struct Increment<'a> {
    scene: &'a Scene<'a>,
    load: &'a Load,
    rule: Rule,
    pub contact: Contact<'a>,
    after: After<'a>,
    now: &'a Solved,
    /// Norm of its tractions [pressure].
    size: f64,
}

impl<'a> Increment<'a> {
    /// The increment that led to `now`, under a `load`, by the rule of end points or not.
    pub fn new(
        scene: &'a Scene<'a>,
        (by_end_points, load): (bool, &'a Load),
        now: &'a Solved,
        [before, former]: [&'a Solved; 2],
    ) -> Self {
        let law = before.law_at(scene, load.stage);
        let zones: Vec<Zone> = now.contact.cells().map(|cell| now.zone_of(cell)).collect();
        let contact = (&now.contact, &zones[..]);
        let rule = Rule::new(scene, (load, by_end_points), [before, former], contact, Cells::All);
        let contact = Contact::new(scene, (now, before), (load, &law, &rule));
        let after = After::new(scene, [now, before], (&law, &rule));
        let size = now.tractions.iter().map(|part| dot(part, part)).sum::<f64>().sqrt();
        Self { scene, load, rule, contact, after, now, size }
    }

    /// Its linear equations.
    pub fn equations<'b>(&'b self, operators: &'b mut Operators) -> Result<Linearised<'b>, SensitivityError> {
        let cells = (self.contact.set, &self.contact.cells[..]);
        Linearised::new(operators, cells, self.contact.prescribed, self.scene.region.len())
    }

    /// Changes after it, from those before it and before the one before; the residual of the linear equations where they are not solved.
    pub fn forward(
        &self,
        equations: &mut Linearised<'_>,
        [before, former]: [&Change; 2],
        (drive, numbers): (&Drive, &[f64; FREEDOMS]),
    ) -> Result<Change, f64> {
        let mut next = self.scene.no_change();
        self.load.forward(before, numbers, &mut next);
        let [x, y] = self.scene.strain.forward(&next.load);
        next.strain = [x + drive.strain[0], y + drive.strain[1]];
        let paths = self.rule.forward([before, former, &next]);
        let asked = self.contact.asked(before, &next, (&paths, drive));
        let solution = if self.contact.cells.is_empty() {
            self.apart(before, &asked, drive)
        } else {
            self.solve(equations, asked, drive)?
        };
        self.after.forward((&solution, &paths, drive), before, &mut next);
        Ok(next)
    }

    /// Backwards, from those after it: adds to those before it, before the one before, and to the numbers of the case. `drive.response` is
    /// what the displacements of its tractions count, in all cells of the region. `largest`: the largest product of a right side and of tractions
    /// in the increments so far, beside which what is left of the equations is small enough.
    pub fn transposed(
        &self,
        equations: &mut Linearised<'_>,
        mut next: Change,
        [before, former]: [&mut Change; 2],
        (drive, numbers): (&mut Drive, &mut [f64; FREEDOMS]),
        largest: &mut f64,
    ) -> Result<(), f64> {
        let mut paths = PathChange::none(self.contact.cells.len());
        let solution = self.after.transposed(&mut next, before, (&mut paths, drive));
        let asked = self.solve_transposed(equations, &solution, drive, largest)?;
        self.contact.asked_transposed(&asked, [before, &mut next], (&mut paths, drive));
        self.rule.transposed(paths, [before, former, &mut next]);
        self.scene.strain.transposed(next.strain, &mut next.load);
        drive.strain.iter_mut().zip(next.strain).for_each(|(drive, of)| *drive += of);
        self.load.transposed(&next, before, numbers);
        Ok(())
    }

    fn solve(
        &self,
        equations: &mut Linearised<'_>,
        mut asked: Asked,
        drive: &Drive,
    ) -> Result<Solution, f64> {
        let region = self.scene.region.len();
        let mut moved = drive.response.clone();
        let mut given = zeros(region);
        if !drive.friction.is_none() {
            let [x, y] = self.contact.given(&drive.friction, region);
            given = [vec![0.0; region], x, y];
            for (moved, by_given) in moved.iter_mut().zip(equations.operators.displacements(&given)) {
                add_scaled(moved, 1.0, &by_given);
            }
            let follows =
                equations.rows.resultants(&given.each_ref().map(|field| self.contact.set.packed(field)));
            for motion in 0..MOTIONS {
                asked.amounts[motion] -= match self.contact.prescribed[motion] {
                    Prescribed::Motion => 0.0,
                    Prescribed::Resultant => follows[motion],
                    Prescribed::FarEnd(give) => give * follows[motion],
                };
            }
        }
        let rows = self.contact.rows(&moved.each_ref().map(|field| self.contact.set.packed(field)));
        for (asked, row) in asked.displacements.iter_mut().zip(&rows) {
            add_scaled(asked, -1.0, row);
        }
        let right = equations.right_side(&asked.displacements, &asked.amounts);
        let size = norm(&right);
        let allowed = target(self.scene.plan.case.tolerance) * size;
        let found = krylov::solve(equations, &right, allowed);
        if !(found.left <= ENOUGH * size) {
            return Err(found.left / size);
        }
        let (mut tractions, motions) = equations.parted(&found.unknowns);
        for (traction, given) in tractions.iter_mut().zip(&given) {
            add_scaled(traction, 1.0, given);
        }
        let mut displacements = equations.operators.displacements(&tractions);
        for (displacement, by_response) in displacements.iter_mut().zip(&drive.response) {
            add_scaled(displacement, 1.0, by_response);
        }
        Ok(Solution { tractions, displacements, motions })
    }

    fn solve_transposed(
        &self,
        equations: &mut Linearised<'_>,
        solution: &Solution,
        drive: &mut Drive,
        largest: &mut f64,
    ) -> Result<Asked, f64> {
        // Where all that counts is what displacements in the contact count, the cells see just that: what is left is solved for.
        let packed = solution.displacements.each_ref().map(|field| self.contact.set.packed(field));
        let mut multipliers = equations.rows_of(&packed);
        let (left, mut tractions) = equations.left_of(solution, &multipliers);
        let size = norm(&left);
        // A residual changes the derivatives by its product with the change of the solution, which is of the size of the solution.
        *largest = largest.max(self.product(solution)).max(size * self.size);
        let wanted = target_backwards(self.scene.plan.case.tolerance);
        let allowed = if self.size > 0.0 { wanted * (*largest / self.size) } else { wanted * size };
        let found = krylov::solve(&mut Transposed::of(equations, &self.contact), &left, allowed);
        if !(found.left <= allowed.max(ENOUGH * size)) {
            return Err(found.left / size);
        }
        add_scaled(&mut multipliers, 1.0, &found.unknowns);
        let (asked, amounts) = equations.right_side_transposed(&multipliers);
        if self.contact.cells.iter().any(|cell| cell.along != [0.0; 2]) {
            let follow = std::array::from_fn(|motion| match self.contact.prescribed[motion] {
                Prescribed::Motion => 0.0,
                Prescribed::Resultant => -amounts[motion],
                Prescribed::FarEnd(give) => -give * amounts[motion],
            });
            if self.scene.evolves() {
                // Of each cell by itself: with all multipliers, in one more product.
                (tractions, _) = equations.tractions_of(solution, &multipliers);
                equations.rows.add_resultants(follow, &mut tractions);
                self.contact.given_transposed_in_cells(&tractions, &mut drive.friction);
            } else {
                equations.rows.add_resultants(follow, &mut tractions);
                let by_friction = self.contact.given_transposed(&tractions);
                let everywhere = drive.friction.everywhere.iter_mut();
                for ((friction, by), aside) in everywhere.zip(by_friction).zip(found.aside) {
                    *friction += by - aside;
                }
            }
        }
        let seen = self.contact.seen(&asked);
        for ((response, displacement), seen) in
            drive.response.iter_mut().zip(&solution.displacements).zip(&seen)
        {
            add_scaled(response, 1.0, displacement);
            for (place, cell) in self.contact.set.cells().enumerate() {
                response[cell] -= seen[place];
            }
        }
        Ok(Asked { displacements: asked, amounts })
    }

    /// The product of a solution and of how an objective changes with it, all parts without their signs.
    fn product(&self, counts: &Solution) -> f64 {
        let Solved { tractions, displacements, motions, .. } = self.now;
        let of_fields = |a: &Fields, b: &Fields| -> f64 {
            a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a * b).abs()).sum()
        };
        let of_motions: f64 = motions.iter().zip(&counts.motions).map(|(a, b)| (a * b).abs()).sum();
        of_fields(tractions, &counts.tractions) + of_fields(displacements, &counts.displacements) + of_motions
    }

    /// Changes of bodies that do not touch: motions that are prescribed, and an approach to the first touch where a force is.
    fn apart(&self, before: &Change, asked: &Asked, drive: &Drive) -> Solution {
        let gaps = self.scene.undeformed.iter().zip(&drive.gap);
        let lowest = gaps.fold(
            (f64::INFINITY, 0.0),
            |lowest, (gap, change)| {
                if *gap < lowest.0 { (*gap, *change) } else { lowest }
            },
        );
        let motions = std::array::from_fn(|motion| match self.contact.prescribed[motion] {
            Prescribed::Motion | Prescribed::FarEnd(_) => asked.amounts[motion],
            Prescribed::Resultant if motion == 0 => lowest.1,
            Prescribed::Resultant => before.motions[motion],
        });
        let cells = self.scene.region.len();
        Solution { tractions: zeros(cells), displacements: zeros(cells), motions }
    }
}

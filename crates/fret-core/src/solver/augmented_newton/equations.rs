//! The projection equations: what tractions and motions leave of them, where the method starts, and the way back to feasible tractions.

use super::super::contact_problem::ContactProblem;
use super::super::contact_set::ContactSet;
use super::super::laws::active_sets::ActiveSets;
use super::super::laws::projection::project_pressure;
use super::super::laws::rigid_motions::RigidMotions;
use super::super::laws::slip::{SlipIncrement, TangentialProblem};
use super::super::laws::tilt_motions::TiltMotions;
use super::super::newton;
use super::super::operators::RegionOperators;
use super::super::tractions::{Displacements, Tractions};
use super::point::Point;
use crate::compliance::SurfaceCompliance;
use crate::fields::largest;
use crate::model::TangentialField;

/// Where the response is stiff gap and slip are set against tractions by so many times the self-influence of a cell, normal and tangential: any
/// compliance makes the same equations, and that of a cell alone has long waves, which are far softer, change all sets at once. By trial, films 100
/// to 5000 times stiffer on 96 and 192 cells per side.
const COMPLIANCE_STIFF: [f64; 2] = [2.0, 4.0];

/// The equations of an increment, over all cells of its region.
pub struct Equations<'a> {
    pub problem: &'a ContactProblem<'a>,
    /// Rigid motions of all cells of the region.
    pub motions: RigidMotions,
    /// Those along the normal, where a moment of the pressure is prescribed.
    pub tilt: Option<TiltMotions>,
    /// Compliance by which gap and slip are set against pressure and shear, normal and tangential: the self-influence of a cell, or more
    /// [length/pressure].
    pub self_influence: [f64; 2],
    /// Shear counts in units of the pressure that carries it [-].
    pub weight: f64,
}

/// What the equations of a cell are about.
pub struct AtCell {
    /// `p - g / K_n` [pressure].
    pub augmented: f64,
    /// Slip before it is turned [length].
    pub slip: [f64; 2],
    /// `q + slip / K_t` [pressure].
    pub trial: [f64; 2],
}

impl<'a> Equations<'a> {
    /// Those of a problem; friction is measured by its steepest bound under `tractions`.
    pub fn new(problem: &'a ContactProblem<'a>, tractions: &Tractions, operators: &RegionOperators) -> Self {
        let own = operators.compliance.self_influence();
        let of_stiff = if operators.preconditioner.is_stiff() { COMPLIANCE_STIFF } else { [1.0; 2] };
        let positive: Vec<f64> = tractions.pressure.iter().map(|p| p.max(0.0)).collect();
        let steepest = largest(&problem.friction.bound(&positive).slope);
        Self {
            problem,
            motions: problem.motions_of(&ContactSet::of(positive.len(), |_| true)),
            tilt: problem.tilt_of(&ContactSet::of(positive.len(), |_| true)),
            self_influence: [of_stiff[0] * own.normal, of_stiff[1] * own.tangential],
            weight: if steepest > 0.0 { 1.0 / steepest } else { 1.0 },
        }
    }

    /// The point of tractions: approach and motions that follow from forces are those of feasible ones.
    pub fn start(&self, tractions: &Tractions, displacements: Displacements) -> Point {
        let Self { problem, self_influence: [_, own], .. } = self;
        let contact = ContactSet::loaded(&tractions.pressure);
        let bound = problem.friction.packed(&contact).bound(&contact.packed(&tractions.pressure));
        let equations = TangentialProblem {
            bound: &bound.bound,
            before: &contact.packed_tangential(problem.before),
            path: &problem.path.packed(&contact),
            motions: &problem.motions_of(&contact),
            self_influence: *own,
        };
        let shear = contact.packed_tangential(&tractions.shear);
        let displacement = contact.packed_tangential(&displacements.tangential);
        let free = SlipIncrement::default().find(&equations, &shear, &displacement, [0.0; 3]).motion;
        let (approach, turned) = self.approach_under(&tractions.pressure, &displacements.normal, &contact);
        Point {
            approach,
            turned,
            motion: self.motion_under(&tractions.shear, free),
            tractions: tractions.clone(),
            displacements,
        }
    }

    /// The approach: prescribed, what the machine lets it be, or the mean height of a contact; and the tilts of the plane nearest to its heights,
    /// where moments are prescribed.
    pub fn approach_under(
        &self,
        pressure: &[f64],
        displacement: &[f64],
        contact: &ContactSet,
    ) -> (f64, [f64; 2]) {
        let Self { problem, tilt, .. } = self;
        let prescribed = problem.normal.approach_under(pressure);
        let mut turned = [0.0; 2];
        let mut level = None;
        if let Some(tilt) = tilt {
            let mut inside = vec![0.0; pressure.len()];
            contact.cells().for_each(|cell| inside[cell] = 1.0);
            let heights = (displacement, problem.undeformed, prescribed.unwrap_or(0.0));
            let (found, undeformed) = tilt.turn(|cell| inside[cell], heights);
            (turned, level) = (found, Some(undeformed));
        }
        let undeformed = level.as_deref().unwrap_or(problem.undeformed);
        let height = |cell: usize| undeformed[cell] + displacement[cell];
        let mean = || contact.cells().map(height).sum::<f64>() / contact.len().max(1) as f64;
        (prescribed.unwrap_or_else(mean), turned)
    }

    /// The motions: prescribed, what springs let them be, or as given.
    pub fn motion_under(&self, shear: &TangentialField, free: [f64; 3]) -> [f64; 3] {
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

    /// What the equations of a cell are about.
    pub fn at(&self, point: &Point, cell: usize) -> AtCell {
        let Self { problem, self_influence: [normal, tangential], motions, .. } = self;
        let Point { tractions, displacements, approach, turned, motion } = point;
        let tilted = self.tilt.as_ref().map_or(0.0, |tilt| tilt.at([0.0, turned[0], turned[1]], cell));
        let gap = problem.undeformed[cell] + displacements.normal[cell] - approach - tilted;
        let ([u, before], rigid) = (
            [&displacements.tangential, problem.before].map(|field| field.at(cell)),
            motions.at(*motion, cell),
        );
        let slip = [0, 1].map(|axis| rigid[axis] + before[axis] - u[axis]);
        let (at_end, q) = (problem.path.end_of(cell, slip), tractions.shear.at(cell));
        AtCell {
            augmented: tractions.pressure[cell] - gap / normal,
            slip,
            trial: [0, 1].map(|axis| q[axis] + at_end[axis] / tangential),
        }
    }

    /// Length of what the equations leave over, of the cells and of the resultants [pressure].
    pub fn merit(&self, point: &Point) -> f64 {
        let Self { problem, motions, weight, .. } = self;
        let Tractions { pressure, shear } = &point.tractions;
        let (mut normal, mut tangential) = (0.0, 0.0);
        let (mut total, mut loaded, mut sums) = (0.0, 0_usize, [0.0; 3]);
        for (cell, p) in pressure.iter().enumerate() {
            let AtCell { augmented, trial, .. } = self.at(point, cell);
            let q = shear.at(cell);
            let (bound, _) = problem.friction.at(cell, augmented.max(0.0));
            let size = trial[0].hypot(trial[1]);
            let fraction = if size > bound { bound / size } else { 1.0 };
            normal += (p - augmented.max(0.0)).powi(2);
            tangential += (0..2).map(|axis| (q[axis] - fraction * trial[axis]).powi(2)).sum::<f64>();
            total += p;
            loaded += usize::from(*p > 0.0);
            sums = [sums[0] + q[0], sums[1] + q[1], sums[2]];
            if motions.rotates {
                let around = motions.rotation.at(cell);
                sums[2] += q[0] * around[0] + q[1] * around[1];
            }
        }
        // A resultant that is missing is missed by every cell.
        let cells = loaded.max(1) as f64;
        normal += match &self.tilt {
            None => problem.normal.total.map_or(0.0, |wanted| (total - wanted).powi(2) / cells),
            Some(tilt) => tilt.missing(pressure).map(|missing| missing.powi(2) / cells).iter().sum(),
        };
        let (loads, held) = (problem.tangential, problem.tangential.held());
        let missing = (0..3).filter(|&mode| held[mode]).map(|mode| sums[mode] - loads.resultant[mode]);
        tangential += missing.map(|missing| missing.powi(2) / cells).sum::<f64>();
        (normal + weight * weight * tangential).sqrt()
    }

    /// The tractions of a point brought to what the laws allow; cells slip where its trial shear lies outside of their discs. False where no cell
    /// is left to carry the normal force.
    pub fn project(&self, point: &Point, tractions: &mut Tractions) -> bool {
        let Self { problem, self_influence: [_, own], .. } = self;
        tractions.clone_from(&point.tractions);
        if !project_pressure(&mut tractions.pressure, problem.normal.total, self.tilt.as_ref()) {
            return false;
        }
        newton::project_shear(problem, tractions, |contact, _, bound| {
            let mut trial = TangentialField::zeros(contact.len());
            for (place, cell) in contact.cells().enumerate() {
                trial.set(place, self.at(point, cell).trial);
            }
            ActiveSets::of_trial(&trial, bound, *own)
        });
        true
    }
}

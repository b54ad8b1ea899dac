//! One increment in a region: everything that its equations need, gathered.

use std::borrow::Cow;

use ndarray::Array2;

use super::contact_problem::{ContactProblem, Pressure, Solution};
use super::contact_set::ContactSet;
use super::laws::complementarity::NormalResidual;
use super::laws::friction::FrictionLaw;
use super::laws::limit::{Sliding, sliding};
use super::laws::rigid_motions::CellPositions;
use super::laws::slip_path::SlipPath;
use super::laws::tilt_motions::TiltMotions;
use super::normal::{NormalEquations, first_pressure};
use super::operators::RegionOperators;
use super::prescribed::{NormalLoad, TangentialLoads};
use super::region::Region;
use super::settings::{Carried, Coupling, SolveError, SolverSettings};
use super::stretch::Stretch;
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::model::{ContactState, Control, CoulombFriction, LoadStep, Rig, SurfaceGrid, TangentialField};

/// Friction that carries less than this fraction of what is prescribed is the reason why there is no solution. By the pressure without
/// friction where the two are coupled: that takes some of it away. A sphere that slides at a given approach carried 0.89 to 0.997 of it (friction 0.3 to 2,
/// Poisson's ratio -0.5 to 0.3, with and without coatings).
pub const COUPLED_LIMIT: f64 = 0.98;

/// A relative change of the normal force that is rounding and what the tolerance leaves.
const SAME_LOAD: f64 = 1e-6;
/// Newton iterations of the rule of second order; where it converges it takes about six.
const MOST_TURNING: usize = 24;

/// One increment in one region.
pub struct IncrementProblem<'a> {
    pub grid: &'a SurfaceGrid,
    /// How many cells of the whole contact each of its cells stands for.
    pub copies: usize,
    /// The state before.
    pub state: &'a ContactState,
    /// What is prescribed at the end.
    pub load: &'a LoadStep,
    pub region: Region,
    /// How pressure and shear act on each other.
    pub coupling: Coupling,
    pub friction: FrictionLaw,
    /// That of the state before, where maps have moved since then.
    pub friction_before: Option<FrictionLaw>,
    pub positions: CellPositions,
    /// Whether the bodies touched in the state before.
    pub touched: bool,
    /// Gap before deformation [length], and the tilt of the upper body in it.
    pub undeformed: Vec<f64>,
    pub tilt: [f64; 2],
    /// What is prescribed along the normal and along the surface.
    pub normal: NormalLoad,
    pub tangential: TangentialLoads,
    /// What the bulk stresses do in the increment.
    pub stretch: Stretch,
    /// Whether the contact moves over the grid, so that cells enter and leave it by the way.
    pub travels: bool,
    /// What moving surfaces add to the displacement before [length].
    pub carried: Option<TangentialField>,
    /// By how much moving surfaces have changed the gap before deformation since the state before [length].
    pub moved: Option<Vec<f64>>,
    /// What is known of the paths of slip.
    pub path: SlipPath,
    /// Whether nothing changes in it.
    pub pauses: bool,
    /// A pressure to start from, whatever the state before.
    pub start: Option<Cow<'a, [f64]>>,
}

/// Where the cells of a region are along an axis [length].
pub fn centres(grid: &SurfaceGrid, region: Region, axis: usize) -> Vec<f64> {
    (0..region.shape[axis]).map(|index| grid.centre(axis, region.origin[axis] + index)).collect()
}

/// A solved region.
pub struct Solved {
    /// Pressure and shear.
    pub tractions: Tractions,
    /// Their displacements.
    pub displacements: Displacements,
    /// Change of the tangential displacement of the upper body over the lower, in every cell [length].
    pub drift: TangentialField,
    /// Gap, slip, motions and residuals.
    pub solution: Solution,
    /// By how much the surfaces have yielded in the increment [length]; empty where they have not.
    pub yielded: Vec<f64>,
}

impl<'a> IncrementProblem<'a> {
    /// Gathers what an increment needs inside `region`.
    pub fn new(
        (grid, copies): (&'a SurfaceGrid, usize),
        (undeformed, tilt): (&Array2<f64>, [f64; 2]),
        (friction, coupling): (&CoulombFriction, Coupling),
        (state, load): (&'a ContactState, &'a LoadStep),
        (rig, stretch, pole): (Rig, Stretch, [f64; 2]),
        region: Region,
    ) -> Self {
        let rotates = state.twist != 0.0 || load.twist != Control::Motion(0.0);
        let positions =
            CellPositions::new(centres(grid, region, 0), centres(grid, region, 1), rotates).about(pole);
        let area = grid.cell_area();
        Self {
            grid,
            copies,
            state,
            touched: state.pressure.iter().any(|p| *p > 0.0),
            load,
            region,
            coupling,
            friction: FrictionLaw::in_region(friction, region),
            friction_before: None,
            undeformed: region.gather(undeformed),
            tilt,
            normal: NormalLoad::new(state, load, rig, [positions.length, area]),
            tangential: TangentialLoads::new(state, load, rig, [positions.length, area]),
            positions,
            stretch,
            travels: false,
            carried: None,
            moved: None,
            path: SlipPath::default(),
            pauses: false,
            start: None,
        }
    }

    /// The solution where the bodies do not touch under these loads.
    pub fn apart(&self) -> Option<Solved> {
        let NormalLoad { total, approach, .. } = self.normal;
        let lowest = self.undeformed.iter().copied().fold(f64::INFINITY, f64::min);
        let (apart, approach) = match total {
            Some(total) => (total <= 0.0, lowest),
            None => (approach <= lowest, approach),
        };
        let len = self.region.len();
        apart.then(|| Solved {
            tractions: Tractions::zeros(len),
            displacements: Displacements::zeros(len),
            drift: TangentialField::zeros(len),
            solution: Solution {
                normal: NormalResidual { approach, turned: [0.0; 2], residual: 0.0 },
                gap: self.undeformed.iter().map(|gap| gap - approach).collect(),
                ..Solution::without_slip(len, self.tangential.motion_apart())
            },
            yielded: Vec::new(),
        })
    }

    /// Its equations, as the methods take them.
    pub fn contact_problem<'b>(
        &'b self,
        pressure: Pressure,
        before: &'b TangentialField,
    ) -> ContactProblem<'b> {
        ContactProblem {
            pressure,
            undeformed: &self.undeformed,
            friction: &self.friction,
            normal: self.normal,
            tangential: self.tangential,
            before,
            path: &self.path,
            positions: &self.positions,
        }
    }

    /// A first pressure [pressure].
    pub fn first_pressure(&self, operators: &RegionOperators) -> Vec<f64> {
        if let Some(start) = &self.start {
            return start.to_vec();
        }
        first_pressure(&self.normal_equations(), operators.compliance.self_influence().normal)
    }

    /// Those of the frictionless problem.
    pub fn normal_equations(&self) -> NormalEquations<'_> {
        NormalEquations { undeformed: &self.undeformed, load: self.normal, positions: &self.positions }
    }

    /// The motions along the normal, where a moment of the pressure is prescribed.
    pub fn tilt_motions(&self) -> Option<TiltMotions> {
        self.normal_equations().tilt()
    }

    /// Whether anything asks for shear, or has left some.
    pub fn causes_shear(&self) -> bool {
        let TangentialLoads { motion, resultant, .. } = self.tangential;
        motion != [0.0; 3]
            || !self.stretch.is_none()
            || self.carried.is_some()
            || resultant != [0.0; 3]
            || self.state.shear.iter().any(|shear| shear.iter().any(|q| *q != 0.0))
    }

    /// Whether more or less than before is prescribed along the normal.
    pub fn changes_normal_load(&self) -> bool {
        let NormalLoad { total, approach, give, .. } = self.normal;
        let before: f64 = self.state.pressure.iter().sum();
        match total {
            Some(total) => (total - before).abs() > SAME_LOAD * total,
            None => approach - give * before != self.state.approach,
        }
    }

    /// Settings with fewer iterations where the end-point rule is left to fall back on.
    pub fn limited(&self, settings: &SolverSettings) -> SolverSettings {
        let most = if self.path.turns() { MOST_TURNING } else { usize::MAX };
        SolverSettings { max_newton_iterations: settings.max_newton_iterations.min(most), ..*settings }
    }

    /// Whether friction carries more than a fraction `limit` of what is prescribed, at the pressure of `tractions`.
    pub fn check_limit(&self, tractions: &Tractions, limit: f64) -> Result<(), SolveError> {
        let Sliding { fraction, .. } = self.sliding(tractions);
        if fraction > limit { Ok(()) } else { Err(self.above_limit(fraction)) }
    }

    /// How the contact slides at the pressure of `tractions`.
    pub fn sliding(&self, tractions: &Tractions) -> Sliding {
        let contact = ContactSet::loaded(&tractions.pressure);
        let bound = self.friction.packed(&contact).bound(&contact.packed(&tractions.pressure));
        let loads = TangentialLoads { by_force: self.tangential.held(), ..self.tangential };
        let motions = self.positions.motions_of(&contact, loads);
        sliding(&bound.bound, &motions, self.prescribed())
    }

    /// That friction carries no more than a fraction of what is prescribed.
    pub fn above_limit(&self, fraction: f64) -> SolveError {
        let [x, y, moment] = self.prescribed();
        if moment != 0.0 {
            return SolveError::AboveFullSlip { fraction };
        }
        let asked = x.hypot(y) * self.grid.cell_area();
        let by = if self.friction.has_strength() {
            Carried::Strength
        } else if self.friction.is_uniform()
            && (self.normal.total.is_some() || self.coupling != Coupling::Coupled)
        {
            Carried::Coefficient
        } else {
            Carried::Sliding
        };
        SolveError::AboveSliding { asked, bound: fraction * asked, by }
    }

    /// Sums of shear times mode that are prescribed as they are; zero for the others [pressure].
    pub fn prescribed(&self) -> [f64; 3] {
        let loads = TangentialLoads { by_force: self.tangential.held(), ..self.tangential };
        loads.only_by_force(loads.resultant)
    }
}

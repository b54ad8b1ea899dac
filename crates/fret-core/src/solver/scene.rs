//! One increment seen inside one box: everything the equations need, gathered; solved; and put back on the grid.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::alternating::solve_alternating;
use super::contact_set::ContactSet;
use super::coulomb::{TangentialTask, TangentialVerdict};
use super::coupled::{CoupledTask, solve_together};
use super::frozen::KrylovMemory;
use super::normal::{NormalTask, first_pressure, full_contact_pressure, solve_normal};
use super::preconditioner::Preconditioner;
use super::region::Region;
use super::residual::{NormalVerdict, judge_normal};
use super::retraction::{Retraction, retract_pressure};
use super::rigid::{Places, RigidModes};
use super::settings::{SolveError, SolverSettings, Watch};
use super::shear::solve_shear;
use super::tractions::{Displacements, Tractions};
use super::zones::Zones;
use crate::compliance::{SpectralCompliance, SurfaceCompliance};
use crate::history::{Regime, Residual};
use crate::model::field::sum;
use crate::model::{
    ContactState, Control, CoulombFriction, LoadStep, Scheme, SurfaceGrid, TangentialField, Zone, mean_bound,
};

/// Residual to which the frictionless start of a coupled contact is solved.
const ROUGH: f64 = 1e-2;
/// The operators of a box.
pub struct BoxOperators {
    /// Where the box lies.
    pub region: Region,
    /// The elastic answer.
    pub compliance: SpectralCompliance,
    /// Its approximate inverse.
    pub preconditioner: Preconditioner,
    /// Memory of the Krylov method on frozen zones.
    pub krylov: KrylovMemory,
}

/// One increment in one box.
pub struct Scene<'a> {
    grid: &'a SurfaceGrid,
    state: &'a ContactState,
    region: Region,
    undeformed: Vec<f64>,
    friction: Vec<f64>,
    total: Option<f64>,
    approach: f64,
    places: Places,
    motion: [f64; 3],
    resultant: [f64; 3],
    periodic: bool,
    /// A pressure to start from, whatever the state before.
    start: Option<Vec<f64>>,
}

/// What an increment of pressure and shear in turn can leave out.
#[derive(Debug, Clone, Copy)]
pub struct Turn {
    /// The normal load is that of the state before: pressure stays.
    pub unchanged: bool,
    /// There is no friction: no shear.
    pub frictionless: bool,
    /// No shear is looked for before something causes it.
    pub waits_for_a_cause: bool,
}

/// A solved box.
pub struct Solved {
    /// Pressure and shear.
    pub tractions: Tractions,
    /// Their displacements.
    pub displacements: Displacements,
    /// Gap [length].
    pub gap: Vec<f64>,
    /// Minus the slip increment [length].
    s: TangentialField,
    normal: NormalVerdict,
    tangential: TangentialVerdict,
    /// Outer iterations.
    pub iterations: usize,
}

/// Sums of the tractions.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Resultants {
    /// Normal force [force].
    pub normal: f64,
    /// Tangential force on the lower body [force].
    pub tangential: [f64; 2],
    /// Moment about z on the lower body [force x length].
    pub moment: f64,
}

/// What an increment did, apart from the fields.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// Resultants of the tractions.
    pub resultants: Resultants,
    /// Cells in contact.
    pub contact_cells: usize,
    /// Cells that stick.
    pub stick_cells: usize,
    /// What the contact does.
    pub regime: Regime,
    /// How well the equations hold.
    pub residual: Residual,
}

impl<'a> Scene<'a> {
    /// Gathers what an increment needs inside `region`.
    pub fn new(
        grid: &'a SurfaceGrid,
        undeformed: &Array2<f64>,
        friction: &CoulombFriction,
        state: &'a ContactState,
        load: &LoadStep,
        region: Region,
        periodic: bool,
    ) -> Self {
        let centres = |axis: usize| -> Vec<f64> {
            (0..region.shape[axis]).map(|index| grid.centre(axis, region.origin[axis] + index)).collect()
        };
        let controls = [load.tangential[0], load.tangential[1], load.twist];
        let by_force = controls.map(|control| matches!(control, Control::Force(_)));
        let rotates = state.twist != 0.0 || load.twist != Control::Motion(0.0);
        let places = Places::new(centres(0), centres(1), rotates, by_force);
        let area = grid.cell_area();
        let now = [state.shift[0], state.shift[1], state.twist];
        let units = [1.0, 1.0, places.length];
        let mut motion = [0.0; 3];
        let mut resultant = [0.0; 3];
        for mode in 0..3 {
            match controls[mode] {
                Control::Motion(target) => motion[mode] = (target - now[mode]) * units[mode],
                Control::Force(target) => resultant[mode] = target / (area * units[mode]),
            }
        }
        let [_, columns] = region.shape;
        let friction = (0..region.len())
            .map(|cell| friction.at(region.origin[0] + cell / columns, region.origin[1] + cell % columns))
            .collect();
        let (total, approach) = match load.normal {
            Control::Force(force) => (Some(force / area), state.approach),
            Control::Motion(approach) => (None, approach),
        };
        Self {
            grid,
            state,
            region,
            undeformed: region.gather(undeformed),
            friction,
            total,
            approach,
            places,
            motion,
            resultant,
            periodic,
            start: None,
        }
    }

    /// Starts from a pressure on the whole grid.
    pub fn starting_from(self, pressure: &Array2<f64>) -> Self {
        Self { start: Some(self.region.gather(pressure)), ..self }
    }

    /// The bodies do not touch under these loads.
    pub fn is_apart(&self) -> bool {
        let lowest = self.undeformed.iter().copied().fold(f64::INFINITY, f64::min);
        match self.total {
            Some(total) => total <= 0.0,
            None => self.approach <= lowest,
        }
    }

    /// Bodies that do not touch.
    pub fn apart(&self) -> Solved {
        let len = self.region.len();
        let lowest = self.undeformed.iter().copied().fold(f64::INFINITY, f64::min);
        let approach = if self.total.is_some() { lowest } else { self.approach };
        Solved {
            tractions: Tractions::zeros(len),
            displacements: Displacements::zeros(len),
            gap: self.undeformed.iter().map(|gap| gap - approach).collect(),
            s: TangentialField::zeros(len),
            normal: NormalVerdict { approach, residual: 0.0 },
            tangential: TangentialVerdict { motion: self.motion, residual: 0.0 },
            iterations: 0,
        }
    }

    fn touched(&self) -> bool {
        self.state.pressure.iter().any(|p| *p > 0.0)
    }

    fn normal_task(&self) -> NormalTask<'_> {
        NormalTask { undeformed: &self.undeformed, total: self.total, approach: self.approach }
    }

    /// A first pressure; exact at once where a scene that repeats is in full contact.
    fn first_pressure(&self, own: f64, preconditioner: &mut Preconditioner) -> Vec<f64> {
        if let Some(start) = &self.start {
            return start.clone();
        }
        let task = self.normal_task();
        let full = if self.periodic { full_contact_pressure(&task, preconditioner) } else { None };
        full.unwrap_or_else(|| first_pressure(&task, own))
    }

    fn bound(&self, pressure: &[f64]) -> Vec<f64> {
        pressure.iter().zip(&self.friction).map(|(p, mu)| p * mu).collect()
    }

    fn task<'b>(
        &self,
        contact: &'b ContactSet,
        bound: &'b [f64],
        before: &'b TangentialField,
        modes: &'b RigidModes,
        own: f64,
    ) -> TangentialTask<'b> {
        TangentialTask {
            shape: self.region.shape,
            contact,
            bound,
            before,
            modes,
            motion: self.motion,
            resultant: self.resultant,
            own,
        }
    }

    /// Predicted tractions made feasible.
    fn feasible(&self, tractions: &mut Tractions, own: f64) {
        if let Some(total) = self.total {
            // Shear keeps its ratio to the pressure: what was on its circle stays there.
            let found: f64 = tractions.pressure.iter().map(|p| p.max(0.0)).sum();
            if found > 0.0 {
                for q in tractions.shear.x.iter_mut().chain(&mut tractions.shear.y) {
                    *q *= total / found;
                }
            }
        }
        retract_pressure(&mut tractions.pressure, self.total);
        self.feasible_shear(tractions, own);
    }

    /// Predicted shear made feasible under its pressure.
    fn feasible_shear(&self, tractions: &mut Tractions, own: f64) {
        let contact = loaded(&tractions.pressure);
        let bound = contact.packed(&self.bound(&tractions.pressure));
        let mut shear = contact.packed_tangential(&tractions.shear);
        let at_rest = TangentialField::zeros(contact.len());
        let modes = self.places.modes(&contact);
        let zones = Zones::of(&shear, &at_rest, &bound);
        Retraction::default().shear(&mut shear, &zones, &self.task(&contact, &bound, &at_rest, &modes, own));
        contact.scatter_tangential(&shear, &mut tractions.shear);
    }

    /// Pressure and shear together. `settled`: displacements of the state before, when they are known.
    pub fn together(
        &self,
        mut tractions: Tractions,
        settled: Option<&Displacements>,
        operators: &mut BoxOperators,
        settings: &SolverSettings,
        watch: Watch<'_>,
    ) -> Result<Solved, SolveError> {
        let len = self.region.len();
        let BoxOperators { compliance, preconditioner, krylov, .. } = operators;
        let own = compliance.own();
        let mut displacements = Displacements::zeros(len);
        let mut before = TangentialField::zeros(len);
        if self.touched() {
            before = self.displaced_before(settled, compliance, true);
            self.feasible(&mut tractions, own.tangential);
        } else {
            tractions.shear.clear();
            tractions.pressure = self.first_pressure(own.normal, preconditioner);
            compliance.normal(&tractions.pressure, &mut displacements.normal);
            let rough = SolverSettings { tolerance: ROUGH, ..*settings };
            solve_normal(
                &self.normal_task(),
                &mut tractions.pressure,
                &mut displacements.normal,
                compliance,
                preconditioner,
                &rough,
                watch,
            )?;
            self.feasible(&mut tractions, own.tangential);
        }
        compliance.full(tractions.parts(), displacements.parts_mut());
        let task = CoupledTask {
            undeformed: &self.undeformed,
            friction: &self.friction,
            total: self.total,
            approach: self.approach,
            before: &before,
            places: &self.places,
            motion: self.motion,
            resultant: self.resultant,
        };
        let unsolved = (&mut tractions, &mut displacements);
        let solution = match settings.scheme {
            Scheme::Alternating => {
                let (tractions, displacements) = unsolved;
                solve_alternating(
                    &task,
                    tractions,
                    displacements,
                    compliance,
                    preconditioner,
                    settings,
                    watch,
                )
            }
            Scheme::Together => {
                solve_together(&task, unsolved, compliance, preconditioner, krylov, settings, watch)
            }
        }?;
        Ok(Solved {
            tractions,
            displacements,
            gap: solution.gap,
            s: solution.s,
            normal: solution.normal,
            tangential: solution.tangential,
            iterations: solution.iterations,
        })
    }

    /// Tangential displacement of the state before, in the box.
    fn displaced_before(
        &self,
        settled: Option<&Displacements>,
        compliance: &mut SpectralCompliance,
        with_pressure: bool,
    ) -> TangentialField {
        if let Some(settled) = settled {
            return settled.tangential.clone();
        }
        let mut before = TangentialField::zeros(self.region.len());
        let shear = self.region.gather_tangential(&self.state.shear);
        if with_pressure {
            let pressure = self.region.gather(&self.state.pressure);
            let mut aside = vec![0.0; self.region.len()];
            let ([from_x, from_y], [to_x, to_y]) = (shear.parts(), before.parts_mut());
            compliance.full([&pressure, from_x, from_y], [&mut aside, to_x, to_y]);
        } else if shear.x.iter().chain(&shear.y).any(|q| *q != 0.0) {
            compliance.tangential(shear.parts(), before.parts_mut());
        }
        before
    }

    /// Pressure first, then shear on it: for bodies whose shear does not move the surfaces normally.
    pub fn in_turn(
        &self,
        mut tractions: Tractions,
        settled: Option<&Displacements>,
        turn: Turn,
        operators: &mut BoxOperators,
        settings: &SolverSettings,
        watch: Watch<'_>,
    ) -> Result<Solved, SolveError> {
        let len = self.region.len();
        let BoxOperators { compliance, preconditioner, .. } = operators;
        let own = compliance.own();
        let mut displacements = Displacements::zeros(len);
        let (mut gap, normal, mut iterations);
        if let (true, Some(settled)) = (turn.unchanged, settled) {
            tractions.pressure = self.region.gather(&self.state.pressure);
            displacements.normal.clone_from(&settled.normal);
            gap = displacements.normal.iter().zip(&self.undeformed).map(|(u, g)| u + g).collect::<Vec<_>>();
            let prescribed = if self.total.is_none() { Some(self.approach) } else { None };
            normal = judge_normal(&tractions.pressure, &mut gap, &self.undeformed, own.normal, prescribed);
            iterations = 0;
        } else {
            let usable = retract_pressure(&mut tractions.pressure, self.total);
            if self.start.is_some() || !self.touched() || !usable {
                tractions.pressure = self.first_pressure(own.normal, preconditioner);
            }
            compliance.normal(&tractions.pressure, &mut displacements.normal);
            let solution = solve_normal(
                &self.normal_task(),
                &mut tractions.pressure,
                &mut displacements.normal,
                compliance,
                preconditioner,
                settings,
                watch,
            )?;
            gap = solution.gap;
            normal = solution.verdict;
            iterations = solution.iterations;
        }
        let mut s = TangentialField::zeros(len);
        let mut tangential = TangentialVerdict { motion: self.motion, residual: 0.0 };
        let caused = !turn.waits_for_a_cause
            || self.motion != [0.0; 3]
            || self.resultant != [0.0; 3]
            || self.state.shear.iter().any(|shear| shear.iter().any(|q| *q != 0.0));
        if turn.frictionless || !caused {
            tractions.shear.clear();
        } else {
            let before = self.displaced_before(settled, compliance, false);
            self.feasible_shear(&mut tractions, own.tangential);
            compliance.tangential(tractions.shear.parts(), displacements.tangential.parts_mut());
            let contact = loaded(&tractions.pressure);
            let bound = contact.packed(&self.bound(&tractions.pressure));
            let before = contact.packed_tangential(&before);
            let modes = self.places.modes(&contact);
            let mut shear = contact.packed_tangential(&tractions.shear);
            let solution = solve_shear(
                &self.task(&contact, &bound, &before, &modes, own.tangential),
                &mut shear,
                &mut displacements.tangential,
                compliance,
                preconditioner,
                settings,
                watch,
            )?;
            contact.scatter_tangential(&shear, &mut tractions.shear);
            contact.scatter_tangential(&solution.s, &mut s);
            tangential = solution.verdict;
            iterations += solution.iterations;
        }
        Ok(Solved { tractions, displacements, gap, s, normal, tangential, iterations })
    }

    /// The state after the increment, and what happened.
    pub fn settle(&self, solved: &Solved) -> (ContactState, Outcome) {
        let Tractions { pressure, shear } = &solved.tractions;
        let area = self.grid.cell_area();
        let contact = loaded(pressure);
        let bound = contact.packed(&self.bound(pressure));
        let packed = contact.packed_tangential(shear);
        let s = contact.packed_tangential(&solved.s);
        let zones = Zones::of(&packed, &s, &bound);
        let modes = self.places.modes(&contact);
        let mut state = ContactState::untouched(self.grid.cells());
        state.worn_depth.clone_from(&self.state.worn_depth);
        self.region.place(pressure, &mut state.pressure);
        self.region.place(&shear.x, &mut state.shear[0]);
        self.region.place(&shear.y, &mut state.shear[1]);
        for (slip, before) in state.slip.iter_mut().zip(&self.state.slip) {
            if before.iter().any(|slip| *slip != 0.0) {
                slip.assign(before);
            }
        }
        (state.shift, state.twist) = (self.state.shift, self.state.twist);
        state.dissipated_energy = self.state.dissipated_energy;
        state.approach = solved.normal.approach;
        let moved = solved.tangential.motion;
        state.shift = [state.shift[0] + moved[0], state.shift[1] + moved[1]];
        state.twist += moved[2] / self.places.length;
        let columns = self.region.shape[1];
        let mut stick_cells = 0;
        let mut sums = [0.0; 3];
        let mut dissipated = 0.0;
        for (place, cell) in contact.cells().enumerate() {
            let at = [self.region.origin[0] + cell / columns, self.region.origin[1] + cell % columns];
            let q = packed.at(place);
            sums[0] += q[0];
            sums[1] += q[1];
            if modes.rotates {
                sums[2] += q[0] * modes.rotation.x[place] + q[1] * modes.rotation.y[place];
            }
            if zones.is_on_circle(place) {
                state.zone[at] = Zone::Slip;
                let slip = [-s.x[place], -s.y[place]];
                state.slip[0][at] += slip[0];
                state.slip[1][at] += slip[1];
                let ratio = mean_bound(self.state.pressure[at], pressure[cell]);
                dissipated += ratio * (q[0] * slip[0] + q[1] * slip[1]);
            } else {
                state.zone[at] = Zone::Stick;
                stick_cells += 1;
            }
        }
        state.dissipated_energy += dissipated * area;
        let total = sum(pressure);
        let limit = sum(&bound);
        let mut equilibrium = match self.total {
            Some(asked) if asked > 0.0 => ((total - asked) / asked).abs(),
            _ => 0.0,
        };
        if limit > 0.0 {
            for mode in 0..3 {
                if modes.by_force[mode] {
                    equilibrium = equilibrium.max(((sums[mode] - self.resultant[mode]) / limit).abs());
                }
            }
        }
        let regime = match (contact.len(), stick_cells) {
            (0, _) => Regime::Apart,
            _ if limit == 0.0 => Regime::Frictionless,
            (_, 0) => Regime::GrossSlip,
            (all, stick) if all == stick => Regime::FullStick,
            _ => Regime::PartialSlip,
        };
        let outcome = Outcome {
            resultants: Resultants {
                normal: total * area,
                tangential: [sums[0] * area, sums[1] * area],
                moment: sums[2] * area * self.places.length,
            },
            contact_cells: contact.len(),
            stick_cells,
            regime,
            residual: Residual {
                complementarity: solved.normal.residual,
                coulomb: solved.tangential.residual,
                equilibrium,
            },
        };
        (state, outcome)
    }
}

/// Cells with pressure.
fn loaded(pressure: &[f64]) -> ContactSet {
    ContactSet::of(pressure.len(), |cell| pressure[cell] > 0.0)
}

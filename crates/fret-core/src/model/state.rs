//! All that an increment leaves behind for the next one: history lives here and nowhere else.

use std::borrow::Cow;

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::accumulated::AccumulatedSlip;
use super::load::LoadStep;
use crate::fields::stored::{self, Number};
use crate::fields::{Outside, carried, carried_by_whole_cells, copied, is_zero};

/// What a cell of the surface does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[repr(u8)]
pub enum Zone {
    /// The surfaces are apart.
    #[default]
    Open = 0,
    /// In contact without slip in this increment.
    Stick = 1,
    /// In contact and slipping in this increment.
    Slip = 2,
}

impl Number for Zone {
    fn bytes(zones: &[Self]) -> Cow<'_, [u8]> {
        Cow::Owned(zones.iter().map(|&zone| zone as u8).collect())
    }

    fn numbers(bytes: &[u8]) -> Option<Vec<Self>> {
        let zones = [Self::Open, Self::Stick, Self::Slip];
        bytes.iter().map(|&byte| zones.get(usize::from(byte)).copied()).collect()
    }
}

/// Tractions, displacements and rigid motions at the end of an increment. Fields have shape `(nx, ny)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactState {
    /// Contact pressure [pressure], compression positive.
    #[serde(with = "stored")]
    pub pressure: Array2<f64>,
    /// Shear traction on the lower body along x and y [pressure].
    #[serde(with = "stored")]
    pub shear: [Array2<f64>; 2],
    /// Slip accumulated along its path: sum of the increments of the upper point relative to the lower, x and y [length].
    #[serde(with = "stored")]
    pub slip: [Array2<f64>; 2],
    /// What each cell did in the last increment.
    #[serde(with = "stored")]
    pub zone: Array2<Zone>,
    /// Depth worn off both bodies together [length], of bodies that move against each other off the lower one; `None` where nothing wears.
    #[serde(with = "stored")]
    pub worn_depth: Option<Array2<f64>>,
    /// Depth worn off the upper body [length] in its own frame, which lay over the grid without a shift; `None` where it does not move against
    /// the lower one, or nothing wears.
    #[serde(with = "stored")]
    pub upper_worn_depth: Option<Array2<f64>>,
    /// Thickness of the debris between the surfaces [length], in the frame of the lower body; `None` where none stays.
    #[serde(with = "stored")]
    pub debris: Option<Array2<f64>>,
    /// Depth by which both surfaces together have yielded [length]; `None` where none has.
    #[serde(with = "stored")]
    pub plastic_depth: Option<Array2<f64>>,
    /// What slip has done to each cell since the start; `None` where nothing follows it.
    pub accumulated: Option<AccumulatedSlip>,
    /// Rigid normal approach [length].
    pub approach: f64,
    /// Rigid tangential displacement of the upper body relative to the lower [length].
    pub shift: [f64; 2],
    /// Rotation of the upper body about z [rad].
    pub twist: f64,
    /// Slope of the upper body along x and y [-]: deeper towards positive x and y.
    pub tilt: [f64; 2],
    /// Bulk stress of the lower and of the upper substrate along x and y [pressure].
    pub bulk_stress: [[f64; 2]; 2],
    /// Distance that the contact has rolled along x and y [length].
    #[serde(default)]
    pub roll: [f64; 2],
    /// Energy dissipated by friction since the start [force x length]; with wear that of all cycles that computed ones stand for.
    pub dissipated_energy: f64,
    /// Elastic energy that the tractions of the contact store in both bodies and the interface [force x length]: half the sum of tractions
    /// times relative displacements, in a line contact relative to the datum.
    pub elastic_energy: f64,
    /// Work of the forces, the moments and the bulk stresses on the contact since the start [force x length]: means of both ends of an
    /// increment times the change of the motions; of surfaces that move also the work of their slopes under the pressure and of the
    /// displacements that they carry along under the shear; with wear that of all cycles that computed ones stand for, which store nothing.
    pub external_work: f64,
    /// Energy that has gone with what wore off since the start [force x length]: work of the pressure over the depth worn under it, and
    /// what thinner bodies store less.
    pub wear_work: f64,
    /// Work that yielding has taken since the start [force x length]: the hardness times the plastic volume.
    #[serde(default)]
    pub plastic_work: f64,
    /// External work less what is stored, dissipated, yielded and gone with wear since the start [force x length]: what increments of finite length
    /// leave unresolved; with wear that of all cycles that computed ones stand for.
    pub unresolved_energy: f64,
    /// Work that the bulk stresses have done on the contact since the start [force x length]: minus the mean shear times the change of
    /// the relative displacement by the strains; with wear that of all cycles that computed ones stand for.
    pub bulk_work: f64,
    /// Debris that has flowed out over the rim of the contact since the start [length^3], by all cycles that computed ones stand for.
    #[serde(default)]
    pub debris_outflow: f64,
}

impl ContactState {
    /// Bodies that have not touched yet.
    pub fn untouched(cells: [usize; 2]) -> Self {
        // Each made anew, not copied: zeros that nobody wrote to take no memory.
        let zero = || Array2::zeros(cells);
        Self {
            pressure: zero(),
            shear: [zero(), zero()],
            slip: [zero(), zero()],
            zone: Array2::from_elem(cells, Zone::Open),
            worn_depth: None,
            upper_worn_depth: None,
            debris: None,
            plastic_depth: None,
            accumulated: None,
            approach: 0.0,
            shift: [0.0; 2],
            twist: 0.0,
            tilt: [0.0; 2],
            bulk_stress: [[0.0; 2]; 2],
            roll: [0.0; 2],
            dissipated_energy: 0.0,
            elastic_energy: 0.0,
            external_work: 0.0,
            wear_work: 0.0,
            plastic_work: 0.0,
            unresolved_energy: 0.0,
            bulk_work: 0.0,
            debris_outflow: 0.0,
        }
    }

    /// The state of bodies that have been carried over the grid by whole cells along each axis: what leaves the grid is gone.
    #[must_use]
    pub fn carried(&self, cells: [f64; 2]) -> Self {
        let moved = |field: &Array2<f64>| carried(field, cells, Outside::Zero);
        let whole = cells.map(|cells| cells as isize);
        let zone = carried_by_whole_cells(&self.zone, whole, (Outside::Zero, Zone::Open));
        Self {
            pressure: moved(&self.pressure),
            shear: self.shear.each_ref().map(moved),
            slip: self.slip.each_ref().map(moved),
            zone,
            worn_depth: self.worn_depth.clone(),
            upper_worn_depth: self.upper_worn_depth.clone(),
            debris: self.debris.clone(),
            plastic_depth: self.plastic_depth.as_ref().map(moved),
            accumulated: self.accumulated.clone(),
            ..*self
        }
    }

    /// Opens a gap by what is worn in the frame of the lower body, and fills it with the debris there.
    pub fn open(&self, gap: &mut Array2<f64>) {
        if let Some(worn) = &self.worn_depth {
            *gap += worn;
        }
        if let Some(debris) = &self.debris {
            *gap -= debris;
        }
    }

    /// A copy without the tractions and the slip that are kept as fields, by the names they have there.
    #[must_use]
    pub fn beside(&self, is_kept: impl Fn(&str) -> bool) -> Self {
        let copy = |name: &str, field: &Array2<f64>| {
            if is_kept(name) { Array2::zeros((0, 0)) } else { copied(field) }
        };
        let Self { pressure, shear: [shear_x, shear_y], slip: [slip_x, slip_y], .. } = self;
        Self {
            pressure: copy("pressure", pressure),
            shear: [copy("shear_x", shear_x), copy("shear_y", shear_y)],
            slip: [copy("slip_x", slip_x), copy("slip_y", slip_y)],
            zone: self.zone.clone(),
            worn_depth: self.worn_depth.clone(),
            upper_worn_depth: self.upper_worn_depth.clone(),
            debris: self.debris.clone(),
            plastic_depth: self.plastic_depth.clone(),
            accumulated: self.accumulated.clone(),
            ..*self
        }
    }

    /// Whether the tractions and the slip that are not kept as fields are zero everywhere.
    pub fn is_zero_beside(&self, is_kept: impl Fn(&str) -> bool) -> bool {
        let names = ["pressure", "shear_x", "shear_y", "slip_x", "slip_y"];
        names.into_iter().filter(|name| !is_kept(name)).filter_map(|name| self.field(name)).all(is_zero)
    }

    /// A field of a solved increment by the name it has as a kept one: pressure, shear and slip.
    pub fn field(&self, name: &str) -> Option<&Array2<f64>> {
        match name {
            "pressure" => Some(&self.pressure),
            "shear_x" => Some(&self.shear[0]),
            "shear_y" => Some(&self.shear[1]),
            "slip_x" => Some(&self.slip[0]),
            "slip_y" => Some(&self.slip[1]),
            _ => None,
        }
    }

    /// Whether this can be a state on a grid of `cells`: every field of its shape, every number finite.
    pub fn is_sound(&self, cells: [usize; 2]) -> bool {
        let [qx, qy] = &self.shear;
        let [sx, sy] = &self.slip;
        let [tilt_x, tilt_y] = self.tilt;
        let motions = [self.approach, self.shift[0], self.shift[1], self.twist, tilt_x, tilt_y];
        let numbers = motions.into_iter().chain(self.bulk_stress.into_iter().flatten()).chain(self.roll);
        let energies = [self.dissipated_energy, self.elastic_energy, self.external_work, self.wear_work];
        let mut numbers = numbers.chain(energies).chain([
            self.unresolved_energy,
            self.bulk_work,
            self.debris_outflow,
            self.plastic_work,
        ]);
        let field = |field: &Array2<f64>| field.dim() == cells.into() && field.iter().all(|v| v.is_finite());
        let accumulated = self.accumulated.iter().flat_map(AccumulatedSlip::fields);
        let worn = self.worn_depth.iter().chain(&self.upper_worn_depth).chain(&self.debris);
        let worn = worn.chain(&self.plastic_depth);
        [&self.pressure, qx, qy, sx, sy].into_iter().chain(worn).chain(accumulated).all(field)
            && self.zone.dim() == cells.into()
            && numbers.all(f64::is_finite)
    }
}

/// A state with what was prescribed and reached there: what another history starts from. A field that is kept elsewhere is empty.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SolvedState {
    /// What was prescribed.
    pub loads: LoadStep,
    /// Normal force [force], compression positive.
    pub normal_force: f64,
    /// Tangential force on the lower body along x and y [force].
    pub tangential_force: [f64; 2],
    /// Moment about z on the lower body [force x length].
    pub twist_moment: f64,
    /// First moment of the pressure along x and y [force x length].
    pub tilt_moment: [f64; 2],
    /// Tractions, motions, slip and wear. What an unfinished cycle has worn so far is taken off once.
    pub state: ContactState,
}

impl SolvedState {
    /// The same with the fields that are empty put back by `field`, which hands them over by name.
    ///
    /// # Errors
    /// Those of `field`.
    pub fn completed<E>(mut self, mut field: impl FnMut(&str) -> Result<Array2<f64>, E>) -> Result<Self, E> {
        for (name, empty) in self.tractions_and_slip() {
            if empty.is_empty() {
                *empty = field(name)?;
            }
        }
        Ok(self)
    }

    fn tractions_and_slip(&mut self) -> [(&'static str, &mut Array2<f64>); 5] {
        let ContactState { pressure, shear: [shear_x, shear_y], slip: [slip_x, slip_y], .. } =
            &mut self.state;
        [
            ("pressure", pressure),
            ("shear_x", shear_x),
            ("shear_y", shear_y),
            ("slip_x", slip_x),
            ("slip_y", slip_y),
        ]
    }
}

//! The elastic response of the bodies of a history: on all cells of its region, and around the contact of an increment, where linear problems are
//! solved: a small contact in a large region takes little.

use std::sync::Arc;

use super::error::SensitivityError;
use super::fields::{Fields, zeros};
use super::krylov::Searches;
use crate::compliance::{OperatorSet, SelfInfluence, SpectralCompliance, SurfaceCompliance};
use crate::fields::norm;
use crate::run::PairCompliance;
use crate::solver::{CellWaves, ContactSet, Preconditioner, Region, SlipWeights};
use fret_fft::{ConvolutionError, good_length};

/// Operators serve a contact that would do with so many times fewer cells.
const ROOM: f64 = 1.3;

/// What the operators of a history are made from.
#[derive(Clone)]
pub(super) struct Made {
    pub pair: Arc<PairCompliance>,
    pub set: OperatorSet,
    /// Sides of a cell [length].
    pub spacing: [f64; 2],
    /// Cells of the region of the history, and of the grid in front of the mirrors.
    pub region: [usize; 2],
    pub grid: usize,
    pub periodic: bool,
    pub frictional: bool,
}

/// Operators on the cells of the region of a history, and around a contact.
pub(super) struct Operators {
    made: Made,
    compliance: SpectralCompliance,
    around: Around,
    /// Whether displacements around the contact are found in single precision, where they can be.
    hurries: bool,
    /// What searches leave for those after them.
    pub searches: Searches,
    work: Counted,
}

/// Operators around a contact.
struct Around {
    /// Where they are in the region of the history.
    region: Region,
    /// The contact, in that.
    contact: ContactSet,
    compliance: SpectralCompliance,
    preconditioner: Preconditioner,
}

/// Work so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Counted {
    /// Applications in linear problems, and all others.
    pub of_linear_problems: usize,
    pub others: usize,
    /// Cells of all of them.
    cells: usize,
    /// Passes of preconditioners that are no more.
    passes: usize,
}

fn failed(error: ConvolutionError) -> SensitivityError {
    SensitivityError::Operators(error.to_string())
}

impl Made {
    fn compliance(&self, shape: [usize; 2]) -> Result<SpectralCompliance, SensitivityError> {
        SpectralCompliance::new(&self.pair.response, shape, self.set).map_err(failed)
    }

    fn around(&self, region: Region) -> Result<Around, SensitivityError> {
        let Self { pair, set, spacing, .. } = self;
        let waves = pair.table.as_ref().map(|table| CellWaves { table, spacing: *spacing });
        let preconditioner =
            Preconditioner::new(&pair.response, waves, region.shape, *set).map_err(failed)?;
        let compliance = self.compliance(region.shape)?;
        Ok(Around { region, contact: ContactSet::default(), compliance, preconditioner })
    }
}

impl Operators {
    /// Those of a history.
    pub fn new(made: Made) -> Result<Self, SensitivityError> {
        let compliance = made.compliance(made.region)?;
        let around = made.around(Region::whole(made.region))?;
        Ok(Self {
            made,
            compliance,
            around,
            hurries: false,
            searches: Searches::default(),
            work: Counted::default(),
        })
    }

    /// Influence of a cell on itself.
    pub fn self_influence(&self) -> SelfInfluence {
        self.compliance.self_influence()
    }

    /// Comes to a contact of the region.
    pub fn come_to(&mut self, contact: &ContactSet) -> Result<(), SensitivityError> {
        let Self { made, around, work, .. } = self;
        let [rows, columns] = made.region;
        let mut touched = vec![false; rows * columns];
        contact.cells().for_each(|cell| touched[cell] = true);
        let whole = Region::whole(made.region);
        let near = |good: fn(usize) -> usize| {
            let mirrored = made.set.symmetry.axes();
            Region::around(made.region, mirrored, 0, good, |i, j| touched[i * columns + j])
        };
        let wanted = if made.periodic || contact.len() == 0 { whole } else { near(good_length) };
        let serves = around.region.contains_all(&near(|n| n))
            && around.region.len() as f64 <= ROOM * wanted.len() as f64;
        if !serves {
            work.passes += around.preconditioner.passes;
            *around = made.around(wanted)?;
        }
        let region = around.region;
        let is_in = |cell: usize| {
            let [i, j] = region.at(cell);
            touched[i * columns + j]
        };
        around.contact = ContactSet::of(region.len(), is_in);
        Ok(())
    }

    /// Displacements of tractions on all cells of the region [length].
    pub fn displacements(&mut self, tractions: &Fields) -> Fields {
        self.work.others += 1;
        self.work.cells += tractions[0].len();
        displacements(&mut self.compliance, self.made.frictional, tractions)
    }

    /// Displacements, in the cells of the `contact` come to last, packed over it, of tractions on all cells of the region [length].
    pub fn in_contact(&mut self, contact: &ContactSet, tractions: &Fields) -> Fields {
        let (region, columns) = (self.around.region, self.made.region[1]);
        let mut parts = zeros(region.len());
        let mut outside = false;
        for (field, part) in tractions.iter().zip(&mut parts) {
            for (cell, value) in field.iter().enumerate().filter(|(_, value)| **value != 0.0) {
                let [i, j] = [cell / columns, cell % columns];
                if region.contains(i, j) {
                    part[(i - region.origin[0]) * region.shape[1] + j - region.origin[1]] = *value;
                } else {
                    outside = true;
                }
            }
        }
        if outside {
            return self.displacements(tractions).each_ref().map(|field| contact.packed(field));
        }
        self.work.others += 1;
        self.work.cells += region.len();
        let around = &mut self.around;
        let moved = displacements(&mut around.compliance, self.made.frictional, &parts);
        moved.each_ref().map(|field| around.contact.packed(field))
    }

    /// Displacements of tractions in the cells of the contact come to last, both packed over it; in single precision where that is wanted [length].
    pub fn moved(&mut self, tractions: &Fields, moved: &mut Fields) {
        let Self { made, around, hurries, work, .. } = self;
        let Around { region, compliance, preconditioner, .. } = around;
        work.of_linear_problems += 1;
        work.cells += region.len();
        let from = tractions.each_ref().map(Vec::as_slice);
        let mut to = moved.each_mut().map(Vec::as_mut_slice);
        if !made.frictional {
            preconditioner.fields::<f64>().carry(&from[..1], &mut to[..1], [1.0; 2], |from, to| {
                compliance.normal(from[0], to[0]);
            });
            return;
        }
        if let Some(mut single) = hurries.then(|| compliance.full_single()).flatten() {
            let size = from.iter().map(|part| norm(part)).fold(0.0, f64::max);
            let unit = if size > 0.0 { size } else { 1.0 };
            let factors = [unit, unit * single.unit()];
            preconditioner.fields::<f32>().carry(&from, &mut to, factors, |from, to| single.apply(from, to));
            return;
        }
        preconditioner.fields::<f64>().carry(&from, &mut to, [1.0; 2], |from, to| {
            let [normal, x, y] = to else { return };
            compliance.full([from[0], from[1], from[2]], [normal, x, y]);
        });
    }

    /// Finds displacements around the contact in single precision from now on, where that may be and can; says whether it does.
    pub fn hurry(&mut self, may: bool) -> bool {
        self.hurries = may && self.around.compliance.full_single().is_some();
        self.hurries
    }

    /// Makes ready to remove displacements in the contact come to last, whose cells have such slip compliances.
    pub fn prepare(&mut self, slip_compliance: &[f64], weights: &mut SlipWeights<f64>) {
        let Around { contact, preconditioner, .. } = &mut self.around;
        preconditioner.prepare(contact, slip_compliance, 1.0, weights);
    }

    /// Tractions that nearly remove displacements, both packed over that contact.
    pub fn removed(
        &mut self,
        [normal, x, y]: &Fields,
        [pressure, along_x, along_y]: &mut Fields,
        weights: &mut SlipWeights<f64>,
    ) {
        let preconditioner = &mut self.around.preconditioner;
        preconditioner.pressure(normal, pressure, weights);
        if self.made.frictional {
            preconditioner.shear(([x, y], None), [along_x, along_y], weights);
        }
    }

    /// Applications in linear problems, all others, all of them in applications on the grid of the history, and passes of the preconditioner.
    pub fn work(&self) -> (usize, usize, f64, usize) {
        let Counted { of_linear_problems, others, cells, passes } = self.work;
        let in_full = cells as f64 / self.made.grid as f64;
        (of_linear_problems, others, in_full, passes + self.around.preconditioner.passes)
    }
}

/// Displacements of tractions on all cells of a region [length].
pub(super) fn displacements(
    compliance: &mut SpectralCompliance,
    frictional: bool,
    tractions: &Fields,
) -> Fields {
    let [pressure, x, y] = tractions;
    let mut moved = zeros(pressure.len());
    let [normal, along_x, along_y] = &mut moved;
    if frictional {
        compliance.full([pressure, x, y], [normal, along_x, along_y]);
    } else {
        compliance.normal(pressure, normal);
    }
    moved
}

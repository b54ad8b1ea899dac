//! The change, by one number, of all that an increment leaves behind for those after it; or, backwards, how an objective changes with each of
//! these.

use crate::model::controls::FREEDOMS;

use super::cell::MOTIONS;

/// Where the degrees of freedom are, in the order of their controls (normal, along x and y, about z, tilts): force of the whole contact, motion,
/// motion of the far end of the spring.
pub(super) type Reached = [[f64; 3]; 6];

/// A tangential field.
pub(super) type Tangential = [Vec<f64>; 2];

/// Energies of the whole contact, by their places: those of the record, and what has been dissipated, left unresolved and done by the bulk
/// stresses since the cycle began.
pub(super) const DISSIPATED: usize = 0;
pub(super) const STORED: usize = 1;
pub(super) const EXTERNAL: usize = 2;
pub(super) const UNRESOLVED: usize = 3;
pub(super) const OF_WEAR: usize = 4;
pub(super) const OF_BULK: usize = 5;
pub(super) const OF_CYCLE: [usize; 3] = [6, 7, 8];
pub(super) const ENERGIES: usize = 9;

/// One number for each of the quantities that go from increment to increment, in the region.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Change {
    pub pressure: Vec<f64>,
    pub shear: Tangential,
    /// Gap at the end of the increment, after what wears off then.
    pub gap: Vec<f64>,
    /// Tangential displacement of the upper surface over the lower, motions and bulk strains included.
    pub slid: Tangential,
    /// What the rule of slip takes for the drift of the increment.
    pub drift: Tangential,
    /// Depth worn off, and what has been collected to be worn off; nothing where nothing wears.
    pub worn: Vec<f64>,
    pub collected: Vec<f64>,
    /// Thickness of the debris, and what has been slipped since the cycle began; nothing where no debris stays.
    pub debris: Vec<f64>,
    pub path: Vec<f64>,
    /// What friction follows in each cell, and what has been collected of it since the cycle began; nothing where friction does not evolve.
    pub slipped: Vec<f64>,
    pub slipping: Vec<f64>,
    /// Slip of the increment; nothing where nobody asks for it.
    pub slip: Tangential,
    /// Rotations times the length.
    pub motions: [f64; MOTIONS],
    /// Strain of the lower surface less that of the upper one by bulk stresses, times the length.
    pub strain: [f64; 2],
    pub energies: [f64; ENERGIES],
    pub reached: Reached,
    /// Load at the start of the stage and at the end of the increment, of the whole contact.
    pub start: [f64; FREEDOMS],
    pub held: [f64; FREEDOMS],
    /// Load at the start and at the end of the increment, of the part in front of the mirrors.
    pub from: [f64; FREEDOMS],
    pub load: [f64; FREEDOMS],
    /// Length of the increment over that of the one before.
    pub ratio: f64,
}

impl Change {
    /// None, in a region of so many cells.
    pub fn none(cells: usize) -> Self {
        let tangential = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            pressure: vec![0.0; cells],
            shear: tangential(),
            gap: vec![0.0; cells],
            slid: tangential(),
            drift: tangential(),
            worn: Vec::new(),
            collected: Vec::new(),
            debris: Vec::new(),
            path: Vec::new(),
            slipped: Vec::new(),
            slipping: Vec::new(),
            slip: [Vec::new(), Vec::new()],
            motions: [0.0; MOTIONS],
            strain: [0.0; 2],
            energies: [0.0; ENERGIES],
            reached: Reached::default(),
            start: [0.0; FREEDOMS],
            held: [0.0; FREEDOMS],
            from: [0.0; FREEDOMS],
            load: [0.0; FREEDOMS],
            ratio: 0.0,
        }
    }

    /// All its numbers, part by part.
    pub fn parts(&self) -> impl Iterator<Item = &[f64]> {
        let Self { shear, slid, drift, slip, reached, .. } = self;
        let worn = [&self.worn, &self.collected, &self.debris, &self.path, &self.slipped, &self.slipping];
        let fields = [&self.pressure, &self.gap]
            .into_iter()
            .chain(shear)
            .chain(slid)
            .chain(drift)
            .chain(worn)
            .chain(slip);
        let loads = [&self.start, &self.held, &self.from, &self.load].into_iter().map(|load| &load[..]);
        let (motions, ratio) = ([&self.motions[..], &self.strain], std::slice::from_ref(&self.ratio));
        let small = motions.into_iter().chain([&self.energies[..], reached.as_flattened(), ratio]);
        fields.map(Vec::as_slice).chain(loads).chain(small)
    }

    /// The same of surfaces that wear.
    #[must_use]
    pub fn of_wear(self, wears: bool) -> Self {
        let cells = if wears { self.gap.len() } else { 0 };
        Self { worn: vec![0.0; cells], collected: vec![0.0; cells], ..self }
    }

    /// The same of surfaces between which debris stays.
    #[must_use]
    pub fn of_debris(self, stays: bool) -> Self {
        let cells = if stays { self.gap.len() } else { 0 };
        Self { debris: vec![0.0; cells], path: vec![0.0; cells], ..self }
    }

    /// By how much the gap has opened in a cell: by what has worn off less the debris that lies there.
    pub fn opened(&self, cell: usize) -> f64 {
        let of = |field: &[f64]| field.get(cell).copied().unwrap_or(0.0);
        of(&self.worn) - of(&self.debris)
    }

    /// Backwards: adds what the gap of a cell counts.
    pub fn add_opened(&mut self, cell: usize, of: f64) {
        self.worn.get_mut(cell).into_iter().for_each(|worn| *worn += of);
        self.debris.get_mut(cell).into_iter().for_each(|debris| *debris -= of);
    }

    /// The same of surfaces whose friction evolves.
    #[must_use]
    pub fn of_evolution(self, evolves: bool) -> Self {
        let cells = if evolves { self.gap.len() } else { 0 };
        Self { slipped: vec![0.0; cells], slipping: vec![0.0; cells], ..self }
    }

    /// The same of which slip is asked for.
    #[must_use]
    pub fn of_slip(self, asked: bool) -> Self {
        let cells = if asked { self.gap.len() } else { 0 };
        Self { slip: [vec![0.0; cells], vec![0.0; cells]], ..self }
    }

    /// Whether all are zero.
    pub fn is_none(&self) -> bool {
        self.parts().flatten().all(|value| *value == 0.0)
    }
}

/// Change of the solution of an increment: tractions and displacements on all cells of the region, and motions; or how an objective changes with
/// them.
#[derive(Debug, Clone)]
pub(super) struct Solution {
    pub tractions: super::fields::Fields,
    pub displacements: super::fields::Fields,
    pub motions: [f64; MOTIONS],
}

/// Adds to a cell of a tangential field.
pub(super) fn add(field: &mut Tangential, cell: usize, [x, y]: [f64; 2]) {
    field[0][cell] += x;
    field[1][cell] += y;
}

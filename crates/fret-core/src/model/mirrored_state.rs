//! States in front of mirrors: how a run holds them, and how they are made whole. Fields are those of the part in front of the
//! mirrors, numbers those of the whole contact.

use std::borrow::Cow;

use ndarray::Array2;

use super::state::{ContactState, SolvedState};
use super::symmetry::Symmetry;

/// A state as a run holds it, for those who look at it.
#[derive(Debug, Clone, Copy)]
pub struct MirroredState<'a> {
    /// The state in front of the mirrors; where there is none the state itself.
    pub part: &'a ContactState,
    /// The mirrors.
    pub symmetry: Symmetry,
}

impl<'a> MirroredState<'a> {
    /// The state of the whole contact, made when it is asked for.
    pub fn whole(&self) -> Cow<'a, ContactState> {
        if self.symmetry.any() {
            Cow::Owned(made_whole(self.part, self.symmetry))
        } else {
            Cow::Borrowed(self.part)
        }
    }
}

impl Symmetry {
    /// The part of a state in front of the mirrors.
    pub fn part_of_state(&self, whole: &ContactState) -> ContactState {
        ContactState {
            pressure: self.part(&whole.pressure),
            shear: [0, 1].map(|axis| self.part(&whole.shear[axis])),
            slip: [0, 1].map(|axis| self.part(&whole.slip[axis])),
            zone: self.part(&whole.zone),
            worn_depth: whole.worn_depth.as_ref().map(|depth| self.part(depth)),
            upper_worn_depth: whole.upper_worn_depth.as_ref().map(|depth| self.part(depth)),
            debris: whole.debris.as_ref().map(|thickness| self.part(thickness)),
            plastic_depth: whole.plastic_depth.as_ref().map(|depth| self.part(depth)),
            accumulated: whole.accumulated.as_ref().map(|slip| slip.with_fields(|field| self.part(field))),
            ..*whole
        }
    }

    /// The state of the whole contact from that in front of the mirrors.
    pub fn whole_state(&self, part: ContactState) -> ContactState {
        if self.any() { made_whole(&part, *self) } else { part }
    }

    /// The same of a state that another history starts from.
    pub fn whole_solved(&self, part: SolvedState) -> SolvedState {
        SolvedState { state: self.whole_state(part.state), ..part }
    }

    /// Whether a state of the whole contact is its own mirror image, to the bit.
    pub fn keeps_state(&self, whole: &ContactState) -> bool {
        let (nx, ny) = whole.pressure.dim();
        let even = [nx, ny].iter().zip(self.axes()).all(|(cells, mirrored)| !mirrored || cells % 2 == 0);
        even && self.whole_state(self.part_of_state(whole)) == *whole
    }
}

fn made_whole(part: &ContactState, symmetry: Symmetry) -> ContactState {
    let even = |field: &Array2<f64>| symmetry.whole(field, [false; 2]);
    let tangential = |field: &[Array2<f64>; 2]| {
        [0, 1].map(|axis| symmetry.whole(&field[axis], symmetry.shear_is_odd(axis)))
    };
    ContactState {
        pressure: even(&part.pressure),
        shear: tangential(&part.shear),
        slip: tangential(&part.slip),
        zone: symmetry.whole_zones(&part.zone),
        worn_depth: part.worn_depth.as_ref().map(even),
        upper_worn_depth: part.upper_worn_depth.as_ref().map(even),
        debris: part.debris.as_ref().map(even),
        plastic_depth: part.plastic_depth.as_ref().map(even),
        accumulated: part.accumulated.as_ref().map(|slip| slip.with_fields(even)),
        ..*part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{AccumulatedSlip, Zone};

    /// A state on 4 x 6 cells whose fields all differ, and its own image in the mirrors.
    #[test]
    fn a_part_made_whole_is_the_state_it_was_taken_from() {
        for symmetry in [
            Symmetry::NONE,
            Symmetry { odd_shear: [None, Some(1)] },
            Symmetry { odd_shear: [Some(1), None] },
            Symmetry { odd_shear: [Some(0), Some(1)] },
        ] {
            let cells = symmetry.part_of([4, 6]);
            let field = |first: f64| Array2::from_shape_fn(cells, |(i, j)| first + (10 * i + j) as f64);
            let part = ContactState {
                pressure: field(100.0),
                shear: [field(200.0), field(300.0)],
                slip: [field(400.0), field(500.0)],
                zone: Array2::from_shape_fn(cells, |(i, j)| if i < j { Zone::Slip } else { Zone::Stick }),
                worn_depth: Some(field(600.0)),
                upper_worn_depth: Some(field(650.0)),
                debris: Some(field(670.0)),
                plastic_depth: Some(field(690.0)),
                accumulated: Some(AccumulatedSlip { distance: field(700.0), ..AccumulatedSlip::none(cells) }),
                dissipated_energy: 8.0,
                bulk_work: -3.0,
                ..ContactState::untouched(cells)
            };
            let whole = symmetry.whole_state(part.clone());
            assert_eq!(whole, *MirroredState { part: &part, symmetry }.whole());
            assert!(whole.is_sound([4, 6]) && symmetry.keeps_state(&whole));
            assert_eq!([whole.dissipated_energy, whole.bulk_work], [8.0, -3.0]);
            assert_eq!(symmetry.part_of_state(&whole), part);
            let mut other = whole;
            other.shear[1][[0, 0]] += 1.0;
            assert_eq!(symmetry.keeps_state(&other), !symmetry.any());
        }
    }
}

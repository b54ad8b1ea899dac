//! Mirror symmetry of a scene: the part of the grid in front of its mirrors stands for the whole.

use std::borrow::Cow;

use ndarray::{Array2, ArrayView1, ArrayView2, Axis, Zip, s};
use serde::{Deserialize, Serialize};

use super::friction::CoulombFriction;
use super::load::{Control, LoadStep};
use super::state::{ContactState, Zone};

/// Planes through the middle of the grid at which scene and load are their own mirror image.
///
/// Behind a plane gap and pressure go on as they are; of the shear one component goes on as it is, the other with the other sign.
/// The part in front of the mirrors are the cells of the second half along each mirrored axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Symmetry {
    /// For a mirror along x and y the component of shear that changes its sign behind it (0: x, 1: y); `None` without.
    pub odd_shear: [Option<usize>; 2],
}

impl Symmetry {
    /// No mirror.
    pub const NONE: Self = Self { odd_shear: [None, None] };

    /// Whether there is any mirror.
    pub fn any(&self) -> bool {
        *self != Self::NONE
    }

    /// Whether there is a mirror along `[x, y]`.
    pub fn axes(&self) -> [bool; 2] {
        self.odd_shear.map(|odd| odd.is_some())
    }

    /// How many cells of the whole grid each cell of the part stands for.
    pub fn copies(&self) -> usize {
        self.axes().into_iter().filter(|mirrored| *mirrored).fold(1, |copies, _| 2 * copies)
    }

    /// Whether a component of shear (0: x, 1: y) changes its sign behind the mirror along each axis.
    pub fn shear_is_odd(&self, component: usize) -> [bool; 2] {
        self.odd_shear.map(|odd| odd == Some(component))
    }

    /// Whether a rigid motion along an axis, and the force that goes with it, are none.
    fn forbids(&self, component: usize) -> bool {
        self.shear_is_odd(component) != [false, false]
    }

    /// Cells of the part of a grid of `cells`, which must be even along a mirrored axis.
    pub fn part_of(&self, cells: [usize; 2]) -> [usize; 2] {
        let axes = self.axes();
        [0, 1].map(|axis| if axes[axis] { cells[axis] / 2 } else { cells[axis] })
    }

    /// Cells of the grid of which a part has `cells`.
    pub fn whole_of(&self, cells: [usize; 2]) -> [usize; 2] {
        let axes = self.axes();
        [0, 1].map(|axis| if axes[axis] { 2 * cells[axis] } else { cells[axis] })
    }

    /// Whether a field of the whole grid is its own mirror image, to the bit.
    pub fn is_kept_by(&self, field: &ArrayView2<'_, f64>) -> bool {
        let axes = self.axes();
        let (nx, ny) = field.dim();
        let even = [nx, ny].iter().zip(axes).all(|(cells, mirrored)| !mirrored || cells % 2 == 0);
        let kept_along_x = || (0..nx / 2).all(|i| field.row(i) == field.row(nx - 1 - i));
        let kept_along_y = || {
            let is_kept =
                |row: ArrayView1<'_, f64>| row.iter().zip(row.iter().rev()).take(ny / 2).all(|(a, b)| a == b);
            field.rows().into_iter().all(is_kept)
        };
        even && (!axes[0] || kept_along_x()) && (!axes[1] || kept_along_y())
    }

    /// The part of a field in front of the mirrors.
    pub fn part<T: Clone>(&self, field: &Array2<T>) -> Array2<T> {
        let (nx, ny) = field.dim();
        let [mx, my] = self.part_of([nx, ny]);
        let (_, rows) = field.view().split_at(Axis(0), nx - mx);
        let (_, part) = rows.split_at(Axis(1), ny - my);
        part.as_standard_layout().into_owned()
    }

    /// The whole of a field that goes on behind the mirrors, with the other sign along axes where it is odd.
    pub fn whole(&self, part: &Array2<f64>, odd: [bool; 2]) -> Array2<f64> {
        // Zeros that nobody wrote to take no memory.
        let zeros = Array2::zeros(self.whole_of(part.dim().into()));
        made_whole(part, zeros, |value, behind| {
            let turns = (behind[0] && odd[0]) != (behind[1] && odd[1]);
            if turns && value != 0.0 { -value } else { value }
        })
    }

    /// Zones of the whole grid.
    pub fn whole_zones(&self, part: &Array2<Zone>) -> Array2<Zone> {
        let open = Array2::from_elem(self.whole_of(part.dim().into()), Zone::Open);
        made_whole(part, open, |zone, _| zone)
    }

    /// The cells of a field behind all mirrors, which are those of the whole with the lowest indices, for a field without a sign.
    pub fn behind<'a, T>(&self, part: &'a Array2<T>) -> ArrayView2<'a, T> {
        let mut image = part.view();
        for axis in (0..2).filter(|axis| self.axes()[*axis]) {
            image.invert_axis(Axis(axis));
        }
        image
    }

    /// The cell of the whole grid that is the image behind all mirrors of a cell of the part, which has so many.
    pub fn image_behind(&self, cell: [usize; 2], cells_of_part: [usize; 2]) -> [usize; 2] {
        let axes = self.axes();
        [0, 1].map(|axis| if axes[axis] { cells_of_part[axis] - 1 - cell[axis] } else { cell[axis] })
    }

    /// The part of a friction law; the law itself where its part is no other.
    pub fn part_of_friction<'a>(&self, friction: &'a CoulombFriction) -> Cow<'a, CoulombFriction> {
        if self.any() && friction.is_map() {
            Cow::Owned(friction.with_maps(|map| self.part(map)))
        } else {
            Cow::Borrowed(friction)
        }
    }

    /// The share of a load that the part carries; along an axis that the symmetry forbids nothing moves from `state`.
    pub fn part_of_load(&self, load: &LoadStep, state: &ContactState) -> LoadStep {
        let share = 1.0 / self.copies() as f64;
        let part = |control: Control| match control {
            Control::Force(force) => Control::Force(force * share),
            Control::Motion(_) | Control::FarEnd(_) => control,
        };
        LoadStep {
            normal: part(load.normal),
            tangential: [0, 1].map(|axis| {
                if self.forbids(axis) {
                    Control::Motion(state.shift[axis])
                } else {
                    part(load.tangential[axis])
                }
            }),
            twist: Control::Motion(state.twist),
            tilt: [0, 1].map(|axis| {
                if self.axes()[axis] { Control::Motion(state.tilt[axis]) } else { part(load.tilt[axis]) }
            }),
            bulk_stress: load.bulk_stress,
            roll: load.roll,
        }
    }

    /// Sums of a tangential force over the whole grid from those over the part.
    pub fn whole_force(&self, part: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| if self.forbids(axis) { 0.0 } else { part[axis] * self.copies() as f64 })
    }
}

/// Fills `whole`, which holds the default everywhere, from the part in front of its mirrors; `seen` tells what a value looks like
/// behind a mirror along each axis.
fn made_whole<T: Copy + PartialEq + Default>(
    part: &Array2<T>,
    mut whole: Array2<T>,
    seen: impl Fn(T, [bool; 2]) -> T,
) -> Array2<T> {
    let (mx, my) = part.dim();
    let (nx, ny) = whole.dim();
    for (i, row) in part.rows().into_iter().enumerate() {
        if row.iter().all(|value| *value == T::default()) {
            continue;
        }
        let rows = [Some((nx - mx + i, false)), (nx > mx).then(|| (mx - 1 - i, true))];
        for (to, behind_x) in rows.into_iter().flatten() {
            let (mut behind, before) = whole.row_mut(to).split_at(Axis(0), ny - my);
            Zip::from(before).and(row).for_each(|to, value| *to = seen(*value, [behind_x, false]));
            if ny > my {
                let mirrored = behind.slice_mut(s![..;-1]);
                Zip::from(mirrored).and(row).for_each(|to, value| *to = seen(*value, [behind_x, true]));
            }
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use ndarray::array;

    use super::*;

    const QUARTER: Symmetry = Symmetry { odd_shear: [Some(0), Some(1)] };
    const HALF: Symmetry = Symmetry { odd_shear: [None, Some(1)] };

    #[test]
    fn a_part_made_whole_goes_on_behind_the_mirrors() {
        let part = array![[1.0, 2.0], [3.0, 4.0]];
        let even = QUARTER.whole(&part, [false, false]);
        let rows =
            array![[4.0, 3.0, 3.0, 4.0], [2.0, 1.0, 1.0, 2.0], [2.0, 1.0, 1.0, 2.0], [4.0, 3.0, 3.0, 4.0]];
        assert_eq!(even, rows);
        assert!(QUARTER.is_kept_by(&even.view()));
        assert_eq!(HALF.whole(&part, [false, true]), array![[-2.0, -1.0, 1.0, 2.0], [-4.0, -3.0, 3.0, 4.0]]);
        assert_eq!(QUARTER.part(&even), part);
        assert_eq!(QUARTER.behind(&part), even.slice(s![..2, ..2]));
        assert_eq!(even[QUARTER.image_behind([1, 0], [2, 2])], part[[1, 0]]);
        for odd in [[true, false], [false, true], [true, true]] {
            let whole = QUARTER.whole(&part, odd);
            assert_eq!(QUARTER.part(&whole), part);
            assert!(!QUARTER.is_kept_by(&whole.view()));
        }
    }

    #[test]
    fn a_field_of_an_odd_number_of_cells_has_no_mirror_between_them() {
        assert!(!HALF.is_kept_by(&Array2::zeros((4, 3)).view()));
        assert!(HALF.is_kept_by(&Array2::zeros((3, 4)).view()));
    }

    #[test]
    fn forces_are_shared_and_motions_are_not() {
        let mut state = ContactState::untouched([4, 4]);
        state.shift = [0.25, 0.0];
        let load = LoadStep {
            normal: Control::Force(12.0),
            tangential: [Control::Motion(0.5), Control::Force(0.0)],
            ..LoadStep::FREE
        };
        let part = HALF.part_of_load(&load, &state);
        assert_eq!(part.normal, Control::Force(6.0));
        assert_eq!(part.tangential, [Control::Motion(0.5), Control::Motion(0.0)]);
        assert_eq!(HALF.whole_force([3.0, 1.0]), [6.0, 0.0]);
    }
}

//! A history that was solved, gone through from its end to its start: of a long one some increments are kept, from which those between are
//! found again.

use super::error::SensitivityError;
use super::fields::Fields;
use super::loads::{Load, Prescribed};
use super::operators::Operators;
use super::replay::Replay;
use super::scene::Scene;
use super::snapshot::Snapshot;
use super::solved::Solved;

/// Bytes a cell of an increment that is kept: twelve fields and the zone; and of its displacements alone.
const WHOLE: usize = 97;
const DISPLACEMENTS: usize = 24;

/// A history that was solved, increment by increment.
pub(super) struct Past<'a> {
    steps: &'a [Snapshot],
    replay: Replay<'a>,
    /// Increments of a segment.
    length: usize,
    segments: Vec<Start<'a>>,
    /// Displacements of all increments, which take a product with the response; none where all increments are kept.
    displacements: Vec<Fields>,
    /// Number of the segment at hand, and its increments.
    here: (usize, Vec<(Load, Solved)>),
}

/// Where a segment starts: the two increments before it, and what is prescribed there.
struct Start<'a> {
    prescribed: Prescribed<'a>,
    past: [Solved; 2],
}

/// Increments of a segment of a history of so many on a region of cells, after a run that took `run` bytes: all where they take no more than
/// that, or else as many as are kept at the starts.
pub(super) fn length_of_segments(increments: usize, cells: usize, run: usize) -> usize {
    if increments.saturating_mul(cells).saturating_mul(WHOLE) <= run {
        return increments.max(1);
    }
    // Of each segment two are kept.
    let length = ((2 * increments) as f64).sqrt().ceil().max(1.0) as usize;
    // Of a short history all are less.
    if bytes_per_cell(increments, length) < increments * WHOLE { length } else { increments.max(1) }
}

/// Bytes a cell that a history of so many increments in segments of a length takes at most.
pub(super) fn bytes_per_cell(increments: usize, length: usize) -> usize {
    let kept = if length < increments { 2 * increments.div_ceil(length) + length } else { increments };
    let displacements = if length < increments { increments } else { 0 };
    kept.saturating_mul(WHOLE).saturating_add(displacements.saturating_mul(DISPLACEMENTS))
}

impl<'a> Past<'a> {
    /// Goes through a history; `None` where bodies come apart, or no load changes in an increment: then derivatives go forward.
    pub fn of(
        scene: &'a Scene<'a>,
        steps: &'a [Snapshot],
        operators: &mut Operators,
        length: usize,
    ) -> Option<Self> {
        let (segments, displacements, here) = (Vec::new(), Vec::new(), (0, Vec::new()));
        let mut past = Self { steps, replay: Replay::new(scene), length, segments, displacements, here };
        for number in 0..steps.len() {
            if number.is_multiple_of(length) {
                let start = Start { prescribed: past.replay.prescribed.clone(), past: past.last_two() };
                past.segments.push(start);
                past.here = (number / length, Vec::with_capacity(length));
            }
            past.go_on(number, operators)?;
            if let (true, Some((_, solved))) = (length < steps.len(), past.here.1.last()) {
                past.displacements.push(solved.displacements.clone());
            }
        }
        Some(past)
    }

    /// The last two increments at hand; what bodies are before they touch where there are none.
    fn last_two(&self) -> [Solved; 2] {
        let Some(start) = self.segments.last() else { return [(); 2].map(|()| self.replay.start.clone()) };
        let (_, here) = &self.here;
        [1, 2].map(|back| back_from(here.len(), back, (here, &start.past)).clone())
    }

    /// Finds the increment of a number again, where the one before it is at hand.
    fn go_on(&mut self, number: usize, operators: &mut Operators) -> Option<()> {
        let Self { replay, here, segments, length, displacements, .. } = self;
        let start = &segments[here.0].past;
        let past = [1, 2].map(|back| back_from(number - here.0 * *length, back, (&here.1, start)));
        let last = number.checked_sub(1).map(|last| &self.steps[last]);
        let found = displacements.get(number);
        let next = replay.next((&self.steps[number], last), past.map(Some), (operators, found));
        let solved = next.solved.filter(|solved| solved.contact.len() > 0)?;
        self.here.1.push((next.load, solved));
        Some(())
    }

    /// Comes to an increment: finds those of its segment again where they are not at hand.
    pub fn come_to(&mut self, number: usize, operators: &mut Operators) -> Result<(), SensitivityError> {
        let segment = number / self.length;
        if segment == self.here.0 {
            return Ok(());
        }
        self.replay.prescribed = self.segments[segment].prescribed.clone();
        self.here = (segment, Vec::with_capacity(self.length));
        for at in segment * self.length..self.steps.len().min((segment + 1) * self.length) {
            // It was found before.
            self.go_on(at, operators).ok_or_else(|| {
                let increment = self.steps[at].record.increment;
                SensitivityError::Operators(format!("increment {increment} is not found again"))
            })?;
        }
        Ok(())
    }

    /// The load and the solution of an increment of the segment at hand, and the two before it.
    pub fn at(&self, number: usize) -> (&Load, &Solved, [&Solved; 2]) {
        let (segment, here) = &self.here;
        let place = number - segment * self.length;
        let (load, now) = &here[place];
        let start = &self.segments[*segment].past;
        (load, now, [1, 2].map(|back| back_from(place, back, (here, start))))
    }
}

/// The increment so far back, one or two, from a place in a segment, of which those before the place are at hand, or of the two before it.
fn back_from<'b>(
    place: usize,
    back: usize,
    (here, start): (&'b [(Load, Solved)], &'b [Solved; 2]),
) -> &'b Solved {
    match place.checked_sub(back) {
        Some(at) => &here[at].1,
        None => &start[back - 1 - place],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing is found again where all takes little; else what is kept grows with the root.
    #[test]
    fn what_is_kept_grows_with_the_root() {
        assert_eq!(length_of_segments(96, 100, 96 * 100 * WHOLE), 96);
        assert_eq!([length_of_segments(96, 100, 96 * 100), length_of_segments(11, 100, 0)], [14, 11]);
        assert_eq!(bytes_per_cell(96, 14), 28 * WHOLE + 96 * DISPLACEMENTS);
        assert_eq!(
            [length_of_segments(800, 1, 0), bytes_per_cell(800, 40)],
            [40, 80 * WHOLE + 800 * DISPLACEMENTS]
        );
        assert_eq!([length_of_segments(0, 1, 0), bytes_per_cell(0, 1)], [1, 0]);
    }
}

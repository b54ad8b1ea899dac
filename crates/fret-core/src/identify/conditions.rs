//! The sliding conditions of a test over its cycles: where it changes from partial to gross slip, and back.

use serde::Serialize;

use super::identification::{Cycle, Identification};
use crate::history::CycleRegime;

/// Single cycles that a change of the sliding condition must explain: fewer, one after the other, are noise at the border.
const CHANGE: usize = 5;

/// Cycles of one sliding condition, by their names in the log.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Span {
    /// The first.
    pub from: f64,
    /// The last.
    pub to: f64,
    /// Partial or gross slip.
    pub sliding_condition: CycleRegime,
}

impl Identification {
    /// The sliding conditions of the test, in their order.
    pub fn sliding_conditions(&self) -> Vec<Span> {
        let judged: Vec<(f64, bool)> = self.cycles.iter().filter_map(condition).collect();
        let slides: Vec<bool> = judged.iter().map(|(_, slides)| *slides).collect();
        let mut spans: Vec<Span> = Vec::new();
        for ((name, _), slides) in judged.iter().zip(smoothed(&slides)) {
            let sliding_condition = if slides { CycleRegime::GrossSlip } else { CycleRegime::PartialSlip };
            match spans.last_mut() {
                Some(last) if last.sliding_condition == sliding_condition => last.to = *name,
                _ => spans.push(Span { from: *name, to: *name, sliding_condition }),
            }
        }
        spans
    }
}

/// The name of a cycle, and whether it is in gross slip; nothing of one that was skipped. That noise hides the friction of a cycle says
/// nothing about it.
fn condition(cycle: &Cycle) -> Option<(f64, bool)> {
    Some((cycle.measured.name, cycle.quantities.as_ref()?.slides?))
}

/// The sequence of two conditions that contradicts fewest cycles, where each change costs as much as [`CHANGE`] contradictions (Viterbi).
fn smoothed(slides: &[bool]) -> Vec<bool> {
    // cost of the best sequence that ends in either condition, and which one it came from
    let mut cost = [0, 0];
    let mut came_from = Vec::with_capacity(slides.len());
    for &slides in slides {
        let from = [0, 1].map(|to: usize| if cost[1 - to] + CHANGE < cost[to] { 1 - to } else { to });
        cost = [0, 1].map(|to: usize| {
            let change = if from[to] == to { 0 } else { CHANGE };
            cost[from[to]] + change + usize::from(usize::from(slides) != to)
        });
        came_from.push(from);
    }
    let mut state = usize::from(cost[1] < cost[0]);
    let step_back = |from: &[usize; 2]| {
        let now = state;
        state = from[now];
        now == 1
    };
    let mut sequence: Vec<bool> = came_from.iter().rev().map(step_back).collect();
    sequence.reverse();
    sequence
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judged cycle by cycle a test flickers where it changes from gross to partial slip; the one change that contradicts fewest cycles
    /// is told.
    #[test]
    fn a_change_is_told_once_where_single_cycles_flicker() {
        let mut judged: Vec<bool> = (0..400).map(|cycle| cycle < 200).collect();
        for flicker in [50, 185, 190, 191, 197, 203, 206, 350] {
            judged[flicker] = !judged[flicker];
        }
        let right: Vec<bool> = (0..400).map(|cycle| cycle < 200).collect();
        let found = smoothed(&judged);
        let wrong = found.iter().zip(&right).filter(|(found, right)| found != right).count();
        assert!(wrong <= 3, "{wrong}"); // the border itself is not known better than the cycles around it say
        assert_eq!(found.windows(2).filter(|pair| pair[0] != pair[1]).count(), 1);
    }

    #[test]
    fn long_stretches_are_kept_and_single_cycles_are_not() {
        let of = |text: &str| text.chars().map(|letter| letter == 's').collect::<Vec<bool>>();
        for (judged, right) in [
            ("", ""),
            ("s", "s"),
            ("pps", "ppp"),
            ("ssss", "ssss"),
            ("ssssssssssspsssssssss", "sssssssssssssssssssss"),
            ("sssssssssssspppppppppppppsssssssssssss", "sssssssssssspppppppppppppsssssssssssss"),
        ] {
            assert_eq!(smoothed(&of(judged)), of(right), "{judged}");
        }
    }
}

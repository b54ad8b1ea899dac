//! The turn of a body under a moment, where its place, about which it turns, follows from the turn: found in rounds, by secants.

/// By how much of a change of the twist that is taken the twist found changes, at the most, where the next one is looked for.
const STEEPEST: f64 = 0.9;

/// Twists that were taken for that of a moment in the rounds of an increment, with those that were then found.
#[derive(Default)]
pub struct TurnByMoment {
    /// The last twist taken and found [rad], and how far the upper surface lay shifted [cells].
    last: Option<([f64; 2], [f64; 2])>,
}

impl TurnByMoment {
    /// The next twist to take, after one was taken and another found: where a line through this round and the one before finds what it takes. A contact
    /// that slides finds half of a turn, say, anew in each round.
    pub fn next(&mut self, [taken, found]: [f64; 2], cells: [f64; 2]) -> f64 {
        let last = self.last.replace(([taken, found], cells));
        let Some(([taken_before, found_before], _)) = last.filter(|(_, before)| *before == cells) else {
            return found;
        };
        let slope = (found - found_before) / (taken - taken_before);
        if slope.is_finite() {
            taken + (found - taken) / (1.0 - slope.clamp(-STEEPEST, STEEPEST))
        } else {
            found
        }
    }
}

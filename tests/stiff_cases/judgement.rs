//! What a scene shows, what of it must hold, and the worst of a family.

use super::families::Family;
use super::scene::{Outcome, TOLERANCE};

/// What one scene shows; all relative.
#[derive(Debug, Clone, Copy)]
pub struct Judgement {
    /// Error of the frequency response.
    pub response: f64,
    /// Asymmetry of the operator.
    pub asymmetry: f64,
    /// Smallest pivot of the operator.
    pub pivot: f64,
    /// Residual.
    pub residual: f64,
    /// What is missing in the accounts of energy.
    pub balance: f64,
    /// Difference to the mirror image.
    pub mirror: f64,
    /// Convolutions an increment.
    pub effort: f64,
}

/// What must hold of a judgement.
pub struct Bounds;

impl Bounds {
    /// The response is right to rounding, a few thousand units in the last place after a thousand layers.
    pub const RESPONSE: f64 = 1e-12;
    /// A symmetric operator in rounding.
    pub const ASYMMETRY: f64 = 1e-12;
    /// Energy is missing in proportion to the residual.
    pub const BALANCE: f64 = 10.0 * TOLERANCE;
    /// So is symmetry, in the worst cell.
    pub const MIRROR: f64 = 100.0 * TOLERANCE;
}

impl Judgement {
    /// What does not hold, in words.
    pub fn broken(&self) -> Vec<&'static str> {
        let tests = [
            ("frequency response", self.response <= Bounds::RESPONSE),
            ("asymmetry", self.asymmetry <= Bounds::ASYMMETRY),
            ("positivity", self.pivot > 0.0),
            ("residual", self.residual <= TOLERANCE),
            ("energy balance", self.balance <= Bounds::BALANCE),
            ("mirror image", self.mirror <= Bounds::MIRROR),
        ];
        tests.into_iter().filter(|(_, holds)| !holds).map(|(name, _)| name).collect()
    }

    /// The worst of two in every respect.
    fn with(self, other: Self) -> Self {
        Self {
            response: self.response.max(other.response),
            asymmetry: self.asymmetry.max(other.asymmetry),
            pivot: self.pivot.min(other.pivot),
            residual: self.residual.max(other.residual),
            balance: self.balance.max(other.balance),
            mirror: self.mirror.max(other.mirror),
            effort: self.effort.max(other.effort),
        }
    }
}

/// A family judged.
#[derive(Debug, Clone)]
pub struct Row {
    /// Its name.
    pub name: &'static str,
    /// What varies in it.
    pub range: String,
    /// Scenes in it.
    pub scenes: usize,
    /// The worst of those that were solved.
    pub worst: Option<Judgement>,
    /// The scene that took most convolutions an increment.
    pub slowest: String,
    /// What was refused as not computable, with the reason.
    pub refused: Vec<[String; 2]>,
    /// What does not hold: which scene, what.
    pub broken: Vec<[String; 2]>,
}

/// Judges every scene of a family.
pub fn row(family: &Family) -> Row {
    let mut row = Row {
        name: family.name,
        range: family.range.clone(),
        scenes: family.scenes.len(),
        worst: None,
        slowest: String::new(),
        refused: Vec::new(),
        broken: Vec::new(),
    };
    let mut most = 0.0;
    for scene in &family.scenes {
        match scene.judged() {
            Outcome::Judged(found) => {
                row.broken
                    .extend(found.broken().into_iter().map(|what| [scene.label.clone(), what.to_owned()]));
                if found.effort > most {
                    most = found.effort;
                    row.slowest.clone_from(&scene.label);
                }
                row.worst = Some(row.worst.map_or(found, |worst| worst.with(found)));
            }
            Outcome::Refused(why) => row.refused.push([scene.label.clone(), why]),
            Outcome::Failed(why) => row.broken.push([scene.label.clone(), why]),
        }
    }
    row
}

impl Row {
    /// Whether everything holds that must.
    pub fn holds(&self) -> bool {
        self.broken.is_empty() && self.worst.is_some()
    }

    /// In two words.
    pub fn verdict(&self) -> String {
        match (self.holds(), self.refused.len()) {
            (true, 0) => "holds".to_owned(),
            (true, count) => format!("holds, {count} refused"),
            (false, _) => "DOES NOT HOLD".to_owned(),
        }
    }
}

//! What a history prescribes, increment by increment, and how it changes: linear in the numbers of its stages and in where these start.

use std::mem::discriminant;

use super::change::{Change, Reached};
use super::scene::Scene;
use crate::case::{Stage, StageControl};
use crate::model::controls::FREEDOMS;
use crate::model::stage::Path;
use crate::model::{ContactState, Control, LoadStep};

/// Where a control of a kind is among what a degree of freedom has reached.
fn place_of(control: Control) -> usize {
    match control {
        Control::Force(_) => 0,
        Control::Motion(_) => 1,
        Control::FarEnd(_) => 2,
    }
}

/// The control of a kind that prescribes what was reached.
fn reached_like(control: Control, reached: [f64; 3]) -> Control {
    let value = reached[place_of(control)];
    match control {
        Control::Force(_) => Control::Force(value),
        Control::Motion(_) => Control::Motion(value),
        Control::FarEnd(_) => Control::FarEnd(value),
    }
}

/// A load with controls of the kinds of another: where a kind is another one, what has been reached; with it, for each degree of freedom, whether
/// it was so.
fn of_kinds(
    load: &LoadStep,
    kinds: &[Control; FREEDOMS],
    freedoms: std::ops::Range<usize>,
    reached: &Reached,
) -> (LoadStep, [Option<usize>; FREEDOMS]) {
    let mut controls = load.controls();
    let mut taken = [None; FREEDOMS];
    for freedom in freedoms {
        if discriminant(&controls[freedom]) != discriminant(&kinds[freedom]) {
            controls[freedom] = reached_like(kinds[freedom], reached[freedom]);
            taken[freedom] = Some(place_of(kinds[freedom]));
        }
    }
    (LoadStep::of(controls), taken)
}

/// What a history has prescribed so far, of the whole contact.
#[derive(Clone)]
pub(super) struct Prescribed<'a> {
    scene: &'a Scene<'a>,
    held: LoadStep,
    start: LoadStep,
    /// The stage at work, how many of its increments have begun, and the share of the last one's way that has been.
    stage: Option<usize>,
    increments: usize,
    share: f64,
}

/// What an increment prescribes, and what that depends on.
#[derive(Debug, Clone)]
pub(super) struct Load {
    /// Of the part in front of the mirrors: at the end, and at the start, in controls of the same kinds; `None` before the first.
    pub step: LoadStep,
    pub from: Option<LoadStep>,
    pub stage: usize,
    /// Whether the stage begins.
    pub begins: bool,
    /// At the start of a stage: what is taken from what was reached.
    taken: [Option<usize>; FREEDOMS],
    /// The same of the start of the increment.
    taken_before: [Option<usize>; FREEDOMS],
    /// Derivatives of the load by that at the start of the stage and by the number of its control.
    keeps: [f64; FREEDOMS],
    own: [f64; FREEDOMS],
    /// Share of the part in front of the mirrors.
    share: [f64; FREEDOMS],
    copies: f64,
}

impl<'a> Prescribed<'a> {
    /// Nothing yet.
    pub fn new(scene: &'a Scene<'a>) -> Self {
        Self { scene, held: LoadStep::FREE, start: LoadStep::FREE, stage: None, increments: 0, share: 1.0 }
    }

    /// Goes on in a stage to the end of an increment, or to a share of its way, from a state, what that has reached, and the last load in front of
    /// the mirrors.
    pub fn next(
        &mut self,
        (stage, share): (usize, f64),
        (state, reached): (&ContactState, &Reached),
        last: Option<&LoadStep>,
    ) -> Load {
        let plan = self.scene.plan;
        let given = &plan.case.stages[stage];
        let begins = self.stage != Some(stage);
        self.increments = match self.share {
            _ if begins => 1,
            done if done >= 1.0 => self.increments + 1,
            _ => self.increments,
        };
        self.share = share;
        self.stage = Some(stage);
        let mut taken = [None; FREEDOMS];
        if begins {
            let mut kinds = self.held.controls();
            for (kind, control) in kinds.iter_mut().zip(given.by_freedom()) {
                if let Some(control) = control {
                    *kind = control.prescribing(0.0);
                }
            }
            (self.start, taken) = of_kinds(&self.held, &kinds, 0..reached.len(), reached);
        }
        self.held = given.load(&self.start, self.increments);
        let (mut keeps, mut own) = slopes(given, self.increments);
        if share < 1.0 {
            let k = self.increments - 1;
            let from = if k == 0 { self.start } else { given.load(&self.start, k) };
            self.held = LoadStep::between(&from, &self.held, share);
            let (keeps_before, own_before) = slopes(given, k);
            for (slopes, before) in [(&mut keeps, keeps_before), (&mut own, own_before)] {
                let both = slopes.iter_mut().zip(before);
                both.for_each(|(slope, before)| *slope = (1.0 - share) * before + share * *slope);
            }
        }
        let symmetry = plan.symmetry;
        let step = if symmetry.any() { symmetry.part_of_load(&self.held, state) } else { self.held };
        let copies = symmetry.copies() as f64;
        let (whole, part) = (self.held.controls(), step.controls());
        let share = std::array::from_fn(|freedom| match (whole[freedom], part[freedom]) {
            // Bulk stresses are no forces of a part.
            (Control::Force(_), Control::Force(_)) if freedom < 6 => 1.0 / copies,
            (whole, part) if discriminant(&whole) == discriminant(&part) => 1.0,
            _ => 0.0, // the symmetry forbids it
        });
        let mut of_part = *reached;
        for [force, ..] in &mut of_part {
            *force /= copies;
        }
        let from = last.map(|last| of_kinds(last, &step.controls(), 0..3, &of_part));
        let taken_before = from.map_or([None; FREEDOMS], |(_, taken)| taken);
        let from = from.map(|(from, _)| from);
        Load { step, from, stage, begins, taken, taken_before, keeps, own, share, copies }
    }
}

/// Derivatives of what a stage prescribes at the end of its increment `k`, 0 at its start, by where it starts and by the numbers of its controls, in both of
/// which it is linear.
fn slopes(stage: &Stage, k: usize) -> ([f64; FREEDOMS], [f64; FREEDOMS]) {
    let times = stage.times();
    let (mut keeps, mut own) = ([1.0; FREEDOMS], [0.0; FREEDOMS]);
    if k == 0 {
        return (keeps, own);
    }
    for (freedom, control) in stage.by_freedom().into_iter().enumerate() {
        let Some(control) = control else { continue };
        keeps[freedom] = stage.value(&with_number(control, 0.0), 1.0, k, times.as_ref());
        own[freedom] = stage.value(&with_number(control, 1.0), 0.0, k, times.as_ref());
    }
    (keeps, own)
}

/// A control with another number; of a table none.
fn with_number(control: &StageControl, number: f64) -> StageControl {
    let path = match control.path() {
        Path::To(_) => Path::To(number),
        Path::Wave { phase, .. } => Path::Wave { amplitude: number, phase: *phase },
        Path::Through(values) => Path::Through(vec![0.0; values.len()]),
    };
    match control {
        StageControl::Force(_) => StageControl::Force(path),
        StageControl::Motion(_) => StageControl::Motion(path),
        StageControl::FarEnd(_) => StageControl::FarEnd(path),
        StageControl::Rate(_) => StageControl::Rate(path),
    }
}

impl Load {
    /// Changes of the loads, with those of the numbers of the stage.
    pub fn forward(&self, before: &Change, numbers: &[f64; FREEDOMS], next: &mut Change) {
        let (mut taken, mut from) = (before.held, before.load);
        for (freedom, reached) in before.reached.iter().enumerate() {
            if let Some(place) = self.taken[freedom] {
                taken[freedom] = reached[place];
            }
            if let Some(place) = self.taken_before[freedom] {
                from[freedom] = reached[place] / if place == 0 { self.copies } else { 1.0 };
            }
        }
        next.start = if self.begins { taken } else { before.start };
        for freedom in 0..FREEDOMS {
            next.held[freedom] =
                self.keeps[freedom] * next.start[freedom] + self.own[freedom] * numbers[freedom];
            next.load[freedom] = self.share[freedom] * next.held[freedom];
        }
        next.from = from;
    }

    /// Backwards: from those of the loads to those of the loads before, and of the numbers of the stage.
    pub fn transposed(&self, next: &Change, before: &mut Change, numbers: &mut [f64; FREEDOMS]) {
        let mut start = next.start;
        for freedom in 0..FREEDOMS {
            let held = next.held[freedom] + self.share[freedom] * next.load[freedom];
            start[freedom] += self.keeps[freedom] * held;
            numbers[freedom] += self.own[freedom] * held;
        }
        for freedom in 0..FREEDOMS {
            if !self.begins {
                before.start[freedom] += start[freedom];
            } else if let Some(place) = self.taken[freedom] {
                before.reached[freedom][place] += start[freedom];
            } else {
                before.held[freedom] += start[freedom];
            }
            if let Some(place) = self.taken_before[freedom] {
                let copies = if place == 0 { self.copies } else { 1.0 };
                before.reached[freedom][place] += next.from[freedom] / copies;
            } else {
                before.load[freedom] += next.from[freedom];
            }
        }
    }
}

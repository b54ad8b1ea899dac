use super::super::tests::few_cells::{Asked, Cells, tractions_of};
use super::*;
use crate::random::Random;

/// A step that changes which cells are in contact, taken back by half: pressures are the means of both ends, and what slipped where the step
/// began is on its circle again. With the sets read on the contact after the step such cells would be left inside, and taken for
/// sticking.
#[test]
fn halfway_back_slipping_cells_are_on_their_circles_whatever_the_contact_became() {
    let cells = Cells::new([4, 3], 0.2);
    let mut random = Random::seeded(31);
    let (mut wider, mut as_wide, mut slipping) = (0, 0, 0);
    for _ in 0..300 {
        let asked = Asked::drawn(&mut random, &cells);
        let start: Vec<[f64; 3]> = (0..cells.count())
            .map(|cell| {
                let pressure = random.between(-0.5, 1.0_f64).max(0.0);
                let (angle, part) = (random.between(0.0, 6.3), random.between(0.5, 1.5_f64).min(1.0));
                let shear = part * asked.friction[cell] * pressure;
                [pressure, shear * f64::cos(angle), shear * f64::sin(angle)]
            })
            .collect();
        asked.problem(&cells, |problem| {
            let mut operators = cells.operators();
            let (mut tractions, count) = (tractions_of(&start), cells.count());
            let mut displacements = Displacements::zeros(count);
            let mut iterate = Iterate::new(problem, &mut tractions, &mut displacements, &operators);
            iterate.find_displacements(&mut operators);
            iterate.evaluate();
            iterate.find_sets();
            let (began, sets) = (iterate.contact.clone(), iterate.sets.clone());
            iterate.find_step(0.5, &SolverSettings::new(1e-8), &mut operators);
            if !iterate.take_step() {
                return;
            }
            let there = iterate.tractions.pressure.clone();
            iterate.find_displacements(&mut operators);
            iterate.evaluate();
            if iterate.contact == began {
                return;
            }
            wider += 1;
            as_wide += usize::from(iterate.contact.len() == began.len());
            iterate.go_halfway_back(&mut operators);
            for (cell, (start, there)) in start.iter().zip(&there).enumerate() {
                assert_eq!(iterate.tractions.pressure[cell], 0.5 * (start[0] + there));
            }
            for (packed, cell) in began.cells().enumerate().filter(|(packed, _)| sets.stick[*packed] == 0.0) {
                let bound = asked.friction[cell] * iterate.tractions.pressure[cell];
                let [x, y] = iterate.tractions.shear.at(cell);
                // Rounding of the projection.
                assert!((x.hypot(y) - bound).abs() <= 1e-14, "{packed} {cell}: {x} {y} {bound}");
                slipping += usize::from(bound > 0.0);
            }
        });
    }
    assert!(wider > 100 && as_wide > 10 && slipping > 300, "{wider} {as_wide} {slipping}");
}

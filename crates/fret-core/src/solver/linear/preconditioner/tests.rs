use std::f64::consts::TAU;

use super::*;
use crate::compliance::{SpectralCompliance, SurfaceCompliance};
use crate::fields::dot;
use crate::kernel::{Components, influence_coefficients, periodic_symbols};
use crate::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};

const CELLS: [usize; 2] = [16, 12];
const SPACING: [f64; 2] = [0.5, 0.7];
const NU: f64 = 0.3;

/// A rigid body on a half-space of shear modulus 1.
fn pair() -> ContactPair {
    let material = ElasticMaterial::new(2.0 * (1.0 + NU), NU).unwrap();
    let lower = HalfSpace::new(Vec::new(), Base::Elastic(material)).unwrap();
    ContactPair::new(Body::Rigid, Body::Elastic(lower)).unwrap()
}

fn preconditioner(response: &SurfaceResponse, single: bool) -> Preconditioner {
    let operators = OperatorSet { tangential: true, single, ..OperatorSet::default() };
    Preconditioner::new(response, None, CELLS, operators).unwrap()
}

fn periodic(single: bool) -> Preconditioner {
    let symbols = periodic_symbols(&pair(), CELLS, SPACING, Components::ALL, 0);
    preconditioner(&SurfaceResponse::Periodic(symbols), single)
}

fn free_space(single: bool) -> Preconditioner {
    let coefficients = influence_coefficients(&pair(), CELLS, SPACING, Components::ALL);
    preconditioner(&SurfaceResponse::FreeSpace(coefficients), single)
}

/// Two waves in the length of the region along x: on a half-space `u = (1 - nu) / (G k)` times pressure or shear along the wave, and
/// `1 / (G k)` times shear across it; cells take `sin(k d / 2) / (k d / 2)` off.
fn wave() -> (Vec<f64>, f64) {
    let turns = 2.0 / CELLS[0] as f64;
    let k = TAU * turns / SPACING[0];
    let half = 0.5 * k * SPACING[0];
    let values =
        (0..CELLS[0] * CELLS[1]).map(|cell| (TAU * turns * (cell / CELLS[1]) as f64).cos()).collect();
    (values, half.sin() / half / k)
}

fn all() -> ContactSet {
    ContactSet::of(CELLS[0] * CELLS[1], |_| true)
}

/// What would remove displacements `right` when the cells of a contact have this slip compliance.
fn shear_of(
    tested: &mut Preconditioner,
    contact: &ContactSet,
    right: [&[f64]; 2],
    slip_compliance: &[f64],
) -> [Vec<f64>; 2] {
    let mut weights = SlipWeights::default();
    tested.prepare(contact, slip_compliance, 1.0, &mut weights);
    let (mut x, mut y) = (vec![9.0; right[0].len()], vec![9.0; right[0].len()]);
    tested.shear((right, None), [&mut x, &mut y], &mut weights);
    [x, y]
}

fn worst(found: &[f64], expected: &[f64]) -> f64 {
    found.iter().zip(expected).fold(0.0, |worst, (found, expected)| worst.max((found - expected).abs()))
}

#[test]
fn waves_on_a_periodic_half_space_are_removed_exactly() {
    let (wave, response) = wave();
    for (single, rounding) in [(false, 1e-13), (true, 1e-6)] {
        let mut tested = periodic(single);
        let times = |factor: f64| -> Vec<f64> { wave.iter().map(|value| value * factor).collect() };
        let mut pressure = vec![9.0; wave.len()];
        tested.normal(&times((1.0 - NU) * response), &mut pressure);
        assert!(worst(&pressure, &wave) < rounding);
        // The same through a contact of all cells.
        let (contact, stick) = (all(), vec![0.0; wave.len()]);
        let mut weights = SlipWeights::default();
        tested.prepare(&contact, &stick, 1.0, &mut weights);
        tested.pressure(&times((1.0 - NU) * response), &mut pressure, &weights);
        assert!(worst(&pressure, &wave) < rounding);
        // Along the wave and across it, with twice as much of the latter.
        let right = [times((1.0 - NU) * response), times(2.0 * response)];
        let [x, y] = shear_of(&mut tested, &contact, [&right[0], &right[1]], &stick);
        assert!(worst(&x, &wave) < rounding && worst(&y, &times(2.0)) < 2.0 * rounding);
        assert_eq!(tested.passes, 3);
    }
}

/// A film a hundred times stiffer than what is below it, on a grid that repeats, all in contact: the pressure that removes normal displacements
/// moves the surface along itself, and the shear found with it leaves of the tangential displacements nothing. Without a film the shear is
/// found by itself.
#[test]
fn under_a_film_shear_removes_what_pressure_displaces_along_the_surface() {
    let material = |young: f64| ElasticMaterial::new(young, NU).unwrap();
    let film = Coating::new(material(100.0), 0.4).unwrap();
    let lower = HalfSpace::new(vec![film], Base::Elastic(material(1.0))).unwrap();
    let film = ContactPair::new(Body::Rigid, Body::Elastic(lower)).unwrap();
    let cells = CELLS[0] * CELLS[1];
    // Random numbers whose sum is zero: what is uniform displaces by what the datum says.
    let field = |seed: usize| -> Vec<f64> {
        let at = |cell: usize| ((cell * cell + seed * cell + 3 * seed) % 17) as f64 / 8.0 - 1.0;
        let mean = (0..cells).map(at).sum::<f64>() / cells as f64;
        (0..cells).map(|cell| at(cell) - mean).collect()
    };
    for (pair, follows) in [(film, true), (pair(), false)] {
        let symbols = periodic_symbols(&pair, CELLS, SPACING, Components::ALL, 0);
        let response = SurfaceResponse::Periodic(symbols);
        let operators = OperatorSet { full: true, ..OperatorSet::default() };
        let mut compliance = SpectralCompliance::new(&response, CELLS, operators).unwrap();
        let mut tested = Preconditioner::new(&response, None, CELLS, operators).unwrap();
        assert_eq!(tested.follows_pressure, follows);
        let (gap, right) = (field(1), [field(2), field(5)]);
        let mut weights = SlipWeights::default();
        tested.prepare(&all(), &vec![0.0; cells], 1.0, &mut weights);
        let [mut p, mut x, mut y, mut normal, mut along, mut across] = [(); 6].map(|()| vec![0.0; cells]);
        tested.pressure(&gap, &mut p, &weights);
        tested.shear(([&right[0], &right[1]], Some(&p)), [&mut x, &mut y], &mut weights);
        compliance.full([&p, &x, &y], [&mut normal, &mut along, &mut across]);
        let left = worst(&along, &right[0]).max(worst(&across, &right[1]));
        // Rounding of the stiffest waves' tractions; a half-space of this Poisson ratio leaves more than a tenth.
        assert!(if follows { left < 1e-11 } else { left > 0.1 }, "{left}");
    }
}

/// Slip compliance far above the elastic compliance decides alone: `q = s / D`.
#[test]
fn much_slip_compliance_leaves_the_elastic_response_aside() {
    let (wave, _) = wave();
    let mut tested = periodic(false);
    let slip_compliance = vec![1e10 * tested.softest; wave.len()];
    let [x, _] = shear_of(&mut tested, &all(), [&wave, &wave], &slip_compliance);
    let times: Vec<f64> = x.iter().map(|value| value * slip_compliance[0]).collect();
    // The elastic share is 3 / r with r = sqrt(D / softest) = 1e5.
    assert!(worst(&times, &wave) < 1e-4);
}

/// A preconditioner of conjugate gradients has to be symmetric and positive: with slip compliance that differs from cell to cell,
/// on a part of the cells, in either precision.
#[test]
fn inverses_are_symmetric_and_positive() {
    let contact = ContactSet::of(CELLS[0] * CELLS[1], |cell| cell % 5 != 0 && cell > 20);
    let field = |seed: usize| -> Vec<f64> {
        (0..contact.len())
            .map(|cell| ((cell * cell + seed * cell + 3 * seed) % 17) as f64 / 8.0 - 1.0)
            .collect()
    };
    for (single, rounding) in [(false, 1e-13), (true, 1e-5)] {
        for tested in [&mut periodic(single), &mut free_space(single)] {
            let slip_compliance: Vec<f64> =
                (0..contact.len()).map(|cell| (cell % 3) as f64 * 10.0 * tested.softest).collect();
            let mut apply = |right: [&[f64]; 2]| shear_of(tested, &contact, right, &slip_compliance);
            let (a, b) = ([field(1), field(2)], [field(3), field(5)]);
            let (m_a, m_b) = (apply([&a[0], &a[1]]), apply([&b[0], &b[1]]));
            let inner = |a: &[Vec<f64>; 2], b: &[Vec<f64>; 2]| dot(&a[0], &b[0]) + dot(&a[1], &b[1]);
            let (a_m_a, b_m_b) = (inner(&a, &m_a), inner(&b, &m_b));
            assert!(a_m_a > 0.0 && b_m_b > 0.0);
            assert!((inner(&a, &m_b) - inner(&b, &m_a)).abs() < rounding * (a_m_a * b_m_b).sqrt());
        }
    }
}

/// In free space it only has to come near: the displacement of a pressure in the middle of the region, back to pressure.
#[test]
fn displacements_in_free_space_are_removed_but_for_a_small_part() {
    let coefficients = influence_coefficients(&pair(), CELLS, SPACING, Components::NORMAL);
    let zz = coefficients.zz.as_ref().unwrap();
    let loaded = |i: usize, j: usize| if (6..10).contains(&i) && (4..8).contains(&j) { 1.0 } else { 0.0 };
    let pressure: Vec<f64> =
        (0..CELLS[0] * CELLS[1]).map(|cell| loaded(cell / CELLS[1], cell % CELLS[1])).collect();
    let displacement: Vec<f64> = (0..pressure.len())
        .map(|cell| {
            let (i, j) = (cell / CELLS[1], cell % CELLS[1]);
            (0..pressure.len())
                .map(|from| zz[[i.abs_diff(from / CELLS[1]), j.abs_diff(from % CELLS[1])]] * pressure[from])
                .sum()
        })
        .collect();
    let mut found = vec![0.0; pressure.len()];
    free_space(false).normal(&displacement, &mut found);
    let off: Vec<f64> = found.iter().zip(&pressure).map(|(found, given)| found - given).collect();
    // Images one region away answer with 1/16 of the size, and their sum over the neighbours with some of that.
    assert!(dot(&off, &off).sqrt() < 0.2 * dot(&pressure, &pressure).sqrt());
}

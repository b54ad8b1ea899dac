//! Influence coefficients where scales lie far apart: coatings a thousandth to ten thousand cells thick, long cells, offsets to
//! a thousand cells, all six components; and the first order in which a coating vanishes or becomes everything.

use std::f64::consts::{PI, TAU};

use fret_core::kernel::{Components, FrequencyResponse, influence_coefficients};
use fret_core::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};
use serde::Deserialize;

/// `(E, nu, h)`.
type Layer = (f64, f64, f64);
/// `(E, nu)`.
type Material = (f64, f64);

fn half_space(layers: &[Layer], substrate: Option<Material>) -> HalfSpace {
    let material = |young, poisson| ElasticMaterial::new(young, poisson).unwrap();
    let coatings = layers.iter().map(|&(e, nu, h)| Coating::new(material(e, nu), h).unwrap()).collect();
    HalfSpace::new(coatings, substrate.map_or(Base::Rigid, |(e, nu)| Base::Elastic(material(e, nu)))).unwrap()
}

/// zz, xx, yy, xy, zx, zy at some offsets of one grid.
fn coefficients(
    layers: &[Layer],
    substrate: Option<Material>,
    spacing: [f64; 2],
    offsets: &[[usize; 2]],
) -> Vec<[f64; 6]> {
    let pair = ContactPair::new(Body::Rigid, Body::Elastic(half_space(layers, substrate))).unwrap();
    let cells = [0, 1].map(|axis| 1 + offsets.iter().map(|offset| offset[axis]).max().unwrap());
    let found = influence_coefficients(&pair, cells, spacing, Components::ALL);
    let arrays = [found.zz, found.xx, found.yy, found.xy, found.zx, found.zy].map(Option::unwrap);
    offsets.iter().map(|&offset| arrays.each_ref().map(|array| array[offset])).collect()
}

#[derive(Deserialize)]
struct Regimes {
    bodies: Vec<GoldenBody>,
}

#[derive(Deserialize)]
struct GoldenBody {
    family: String,
    thickness: f64,
    layers: Vec<Layer>,
    substrate: Option<Material>,
    spacing: [f64; 2],
    rows: Vec<GoldenRow>,
}

/// `i, j, zz, xx, yy, xy, zx, zy`, then the row's own error over zz of the own cell and over zz of the row.
type GoldenRow = (usize, usize, f64, f64, f64, f64, f64, f64, f64, f64);

#[test]
fn six_components_in_all_regimes_are_right_to_rounding() {
    let regimes: Regimes = serde_json::from_str(include_str!("golden/coefficient_regimes.json")).unwrap();
    let (mut rows, mut values, mut large, mut farthest) = (0, 0, 0, [0, 0]);
    println!(
        "largest error of six components: where zz > 1e-5 zz(0), over zz / anywhere, over 1e-10 zz + 1e-15 zz(0)"
    );
    for family in regimes.bodies.chunk_by(|one, next| one.family == next.family) {
        print!("{:>10}", family[0].family);
        for bodies in family.chunk_by(|one, next| one.thickness == next.thickness) {
            let (mut of_offset, mut of_bound) = (0.0_f64, 0.0_f64);
            let mut shapes: Vec<[f64; 2]> = bodies.iter().map(|body| body.spacing).collect();
            shapes.dedup();
            assert_eq!(shapes, [[1.0, 1.0], [1.0, 10.0], [10.0, 1.0]]);
            for body in bodies {
                let offsets: Vec<[usize; 2]> = body.rows.iter().map(|row| [row.0, row.1]).collect();
                let found = coefficients(&body.layers, body.substrate, body.spacing, &offsets);
                assert_eq!(offsets[0], [0, 0]);
                let own = body.rows[0].2;
                for (row, found) in body.rows.iter().zip(&found) {
                    let &(i, j, zz, xx, yy, xy, zx, zy, certain_of_own, certain_of_offset) = row;
                    assert!(certain_of_offset < 1e-12 || certain_of_own < 1e-17, "the table itself");
                    for (found, exact) in found.iter().zip([zz, xx, yy, xy, zx, zy]) {
                        let error = (found - exact).abs();
                        // rounding; promised is 1e-10 of zz instead of 1e-13
                        assert!(
                            error <= 1e-13 * zz.abs() + 1e-15 * own,
                            "{} {} {:?} ({i}, {j}): {found:e}, not {exact:e}",
                            body.family,
                            body.thickness,
                            body.spacing
                        );
                        if zz.abs() > 1e-5 * own {
                            of_offset = of_offset.max(error / zz.abs());
                        }
                        of_bound = of_bound.max(error / (1e-10 * zz.abs() + 1e-15 * own));
                        values += usize::from(exact != 0.0);
                    }
                    rows += 1;
                    large += usize::from(zz.abs() > 1e-5 * own);
                    farthest = [farthest[0].max(i), farthest[1].max(j)];
                }
            }
            print!("  {:>6}: {of_offset:.0e} / {of_bound:.0e}", bodies[0].thickness);
        }
        println!();
    }
    println!(
        "{rows} rows, {values} values that are not zero, {large} rows with zz above 1e-5 of the own cell"
    );
    // all of the table
    assert_eq!((rows, values, large, farthest), (300, 1187, 273, [1000, 1000]));
}

/// Change of the compliances `C_zz`, `C_rr`, `C_tt`, `C_rz` by a coating far thinner than a wave, per thickness: strained by the
/// surface under it and squeezed by the traction on it, it changes the tractions on that surface by those of its plate.
fn thin_coating(coating: Material, substrate: Material) -> [f64; 4] {
    let shear = |(young, poisson): Material| young / (2.0 * (1.0 + poisson));
    let (nu, below) = (coating.1, substrate.1);
    let (g, g_below) = (shear(coating), shear(substrate));
    let (direct, across, coupled) =
        ((1.0 - below) / g_below, 1.0 / g_below, (1.0 - 2.0 * below) / (2.0 * g_below));
    let plate = 2.0 * g / (1.0 - nu);
    [
        (1.0 - 2.0 * nu) / (2.0 * g * (1.0 - nu))
            - 2.0 * nu / (1.0 - nu) * coupled
            - plate * coupled * coupled,
        1.0 / g + 2.0 * coupled - plate * direct * direct,
        1.0 / g - g * across * across,
        direct * ((1.0 - 2.0 * nu) / (1.0 - nu) - plate * coupled),
    ]
}

/// The same in the plane, integrated over the cell at an offset: constants of the wavenumber are a spring in the own cell,
/// and of the direction 1/r^2 elsewhere.
fn thin_coating_over_cell([zz, rr, tt, rz]: [f64; 4], [i, j]: [usize; 2], [dx, dy]: [f64; 2]) -> [f64; 6] {
    let ends = |n: usize, side: f64| [(n as f64 - 0.5) * side, (n as f64 + 0.5) * side];
    let (x, y) = (ends(i, dx), ends(j, dy));
    let corners = |term: &dyn Fn(f64, f64) -> f64| {
        term(x[1], y[1]) - term(x[1], y[0]) - term(x[0], y[1]) + term(x[0], y[0])
    };
    let own = if [i, j] == [0, 0] { 1.0 } else { 0.0 };
    let (mean, half) = (0.5 * (rr + tt) * own, 0.5 * (rr - tt) / TAU);
    let turned = half * (corners(&|x, y| (x / y).atan()) - corners(&|x, y| (y / x).atan()));
    [
        zz * own,
        mean - turned,
        mean + turned,
        2.0 * half * corners(&|x, y| x.hypot(y).ln()),
        -rz / TAU * corners(&|x, y| (y / x.abs()).asinh()),
        -rz / TAU * corners(&|x, y| (x / y.abs()).asinh()),
    ]
}

const OFFSETS: [[usize; 2]; 6] = [[0, 0], [1, 0], [0, 1], [1, 1], [3, 2], [10, 7]];
const MATERIALS: [(Material, Material); 5] = [
    ((4.0, 0.2), (1.0, 0.3)),
    ((0.1, 0.4), (1.0, 0.3)),
    ((100.0, 0.3), (1.0, 0.45)),
    ((0.3, 0.5), (1.0, 0.25)),
    ((2.0, 0.25), (1.0, 0.5)),
];

/// Largest difference of the change between two bodies, per `measure`, from `theory`, over the largest of the theory.
fn departure(with: &[[f64; 6]], without: &[[f64; 6]], measure: f64, theory: &[[f64; 6]]) -> f64 {
    let largest = theory.iter().flatten().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let mut worst = 0.0_f64;
    for ((with, without), theory) in with.iter().zip(without).zip(theory) {
        for component in 0..6 {
            let change = (with[component] - without[component]) / measure;
            worst = worst.max((change - theory[component]).abs());
        }
    }
    worst / largest
}

#[test]
fn a_thin_coating_changes_the_substrate_by_the_first_order_of_its_thickness() {
    println!("departure from the first order, coatings 1e-4 and 1e-5 cells thick");
    for (coating, substrate) in MATERIALS {
        for spacing in [[1.0, 1.0], [1.0, 10.0]] {
            let constants = thin_coating(coating, substrate);
            let theory = OFFSETS.map(|offset| thin_coating_over_cell(constants, offset, spacing));
            let without = coefficients(&[], Some(substrate), spacing, &OFFSETS);
            let [thick, thin] = [1e-4, 1e-5].map(|thickness| {
                let layers = [(coating.0, coating.1, thickness)];
                let with = coefficients(&layers, Some(substrate), spacing, &OFFSETS);
                departure(&with, &without, thickness, &theory)
            });
            println!("{coating:?} on {substrate:?}, cells {spacing:?}: {thick:.1e} {thin:.1e}");
            // the second order: h E1/E2 over the cell
            assert!(thin < 4e-5 * coating.0.max(1.0 / coating.0) && (9.5..10.5).contains(&(thick / thin)));
        }
    }
}

/// Integral of a function of the wavenumber that decays like `exp(-2 k)`, trapezoid in `x`, `k = exp(x - exp(-x))`.
fn over_wavenumbers(function: impl Fn(f64) -> f64) -> f64 {
    let step = 1.0 / 64.0;
    let nodes = (-5 * 64..5 * 64).map(|n| f64::from(n) * step);
    nodes
        .map(|x| ((x - (-x).exp()).exp(), 1.0 + (-x).exp()))
        .map(|(k, slope)| step * slope * k * function(k))
        .sum()
}

#[test]
fn a_thick_coating_is_its_half_space_but_for_a_shift_in_inverse_thickness() {
    println!("departure from the first order, coatings 1e4 and 1e5 cells thick");
    for (coating, substrate) in MATERIALS {
        let unit = FrequencyResponse::new(&half_space(&[(coating.0, coating.1, 1.0)], Some(substrate)));
        let alone = FrequencyResponse::new(&half_space(&[], Some(coating)));
        let shift = |pick: fn(&FrequencyResponse, f64) -> f64| {
            over_wavenumbers(|k| k * (pick(&unit, k) - pick(&alone, k))) / TAU
        };
        let (zz, rr) = (shift(|response, k| response.at(k).zz), shift(|response, k| response.at(k).rr));
        // in closed form across the wave
        let shear = |(young, poisson): Material| young / (2.0 * (1.0 + poisson));
        let tt = (0.5 * (1.0 + shear(coating) / shear(substrate))).ln() / (2.0 * PI * shear(coating));
        assert!((shift(|response, k| response.at(k).tt) / tt - 1.0).abs() < 1e-12);
        for spacing in [[1.0, 1.0], [1.0, 10.0]] {
            let area = spacing[0] * spacing[1];
            let tangential = 0.5 * (rr + tt) * area;
            let theory = OFFSETS.map(|_| [zz * area, tangential, tangential, 0.0, 0.0, 0.0]);
            let without = coefficients(&[], Some(coating), spacing, &OFFSETS);
            let [thick, thicker] = [1e4, 1e5].map(|thickness| {
                let layers = [(coating.0, coating.1, thickness)];
                let with = coefficients(&layers, Some(substrate), spacing, &OFFSETS);
                departure(&with, &without, 1.0 / thickness, &theory)
            });
            println!("{coating:?} on {substrate:?}, cells {spacing:?}: {thick:.1e} {thicker:.1e}");
            assert!(thicker < 1e-3 && (9.5..10.5).contains(&(thick / thicker)));
        }
    }
}

#[test]
fn fifty_thicknesses_from_the_load_a_film_on_a_rigid_base_does_not_move() {
    println!("largest coefficient fifty thicknesses and more away, over the largest of the own cell");
    for poisson in [0.0, 0.3, 0.4] {
        print!("{poisson:>5}");
        for thickness in [1e-3, 3e-3, 1e-2] {
            let (mut worst, mut of_zz) = (0.0_f64, 0.0_f64);
            for spacing in [[1.0, 1.0], [1.0, 10.0], [10.0, 1.0]] {
                let offsets: Vec<[usize; 2]> = (0..30).flat_map(|i| (0..30).map(move |j| [i, j])).collect();
                let found = coefficients(&[(1.0, poisson, thickness)], None, spacing, &offsets);
                let own = found[0].iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
                let largest =
                    found[1..].iter().flatten().fold(0.0_f64, |largest, value| largest.max(value.abs()));
                worst = worst.max(largest / own);
                of_zz = of_zz.max(largest / found[0][0]);
            }
            print!("  {thickness:>6}: {worst:.1e} (of zz {of_zz:.1e})");
            // exp(-50) and less in truth; rounding of the own cell's value
            assert!(worst < 1e-15);
        }
        println!();
    }
}

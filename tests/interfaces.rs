//! Coatings on springs: certified contacts, limits, a Winkler foundation, displacements that jump by traction over stiffness.

use std::f64::consts::PI;

use fret_core::history::History;
use fret_core::kernel::{Components, line_coefficients};
use fret_core::model::{
    Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace, Interface, Periodicity, SurfaceGrid,
};
use fret_core::subsurface::{DepthOperator, DepthPoint, Tractions};
use fret_validation::certifier::run_certified;
use fret_validation::{RADIUS, Sphere, keeping, solved};
use ndarray::Array2;
use serde::Deserialize;

/// Normal and shear stiffness; `None`: bonded.
type Springs = (Option<f64>, Option<f64>);

fn material(young: f64, poisson: f64) -> ElasticMaterial {
    ElasticMaterial::new(young, poisson).unwrap()
}

fn interface(springs: Option<Springs>) -> Interface {
    springs.map_or(Interface::BONDED, |(normal, shear)| Interface::springs(normal, shear).unwrap())
}

/// A coated sphere whose coating lies on this interface.
fn on(sphere: &Sphere, interface: &str, text: &str) -> String {
    let coated = format!("poisson = {} }}]", sphere.poisson);
    let replaced =
        text.replacen(&coated, &format!("poisson = {}, interface = {interface} }}]", sphere.poisson), 1);
    assert_ne!(replaced, text);
    replaced
}

fn pressure(history: &History) -> &Array2<f64> {
    history.fields.last().unwrap().pressure.as_ref().unwrap()
}

fn far(one: &Array2<f64>, other: &Array2<f64>) -> f64 {
    let largest = other.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    one.iter().zip(other).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs())) / largest
}

#[test]
fn coupled_contacts_on_springs_hold_every_law() {
    let sphere =
        Sphere { cells: 24, friction: 0.3, coating: Some((4.0, 0.5)), size: 4.0, ..Sphere::default() };
    for springs in ["{ normal_stiffness = 2.0, shear_stiffness = 0.5 }", "{ shear_stiffness = 0.02 }"] {
        let text = on(&sphere, springs, &sphere.pulled(&sphere.pressed(1.0, 3, "cubic"), 0.8, 3, None));
        let periodic = text.replace("[upper]", "periodic = true\n[upper]");
        for text in [text, periodic] {
            let ended = run_certified(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert!(ended.error.is_none(), "{:?}\n{text}", ended.error);
            assert_eq!(ended.wrong(), None, "{text}");
        }
    }
    let line = "[grid]\ncells = 64\nsize = 6.0\n[upper]\nrigid = true\n[lower]\n\
                coatings = [{ thickness = 0.4, young = 5.0, poisson = 0.25, interface = { normal_stiffness = 3.0, shear_stiffness = 0.3 } }]\n\
                substrate = { young = 1.0, poisson = 0.3 }\n[profile.cylinder]\nradius = 50.0\naxis = \"y\"\n[friction]\ncoefficient = 0.4\n\
                [[load]]\nnormal_force = 0.02\nincrements = 3\n[[load]]\ntangential_force = [5e-3, 0.0]\nbulk_stress = 1e-3\nincrements = 3\n";
    let ended = run_certified(line, &[]).unwrap_or_else(|error| panic!("{error}"));
    assert!(ended.error.is_none() && ended.wrong().is_none(), "{:?} {:?}", ended.error, ended.wrong());
}

#[test]
fn contacts_on_stiff_springs_are_those_of_bonded_coatings() {
    let sphere = Sphere { cells: 24, friction: 0.3, coating: Some((4.0, 0.5)), ..Sphere::default() };
    let text = sphere.pulled(&sphere.pressed(1.0, 2, "cubic"), 0.8, 2, None) + &keeping(1);
    let bonded = solved(&text);
    let same = solved(&on(&sphere, "\"bonded\"", &text));
    assert_eq!(pressure(&same), pressure(&bonded));
    // The change is that of the compliance: modulus over stiffness and coating thickness, 1e-9 and less.
    let stiff = solved(&on(&sphere, "{ normal_stiffness = 1e10, shear_stiffness = 1e10 }", &text));
    assert!(
        far(pressure(&stiff), pressure(&bonded)) < 1e-7,
        "{:e}",
        far(pressure(&stiff), pressure(&bonded))
    );
    // Soft ones spread the contact: more compliant at every wavenumber.
    let soft = solved(&on(&sphere, "{ normal_stiffness = 0.5, shear_stiffness = 0.5 }", &text));
    assert!(soft.steps[1].approach > 1.2 * bonded.steps[1].approach);
    assert!(soft.steps[1].max_pressure < 0.95 * bonded.steps[1].max_pressure);
}

/// A layer too thin to bend or to be compressed, on springs over a rigid base, is a Winkler foundation: `p = k (delta - r^2/2R)`,
/// `P = pi k R delta^2`.
#[test]
fn a_thin_layer_on_springs_over_a_rigid_base_is_a_winkler_foundation() {
    let (spring, force) = (0.1, 1e-3);
    let text = format!(
        "[grid]\ncells = [64, 64]\nsize = [2.6, 2.6]\n[upper]\nrigid = true\n[lower]\nbase = \"rigid\"\n\
         coatings = [{{ thickness = 4e-3, young = 1.0, poisson = 0.3, interface = {{ normal_stiffness = {spring}, shear_stiffness = 0.0 }} }}]\n\
         [profile.sphere]\nradius = {RADIUS}\n[[load]]\nnormal_force = {force:e}\nincrements = 1\n"
    );
    let found = solved(&text);
    let approach = (force / (PI * spring * RADIUS)).sqrt();
    // The layer bends over (E h^3/(12 (1 - nu^2) k))^(1/4) = 1.6 % of the contact radius of 0.8, and is compressed by h k/E = 4e-4.
    let (step, radius) = (&found.steps[0], (2.0 * RADIUS * approach).sqrt());
    assert!((step.approach / approach - 1.0).abs() < 4e-3, "{} {approach}", step.approach);
    assert!((step.max_pressure / (spring * approach) - 1.0).abs() < 6e-3, "{}", step.max_pressure);
    assert!((step.contact_area / (PI * radius * radius) - 1.0).abs() < 0.06, "{}", step.contact_area);
}

/// A coating that slides freely, without friction: in full contact of a wave its pressure is the amplitude over the response, whose
/// closed form over a rigid base is `2 (1 - nu^2)/(E k) sinh^2 x/(x + sinh x cosh x)`.
#[test]
fn a_wave_on_a_coating_that_slides_freely_answers_like_its_closed_form() {
    let (cells, amplitude, mean) = (32, 1e-4, 0.05);
    let text = format!(
        "[grid]\ncells = [{cells}, 4]\nsize = [1.0, 0.125]\nperiodic = true\n[upper]\nrigid = true\n[lower]\nbase = \"rigid\"\n\
         coatings = [{{ thickness = 0.2, young = 1.0, poisson = 0.3, interface = \"frictionless\" }}]\n\
         [profile.wave]\namplitude = {amplitude:e}\nwavelength_x = 1.0\n[[load]]\nnormal_force = {:e}\nincrements = 1\n{}",
        mean * 0.125,
        keeping(1)
    );
    let history = solved(&text);
    let (k, d) = (2.0 * PI, 1.0 / f64::from(cells));
    let x = k * 0.2_f64;
    let response = 2.0 * (1.0 - 0.09) / k * x.sinh().powi(2) / (x + x.sinh() * x.cosh());
    let cell = (0.5 * k * d).sin() / (0.5 * k * d);
    for ((i, _), p) in pressure(&history).indexed_iter() {
        let expected = mean + amplitude / (response * cell) * (k * history.grid.centre(0, i)).cos();
        // solved to 1e-8 of the mean
        assert!((p - expected).abs() < 1e-8 * mean + 1e-12, "{i}: {p} {expected}");
    }
}

#[test]
fn at_springs_tractions_pass_and_displacements_jump() {
    let springs = (Some(0.7), Some(0.3));
    let grid = SurfaceGrid::new([16, 12], [0.2, 0.25]).unwrap();
    let field =
        |seed: usize| Array2::from_shape_fn((16, 12), |(i, j)| ((7 * i + 11 * j + seed) % 17) as f64 / 17.0);
    let (p, x, y) = (field(0), field(5), field(3));
    // displacements in a period are those of the grid's own waves, as stresses are from 12 cells down
    for (periodic, thickness) in [(false, 0.6), (true, 3.2)] {
        let coating = Coating::new(material(4.0, 0.25), thickness).unwrap().on(interface(Some(springs)));
        let body = HalfSpace::new(vec![coating], Base::Elastic(material(1.0, 0.3))).unwrap();
        let at = |layer: usize| {
            let point = DepthPoint { depth: thickness, layer };
            let mut operator =
                DepthOperator::new(&body, point, &grid, Periodicity::Both(periodic), true, true).unwrap();
            let tractions = Tractions { pressure: p.view(), shear: Some([x.view(), y.view()]) };
            (operator.stress(&tractions), operator.displacement(&tractions).unwrap())
        };
        let ((upper, above), (lower, below)) = (at(0), at(1));
        let mean = |field: &Array2<f64>| field.mean().unwrap();
        for (component, stiffness) in [(2, springs.0), (0, springs.1), (1, springs.1)] {
            // u_x, u_y, u_z jump with sigma_xz, sigma_yz, sigma_zz; tension positive
            let traction = [
                upper.components[SHEAR_XZ].clone(),
                upper.components[SHEAR_YZ].clone(),
                upper.components[ZZ].clone(),
            ];
            let other = [&lower.components[SHEAR_XZ], &lower.components[SHEAR_YZ], &lower.components[ZZ]];
            let traction = &traction[component];
            let size = traction.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            for (one, two) in traction.iter().zip(other[component]) {
                assert!((one - two).abs() < 1e-11 * size, "{component}: {one} {two}");
            }
            // in periods displacements are without their means
            let jump = &above[component] - &below[component];
            let (jump_mean, traction_mean) =
                if periodic { (mean(&jump), mean(traction)) } else { (0.0, 0.0) };
            for (jump, traction) in jump.iter().zip(traction) {
                let expected = -(traction - traction_mean) / stiffness.unwrap();
                let error = (jump - jump_mean - expected).abs();
                // cells of two operators, each to 1e-12 of its largest value
                assert!(error < 1e-9 * size / stiffness.unwrap(), "{component}: {jump} {expected}");
            }
        }
    }
}

const ZZ: usize = 2;
const SHEAR_YZ: usize = 5;
const SHEAR_XZ: usize = 4;

#[derive(Deserialize)]
struct Stack {
    layers: Vec<(f64, f64, f64)>,
    substrate: Option<(f64, f64)>,
    #[serde(default)]
    interfaces: Vec<Option<Springs>>,
}

#[derive(Deserialize)]
struct Entry {
    family: String,
    lower: Stack,
    upper: Option<Stack>,
    datum: f64,
    rows: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
struct Table {
    bodies: Vec<Entry>,
}

fn half_space(stack: &Stack) -> Body {
    let coatings = stack.layers.iter().enumerate().map(|(index, &(e, nu, h))| {
        let springs = stack.interfaces.get(index).copied().flatten();
        Coating::new(material(e, nu), h).unwrap().on(interface(springs))
    });
    let base = stack.substrate.map_or(Base::Rigid, |(e, nu)| Base::Elastic(material(e, nu)));
    Body::Elastic(HalfSpace::new(coatings.collect(), base).unwrap())
}

#[test]
fn line_coefficients_on_springs_are_those_of_high_precision_integrals() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/line_coefficients_interfaces.json");
    let table: Table = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!(table.bodies.len(), 60);
    let mut worst_of_all = 0.0_f64;
    for entry in &table.bodies {
        let upper = entry.upper.as_ref().map_or(Body::Rigid, half_space);
        let pair = ContactPair::new(upper, half_space(&entry.lower)).unwrap();
        let found = line_coefficients(&pair, 1001, 1.0, entry.datum, Components::ALL);
        // offset; zz, xx, yy, zx, or zz alone; the table's own error
        let lanes = entry.rows[0].len() - 2;
        let own = entry.rows[0][1..=lanes].iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let mut worst = 0.0_f64;
        for row in &entry.rows {
            assert!(row[lanes + 1] < 1e-16, "the table's own error");
            let fields = [&found.zz, &found.xx, &found.yy, &found.zx];
            for (field, exact) in fields.into_iter().zip(&row[1..=lanes]) {
                let found = field.as_ref().unwrap()[[row[0] as usize, 0]];
                // far from a shallow datum coefficients are larger than the one at offset 0
                worst = worst.max((found - exact).abs() / own.max(exact.abs()));
            }
        }
        assert!(
            worst < 1e-12,
            "{}, h {}, datum {}: {worst:.1e}",
            entry.family,
            entry.lower.layers[0].2,
            entry.datum
        );
        worst_of_all = worst_of_all.max(worst);
    }
    println!("line coefficients on springs within {worst_of_all:.1e} of the own one");
}

/// The example of a tile on a film of epoxy. The film as a layer of its own has the same numbers but for what springs leave out, which is of
/// first order in its thickness: 4 % of the tile's, then half of that at the same stiffnesses. On springs a million times as stiff the
/// tile is bonded.
#[test]
fn the_example_on_a_film_is_the_case_with_the_film_as_a_layer() {
    let text = include_str!("../examples/bonded_tile.toml").replace("cells = [96, 96]", "cells = [48, 48]");
    let springs = "interface = { normal_stiffness = 4.815e14, shear_stiffness = 1.111e14 }\n";
    assert_eq!(text.matches(springs).count(), 1);
    let film = |part: f64| {
        format!(
            "[[lower.coatings]]\nthickness = {:e}\nyoung = {:e}\npoisson = 0.35\n",
            part * 10e-6,
            part * 3e9
        )
    };
    let stiff = springs.replace("e14", "e20");
    let [on_springs, layer, half, stiff, bonded] =
        [springs, &film(1.0), &film(0.5), &stiff, ""].map(|film| {
            let history = solved(&text.replace(springs, film));
            let peak = &history.steps[27];
            [peak.approach, peak.shift[0], peak.max_pressure, history.cycles[0].dissipated_energy]
        });
    let off = |one: [f64; 4], other: [f64; 4]| -> [f64; 4] {
        std::array::from_fn(|number| (one[number] / other[number] - 1.0).abs())
    };
    let [whole, halved] = [off(on_springs, layer), off(on_springs, half)];
    println!("springs for a layer: {whole:?}, half as thick {halved:?}, stiff {:?}", off(stiff, bonded));
    assert!((1.8..2.2).contains(&(whole[0] / halved[0])), "approach: {whole:?} {halved:?}");
    // found: 5e-4 of the approach; the tolerance of the solver is 1e-6
    assert!(whole.into_iter().all(|off| off < 6e-4), "{whole:?}");
    assert!(off(bonded, layer)[0] > 0.09 && off(bonded, layer)[1] > 0.02, "{:?}", off(bonded, layer));
    // the springs' compliance: 1e-6 of what makes 11 %
    assert!(off(stiff, bonded).into_iter().all(|off| off < 2e-6), "{:?}", off(stiff, bonded));
}

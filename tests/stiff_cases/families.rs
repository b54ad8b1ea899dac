//! The families of extreme scenes, quick and in full.

use super::bodies::{Layer, Stack};
use super::scene::Scene;

/// Scenes that vary in one respect.
#[derive(Debug, Clone)]
pub struct Family {
    /// Its name.
    pub name: &'static str,
    /// What varies.
    pub range: String,
    /// Its scenes.
    pub scenes: Vec<Scene>,
}

/// Poisson's ratios: the stiffest to shear, none, common, nearly and quite incompressible.
const POISSON: [f64; 6] = [-0.9, -0.5, 0.0, 0.3, 0.49, 0.5];

/// All families; the first is the benign scene that others are compared with.
pub fn families(quick: bool) -> Vec<Family> {
    let cells = if quick { 20 } else { 32 };
    let mut all = vec![
        family("benign", "a sphere on a plain half-space, mu 0.3, Q 0.8 mu P", vec![benign("plain", cells)]),
        contrasts(quick, cells),
        thicknesses(quick, cells),
        poissons(quick, cells),
        rigid_bases(quick, cells),
        frictions(quick, cells),
        pulls(quick, cells),
        long_cells(quick),
        units(quick, cells),
        loads(quick, cells),
        increments(quick),
        layers(quick, cells),
        springs(quick, cells),
        single_cell(),
        full_contact(cells),
    ];
    if !quick {
        all.push(nearly_full_contact(cells));
    }
    all
}

fn family(name: &'static str, range: impl Into<String>, scenes: Vec<Scene>) -> Family {
    Family { name, range: range.into(), scenes }
}

fn benign(label: impl Into<String>, cells: usize) -> Scene {
    Scene::benign(label.into(), cells)
}

/// Powers of ten from one to another, each `step`.
fn decades(from: i32, to: i32, step: usize) -> impl Iterator<Item = (i32, f64)> {
    (from..=to).step_by(step).map(|power| (power, 10.0_f64.powi(power)))
}

fn contrasts(quick: bool, cells: usize) -> Family {
    let step = if quick { 3 } else { 1 };
    let scenes = decades(-6, 6, step).map(|(power, contrast)| {
        benign(format!("E_c/E_s = 1e{power}"), cells).on(Stack::coated(contrast, 0.3, 0.5))
    });
    family("coating contrast", "E_c/E_s 1e-6 .. 1e6, h = 0.5 a", scenes.collect())
}

fn thicknesses(quick: bool, cells: usize) -> Family {
    let step = if quick { 4 } else { 1 };
    let contrasts: &[f64] = if quick { &[100.0] } else { &[0.01, 100.0] };
    let scenes = contrasts.iter().flat_map(|contrast| {
        decades(-4, 4, step).map(move |(power, thickness)| {
            benign(format!("h/a = 1e{power}, E_c/E_s = {contrast}"), cells)
                .on(Stack::coated(*contrast, 0.3, thickness))
        })
    });
    family("coating thickness", "h/a 1e-4 .. 1e4, E_c/E_s 0.01 and 100", scenes.collect())
}

fn poissons(quick: bool, cells: usize) -> Family {
    let ends = [POISSON[0], POISSON[5]];
    let ratios: &[f64] = if quick { &ends } else { &POISSON };
    let scenes = ratios.iter().flat_map(|coating| {
        ratios.iter().map(move |substrate| {
            let stack = Stack { substrate: Some([1.0, *substrate]), ..Stack::coated(4.0, *coating, 0.5) };
            benign(format!("nu1 = {coating}, nu2 = {substrate}"), cells).on(stack)
        })
    });
    family("Poisson's ratios", "-0.9 .. 0.5 in coating and substrate, E_c/E_s = 4", scenes.collect())
}

fn rigid_bases(quick: bool, cells: usize) -> Family {
    let ratios: &[f64] = if quick { &[0.3, 0.5] } else { &POISSON };
    let thicknesses: &[f64] = if quick { &[0.1, 10.0] } else { &[1e-2, 0.1, 1.0, 10.0, 1e3] };
    let scenes = ratios.iter().flat_map(|poisson| {
        thicknesses.iter().map(move |thickness| {
            let film = Layer::bonded(1.0, *poisson, *thickness);
            // Thin incompressible films spread the contact to twice its nominal radius.
            let scene =
                Scene { size: [5.4; 2], ..benign(format!("nu = {poisson}, h/a = {thickness}"), cells) };
            scene.on(Stack { coatings: vec![film], substrate: None })
        })
    });
    family("rigid base", "one layer, nu -0.9 .. 0.5, h/a 0.01 .. 1000", scenes.collect())
}

fn frictions(quick: bool, cells: usize) -> Family {
    let coefficients: &[f64] =
        if quick { &[1e-6, 1e-3, 2.0] } else { &[1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0, 1.5, 2.0] };
    let scenes = coefficients
        .iter()
        .map(|&friction| Scene { friction, ..benign(format!("mu = {friction:e}"), cells) });
    family("friction", "mu 1e-6 .. 2", scenes.collect())
}

fn pulls(quick: bool, cells: usize) -> Family {
    let all = [0.9, 0.99, 0.999, 0.9999];
    let shares = if quick { &all[3..] } else { &all };
    let scenes = shares.iter().flat_map(|&pull| {
        [("plain", Stack::plain()), ("E_c/E_s = 4", Stack::coated(4.0, 0.3, 0.5))].map(|(name, stack)| {
            Scene { pull, ..benign(format!("Q/(mu P) = {pull}, {name}"), cells).on(stack) }
        })
    });
    family("near gross slip", "Q 0.9 .. 0.9999 mu P", scenes.collect())
}

fn long_cells(quick: bool) -> Family {
    let shapes: &[[usize; 2]] =
        if quick { &[[160, 8], [8, 160]] } else { &[[160, 8], [80, 16], [16, 80], [8, 160]] };
    let scenes = shapes
        .iter()
        .map(|&cells| Scene { cells, ..benign(format!("{} x {} cells", cells[0], cells[1]), 8) });
    family("long cells", "1:20 .. 20:1", scenes.collect())
}

fn units(quick: bool, cells: usize) -> Family {
    let all = [[1e-12, 1.0], [1e12, 1.0], [1.0, 1e-12], [1.0, 1e12], [1e-12, 1e12], [1e12, 1e-12]];
    let factors = if quick { &all[4..] } else { &all };
    let scenes = factors.iter().map(|&units| {
        let label = format!("lengths x {:e}, moduli x {:e}", units[0], units[1]);
        Scene { units, ..benign(label, cells).on(Stack::coated(4.0, 0.3, 0.5)) }
    });
    family("units", "lengths and moduli x 1e-12 .. 1e12", scenes.collect())
}

fn loads(quick: bool, cells: usize) -> Family {
    let step = if quick { 12 } else { 3 };
    let scenes = decades(-12, 12, step).map(|(power, load)| {
        // a^3 grows with the load; the grid goes with it, sphere and coating do not.
        let contact = load.cbrt();
        Scene {
            contact,
            size: [3.6 * contact; 2],
            ..benign(format!("load x 1e{power}"), cells).on(Stack::coated(4.0, 0.3, 0.5))
        }
    });
    family("load", "x 1e-12 .. 1e12 on one sphere and coating", scenes.collect())
}

fn increments(quick: bool) -> Family {
    let counts: &[usize] = if quick { &[1, 10, 100] } else { &[1, 10, 100, 1000, 10_000] };
    let scenes = counts.iter().map(|&count| Scene {
        increments: [count, count],
        ..benign(format!("{count} + {count} increments"), 16)
    });
    family("increments", format!("1 .. {} for one path", counts[counts.len() - 1]), scenes.collect())
}

fn layers(quick: bool, cells: usize) -> Family {
    let contrasts: &[f64] = if quick { &[10.0] } else { &[1.0 + 1e-9, 10.0, 1e6] };
    let scenes = contrasts.iter().map(|&contrast| {
        let layer = |index: usize| {
            let (young, poisson) = if index.is_multiple_of(2) { (contrast, 0.25) } else { (1.0, 0.4) };
            Layer::bonded(young, poisson, 1e-3)
        };
        let stack = Stack { coatings: (0..1000).map(layer).collect(), ..Stack::plain() };
        benign(format!("moduli {contrast} : 1 in turn"), cells).on(stack)
    });
    family("thousand layers", "1000 of h = 0.001 a, alternating", scenes.collect())
}

fn springs(quick: bool, cells: usize) -> Family {
    let step = if quick { 6 } else { 2 };
    let contrasts: &[f64] = if quick { &[10.0] } else { &[0.1, 10.0] };
    let scenes = contrasts.iter().flat_map(|contrast| {
        decades(-6, 6, step).map(move |(power, factor)| {
            // Springs in units of the coating's own stiffness, modulus over thickness; softer against shear.
            let own = factor * contrast / 0.5;
            let coating = Layer { springs: Some([own, 0.1 * own]), ..Layer::bonded(*contrast, 0.3, 0.5) };
            benign(format!("k h/E_c = 1e{power}, E_c/E_s = {contrast}"), cells)
                .on(Stack { coatings: vec![coating], ..Stack::plain() })
        })
    });
    family("springs below the coating", "k_n h/E_c 1e-6 .. 1e6, k_t = 0.1 k_n, h = 0.5 a", scenes.collect())
}

fn single_cell() -> Family {
    let scenes = [("plain", Stack::plain()), ("E_c/E_s = 100", Stack::coated(100.0, 0.3, 0.5))].map(
        |(name, stack)| {
            // A sphere on an odd grid, pressed by a tenth of what would reach the next cell.
            let side = 1.8;
            let cell = side / 9.0;
            Scene { cells: [9; 2], size: [side; 2], contact: 0.2 * cell, ..benign(name, 9).on(stack) }
        },
    );
    family("single cell in contact", "9 x 9 cells", scenes.into())
}

fn full_contact(cells: usize) -> Family {
    let scenes = [("plain", Stack::plain(), 2.0), ("E_c/E_s = 100", Stack::coated(100.0, 0.3, 0.05), 100.0)]
        .map(|(name, stack, pressed)| wave(name, cells, stack, pressed));
    family("contact fills the period", "a wave pressed flat, and as much again", scenes.into())
}

fn nearly_full_contact(cells: usize) -> Family {
    let scenes = [10.0, 100.0].map(|contrast| {
        wave(&format!("E_c/E_s = {contrast}"), cells, Stack::coated(contrast, 0.3, 0.05), 2.0)
    });
    family(
        "contact nearly fills the period",
        "the same force under stiff coatings, h = 0.05 wavelengths",
        scenes.into(),
    )
}

fn wave(label: &str, cells: usize, stack: Stack, pressed: f64) -> Scene {
    Scene { wave: Some(pressed), size: [1.0; 2], ..benign(label, cells).on(stack) }
}

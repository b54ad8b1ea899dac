//! Wear through layers: what each layer of both bodies loses by closed forms, and bodies whose elastic response gets thinner with them.

use fret_core::case::Case;
use fret_core::history::History;
use fret_core::kernel::PairResponse;
use fret_core::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace, Symmetry, thinned};
use fret_core::plan::{LeaveOut, Plan, Simplification};
use fret_validation::shortcuts::{TOLERANCE, difference, solved as solved_leaving_out};
use fret_validation::{Sphere, keeping, run, solved};

/// Pressure on a flat layer and amplitude of its cycles; stiffness of the layer (E = 10, nu = 0.3, thickness 1) under uniform shear.
const PRESSURE: f64 = 3.0;
const AMPLITUDE: f64 = 1.0;
const SHEAR_MODULUS: f64 = 10.0 / 2.6;
const FRICTION: f64 = 0.2;

/// A flat on flat layers, pressed evenly and slid to and fro: every cell wears the same. `lower`, `upper`: bodies as TOML.
fn flat([lower, upper]: [&str; 2], wear: &str, cycles: usize) -> String {
    format!(
        "[grid]\ncells = [8, 4]\nsize = [2.0, 1.0]\nperiodic = true\n[upper]\n{upper}\n[lower]\n{lower}\n\
         [profile.wave]\namplitude = 1e-13\nwavelength_x = 2.0\n[friction]\ncoefficient = {FRICTION}\n[wear]\n{wear}\n\
         [[load]]\nnormal_force = {:e}\nincrements = 1\n[[load]]\nshift = [{AMPLITUDE:e}, 0.0]\nincrements = 8\ncycles = {cycles}\n\
         [output]\nfields = [\"worn_depth\", \"pressure\"]\nevery = 8\n",
        PRESSURE * 2.0
    )
}

/// A layer of a thickness and a wear coefficient on a rigid base.
fn on_rigid(thickness: f64, coefficient: f64) -> String {
    format!(
        "coatings = [{{ thickness = {thickness:e}, young = 10.0, poisson = 0.3, wear_coefficient = {coefficient:e} }}]\nbase = \"rigid\""
    )
}

/// Work by area of so many cycles at constant stiffness: the first starts without shear.
fn work_of(cycles: usize, stiffness: f64) -> f64 {
    let shear = FRICTION * PRESSURE;
    shear * (4.0 * AMPLITUDE * cycles as f64 - (4.0 * cycles as f64 + 1.0) * shear / stiffness)
}

/// The dissipated energy by area times the coefficient of the layer at the surface, piece by piece, in both bodies: by hand. Volumes of the
/// layers add up to that of all.
#[test]
fn each_layer_of_both_bodies_loses_its_coefficient_times_the_energy() {
    let work = work_of(40, SHEAR_MODULUS / 1.0);
    // Lower: a film that lasts a quarter of the work, then twice as hard. Upper: rigid, worn too.
    let (soft, hard, rigid) = (1e-3 / work, 0.5e-3 / work, 0.3e-3 / work);
    let film = 0.25 * soft * work;
    let lower = format!(
        "coatings = [{{ thickness = {film:e}, young = 10.0, poisson = 0.3, wear_coefficient = {soft:e} }},\
         {{ thickness = {:e}, young = 10.0, poisson = 0.3, wear_coefficient = {hard:e} }}]\nbase = \"rigid\"",
        1.0 - film
    );
    let upper = format!("rigid = true\nwear_coefficient = {rigid:e}");
    for wear in ["law = \"energy\"", "law = \"energy\"\nevery = 7\nlargest_step = 1.0"] {
        let history = solved(&flat([&lower, &upper], wear, 40));
        let energy = history.steps.last().unwrap().dissipated_energy / 2.0;
        // The first cycle starts without shear; a jump counts it for seven.
        assert!((energy / work - 1.0).abs() < 0.01, "{energy:e} {work:e}");
        let expected = [film + hard * (energy - film / soft), rigid * energy];
        let last = history.cycles.last().unwrap();
        let found = [last.lower_worn_depth.unwrap(), last.upper_worn_depth.unwrap()];
        for (found, expected) in found.into_iter().zip(expected) {
            // Sums of the same numbers in another order.
            assert!((found / expected - 1.0).abs() < 1e-10, "{wear}: {found:e} {expected:e}");
        }
        assert!((last.max_worn_depth / (expected[0] + expected[1]) - 1.0).abs() < 1e-10);
        let layers = history.worn_by_layer.as_ref().unwrap();
        assert_eq!((layers.lower.len(), layers.upper.len()), (3, 1));
        assert!((layers.lower[0] / (2.0 * film) - 1.0).abs() < 1e-12 && layers.lower[2] == 0.0);
        let sum: f64 = layers.lower.iter().chain(&layers.upper).sum();
        assert!((sum / last.worn_volume - 1.0).abs() < 1e-12);
        assert_eq!(last.compliance_spread, None, "the response stays");
    }
}

/// Depth by depth, a stiffness that follows the thickness: cycle by cycle a recurrence, for the layer gives by its shear over `G / h`, and
/// the approach is that of the thinner layer.
#[test]
fn a_layer_gets_stiffer_as_it_wears() {
    let coefficient = 0.01 / work_of(1, SHEAR_MODULUS);
    let wear = "law = \"energy\"\nthinning_tolerance = 1e-9\nlargest_step = 1.0";
    let history = solved(&flat([&on_rigid(1.0, coefficient), "rigid = true"], wear, 30));
    let shear = FRICTION * PRESSURE;
    let (mut thickness, mut before) = (1.0, 0.0);
    let mut worst = 0.0_f64;
    for cycle in &history.cycles {
        // The shear that a cycle starts with has given the thicker layer way already: only its change does.
        let slip = 4.0 * AMPLITUDE - (5.0 * shear - before) * thickness / SHEAR_MODULUS;
        before = shear;
        worst = worst.max((cycle.dissipated_energy / (2.0 * shear * slip) - 1.0).abs());
        thickness -= coefficient * shear * slip;
        worst = worst.max((cycle.lower_worn_depth.unwrap() / (1.0 - thickness) - 1.0).abs());
        assert!(cycle.compliance_spread.unwrap() < 1e-9, "even wear");
    }
    println!("a layer worn to {thickness:.3} of its thickness: energies and depths within {worst:.1e}");
    assert!(thickness < 0.8);
    // The solver's residual of 1e-8 over 30 cycles.
    assert!(worst < 1e-6, "{worst:e}");
    // In the next increment the layer gives as one of the thickness that is left: M / h under uniform pressure, M = E (1 - nu) / ((1 + nu)(1 - 2 nu)).
    let last = &history.steps[history.cycles[29].first_increment];
    let modulus = 10.0 * 0.7 / (1.3 * 0.4);
    let left = 1.0 - history.cycles[28].lower_worn_depth.unwrap();
    let depth = history.cycles[28].max_worn_depth;
    let expected = PRESSURE * left / modulus + depth;
    assert!((last.approach / expected - 1.0).abs() < 1e-7, "{:e} {expected:e}", last.approach);
}

/// What is left of a coating worn evenly answers as the case of the thinner one: pressed on, it has its approach and its pressure.
#[test]
fn a_coating_worn_evenly_is_the_thinner_coating() {
    let layers = |thickness: f64, coefficient: f64| {
        format!(
            "coatings = [{{ thickness = {thickness:e}, young = 10.0, poisson = 0.3, wear_coefficient = {coefficient:e} }},\
             {{ thickness = 0.3, young = 1.0, poisson = 0.2, wear_coefficient = 0.0 }}]\nbase = \"rigid\""
        )
    };
    let wear = "law = \"archard\"\nthinning_tolerance = 1e-9\nlargest_step = 1.0";
    let press =
        "[[load]]\nnormal_force = 18.0\nincrements = 1\n[[load]]\nnormal_force = 6.0\nincrements = 1\n";
    let text = |thickness: f64, coefficient: f64, cycles: usize| {
        flat([&layers(thickness, coefficient), "rigid = true"], wear, cycles)
            .replace("[output]", &format!("{press}[output]"))
    };
    let worn = solved(&text(0.5, 2e-3, 8));
    let depth = worn.cycles.last().unwrap().max_worn_depth;
    assert!(depth > 0.05 && depth < 0.4, "{depth}");
    let thinner = solved(&text(0.5 - depth, 0.0, 8));
    let ends = [&worn, &thinner].map(|history| {
        let [.., high, low] = &history.steps[..] else { panic!() };
        high.approach - low.approach
    });
    // Displacements of two loads, so that the worn gap does not matter; both to 1e-8.
    assert!((ends[0] / ends[1] - 1.0).abs() < 1e-6, "{ends:?}");
}

/// Half or a quarter of the grid behind mirrors wears thinner as the whole one does.
#[test]
fn mirrors_change_nothing_where_a_coating_gets_thinner() {
    for poisson in [0.0, 0.3] {
        let text = format!(
            "[grid]\ncells = [24, 24]\nsize = [2.8, 2.8]\n[upper]\nrigid = true\n[lower]\n\
             coatings = [{{ thickness = 0.02, young = 3.0, poisson = {poisson}, wear_coefficient = 0.8 }}]\n\
             substrate = {{ young = 1.0, poisson = {poisson}, wear_coefficient = 0.0 }}\n[profile.sphere]\nradius = 100.0\n\
             [friction]\ncoefficient = 0.3\n[solver]\ntolerance = {TOLERANCE:e}\n[wear]\nthinning_tolerance = 0.02\nlargest_step = 1.0\n\
             [[load]]\nnormal_force = 1.2e-2\nincrements = 3\n[[load]]\nshift = [0.03, 0.0]\nincrements = 8\ncycles = 30\n{}",
            keeping(8).replace("\"zone\"", "\"zone\", \"worn_depth\"")
        );
        let [with, without] = [LeaveOut::ALL, LeaveOut::all_but(Simplification::Mirror)].map(|leave_out| {
            let plan = Plan::leaving_out(Case::from_toml(&text, "case.toml").unwrap(), leave_out).unwrap();
            (plan.symmetry, solved_leaving_out(&text, leave_out).history)
        });
        assert!(with.0 != Symmetry::NONE && without.0 == Symmetry::NONE);
        let depths = [&with.1, &without.1].map(|history| history.cycles.last().unwrap().max_worn_depth);
        let off = difference(&without.1, &with.1);
        println!("nu = {poisson}: worn {:.2e} of 0.02, {off:.1e} apart", depths[0]);
        assert!(depths[0] > 0.1 * 0.02, "{}: the response shall have been found anew", depths[0]);
        // The same iterations on half of the cells: rounding, over 30 cycles.
        assert!((depths[0] / depths[1] - 1.0).abs() < 1e-11, "{depths:?}");
        assert!(off < 100.0 * TOLERANCE, "{off:e}");
    }
}

/// A soft coating under a sphere is worn through in the middle first, where the substrate wears by its own coefficient.
#[test]
fn a_coating_is_worn_through_in_the_middle_first() {
    let body = |coating: &str| {
        format!(
            "[grid]\ncells = [24, 24]\nsize = [2.6, 2.6]\n[upper]\nrigid = true\n[lower]\n{coating}\
             substrate = {{ young = 1.0, poisson = 0.3, wear_coefficient = 1e-9 }}\n[profile.sphere]\nradius = 100.0\n\
             [friction]\ncoefficient = 0.3\n"
        )
    };
    let coating = "coatings = [{ thickness = 2e-3, young = 0.3, poisson = 0.3, wear_coefficient = 0.2 }]\n";
    let loads = "[[load]]\nnormal_force = 1.2e-2\nincrements = 4\n[[load]]\nshift = [0.05, 0.0]\nincrements = 8\ncycles = 120\n";
    let wear = "[wear]\nlaw = \"energy\"\nthinning_tolerance = 0.05\nlargest_step = 1.0\n";
    let history = solved(&format!(
        "{}{wear}{loads}{}",
        body(coating),
        keeping(8).replace("\"zone\"", "\"zone\", \"worn_depth\"")
    ));
    let last = history.cycles.last().unwrap();
    let layers = history.worn_by_layer.as_ref().unwrap();
    assert!(layers.lower[1] > 0.0, "the substrate is reached: {layers:?}");
    let spread = last.compliance_spread.unwrap();
    println!(
        "worn {:.2e} of a coating of 2e-3; spread of compliance {spread:.2e}; volumes {:?}",
        last.lower_worn_depth.unwrap(),
        layers.lower
    );
    assert!(last.lower_worn_depth.unwrap() >= 2e-3);
    // In the middle the coating is gone, and the substrate, which hardly wears, carries on.
    let kept = history.fields.last().unwrap();
    let pressure = kept.pressure.as_ref().unwrap();
    let depth = kept.worn_depth.as_ref().unwrap();
    assert!((depth[[12, 12]] / 2e-3 - 1.0).abs() < 1e-4, "{:e}", depth[[12, 12]]);
    let mean = (depth * pressure).sum() / pressure.sum();
    assert!(mean > 0.95 * 2e-3 && mean < 2e-3, "{mean:e}");
}

/// What is left of a coating matters in proportion to its thickness, down to nothing: the response tends to that of the substrate.
#[test]
fn the_last_of_a_coating_matters_as_little_as_there_is_of_it() {
    let [soft, hard] = [0.2, 1.0].map(|young| ElasticMaterial::new(young, 0.3).unwrap());
    let coating = Coating::new(soft, 0.1).unwrap();
    let lower = Body::Elastic(HalfSpace::new(vec![coating], Base::Elastic(hard)).unwrap());
    let pair = ContactPair::new(Body::Rigid, lower).unwrap();
    let response = |left: f64| PairResponse::new(&thinned(&pair, [0.1 - left, 0.0]).unwrap()).times_k(1.0).zz;
    let bare = response(0.0);
    for left in [1e-3, 1e-5, 1e-7] {
        // What is of second order in the thickness, and rounding of the difference.
        let ratio = (response(left) - bare) / (response(0.1 * left) - bare);
        assert!((ratio - 10.0).abs() < 0.05, "{left:e}: {ratio}");
    }
    assert_eq!(bare, PairResponse::new(&thinned(&pair, [0.5, 0.0]).unwrap()).times_k(1.0).zz);
}

/// A Winkler layer under a sliding sphere: in every point p = M (d - r^2/2R - w)/(h - w) with one approach d for the force, and
/// dw = k mu p ds: an ordinary differential equation a point.
#[test]
fn a_thin_layer_wears_as_its_differential_equations_say() {
    // A thin, compressible layer, so thin against the contact that each point is its own spring.
    let (thickness, radius) = (0.02, 100.0);
    let modulus = 0.8 / (1.2 * 0.6); // M of E = 1, nu = 0.2
    let force = 4e-2;
    let text = format!(
        "[grid]\ncells = [48, 48]\nsize = [2.4, 2.4]\n[upper]\nrigid = true\n[lower]\n\
         coatings = [{{ thickness = {thickness}, young = 1.0, poisson = 0.2, wear_coefficient = K }}]\nbase = \"rigid\"\n\
         [profile.sphere]\nradius = {radius}\n[friction]\ncoefficient = 0.1\n[wear]\nlaw = \"archard\"\nthinning_tolerance = 1e-3\n\
         every = 1\nlargest_step = 1.0\n[[load]]\nnormal_force = {force}\nincrements = 1\n[[load]]\nshift = [0.02, 0.0]\nincrements = 4\n\
         cycles = 80\n[output]\nfields = [\"pressure\", \"worn_depth\"]\nevery = 4\n"
    );
    let k = 0.02;
    let history = solved(&text.replace("wear_coefficient = K", &format!("wear_coefficient = {k}")));
    let (side, cells) = (2.4, 400);
    let at = |index: i32| (f64::from(index) + 0.5) * side / f64::from(cells) - 0.5 * side;
    let squares: Vec<f64> =
        (0..cells * cells).map(|cell| at(cell / cells).powi(2) + at(cell % cells).powi(2)).collect();
    let layer = [thickness, radius, modulus, force, k, (side / f64::from(cells)).powi(2)];
    let [by_hand, unthinned] = [true, false].map(|thins| winkler(&history, layer, &squares, thins));
    let last = history.cycles.last().unwrap();
    let found = [last.max_worn_depth, history.steps.last().unwrap().approach];
    println!(
        "Winkler layer: depth and approach {found:?}, by its equations {by_hand:?}, not thinning {unthinned:?}"
    );
    // The layer is a thirtieth of the contact radius thick: 1 % of the load is carried otherwise.
    assert!((found[0] / by_hand[0] - 1.0).abs() < 0.015, "{found:?} {by_hand:?}");
    // The approach is that of the middle, where the layer is next to a spring; without thinning it is 0.6 % off.
    assert!((found[1] / by_hand[1] - 1.0).abs() < 1e-3, "{found:?} {by_hand:?}");
    assert!((unthinned[1] / by_hand[1] - 1.0).abs() > 5e-3, "{unthinned:?} {by_hand:?}");
}

/// The same layer in a line contact, under a cylinder.
#[test]
fn a_thin_layer_in_a_line_contact_wears_as_its_differential_equations_say() {
    let (thickness, radius, force, k) = (0.02, 100.0, 3e-2, 0.02);
    let modulus = 0.8 / (1.2 * 0.6);
    let text = format!(
        "[grid]\ncells = 256\nsize = 2.4\n[upper]\nrigid = true\n[lower]\n\
         coatings = [{{ thickness = {thickness}, young = 1.0, poisson = 0.2, wear_coefficient = {k} }}]\nbase = \"rigid\"\n\
         [profile.cylinder]\nradius = {radius}\naxis = \"y\"\n[friction]\ncoefficient = 0.1\n[wear]\nlaw = \"archard\"\n\
         thinning_tolerance = 1e-3\nevery = 1\nlargest_step = 1.0\n[[load]]\nnormal_force = {force}\nincrements = 1\n\
         [[load]]\nshift = [0.02, 0.0]\nincrements = 4\ncycles = 80\n"
    );
    let history = solved(&text);
    let step = 2.4 / 4000.0;
    let squares: Vec<f64> = (0..4000).map(|k| ((f64::from(k) + 0.5) * step - 1.2).powi(2)).collect();
    let layer = [thickness, radius, modulus, force, k, step];
    let [by_hand, unthinned] = [true, false].map(|thins| winkler(&history, layer, &squares, thins));
    let last = history.cycles.last().unwrap();
    let found = [last.max_worn_depth, history.steps.last().unwrap().approach];
    println!("line on a Winkler layer: {found:?}, by its equations {by_hand:?}, not thinning {unthinned:?}");
    // As under the sphere: a layer of a twentieth of the half-width is nearly its own spring, in the middle most of all.
    assert!((found[0] / by_hand[0] - 1.0).abs() < 0.015, "{found:?} {by_hand:?}");
    assert!((found[1] / by_hand[1] - 1.0).abs() < 1e-3, "{found:?} {by_hand:?}");
    assert!((unthinned[1] / by_hand[1] - 1.0).abs() > 5e-3, "{unthinned:?} {by_hand:?}");
}

/// Largest depth after the cycles of a history, and approach in the last one, by springs: at squares of the distance from the middle, one
/// for each `cell` (area, of a line length).
fn winkler(
    history: &History,
    [thickness, radius, modulus, force, k, cell]: [f64; 6],
    squares: &[f64],
    thins: bool,
) -> [f64; 2] {
    let squares: Vec<f64> = squares.iter().copied().filter(|square| *square < 1.44).collect();
    let mut worn = vec![0.0; squares.len()];
    let mut approach = 0.0;
    for cycle in &history.cycles {
        // All slides; at each turn the layer gives by its shear before.
        let turns = if cycle.cycle == 1 { 5.0 } else { 4.0 };
        let pressure = |approach: f64, worn: &[f64]| -> Vec<f64> {
            squares
                .iter()
                .zip(worn)
                .map(|(square, worn)| {
                    let left = if thins { thickness - worn } else { thickness };
                    (modulus * (approach - square / (2.0 * radius) - worn) / left).max(0.0)
                })
                .collect()
        };
        let (mut low, mut high) = (0.0, 0.05);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let found = pressure(middle, &worn).iter().sum::<f64>() * cell;
            if found > force { high = middle } else { low = middle }
        }
        approach = low;
        let pressure = pressure(low, &worn);
        for (worn, pressure) in worn.iter_mut().zip(&pressure) {
            let left = if thins { thickness - *worn } else { thickness };
            let gives = 0.1 * pressure * left * 2.4; // mu p h / G, G = 1 / 2.4
            *worn += k * pressure * (4.0 * 0.02 - turns * gives);
        }
    }
    [worn.into_iter().fold(0.0, f64::max), approach]
}

/// Halving the tolerance of a jump halves its error, against the run cycle by cycle.
#[test]
fn halving_the_tolerance_of_a_wear_jump_halves_its_error() {
    let sphere =
        Sphere { cells: 20, size: 2.8, poisson: 0.0, identical: true, friction: 0.3, ..Sphere::default() };
    let shift =
        0.9 * 0.3 * sphere.effective_modulus() * sphere.approach() / (4.0 * sphere.effective_shear_modulus());
    let volume = |wear: &str| {
        let text = format!(
            "{}[wear]\ncoefficient = 0.1\nlargest_step = 1.0\n{wear}\n[[load]]\napproach = {:e}\nincrements = 1\n[[load]]\n\
             shift = [{shift:e}, 0.0]\nincrements = 8\ncycles = 400\n",
            sphere.head(),
            sphere.approach()
        );
        let history = solved(&text);
        let last = history.cycles.last().unwrap();
        assert_eq!(last.last_cycle, 400);
        (history.cycles.len(), last.worn_volume, history)
    };
    let (_, exact, _) = volume("every = 1");
    let [coarse, fine, finer] = [4e-3, 2e-3, 1e-3].map(|tolerance| {
        let (cycles, volume, history) = volume(&format!("tolerance = {tolerance}"));
        let told = history.cycles.iter().filter_map(|cycle| cycle.wear_jump_error).fold(0.0, f64::max);
        let off = volume / exact - 1.0;
        println!(
            "tolerance {tolerance}: {cycles} cycles, volume off {off:.2e}, largest error told {told:.2e}"
        );
        assert!(cycles < 200 && off.abs() < tolerance, "{cycles} {off:e}");
        off
    });
    for ratio in [coarse / fine, fine / finer] {
        // First order in the length of the jumps, which are whole cycles and double at the most.
        assert!((1.4..2.8).contains(&ratio), "{coarse:e} {fine:e} {finer:e}");
    }
}

/// A layer on a rigid base gets ever stiffer, until a cycle takes more off it than it gives; a nearly incompressible film gets too thin for
/// the cells. The run says so.
#[test]
fn a_film_that_cannot_be_followed_ends_the_run_with_words() {
    let coefficient = 4e-3 / work_of(1, SHEAR_MODULUS);
    let wear = "law = \"energy\"\nthinning_tolerance = 0.2\nlargest_step = 1.0\nevery = 10";
    let text = flat([&on_rigid(1.0, coefficient), "rigid = true"], wear, 400);
    let failed = run(&text).unwrap_err().to_string();
    assert!(failed.contains("of the stiffest wave of pressure"), "{failed}");
    // With the response of the whole layer it would go on, through the base.
    assert!(run(&text.replace("thinning_tolerance = 0.2\n", "")).is_ok());
    let text = "[grid]\ncells = [16, 16]\nsize = [1.6, 1.6]\n[upper]\nrigid = true\n[lower]\n\
         coatings = [{ thickness = 0.0202, young = 1.0, poisson = 0.5, wear_coefficient = 0.003 }]\nbase = \"rigid\"\n\
         [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[wear]\nthinning_tolerance = 0.01\nlargest_step = 1.0\nevery = 9\n\
         [[load]]\nnormal_force = 1e-2\nincrements = 4\n[[load]]\nshift = [0.05, 0.0]\nincrements = 8\ncycles = 900\n";
    let failed = run(text).unwrap_err().to_string();
    assert!(failed.contains("nearly incompressible film"), "{failed}");
}

/// The same numbers in other units.
#[test]
fn units_are_the_user_s() {
    let end = |length: f64, modulus: f64| {
        let wear = 0.1 / modulus;
        let text = format!(
            "[grid]\ncells = [16, 16]\nsize = [{0:e}, {0:e}]\n[upper]\nrigid = true\n[lower]\n\
             coatings = [{{ thickness = {1:e}, young = {2:e}, poisson = 0.3, wear_coefficient = {3:e} }}]\n\
             substrate = {{ young = {4:e}, poisson = 0.3, wear_coefficient = 0.0 }}\n[profile.sphere]\nradius = {5:e}\n\
             [friction]\ncoefficient = 0.3\n[wear]\nthinning_tolerance = 0.02\n[[load]]\nnormal_force = {6:e}\nincrements = 3\n\
             [[load]]\nshift = [{7:e}, 0.0]\nincrements = 8\ncycles = 5\n",
            2.8 * length,
            0.02 * length,
            3.0 * modulus,
            wear,
            modulus,
            100.0 * length,
            1.2e-2 * modulus * length * length,
            0.03 * length
        );
        let history = solved(&text);
        let last = history.cycles.last().unwrap();
        [
            last.max_worn_depth / length,
            last.compliance_spread.unwrap(),
            last.dissipated_energy / (modulus * length.powi(3)),
        ]
    };
    let [one, other] = [end(1.0, 1.0), end(1e-3, 1e6)];
    assert!(one[0] > 1e-5, "{one:?}");
    for (a, b) in one.into_iter().zip(other) {
        // Two solutions to 1e-8.
        assert!((a / b - 1.0).abs() < 1e-5, "{one:?} {other:?}");
    }
}

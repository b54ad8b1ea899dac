//! Contacts that roll: Carter's creepage, the numbers of CONTACT's example, and one problem in the frames of the bodies and of the contact.

use std::f64::consts::PI;
use std::sync::Arc;

use fret_core::case::{Attachments, Case};
use fret_core::history::{History, Start, StepRecord};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::{Silent, Simulation};
use fret_validation::{off_first_law, run, solved, solved_with};
use ndarray::Array2;

/// Two cylinders of one material with E* = 1 and the relative radius 100, pressed to a half-width of 1; friction 0.3.
fn cylinders(grid: &str, kinematics: &str, loads: &str) -> String {
    let force = PI / 400.0;
    format!(
        "[grid]\n{grid}\n[upper]\nsubstrate = {{ young = 1.82, poisson = 0.3 }}\n[lower]\nsubstrate = {{ young = 1.82, poisson = 0.3 }}\n\
         [profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n[kinematics]\n{kinematics}\n[solver]\ntolerance = 1e-9\n\
         [[load]]\nnormal_force = {force:e}\nincrements = 1\n{loads}"
    )
}

/// A grid that goes with the contact holds twice the cells of an increment open beside it: then the answer is that of a wide grid. With less it is
/// not known what is left behind (beside one open cell the force of the steady state was 2.4 % too much), and that is refused.
#[test]
fn a_grid_that_goes_with_the_contact_holds_what_it_leaves_behind() {
    // The contact has 21 cells.
    let case = |cells: usize, loads: &str| {
        let grid = format!("cells = {cells}\nsize = {:?}\ndatum = 20.0", cells as f64 * 2.0 / 20.5);
        cylinders(&grid, "frame = \"contact\"", loads)
    };
    let steady = "[[load]]\nroll = \"steady\"\ncreepage = [2e-3, 0.0]\nincrements = 1\n".to_owned();
    let by = |cells: usize| {
        let way = 12.0 * 2.0 / 20.5;
        format!("[[load]]\nroll = {way:?}\ncreepage = [2e-3, 0.0]\nincrements = {}\n", 12 / cells)
    };
    // Steady to 1e-5 of the tractions; marched to the tolerance.
    for (loads, few, enough, tolerance) in
        [(steady, 23, 25, 1e-4), (by(1), 23, 25, 1e-6), (by(2), 27, 29, 1e-6)]
    {
        let error = run(&case(few, &loads)).unwrap_err().to_string();
        assert!(error.contains("twice the cells of an increment"), "{error}");
        let [narrow, wide] = [enough, 41].map(|cells| {
            let history = solved(&case(cells, &loads));
            let last = history.steps.last().unwrap();
            assert_eq!(last.contact_cells, 21);
            last.tangential_force[0]
        });
        assert!((narrow / wide - 1.0).abs() < tolerance, "{loads}: {narrow:e} {wide:e}");
    }
}

/// Carter (1926): under a tractive force Q the creepage is `mu a/R (1 - sqrt(1 - Q/(mu P)))`, and the stick zone of half-length
/// `a sqrt(1 - Q/(mu P))` lies at the leading edge.
#[test]
fn the_creepage_of_cylinders_is_carters() {
    for (fraction, expected) in [(0.25, 0.133_975), (0.5, 0.292_893), (0.75, 0.5), (0.9, 0.683_772)] {
        let force = fraction * 0.3 * PI / 400.0;
        let loads = format!(
            "[[load]]\ntangential_force = [{force:e}, 0.0]\nincrements = 4\n[[load]]\nroll = 14.0\nincrements = 1120\n"
        );
        let history = solved(&cylinders("cells = 256\nsize = 3.2", "frame = \"contact\"", &loads));
        let last = history.steps.last().unwrap();
        let [creepage, across] = last.creepage.unwrap();
        let found = creepage * 100.0 / 0.3;
        let zones = history.fields.last().unwrap().zone.as_ref().unwrap();
        let stick: Vec<usize> =
            (0..256).filter(|i| zones[[*i, 0]] == fret_core::model::Zone::Stick).collect();
        let half = 0.5 * stick.len() as f64 * 3.2 / 256.0;
        println!(
            "Carter, Q = {fraction} mu P: creepage {found:.6} ({:+.2} %), stick {half:.4} of {:.4}, up to x = {:.3}",
            100.0 * (found / expected - 1.0),
            (1.0_f64 - fraction).sqrt(),
            history.grid.centre(0, *stick.last().unwrap())
        );
        assert!((found / expected - 1.0).abs() < 0.005 && across == 0.0, "{found}");
        // to a cell at either end, and at the leading edge to one
        assert!((half - (1.0_f64 - fraction).sqrt()).abs() < 0.0125);
        assert!((history.grid.centre(0, *stick.last().unwrap()) - 1.0).abs() < 0.02);
    }
}

/// The example carter2d of CONTACT (Vollebregt), 50 elements over the contact, of which the foremost has its centre 0.01 behind the leading edge:
/// G = 82 000, nu = 0.28, P = 178.9 a unit of length, R = 500, mu = 0.3, creepage 2.4e-4 gives Q = 0.6480 mu P by its rule, which is that of end
/// points, an element an increment. Exact: 0.64. A tilt moves the contact to where that element is.
#[test]
fn creepage_prescribed_gives_the_force_of_contacts_example() {
    let text = |integration: &str| {
        format!(
            "[grid]\ncells = 60\nsize = 2.4\n[upper]\nsubstrate = {{ young = 209920.0, poisson = 0.28 }}\n[lower]\n\
             substrate = {{ young = 209920.0, poisson = 0.28 }}\n[profile.cylinder]\nradius = 500.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n\
             [kinematics]\nframe = \"contact\"\n[solver]\nintegration = \"{integration}\"\n\
             [[load]]\nnormal_force = 178.9\ntilt = -2e-5\nincrements = 1\n[[load]]\nroll = 24.0\ncreepage = [2.4e-4, 0.0]\nincrements = 600\n"
        )
    };
    let force = |text: &str| {
        let history = run(text).unwrap();
        let last = history.steps.last().unwrap();
        assert!((last.creepage.unwrap()[0] / 2.4e-4 - 1.0).abs() < 1e-9);
        last.tangential_force[0] / (0.3 * 178.9)
    };
    let [ends, second] = [force(&text("end_point")), force(&text("second_order"))];
    println!(
        "carter2d: Q/(mu P) = {ends:.4} by end points (CONTACT 0.6480), {second:.4} of second order (exact 0.64)"
    );
    // CONTACT prints four digits
    assert!((ends - 0.6480).abs() < 1e-4, "{ends}");
    assert!((second - 0.64).abs() < 0.05 * (0.648 - 0.64), "{second}");
}

fn ball(frame: &str, integration: &str, motion: &str) -> History {
    // cells of 0.1 in both; the grid of the bodies holds the way
    let cells = if frame == "bodies" { 64 } else { 28 };
    let text = format!(
        "[grid]\ncells = [{cells}, 28]\nsize = [{:?}, 2.8]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n\
         [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[kinematics]\nframe = \"{frame}\"\n\
         [solver]\ntolerance = 1e-10\nintegration = \"{integration}\"\n[output]\nfields = [\"pressure\", \"shear\", \"slip\"]\nevery = 1\n\
         [[load]]\nnormal_force = 1.2e-2\nincrements = 3\n[[load]]\ntangential_force = [1e-3, 0.0]\nincrements = 2\n\
         [[load]]\nroll = [1.6, 0.0]\n{motion}\nincrements = 16\n",
        0.1 * f64::from(cells),
    );
    let history = solved(&text);
    assert!(off_first_law(&history, 0.0) < 1e-9, "{:e}", off_first_law(&history, 0.0));
    history
}

/// A rigid ball on an elastic flat, pulled and rolled, along and across, and with spin: the grid fixed to the bodies, or with the contact, is one
/// problem. Tolerance: residuals of 1e-10 of each; they are solved in other regions.
#[test]
fn the_frame_of_the_bodies_and_that_of_the_contact_agree() {
    for motion in ["", "spin = 2e-3\ncreepage = [\"held\", 1e-3]", "creepage = [2e-3, 1e-3]"] {
        for integration in ["end_point", "second_order"] {
            let [bodies, contact] = ["bodies", "contact"].map(|frame| ball(frame, integration, motion));
            let mut largest = 0.0_f64;
            for (step, rolled) in (5..21).zip(1..=16_usize) {
                let [one, other] = [&bodies, &contact].map(|history| history.fields_of(step).unwrap());
                let (p, r) = (one.pressure.as_ref().unwrap(), other.pressure.as_ref().unwrap());
                let most = r.iter().copied().fold(0.0, f64::max);
                for ((i, j), pressure) in r.indexed_iter() {
                    let at = [i + 18 + rolled, j];
                    let mut differs = (p[at] - pressure).abs();
                    for axis in 0..2 {
                        let [q, s] = [one, other].map(|fields| &fields.shear.as_ref().unwrap()[axis]);
                        differs = differs.max((q[at] - s[[i, j]]).abs());
                    }
                    largest = largest.max(differs / most);
                }
            }
            let [one, other] = [&bodies, &contact].map(|history| history.steps.last().unwrap().clone());
            let numbers = |step: &StepRecord| {
                let [[x, y], [qx, qy]] = [step.creepage.unwrap(), step.tangential_force];
                [
                    x,
                    y,
                    step.spin.unwrap(),
                    qx,
                    qy,
                    step.twist_moment,
                    step.tilt_moment[0],
                    step.dissipated_energy,
                    step.external_work,
                ]
            };
            println!(
                "frames, {integration}, {motion}: tractions differ by {largest:.1e}, {:.6e} {:.6e}",
                numbers(&one)[0],
                numbers(&other)[0]
            );
            assert!(largest < 1e-7, "{largest:e}");
            for (place, (a, b)) in numbers(&one).into_iter().zip(numbers(&other)).enumerate() {
                assert!((a - b).abs() <= 1e-6 * a.abs().max(1e-6), "{place}: {a:e} {b:e}");
            }
        }
    }
}

/// Two bodies of one material, pressed by a Hertz pressure to a circle of radius 1, roll under small creepages and a small spin: everything but
/// the trailing edge sticks. Kalker's coefficients for a circle and nu = 0.25: `F_x = -G a^2 C11 xi`, `F_y = -G a^2 (C22 eta + a C23 phi)` with
/// C11 = 4.12, C22 = 3.67, C23 = 1.47 (Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, 1990, table E3, `g = 1`).
fn spheres(cells: usize, motion: &str, increments: usize) -> StepRecord {
    // G = 1: E = 2.5; E* of the pair = 4/3; R = 100
    let force = 4.0 / 3.0 * (4.0 / 3.0) / 100.0;
    let size = 2.4;
    let rolled = size / cells as f64 * increments as f64;
    let text = format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [{size}, {size}]\n[upper]\nsubstrate = {{ young = 2.5, poisson = 0.25 }}\n[lower]\n\
         substrate = {{ young = 2.5, poisson = 0.25 }}\n[profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.5\n[kinematics]\n\
         frame = \"contact\"\n[solver]\ntolerance = 1e-8\n[[load]]\nnormal_force = {force:e}\nincrements = 1\n\
         [[load]]\nroll = [{rolled:?}, 0.0]\n{motion}\nincrements = {increments}\n"
    );
    let history = run(&text).unwrap_or_else(|error| panic!("{error}"));
    history.steps.last().unwrap().clone()
}

#[test]
fn small_creepages_and_spin_give_kalkers_coefficients() {
    let small = 1e-6;
    let (cells, increments) = (48, 288);
    let along = spheres(cells, &format!("creepage = [{small:e}, 0.0]"), increments);
    let across = spheres(cells, &format!("creepage = [0.0, {small:e}]"), increments);
    let spin = spheres(cells, &format!("creepage = [0.0, 0.0]\nspin = {small:e}"), increments);
    let found = [along.tangential_force[0], across.tangential_force[1], spin.tangential_force[1]]
        .map(|force| force / small);
    println!("Kalker's coefficients: {found:?}, of 4.12, 3.67, 1.47");
    for (found, table) in found.into_iter().zip([4.12, 3.67, 1.47]) {
        // three digits, and 40 cells over the contact
        assert!((found / table - 1.0).abs() < 0.005, "{found} {table}");
    }
    // a spin turns a sphere to the left where it rolls to: the force is to the left
    assert!(spin.tangential_force[0].abs() < 1e-6 * spin.tangential_force[1]);
}

/// In the steady state friction takes what creepage and spin put in: `Q . creepage + M spin`, by distance rolled.
#[test]
fn the_work_of_creepage_is_what_friction_dissipates() {
    let cells = 32;
    let of = |increments: usize| spheres(cells, "creepage = [2e-3, 1e-3]\nspin = 1e-3", increments);
    let [before, last] = [192, 193].map(of);
    let rolled = 2.4 / cells as f64;
    let [creepage, force] = [last.creepage.unwrap(), last.tangential_force];
    let put_in = force[0] * creepage[0] + force[1] * creepage[1] + last.twist_moment * last.spin.unwrap();
    let dissipated = (last.dissipated_energy - before.dissipated_energy) / rolled;
    let worked = (last.external_work - before.external_work) / rolled;
    println!("power: put in {put_in:.6e}, work {worked:.6e}, dissipated {dissipated:.6e}");
    assert!((worked / put_in - 1.0).abs() < 1e-6, "{worked} {put_in}");
    // what 27 cells over the contact leave unresolved
    assert!((dissipated / put_in - 1.0).abs() < 3e-3, "{dissipated} {put_in}");
}

/// CONTACT's example tractcurv: spheroids of a/b = 1/2, nu = 0.28, mu = 0.33, 106.7 kN, 48 x 44 elements over 1.1 times the contact. Of its steady
/// force 0.007015, 0.2588 and 0.4742 mu P; it prints four digits, and its increments are 1.73
/// elements.
#[test]
fn the_tractive_curve_is_that_of_contact() {
    // Hertz, e^2 = 3/4: the complete elliptic integrals K and E
    let (k, e) = (2.156_515_647_5, 1.211_056_027_6);
    let [of_x, of_y] = [(4.0 * e - k) / 3.0, (k - e) / 3.0];
    let modulus = 82_000.0 / 0.72;
    let along = (of_x * 3.0 * 106_700.0 / (4.0 * PI * modulus * 0.0008)).cbrt();
    let across = 2.0 * along;
    let [width, depth] = [2.2 * along, 2.2 * across];
    let [radius_x, radius_y] = [625.0, 625.0 * of_x / of_y];
    for (creepage, expected) in [(1e-5, 0.007_015), (4e-4, 0.2588), (8e-4, 0.4742)] {
        let text = format!(
            "[grid]\ncells = [48, 44]\nsize = [{width:?}, {depth:?}]\n[upper]\nsubstrate = {{ young = 209920.0, poisson = 0.28 }}\n[lower]\n\
             substrate = {{ young = 209920.0, poisson = 0.28 }}\n[profile.ellipsoid]\nradius_x = {radius_x:?}\nradius_y = {radius_y:?}\n\
             [friction]\ncoefficient = 0.33\n[kinematics]\nframe = \"contact\"\n[solver]\nintegration = \"end_point\"\n\
             [[load]]\nnormal_force = 106700.0\nincrements = 1\n[[load]]\nroll = [{:?}, 0.0]\ncreepage = [{creepage:e}, 0.0]\nincrements = 240\n",
            5.0 * width
        );
        let history = run(&text).unwrap_or_else(|error| panic!("{error}"));
        let found = history.steps.last().unwrap().tangential_force[0] / (0.33 * 106_700.0);
        println!("tractcurv: {creepage:e} gives {found:.6} mu P (CONTACT {expected})");
        assert!((found / expected - 1.0).abs() < 2e-3, "{found}");
    }
}

/// CONTACT's example bentall: an aluminium roller on a steel roller, R = 50 each, 16.2019 a unit of length, 216 elements of 0.001; free rolling.
/// Creepage, largest pressure and elements in adhesion, of three with friction of 0.05: free, and pulled by 0.75 of it forward and back. There it
/// rolls to -x, here to x.
#[test]
fn unlike_rollers_creep_as_contacts_do() {
    for (friction, pull, expected, told) in [
        (1e-4, 0.0, 5.260e-4, None),
        (0.05, 0.0, 4.294e-4, Some((103.6, 125))),
        (0.05, 0.75, 2.109e-4, Some((103.2, 36))),
        (0.05, -0.75, 5.392e-4, Some((103.3, 106))),
    ] {
        let pull = pull * friction * 16.2019;
        let text = format!(
            "[grid]\ncells = 216\nsize = 0.216\n[upper]\nsubstrate = {{ young = 60260.0, poisson = 0.31 }}\n[lower]\n\
             substrate = {{ young = 209920.0, poisson = 0.28 }}\n[profile.cylinder]\nradius = 25.0\naxis = \"y\"\n\
             [friction]\ncoefficient = {friction:?}\n[kinematics]\nframe = \"contact\"\n[solver]\nintegration = \"end_point\"\n\
             [[load]]\nnormal_force = 16.2019\nincrements = 1\n[[load]]\nroll = 0.1\ntangential_force = [{pull:e}, 0.0]\nincrements = 100\n[[load]]\n\
             roll = 1.1\nincrements = 1000\n"
        );
        let history = run(&text).unwrap_or_else(|error| panic!("{error}"));
        let last = history.steps.last().unwrap();
        let found = -last.creepage.unwrap()[0];
        println!(
            "bentall, mu {friction}: creepage {found:.4e} (CONTACT {expected:e}), pressure {:.2}",
            last.max_pressure
        );
        // four digits are printed
        assert!((found - expected).abs() < 1e-7, "{found}");
        // Friction takes what the force and the moment of the pressure put in, by distance, where they nearly cancel, too: to what 162 cells over
        // the contact leave unresolved of the larger.
        let [pulled, pressed] = [last.tangential_force[0] * -found, last.tilt_moment[0] / 25.0];
        let dissipated = last.rolling_friction.unwrap();
        println!("dissipated {dissipated:.4e}: by the force {pulled:.4e}, by the pressure {pressed:.4e}");
        assert!(pressed.abs() > 0.01 * dissipated);
        let larger = pulled.abs().max(pressed.abs());
        assert!((pulled + pressed - dissipated).abs() < 5e-3 * larger, "{pulled} + {pressed}, {dissipated}");
        if let Some((pressure, adhesion)) = told {
            assert!((last.max_pressure - pressure).abs() < 0.06 && last.stick_cells == adhesion, "{last:?}");
        }
    }
}

/// Two like cylinders with like coatings under a creepage so small that all sticks: the linear theory, by a dense matrix of the response along the
/// surface (O'Sullivan & King's of a bilayer, with the coating's half-space in closed form and the rest by quadrature); force by creepage for
/// 40 cells over a half-width of 1, coatings half of that (`golden/rolling_coated.py`). Coating over substrate, E1/E2: 1/2, 2, 10 (E2 = 1.82, nu =
/// 0.3).
#[test]
fn coated_cylinders_roll_as_the_linear_theory_says() {
    for (young, most, expected) in
        [(0.91, 0.007, 0.932_026_242_4), (3.64, 0.012, 2.632_588_095_3), (18.2, 0.03, 8.906_082_269_1)]
    {
        let body = format!(
            "coatings = [{{ thickness = 0.5, young = {young}, poisson = 0.3 }}]\nsubstrate = {{ young = 1.82, poisson = 0.3 }}\n"
        );
        let text = |force: f64| {
            format!(
                "[grid]\ncells = 64\nsize = 3.2\n[upper]\n{body}[lower]\n{body}[profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[friction]\n\
             coefficient = 0.9\n[kinematics]\nframe = \"contact\"\n[solver]\ntolerance = 1e-11\nintegration = \"end_point\"\n\
             [[load]]\nnormal_force = {force:e}\nincrements = 1\n"
            )
        };
        // a force under which 40 cells touch
        let cells = |force: f64| run(&text(force)).unwrap().steps[0].contact_cells;
        let (mut low, mut high) = (1e-4, most);
        let force = loop {
            let force = 0.5 * (low + high);
            match cells(force) {
                40 => break force,
                fewer if fewer < 40 => low = force,
                _ => high = force,
            }
        };
        let text = text(force) + "[[load]]\nroll = 120.0\ncreepage = [1e-5, 0.0]\nincrements = 2400\n";
        let history = run(&text).unwrap_or_else(|error| panic!("{error}"));
        let last = history.steps.last().unwrap();
        let found = last.tangential_force[0] / 1e-5;

        println!("coated, {young}: force by creepage {found:.9} of {expected:.9}");
        assert_eq!([last.contact_cells, last.stick_cells], [40, 40]);
        // what ten digits and residuals of 1e-11 leave after 60 lengths of the contact
        assert!((found / expected - 1.0).abs() < 1e-8, "{found}");
    }
}

/// A coating of the body's own material is none.
#[test]
fn a_coating_of_the_bodys_own_material_is_none() {
    let text = |coating: &str| {
        format!(
            "[grid]\ncells = [32, 32]\nsize = [2.6, 2.6]\n[upper]\nrigid = true\n[lower]\n{coating}substrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[kinematics]\nframe = \"contact\"\n[solver]\ntolerance = 1e-10\n\
             [[load]]\nnormal_force = 0.0146\nincrements = 3\n[[load]]\nroll = [3.25, 0.0]\ncreepage = [1e-3, 5e-4]\nspin = 2e-4\nincrements = 40\n"
        )
    };
    let [bare, coated] =
        ["", "coatings = [{ thickness = 0.4, young = 1.0, poisson = 0.3 }]\n"].map(|coating| {
            let history = solved(&text(coating));
            history.steps.last().unwrap().clone()
        });
    let numbers = |step: &StepRecord| {
        [step.tangential_force[0], step.tangential_force[1], step.twist_moment, step.dissipated_energy]
    };
    for (one, other) in numbers(&bare).into_iter().zip(numbers(&coated)) {
        // kernels of coated bodies are right to some 1e-9
        assert!((one / other - 1.0).abs() < 1e-7, "{one:e} {other:e}");
    }
}

/// An oscillating bearing (false brinelling): a ball that is pulled rolls back and forth on a flat, and both wear. What wears is the coefficient
/// times what friction dissipates; without pull, a pair of one material has nothing to wear.
#[test]
fn rolling_back_and_forth_wears_by_what_friction_dissipates() {
    let case = |pull: f64| {
        format!(
            "[grid]\ncells = [64, 32]\nsize = [4.8, 2.4]\n[upper]\nsubstrate = {{ young = 1.82, poisson = 0.3 }}\n[lower]\n\
             substrate = {{ young = 1.82, poisson = 0.3 }}\n[profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n\
             [solver]\ntolerance = 1e-10\n[wear]\ncoefficient = 0.5\n[output]\nfields = [\"worn_depth\", \"pressure\"]\n\
             [[load]]\nnormal_force = 0.0133\nincrements = 2\n[[load]]\ntangential_force = [{pull:e}, 0.0]\nincrements = 2\n\
             [[load]]\nroll = [0.6, 0.0]\nincrements = 32\ncycles = 4\n"
        )
    };
    let history = solved(&case(2e-3));
    assert!(off_first_law(&history, 0.0) < 1e-9);
    let last = history.steps.last().unwrap();
    let before = history.steps[3].dissipated_energy;
    println!(
        "oscillating: {:.4e} dissipated, of it {:.1e} before, {:.4e} worn",
        last.dissipated_energy, before, last.worn_volume
    );
    assert!((last.worn_volume / (0.5 * last.dissipated_energy) - 1.0).abs() < 1e-9);
    assert!(last.dissipated_energy > 3.0 * before);
    // the force stays, so that there is no loop of it
    assert!(history.cycles.iter().all(|cycle| cycle.energy_ratio.is_none() && cycle.force_amplitude == 0.0));
    // it wears beyond the contact at rest, as far as the way goes
    let worn = history.fields.last().unwrap().worn_depth.as_ref().unwrap();
    let [first, end] = [
        worn.rows().into_iter().position(|row| row.sum() > 0.0).unwrap(),
        64 - worn.rows().into_iter().rev().position(|row| row.sum() > 0.0).unwrap(),
    ];
    println!("worn from {first} to {end} of 64");
    let free = solved(&case(0.0));
    assert!(free.steps.last().unwrap().worn_volume == 0.0, "{:e}", free.steps.last().unwrap().worn_volume);
}

/// A grid that goes with the contact moves by whole cells; another increment is refused before anything is solved.
#[test]
fn parts_of_cells_are_refused() {
    let text =
        cylinders("cells = 64\nsize = 3.2", "frame = \"contact\"", "[[load]]\nroll = 1.0\nincrements = 30\n");
    let case = Case::from_toml(&text, "case.toml").unwrap_or_else(|error| panic!("{error}"));
    let refused = Plan::new(case).map(|_| ()).unwrap_err().to_string();
    assert!(refused.contains("moves by whole cells") && refused.contains("0.6667 cells"), "{refused}");
}

/// A steady state is told by an increment of one step, from which the next stage counts its way: over whole cells it stays steady, the way as the
/// user counts it from the start is refused with the distance rolled before.
#[test]
fn rolling_on_from_a_steady_state_stays_steady() {
    let force = 0.15 * PI / 400.0;
    let text = |to: f64| {
        let pull = format!("[[load]]\ntangential_force = [{force:e}, 0.0]\nincrements = 2\n");
        let way =
            format!("[[load]]\nroll = \"steady\"\nincrements = 1\n[[load]]\nroll = {to}\nincrements = 4\n");
        cylinders("cells = 64\nsize = 3.2\ndatum = 100.0", "frame = \"contact\"", &format!("{pull}{way}"))
    };
    let history = solved(&text(0.25));
    let [.., steady, _, _, _, last] = &history.steps[..] else { panic!("too few") };
    assert!((steady.roll[0] / 0.05 - 1.0).abs() < 1e-12 && (last.roll[0] / 0.25 - 1.0).abs() < 1e-12);
    let creepage = |step: &StepRecord| step.creepage.map_or(f64::NAN, |along| along[0]);
    // what is left of a transient, 1e-5 of the shear
    assert!((creepage(last) / creepage(steady) - 1.0).abs() < 1e-4, "{last:?}");
    let case = Case::from_toml(&text(0.2), "case.toml").unwrap_or_else(|error| panic!("{error}"));
    let refused = Plan::new(case).map(|_| ()).unwrap_err().to_string();
    assert!(refused.contains("0.7500 cells") && refused.contains("after [0.05, 0.0]"), "{refused}");
}

/// Bodies of one material under no force roll without creeping: nothing changes from the first length on, and that is steady.
#[test]
fn free_rolling_is_steady_at_once() {
    let history = solved(&cylinders(
        "cells = 64\nsize = 3.2\ndatum = 100.0",
        "frame = \"contact\"",
        "[[load]]\nroll = \"steady\"\nincrements = 1\n",
    ));
    let last = history.steps.last().unwrap();
    assert!(last.creepage.is_some_and(|along| along[0].abs() < 1e-12) && last.max_shear == 0.0, "{last:?}");
}

/// Rolling along x leaves the mirror across y, and none across its way; spin leaves none.
#[test]
fn rolling_keeps_the_mirror_beside_its_way() {
    let mirrors = |stage: &str| {
        let text = format!(
            "[grid]\ncells = [32, 32]\nsize = [3.2, 3.2]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[kinematics]\nframe = \"contact\"\n\
             [[load]]\nnormal_force = 0.01\nincrements = 1\n[[load]]\nincrements = 10\n{stage}\n"
        );
        let case = Case::from_toml(&text, "case.toml").unwrap_or_else(|error| panic!("{error}"));
        Plan::new(case).unwrap_or_else(|error| panic!("{error}")).symmetry.axes()
    };
    assert_eq!(mirrors("roll = [1.0, 0.0]\ncreepage = [1e-3, 0.0]"), [false, true]);
    assert_eq!(mirrors("roll = \"steady\"\ncreepage = [1e-3, 0.0]"), [false, true]);
    assert_eq!(mirrors("roll = [0.0, 1.0]"), [true, false]);
    assert_eq!(mirrors("roll = [1.0, 0.0]\nspin = 1e-3"), [false, false]);
    assert_eq!(mirrors("roll = [1.0, 0.0]\ncreepage = [0.0, 1e-3]"), [false, false]);
}

/// The steady state is found without the way to it: the same as that of marching, by fewer increments.
#[test]
fn the_steady_state_is_what_marching_ends_with() {
    let line = |stage: &str| cylinders("cells = 128\nsize = 3.2", "frame = \"contact\"", stage);
    let ball = |stage: &str| {
        format!(
            "[grid]\ncells = [40, 40]\nsize = [2.6, 2.6]\n[upper]\nrigid = true\n[lower]\n\
             coatings = [{{ thickness = 0.4, young = 2.0, poisson = 0.3 }}]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[kinematics]\nframe = \"contact\"\n[solver]\ntolerance = 1e-9\n\
             [[load]]\nnormal_force = 0.0146\nincrements = 3\n{stage}"
        )
    };
    let half = 0.5 * 0.3 * PI / 400.0;
    let cases = [
        (
            "cylinders, force",
            line(&format!("[[load]]\ntangential_force = [{half:e}, 0.0]\nincrements = 3\n[[load]]\nWAY\n")),
        ),
        ("cylinders, creepage", line("[[load]]\ncreepage = [1e-3, 0.0]\nWAY\n")),
        ("cylinders, along and across", line("[[load]]\ncreepage = [1e-3, 2e-3]\nWAY\n")),
        ("ball, creepage", ball("[[load]]\ncreepage = [1e-3, 0.0]\nWAY\n")),
        ("ball, creepage and spin", ball("[[load]]\ncreepage = [1e-3, 5e-4]\nspin = 2e-3\nWAY\n")),
        ("ball, force", ball("[[load]]\ntangential_force = [1e-3, 5e-4]\nincrements = 3\n[[load]]\nWAY\n")),
        ("ball, free", ball("[[load]]\nWAY\n")),
    ];
    for (name, text) in cases {
        let way = if name.starts_with("ball") { (19.5, 300) } else { (30.0, 1200) };
        let marched = run(&text.replace(
            "WAY",
            &format!(
                "roll = {}\nincrements = {}",
                if name.starts_with("ball") { format!("[{}, 0.0]", way.0) } else { way.0.to_string() },
                way.1
            ),
        ))
        .unwrap_or_else(|error| panic!("{name}: {error}"));
        let steady = run(&text.replace("WAY", "roll = \"steady\"\nincrements = 1"))
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let numbers = |history: &History| {
            let step = history.steps.last().unwrap();
            let [[x, y], [qx, qy]] = [step.creepage.unwrap(), step.tangential_force];
            [x, y, qx, qy, step.twist_moment, step.rolling_friction.unwrap()]
        };
        let [one, other] = [&marched, &steady].map(numbers);
        let last = steady.steps.last().unwrap();
        let seconds = |history: &History| history.steps.iter().map(|step| step.wall_s).sum::<f64>();
        println!(
            "{name}: {one:.7?} marched in {:.3} s; {other:.7?} steady after {} increments, {} convolutions, {:.3} s",
            seconds(&marched),
            last.parts,
            last.work.convolutions,
            seconds(&steady)
        );
        assert!(off_first_law(&steady, 0.0) < 1e-9, "{:e}", off_first_law(&steady, 0.0));
        let carries = 0.3 * last.normal_force;
        let creepage = one[0].abs().max(one[1].abs());
        let scales = [creepage, creepage, carries, carries, carries, carries * creepage];
        for (place, (a, b)) in one.into_iter().zip(other).enumerate() {
            // what is left of the transient, and of that of the march
            assert!((a - b).abs() < 2e-5 * scales[place], "{name}, {place}: {a:e} {b:e}");
        }
    }
}

/// Unlike coated bodies under creepage and spin, rolled to their steady state: radii, cells and creepage along x and y, and the way. Forces, moment,
/// rolling friction, creepage along x and y, and spin.
fn rolled_on(
    [radii, cells]: [[f64; 2]; 2],
    (direction, creepage, spin): ([f64; 2], [f64; 2], f64),
    driven: Option<[f64; 2]>,
) -> [f64; 7] {
    let drive = driven.map_or_else(
        || format!("creepage = {creepage:?}\nspin = {spin:e}"),
        |force| format!("tangential_force = {force:?}"),
    );
    let sides = [0, 1].map(|axis| 0.055 * cells[axis]);
    let text = format!(
        "[grid]\ncells = [{}, {}]\nsize = {sides:?}\n[upper]\nsubstrate = {{ young = 3.0, poisson = 0.2 }}\n[lower]\n\
         coatings = [{{ thickness = 0.3, young = 4.0, poisson = 0.3 }}]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
         [profile.ellipsoid]\nradius_x = {:?}\nradius_y = {:?}\n[friction]\ncoefficient = 0.3\n[solver]\ntolerance = 1e-9\n\
         [[load]]\nnormal_force = 0.0146\nincrements = 3\n[[load]]\nroll = \"steady\"\nroll_direction = {direction:?}\n{drive}\nincrements = 1\n",
        cells[0], cells[1], radii[0], radii[1]
    );
    let history = solved(&text);
    assert!(off_first_law(&history, 0.0) < 1e-9, "{:e}", off_first_law(&history, 0.0));
    let last = history.steps.last().unwrap();
    let [[qx, qy], [x, y]] = [last.tangential_force, last.creepage.unwrap()];
    let rolled = history.state.roll;
    let [dx, dy] = direction;
    assert!((rolled[0] * dy - rolled[1] * dx).abs() < 1e-12 && rolled[0] * dx + rolled[1] * dy > 0.0);
    [qx, qy, last.twist_moment, last.rolling_friction.unwrap(), x, y, last.spin.unwrap()]
}

/// The largest difference of forces, moment, rolling friction and creepages, each over the size of its kind.
fn apart(one: [f64; 7], other: [f64; 7]) -> f64 {
    let size = |places: &[usize]| places.iter().map(|place| one[*place].abs()).fold(0.0, f64::max);
    let scales =
        [size(&[0, 1]), size(&[0, 1]), size(&[2]), size(&[3]), size(&[4, 5]), size(&[4, 5]), size(&[6])];
    (0..7).map(|place| (one[place] - other[place]).abs() / scales[place].max(1e-12)).fold(0.0, f64::max)
}

/// A steady state rolled to along y is that along x with the axes exchanged: so are profile, cells and creepage, and what turns, turns the other way.
/// Rolled against x it is the mirror image. The search does the same in all of them, so that they differ by rounding alone, or,
/// where that turns an iteration, by the residuals.
#[test]
fn steady_states_along_all_axes_are_one_problem() {
    let (radii, cells) = ([100.0, 60.0], [46.0, 40.0]);
    let (creepage, spin) = ([1e-3, 5e-4], 2e-3);
    let exchanged = |[x, y]: [f64; 2]| [y, x];
    for driven in [None, Some([1e-3, 4e-4])] {
        let along = rolled_on([radii, cells], ([1.0, 0.0], creepage, spin), driven);
        let [qx, qy, m, friction, x, y, turned] = along;
        let back = driven.map(|[x, y]| [-x, y]);
        let mirrored = rolled_on([radii, cells], ([-2.0, 0.0], [-creepage[0], creepage[1]], -spin), back);
        let across = rolled_on(
            [exchanged(radii), exchanged(cells)],
            ([0.0, 3.0], exchanged(creepage), -spin),
            driven.map(exchanged),
        );
        let back = driven.map(|[x, y]| [y, -x]);
        let against = rolled_on(
            [exchanged(radii), exchanged(cells)],
            ([0.0, -1.0], [creepage[1], -creepage[0]], spin),
            back,
        );
        let off = [
            apart([-qx, qy, -m, friction, -x, y, -turned], mirrored),
            apart([qy, qx, -m, friction, y, x, -turned], across),
            apart([qy, -qx, m, friction, y, -x, turned], against),
        ];
        println!("steady, {driven:?}: {along:.6?}; against x, along y, against y off by {off:?}");
        assert!(off.iter().all(|off| *off < 1e-8), "{off:?}");
    }
}

/// A ball of one coating rolls alike in all directions: along a diagonal, by steps of one cell each way, and by two cells and one. Steps are 1.4 and
/// 2.2 cells long, and the cells lie otherwise on the contact: 36 cells over it leave a part in a hundred.
#[test]
fn a_ball_rolls_on_alike_in_all_directions() {
    let rolled = |direction: [f64; 2]| {
        let [c, s] = direction.map(|part| part / direction[0].hypot(direction[1]));
        let creepage = [1e-3 * c - 5e-4 * s, 1e-3 * s + 5e-4 * c];
        let found = rolled_on([[100.0, 100.0], [46.0, 46.0]], (direction, creepage, 2e-3), None);
        let [x, y] = [found[0], found[1]];
        [x * c + y * s, y * c - x * s, found[2], found[3]]
    };
    let along = rolled([1.0, 0.0]);
    for direction in [[1.0, 1.0], [-1.0, 2.0]] {
        let found = rolled(direction);
        let off = [0, 1, 2, 3].map(|place| found[place] / along[place] - 1.0);
        println!("a ball along {direction:?}: {found:.6?}, along x {along:.6?}, off by {off:?}");
        assert!(off.iter().all(|off| off.abs() < 0.02), "{off:?}");
    }
}

/// The grid goes with the contact by whole cells: a direction that none of them lie in is refused before anything is solved.
#[test]
fn directions_between_the_cells_are_refused() {
    let text = |direction: &str| {
        format!(
            "[grid]\ncells = [32, 32]\nsize = [3.2, 3.2]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 0.01\nincrements = 1\n\
             [[load]]\nroll = \"steady\"\nroll_direction = {direction}\nincrements = 1\n"
        )
    };
    let planned = |direction: &str| {
        Plan::new(Case::from_toml(&text(direction), "case.toml").unwrap_or_else(|error| panic!("{error}")))
    };
    let refused = planned("[1.0, 0.3]").map(|_| ()).unwrap_err().to_string();
    assert!(refused.contains("have no step of at most 3") && refused.contains("[1.0, 0.3]"), "{refused}");
    let mirrors = planned("[0.0, -1.0]").unwrap_or_else(|error| panic!("{error}")).symmetry.axes();
    assert_eq!(mirrors, [true, false]);
}

/// What a steady point costs: 64 x 64 cells, coupled, in operator applications.
#[test]
fn a_steady_point_of_a_coated_ball_is_found_soon() {
    let text = "[grid]\ncells = [64, 64]\nsize = [2.4, 2.4]\n[upper]\nrigid = true\n[lower]\n\
         coatings = [{ thickness = 0.4, young = 2.0, poisson = 0.3 }]\nsubstrate = { young = 1.0, poisson = 0.3 }\n\
         [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n\
         [[load]]\nnormal_force = 0.0146\nincrements = 3\n\
         [[load]]\nroll = \"steady\"\ncreepage = [1e-3, 5e-4]\nspin = 1e-3\nincrements = 1\n";
    let history = run(text).unwrap_or_else(|error| panic!("{error}"));
    let last = history.steps.last().unwrap();
    println!(
        "steady point: {:?} after {} increments, {} convolutions, {:.3} s",
        last.tangential_force, last.parts, last.work.convolutions, last.wall_s
    );
    // 2378 were counted, 46 cells over the contact.
    assert!(last.work.convolutions < 2650, "{}", last.work.convolutions);
    let [creepage, spin] = [last.creepage.unwrap()[1], last.spin.unwrap()];
    assert!((creepage / 5e-4 - 1.0).abs() < 1e-9 && (spin / 1e-3 - 1.0).abs() < 1e-9);
}

/// Lengths whose quotient is a whole number but for rounding, as 1.0000001 cells an increment: the grid moves by whole cells, and nothing is
/// carried between them.
#[test]
fn increments_that_are_whole_cells_but_for_rounding_go_by_whole_cells() {
    let loads = |roll: f64| {
        format!(
            "[[load]]\ntangential_force = [1e-3, 0.0]\nincrements = 2\n[[load]]\nroll = {roll:?}\nincrements = 40\n"
        )
    };
    let last = |size: &str, roll: f64| {
        let grid = format!("cells = 100\nsize = {size}");
        let history = solved(&cylinders(&grid, "frame = \"contact\"", &loads(roll)));
        let step = history.steps.last().unwrap().clone();
        (step.creepage.unwrap()[0], step.stick_cells)
    };
    // forty cells of 0.032, and of a cell shorter by 1e-7 and 3e-7 of itself
    let (right, cells) = last("3.2", 1.28);
    for size in ["3.19999968", "3.19999904"] {
        let (found, sticking) = last(size, 1.28);
        // Between cells a fraction of 1e-5 would smear the edges of the zones from the tenth increment on.
        assert!(
            (found / right - 1.0).abs() < 1e-5 && sticking == cells,
            "{size}: {found} {right}, {sticking} {cells}"
        );
    }
}

/// A scar stays where it was worn while the contact rolls away over it: one history from the worn state, and one of a body whose surface was made
/// so. With the contact nothing would carry the scar along, and that is refused; a state without one goes on there.
#[test]
fn a_contact_that_starts_worn_rolls_over_its_scar() {
    let case = |frame: &str, profile: &str, loads: &str| {
        format!(
            "[grid]\ncells = [40, 32]\nsize = [4.0, 3.2]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n\
             [profile.sphere]\nradius = 100.0\n{profile}[friction]\ncoefficient = 0.3\n{frame}[solver]\nintegration = \"end_point\"\ntolerance = 1e-9\n\
             [output]\nevery = 1\nfields = [\"pressure\", \"shear\", \"worn_depth\"]\n{loads}"
        )
    };
    // By end points: what came before in the one history tells nothing of the paths of slip in the other.
    let press = "[[load]]\nnormal_force = 1.2e-2\nincrements = 2\n";
    let wear = "[wear]\ncoefficient = 0.5\nevery = 10\nlargest_step = 0.1\n";
    let rub = format!("{wear}{press}[[load]]\nshift = [0.05, 0.0]\ncycles = 10\nincrements = 8\n");
    let rolls = |roll: f64, increments: usize| {
        format!(
            "[[load]]\nnormal_force = 0.0\nshift = [0.0, 0.0]\nincrements = 1\n{press}[[load]]\nroll = [{roll:?}, 0.0]\nincrements = {increments}\n"
        )
    };
    let from = |start: &History, text: &str| {
        let start = Arc::new(Start::of(start, start.steps.last().unwrap().increment).unwrap());
        let attachments = Attachments { start: Some(start.solved.loads), ..Attachments::none() };
        let case = Case::from_toml_with(text, "case.toml", attachments).unwrap();
        let plan =
            Plan::starting_from(Some(start), case, LeaveOut::ALL).map_err(|error| error.to_string())?;
        Simulation::new(&plan).run(&mut Silent).map_err(|error| error.to_string())
    };
    let worn = solved(&case("", "", &rub));
    let depth = worn.fields.last().unwrap().worn_depth.clone().unwrap();
    let largest = |field: &Array2<f64>| field.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    assert!(largest(&depth) > 0.1 * worn.steps[1].approach);
    let rolled = from(&worn, &case("", "", &rolls(0.65, 6))).unwrap();
    let made = "[profile.heights]\nof = \"gap\"\nvalues = { array = 0 }\n";
    let made = solved_with(&case("", made, &rolls(0.65, 6)), &[depth]);
    for step in 1..9 {
        let [one, other] = [&rolled, &made].map(|history| history.fields_of(step).unwrap());
        let [p, r] = [one, other].map(|fields| fields.pressure.as_ref().unwrap());
        let off = largest(&(p - r)) / largest(r);
        let [q, s] = [one, other].map(|fields| &fields.shear.as_ref().unwrap()[0]);
        let sheared = largest(&(q - s)) / largest(r);
        // residuals of 1e-9 of each, in regions of their own
        assert!(off < 1e-6 && sheared < 1e-6, "{step}: {off:e} {sheared:e}");
    }
    let last = made.fields_of(8).unwrap().pressure.as_ref().unwrap();
    let fresh = solved(&case("", "", &rolls(0.65, 6)));
    let unworn = fresh.fields_of(8).unwrap().pressure.as_ref().unwrap();
    assert!(largest(&(last - unworn)) > 0.02 * largest(unworn), "the scar is felt");
    let contact = "[kinematics]\nframe = \"contact\"\n";
    let refused = from(&worn, &case(contact, "", &rolls(0.6, 6))).unwrap_err();
    assert!(
        refused.contains("kinematics.frame = \"contact\"") && refused.contains("worn or yielded"),
        "{refused}"
    );
    let pressed = solved(&case("", "", press));
    let onward = from(&pressed, &case(contact, "", &rolls(0.6, 6))).unwrap();
    let whole = solved(&case(contact, "", &rolls(0.6, 6)));
    let [one, other] = [&onward, &whole].map(|history| history.steps.last().unwrap().approach);
    assert!((one / other - 1.0).abs() < 1e-8, "{one} {other}");
}

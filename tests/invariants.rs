//! What must not change: units, mirrors, axes, threads.

use fret_core::history::{History, StepRecord};
use fret_core::plan::{LeaveOut, Simplification};
use fret_validation::shortcuts;
use fret_validation::{Sphere, keeping, solved};

fn coupled_scene(length: f64, modulus: f64) -> History {
    solved(&coupled_text(length, modulus))
}

fn coupled_text(length: f64, modulus: f64) -> String {
    let sphere = Sphere {
        cells: 32,
        tolerance: 1e-10,
        coating: Some((2.0, 0.5)),
        friction: 0.2,
        length,
        modulus,
        ..Sphere::default()
    };
    let text = sphere.pulled(&sphere.pressed(1.0, 4, "cubic"), 0.6, 3, None);
    text + &keeping(1)
}

#[test]
fn results_scale_with_lengths_and_moduli() {
    let one = coupled_scene(1.0, 1.0);
    for (length, modulus) in [(1e-6, 1.0), (1.0, 1e9), (1e-3, 210e9), (1e12, 1e-12)] {
        let other = coupled_scene(length, modulus);
        let worst = one
            .steps
            .iter()
            .zip(&other.steps)
            .flat_map(|(a, b)| relative(a, b, length, modulus))
            .fold(0.0, f64::max);
        // Rounding differs, and may make the iterations differ; both are solved to 1e-10.
        assert!(worst < 1e-9, "lengths x {length:e}, moduli x {modulus:e}: {worst:e}");
    }
}

fn relative(a: &StepRecord, b: &StepRecord, length: f64, modulus: f64) -> [f64; 4] {
    let scale = |x: f64, y: f64, unit: f64| if x == 0.0 { 0.0 } else { (y / unit / x - 1.0).abs() };
    [
        scale(a.max_pressure, b.max_pressure, modulus),
        scale(a.approach, b.approach, length),
        scale(a.contact_area, b.contact_area, length * length),
        scale(a.dissipated_energy, b.dissipated_energy, modulus * length.powi(3)),
    ]
}

#[test]
fn mirrors_of_the_scene_are_mirrors_of_the_fields() {
    // Six digits on frozen zones are rounded differently on either side: what the laws leave open must lie below the bound.
    let text = coupled_text(1.0, 1.0).replace("1e-10", "1e-11");
    let history = shortcuts::solved(&text, LeaveOut::all_but(Simplification::Mirror)).history;
    let kept = history.fields.last().unwrap();
    let [nx, ny] = history.grid.cells();
    let pressure = kept.pressure.as_ref().unwrap();
    let [qx, qy] = kept.shear.as_ref().unwrap();
    let peak = pressure.iter().copied().fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for i in 0..nx {
        for j in 0..ny {
            let mirrored = [i, ny - 1 - j];
            worst = worst.max((pressure[[i, j]] - pressure[mirrored]).abs());
            worst = worst.max((qx[[i, j]] - qx[mirrored]).abs());
            worst = worst.max((qy[[i, j]] + qy[mirrored]).abs());
        }
    }
    assert!(worst < 1e-10 * peak, "{:e}", worst / peak);
}

#[test]
fn pulling_along_y_is_pulling_along_x_turned() {
    let sphere = Sphere {
        cells: 32,
        size: 2.9,
        coating: Some((0.5, 0.5)),
        friction: 0.2,
        tolerance: 1e-11,
        ..Sphere::default()
    };
    let along = |direction: [f64; 2]| {
        let force = 0.5 * 0.2 * sphere.force();
        let text = format!(
            "{}[[load]]\ntangential_force = [{:e}, {:e}]\nincrements = 2\n{}",
            sphere.pressed(1.0, 3, "cubic"),
            force * direction[0],
            force * direction[1],
            keeping(1)
        );
        solved(&text)
    };
    let (x, y) = (along([1.0, 0.0]), along([0.0, 1.0]));
    let fields = |history: &History| history.fields.last().unwrap().clone();
    let (a, b) = (fields(&x), fields(&y));
    let peak = x.steps.last().unwrap().max_pressure;
    let [ax, _] = a.shear.as_ref().unwrap();
    let [_, by] = b.shear.as_ref().unwrap();
    let worst = ax.indexed_iter().map(|((i, j), q)| (q - by[[j, i]]).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-10 * peak, "{:e}", worst / peak);
}

#[test]
fn one_and_two_threads_give_the_same_bits() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let sphere = Sphere {
                cells: 128,
                size: 2.1,
                coating: Some((2.0, 0.5)),
                friction: 0.2,
                ..Sphere::default()
            };
            let text = sphere.pulled(&sphere.pressed(1.0, 1, "cubic"), 0.6, 1, None);
            solved(&(text + &keeping(1)))
        })
    };
    let (one, two) = (run(1), run(2));
    assert_eq!(one.state, two.state);
    for (a, b) in one.steps.iter().zip(&two.steps) {
        assert_eq!(a.max_pressure.to_bits(), b.max_pressure.to_bits());
        assert_eq!(a.work, b.work);
    }
}

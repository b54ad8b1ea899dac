//! Runs of every kind hold their laws as the certifier computes them; and what is not right does not pass it.

use fret_validation::Sphere;
use fret_validation::certifier::{Ended, run_certified};

fn ended(text: &str) -> Ended {
    let ended = run_certified(text, &[]).unwrap_or_else(|error| panic!("{error}"));
    assert!(ended.error.is_none(), "{:?}", ended.error);
    ended
}

#[test]
fn a_coated_sphere_pressed_and_pulled_is_certified() {
    let sphere = Sphere { cells: 32, friction: 0.3, coating: Some((4.0, 0.5)), ..Sphere::default() };
    let ended = ended(&sphere.pulled(&sphere.pressed(1.0, 3, "cubic"), 0.7, 4, None));
    for certificate in &ended.certificates {
        println!("{certificate:?}");
    }
    assert_eq!(ended.wrong(), None);
}

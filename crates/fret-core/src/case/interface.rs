//! The judgement of interfaces below coatings, and of what a coating that slides freely cannot bear.

use super::body_file::{CoatingFile, InterfaceFile, InterfaceWord};
use super::judge::Judge;
use super::known::Known;
use crate::model::{Interface, InterfaceError, Layer};

/// Stiffness of a spring over that of the coating, modulus over thickness, at the least: below it nothing is held, and digits are lost.
const WEAKEST: f64 = 1e-9;

/// The interface below a coating whose other keys made this layer; `None` when it was refused.
pub(super) fn interface(
    judge: &mut Judge,
    place: &str,
    given: &CoatingFile,
    layer: Option<&Layer>,
) -> Option<Interface> {
    let Some(interface) = &given.interface else { return Some(Interface::BONDED) };
    let springs = match &interface.value {
        InterfaceFile::Word(InterfaceWord::Bonded) => return Some(Interface::BONDED),
        InterfaceFile::Word(InterfaceWord::Frictionless) => return Some(Interface::FRICTIONLESS),
        InterfaceFile::Springs(springs) => springs,
    };
    let [normal, shear] = [springs.normal_stiffness, springs.shear_stiffness];
    if normal.or(shear).is_none() {
        return judge.refuse(
            interface.span(),
            format!("{place}.interface: empty"),
            "normal_stiffness = ..., shear_stiffness = ..., or both; \"bonded\" is the default",
        );
    }
    let mut refuse = |key: &str, message: String, help: &str| {
        let key = format!("{place}.interface.{key}");
        let span = judge.places.of(&key).unwrap_or(interface.span());
        judge.refuse(span, key + &message, help)
    };
    let found = match Interface::springs(normal, shear) {
        Ok(found) => found,
        Err(error @ InterfaceError::Normal(_)) => {
            return refuse("normal_stiffness", format!(": {error}"), "");
        }
        Err(error @ InterfaceError::Shear(_)) => return refuse("shear_stiffness", format!(": {error}"), ""),
    };
    let least = WEAKEST * layer.map_or(0.0, Layer::stiffness);
    for (key, spring) in [("normal_stiffness", normal), ("shear_stiffness", shear)] {
        if let Some(spring) = spring.filter(|spring| (f64::MIN_POSITIVE..least).contains(spring)) {
            let message = format!(
                " = {spring:?}: less than {WEAKEST:e} of the coating's own stiffness, modulus over thickness, holds nothing"
            );
            return refuse(key, message, &format!("at least {least:.3e}; or \"frictionless\""));
        }
    }
    Some(found)
}

/// Refuses what has no equilibrium where a coating slides freely: shear on its surface, and a substrate that is stretched below it.
pub(super) fn sliding_coatings(judge: &mut Judge, known: &Known<'_>) {
    let frictionless = known.is_frictionless() || known.laws.is_none();
    for (body, (which, file)) in known.written().into_iter().enumerate() {
        let coatings = file.coatings.as_ref().map_or(&[][..], |list| &list.value);
        let slides = |interface: &InterfaceFile| match interface {
            InterfaceFile::Word(word) => *word == InterfaceWord::Frictionless,
            InterfaceFile::Springs(springs) => springs.shear_stiffness == Some(0.0),
        };
        let free = coatings.iter().enumerate().find_map(|(index, coating)| {
            let interface = coating.value.interface.as_ref()?;
            slides(&interface.value)
                .then(|| (format!("{which}.coatings[{index}].interface"), interface.span()))
        });
        let Some((place, span)) = free else { continue };
        let stretched = known.stages.is_some_and(|stages| {
            stages.iter().any(|stage| stage.bulk_stress[body].iter().any(Option::is_some))
        });
        judge.refuse_given([
            (
                (!frictionless).then(|| span.clone()),
                format!(
                    "{place}: no shear passes, so nothing holds the coating against friction on its surface"
                ),
                "friction.coefficient = 0.0, or interface = { shear_stiffness = ... }",
            ),
            (
                stretched.then_some(span),
                format!("{place}: no shear passes, so the coating is not stretched with its substrate"),
                "no bulk stress of this body, or interface = { shear_stiffness = ... }",
            ),
        ]);
    }
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use crate::model::{Body, Interface};

    fn text(interface: &str, more: &str) -> String {
        format!(
            "grid = {{ cells = [8, 8], size = [1.0, 1.0] }}\nupper = {{ rigid = true }}\nprofile.sphere.radius = 10.0\n\
             [lower]\ncoatings = [{{ thickness = 0.5, young = 2.0, poisson = 0.3, interface = {interface} }}]\n\
             substrate = {{ young = 1.0, poisson = 0.3 }}\n{more}[[load]]\nnormal_force = 0.01\nincrements = 1\n"
        )
    }

    fn read(interface: &str) -> Interface {
        let case = Case::from_toml(&text(interface, ""), "case.toml").unwrap();
        match case.bodies.lower() {
            Body::Elastic(half_space) => *half_space.coatings()[0].interface(),
            Body::Rigid => unreachable!("the lower body is elastic"),
        }
    }

    /// The one mistake, and the text it stands at.
    fn refused(text: &str) -> (String, String) {
        let error = Case::from_toml(text, "case.toml").unwrap_err();
        assert_eq!(error.mistakes().len(), 1, "{error}");
        let mistake = &error.mistakes()[0];
        (mistake.message.clone(), text[mistake.span.clone().unwrap()].to_owned())
    }

    #[test]
    fn words_and_springs_are_read() {
        assert_eq!(read("\"bonded\""), Interface::BONDED);
        assert_eq!(read("\"frictionless\""), Interface::FRICTIONLESS);
        let both = read("{ normal_stiffness = 3.0, shear_stiffness = 2 }");
        assert_eq!(both, Interface::springs(Some(3.0), Some(2.0)).unwrap());
        assert_eq!(read("{ shear_stiffness = 2.0 }"), Interface::springs(None, Some(2.0)).unwrap());
        assert_eq!(read("{ normal_stiffness = 2.0 }"), Interface::springs(Some(2.0), None).unwrap());
    }

    #[test]
    fn the_interface_of_a_graded_coating_is_that_of_its_lowest_sublayer() {
        let graded = text("\"bonded\"", "").replace(
            "young = 2.0, poisson = 0.3, interface = \"bonded\"",
            "poisson = 0.3, gradient = { young = [2.0, 1.0], law = \"linear\", layers = 5 }, interface = { shear_stiffness = 2.0 }",
        );
        let case = Case::from_toml(&graded, "case.toml").unwrap();
        let Body::Elastic(half_space) = case.bodies.lower() else {
            unreachable!("the lower body is elastic")
        };
        let bonded: Vec<bool> = half_space.coatings().iter().map(|one| one.interface().is_bonded()).collect();
        assert_eq!(bonded, [true, true, true, true, false]);
    }

    #[test]
    fn what_holds_nothing_is_refused_where_it_stands() {
        for (interface, message, place) in [
            ("\"glued\"", "found the text \"glued\", expected \"bonded\", \"frictionless\"", "\"glued\""),
            ("3.0", "found 3.0, expected \"bonded\"", "3.0"),
            ("{ stiffness = 1.0 }", "unknown key `stiffness`", "stiffness"),
            ("{}", "interface: empty", "{}"),
            ("{ normal_stiffness = 0.0 }", "nothing carries the layer", "0.0"),
            ("{ normal_stiffness = -1.0, shear_stiffness = 1.0 }", "normal stiffness -1.0", "-1.0"),
            ("{ shear_stiffness = nan }", "shear stiffness NaN", "nan"),
            ("{ shear_stiffness = 1e-12 }", "holds nothing", "1e-12"),
            ("{ normal_stiffness = 1e-12 }", "holds nothing", "1e-12"),
        ] {
            let (found, stands) = refused(&text(interface, ""));
            assert!(found.contains(message), "{interface}: {found}");
            assert_eq!(stands, place, "{interface}: {found}");
        }
    }

    #[test]
    fn a_coating_that_slides_freely_bears_neither_friction_nor_a_stretched_substrate() {
        for interface in ["\"frictionless\"", "{ normal_stiffness = 1.0, shear_stiffness = 0.0 }"] {
            let (found, stands) = refused(&text(interface, "[friction]\ncoefficient = 0.1\n"));
            assert!(found.contains("nothing holds the coating against friction"), "{found}");
            assert_eq!(stands, interface);
            let stretched = text(interface, "") + "bulk_stress = [1e-3, 0.0]\n";
            let (found, stands) = refused(&stretched);
            assert!(found.contains("not stretched with its substrate"), "{found}");
            assert_eq!(stands, interface);
        }
        assert!(
            Case::from_toml(
                &text("{ shear_stiffness = 0.1 }", "[friction]\ncoefficient = 0.1\n"),
                "case.toml"
            )
            .is_ok()
        );
    }

    /// A coating of modulus 2 and thickness 1/2 has a stiffness of 4, of which a spring has a billionth at the least.
    #[test]
    fn springs_are_weighed_against_the_layer_above_them() {
        let bound = super::WEAKEST * 4.0;
        read(&format!("{{ shear_stiffness = {:e} }}", 1.01 * bound));
        let (found, _) = refused(&text(&format!("{{ shear_stiffness = {:e} }}", 0.99 * bound), ""));
        assert!(found.contains("holds nothing"), "{found}");
    }
}

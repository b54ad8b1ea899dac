//! The judgement of one entry of a list of coatings.

use super::body_file::{CoatingFile, GradientFile, LawFile};
use super::interface::interface;
use super::judge::Judge;
use crate::document::At;
use crate::model::{
    Coating, ElasticMaterial, GradedCoating, GradientError, Layer, MaterialError, YoungGradient,
};

/// The layer of an entry; `None` when something about it was refused.
pub(super) fn layer(judge: &mut Judge, place: &str, entry: &At<CoatingFile>) -> Option<Layer> {
    let given = &entry.value;
    let thickness = given.thickness.value;
    let has_thickness = Coating::can_be(thickness);
    let layer = match (&given.young, &given.gradient) {
        (Some(young), None) => {
            let material = material(judge, place, young, &given.poisson);
            material.and_then(|material| Coating::new(material, thickness).ok()).map(Layer::Uniform)
        }
        (None, Some(gradient)) => graded(judge, place, given, &gradient.value, has_thickness),
        (Some(_), Some(gradient)) => judge.both(gradient.span(), &format!("{place}: young and gradient")),
        (None, None) => judge.refuse(
            entry.span(),
            format!("{place}: nothing says how stiff it is"),
            "young = ..., or gradient = { young = [top, bottom], law = \"exponential\" }",
        ),
    };
    if !has_thickness {
        let message = format!("{place}.thickness: {}", MaterialError::Thickness(thickness));
        return judge.refuse(given.thickness.span(), message, "");
    }
    let interface = interface(judge, place, given, layer.as_ref())?;
    layer.map(|layer| layer.on(interface))
}

/// The material of a modulus and a ratio; `None` when one of them was refused.
pub(super) fn material(
    judge: &mut Judge,
    place: &str,
    young: &At<f64>,
    poisson: &At<f64>,
) -> Option<ElasticMaterial> {
    if let Err(error) = ElasticMaterial::new(young.value, 0.0) {
        judge.refuse::<()>(young.span(), format!("{place}.young: {error}"), "");
    }
    is_ratio(judge, place, poisson);
    ElasticMaterial::new(young.value, poisson.value).ok()
}

/// Whether a number is Poisson's ratio of any material; refused where it is not.
fn is_ratio(judge: &mut Judge, place: &str, poisson: &At<f64>) -> bool {
    let Err(error) = ElasticMaterial::new(1.0, poisson.value) else { return true };
    judge.refuse::<()>(poisson.span(), format!("{place}.poisson: {error}"), "");
    false
}

fn graded(
    judge: &mut Judge,
    place: &str,
    given: &CoatingFile,
    gradient: &GradientFile,
    has_thickness: bool,
) -> Option<Layer> {
    let has_poisson = is_ratio(judge, place, &given.poisson);
    let sublayers = gradient.layers.as_ref().map(|count| count.value);
    let young = young(judge, place, given, gradient);
    if !has_poisson || !has_thickness {
        return None;
    }
    let young = young?;
    match GradedCoating::new(young, given.poisson.value, given.thickness.value) {
        Ok(coating) => Some(Layer::Graded { coating, sublayers }),
        Err(error) => {
            let key = if gradient.table.is_some() { "table" } else { "young" };
            let span = gradient.table.as_ref().map(At::span);
            let span = span.or(gradient.young.as_ref().map(At::span)).unwrap_or(given.thickness.span());
            let help = match error {
                GradientError::Order { .. } => "a jump of stiffness is an interface: two coatings",
                GradientError::Rows(_) | GradientError::FirstDepth(_) | GradientError::LastDepth { .. } => {
                    "depths rise from 0 to the coating's thickness"
                }
                GradientError::Material(_) => "",
            };
            judge.refuse(span, format!("{place}.gradient.{key}: {error}"), help)
        }
    }
}

/// The modulus over the depth, as it is written; its numbers are judged later.
fn young(
    judge: &mut Judge,
    place: &str,
    given: &CoatingFile,
    gradient: &GradientFile,
) -> Option<YoungGradient> {
    const TWO_WAYS: &str = "gradient = { young = [top, bottom], law = \"exponential\" or \"linear\" }, or gradient = { table = [[depth, young], ...] }";
    match (&gradient.young, &gradient.law, &gradient.table) {
        (Some(young), Some(law), None) => {
            let [top, bottom] = young.value;
            Some(match &law.value {
                LawFile::Exponential => YoungGradient::Exponential { top, bottom },
                LawFile::Linear => YoungGradient::Linear { top, bottom },
            })
        }
        (None, None, Some(table)) => Some(YoungGradient::Table(table.value.clone())),
        (Some(young), None, None) => judge.refuse(
            young.span(),
            format!("{place}.gradient: young at both faces, but no law between them"),
            "law = \"exponential\" or law = \"linear\"",
        ),
        (None, Some(law), None) => judge.refuse(
            law.span(),
            format!("{place}.gradient: a law, but no young at both faces"),
            "young = [top, bottom]",
        ),
        (_, _, Some(table)) => {
            judge.both(table.span(), &format!("{place}.gradient: a table and a law of depth"))
        }
        (None, None, None) => judge.refuse(
            given.gradient.as_ref().map_or(given.thickness.span(), At::span),
            format!("{place}.gradient: nothing says how the modulus changes with depth"),
            TWO_WAYS,
        ),
    }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, CaseError};
    use crate::model::{Body, HalfSpace};

    fn read(coatings: &str) -> Result<HalfSpace, CaseError> {
        let text = format!(
            "grid = {{ cells = [8, 8], size = [1.0, 1.0] }}\nupper = {{ rigid = true }}\nprofile.sphere.radius = 10.0\n\
             [lower]\ncoatings = [{coatings}]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [[load]]\nnormal_force = 0.01\nincrements = 1\n"
        );
        Case::from_toml(&text, "case.toml").map(|case| match case.bodies.lower() {
            Body::Elastic(half_space) => half_space.clone(),
            Body::Rigid => unreachable!("the lower body is elastic"),
        })
    }

    /// The one mistake of a coating, its message and the text it stands at.
    fn refused(coating: &str) -> (String, String) {
        let error = read(coating).unwrap_err();
        assert_eq!(error.mistakes().len(), 1, "{error}");
        let mistake = &error.mistakes()[0];
        let (_, column) = error.place(mistake).unwrap();
        let span = mistake.span.clone().unwrap();
        let start = column - 1 - "coatings = [".len();
        (mistake.message.clone(), coating[start..start + span.len()].to_owned())
    }

    #[test]
    fn gradients_become_sublayers() {
        let law = "{ thickness = 0.5, poisson = 0.3, gradient = { young = [4.0, 1.0], law = \"linear\", layers = 40 } }";
        let body = read(law).unwrap();
        assert_eq!(body.coatings().len(), 40);
        assert!((body.coating_thickness() - 0.5).abs() < 1e-15);
        let bound =
            "{ thickness = 0.5, poisson = 0.3, gradient = { young = [4.0, 1.0], law = \"exponential\" } }";
        assert!((20..200).contains(&read(bound).unwrap().coatings().len()));
        let table =
            "{ thickness = 0.5, poisson = 0.3, gradient = { table = [[0.0, 4.0], [0.2, 1.0], [0.5, 2.0]] } }";
        assert!((20..200).contains(&read(table).unwrap().coatings().len()));
        let uniform = "{ thickness = 0.5, poisson = 0.3, young = 4.0 }";
        let constant =
            "{ thickness = 0.5, poisson = 0.3, gradient = { young = [4.0, 4.0], law = \"linear\" } }";
        assert_eq!(read(uniform).unwrap(), read(constant).unwrap());
    }

    #[test]
    fn wrong_gradients_are_refused_where_they_stand() {
        let with = |rest: &str| refused(&format!("{{ thickness = 0.5, poisson = 0.3, {rest} }}"));
        let linear = "gradient = { young = [4.0, 1.0], law = \"linear\" }";
        for (rest, message, place) in [
            (&*format!("young = 1.0, {linear}"), "both at once", &linear["gradient = ".len()..]),
            ("gradient = { young = [4.0, 1.0] }", "no law", "[4.0, 1.0]"),
            ("gradient = { law = \"linear\" }", "no young", "\"linear\""),
            ("gradient = { layers = 4 }", "nothing says how the modulus", "{ layers = 4 }"),
            (
                "gradient = { law = \"linear\", table = [[0.0, 1.0], [0.5, 2.0]] }",
                "both at once",
                "[[0.0, 1.0], [0.5, 2.0]]",
            ),
            ("gradient = { young = [4.0, -1.0], law = \"linear\" }", "-1.0", "[4.0, -1.0]"),
            ("gradient = { young = [4.0, 1.0], law = \"linear\", layers = 0 }", "layers = 0", "0"),
            ("gradient = { young = [4.0, 1.0], law = \"linear\", layers = 5000 }", "layers = 5000", "5000"),
            ("gradient = { table = [[0.0, 1.0]] }", "1 rows", "[[0.0, 1.0]]"),
            ("gradient = { table = [[0.0, 1.0], [0.4, 2.0]] }", "last depth 0.4", "[[0.0, 1.0], [0.4, 2.0]]"),
            (
                "gradient = { table = [[0.1, 1.0], [0.5, 2.0]] }",
                "first depth 0.1",
                "[[0.1, 1.0], [0.5, 2.0]]",
            ),
            (
                "gradient = { table = [[0.0, 1.0], [0.0, 3.0], [0.5, 2.0]] }",
                "row 1",
                "[[0.0, 1.0], [0.0, 3.0], [0.5, 2.0]]",
            ),
            ("gradient = { young = [4.0, 1.0], law = \"cubic\" }", "unknown name `cubic`", "\"cubic\""),
            ("gradient = { young = [4.0, 1.0], law = \"linaer\" }", "unknown name `linaer`", "\"linaer\""),
        ] {
            let (found, stands) = with(rest);
            assert!(found.contains(message), "{rest}: {found}");
            assert_eq!(stands, place, "{rest}: {found}");
        }
        let bare = "{ thickness = 0.5, poisson = 0.3 }";
        assert_eq!(
            refused(bare),
            ("lower.coatings[0]: nothing says how stiff it is".to_owned(), bare.to_owned())
        );
        let poisson =
            "{ thickness = 0.5, poisson = 0.7, gradient = { young = [4.0, 1.0], law = \"linear\" } }";
        assert_eq!(refused(poisson).1, "0.7");
        let thickness =
            "{ thickness = -0.5, poisson = 0.3, gradient = { young = [4.0, 1.0], law = \"linear\" } }";
        assert_eq!(refused(thickness).1, "-0.5");
        let steep =
            "{ thickness = 0.5, poisson = 0.3, gradient = { young = [1e-13, 1.0], law = \"linear\" } }";
        let error = read(steep).unwrap_err();
        assert!(error.mistakes().len() == 1 && error.to_string().contains("4096 sublayers"), "{error}");
    }
}

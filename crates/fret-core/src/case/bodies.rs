//! The judgement of the two bodies.

use toml::Spanned;

use super::body_file::BodyFile;
use super::coating::{self, material};
use super::judge::Judge;
use crate::kernel::sublayers::{RESPONSE_BOUND, SublayerError, layered_half_space};
use crate::model::{Base, Body, ContactPair, Layer};

/// The pair; `None` when something about it was refused.
pub(super) fn bodies(
    judge: &mut Judge,
    upper: &Spanned<BodyFile>,
    lower: &Spanned<BodyFile>,
) -> Option<ContactPair> {
    let (first, second) = (body(judge, "upper", upper), body(judge, "lower", lower));
    match ContactPair::new(first?, second?) {
        Ok(pair) => Some(pair),
        Err(error) => judge.refuse(lower.span(), error.to_string(), ""),
    }
}

fn body(judge: &mut Judge, which: &str, given: &Spanned<BodyFile>) -> Option<Body> {
    let body = given.get_ref();
    if body.rigid.as_ref().is_some_and(|rigid| *rigid.get_ref()) {
        let extra = [
            body.coatings.as_ref().map(Spanned::span),
            body.substrate.as_ref().map(Spanned::span),
            body.base.as_ref().map(Spanned::span),
        ];
        return match extra.into_iter().flatten().next() {
            Some(span) => judge.refuse(
                span,
                format!("{which}: rigid = true and an elastic part, both at once"),
                "leave out one of the two",
            ),
            None => Some(Body::Rigid),
        };
    }
    let base = match (&body.substrate, &body.base) {
        (Some(substrate), None) => {
            let place = format!("{which}.substrate");
            material(judge, &place, &substrate.get_ref().young, &substrate.get_ref().poisson)
                .map(Base::Elastic)
        }
        (None, Some(_)) => Some(Base::Rigid),
        (Some(_), Some(base)) => judge.refuse(
            base.span(),
            format!("{which}: a substrate and base = \"rigid\", both at once"),
            "leave out one of the two",
        ),
        (None, None) => judge.refuse(
            given.span(),
            format!("{which}: nothing says what it is made of"),
            "rigid = true, or substrate = { young = ..., poisson = ... }, or base = \"rigid\" under coatings",
        ),
    };
    let layers: Option<Vec<Layer>> = match &body.coatings {
        None => Some(Vec::new()),
        Some(list) => {
            let checked: Vec<Option<Layer>> = list
                .get_ref()
                .iter()
                .enumerate()
                .map(|(index, entry)| coating::layer(judge, &format!("{which}.coatings[{index}]"), entry))
                .collect();
            checked.into_iter().collect()
        }
    };
    match layered_half_space(&layers?, base?, RESPONSE_BOUND) {
        Ok(half_space) => Some(Body::Elastic(half_space)),
        Err(error @ SublayerError::TooSteep { .. }) => {
            let span = body.coatings.as_ref().map_or(given.span(), Spanned::span);
            judge.refuse(
                span,
                format!("{which}.coatings: {error}"),
                "a modulus that changes less, or gradient.layers = ... to be content with so many",
            )
        }
        Err(SublayerError::Material(error)) => judge.refuse(given.span(), format!("{which}: {error}"), ""),
    }
}

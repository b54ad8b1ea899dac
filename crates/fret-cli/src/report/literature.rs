//! What to cite: the works whose methods and formulas stand behind this very page.

use fret_core::model::{Body, Control, Dimension};
use fret_core::study::{PartialSlip, Pressed};
use maud::{Markup, html};

use super::{Measured, Overview};
use crate::run::paragraph;

const LAYERS: &str = "T. C. O'Sullivan, R. B. King: Sliding contact stress field due to a spherical indenter on a layered \
                      elastic half-space. J. Tribol. 110 (1988) 235–240.";
const COATED: &str = "S. Spinu: Numerical analysis of elastic contact between coated bodies. Advances in Tribology (2018). \
                      doi 10.1155/2018/6498503.";
const LOVE: &str = "A. E. H. Love: The stress produced in a semi-infinite solid by pressure on part of the boundary. Phil. \
                    Trans. R. Soc. A 228 (1929) 377–420.";
const GRADIENTS: &str = "I. A. Polonsky, L. M. Keer: A numerical method for solving rough contact problems based on the \
                         multi-level multi-summation and conjugate gradient techniques. Wear 231 (1999) 206–219.";
const CONVOLUTION: &str = "S. Liu, Q. Wang, G. Liu: A versatile method of discrete convolution and FFT (DC-FFT) for contact \
                           analyses. Wear 243 (2000) 101–111.";
const FRETTING: &str = "L. Gallego, D. Nélias, S. Deyber: A fast and efficient contact algorithm for fretting problems \
                        applied to fretting modes I, II and III. Wear 268 (2010) 208–222.";
const HERTZ: &str =
    "H. Hertz: Ueber die Berührung fester elastischer Körper. J. reine angew. Math. 92 (1881) 156–171.";
const CATTANEO: &str =
    "C. Cattaneo: Sul contatto di due corpi elastici. Rend. Accad. Naz. Lincei 27 (1938) 342, 434, 474.";
const MINDLIN: &str =
    "R. D. Mindlin: Compliance of elastic bodies in contact. J. Appl. Mech. 16 (1949) 259–268.";
const DERESIEWICZ: &str = "R. D. Mindlin, H. Deresiewicz: Elastic spheres in contact under varying oblique forces. J. Appl. \
                           Mech. 20 (1953) 327–344.";
const NOWELL: &str =
    "D. Nowell, D. A. Hills: Mechanics of fretting fatigue tests. Int. J. Mech. Sci. 29 (1987) 355–365.";
const SNEDDON: &str = "I. N. Sneddon: The relation between load and penetration in the axisymmetric Boussinesq problem for a punch of \
                       arbitrary profile. Int. J. Engng Sci. 3 (1965) 47–57.";
const JOHNSON: &str = "K. L. Johnson: Contact Mechanics. Cambridge University Press (1985).";

/// The chapter.
pub fn chapter(view: &Overview<'_>) -> Markup {
    let case = view.results.case();
    let coated = [case.bodies.upper(), case.bodies.lower()]
        .iter()
        .any(|body| matches!(body, Body::Elastic(half_space) if !half_space.coatings().is_empty()));
    let periodic = case.periodic.is_both();
    let pressed = view.normal_form.and_then(|form| form.under(Control::Force(1.0)));
    let partial_slip = view.tangential_form.is_some();
    let is_point = view.dimension() == Dimension::Plane;
    let is_stretched = view
        .tangential_form
        .as_ref()
        .is_some_and(|form| form.any(|slip| matches!(slip, PartialSlip::Stretched { .. })));
    let works = [
        (coated, COATED),
        (coated, LAYERS),
        (!coated && !periodic, LOVE),
        (!periodic, CONVOLUTION),
        (true, GRADIENTS),
        (view.direction.is_some(), FRETTING),
        (matches!(pressed, Some(Pressed::Sphere(_) | Pressed::Ellipsoid(_) | Pressed::Line(..))), HERTZ),
        (matches!(pressed, Some(Pressed::Rounded(_) | Pressed::Flat(_) | Pressed::Cone(_))), SNEDDON),
        (partial_slip, CATTANEO),
        (partial_slip, MINDLIN),
        (is_stretched, NOWELL),
        (partial_slip && is_point && !view.cycles().is_empty(), DERESIEWICZ),
        (pressed.is_some(), JOHNSON),
    ];
    let record = &view.results.record;
    let version = &record.version;
    let solved = record.end.as_ref().filter(|_| record.status == "solved").map(|end| end.totals.increments);
    let methods = solved.map(|solved| paragraph(view.results.plan(), solved, (version, &record.commit)));
    html! {
        @if let Some(methods) = methods {
            section {
                h2 { "For the methods section" }
                p { (methods) }
            }
        }
        section {
            h2 { "To cite" }
            p { "The program, fretting " (version) ", with its file " code { "CITATION.cff" } "; and the works that this page builds on:" }
            ul class="works" { @for (is_used, work) in works { @if is_used { li { (work) } } } }
        }
    }
}

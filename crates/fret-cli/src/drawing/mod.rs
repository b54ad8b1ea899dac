//! Pictures as SVG: line charts and false-colour maps. A picture stands in a page, whose style sheet colours it, or alone, with the
//! same style sheet inside.
//!
//! From the ground: `drawn` (a picture, not yet put anywhere), `scale` (axes), `raster` (images of fields), `frame` (the area between two axes), `chart` and `map`.

mod chart;
mod drawn;
mod frame;
mod map;
mod raster;
mod scale;
mod section;

pub use chart::{Chart, Curve, Stroke, joined};
pub use drawn::{Drawing, STYLE, figure_of};
pub use frame::{Frame, room_for};
pub use map::{Map, SURFACE};
pub use raster::{Raster, pixels_for};
pub use scale::{Axis, Label, ends, superscript};
pub use section::Section;

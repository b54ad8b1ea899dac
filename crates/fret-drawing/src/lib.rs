//! Pictures as SVG: line charts and false-colour maps. A picture stands in a page, whose style sheet colours it, or alone, with the
//! same style sheet inside.
//!
//! From the ground: `drawn` (a picture, not yet put anywhere), `scale` (axes), `raster` (images of fields), `frame` (the area between two axes), `chart` and `map`.
//!
//! ```
//! use fretting_drawing::{Chart, Curve, Label};
//!
//! let curve = Curve::line(vec![[0.0, 0.0], [1.0, 2.0]], "computed", 0);
//! let chart = Chart::new("force over shift", [Label::plain("shift"), Label::plain("force")], vec![curve]);
//! assert!(chart.drawing().alone(&["A loop"]).starts_with("<svg"));
//! ```

mod chart;
mod drawn;
mod frame;
mod map;
mod raster;
mod scale;

pub use chart::{Chart, Curve, Stroke};
pub use drawn::Drawing;
pub use frame::Frame;
pub use map::Map;
pub use png::EncodingError;
pub use raster::Raster;
pub use scale::{Axis, Label};

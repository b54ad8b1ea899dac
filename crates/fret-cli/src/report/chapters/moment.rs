//! What is shown of one kept increment: values along a section, and images of maps; and what all of them share.

use ndarray::{Array2, Zip};

use crate::failure::Failure;
use crate::figures::largest;
use crate::report::chapters::sections::shear_direction;
use crate::report::chapters::surfaces;
use crate::report::{Overview, Section, Window};

/// What is shown of one increment.
pub struct Moment {
    pub increment: usize,
    /// Along the section: pressure, shear, and the bound of shear where it is known.
    pub pressure: Vec<f64>,
    pub shear: Vec<f64>,
    pub bound: Option<Vec<f64>>,
    /// Heights of the lower and of the upper surface, where they move.
    pub surfaces: Option<[Vec<f64>; 2]>,
    /// Images by the place of their map, each an address.
    pub images: Vec<String>,
}

/// What holds for all moments.
pub struct Ground<'a> {
    pub view: &'a Overview<'a>,
    pub section: Section,
    direction: [f64; 2],
    pub shear_name: &'static str,
    pub has_shear: bool,
    pub has_zones: bool,
    pub has_surfaces: bool,
    pub window: Window,
    /// Largest pressure and largest shear of a cell.
    pub most: [f64; 2],
}

impl<'a> Ground<'a> {
    /// Looks at all increments that can be shown; no more than `most` of them.
    pub fn of(view: &'a Overview<'a>, most: usize) -> Result<Self, Failure> {
        let fields = &view.results.fields;
        let section = Section::of(view);
        let (direction, shear_name) = shear_direction(view, &section);
        let has_shear = fields.has("shear_x") && !view.is_frictionless();
        let has_zones = fields.has("zone") && !view.is_frictionless();
        let mut ground = Self {
            view,
            section,
            direction,
            shear_name,
            has_shear,
            has_zones,
            has_surfaces: surfaces::are_known(view),
            window: Window::new(fields.cells()),
            most: [0.0; 2],
        };
        for position in view.telling(most) {
            let pressure = fields.field("pressure", position)?;
            ground.window.widen(&pressure);
            ground.most[0] = ground.most[0].max(largest(&pressure));
            if has_shear {
                ground.most[1] = ground.most[1].max(largest(&ground.magnitude(position)?));
            }
        }
        Ok(ground)
    }

    /// Magnitude of the shear.
    fn magnitude(&self, position: usize) -> Result<Array2<f64>, Failure> {
        let fields = &self.view.results.fields;
        let (x, y) = (fields.field("shear_x", position)?, fields.field("shear_y", position)?);
        Ok(Zip::from(&x).and(&y).map_collect(|x, y| x.hypot(*y)))
    }

    /// The increment at a position among the kept ones.
    pub fn moment(&self, position: usize) -> Result<Moment, Failure> {
        let fields = &self.view.results.fields;
        let increment = fields.steps[position];
        let field = fields.field("pressure", position)?;
        let pressure = self.section.values(&field);
        let mut images = Vec::new();
        if self.has_zones {
            let zone = fields.field("zone", position)?;
            images.push(self.window.part().zones(|cell| zone[cell])?);
        }
        images.push(self.image(&field, &field, self.most[0])?);
        let mut shear = Vec::new();
        if self.has_shear {
            shear = self.section.shear(fields, position, self.direction)?;
            images.push(self.image(&self.magnitude(position)?, &field, self.most[1])?);
        }
        let bound =
            self.view.friction_at(increment).filter(|_| self.has_shear).map(|(coefficient, strength)| {
                let bound = |pressure: &f64| (coefficient * pressure).min(strength.unwrap_or(f64::INFINITY));
                pressure.iter().map(bound).collect()
            });
        let surfaces =
            self.has_surfaces.then(|| surfaces::along(self.view, &self.section, position)).transpose()?;
        Ok(Moment { increment, pressure, shear, bound, surfaces, images })
    }

    /// A field in false colours where there is contact.
    fn image(&self, field: &Array2<f64>, pressure: &Array2<f64>, most: f64) -> Result<String, Failure> {
        let value = |cell: [usize; 2]| if pressure[cell] > 0.0 { field[cell] } else { f64::NAN };
        Ok(self.window.part().values([0.0, most], value)?)
    }
}

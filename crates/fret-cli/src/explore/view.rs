//! What is drawn and told of a solution: loop, section, zones, pressure, stress. Drawings are those of the report.

use fret_core::history::{History, KeptFields, StepRecord};
use fret_core::model::Dimension;
use fret_core::plan::Plan;
use fret_core::units::Units;
use maud::{Markup, html};
use ndarray::Array2;
use serde_json::{Value, json};

use super::question::Values;
use super::stress::stress_below;
use crate::failure::Failure;
use crate::figures::percent;
use crate::report::{Measured, Part, Window, friction_in, legend_of_zones, number};
use crate::stress::Section;
use crate::sweep::{Path, last_cycle};
use crate::way::Way;
use fret_drawing::{Chart, Curve, Map};

/// Room around the contact in a picture, over its width.
const ROOM: f64 = 0.12;

/// A solution.
pub struct Solved {
    /// The numbers of the sliders.
    pub values: Values,
    /// What was planned.
    pub plan: Plan,
    /// What was found.
    pub history: History,
    /// The time that it took.
    pub seconds: f64,
}

/// A solution, seen in one increment of its last cycle.
pub struct View<'a> {
    plan: &'a Plan,
    history: &'a History,
    /// Increments of the path.
    steps: &'a [StepRecord],
    /// The path of the load.
    pub path: Path,
    /// Whether anything moves sideways; else the path is that of pressing.
    moves: bool,
    /// Which of them is shown.
    pub moment: usize,
}

impl Measured for View<'_> {
    fn units(&self) -> Option<&Units> {
        self.plan.case.units.as_ref()
    }

    fn dimension(&self) -> Dimension {
        self.plan.grid.dimension()
    }
}

impl<'a> View<'a> {
    /// A solution in an increment; without one, in that of the largest load.
    pub fn of(solved: &'a Solved, moment: Option<usize>) -> Self {
        let (plan, history) = (&solved.plan, &solved.history);
        let steps = &history.steps[last_cycle(history)];
        let mut path = Path::through(steps);
        let moves = path.points.iter().any(|point| point[1] != 0.0 || point[0] != path.points[0][0]);
        if !moves {
            path.points = steps.iter().map(|step| [step.approach, step.normal_force]).collect();
        }
        let load = |place: &usize| path.points[*place][1].abs();
        // the first of equal ones
        let largest = (0..steps.len()).rev().max_by(|a, b| load(a).total_cmp(&load(b))).unwrap_or(0);
        let moment = moment.unwrap_or(largest).min(steps.len().saturating_sub(1));
        Self { plan, history, steps, path, moves, moment }
    }

    fn record(&self) -> Option<&'a StepRecord> {
        self.steps.get(self.moment)
    }

    fn kept(&self) -> Option<&'a KeptFields> {
        self.history.fields_of(self.record()?.increment)
    }

    /// What is drawn, by the places of the page.
    pub fn figures(&self) -> Result<Value, Failure> {
        let mut figures = serde_json::Map::new();
        let mut add = |name: &str, drawing: Markup| {
            figures.insert(name.to_owned(), json!(drawing.into_string()));
        };
        add("loop", self.loop_chart().in_page());
        let Some((kept, pressure)) = self.kept().and_then(|kept| Some((kept, kept.pressure.as_ref()?)))
        else {
            return Ok(figures.into());
        };
        add("section", self.section(kept, pressure));
        let part = self.part(pressure);
        if let Some(zone) = kept.zone.as_ref().filter(|_| !self.plan.case.friction.is_frictionless()) {
            let image = part.zones(|cell| f64::from(zone[cell] as u8))?;
            add("zones", html! { (self.map("stick and slip", &part, image, None)?) (legend_of_zones()) });
        }
        if self.dimension() == Dimension::Plane {
            let most = pressure.iter().copied().fold(0.0, f64::max);
            let value = |cell: [usize; 2]| if pressure[cell] > 0.0 { pressure[cell] } else { f64::NAN };
            let image = part.values([0.0, most], value)?;
            add("pressure", self.map("pressure", &part, image, Some(most))?);
        }
        Ok(figures.into())
    }

    fn loop_chart(&self) -> Chart {
        let axes = if self.moves {
            self.loop_labels(self.path.twists)
        } else {
            [self.label("approach", "length"), self.label("normal force", "force")]
        };
        let curve = Curve::plain(self.path.points.clone());
        let here = self.path.points.get(self.moment).map(|at| (*at, "here"));
        Chart { here, ..Chart::new("the path of the load", axes, vec![curve]) }
    }

    /// Pressure, shear along the load and its bound, along x through the middle.
    fn section(&self, kept: &KeptFields, pressure: &Array2<f64>) -> Markup {
        let grid = &self.history.grid;
        let row = grid.cells()[1] / 2;
        let x = grid.centres(0).to_vec();
        let line = |of: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
            x.iter().enumerate().map(|(i, x)| [*x, of(i)]).collect()
        };
        let touches = |i: usize| pressure[[i, row]] > 0.0;
        let (first, last) =
            (0..x.len()).filter(|&i| touches(i)).fold((usize::MAX, 0), |(a, b), i| (a.min(i), b.max(i)));
        let mut curves = vec![Curve::line(line(&|i| pressure[[i, row]]), "pressure", 0)];
        if let Some([along, across]) = &kept.shear {
            let [cosine, sine] = Way::through(self.steps).direction([0.0; 2]).unwrap_or([1.0, 0.0]);
            let friction = self.record().and_then(|record| friction_in(&self.plan.case, record.stage));
            if let Some((coefficient, None)) = friction {
                curves.push(Curve::dashed(line(&|i| coefficient * pressure[[i, row]]), "friction bound", 2));
            }
            let shear = line(&|i| cosine * along[[i, row]] + sine * across[[i, row]]);
            curves.push(Curve::line(shear, "shear", 1));
        }
        let range = (first <= last).then(|| {
            let room = ROOM * (x[last] - x[first]).max(grid.spacing()[0]);
            [x[first] - room, x[last] + room]
        });
        if let Some([low, high]) = range {
            for curve in &mut curves {
                curve.points.retain(|[x, _]| (low..=high).contains(x));
            }
        }
        let axes = [self.label("x", "length"), self.label("traction", "pressure")];
        let chart = Chart {
            ranges: [range, None],
            ..Chart::new("pressure and shear along x through the middle", axes, curves)
        };
        chart.in_page()
    }

    /// The part of the grid that maps show: the contact with some room around it.
    fn part(&self, pressure: &Array2<f64>) -> Part {
        let mut window = Window::new(self.history.grid.cells());
        window.widen(pressure);
        window.part_with(|wide| (ROOM * wide as f64).ceil() as usize)
    }

    fn map(&self, what: &str, part: &Part, image: String, most: Option<f64>) -> Result<Markup, Failure> {
        let grid = &self.history.grid;
        let edges = part.edges(|axis, cell| grid.centre(axis, cell), grid.spacing());
        let map = Map {
            bar: most.map(|most| (self.label("pressure", "pressure"), [0.0, most])),
            ..Map::of_surface(what, self.labels_of_surface(), edges, image)
        };
        Ok(map.drawing()?.in_page())
    }

    /// The numbers that matter, in words.
    pub fn numbers(&self) -> Vec<[String; 3]> {
        let Some(record) = self.record() else { return Vec::new() };
        let mut told = Vec::new();
        let mut add =
            |id: &str, name: &str, value: String| told.push([id.to_owned(), name.to_owned(), value]);
        add("p0", "max pressure", self.number(record.max_pressure, "pressure"));
        let name = match self.dimension() {
            Dimension::Plane => "contact radius",
            Dimension::Line => "contact half-width",
        };
        add("a", name, self.number(self.dimension().radius(record.contact_area), "length"));
        add("approach", "approach", self.number(record.approach, "length"));
        if self.plan.case.friction.is_frictionless() {
            return told;
        }
        add("stick", "stick fraction", percent(record.stick_area / record.contact_area));
        if let Some(cycle) = self.history.cycles.last() {
            add("energy", "energy W_d per cycle", self.number(cycle.dissipated_energy, "force x length"));
            add("condition", "running condition", spoken(&json!(cycle.regime)));
            add("ratio", "energy ratio A", cycle.energy_ratio.map_or("–".to_owned(), number));
        } else {
            add("energy", "dissipated energy", self.number(record.dissipated_energy, "force x length"));
            add("condition", "condition", spoken(&json!(record.regime)));
        }
        told
    }

    /// The same for programs: of the last increment and the last cycle.
    pub fn raw(&self) -> Value {
        let end = self.history.steps.last();
        json!({
            "normal_force": end.map(|end| end.normal_force),
            "approach": end.map(|end| end.approach),
            "max_pressure": end.map(|end| end.max_pressure),
            "dissipated_energy": end.map(|end| end.dissipated_energy),
            "cycle_dissipated_energy": self.history.cycles.last().map(|cycle| cycle.dissipated_energy),
            "cells": self.plan.grid.cells(),
        })
    }

    /// The section of the stress, the numbers that go with it, and these for programs.
    pub fn stress(&self) -> Result<(String, Vec<[String; 3]>, Value), Failure> {
        let Some(seen) = self.record().zip(self.kept()) else {
            return Ok((String::new(), Vec::new(), json!(null)));
        };
        let Some(below) = stress_below(self.plan, self.history, seen)? else {
            return Ok((String::new(), Vec::new(), json!(null)));
        };
        let (most, depth) = below.largest;
        let section = Section {
            title: "",
            subject: "section at y = 0",
            quantity: ("von Mises stress", "pressure"),
            units: self.plan.case.units.as_ref(),
            x: &self.history.grid.centres(0).to_vec(),
            depths: &below.depths,
            values: &below.values,
            interfaces: &below.interfaces,
            range: None,
        };
        let figure =
            section.drawing(Map::WIDTH)?.map_or_else(String::new, |drawing| drawing.in_page().into_string());
        let mut told = vec![
            ["mises".to_owned(), "max von Mises stress".to_owned(), self.number(most, "pressure")],
            ["depth".to_owned(), format!("its depth, {} body", below.body), self.number(depth, "length")],
        ];
        if let Some(margin) = below.margin {
            told.push(["margin".to_owned(), "yield margin".to_owned(), number(margin)]);
        }
        Ok((figure, told, json!({ "max_von_mises": most, "depth": depth, "yield_margin": below.margin })))
    }
}

/// A word of a file for a person.
fn spoken(word: &Value) -> String {
    word.as_str().map_or("–".to_owned(), |word| word.replace('_', " "))
}

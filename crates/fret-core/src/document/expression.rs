//! An expression of numbers in named variables, as it is written on paper: read once, evaluated often. Powers bind before signs (`-x^2` is
//! `-(x^2)`) and from the right.

mod reading;
mod step;

pub use reading::ExpressionError;
use reading::Reading;
pub use step::is_free_name;
use step::{DEEPEST, FUNCTIONS, OF_TWO, Step, power};

/// An expression that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    steps: Vec<Step>,
}

impl Expression {
    /// Reads an expression in `variables`; `constants` are names of numbers.
    ///
    /// # Errors
    /// When it is none.
    pub fn parse(
        text: &str,
        variables: &[&str],
        constants: &[(String, f64)],
    ) -> Result<Self, ExpressionError> {
        let mut reading = Reading::new(text, variables, constants);
        reading.sum()?;
        match reading.next() {
            None => Ok(Self { steps: reading.steps }),
            Some(')') => Err(reading.wrong_here(") without its (", "")),
            Some(_) => Err(reading.wrong_here(
                &format!("found {:?}, expected an operator or the end", reading.word()),
                "products are written with *: 2*x, 3*(x + y)",
            )),
        }
    }

    /// Whether it depends on the variable of that number.
    pub fn has(&self, variable: usize) -> bool {
        self.steps.contains(&Step::Variable(variable))
    }

    /// Its value; of a variable that is not given, no number.
    pub fn at(&self, variables: &[f64]) -> f64 {
        let mut pile = [0.0; DEEPEST];
        let mut held = 0;
        for step in &self.steps {
            let of_two = |pile: &mut [f64; DEEPEST], rule: &dyn Fn(f64, f64) -> f64| {
                pile[held - 2] = rule(pile[held - 2], pile[held - 1]);
            };
            match *step {
                Step::Number(number) => pile[held] = number,
                Step::Variable(number) => pile[held] = variables.get(number).copied().unwrap_or(f64::NAN),
                Step::Negative => pile[held - 1] = -pile[held - 1],
                Step::Function(number) => pile[held - 1] = FUNCTIONS[number].1(pile[held - 1]),
                Step::Sum => of_two(&mut pile, &|one, other| one + other),
                Step::Difference => of_two(&mut pile, &|one, other| one - other),
                Step::Product => of_two(&mut pile, &|one, other| one * other),
                Step::Quotient => of_two(&mut pile, &|one, other| one / other),
                Step::Power => of_two(&mut pile, &power),
                Step::FunctionOfTwo(number) => of_two(&mut pile, &OF_TWO[number].1),
            }
            held = step.held_after(held);
        }
        pile[0]
    }
}

#[cfg(test)]
mod tests;

//! An expression while it is read, by precedence, and what is wrong with one.

use std::ops::Range;

use super::step::{Arguments, CONSTANTS, DEEPEST, FUNCTIONS, OF_TWO, Step, is_in_a_name, starts_a_name};

/// What is wrong with an expression.
#[derive(Debug, Clone, PartialEq)]
pub struct ExpressionError {
    /// What.
    pub message: String,
    /// What is allowed.
    pub help: String,
    /// Bytes of the expression that it is about.
    pub at: Range<usize>,
}

/// An expression while it is read, by precedence: a sum of products of signed powers.
pub(super) struct Reading<'t> {
    text: &'t str,
    /// Bytes read.
    at: usize,
    variables: &'t [&'t str],
    constants: &'t [(String, f64)],
    pub steps: Vec<Step>,
    /// Numbers on the pile after the steps so far.
    held: usize,
    /// Parentheses and exponents that are open.
    inside: usize,
}

type Read = Result<(), ExpressionError>;

impl<'t> Reading<'t> {
    /// Nothing read yet.
    pub fn new(text: &'t str, variables: &'t [&'t str], constants: &'t [(String, f64)]) -> Self {
        Self { text, at: 0, variables, constants, steps: Vec::new(), held: 0, inside: 0 }
    }

    pub fn sum(&mut self) -> Read {
        self.product()?;
        loop {
            let step = match self.next() {
                Some('+') => Step::Sum,
                Some('-') => Step::Difference,
                _ => return Ok(()),
            };
            self.at += 1;
            self.product()?;
            self.take(step)?;
        }
    }

    fn product(&mut self) -> Read {
        self.signed()?;
        loop {
            let step = match self.next() {
                Some('*') => Step::Product,
                Some('/') => Step::Quotient,
                _ => return Ok(()),
            };
            self.at += 1;
            self.signed()?;
            self.take(step)?;
        }
    }

    /// A power, and the signs before it.
    fn signed(&mut self) -> Read {
        let mut negative = false;
        while let Some(sign @ ('+' | '-')) = self.next() {
            negative ^= sign == '-';
            self.at += 1;
        }
        self.power()?;
        if negative { self.take(Step::Negative) } else { Ok(()) }
    }

    fn power(&mut self) -> Read {
        self.operand()?;
        self.next();
        let rest = &self.text[self.at..];
        let sign = ["**", "^"].into_iter().find(|sign| rest.starts_with(sign));
        let Some(sign) = sign else { return Ok(()) };
        let open = self.at;
        self.at += sign.len();
        self.deeper(open, Self::signed)?;
        self.take(Step::Power)
    }

    fn operand(&mut self) -> Read {
        match self.next() {
            Some('(') => self.in_parentheses(Self::sum),
            Some(letter) if letter.is_ascii_digit() || letter == '.' => self.number(),
            Some(letter) if starts_a_name(letter) => self.name(),
            Some(_) => Err(self.wrong_here(
                &format!("found {:?}, expected a number, a name or (", self.word()),
                "operators are + - * / ^; powers are written x^2",
            )),
            None => {
                let end = self.text.len();
                Err(self.wrong(end..end, "it ends where a number, a name or ( is expected", ""))
            }
        }
    }

    fn in_parentheses(&mut self, read: fn(&mut Self) -> Read) -> Read {
        let open = self.at;
        self.at += 1;
        self.deeper(open, read)?;
        if self.next() == Some(')') {
            self.at += 1;
            return Ok(());
        }
        match self.next() {
            None => Err(self.wrong(open..open + 1, "( that is not closed", "")),
            Some(_) => {
                Err(self.wrong_here(&format!("found {:?}, expected an operator or )", self.word()), ""))
            }
        }
    }

    fn deeper(&mut self, open: usize, read: fn(&mut Self) -> Read) -> Read {
        self.inside += 1;
        if self.inside > DEEPEST {
            return Err(self.too_deep(open));
        }
        read(self)?;
        self.inside -= 1;
        Ok(())
    }

    fn number(&mut self) -> Read {
        let rest = &self.text[self.at..];
        let digits = |from: usize| from + rest[from..].bytes().take_while(u8::is_ascii_digit).count();
        let mut end = digits(0);
        if rest[end..].starts_with('.') {
            end = digits(end + 1);
        }
        if let Some(exponent) = rest[end..].strip_prefix(['e', 'E']) {
            let sign = usize::from(exponent.starts_with(['+', '-']));
            let last = digits(end + 1 + sign);
            if last > end + 1 + sign {
                end = last;
            }
        }
        let place = self.at..self.at + end;
        self.at += end;
        match rest[..end].parse::<f64>() {
            Ok(number) if number.is_finite() => self.take(Step::Number(number)),
            Ok(_) => Err(self.wrong(place, "a number that is too large", "")),
            Err(_) => Err(self.wrong(place, &format!("{:?} is no number", &rest[..end]), "")),
        }
    }

    fn name(&mut self) -> Read {
        let rest = &self.text[self.at..];
        let name = &rest[..rest.bytes().take_while(|byte| is_in_a_name(char::from(*byte))).count()];
        let place = self.at..self.at + name.len();
        self.at += name.len();
        if let Some(number) = FUNCTIONS.iter().position(|(known, _)| *known == name) {
            self.opens(&place)?;
            self.in_parentheses(Self::sum)?;
            return self.take(Step::Function(number));
        }
        if let Some(number) = OF_TWO.iter().position(|(known, ..)| *known == name) {
            self.opens(&place)?;
            return self.arguments(number, place);
        }
        if let Some(number) = self.variables.iter().position(|known| *known == name) {
            return self.take(Step::Variable(number));
        }
        let own = self.constants.iter().find(|(known, _)| known == name).map(|(_, value)| *value);
        let known = || CONSTANTS.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
        if let Some(value) = own.or_else(known) {
            return self.take(Step::Number(value));
        }
        let message = format!("unknown name {name:?}");
        Err(self.wrong(place, &message, &self.names()))
    }

    /// Arguments of a function of two numbers, or of several.
    fn arguments(&mut self, number: usize, place: Range<usize>) -> Read {
        let (name, _, takes) = OF_TWO[number];
        let open = self.at;
        self.at += 1;
        self.deeper(open, Self::sum)?;
        let mut count = 1;
        while self.next() == Some(',') {
            self.at += 1;
            self.deeper(open, Self::sum)?;
            self.take(Step::FunctionOfTwo(number))?;
            count += 1;
        }
        match self.next() {
            Some(')') => self.at += 1,
            None => return Err(self.wrong(open..open + 1, "( that is not closed", "")),
            Some(_) => {
                return Err(self.wrong_here(
                    &format!("found {:?}, expected an operator, a comma or )", self.word()),
                    "",
                ));
            }
        }
        match takes {
            Arguments::Two if count != 2 => Err(self.wrong(
                place,
                &format!("{name} takes two numbers, found {count}"),
                &format!("{name}(a, b)"),
            )),
            Arguments::Several if count < 2 => {
                Err(self.wrong(place, &format!("{name} of one number"), &format!("{name}(a, b, ...)")))
            }
            _ => Ok(()),
        }
    }

    /// That a function is followed by its arguments.
    fn opens(&mut self, name: &Range<usize>) -> Read {
        if self.next() == Some('(') {
            return Ok(());
        }
        let word = &self.text[name.clone()];
        let message = format!("{word} without its argument");
        Err(self.wrong(name.clone(), &message, &format!("{word}(...)")))
    }

    /// Takes a step.
    fn take(&mut self, step: Step) -> Read {
        self.held = step.held_after(self.held);
        if self.held > DEEPEST {
            return Err(self.too_deep(self.at.min(self.text.len())));
        }
        self.steps.push(step);
        Ok(())
    }

    /// The next letter but blanks, which are passed over; not read.
    pub fn next(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    /// The word or letter that stands next.
    pub fn word(&self) -> &str {
        let rest = &self.text[self.at..];
        let length =
            rest.chars().take_while(|letter| is_in_a_name(*letter)).map(char::len_utf8).sum::<usize>();
        &rest[..length.max(rest.chars().next().map_or(0, char::len_utf8))]
    }

    fn names(&self) -> String {
        let mut own: Vec<&str> = self.variables.to_vec();
        own.extend(self.constants.iter().map(|(name, _)| name.as_str()));
        own.extend(CONSTANTS.map(|(name, _)| name));
        let functions = FUNCTIONS.map(|(name, _)| name).into_iter().chain(OF_TWO.map(|(name, ..)| name));
        format!("known are {}; functions are {}", own.join(", "), functions.collect::<Vec<_>>().join(", "))
    }

    fn too_deep(&self, at: usize) -> ExpressionError {
        self.wrong(at..at, "nested too deeply", "at most 32 parentheses and powers inside one another")
    }

    pub fn wrong_here(&self, message: &str, help: &str) -> ExpressionError {
        self.wrong(self.at..self.at + self.word().len(), message, help)
    }

    fn wrong(&self, at: Range<usize>, message: &str, help: &str) -> ExpressionError {
        let number = self.text[..at.start].chars().count() + 1;
        ExpressionError { message: format!("{message}, at character {number}"), help: help.to_owned(), at }
    }
}

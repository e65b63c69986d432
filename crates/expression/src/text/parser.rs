//! The parser of expressions: by descent, with the dimension of every part.

use crate::{Expression, ExpressionNode as Node, Function, Operation};
use piola_document::units::Dimension;

use super::dimensions::{plain, power, pure, words};
use super::tokens::{Token, tokens};
use super::{ExpressionMistake, ExpressionNames, NameMeaning, one_of};

/// Brackets and signs within each other, beyond which the parser would recurse too far.
const DEEPEST: usize = 60;
/// Nodes of one expression.
const MOST_NODES: usize = 5000;

/// Functions of one argument.
const FUNCTIONS: [(&str, Function); 14] = [
    ("sqrt", Function::Sqrt),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("asin", Function::Asin),
    ("acos", Function::Acos),
    ("atan", Function::Atan),
    ("sinh", Function::Sinh),
    ("cosh", Function::Cosh),
    ("tanh", Function::Tanh),
    ("abs", Function::Abs),
    ("sign", Function::Sign),
];

/// Functions of two arguments.
const PAIRS: [(&str, Operation); 3] = [("atan2", Operation::Atan2), ("min", Operation::Min), ("max", Operation::Max)];

pub(super) fn is_function(name: &str) -> bool {
    name == "rate" || FUNCTIONS.iter().any(|(known, _)| *known == name) || PAIRS.iter().any(|(known, _)| *known == name)
}

pub(super) fn parse(text: &str, names: &ExpressionNames, expected: Dimension) -> Result<Expression, ExpressionMistake> {
    let tokens = tokens(text)?;
    let mut parser = Parser { tokens: &tokens, next: 0, names, nodes: Vec::new(), depth: 0 };
    let whole = parser.sum()?;
    if let Some(token) = parser.peek() {
        return Err(ExpressionMistake::new(
            format!("{} cannot stand there", token.shown()),
            "a sign + - * / ^ between two parts, as in 2 * x",
        ));
    }
    let expected = plain(expected);
    if names.with_units && whole.dimension != expected && bare(&tokens).is_none() {
        return Err(ExpressionMistake::new(
            format!("it is {} instead of {}", words(whole.dimension), words(expected)),
            format!("numbers with their units, as 2 [{}]", expected.si_unit()),
        ));
    }
    Expression::new(parser.nodes).map_err(|error| ExpressionMistake::new(error.to_string(), "a shorter expression"))
}

/// The number without a unit that tokens are, with signs before it and brackets about it.
fn bare(mut tokens: &[Token]) -> Option<f64> {
    loop {
        tokens = match tokens {
            [Token::Number(value, None)] => return Some(*value),
            [Token::Sign('+' | '-'), rest @ ..] | [Token::Sign('('), rest @ .., Token::Sign(')')] => rest,
            _ => return None,
        };
    }
}

/// A part of an expression: the nodes from `start` on, of which the last is its value.
struct Part {
    start: usize,
    dimension: Dimension,
}

struct Parser<'p> {
    tokens: &'p [Token],
    next: usize,
    names: &'p ExpressionNames,
    nodes: Vec<Node>,
    depth: usize,
}

impl Parser<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next)
    }

    /// Takes one of the signs if it stands next.
    fn take(&mut self, signs: &[char]) -> Option<char> {
        match self.peek() {
            Some(Token::Sign(sign)) if signs.contains(sign) => {
                let sign = *sign;
                self.next += 1;
                Some(sign)
            }
            _ => None,
        }
    }

    fn require(&mut self, sign: char, why: &str) -> Result<(), ExpressionMistake> {
        if self.take(&[sign]).is_some() {
            return Ok(());
        }
        let found = self.peek().map_or_else(|| "it ends".to_string(), |token| format!("{} stands", token.shown()));
        Err(ExpressionMistake::new(format!("{found} where `{sign}` {why}"), format!("`{sign}`")))
    }

    /// Adds a node, or the number that it is.
    fn push(&mut self, start: usize, node: Node, dimension: Dimension) -> Result<Part, ExpressionMistake> {
        self.nodes.push(node);
        if MOST_NODES < self.nodes.len() {
            return Err(ExpressionMistake::new(format!("it has more than {MOST_NODES} parts"), "a shorter expression"));
        }
        let inner = &self.nodes[start..];
        if 1 < inner.len() && !inner.iter().any(|node| matches!(node, Node::Variable(_))) {
            // All that stands below is a number: computed once.
            let shifted = inner.iter().map(|node| lowered(*node, start)).collect();
            let value = Expression::new(shifted).map_or(f64::NAN, |number| number.evaluate(&|_| 0.0));
            if !value.is_finite() {
                return Err(ExpressionMistake::new(format!("a part of it is {value}"), "finite numbers"));
            }
            self.nodes.truncate(start);
            self.nodes.push(Node::Constant(value));
        }
        Ok(Part { start, dimension })
    }

    /// The number that a part is, if it is one.
    fn number(&self, part: &Part) -> Option<f64> {
        match self.nodes[part.start..] {
            [Node::Constant(value)] => Some(value),
            _ => None,
        }
    }

    fn last(&self) -> usize {
        self.nodes.len() - 1
    }

    fn sum(&mut self) -> Result<Part, ExpressionMistake> {
        // A written zero without a unit has every dimension; a parameter that is zero has its own.
        let zero = |tokens: &[Token]| bare(tokens).is_some_and(|value| value.abs() <= 0.0);
        let first = self.next;
        let mut sum = self.product()?;
        let mut zero_left = zero(&self.tokens[first..self.next]);
        while let Some(sign) = self.take(&['+', '-']) {
            let (left, first) = (self.last(), self.next);
            let term = self.product()?;
            let zero_term = zero(&self.tokens[first..self.next]);
            let dimension = if zero_left { term.dimension } else { sum.dimension };
            if sum.dimension != term.dimension && !zero_left && !zero_term {
                let operation = if sign == '+' { "added to" } else { "taken from" };
                let (left, right) = (words(sum.dimension), words(term.dimension));
                let valid = format!("two parts of the dimension {left}");
                return Err(ExpressionMistake::new(format!("{right} is {operation} {left}"), valid));
            }
            zero_left &= zero_term;
            let operation = if sign == '+' { Operation::Sum } else { Operation::Difference };
            sum = self.push(sum.start, Node::Operation(operation, left, self.last()), dimension)?;
        }
        Ok(sum)
    }

    fn product(&mut self) -> Result<Part, ExpressionMistake> {
        let mut product = self.power()?;
        while let Some(sign) = self.take(&['*', '/']) {
            let left = self.last();
            let factor = self.power()?;
            let (operation, dimension) = if sign == '*' {
                (Operation::Product, product.dimension.times(factor.dimension))
            } else {
                (Operation::Quotient, product.dimension.over(factor.dimension))
            };
            product = self.push(product.start, Node::Operation(operation, left, self.last()), dimension)?;
        }
        Ok(product)
    }

    fn power(&mut self) -> Result<Part, ExpressionMistake> {
        self.depth += 1;
        if DEEPEST < self.depth {
            return Err(ExpressionMistake::new(
                format!("it has more than {DEEPEST} brackets in each other"),
                "fewer brackets",
            ));
        }
        let part = self.power_within();
        self.depth -= 1;
        part
    }

    fn power_within(&mut self) -> Result<Part, ExpressionMistake> {
        if self.take(&['-']).is_some() {
            let part = self.power()?;
            return self.push(part.start, Node::Negative(self.last()), part.dimension);
        }
        if self.take(&['+']).is_some() {
            return self.power();
        }
        let base = self.atom()?;
        if self.take(&['^']).is_none() {
            return Ok(base);
        }
        let at = self.last();
        let exponent = self.power()?;
        pure("an exponent", exponent.dimension)?;
        let Some(number) = self.number(&exponent) else {
            pure("a number with a variable exponent", base.dimension)?;
            return self.push(base.start, Node::Operation(Operation::Power, at, self.last()), Dimension::NONE);
        };
        let dimension = power(base.dimension, number).ok_or_else(|| {
            ExpressionMistake::new(
                format!("{} to the power {number} has no dimension", base.dimension),
                "a whole exponent",
            )
        })?;
        if number.fract().abs() <= 0.0 && number.abs() <= 1000.0 {
            self.nodes.truncate(exponent.start);
            #[expect(clippy::cast_possible_truncation, reason = "a whole number of at most four digits")]
            return self.push(base.start, Node::WholePower(at, number as i32), dimension);
        }
        self.push(base.start, Node::Operation(Operation::Power, at, self.last()), dimension)
    }

    fn atom(&mut self) -> Result<Part, ExpressionMistake> {
        let start = self.nodes.len();
        let token = self.peek().cloned();
        self.next += 1;
        match token {
            Some(Token::Number(value, dimension)) => {
                if dimension.is_some() && !self.names.with_units {
                    return Err(ExpressionMistake::new("a number has a unit", "pure numbers: nothing here has a unit"));
                }
                let dimension = plain(dimension.unwrap_or(Dimension::NONE));
                self.push(start, Node::Constant(value), dimension)
            }
            Some(Token::Sign('(')) => {
                let part = self.sum()?;
                self.require(')', "must close a bracket")?;
                Ok(part)
            }
            Some(Token::Name(name)) => {
                if self.take(&['(']).is_some() {
                    return self.call(&name, start);
                }
                let Some((meaning, dimension)) = self.names.meanings.get(&name) else {
                    return Err(ExpressionMistake::new(format!("`{name}` is not known"), one_of(&name, self.names)));
                };
                let node = match meaning {
                    NameMeaning::Variable(variable) => Node::Variable(*variable),
                    NameMeaning::Number(value) => Node::Constant(*value),
                };
                let dimension = if self.names.with_units { plain(*dimension) } else { Dimension::NONE };
                self.push(start, node, dimension)
            }
            Some(token) => Err(ExpressionMistake::new(
                format!("{} stands where a number or a name must", token.shown()),
                "a number, a name or a bracket",
            )),
            None => Err(ExpressionMistake::new(
                "it ends where a number or a name must stand",
                "a number, a name or a bracket",
            )),
        }
    }

    /// A function, after its bracket.
    fn call(&mut self, name: &str, start: usize) -> Result<Part, ExpressionMistake> {
        if name == "rate" {
            return self.rate(start);
        }
        let first = self.sum()?;
        if let Some((_, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) {
            self.require(')', &format!("must close {name}(…)"))?;
            let dimension = match function {
                Function::Abs => first.dimension,
                Function::Sign => Dimension::NONE,
                Function::Sqrt => power(first.dimension, 0.5).ok_or_else(|| {
                    ExpressionMistake::new(format!("the root of {} has no dimension", first.dimension), "a square")
                })?,
                _ => {
                    pure(&format!("the argument of {name}"), first.dimension)?;
                    Dimension::NONE
                }
            };
            return self.push(start, Node::Function(*function, self.last()), dimension);
        }
        let Some((_, operation)) = PAIRS.iter().find(|(known, _)| *known == name) else {
            let known = FUNCTIONS.iter().map(|(name, _)| *name).chain(PAIRS.iter().map(|(name, _)| *name));
            let valid = piola_document::words::one_of(name, known.chain(["rate"]));
            return Err(ExpressionMistake::new(format!("no function is named `{name}`"), valid));
        };
        let left = self.last();
        self.require(',', &format!("must part the arguments of {name}(…)"))?;
        let second = self.sum()?;
        self.require(')', &format!("must close {name}(…)"))?;
        if first.dimension != second.dimension {
            let (first, second) = (words(first.dimension), words(second.dimension));
            let valid = format!("two parts of the dimension {first}");
            return Err(ExpressionMistake::new(format!("{name} of {first} and {second}"), valid));
        }
        let dimension = if *operation == Operation::Atan2 { Dimension::NONE } else { first.dimension };
        self.push(start, Node::Operation(*operation, left, self.last()), dimension)
    }

    fn rate(&mut self, start: usize) -> Result<Part, ExpressionMistake> {
        let Some(Token::Name(name)) = self.peek().cloned() else {
            return Err(ExpressionMistake::new("rate(…) has no name in it", "rate(joint): the rate of a coordinate"));
        };
        self.next += 1;
        let known = self.names.rates.keys().map(String::as_str);
        let Some((variable, dimension)) = self.names.rates.get(&name) else {
            return Err(ExpressionMistake::new(
                format!("no coordinate with a rate is named `{name}`"),
                piola_document::words::one_of(&name, known),
            ));
        };
        self.require(')', "must close rate(…)")?;
        self.push(start, Node::Variable(*variable), plain(*dimension))
    }
}

/// A node with its operands counted from `start`.
fn lowered(node: Node, start: usize) -> Node {
    match node {
        Node::Negative(a) => Node::Negative(a - start),
        Node::WholePower(a, n) => Node::WholePower(a - start, n),
        Node::Function(function, a) => Node::Function(function, a - start),
        Node::Operation(operation, a, b) => Node::Operation(operation, a - start, b - start),
        Node::Constant(_) | Node::Variable(_) => node,
    }
}

//! Small formulas over the inputs of a node, as `cheaper:` lines use them: `2 / roughness^4 - 2`.
//!
//! Numbers, names of inputs, `+ - * / ^` and parentheses. Vectors take part component by component, and a single number
//! with each of them.

/// Deepest nesting.
const MAX_DEPTH: usize = 32;

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// A number.
    Number(f64),
    /// What an input is fed or set to.
    Input(String),
    /// Two formulas and one of `+ - * / ^`.
    Both(char, Box<(Formula, Formula)>),
}

/// What is known of a formula before anything runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Known {
    /// Its components.
    Numbers(Vec<f64>),
    /// It is what this input is fed.
    Input(String),
}

impl Formula {
    /// Reads a formula. What is wrong is said in words, with the byte where it is.
    pub fn parse(text: &str) -> Result<Self, (usize, String)> {
        let mut reader = Reader { text, at: 0, depth: 0 };
        let formula = reader.sum()?;
        match reader.peek() {
            None => Ok(formula),
            Some(c) => Err((reader.at, format!("`{c}` cannot stand here"))),
        }
    }

    /// Names of the inputs in it.
    pub fn inputs(&self) -> Vec<&str> {
        match self {
            Self::Number(_) => Vec::new(),
            Self::Input(name) => vec![name],
            Self::Both(_, both) => [both.0.inputs(), both.1.inputs()].concat(),
        }
    }

    /// What it comes to where `of` says what is known of each input: numbers, or an input that is passed on as it is. None
    /// where it would have to be computed, or is no number.
    pub fn reduce(&self, of: &dyn Fn(&str) -> Option<Known>) -> Option<Known> {
        match self {
            Self::Number(x) => Some(Known::Numbers(vec![*x])),
            Self::Input(name) => of(name),
            Self::Both(operator, both) => {
                // What is multiplied by nothing need not be known.
                let (left, right) = (both.0.reduce(of), both.1.reduce(of));
                let is =
                    |side: &Option<Known>, x: f64| matches!(side, Some(Known::Numbers(n)) if n.iter().all(|y| *y == x));
                match operator {
                    '*' if is(&left, 0.0) || is(&right, 0.0) => Some(Known::Numbers(vec![0.0])),
                    '+' if is(&left, 0.0) => right,
                    '*' if is(&left, 1.0) => right,
                    '+' | '-' if is(&right, 0.0) => left,
                    '*' | '/' | '^' if is(&right, 1.0) => left,
                    _ => numbers(*operator, &left?, &right?),
                }
            }
        }
    }
}

fn numbers(operator: char, left: &Known, right: &Known) -> Option<Known> {
    let (Known::Numbers(left), Known::Numbers(right)) = (left, right) else { return None };
    let count = left.len().max(right.len());
    let part = |side: &[f64], i: usize| if side.len() == 1 { Some(side[0]) } else { side.get(i).copied() };
    let one = |i: usize| {
        let (a, b) = (part(left, i)?, part(right, i)?);
        let x = match operator {
            '+' => a + b,
            '-' => a - b,
            '*' => a * b,
            '/' => a / b,
            _ => a.powf(b),
        };
        x.is_finite().then_some(x)
    };
    (0..count).map(one).collect::<Option<Vec<f64>>>().map(Known::Numbers)
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
}

type Read = Result<Formula, (usize, String)>;

impl Reader<'_> {
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    fn take(&mut self, wanted: &[char]) -> Option<char> {
        let found = self.peek().filter(|c| wanted.contains(c))?;
        self.at += found.len_utf8();
        Some(found)
    }

    fn sum(&mut self) -> Read {
        let mut left = self.product()?;
        while let Some(operator) = self.take(&['+', '-']) {
            left = Formula::Both(operator, Box::new((left, self.product()?)));
        }
        Ok(left)
    }

    fn product(&mut self) -> Read {
        let mut left = self.power()?;
        while let Some(operator) = self.take(&['*', '/']) {
            left = Formula::Both(operator, Box::new((left, self.power()?)));
        }
        Ok(left)
    }

    fn power(&mut self) -> Read {
        let base = self.leaf()?;
        match self.take(&['^']) {
            Some(operator) => Ok(Formula::Both(operator, Box::new((base, self.leaf()?)))),
            None => Ok(base),
        }
    }

    fn leaf(&mut self) -> Read {
        let start = self.at;
        if self.take(&['(']).is_some() {
            self.depth += 1;
            if self.depth > MAX_DEPTH {
                return Err((start, "the formula nests too deeply".into()));
            }
            let inner = self.sum()?;
            self.depth -= 1;
            return match self.take(&[')']) {
                Some(_) => Ok(inner),
                None => Err((self.at, "a parenthesis is not closed".into())),
            };
        }
        let word: String = match self.peek() {
            Some(c) if c.is_ascii_alphanumeric() || matches!(c, '_' | '.') => self.text[self.at..]
                .chars()
                .take_while(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '.'))
                .collect(),
            Some(c) => return Err((self.at, format!("`{c}` is neither a number nor an input"))),
            None => return Err((self.at, "something is missing at the end".into())),
        };
        let at = self.at;
        self.at += word.len();
        if super::tokens::is_identifier(&word) {
            return Ok(Formula::Input(word));
        }
        match word.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(Formula::Number(x)),
            _ => Err((at, format!("`{word}` is neither a number nor an input"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reduced(text: &str) -> Option<Known> {
        let of = |name: &str| match name {
            "r" => Some(Known::Numbers(vec![0.5])),
            "c" => Some(Known::Numbers(vec![1.0, 2.0, 4.0])),
            "zero" => Some(Known::Numbers(vec![0.0])),
            "fed" => Some(Known::Input("fed".into())),
            _ => None,
        };
        Formula::parse(text).expect("a formula").reduce(&of)
    }

    #[test]
    fn formulas_are_computed_as_far_as_inputs_are_known() {
        let numbers = |n: &[f64]| Some(Known::Numbers(n.to_vec()));
        assert_eq!(reduced("2 / r^4 - 2"), numbers(&[30.0]));
        assert_eq!(reduced("c * (1 - r) + 1"), numbers(&[1.5, 2.0, 3.0]));
        assert_eq!(reduced("fed * (1 - zero)"), Some(Known::Input("fed".into())));
        assert_eq!(reduced("0.04 * (1 - zero) + fed * zero"), numbers(&[0.04]));
        assert_eq!(reduced("unknown * zero"), numbers(&[0.0]));
        assert_eq!(reduced("fed * r"), None);
        assert_eq!(reduced("1 / zero"), None);
    }

    #[test]
    fn what_is_no_formula_is_refused_where_it_breaks() {
        for (text, at) in [("", 0), ("a +", 3), ("(a", 2), ("a b", 2), ("1.2.3", 0), ("a ^ ^", 4), ("2 % a", 2)] {
            assert_eq!(Formula::parse(text).expect_err(text).0, at, "{text}");
        }
        assert!(Formula::parse(&format!("{}a", "(".repeat(100))).is_err());
        assert_eq!(Formula::parse("a*(b + a)").expect("a formula").inputs(), ["a", "b", "a"]);
    }
}

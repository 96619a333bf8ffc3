//! Values that a person gives to a port, an option or a parameter.

use super::Shape;

/// A literal value, in the unit of the file (degrees where the port says `in deg`).
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// True or false.
    Bool(bool),
    /// One to four numbers.
    Numbers(Vec<f64>),
    /// A path, a name, a WGSL text.
    Text(String),
}

impl Value {
    /// The components, for numbers.
    pub fn numbers(&self) -> Option<&[f64]> {
        match self {
            Self::Numbers(n) => Some(n),
            _ => None,
        }
    }

    /// Whether a port of this shape can take it; a single number fills every component.
    pub fn fits(&self, shape: &Shape) -> bool {
        match (self, shape) {
            (Self::Bool(_), Shape::Bool) | (Self::Text(_), Shape::Texture) => true,
            (Self::Numbers(n), Shape::F32(width)) => n.len() == 1 || n.len() == usize::from(*width),
            (Self::Numbers(n), Shape::I32 | Shape::U32) => n.len() == 1 && n[0].fract() == 0.0,
            (Self::Numbers(n), Shape::Matrix(side)) => n.len() == usize::from(*side).pow(2),
            (Self::Numbers(n), Shape::Generic) => (1..=4).contains(&n.len()),
            _ => false,
        }
    }
}

impl std::fmt::Display for Value {
    /// As a graph file writes it: shortest exact decimals.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bool(b) => write!(f, "{b}"),
            Self::Numbers(n) if n.len() == 1 => write!(f, "{}", number(n[0])),
            Self::Numbers(n) => {
                let parts: Vec<String> = n.iter().map(|x| number(*x)).collect();
                write!(f, "({})", parts.join(", "))
            }
            Self::Text(t) => write!(f, "{t:?}"),
        }
    }
}

/// The shortest decimal that reads back as the same number.
fn number(x: f64) -> String {
    let plain = format!("{x}");
    let exponent = format!("{x:e}");
    if exponent.len() < plain.len() && plain.len() > 12 { exponent } else { plain }
}

//! What a value means: its kind, frame, length, quantity and encoding, and the WGSL shape that carries it.

use std::fmt;

macro_rules! words {
    ($(#[$doc:meta])* $name:ident { $($(#[$vdoc:meta])* $variant:ident = $word:literal),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $name { $($(#[$vdoc])* $variant),+ }

        impl $name {
            /// Every value, in declaration order.
            pub const ALL: &[Self] = &[$(Self::$variant),+];

            /// The word for it in port lines and messages; empty where the value is the unstated one.
            pub const fn word(self) -> &'static str {
                match self { $(Self::$variant => $word),+ }
            }

            /// The value that `word` names.
            pub fn from_word(word: &str) -> Option<Self> {
                if word.is_empty() { return None; }
                Self::ALL.iter().copied().find(|v| v.word() == word)
            }
        }
    };
}

words! {
    /// What sort of thing a value is.
    Kind {
        /// Anything numeric; only the width counts.
        Number = "number",
        /// A pure number.
        Scalar = "scalar",
        /// Radians in the shader.
        Angle = "angle",
        /// Cosine of an angle.
        Cosine = "cosine",
        /// Metres.
        Distance = "distance",
        /// A place.
        Point = "point",
        /// A displacement.
        Vector = "vector",
        /// Where to, without how far.
        Direction = "direction",
        /// Perpendicular to a surface; transforms by the inverse transpose.
        Normal = "normal",
        /// Place on a surface chart.
        Texcoord = "texcoord",
        /// Linear Rec. 709 unless encoded.
        Color = "color",
        /// Position along a viewing axis.
        Depth = "depth",
        /// A whole number that names something.
        Index = "index",
        /// True or false.
        Bool = "bool",
        /// A linear map.
        Matrix = "matrix",
        /// An image to sample.
        Texture = "texture",
        /// How to sample.
        Sampler = "sampler",
        /// A texture in a light's space, made by passes.
        Map = "map",
        /// A light's space.
        Space = "space",
        /// Surroundings of the scene.
        Environment = "environment",
    }
}

words! {
    /// The coordinate frame that a geometric value is given in.
    Frame {
        /// Not stated.
        Any = "",
        /// The object's own.
        Object = "object",
        /// The scene's; y up, metres.
        World = "world",
        /// The camera's; looking along -z.
        View = "view",
        /// Homogeneous clip space of the camera.
        Clip = "clip",
        /// Pixels, y down.
        Screen = "screen",
        /// Tangent, bitangent, normal.
        Tangent = "tangent",
        /// The light's; looking along +z.
        Light = "light",
    }
}

words! {
    /// What is known of a vector's length.
    Length {
        /// Nothing.
        Any = "",
        /// About one: unit vectors after interpolation or filtering.
        Near = "near",
        /// Exactly one.
        Unit = "unit",
    }
}

words! {
    /// The radiometric role of a colour or scalar.
    Quantity {
        /// None.
        None = "",
        /// Share of light scattered back, 0..1.
        Reflectance = "reflectance",
        /// Light arriving at a surface that faces the light.
        Irradiance = "irradiance",
        /// Light leaving towards the viewer.
        Radiance = "radiance",
        /// Share of light that gets through, 0..1.
        Visibility = "visibility",
        /// Light made by the surface itself.
        Emission = "emission",
    }
}

words! {
    /// How a value is written in numbers.
    Encoding {
        /// As it is.
        Linear = "",
        /// sRGB transfer curve.
        Srgb = "srgb",
        /// [-1, 1] packed into [0, 1].
        Signed01 = "signed01",
        /// Depth after a perspective divide.
        Hyperbolic = "hyperbolic",
    }
}

/// Kind and qualifiers together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Meaning {
    /// What sort of thing.
    pub kind: Kind,
    /// In which frame.
    pub frame: Frame,
    /// How long.
    pub length: Length,
    /// In which role.
    pub quantity: Quantity,
    /// Written how.
    pub encoding: Encoding,
}

impl Meaning {
    /// A kind without qualifiers.
    pub const fn of(kind: Kind) -> Self {
        Self { kind, frame: Frame::Any, length: Length::Any, quantity: Quantity::None, encoding: Encoding::Linear }
    }

    /// Reads `kind qualifier qualifier ...`. The error names the word that is not known.
    pub fn parse(words: &str) -> Result<Self, String> {
        let mut words = words.split_whitespace();
        let first = words.next().ok_or("a meaning must name a kind")?;
        let kind = Kind::from_word(first).ok_or_else(|| format!("`{first}` is not a kind"))?;
        let mut meaning = Self::of(kind);
        for word in words {
            if let Some(frame) = Frame::from_word(word) {
                meaning.frame = frame;
            } else if let Some(length) = Length::from_word(word) {
                meaning.length = length;
            } else if let Some(quantity) = Quantity::from_word(word) {
                meaning.quantity = quantity;
            } else if let Some(encoding) = Encoding::from_word(word) {
                meaning.encoding = encoding;
            } else if word != "linear" {
                return Err(format!("`{word}` is not a frame, length, quantity or encoding"));
            }
        }
        Ok(meaning)
    }
}

impl fmt::Display for Meaning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind.word())?;
        for word in [self.frame.word(), self.length.word(), self.quantity.word(), self.encoding.word()] {
            if !word.is_empty() {
                write!(f, " {word}")?;
            }
        }
        Ok(())
    }
}

/// The WGSL type that carries a value.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// `bool`
    Bool,
    /// `i32`
    I32,
    /// `u32`
    U32,
    /// `f32`, or a vector of 2, 3 or 4 of them: the number is the width.
    F32(u8),
    /// `matCxRf` with the same number of columns and rows: 2, 3 or 4.
    Matrix(u8),
    /// `texture_2d<f32>`
    Texture,
    /// `texture_depth_2d`
    DepthTexture,
    /// `sampler`
    Sampler,
    /// `sampler_comparison`
    ComparisonSampler,
    /// The file's type parameter `T`, before it is instantiated.
    Generic,
    /// Any other WGSL type, by name (`LightSpace`, `array<vec4f, 9>`).
    Named(String),
}

impl Shape {
    /// As WGSL writes it.
    pub fn wgsl(&self) -> String {
        match self {
            Self::Bool => "bool".into(),
            Self::I32 => "i32".into(),
            Self::U32 => "u32".into(),
            Self::F32(1) => "f32".into(),
            Self::F32(n) => format!("vec{n}f"),
            Self::Matrix(n) => format!("mat{n}x{n}f"),
            Self::Texture => "texture_2d<f32>".into(),
            Self::DepthTexture => "texture_depth_2d".into(),
            Self::Sampler => "sampler".into(),
            Self::ComparisonSampler => "sampler_comparison".into(),
            Self::Generic => "T".into(),
            Self::Named(name) => name.clone(),
        }
    }

    /// Reads a WGSL type, in its short or its long spelling; `T` is the type parameter.
    pub fn from_wgsl(text: &str) -> Self {
        let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
        match text.as_str() {
            "bool" => Self::Bool,
            "i32" => Self::I32,
            "u32" => Self::U32,
            "f32" => Self::F32(1),
            "vec2f" | "vec2<f32>" => Self::F32(2),
            "vec3f" | "vec3<f32>" => Self::F32(3),
            "vec4f" | "vec4<f32>" => Self::F32(4),
            "mat2x2f" | "mat2x2<f32>" => Self::Matrix(2),
            "mat3x3f" | "mat3x3<f32>" => Self::Matrix(3),
            "mat4x4f" | "mat4x4<f32>" => Self::Matrix(4),
            "texture_2d<f32>" => Self::Texture,
            "texture_depth_2d" => Self::DepthTexture,
            "sampler" => Self::Sampler,
            "sampler_comparison" => Self::ComparisonSampler,
            "T" => Self::Generic,
            _ => Self::Named(text.replace(',', ", ")),
        }
    }

    /// Number of f32 components, for scalars and vectors of f32.
    pub fn width(&self) -> Option<u8> {
        match self {
            Self::F32(n) => Some(*n),
            _ => None,
        }
    }

    /// Whether a parameter of this shape can live in a uniform buffer.
    pub fn is_plain(&self) -> bool {
        matches!(self, Self::Bool | Self::I32 | Self::U32 | Self::F32(_) | Self::Matrix(_))
    }
}

/// Meaning and shape: the type of a port.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Type {
    /// What it means.
    pub meaning: Meaning,
    /// What carries it.
    pub shape: Shape,
}

impl std::hash::Hash for Type {
    /// All but the name of a named shape in one word: types are looked up for every link.
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        let Meaning { kind, frame, length, quantity, encoding } = self.meaning;
        let (tag, number) = match &self.shape {
            Shape::F32(n) => (0, *n),
            Shape::Matrix(n) => (1, *n),
            Shape::Bool => (2, 0),
            Shape::I32 => (3, 0),
            Shape::U32 => (4, 0),
            Shape::Texture => (5, 0),
            Shape::DepthTexture => (6, 0),
            Shape::Sampler => (7, 0),
            Shape::ComparisonSampler => (8, 0),
            Shape::Generic => (9, 0),
            Shape::Named(name) => {
                name.hash(state);
                (10, 0)
            }
        };
        let bytes = [kind as u8, frame as u8, length as u8, quantity as u8, encoding as u8, tag, number, 0];
        state.write_u64(u64::from_le_bytes(bytes));
    }
}

impl Type {
    /// A type of a meaning and a shape.
    pub const fn new(meaning: Meaning, shape: Shape) -> Self {
        Self { meaning, shape }
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (meaning, shape) = (self.meaning.to_string(), self.shape.wgsl());
        match self.shape {
            Shape::Generic => write!(f, "{meaning} (any width)"),
            // `bool (bool)` says it twice.
            _ if meaning == shape => f.write_str(&shape),
            _ => write!(f, "{meaning} ({shape})"),
        }
    }
}

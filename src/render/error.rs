//! What can go wrong between a job and its picture.

/// How the names of uniform blocks begin in [`RenderError::TooLarge`].
pub(super) const UNIFORM_BLOCK: &str = "the uniform block";

/// Why a picture could not be made. The text is one sentence without a full stop; [`RenderError::help`] says what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenderError {
    /// No adapter fits the choice.
    #[error("no graphics adapter was found{}", .wanted.as_deref().map_or(String::new(), |w| format!(" that matches {w}")))]
    NoAdapter {
        /// What was asked for, if anything in particular.
        wanted: Option<String>,
        /// Names of the adapters that there are.
        found: Vec<String>,
    },
    /// The backend list names something unknown.
    #[error("`{0}` is not a graphics backend")]
    UnknownBackend(String),
    /// The adapter gave no device.
    #[error("the adapter {adapter} gives no device: {message}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What the driver says.
        message: String,
    },
    /// The adapter lacks something that cannot be replaced.
    #[error("{0}")]
    Unsupported(String),
    /// Something is larger than the adapter allows.
    #[error("{what} takes {size} {unit}, but at most {limit} {unit} are possible")]
    TooLarge {
        /// What.
        what: String,
        /// How large it is.
        size: u64,
        /// How large it may be.
        limit: u64,
        /// What both are counted in.
        unit: &'static str,
    },
    /// A parameter has a value that nothing can be rendered with.
    #[error("parameter `{path}`: {message}")]
    Parameter {
        /// Its path.
        path: String,
        /// What is wrong with it.
        message: String,
    },
    /// The job contradicts itself.
    #[error("{0}")]
    Job(String),
    /// An image file could not be read.
    #[error("image `{path}`: {message}")]
    Image {
        /// Path as the graph gives it.
        path: String,
        /// What is wrong with it.
        message: String,
    },
    /// The device refuses a shader, a pipeline or a command.
    #[error("{what}: {message}")]
    Rejected {
        /// What was being made.
        what: String,
        /// What the device says.
        message: String,
    },
    /// Memory of the device is used up.
    #[error("out of graphics memory ({0})")]
    OutOfMemory(String),
    /// The device is gone: driver reset, unplugged, or hung.
    #[error("the graphics device was lost: {0}")]
    DeviceLost(String),
}

impl RenderError {
    /// What to do about it, where there is something.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::NoAdapter { found, .. } if !found.is_empty() => {
                Some(format!("choose one of: {}", found.join(", ")))
            }
            Self::NoAdapter { .. } => Some(
                "install a graphics driver; on Debian or Ubuntu `apt-get install mesa-vulkan-drivers libvulkan1` gives \
                 a software one that needs no graphics card"
                    .into(),
            ),
            Self::UnknownBackend(_) => Some("backends are vulkan, gl, metal and dx12, separated by commas".into()),
            Self::TooLarge { what, .. } if what.starts_with(UNIFORM_BLOCK) => {
                Some("use fewer parameters in one material: bake them, or leave nodes out".into())
            }
            Self::OutOfMemory(_) | Self::TooLarge { .. } => {
                Some("lower the size of the picture or of its maps, or the number of samples".into())
            }
            Self::Unsupported(what) if what.contains("formats") => {
                Some("choose another `format` in the options of what asks for the map; `auto` takes what there is".into())
            }
            Self::DeviceLost(_) => Some("try again, with a smaller picture or on another adapter".into()),
            _ => None,
        }
    }
}

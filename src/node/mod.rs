//! Node definitions read from WGSL files, and the catalogue of them.

mod definition;

pub use definition::{
    Choices, Default, Definition, Function, Header, Item, Library, MapSpec, OptionSpec, Port, SamplerSpec, SpaceSpec,
    TextureSpec,
};

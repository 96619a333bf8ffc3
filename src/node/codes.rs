//! The diagnostic codes of this module (ST100 to ST149), with what each means.

/// Code and explanation, ascending.
pub const CODES: &[(&str, &str)] = &[
    (
        "ST100",
        "A node file must say `//! label: ...` and `//! category: ...`.",
    ),
    (
        "ST101",
        "A header line or setting has a key that the format does not know.",
    ),
    ("ST102", "A header line does not follow its form."),
    ("ST103", "The category is not one of the families of nodes."),
    ("ST104", "The same thing is said twice."),
    (
        "ST105",
        "The default of an option is not among its choices.",
    ),
    (
        "ST106",
        "A header line names an input that no port line describes.",
    ),
    (
        "ST107",
        "A header line refers with `$` to an option that the file does not have.",
    ),
    ("ST108", "A `//!` line stands behind the header."),
    (
        "ST109",
        "The file name is not usable as the name of a WGSL function.",
    ),
    (
        "ST110",
        "Conditional text (`//#if` and so on) is malformed, or names unknown options or choices.",
    ),
    ("ST112", "A port line does not follow its form."),
    ("ST113", "A port line names a meaning that is not known."),
    (
        "ST114",
        "A default is not a value, or does not fit the shape of its port.",
    ),
    (
        "ST115",
        "A default asks for something that the compiler does not provide, or that has another shape.",
    ),
    (
        "ST116",
        "A range is malformed or empty, or does not hold the default.",
    ),
    ("ST117", "A port has two lines."),
    ("ST118", "A parameter or result has no port line."),
    ("ST119", "A port line describes no parameter or result."),
    ("ST120", "A name is a word that WGSL keeps for itself."),
    ("ST121", "The file has no function of the name of the file."),
    (
        "ST122",
        "A generic file lacks `alias T = ...;`, or the alias is not the first width.",
    ),
    (
        "ST123",
        "A file marked `inline` has a function whose body is not one `return`.",
    ),
    ("ST124", "WGSL text cannot be split into declarations."),
    (
        "ST125",
        "Something is declared that cannot stand here: entry points, bindings, module-scope variables.",
    ),
    ("ST126", "The WGSL parser rejects the text."),
    ("ST127", "The WGSL validator rejects the text."),
    ("ST128", "A `use:` line names a library that is not there."),
    ("ST130", "The text is too large, or nests too deeply."),
    (
        "ST131",
        "A declaration takes a name that WGSL or a library uses.",
    ),
    (
        "ST132",
        "A file redefines a node that comes with the program.",
    ),
    (
        "ST133",
        "A choice is made for an option that is not there, or that has no such choice.",
    ),
    ("ST135", "A function of a node returns nothing."),
    ("ST136", "The WGSL type of a port cannot carry its meaning."),
    (
        "ST137",
        "A hidden input has no default and nothing supplies it.",
    ),
    (
        "ST138",
        "The header of a fixed pass does not follow its form.",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ascending_and_in_range() {
        assert!(CODES.windows(2).all(|w| w[0].0 < w[1].0));
        assert!(CODES.iter().all(|(c, _)| ("ST100".."ST150").contains(c)));
    }
}

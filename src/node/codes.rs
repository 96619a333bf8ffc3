//! The diagnostic codes of this module (ST0100 to ST0149), with what each means.

/// Code and explanation, ascending.
pub const CODES: &[(&str, &str)] = &[
    ("ST0100", "A node file must say `//! label: ...` and `//! category: ...`."),
    ("ST0101", "A header line or setting has a key that the format does not know."),
    ("ST0102", "A header line does not follow its form."),
    ("ST0103", "The category is not one of the families of nodes."),
    ("ST0104", "The same thing is said twice."),
    ("ST0105", "The default of an option, or a choice of a cheaper form, is not among the choices of the option."),
    ("ST0106", "A header line names an input that no port line describes."),
    ("ST0107", "A header line refers with `$` to an option that the file does not have."),
    ("ST0108", "A `//!` line stands behind the header."),
    ("ST0109", "The file name is not usable as the name of a WGSL function."),
    ("ST0110", "Conditional text (`//#if` and so on) is malformed, or names unknown options or choices."),
    ("ST0112", "A port line does not follow its form."),
    ("ST0113", "A port line names a meaning that is not known."),
    ("ST0114", "A default is not a value, or does not fit the shape of its port."),
    ("ST0115", "A default asks for something that the compiler does not provide, or that has another shape."),
    ("ST0116", "A range is malformed or empty, or does not hold the default."),
    ("ST0117", "A port has two lines."),
    ("ST0118", "A parameter or result has no port line."),
    ("ST0119", "A port line describes no parameter or result."),
    ("ST0120", "A name is a word that WGSL keeps for itself."),
    ("ST0121", "The file has no function of the name of the file."),
    ("ST0122", "A generic file lacks `alias T = ...;`, or the alias is not the first width."),
    ("ST0123", "A file marked `inline` has a function whose body is not one `return`."),
    ("ST0124", "WGSL text cannot be split into declarations."),
    ("ST0125", "Something is declared that cannot stand here: entry points, bindings, module-scope variables."),
    ("ST0126", "The WGSL parser rejects the text."),
    ("ST0127", "The WGSL validator rejects the text."),
    ("ST0128", "A `use:` line names a library that is not there."),
    ("ST0130", "The text is too large, or nests too deeply."),
    ("ST0131", "A declaration takes a name that WGSL or a library uses."),
    ("ST0132", "A file redefines a node that comes with the program."),
    ("ST0133", "A choice is made for an option that is not there, or that has no such choice."),
    ("ST0135", "A function of a node returns nothing."),
    ("ST0136", "The WGSL type of a port cannot carry its meaning."),
    ("ST0137", "A hidden input has no default and nothing supplies it."),
    ("ST0138", "The header of a fixed pass does not follow its form."),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ascending_and_in_range() {
        assert!(CODES.windows(2).all(|w| w[0].0 < w[1].0));
        assert!(CODES.iter().all(|(c, _)| ("ST0100".."ST0150").contains(c)));
    }
}

//! label: Compare
//! category: logic
//! synonyms: less than, greater than, equal, comparison, if, condition, <, >, =
//! Whether one number stands in a relation to another.
//! option relation: less | less_equal | greater | greater_equal | equal | not_equal = greater - The relation of a to b.

/// a (number): The number that is asked about.
/// b (number; = 0.5): The number that it is compared with.
//#if relation == equal | not_equal
/// tolerance (scalar; = 0.0001; 0..): How far apart two equal numbers may be.
//#end
/// -> holds (bool): True where the relation holds.
//#if relation == equal | not_equal
fn compare(a: f32, b: f32, tolerance: f32) -> bool {
//#if relation == equal
    return abs(a - b) <= tolerance;
//#else
    return abs(a - b) > tolerance;
//#end
}
//#else
fn compare(a: f32, b: f32) -> bool {
//#if relation == less
    return a < b;
//#elif relation == less_equal
    return a <= b;
//#elif relation == greater
    return a > b;
//#else
    return a >= b;
//#end
}
//#end

//! label: Receives Shadow
//! category: geometry
//! synonyms: shadow receiver, receive shadows, object flag
//! inline
//! One where the object receives shadows, else zero.

/// receives (scalar; = @receives; hidden): The object's flag.
/// -> receives_shadow (scalar): 1 or 0.
fn receives_shadow(receives: f32) -> f32 {
    return receives;
}

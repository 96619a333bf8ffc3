//! label: Normal Map
//! category: geometry
//! synonyms: tangent space, normal texture, bump, relief
//! use: safe_normal
//! Turns the colour of a tangent-space normal map into a normal in the world. The image must be read as linear.
//! option green: up | down = up - Where the map's second channel points: up (OpenGL, glTF) or down (DirectX).
//! cheaper: input normal - The smooth surface.

/// color (color tangent signed01; = (0.5, 0.5, 1)): Colour of the map: 0..1 stands for -1..1.
/// strength (scalar; = 1; 0..4): How strongly the normal is bent: 0 not at all, 1 as the map says.
/// tangent (direction world near; = @tangent_world; hidden): First axis of the map.
/// bitangent (direction world near; = @bitangent_world; hidden): Second axis; carries the handedness of the map.
/// normal (normal world near; = @normal_world; hidden): Normal of the smooth surface.
/// -> normal (normal world unit): The bent normal.
fn normal_map(color: vec3f, strength: f32, tangent: vec3f, bitangent: vec3f, normal: vec3f) -> vec3f {
    let packed = color * 2.0 - 1.0;
//#if green == up
    let bend = packed.xy * strength;
//#else
    let bend = packed.xy * vec2f(strength, -strength);
//#end
    // A compressed or filtered map may have lost its third channel's sign; a normal never points into the surface.
    let height = max(packed.z, 1e-3);
    // The axes are used as interpolated, not made orthogonal: that is what map bakers assume (Mikkelsen 2008).
    let world = bend.x * tangent + bend.y * bitangent + height * normal;
    return unit_normal_or(world, unit_normal_or(normal, vec3f(0.0, 1.0, 0.0)));
}

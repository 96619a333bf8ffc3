//! label: Facing Ratio
//! category: geometry
//! synonyms: fresnel, layer weight, rim, edge, facing, view angle, falloff, incidence, fresnel effect
//! How much the surface turns away from the eye: 0 or little where it faces it, 1 at the silhouette.
//! Both sides of the surface count alike. The curve of a dielectric is the exact mean over both polarisations, for a
//! body that absorbs nothing (in the form of Cook and Torrance 1982); Schlick's is the fifth-power fit to it (1994).
//! option curve: facing | dielectric | schlick = facing - A plain bendable falloff, or the share of light that a clear body reflects.
//! cheaper: vertex - At the vertices, interpolated.

/// normal (normal world unit; = @normal_world): The normal that is looked at.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
//#if curve == facing
/// bend (scalar; = 0.5; 0..1): 0.5 falls off with the cosine; less keeps the weight near the silhouette, more spreads it over the middle.
/// -> weight (scalar): 0 facing the eye, 1 at the silhouette.
//#else
/// ior (scalar; = 1.5; 1..): Index of refraction: water 1.33, glass 1.5, diamond 2.42.
/// -> weight (scalar): Share of light that is reflected, 0..1.
//#end
//#if curve == facing
fn fresnel_facing(normal: vec3f, to_camera: vec3f, bend: f32) -> f32 {
    let cosine = clamp(abs(dot(normal, to_camera)), 0.0, 1.0);
    let b = clamp(bend, 0.0, 0.9999);
    let exponent = select(0.5 / (1.0 - b), 2.0 * b, b < 0.5);
    return 1.0 - pow(max(cosine, 1e-6), exponent);
}
//#elif curve == dielectric
fn fresnel_facing(normal: vec3f, to_camera: vec3f, ior: f32) -> f32 {
    let cosine = clamp(abs(dot(normal, to_camera)), 0.0, 1.0);
    let index = max(ior, 1.0);
    let g = sqrt(max(index * index - 1.0 + cosine * cosine, 0.0));
    let difference = g - cosine;
    let sum = g + cosine;
    let amplitude = difference / max(sum, 1e-6);
    let ratio = (cosine * sum - 1.0) / (cosine * difference + 1.0);
    return clamp(0.5 * amplitude * amplitude * (1.0 + ratio * ratio), 0.0, 1.0);
}
//#else
fn fresnel_facing(normal: vec3f, to_camera: vec3f, ior: f32) -> f32 {
    let cosine = clamp(abs(dot(normal, to_camera)), 0.0, 1.0);
    let amplitude = (ior - 1.0) / max(ior + 1.0, 1e-6);
    let facing = amplitude * amplitude;
    let grazing = 1.0 - cosine;
    let grazing_squared = grazing * grazing;
    return facing + (1.0 - facing) * grazing_squared * grazing_squared * grazing;
}
//#end

//! label: Temperature
//! category: color
//! synonyms: blackbody, kelvin, color temperature, white balance, light color, warm, cool, incandescent
//! use: rec709
//! The colour of a glowing black body.
//! Chromaticity from the cubic fit to the Planckian locus by Kim et al. (US patent 7024034, 2006), good from 1667 to
//! 25000 K; then linear sRGB (IEC 61966-2-1 primaries, so 6500 K is nearly white), with what the screen cannot show cut off.
//! option scale: peak | luminance = peak - The greatest component is 1, as for a tint; or the luminance is 1, so that a light keeps its brightness.

/// kelvin (scalar; = 6500; 1667..25000): Temperature in kelvin: candle 1900, bulb 2700, noon 5500, overcast 6500, blue sky 10000.
/// -> color (color linear): The tint.
fn temperature(kelvin: f32) -> vec3f {
    let t = clamp(kelvin, 1667.0, 25000.0);
    let u = 1000.0 / t;
    let warm_x = ((-0.2661239 * u - 0.2343589) * u + 0.8776956) * u + 0.179910;
    let cool_x = ((-3.0258469 * u + 2.1070379) * u + 0.2226347) * u + 0.240390;
    let x = select(cool_x, warm_x, t <= 4000.0);
    let red_y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683;
    let warm_y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867;
    let cool_y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    let y = select(select(cool_y, warm_y, t <= 4000.0), red_y, t <= 2222.0);
    let big_x = x / y;
    let big_z = (1.0 - x - y) / y;
    let tint = max(
        vec3f(
            3.2404542 * big_x - 1.5371385 - 0.4985314 * big_z,
            -0.9692660 * big_x + 1.8760108 + 0.0415560 * big_z,
            0.0556434 * big_x - 0.2040259 + 1.0572252 * big_z,
        ),
        vec3f(0.0),
    );
//#if scale == peak
    return tint / max(max(tint.r, tint.g), tint.b);
//#else
    return tint / luminance_rec709(tint);
//#end
}

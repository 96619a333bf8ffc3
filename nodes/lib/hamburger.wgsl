//! The least shadow that four moments of depth allow (Peters and Klein 2015, the Hamburger moment problem).

/// Moments 1 to 4 of depth in [-1, 1], mixed by a linear map whose results use [0, 1] evenly: 16 bits then round less. With
/// x = depth: 3/2 x - 2 x^3 and sqrt(3)/2 x - 2 sqrt(3)/9 x^3 lie within 1/2 of 0, 4 x^2 - 4 x^4 and (x^2 + x^4) / 2 in [0, 1].
fn encode_moments(moments: vec4f) -> vec4f {
    return vec4f(
        1.5 * moments.x - 2.0 * moments.z + 0.5,
        4.0 * (moments.y - moments.w),
        0.8660254 * moments.x - 0.3849002 * moments.z + 0.5,
        0.5 * (moments.y + moments.w),
    );
}

/// The inverse.
fn decode_moments(encoded: vec4f) -> vec4f {
    let odd = encoded.xz - 0.5;
    return vec4f(
        -0.3333333 * odd.x + 1.7320508 * odd.y,
        0.125 * encoded.y + encoded.w,
        -0.75 * odd.x + 1.2990381 * odd.y,
        -0.125 * encoded.y + encoded.w,
    );
}

/// Visibility at `depth` in [-1, 1]: 1 minus the least share of occluders in front of it that distributions with these
/// moments have. Exact for up to two occluder depths beside the receiver's. The moments must be those of no fewer than three
/// depths; mix a few millionths of a wide distribution in before.
fn hamburger_visibility(moments: vec4f, depth: f32) -> f32 {
    let b = moments;
    // B = L D L^T with B = (1, b1, b2; b1, b2, b3; b2, b3, b4). Rounding must not turn a pivot negative.
    let pivot_2 = max(b.y - b.x * b.x, 1e-9);
    let scaled = b.z - b.x * b.y;
    let low = scaled / pivot_2;
    let pivot_3 = max(b.w - b.y * b.y - scaled * low, 1e-10);
    // B c = (1, depth, depth^2): then c1 + c2 x + c3 x^2 vanishes at the two other depths of the distribution with fewest
    // depths that has one at the receiver.
    let u_2 = depth - b.x;
    let u_3 = depth * depth - b.y - low * u_2;
    let c_3 = u_3 / pivot_3;
    let c_2 = u_2 / pivot_2 - low * c_3;
    let c_1 = 1.0 - b.x * c_2 - b.y * c_3;
    // Both roots without cancellation.
    let root = sqrt(max(c_2 * c_2 - 4.0 * c_1 * c_3, 0.0));
    let sum = -0.5 * (c_2 + select(-root, root, c_2 >= 0.0));
    let one = sum / select(c_3, select(-1e-20, 1e-20, c_3 >= 0.0), abs(c_3) < 1e-20);
    let other = c_1 / select(sum, 1e-20, abs(sum) < 1e-20);
    let near = min(one, other);
    let far = max(one, other);
    // Between them the nearer one's share is shadow; behind both, all but the receiver's share.
    let nearer = (depth * far - b.x * (depth + far) + b.y) / ((near - depth) * min(near - far, -1e-7));
    let own = (near * far - b.x * (near + far) + b.y) / max((depth - near) * (depth - far), 1e-12);
    let lit = select(saturate(1.0 - nearer), saturate(own), depth > far);
    return select(lit, 1.0, depth <= near);
}

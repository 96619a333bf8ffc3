//! Triangles in a tree of boxes, in float64.

mod build;

use glam::DVec3;

use super::ray::{Ray, Sheared};

/// Most levels of the tree: see [`build`].
const MAX_DEPTH: usize = 96;
/// What a box is widened by, as a part of the distance to it: three roundings (Ize 2013, "Robust BVH Ray Traversal").
const WIDEN: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Triangles that can be asked what a ray meets.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    /// In the order of the leaves.
    triangles: Vec<[DVec3; 3]>,
    /// Number of each of them as they were given.
    numbers: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// The first triangle of a leaf; the second child of another node, whose first child follows it.
    first: u32,
    /// Triangles of a leaf; 0 for others.
    count: u32,
}

impl Bvh {
    /// A tree over triangles. Those without area or with a corner that is not finite are met by no ray.
    pub fn new(triangles: &[[DVec3; 3]]) -> Self {
        build::build(triangles)
    }

    /// The nearest triangle that a ray meets: its distance and number.
    pub fn nearest(&self, ray: &Ray) -> Option<(f64, u32)> {
        self.search(ray, false)
    }

    /// Whether a ray meets any triangle.
    pub fn meets(&self, ray: &Ray) -> bool {
        self.search(ray, true).is_some()
    }

    /// Goes down the tree without recursion, nearer boxes first.
    fn search(&self, ray: &Ray, any: bool) -> Option<(f64, u32)> {
        let root = self.nodes.first()?;
        let sheared = Sheared::new(ray);
        // A direction of zero along an axis must neither divide by zero nor make 0 * infinity of a flat box.
        let inverse = ray.direction.map(|d| if d.abs() < 1e-300 { 1e300_f64.copysign(d) } else { d.recip() });
        let mut found = None;
        let mut far = ray.far;
        let mut open = [(0_u32, 0.0_f64); MAX_DEPTH];
        let mut count = usize::from(root.entered(ray, inverse, far).is_some());
        while count > 0 {
            count -= 1;
            let (index, entered) = open[count];
            if entered > far {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                for i in node.first as usize..(node.first + node.count) as usize {
                    let Some(t) = sheared.meets(&self.triangles[i]) else { continue };
                    if t >= ray.near && t <= far {
                        found = Some((t, self.numbers[i]));
                        far = t;
                        if any {
                            return found;
                        }
                    }
                }
                continue;
            }
            let children = [index + 1, node.first];
            let entered = children.map(|child| self.nodes[child as usize].entered(ray, inverse, far));
            let farther = usize::from(entered[1].unwrap_or(f64::INFINITY) >= entered[0].unwrap_or(f64::INFINITY));
            for side in [farther, 1 - farther] {
                if let Some(distance) = entered[side] {
                    open[count] = (children[side], distance);
                    count += 1;
                }
            }
        }
        found
    }
}

impl Node {
    /// Where a ray enters the box, if it does before `far`.
    fn entered(&self, ray: &Ray, inverse: DVec3, far: f64) -> Option<f64> {
        let (a, b) = ((self.low - ray.origin) * inverse, (self.high - ray.origin) * inverse);
        let enters = a.min(b).max_element().max(ray.near);
        let leaves = (a.max(b).min_element() * WIDEN).min(far);
        (enters <= leaves).then_some(enters)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn brute(triangles: &[[DVec3; 3]], ray: &Ray) -> Option<f64> {
        let sheared = Sheared::new(ray);
        let distances = triangles.iter().filter_map(|t| sheared.meets(t));
        distances.filter(|t| (ray.near..=ray.far).contains(t)).min_by(f64::total_cmp)
    }

    /// Small whole numbers: many corners, faces and rays along the axes coincide.
    fn coarse() -> impl Strategy<Value = DVec3> {
        [-4..5_i32, -4..5, -4..5].prop_map(|p| DVec3::from_array(p.map(f64::from)) * 0.5)
    }

    fn fine() -> impl Strategy<Value = DVec3> {
        [-2.0..2.0, -2.0..2.0, -2.0..2.0_f64].prop_map(DVec3::from_array)
    }

    fn point() -> impl Strategy<Value = DVec3> {
        prop_oneof![coarse(), fine()]
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]
        #[test]
        fn the_tree_finds_what_looking_at_every_triangle_finds(
            triangles in prop::collection::vec([point(), point(), point()], 0..80),
            rays in prop::collection::vec((point(), point(), 0.0..1.0_f64, 0.5..4.0_f64), 40),
        ) {
            let tree = Bvh::new(&triangles);
            for (origin, direction, near, far) in rays {
                prop_assume!(direction != DVec3::ZERO);
                let ray = Ray { origin, direction, near, far };
                let expected = brute(&triangles, &ray);
                let found = tree.nearest(&ray);
                prop_assert_eq!(found.map(|f| f.0), expected);
                prop_assert_eq!(tree.meets(&ray), expected.is_some());
                if let Some((t, number)) = found {
                    prop_assert_eq!(Sheared::new(&ray).meets(&triangles[number as usize]), Some(t));
                }
            }
        }
    }

    #[test]
    fn hostile_triangles_neither_hang_nor_overflow_the_stack() {
        let one = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let ray = Ray { origin: DVec3::new(0.2, 0.2, 1.0), direction: DVec3::NEG_Z, near: 0.0, far: 9.0 };
        assert_eq!(Bvh::new(&vec![one; 5000]).nearest(&ray).map(|f| f.0), Some(1.0));
        // Each is half as far from the origin as the one before: every split by space takes off one.
        let halved: Vec<_> = (0..2000).map(|i| one.map(|p| (p + DVec3::ONE) * 0.5_f64.powi(i % 1000))).collect();
        let tree = Bvh::new(&halved);
        let found = tree.nearest(&Ray { origin: DVec3::new(1.2, 1.2, 5.0), ..ray });
        assert_eq!(found.map(|f| f.0), Some(4.0));
        let broken = [one.map(|p| p * f64::NAN), one.map(|p| p * f64::INFINITY), [DVec3::X; 3], one];
        assert_eq!(Bvh::new(&broken).nearest(&ray), Some((1.0, 3)));
        assert_eq!(Bvh::new(&[]).nearest(&ray), None);
    }
}

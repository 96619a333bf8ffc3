//! Lights as rays and maps need them.

use glam::DVec3;

use super::source::Source;
use super::view::View;
use super::world::World;

/// A light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// What shines.
    pub source: Source,
    /// The views of its maps: one, or several that share out what it shines on. The first that holds a point counts.
    pub views: Vec<View>,
    /// Whether it shines within its views alone. Then points outside count as lit, as nothing can be seen of a shadow there.
    pub bounded: bool,
}

impl Light {
    /// The light whose maps are made in a projection that a light node names, from its inputs in their order, in metres
    /// and radians: `perspective` (position, direction, half angle, near, range) or `orthographic` (direction, center,
    /// radius; 0 fits the world). Answers what is wrong, as a sentence.
    pub fn projected(projection: &str, inputs: &[Vec<f64>], world: &World) -> Result<Self, String> {
        let vector = |i: usize| match inputs.get(i).map(Vec::as_slice) {
            Some(&[x, y, z]) if [x, y, z].iter().all(|c| c.is_finite()) => Ok(DVec3::new(x, y, z)),
            _ => Err(format!("input number {} of the projection is not a vector", i + 1)),
        };
        let number = |i: usize| match inputs.get(i).map(Vec::as_slice) {
            Some(&[x]) if x.is_finite() => Ok(x),
            _ => Err(format!("input number {} of the projection is not a number", i + 1)),
        };
        let axis = |i: usize| vector(i).and_then(|v| v.try_normalize().ok_or("its direction has no length".to_owned()));
        match projection {
            "perspective" => {
                let (position, axis, half, near) = (vector(0)?, axis(1)?, number(2)?, number(3)?);
                if half <= 0.0 || half >= std::f64::consts::FRAC_PI_2 {
                    return Err("its cone must open by more than 0 and less than 90 degrees to each side".into());
                }
                let view = View::perspective(position, axis, half, near);
                Ok(Self { source: Source::Point { position }, views: vec![view], bounded: true })
            }
            "orthographic" => {
                let (axis, mut center, mut radius) = (axis(0)?, vector(1)?, number(2)?);
                if radius < 0.0 {
                    return Err("its radius is negative".into());
                }
                let (middle, size) = world.ball();
                if radius == 0.0 {
                    (center, radius) = (middle, size.max(1e-6));
                }
                // Wherever the map is, everything towards the light stands in it.
                let near = (middle - center).dot(axis) - size * 1.001;
                let view = View::parallel(center, axis, radius, near);
                Ok(Self { source: Source::Distant { direction: axis, angle: 0.0 }, views: vec![view], bounded: false })
            }
            other => Err(format!("`{other}` is not a projection")),
        }
    }

    /// A light that shines from a point into all directions.
    pub fn point(position: DVec3) -> Self {
        Self { source: Source::Point { position }, views: View::cube(position, 0.0).into(), bounded: false }
    }

    /// The number of the first view that holds a point.
    pub fn view_of(&self, point: DVec3) -> Option<usize> {
        self.views.iter().position(|v| v.holds(v.point(point)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_are_made_from_the_inputs_of_their_nodes() {
        let world = World::new(&[]);
        let down = vec![0.0, -2.0, 0.0];
        let spot = [vec![0.0, 4.0, 0.0], down.clone(), vec![0.5], vec![0.1], vec![9.0]];
        let light = Light::projected("perspective", &spot, &world).expect("a spot light");
        assert!(light.bounded && light.source == Source::Point { position: DVec3::Y * 4.0 });
        assert_eq!(light.view_of(DVec3::X), Some(0));
        assert_eq!(light.view_of(DVec3::X * 3.0), None);
        let sun = [down.clone(), vec![0.0; 3], vec![0.0]];
        let light = Light::projected("orthographic", &sun, &world).expect("a sun");
        assert_eq!((light.view_of(DVec3::new(0.9, 0.5, -0.9)), light.view_of(DVec3::X * 1.1)), (Some(0), None));
        for (name, inputs) in [
            ("perspective", vec![vec![0.0; 3], vec![0.0; 3], vec![0.5], vec![0.1]]),
            ("perspective", vec![vec![0.0; 3], down.clone(), vec![1.6], vec![0.1]]),
            ("orthographic", vec![down.clone(), vec![0.0; 3], vec![-1.0]]),
            ("orthographic", vec![down.clone(), vec![f64::NAN; 3], vec![1.0]]),
            ("orthographic", vec![down]),
            ("fish_eye", vec![]),
        ] {
            assert!(Light::projected(name, &inputs, &world).is_err(), "{name} {inputs:?}");
        }
    }
}

//! Lights as rays and maps need them.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::source::Source;
use super::view::View;
use super::world::World;

/// A light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// What shines.
    pub source: Source,
    /// The views of its maps: one, or several that share out what it shines on.
    pub views: Vec<View>,
    /// Which of them is looked at.
    pub choice: Choice,
    /// Whether it shines within its views alone. Then points outside count as lit, as nothing can be seen of a shadow there.
    pub bounded: bool,
}

/// Which of several views a point is looked up in.
#[derive(Clone, Debug, PartialEq)]
pub enum Choice {
    /// The one that sees it nearest to its axis: faces of a cube, which are wider than a right angle.
    Axis,
    /// The first one that holds it.
    First,
    /// The one for its distance from an eye.
    Distance {
        /// The eye.
        eye: DVec3,
        /// The direction that it looks in, of length 1.
        forward: DVec3,
        /// Distances at which all parts but the last end.
        ends: Vec<f64>,
    },
}

impl Light {
    /// The light whose maps are made in a projection that a light node names, from its inputs in their order, in metres
    /// and radians:
    ///
    /// * `perspective`: position, direction, half angle, near, range, radius of the shining ball;
    /// * `rectangle`: as before, but with width and height of what shines, along x and y of the view;
    /// * `cube`: position, near, range, radius of the shining ball;
    /// * `orthographic`: direction, center, radius of what is covered (0 fits the world), angle from the middle of the light
    ///   to its rim.
    ///
    /// Answers what is wrong, as a sentence.
    pub fn projected(projection: &str, inputs: &[Vec<f64>], world: &World) -> Result<Self, String> {
        let inputs = Inputs(inputs);
        let one = |source, view, bounded| Self { source, views: vec![view], choice: Choice::First, bounded };
        match projection {
            "perspective" => {
                let view = inputs.cone()?;
                Ok(one(Source::Ball { center: view.origin, radius: inputs.length(5)? }, view, true))
            }
            "rectangle" => {
                let view = inputs.cone()?;
                let axes = view.rotation.transpose();
                let half = [axes.x_axis * (inputs.length(5)? / 2.0), axes.y_axis * (inputs.length(6)? / 2.0)];
                Ok(one(Source::Rectangle { center: view.origin, half }, view, true))
            }
            "cube" => {
                let (center, near) = (inputs.vector(0)?, inputs.length(1)?);
                let source = Source::Ball { center, radius: inputs.length(3)? };
                Ok(Self { source, views: View::cube(center, near).into(), choice: Choice::Axis, bounded: false })
            }
            "orthographic" => {
                let (axis, mut center, mut radius) = (inputs.axis(0)?, inputs.vector(1)?, inputs.length(2)?);
                let (middle, size) = world.ball();
                if radius == 0.0 {
                    (center, radius) = (middle, size.max(1e-6));
                }
                let angle = inputs.length(3)?;
                if angle >= FRAC_PI_2 {
                    return Err("its light comes from half of the sky or more".into());
                }
                // Wherever the map is, everything towards the light stands in it.
                let near = (middle - center).dot(axis) - size * 1.001;
                Ok(one(Source::Distant { direction: axis, angle }, View::parallel(center, axis, radius, near), false))
            }
            other => Err(format!("`{other}` is not a projection")),
        }
    }

    /// The number of the view that a point is looked up in, if that holds it.
    pub fn view_of(&self, point: DVec3) -> Option<usize> {
        let holds = |i: &usize| self.views[*i].holds(self.views[*i].point(point));
        let mut all = 0..self.views.len();
        match &self.choice {
            Choice::First => all.find(holds),
            Choice::Distance { eye, forward, ends } => {
                let distance = (point - eye).dot(*forward);
                Some(ends.iter().filter(|end| distance > **end).count()).filter(holds)
            }
            Choice::Axis => {
                let depth = |i: usize| self.views[i].point(point).z;
                all.reduce(|a, b| if depth(b) > depth(a) { b } else { a }).filter(holds)
            }
        }
    }
}

/// Inputs of a projection, by number.
struct Inputs<'a>(&'a [Vec<f64>]);

impl Inputs<'_> {
    fn vector(&self, index: usize) -> Result<DVec3, String> {
        match self.0.get(index).map(Vec::as_slice) {
            Some(&[x, y, z]) if [x, y, z].iter().all(|c| c.is_finite()) => Ok(DVec3::new(x, y, z)),
            _ => Err(format!("input number {} of its projection is not a vector", index + 1)),
        }
    }

    fn axis(&self, index: usize) -> Result<DVec3, String> {
        self.vector(index)?.try_normalize().ok_or("its direction has no length".into())
    }

    /// A number that is not negative.
    fn length(&self, index: usize) -> Result<f64, String> {
        match self.0.get(index).map(Vec::as_slice) {
            Some(&[x]) if x.is_finite() && x >= 0.0 => Ok(x),
            Some(&[x]) if x.is_finite() => Err(format!("input number {} of its projection is negative", index + 1)),
            _ => Err(format!("input number {} of its projection is not a number", index + 1)),
        }
    }

    /// The view of a light that shines into a cone.
    fn cone(&self) -> Result<View, String> {
        let (position, axis, half, near) = (self.vector(0)?, self.axis(1)?, self.length(2)?, self.length(3)?);
        if half <= 0.0 || half >= FRAC_PI_2 {
            return Err("its cone must open by more than 0 and less than 90 degrees to each side".into());
        }
        Ok(View::perspective(position, axis, half, near))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_are_made_from_the_inputs_of_their_nodes() {
        let world = World::new(&[]);
        let down = vec![0.0, -2.0, 0.0];
        let cone = [vec![0.0, 4.0, 0.0], down.clone(), vec![0.5], vec![0.1], vec![9.0], vec![0.2], vec![0.6]];
        let light = Light::projected("perspective", &cone[..6], &world).expect("a spot light");
        assert!(light.bounded && light.source == Source::Ball { center: DVec3::Y * 4.0, radius: 0.2 });
        assert_eq!(light.view_of(DVec3::X), Some(0));
        assert_eq!(light.view_of(DVec3::X * 3.0), None);
        let light = Light::projected("rectangle", &cone, &world).expect("a window");
        assert_eq!(light.source, Source::Rectangle { center: DVec3::Y * 4.0, half: [DVec3::X * 0.1, DVec3::Z * 0.3] });
        let sun = [down.clone(), vec![0.0; 3], vec![0.0], vec![0.005]];
        let light = Light::projected("orthographic", &sun, &world).expect("a sun");
        assert_eq!((light.view_of(DVec3::new(0.9, 0.5, -0.9)), light.view_of(DVec3::X * 1.1)), (Some(0), None));
        for (name, inputs) in [
            ("perspective", vec![vec![0.0; 3], vec![0.0; 3], vec![0.5], vec![0.1], vec![1.0], vec![0.0]]),
            ("perspective", vec![vec![0.0; 3], down.clone(), vec![1.6], vec![0.1], vec![1.0], vec![0.0]]),
            ("perspective", cone[..5].to_vec()),
            ("cube", vec![vec![0.0; 3], vec![-0.1], vec![1.0], vec![0.0]]),
            ("orthographic", vec![down.clone(), vec![0.0; 3], vec![-1.0], vec![0.0]]),
            ("orthographic", vec![down.clone(), vec![f64::NAN; 3], vec![1.0], vec![0.0]]),
            ("orthographic", vec![down.clone(), vec![0.0; 3], vec![1.0], vec![1.6]]),
            ("orthographic", vec![down]),
            ("fish_eye", vec![]),
        ] {
            assert!(Light::projected(name, &inputs, &world).is_err(), "{name} {inputs:?}");
        }
    }

    #[test]
    fn points_are_looked_up_in_the_face_that_they_are_nearest_to_the_axis_of() {
        let cube = [vec![1.0, 2.0, 3.0], vec![0.1], vec![9.0], vec![0.0]];
        let light = Light::projected("cube", &cube, &World::new(&[])).expect("a lamp");
        let face = |x: f64, y: f64, z: f64| light.view_of(DVec3::new(1.0 + x, 2.0 + y, 3.0 + z));
        assert_eq!([face(1.0, 0.99, 0.0), face(-1.0, 0.2, 0.3), face(0.99, 1.0, 0.0)], [Some(0), Some(1), Some(2)]);
        assert_eq!([face(0.1, -1.0, 0.0), face(-1.0, 0.2, 1.3), face(0.9, 0.9, -1.0)], [Some(3), Some(4), Some(5)]);
        assert_eq!(face(0.01, 0.05, 0.0), None, "in front of the near plane");
    }
}

//! Which of a light's views sees the shaded point.

use super::{Id, Op, Program, Resource};
use crate::semantic::Shape;

impl Program {
    /// The `LightSpace` of the view that a light has of the shaded point: the only one, or one chosen per pixel.
    pub(crate) fn view_of_light(&mut self, light: usize, origin: Option<usize>) -> Id {
        let short = self.nodes[light].short.clone();
        let all = self.add(Op::Resource(Resource::Space(light)), Vec::new(), &format!("{short}_space"), origin);
        let definition = self.nodes[light].definition.clone();
        let Some(spec) = definition.header.space.as_ref() else { return all };
        let views = spec.views(&definition);
        if views == 1 {
            return all;
        }
        let selector = spec.selector(&definition);
        let index = if selector == Some("cube_view") {
            let point = self.source("position_world");
            self.template("cube_view($0[0], $1)", vec![all, point], &format!("{short}_face"), origin)
        } else {
            // The number of splits that end before the point.
            let passed: Vec<String> = (0..views - 1).map(|i| format!("u32($1 > $0[{i}].depth.w)")).collect();
            let passed = passed.join(" + ");
            let text = match selector {
                Some(function) => format!("{function}({passed})"),
                None => passed,
            };
            let depth = self.source("depth");
            self.template(&text, vec![all, depth], &format!("{short}_split"), origin)
        };
        let index = self.shaped(index, Shape::U32);
        let view = self.template("$0[$1]", vec![all, index], &format!("{short}_view"), origin);
        self.shaped(view, Shape::Named("LightSpace".into()))
    }
}

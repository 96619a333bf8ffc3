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
        let index = self.view_index(light, all, views, spec.selector(&definition), origin);
        self.view_at(light, all, index, origin)
    }

    /// The `LightSpace` of the view that takes over from the one that sees the shaded point, and the share that it has.
    pub(crate) fn next_view_of_light(&mut self, light: usize, origin: Option<usize>) -> Option<(Id, Id)> {
        let definition = self.nodes[light].definition.clone();
        let spec = definition.header.space.as_ref().filter(|s| s.blends(&definition))?;
        let views = spec.views(&definition);
        let short = self.nodes[light].short.clone();
        let all = self.add(Op::Resource(Resource::Space(light)), Vec::new(), &format!("{short}_space"), origin);
        let index = self.view_index(light, all, views, spec.selector(&definition), origin);
        let here = self.view_at(light, all, index, origin);
        let depth = self.source("depth");
        let share = self.template("split_blend($0, $1)", vec![here, depth], &format!("{short}_blend"), origin);
        let share = self.shaped(share, Shape::F32(1));
        let text = format!("min($0 + 1u, {}u)", views - 1);
        let next = self.template(&text, vec![index], &format!("{short}_next_split"), origin);
        let next = self.shaped(next, Shape::U32);
        Some((self.view_at(light, all, next, origin), share))
    }

    /// What a shadow says in two views, mixed by the share of the second.
    pub(crate) fn mix(&mut self, here: Id, there: Id, share: Id) -> Id {
        let (shape, name) = (self.get(here).shape.clone(), format!("{}_mixed", self.get(here).name));
        let mixed = self.template("mix($0, $1, $2)", vec![here, there, share], &name, None);
        match shape {
            Some(shape) => self.shaped(mixed, shape),
            None => mixed,
        }
    }

    fn view_at(&mut self, light: usize, all: Id, index: Id, origin: Option<usize>) -> Id {
        let name = format!("{}_view", self.nodes[light].short);
        let view = self.template("$0[$1]", vec![all, index], &name, origin);
        self.shaped(view, Shape::Named("LightSpace".into()))
    }

    /// The number of the view that sees the shaded point.
    fn view_index(&mut self, light: usize, all: Id, views: u32, selector: Option<&str>, origin: Option<usize>) -> Id {
        let short = self.nodes[light].short.clone();
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
        self.shaped(index, Shape::U32)
    }
}

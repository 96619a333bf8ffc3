//! Which of a light's views sees the shaded point.

use super::{Id, NodeInfo, Op, Program, Resource};
use crate::semantic::Shape;

impl Program {
    /// The `LightSpace` of the view that a light has of the shaded point: the only one, or one chosen per pixel.
    pub(crate) fn view_of_light(&mut self, light: usize, origin: Option<usize>) -> Id {
        let all = self.all_views(light, origin);
        match self.view_index(light, all, origin) {
            Some(index) => self.view_at(light, all, index, origin),
            None => all,
        }
    }

    /// The `LightSpace` of the view that takes over from the one that sees the shaded point, and the share that it has.
    pub(crate) fn next_view_of_light(&mut self, light: usize, origin: Option<usize>) -> Option<(Id, Id)> {
        let NodeInfo { definition, short, .. } = self.nodes[light].clone();
        let spec = definition.header.space.as_ref().filter(|s| s.blends(&definition))?;
        let all = self.all_views(light, origin);
        let index = self.view_index(light, all, origin)?;
        let here = self.view_at(light, all, index, origin);
        let depth = self.source("depth");
        let share = self.template("split_blend($0, $1)", vec![here, depth], &format!("{short}_blend"), origin);
        let share = self.shaped(share, Shape::F32(1));
        let text = format!("min($0 + 1u, {}u)", spec.views(&definition) - 1);
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

    /// What the host fills: one `LightSpace`, or an array of them.
    fn all_views(&mut self, light: usize, origin: Option<usize>) -> Id {
        let name = format!("{}_space", self.nodes[light].short);
        self.add(Op::Resource(Resource::Space(light)), Vec::new(), &name, origin)
    }

    /// The number of the view that sees the shaded point, where there are several.
    fn view_index(&mut self, light: usize, all: Id, origin: Option<usize>) -> Option<Id> {
        let NodeInfo { definition, short, .. } = self.nodes[light].clone();
        let spec = definition.header.space.as_ref()?;
        let views = spec.views(&definition);
        if views == 1 {
            return None;
        }
        let index = if spec.selector(&definition) == Some("cube_view") {
            let point = self.source("position_world");
            self.template("cube_view($0[0], $1)", vec![all, point], &format!("{short}_face"), origin)
        } else {
            // The number of splits that end before the point.
            let passed: Vec<String> = (0..views - 1).map(|i| format!("u32($1 > $0[{i}].depth.w)")).collect();
            let passed = passed.join(" + ");
            let text = match spec.selector(&definition) {
                Some(function) => format!("{function}({passed})"),
                None => passed,
            };
            let depth = self.source("depth");
            self.template(&text, vec![all, depth], &format!("{short}_split"), origin)
        };
        Some(self.shaped(index, Shape::U32))
    }
}

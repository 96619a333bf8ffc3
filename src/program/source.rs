//! What the compiler provides to inputs that ask for it: each source as an expression over varyings and blocks.

use super::{Id, Op, Program, Resource, Varying};

impl Program {
    /// The expression of the source `name` (without the `@`).
    pub(crate) fn source(&mut self, name: &str) -> Id {
        let varying = |v| (Op::Varying(v), Vec::new());
        let (op, operands) = match name {
            "position_world" => varying(Varying::PositionWorld),
            "position_object" => varying(Varying::PositionObject),
            "normal_world" => varying(Varying::NormalWorld),
            "normal_object" => varying(Varying::NormalObject),
            "texcoord" => varying(Varying::Texcoord),
            "vertex_color" => varying(Varying::VertexColor),
            "tangent_world" => return self.of("$0.xyz", &[Op::Varying(Varying::TangentWorld)], name),
            "tangent_object" => return self.of("$0.xyz", &[Op::Varying(Varying::TangentObject)], name),
            "bitangent_world" => {
                let leaves = [Op::Varying(Varying::NormalWorld), Op::Varying(Varying::TangentWorld)];
                return self.of("cross($0, $1.xyz) * $1.w", &leaves, name);
            }
            "to_camera" => {
                let leaves = [Op::Frame("camera_position"), Op::Varying(Varying::PositionWorld)];
                return self.of("normalize($0 - $1)", &leaves, name);
            }
            "depth" => {
                let leaves =
                    [Op::Frame("camera_forward"), Op::Varying(Varying::PositionWorld), Op::Frame("camera_position")];
                return self.of("dot($0, $1 - $2)", &leaves, name);
            }
            "pixel" => return self.of("$0.xy", &[Op::Input("clip_position")], name),
            "front_facing" => (Op::Input("front_facing"), Vec::new()),
            "camera_position" => (Op::Frame("camera_position"), Vec::new()),
            "camera_forward" => (Op::Frame("camera_forward"), Vec::new()),
            "time" => (Op::Frame("time"), Vec::new()),
            "world_to_view" => (Op::Frame("world_to_view"), Vec::new()),
            "world_to_clip" => (Op::Frame("world_to_clip"), Vec::new()),
            "environment_levels" => (Op::Frame("environment_levels"), Vec::new()),
            "environment_irradiance" => (Op::Frame("environment_irradiance"), Vec::new()),
            "receives" => (Op::Object("receives"), Vec::new()),
            "object_to_world" => (Op::Object("object_to_world"), Vec::new()),
            "world_to_object" => (Op::Object("world_to_object"), Vec::new()),
            "environment" => (Op::Resource(Resource::Environment), Vec::new()),
            "environment_sampler" => (Op::Resource(Resource::EnvironmentSampler), Vec::new()),
            // The table of sources in `node` has no other names; a test holds the two together.
            _ => (Op::Literal("0.0".into()), Vec::new()),
        };
        self.add(op, operands, name, None)
    }

    fn of(&mut self, text: &str, leaves: &[Op], name: &str) -> Id {
        let operands = leaves.iter().map(|op| self.add(op.clone(), Vec::new(), name, None)).collect();
        let id = self.template(text, operands, name, None);
        match crate::node::source(name) {
            Some(source) => self.shaped(id, source.ty.shape.clone()),
            None => id,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_source_has_an_expression() {
        for source in crate::node::sources() {
            let mut program = Program::default();
            let id = program.source(source.name);
            assert!(!matches!(program.get(id).op, Op::Literal(_)), "{}", source.name);
        }
    }
}

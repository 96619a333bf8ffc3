//! How often loops turn, where their text says so: a counter that starts at a number, is compared with a number, and moves
//! by a number. That is what `for (var i = 0; i < COUNT; i++)` becomes.

use naga::{BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, Module, Statement};

/// More turns than a shader has; a loop that claims more is counted as this many.
const MOST: i64 = 4096;

/// The turns of a loop whose body and end are these; `before` is what stands before it in its own block. One where it
/// cannot be told.
pub(super) fn turns(
    module: &Module,
    function: &Function,
    before: &[&Statement],
    (body, continuing): (&Block, &Block),
) -> u32 {
    let look = Look { module, function };
    let known = look.bound(body).and_then(|(counter, operator, bound)| {
        let start = look.start(counter, before)?;
        let step = look.step(counter, continuing)?;
        count(start, step, operator, bound)
    });
    known.map_or(1, |n| u32::try_from(n.clamp(1, MOST)).unwrap_or(1))
}

/// How many values a counter takes before the comparison fails.
fn count(start: i64, step: i64, operator: BinaryOperator, bound: i64) -> Option<i64> {
    let (distance, stride) = match operator {
        BinaryOperator::Less => (bound.checked_sub(start)?, step),
        BinaryOperator::LessEqual => (bound.checked_sub(start)?.checked_add(1)?, step),
        BinaryOperator::Greater => (start.checked_sub(bound)?, step.checked_neg()?),
        BinaryOperator::GreaterEqual => (start.checked_sub(bound)?.checked_add(1)?, step.checked_neg()?),
        _ => return None,
    };
    (stride > 0).then(|| (distance.max(0) + stride - 1) / stride)
}

struct Look<'a> {
    module: &'a Module,
    function: &'a Function,
}

impl<'a> Look<'a> {
    fn get(&self, handle: Handle<Expression>) -> &'a Expression {
        &self.function.expressions[handle]
    }

    /// A whole number that is written, or named by a constant.
    fn number(&self, handle: Handle<Expression>) -> Option<i64> {
        let whole = |literal: &Literal| match literal {
            Literal::I32(n) => Some(i64::from(*n)),
            Literal::U32(n) => Some(i64::from(*n)),
            Literal::AbstractInt(n) => Some(*n),
            _ => None,
        };
        match self.get(handle) {
            Expression::Literal(literal) => whole(literal),
            Expression::Constant(constant) => {
                match &self.module.global_expressions[self.module.constants[*constant].init] {
                    Expression::Literal(literal) => whole(literal),
                    _ => None,
                }
            }
            _ => None,
        }
    }

    /// The variable that an expression reads.
    fn read(&self, handle: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        let Expression::Load { pointer } = self.get(handle) else { return None };
        self.variable(*pointer)
    }

    fn variable(&self, pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        let Expression::LocalVariable(variable) = self.get(pointer) else { return None };
        Some(*variable)
    }

    /// The comparison at the start of the body without which the loop ends.
    fn bound(&self, body: &Block) -> Option<(Handle<LocalVariable>, BinaryOperator, i64)> {
        let test = body.iter().find(|s| !matches!(s, Statement::Emit(_)))?;
        let Statement::If { condition, accept, reject } = test else { return None };
        let ends = accept.iter().next().is_none() && matches!(reject.iter().next(), Some(Statement::Break));
        let Expression::Binary { op, left, right } = self.get(*condition) else { return None };
        ends.then_some((self.read(*left)?, *op, self.number(*right)?))
    }

    /// What the counter holds before the first turn: what was stored last, else what it was declared with.
    fn start(&self, counter: Handle<LocalVariable>, before: &[&Statement]) -> Option<i64> {
        let stored = before.iter().rev().find_map(|statement| match statement {
            Statement::Store { pointer, value } if self.variable(*pointer) == Some(counter) => Some(*value),
            _ => None,
        });
        self.number(stored.or(self.function.local_variables[counter].init)?)
    }

    /// By what the counter moves at the end of a turn, where nothing else happens there.
    fn step(&self, counter: Handle<LocalVariable>, continuing: &Block) -> Option<i64> {
        let mut stores = continuing.iter().filter(|s| !matches!(s, Statement::Emit(_)));
        let (Some(Statement::Store { pointer, value }), None) = (stores.next(), stores.next()) else { return None };
        let Expression::Binary { op, left, right } = self.get(*value) else { return None };
        if self.variable(*pointer) != Some(counter) || self.read(*left) != Some(counter) {
            return None;
        }
        let by = self.number(*right)?;
        match op {
            BinaryOperator::Add => Some(by),
            BinaryOperator::Subtract => by.checked_neg(),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The turns of every loop of a function, outer ones first.
    fn found(text: &str) -> Vec<u32> {
        let module = naga::front::wgsl::parse_str(text).expect("WGSL");
        let function = module.functions.iter().last().expect("a function").1;
        let mut all = Vec::new();
        let mut open = vec![&function.body];
        while let Some(block) = open.pop() {
            let mut before = Vec::new();
            for statement in block.iter() {
                match statement {
                    Statement::Block(inner) => open.push(inner),
                    Statement::Loop { body, continuing, .. } => {
                        all.push(turns(&module, function, &before, (body, continuing)));
                        open.push(body);
                    }
                    _ => {}
                }
                before.push(statement);
            }
        }
        all
    }

    #[test]
    fn loops_that_say_how_often_they_turn_are_counted() {
        let of = |head: &str| {
            found(&format!(
                "const N: i32 = 5;\nfn f(n: i32) -> f32 {{ var s = 0.0; for ({head}) {{ s += 1.5; }} return s; }}"
            ))
        };
        assert_eq!(of("var i = 0; i < N; i++"), [5]);
        assert_eq!(of("var i = -N; i <= N; i += 2"), [6]);
        assert_eq!(of("var i = 7u; i > 0u; i--"), [7]);
        assert_eq!(of("var i = 0; i < 0; i++"), [1]);
        assert_eq!(of("var i = 0; i < 1000000; i++"), [4096]);
        // Not told by the text alone.
        assert_eq!(of("var i = 0; i < n; i++"), [1]);
        assert_eq!(of("var i = n; i < N; i++"), [1]);
        assert_eq!(of("var i = 1; i < N; i *= 2"), [1]);
        assert_eq!(of("var i = 0; i < N; i--"), [1]);
    }

    #[test]
    fn loops_in_loops_are_counted_apart() {
        let text = "fn f() -> f32 { var s = 0.0; for (var y = -1; y <= 1; y++) { for (var x = -2; x <= 2; x++) { s += 1.0; } } return s; }";
        assert_eq!(found(text), [3, 5]);
    }
}

//! Writes statements and the expressions that they need into a function of a module.

use naga::{Arena, BinaryOperator, Block, Expression, Handle, Literal, Span, Statement, proc::Emitter};

/// A block under construction.
pub(super) struct Build<'a> {
    expressions: &'a mut Arena<Expression>,
    block: Block,
}

impl<'a> Build<'a> {
    /// An empty block of the function that has these expressions.
    pub fn new(expressions: &'a mut Arena<Expression>) -> Self {
        Self { expressions, block: Block::new() }
    }

    /// The block.
    pub fn finish(self) -> Block {
        self.block
    }

    /// An expression that has a value without being evaluated: a constant, a variable, an argument.
    pub fn leaf(&mut self, expression: Expression) -> Handle<Expression> {
        self.expressions.append(expression, Span::UNDEFINED)
    }

    /// A constant.
    pub fn number(&mut self, number: u32) -> Handle<Expression> {
        self.leaf(Expression::Literal(Literal::U32(number)))
    }

    /// An expression that is evaluated here.
    pub fn node(&mut self, expression: Expression) -> Handle<Expression> {
        let mut emitter = Emitter::default();
        emitter.start(self.expressions);
        let handle = self.expressions.append(expression, Span::UNDEFINED);
        self.block.extend(emitter.finish(self.expressions));
        handle
    }

    /// The value of a variable.
    pub fn load(&mut self, pointer: Handle<Expression>) -> Handle<Expression> {
        self.node(Expression::Load { pointer })
    }

    /// Member `index` of a struct, or of the struct that a pointer points to.
    pub fn member(&mut self, base: Handle<Expression>, index: u32) -> Handle<Expression> {
        self.node(Expression::AccessIndex { base, index })
    }

    /// Whether an expression is this argument of the function.
    pub fn is_argument(&self, value: Handle<Expression>, argument: u32) -> bool {
        matches!(self.expressions[value], Expression::FunctionArgument(index) if index == argument)
    }

    /// `left op right`.
    pub fn binary(
        &mut self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Handle<Expression> {
        self.node(Expression::Binary { op, left, right })
    }

    /// `pointer = value`.
    pub fn store(&mut self, pointer: Handle<Expression>, value: Handle<Expression>) {
        self.push(Statement::Store { pointer, value });
    }

    /// A statement.
    pub fn push(&mut self, statement: Statement) {
        self.block.push(statement, Span::UNDEFINED);
    }

    /// Statements that are there already.
    pub fn append(&mut self, statements: impl IntoIterator<Item = (Statement, Span)>) {
        for (statement, span) in statements {
            self.block.push(statement, span);
        }
    }

    /// `if (condition) { … }`
    pub fn when(&mut self, condition: Handle<Expression>, then: impl FnOnce(&mut Build<'_>)) {
        let accept = self.inner(then);
        self.push(Statement::If { condition, accept, reject: Block::new() });
    }

    /// A loop that is left by a break in its body.
    pub fn forever(&mut self, turn: impl FnOnce(&mut Build<'_>)) {
        let body = self.inner(turn);
        self.push(Statement::Loop { body, continuing: Block::new(), break_if: None });
    }

    fn inner(&mut self, write: impl FnOnce(&mut Build<'_>)) -> Block {
        let mut inner = Build::new(self.expressions);
        write(&mut inner);
        inner.finish()
    }
}

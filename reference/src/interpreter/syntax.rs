//! What a parsed program is made of. Names are not resolved, and nothing has a type yet.

use super::code::Interpolation;
use super::window::WindowCoordinates;
use std::rc::Rc;

/// A name in the program.
pub type Name = Rc<str>;

/// What stands outside of functions.
#[derive(Clone, Debug)]
pub enum Item {
    /// A function or its prototype.
    Function(Function),
    /// Variables, and a structure that may be declared with them.
    Declaration(Declaration),
    /// An interface block.
    Block(InterfaceBlock),
    /// `invariant name;` and other statements that say more about a variable.
    Requalification,
}

/// A function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Where its name stands.
    pub line: u32,
    /// Its name.
    pub name: Name,
    /// What it returns.
    pub result: TypeName,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// What it does; `None` for a prototype.
    pub body: Option<Vec<Statement>>,
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// `in`, `out`, `inout`, `const`.
    pub storage: StorageQualifier,
    /// Its type.
    pub kind: TypeName,
    /// Its name, empty where it has none.
    pub name: Name,
    /// Lengths of the array that it is.
    pub lengths: Vec<Option<Expression>>,
}

/// Where a variable lives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StorageQualifier {
    /// In the program.
    #[default]
    Plain,
    /// Never changes.
    Constant,
    /// Comes from outside for every sample.
    Input,
    /// Goes out.
    Output,
    /// Goes in and out.
    InputOutput,
    /// Comes from outside for all samples.
    Uniform,
    /// `varying`: input or output, by the stage.
    Varying,
    /// A storage buffer or memory shared by a group.
    Shared,
}

/// The words before a type.
#[derive(Clone, Debug, Default)]
pub struct Qualifiers {
    /// Where it lives.
    pub storage: StorageQualifier,
    /// How it is interpolated between vertices.
    pub interpolation: Interpolation,
    /// `layout(location = …)`, where a number is written.
    pub location: Option<u32>,
    /// How `gl_FragCoord` counts from here on.
    pub window: WindowCoordinates,
    /// Whether `layout(std140)` is among them.
    pub is_std140: bool,
    /// `layout(offset = …)` and `layout(align = …)`, where a number is written.
    pub placed: [Option<u32>; 2],
    /// Whether the rows of matrices lie before their columns, where a layout says it.
    pub is_row_major: Option<bool>,
}

/// A type as it is written.
#[derive(Clone, Debug)]
pub struct TypeName {
    /// Where it stands.
    pub line: u32,
    /// Which type.
    pub base: BaseType,
    /// Lengths behind it.
    pub lengths: Vec<Option<Expression>>,
}

/// A type without lengths.
#[derive(Clone, Debug)]
pub enum BaseType {
    /// By its name.
    Named(Name),
    /// A structure that is declared here: its name and members.
    Struct(Name, Vec<Declaration>),
}

/// Variables of one type.
#[derive(Clone, Debug)]
pub struct Declaration {
    /// Where it starts.
    pub line: u32,
    /// What stands before the type.
    pub qualifiers: Qualifiers,
    /// The type.
    pub kind: TypeName,
    /// The variables.
    pub variables: Vec<DeclaredVariable>,
}

/// A variable as it is declared.
#[derive(Clone, Debug)]
pub struct DeclaredVariable {
    /// Where its name stands.
    pub line: u32,
    /// Its name.
    pub name: Name,
    /// Lengths behind the name.
    pub lengths: Vec<Option<Expression>>,
    /// Its first value.
    pub value: Option<Expression>,
}

/// An interface block.
#[derive(Clone, Debug)]
pub struct InterfaceBlock {
    /// Where it starts.
    pub line: u32,
    /// What stands before its name.
    pub qualifiers: Qualifiers,
    /// The block's name, by which a host knows it.
    pub name: Name,
    /// Its members.
    pub members: Vec<Declaration>,
    /// The name by which the program knows it, and lengths.
    pub instance: Option<(Name, Vec<Option<Expression>>)>,
}

/// A statement.
#[derive(Clone, Debug)]
pub struct Statement {
    /// Where it starts.
    pub line: u32,
    /// What it is.
    pub kind: StatementKind,
}

/// What a statement is.
#[derive(Clone, Debug)]
pub enum StatementKind {
    /// `;`
    Empty,
    /// A value that is not used.
    Expression(Expression),
    /// Variables.
    Declaration(Declaration),
    /// `{ … }`
    Block(Vec<Statement>),
    /// `if`
    If(Expression, Box<Statement>, Option<Box<Statement>>),
    /// `for` and `while`: what is done first, the condition, what is done after each turn, and the body.
    Loop(Option<Box<Statement>>, Option<LoopCondition>, Option<Expression>, Box<Statement>),
    /// `do … while`
    DoWhile(Box<Statement>, Expression),
    /// `switch`
    Switch(Expression, Vec<Statement>),
    /// `case`, or `default` without a value
    Case(Option<Expression>),
    /// `break`
    Break,
    /// `continue`
    Continue,
    /// `return`
    Return(Option<Expression>),
    /// `discard`
    Discard,
}

/// What a loop asks.
#[derive(Clone, Debug)]
pub enum LoopCondition {
    /// A value.
    Expression(Expression),
    /// The value of a variable that is declared for each turn.
    Declaration(Declaration),
}

/// An expression.
#[derive(Clone, Debug)]
pub struct Expression {
    /// Where its operator or first token stands.
    pub line: u32,
    /// The byte of the text at which that is written; 0 of what no text has, and of brackets and commas. A macro writes its body and its arguments as often as
    /// they are used.
    pub at: u32,
    /// Whether evaluating it may change a variable.
    pub changes: bool,
    /// What it is.
    pub kind: ExpressionKind,
}

impl Expression {
    /// One that no text has, and that changes nothing.
    #[must_use]
    pub fn made(line: u32, kind: ExpressionKind) -> Self {
        Self { line, at: 0, changes: false, kind }
    }
}

/// What an expression is.
#[derive(Clone, Debug)]
pub enum ExpressionKind {
    /// `7`, `7u`
    Integer(f64, bool),
    /// `7.0`, `7.0lf`
    Floating(f64, bool),
    /// `true`, `false`
    Bool(bool),
    /// A variable.
    Name(Name),
    /// `-x`
    Unary(Unary, Box<Expression>),
    /// `++x`, `x--`: whether 1 is added, and whether the value is that of before.
    Step(bool, bool, Box<Expression>),
    /// Operators of one level from left to right.
    Chain(Box<Expression>, Vec<(Binary, u32, Expression)>),
    /// `a = b`, `a += b`
    Assign(Option<Binary>, Box<Expression>, Box<Expression>),
    /// `a ? b : c`
    Conditional(Box<Expression>, Box<Expression>, Box<Expression>),
    /// `a, b`
    Comma(Vec<Expression>),
    /// A function or constructor by its name.
    Call(Name, Vec<Expression>),
    /// A constructor of an array.
    ArrayConstructor(Box<TypeName>, Vec<Expression>),
    /// `a[b]`
    Index(Box<Expression>, Box<Expression>),
    /// `a.b`
    Member(Box<Expression>, Name),
    /// `a.length()`
    Length(Box<Expression>),
    /// `{ a, b }`
    List(Vec<Expression>),
}

/// Operators before one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unary {
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `!`
    Not,
    /// `~`
    Complement,
}

/// Operators between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are what they are called")]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    ShiftLeft,
    ShiftRight,
    BitAnd,
    BitXor,
    BitOr,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    And,
    Xor,
    Or,
}

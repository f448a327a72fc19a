//! Declarations: functions, variables, structures, blocks.

use super::{Parser, token};
use crate::interpreter::Refusal;
use crate::interpreter::code::Interpolation;
use crate::interpreter::syntax::{
    BaseType, Declaration, DeclaredVariable, Function, InterfaceBlock, Item, Name, Parameter, Qualifiers,
    StorageQualifier, TypeName,
};
use crate::text::both;

/// Words before a type that do not change what it means here.
const SILENT: [&str; 7] = ["smooth", "centroid", "invariant", "highp", "mediump", "lowp", "precision"];
/// The same, which are names where no name follows.
const SOMETIMES_SILENT: [&str; 9] =
    ["sample", "patch", "precise", "coherent", "volatile", "restrict", "readonly", "writeonly", "subroutine"];

impl Parser<'_> {
    pub(super) fn item(&mut self) -> Result<Item, Refusal> {
        let line = self.line();
        if self.text(0) == "precision" {
            return self.requalification();
        }
        let qualifiers = self.qualifiers()?;
        if self.text(0) == ";" || (self.is_name(0) && matches!(self.text(1), ";" | ",") && !self.is_type_ahead()) {
            if self.text(0) == ";" && qualifiers.storage == StorageQualifier::Uniform {
                self.blocks.is_std140 |= qualifiers.is_std140;
                self.blocks.is_row_major = qualifiers.is_row_major.or(self.blocks.is_row_major);
            }
            return self.requalification();
        }
        if self.is_name(0) && self.text(1) == "{" && self.text(0) != "struct" {
            return Ok(Item::Block(self.block_of(qualifiers, line)?));
        }
        let kind = self.declared_type()?;
        if self.is_name(0) && self.text(1) == "(" {
            return Ok(Item::Function(self.function(kind)?));
        }
        let variables = if self.takes(";") { Vec::new() } else { self.variables()? };
        Ok(Item::Declaration(Declaration { line, qualifiers, kind, variables }))
    }

    fn is_type_ahead(&self) -> bool {
        Self::is_type(self.text(0))
    }

    fn requalification(&mut self) -> Result<Item, Refusal> {
        while !self.takes(";") {
            if self.peek(0).is_none() {
                return Err(self.unexpected(token(";")));
            }
            self.at += 1;
        }
        Ok(Item::Requalification)
    }

    /// The words before a type.
    pub(super) fn qualifiers(&mut self) -> Result<Qualifiers, Refusal> {
        let mut qualifiers = Qualifiers::default();
        loop {
            let word = self.text(0);
            let storage = match word {
                "const" if qualifiers.storage == StorageQualifier::Plain => StorageQualifier::Constant,
                "in" | "attribute" => StorageQualifier::Input,
                "out" => StorageQualifier::Output,
                "inout" => StorageQualifier::InputOutput,
                "uniform" => StorageQualifier::Uniform,
                "varying" => StorageQualifier::Varying,
                "shared" | "buffer" if self.is_name(1) => StorageQualifier::Shared,
                "layout" if self.text(1) == "(" => {
                    self.layout(&mut qualifiers)?;
                    continue;
                }
                "flat" | "noperspective" => {
                    let is_flat = word == "flat";
                    qualifiers.interpolation = if is_flat { Interpolation::Flat } else { Interpolation::NoPerspective };
                    qualifiers.storage
                }
                "const" => qualifiers.storage,
                _ if SILENT.contains(&word) => qualifiers.storage,
                _ if SOMETIMES_SILENT.contains(&word)
                    && (self.is_name(1) || self.text(1) == "(")
                    && !self.is_call() =>
                {
                    qualifiers.storage
                }
                _ => return Ok(qualifiers),
            };
            self.at += 1;
            // `const in` is `in`.
            qualifiers.storage = storage;
        }
    }

    /// Whether a word and a bracket are a call, as `sample(x)`.
    fn is_call(&self) -> bool {
        self.text(1) == "("
    }

    /// What stands in a layout.
    fn layout(&mut self, qualifiers: &mut Qualifiers) -> Result<(), Refusal> {
        self.at += 1;
        let mut depth = 0_usize;
        loop {
            match self.text(0) {
                "location" if self.text(1) == "=" => {
                    qualifiers.location = self.text(2).parse().ok().or(qualifiers.location);
                }
                "origin_upper_left" => qualifiers.window.from_top = true,
                "pixel_center_integer" => qualifiers.window.in_whole_pixels = true,
                "std140" => qualifiers.is_std140 = true,
                "row_major" | "column_major" => qualifiers.is_row_major = Some(self.text(0) == "row_major"),
                "offset" if self.text(1) == "=" => qualifiers.placed[0] = self.text(2).parse().ok(),
                "align" if self.text(1) == "=" => qualifiers.placed[1] = self.text(2).parse().ok(),
                "(" => depth += 1,
                ")" => depth -= 1,
                "" => return Err(self.unexpected(token(")"))),
                _ => {}
            }
            self.at += 1;
            if depth == 0 {
                return Ok(());
            }
        }
    }

    /// Whether a declaration of variables starts here, and not an expression.
    pub(super) fn is_declaration(&self) -> bool {
        let word = self.text(0);
        match word {
            "const" | "struct" | "highp" | "mediump" | "lowp" | "invariant" | "layout" | "precision" => true,
            _ => self.is_name(0) && self.is_name(1 + self.lengths_ahead(1)),
        }
    }

    /// A type that may be a structure declared here.
    pub(super) fn declared_type(&mut self) -> Result<TypeName, Refusal> {
        let line = self.line();
        if !self.takes("struct") {
            return self.type_name();
        }
        let name = if self.is_name(0) { self.name()? } else { Name::from("") };
        let members = self.nested(Self::members)?;
        Ok(TypeName { line, base: BaseType::Struct(name, members), lengths: self.lengths()? })
    }

    fn members(&mut self) -> Result<Vec<Declaration>, Refusal> {
        self.expect("{")?;
        let mut members = Vec::new();
        while !self.takes("}") {
            if !self.takes(";") {
                members.push(self.declaration()?);
            }
        }
        Ok(members)
    }

    /// Qualifiers, type, variables and `;`.
    pub(super) fn declaration(&mut self) -> Result<Declaration, Refusal> {
        let line = self.line();
        let qualifiers = self.qualifiers()?;
        let kind = self.declared_type()?;
        let variables = if self.takes(";") { Vec::new() } else { self.variables()? };
        Ok(Declaration { line, qualifiers, kind, variables })
    }

    fn variables(&mut self) -> Result<Vec<DeclaredVariable>, Refusal> {
        let mut variables = Vec::new();
        loop {
            variables.push(self.variable()?);
            if self.takes(";") {
                return Ok(variables);
            }
            if !self.takes(",") {
                return Err(self.unexpected(both("`,` or `;`", " `,` または `;` ")));
            }
        }
    }

    /// Name, lengths and first value.
    pub(super) fn variable(&mut self) -> Result<DeclaredVariable, Refusal> {
        let line = self.line();
        let name = self.name()?;
        let lengths = self.lengths()?;
        let value = if self.takes("=") { Some(self.initialiser()?) } else { None };
        Ok(DeclaredVariable { line, name, lengths, value })
    }

    fn block_of(&mut self, mut qualifiers: Qualifiers, line: u32) -> Result<InterfaceBlock, Refusal> {
        qualifiers.is_std140 |= self.blocks.is_std140;
        qualifiers.is_row_major = qualifiers.is_row_major.or(self.blocks.is_row_major);
        let name = self.name()?;
        let members = self.members()?;
        let instance = if self.is_name(0) { Some((self.name()?, self.lengths()?)) } else { None };
        self.expect(";")?;
        Ok(InterfaceBlock { line, qualifiers, name, members, instance })
    }

    fn function(&mut self, result: TypeName) -> Result<Function, Refusal> {
        let line = self.line();
        let name = self.name()?;
        self.at += 1;
        let mut parameters = Vec::new();
        if self.text(0) == "void" && self.text(1) == ")" {
            self.at += 1;
        }
        while !self.takes(")") {
            if !parameters.is_empty() {
                self.expect(",")?;
            }
            let storage = self.qualifiers()?.storage;
            let kind = self.declared_type()?;
            let name = if self.is_name(0) { self.name()? } else { Name::from("") };
            parameters.push(Parameter { storage, kind, name, lengths: self.lengths()? });
        }
        self.functions.insert(Name::clone(&name));
        let body = if self.takes(";") { None } else { Some(self.block()?) };
        Ok(Function { line, name, result, parameters, body })
    }
}

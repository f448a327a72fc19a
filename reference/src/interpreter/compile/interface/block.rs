//! Interface blocks: their members as uniforms, inputs or outputs, and where a uniform lies in its block.

use crate::interpreter::code::{BlockPlace, Interpolation, Slot};
use crate::interpreter::compile::scope::Symbol;
use crate::interpreter::compile::{Compiler, scope};
use crate::interpreter::std140::{self, BlockMember};
use crate::interpreter::syntax::{Declaration, InterfaceBlock, Name, StorageQualifier};
use crate::interpreter::types::{Struct, Type};
use crate::interpreter::{Refusal, WindowCoordinates};
use std::sync::Arc;

impl Compiler {
    /// An interface block, with or without a name for the program.
    pub(in crate::interpreter::compile) fn interface_block(&mut self, block: &InterfaceBlock) -> Result<(), Refusal> {
        self.builder.line = block.line;
        let storage = self.storage(block.qualifiers.storage);
        if storage == StorageQualifier::Shared {
            return self.storage_buffer(block);
        }
        let members = self.member_types(&block.members)?;
        let qualifiers = block.members.iter().flat_map(|own| own.variables.iter().map(|_| &own.qualifiers));
        let laid_out = members.iter().zip(qualifiers).map(|((_, kind), own)| BlockMember {
            kind: kind.clone(),
            offset: own.placed[0],
            align: own.placed[1].or(block.qualifiers.placed[1]),
            is_row_major: own.is_row_major.or(block.qualifiers.is_row_major).unwrap_or(false),
        });
        let laid_out: Vec<BlockMember> = laid_out.collect();
        let first = self.uniforms.len();
        let each = |member: &Declaration| -> Vec<(Interpolation, u32)> {
            member.variables.iter().map(|own| (member.qualifiers.interpolation, own.line)).collect()
        };
        let ways: Vec<(Interpolation, u32)> = block.members.iter().flat_map(each).collect();
        self.builder.line = block.line;
        if &*block.name == "gl_PerVertex" {
            return members
                .into_iter()
                .try_for_each(|(name, kind)| self.redeclare(&Name::from(name), kind, WindowCoordinates::default()));
        }
        let Some((instance, lengths)) = &block.instance else {
            for ((name, kind), (interpolation, line)) in members.into_iter().zip(ways) {
                self.builder.line = line;
                let slot = self.allocate(&kind)?;
                self.exchange(storage, &name, &kind, slot)?;
                self.qualify(storage, interpolation, None);
                self.scopes.declare(Name::from(name), Symbol::variable(kind, slot));
            }
            self.place_parts(first, block, &laid_out);
            return Ok(());
        };
        self.structures += 1;
        let structure = Struct::new(block.name.to_string(), self.structures, members);
        let one = Type::Struct(Arc::new(structure));
        let kind = self.arrays_of(one.clone(), lengths)?;
        let slot = self.allocate(&kind)?;
        if storage == StorageQualifier::Uniform {
            self.leaves(&block.name, &kind, slot)?;
            self.place_parts(first, block, &laid_out);
        } else {
            self.block_parts(storage, [&block.name, instance], &kind, slot, &ways)?;
            if matches!(kind, Type::Struct(_)) {
                self.instances.push(Name::clone(instance));
            }
        }
        self.scopes.declare(Name::clone(instance), Symbol::variable(kind, slot));
        Ok(())
    }

    /// Tells the host of the members of an input or output block, or of each block of an array: by the name of the block, and by that which
    /// the program has for it.
    fn block_parts(
        &mut self,
        storage: StorageQualifier,
        [path, written]: [&str; 2],
        kind: &Type,
        slot: Slot,
        ways: &[(Interpolation, u32)],
    ) -> Result<(), Refusal> {
        let mut slot = slot;
        match kind {
            Type::Struct(structure) => {
                for ((name, kind), (interpolation, line)) in structure.members.iter().zip(ways) {
                    self.builder.line = *line;
                    self.exchange(storage, &format!("{path}.{name}"), kind, slot)?;
                    self.qualify(storage, *interpolation, None);
                    if let Some(last) = self.last_exchanged(storage) {
                        last.written = format!("{written}.{name}");
                    }
                    slot += kind.slots().unwrap_or(0) as Slot;
                }
            }
            Type::Array(element, length) => {
                for index in 0..length.unwrap_or(scope::UNSIZED) {
                    let names = [path, written].map(|name| format!("{name}[{index}]"));
                    self.block_parts(storage, [&names[0], &names[1]], element, slot, ways)?;
                    slot += element.slots().unwrap_or(0) as Slot;
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Says where the uniforms from `first` on lie, which are the parts of a block; those of several blocks in an array have no place.
    fn place_parts(&mut self, first: usize, block: &InterfaceBlock, members: &[BlockMember]) {
        let places = std140::places(members);
        let Some(parts) = self.uniforms.get_mut(first..).filter(|parts| parts.len() == places.len()) else { return };
        let is_std140 = block.qualifiers.is_std140;
        for (part, (offset, is_row_major)) in parts.iter_mut().zip(places) {
            part.place = Some(BlockPlace { block: block.name.to_string(), offset, is_std140, is_row_major });
        }
    }

    fn storage_buffer(&mut self, block: &InterfaceBlock) -> Result<(), Refusal> {
        let unsupported =
            || Symbol::Unsupported(["storage buffers are not supported", "ストレージバッファには対応していません"]);
        if let Some((instance, _)) = &block.instance {
            self.scopes.declare(Name::clone(instance), unsupported());
            return Ok(());
        }
        for variable in block.members.iter().flat_map(|member| &member.variables) {
            self.scopes.declare(Name::clone(&variable.name), unsupported());
        }
        Ok(())
    }
}

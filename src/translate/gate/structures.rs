//! How many members the structures of a file have, with those of the structures in them: the compiler walks through all
//! of them wherever a type is used, so that forty structures of two members each keep it busy for ever.

use std::collections::HashMap;

/// Most members of one structure, those of the structures in it written out; arrays count once. As many scalars are all
/// that the variables of a shader may have ([`super::bounds::MAX_SCALARS`]). A file with two variables of so many members
/// takes 20 ms before the driver.
pub(super) const MAX_MEMBERS: u64 = super::bounds::MAX_SCALARS;

/// Follows the definitions of structures.
#[derive(Debug, Default)]
pub(super) struct Structures {
    /// Members of each that is known.
    members: HashMap<String, u64>,
    /// Those that are being defined, the innermost last.
    open: Vec<OpenStructure>,
    /// What stands between `struct` and `{`.
    head: Option<String>,
}

#[derive(Debug)]
struct OpenStructure {
    name: String,
    members: u64,
    /// Members of the type of the declaration that is being read.
    of_type: u64,
    brackets: usize,
}

impl Structures {
    /// Takes the next token; whether a structure has too many members by now.
    pub fn take(&mut self, token: &str) -> bool {
        match (token, self.head.take()) {
            ("struct", _) => self.head = Some(String::new()),
            ("{", Some(name)) => self.open.push(OpenStructure { name, members: 0, of_type: 1, brackets: 0 }),
            // Not a definition after all.
            (";" | ")", Some(_)) => {}
            (name, Some(_)) => self.head = Some(name.into()),
            (token, None) => return self.member(token),
        }
        false
    }

    fn member(&mut self, token: &str) -> bool {
        let Some(open) = self.open.last_mut() else { return false };
        match token {
            "[" => open.brackets += 1,
            "]" => open.brackets = open.brackets.saturating_sub(1),
            "," if open.brackets == 0 => open.members = open.members.saturating_add(open.of_type),
            ";" => {
                open.members = open.members.saturating_add(open.of_type);
                open.of_type = 1;
                open.brackets = 0;
            }
            "}" => {
                let Some(closed) = self.open.pop() else { return false };
                // The type of a declaration in the structure around it.
                if let Some(outer) = self.open.last_mut() {
                    outer.of_type = closed.members;
                }
                let known = self.members.entry(closed.name).or_default();
                // Of several under one name the one that costs most: which one is meant depends on the place.
                *known = closed.members.max(*known);
                return closed.members > MAX_MEMBERS;
            }
            name => {
                if let Some(members) = self.members.get(name).filter(|_| open.brackets == 0) {
                    open.of_type = *members;
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::translate::gate::expand::tokens;

    /// Members of `T`, and whether any structure has too many.
    fn members(code: &str) -> (u64, bool) {
        let mut structures = Structures::default();
        let is_too_many = tokens(code, 1).into_iter().any(|token| structures.take(&token.text));
        (structures.members.get("T").copied().unwrap_or(0), is_too_many)
    }

    #[test]
    fn members_are_counted_with_those_in_them() {
        assert_eq!(members("struct T { float a, b[3]; vec3 c; };"), (3, false));
        assert_eq!(members("struct S { int a; int b; }; struct T { S s, t[2]; highp S u; float v; };"), (7, false));
        assert_eq!(members("struct S { int a; int b; }; struct T { float a[S(1, 2).a]; S b; } t;"), (3, false));
        assert_eq!(members("struct T { struct { int a, b, c; } s, t; };"), (6, false));
        assert_eq!(members("struct { int a; } t; void main() { int T[2] = int[2](1, 2); }"), (0, false));
    }

    #[test]
    fn structures_that_double_each_other_have_too_many() {
        let doubled = |levels: usize| {
            let level = |n: usize| format!("struct S{} {{ S{n} a, b; }};", n + 1);
            format!("struct S0 {{ int x; }};{}", (0..levels).map(level).collect::<String>())
        };
        // 2^14 = 16,384.
        assert!(!members(&doubled(14)).1);
        assert!(members(&doubled(15)).1);
        // Far beyond what 64 bits count.
        assert!(members(&doubled(200)).1);
    }
}

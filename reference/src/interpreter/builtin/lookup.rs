//! Texture functions (GLSL 4.60, section 8.9): their names say what they take.

use super::BuiltinCall;
use crate::Text;
use crate::interpreter::Stage;
use crate::interpreter::code::{ArithmeticClass, Node, Operation, Slot};
use crate::interpreter::compile::{CodeBuilder, ParameterDirection, Signature};
use crate::interpreter::texture::{LookupMode, Query};
use crate::interpreter::types::{Dimension, Sampler, Scalar, Type};
use std::collections::HashMap;

const NAMES: [&str; 18] = [
    "texture",
    "textureProj",
    "textureLod",
    "textureOffset",
    "textureProjOffset",
    "textureLodOffset",
    "textureProjLod",
    "textureProjLodOffset",
    "textureGrad",
    "textureGradOffset",
    "textureProjGrad",
    "textureProjGradOffset",
    "texelFetch",
    "texelFetchOffset",
    "textureGather",
    "textureGatherOffset",
    "textureSize",
    "textureQueryLevels",
];

/// Names of old GLSL (GLSL 1.20, section 8.7), in which the shape of the texture stands: the name, the lookup of today that it is, and
/// the shape.
const OLD_NAMES: [(&str, &str, Dimension); 22] = [
    ("texture1D", "texture", Dimension::One),
    ("texture1DLod", "textureLod", Dimension::One),
    ("texture1DProj", "textureProj", Dimension::One),
    ("texture1DProjLod", "textureProjLod", Dimension::One),
    ("texture2D", "texture", Dimension::Two),
    ("texture2DLod", "textureLod", Dimension::Two),
    ("texture2DProj", "textureProj", Dimension::Two),
    ("texture2DProjLod", "textureProjLod", Dimension::Two),
    ("texture3D", "texture", Dimension::Three),
    ("texture3DLod", "textureLod", Dimension::Three),
    ("texture3DProj", "textureProj", Dimension::Three),
    ("texture3DProjLod", "textureProjLod", Dimension::Three),
    ("textureCube", "texture", Dimension::Cube),
    ("textureCubeLod", "textureLod", Dimension::Cube),
    ("shadow1D", "texture", Dimension::One),
    ("shadow1DLod", "textureLod", Dimension::One),
    ("shadow1DProj", "textureProj", Dimension::One),
    ("shadow1DProjLod", "textureProjLod", Dimension::One),
    ("shadow2D", "texture", Dimension::Two),
    ("shadow2DLod", "textureLod", Dimension::Two),
    ("shadow2DProj", "textureProj", Dimension::Two),
    ("shadow2DProjLod", "textureProjLod", Dimension::Two),
];

/// The lookup of today that one of old GLSL is; `None` where there is none of the same kind.
pub fn lookup_of_today(name: &str) -> Option<&'static str> {
    OLD_NAMES.iter().find(|(old, ..)| *old == name).map(|(_, today, _)| *today)
}

/// Whether a function reads texels.
pub fn is_lookup(name: &str) -> bool {
    let is_question = matches!(name, "textureSize" | "textureQueryLevels");
    !is_question && (NAMES.contains(&name) || lookup_of_today(name).is_some())
}

/// What a function's name says.
struct LookupForm {
    projected: bool,
    level: bool,
    gradient: bool,
    offset: bool,
    fetch: bool,
    gather: bool,
}

impl LookupForm {
    fn of(name: &str) -> Self {
        Self {
            projected: name.contains("Proj"),
            level: name.contains("Lod"),
            gradient: name.contains("Grad"),
            offset: name.contains("Offset"),
            fetch: name.starts_with("texelFetch"),
            gather: name.contains("Gather"),
        }
    }

    fn has_bias(&self) -> bool {
        !(self.level || self.gradient || self.fetch || self.gather)
    }
}

fn samplers() -> Vec<Sampler> {
    use Dimension::{Cube, One, Rectangle, Three, Two};
    let shapes = [
        (One, false),
        (Two, false),
        (Three, false),
        (Cube, false),
        (Rectangle, false),
        (One, true),
        (Two, true),
        (Cube, true),
    ];
    let mut all = Vec::new();
    for (dimension, array) in shapes {
        let sampler = |texel, shadow| Sampler { dimension, array, shadow, texel };
        all.extend([Scalar::Float, Scalar::Int, Scalar::Uint].map(|texel| sampler(texel, false)));
        if dimension != Three {
            all.push(sampler(Scalar::Float, true));
        }
    }
    all
}

/// How many coordinates a lookup takes: with one that is compared, there are at least three.
fn coordinates(sampler: Sampler) -> u8 {
    let count = sampler.coordinates();
    if sampler.shadow && count < 4 { count.max(2) + 1 } else { count }
}

pub fn signatures(table: &mut HashMap<&'static str, Vec<Signature>>) {
    for name in NAMES {
        let all = samplers().into_iter().flat_map(|sampler| of_sampler(name, sampler));
        table.entry(name).or_default().extend(all);
    }
    for (name, today, dimension) in OLD_NAMES {
        let is_of_name = |sampler: &Sampler| {
            let is_shadow = name.starts_with("shadow");
            sampler.dimension == dimension && sampler.shadow == is_shadow && !sampler.array
        };
        let all = samplers().into_iter().filter(is_of_name).filter(|sampler| sampler.texel == Scalar::Float);
        // What compares gave a vector.
        let with_vector = |signature| Signature { result: Type::Vector(Scalar::Float, 4), ..signature };
        let all = all.flat_map(|sampler| of_sampler(today, sampler)).map(with_vector);
        table.entry(name).or_default().extend(all);
    }
}

/// The ways in which a function takes a sampler.
fn of_sampler(name: &str, sampler: Sampler) -> Vec<Signature> {
    let form = LookupForm::of(name);
    let (is_cube, is_rectangle) = (sampler.dimension == Dimension::Cube, sampler.dimension == Dimension::Rectangle);
    let float = |count: u8| Type::Vector(Scalar::Float, count);
    let int = |count: u8| Type::Vector(Scalar::Int, count);
    let texel = if sampler.shadow && !form.gather { Type::FLOAT } else { Type::Vector(sampler.texel, 4) };
    let signature = |result: Type, parameters: Vec<Type>| {
        let parameters = std::iter::once(Type::Sampler(sampler)).chain(parameters);
        Signature { result, parameters: parameters.map(|kind| (ParameterDirection::In, kind)).collect() }
    };
    match name {
        "textureQueryLevels" => return vec![signature(Type::INT, Vec::new())],
        "textureSize" => {
            let size = sampler.dimension.count().min(if is_cube { 2 } else { 3 }) + u8::from(sampler.array);
            let level = if is_rectangle { Vec::new() } else { vec![Type::INT] };
            return vec![signature(int(size), level)];
        }
        _ => {}
    }
    let is_flat = matches!(sampler.dimension, Dimension::Two | Dimension::Rectangle);
    let is_none = (form.gather && !is_flat && !is_cube)
        || (form.offset && is_cube)
        || (form.projected && (sampler.array || is_cube))
        || (form.fetch && (sampler.shadow || is_cube))
        || (form.level && is_rectangle);
    if is_none {
        return Vec::new();
    }
    let places = if form.fetch {
        vec![int(sampler.coordinates())]
    } else if form.gather {
        vec![float(sampler.coordinates())]
    } else if form.projected {
        let least = if sampler.shadow { 4 } else { sampler.dimension.count() + 1 };
        let mut places = vec![float(4)];
        if least < 4 {
            places.push(float(least));
        }
        places
    } else {
        vec![float(coordinates(sampler))]
    };
    let mut all = Vec::new();
    for place in places {
        let mut parameters = vec![place];
        if sampler.shadow && (form.gather || coordinates(sampler) == sampler.coordinates()) {
            parameters.push(Type::FLOAT);
        }
        if form.level || (form.fetch && !is_rectangle) {
            parameters.push(if form.fetch { Type::INT } else { Type::FLOAT });
        }
        if form.gradient {
            let along = sampler.dimension.count();
            parameters.extend([float(along), float(along)]);
        }
        if form.offset {
            parameters.push(int(sampler.dimension.count()));
        }
        all.push(signature(texel.clone(), parameters.clone()));
        if form.has_bias() && !is_rectangle {
            parameters.push(Type::FLOAT);
            all.push(signature(texel.clone(), parameters));
        } else if form.gather && !sampler.shadow {
            parameters.push(Type::INT);
            all.push(signature(texel.clone(), parameters));
        }
    }
    all
}

impl BuiltinCall<'_> {
    /// Writes a texture function.
    pub(super) fn lookup(&self, builder: &mut CodeBuilder) -> Result<Vec<Slot>, Text> {
        let form = LookupForm::of(self.name);
        let Type::Sampler(sampler) = self.arguments[0].kind else { return Err(self.unsupported()) };
        let to: Vec<Slot> = (0..self.result.slots().unwrap_or(0)).map(|_| builder.temporary()).collect();
        let mut query = Query {
            texture: self.arguments[0].slots[0],
            sampler,
            coordinates: Vec::new(),
            reference: None,
            offset: Vec::new(),
            mode: LookupMode::Levels,
            to: to.clone(),
            line: builder.line,
        };
        let mut rest = self.arguments[1..].iter().map(|argument| argument.slots.clone());
        let zero = builder.whole(0.0);
        match self.name {
            "textureQueryLevels" => {}
            "textureSize" => query.mode = LookupMode::Size(rest.next().map_or(zero, |level| level[0])),
            _ => {
                let place = rest.next().unwrap_or_default();
                place_of(builder, &mut query, place, &form);
                if sampler.shadow && query.reference.is_none() {
                    query.reference = rest.next().map(|reference| reference[0]);
                }
                self.mode(&mut query, &mut rest, &form, zero);
            }
        }
        let is_one_number = sampler.shadow && self.name.starts_with("shadow");
        if is_one_number {
            query.to.truncate(1);
        }
        builder.push(Node::Texture(Box::new(query)));
        Ok(if is_one_number { vec![to[0]; to.len()] } else { to })
    }

    fn mode(&self, query: &mut Query, rest: &mut impl Iterator<Item = Vec<Slot>>, form: &LookupForm, zero: Slot) {
        let is_rectangle = query.sampler.dimension == Dimension::Rectangle;
        query.mode = if form.fetch {
            LookupMode::Fetch(if is_rectangle { zero } else { rest.next().map_or(zero, |level| level[0]) })
        } else if form.level {
            LookupMode::Level(rest.next().map_or(zero, |level| level[0]))
        } else if form.gradient {
            LookupMode::Gradient(rest.next().unwrap_or_default(), rest.next().unwrap_or_default())
        } else {
            LookupMode::Implicit(None)
        };
        if form.offset {
            query.offset = rest.next().unwrap_or_default();
        }
        let last = rest.next().map(|last| last[0]);
        if form.gather {
            query.mode = LookupMode::Gather(last.unwrap_or(zero));
        } else if let LookupMode::Implicit(bias) = &mut query.mode {
            *bias = last;
            // A vertex has no neighbours: its level is 0.
            if self.stage == Stage::Vertex {
                query.mode = LookupMode::Level(zero);
            }
        }
    }
}

/// Coordinates and what is compared, divided by the last where they are projected.
fn place_of(builder: &mut CodeBuilder, query: &mut Query, mut place: Vec<Slot>, form: &LookupForm) {
    let sampler = query.sampler;
    if form.projected {
        let last = place.pop().unwrap_or(query.texture);
        place = builder.each2(Operation::Divide, ArithmeticClass::Float, &place, &[last]);
    }
    let count = usize::from(sampler.coordinates());
    if sampler.shadow && !form.gather && place.len() > count {
        query.reference = place.get(count.max(2)).copied();
    }
    place.truncate(count);
    query.coordinates = place;
}

//! From the manifest to an assignment: every name is resolved, every expression typed, every number in range.

mod advice;
mod mistakes;

use super::{Assignment, AssignmentError, Constant, HandedIn, Input, Interface, Output, Uniform, error};
use crate::equation::{COLOUR, Definition, Equation, MAX_INPUTS, POSITION};
use crate::expression::{Expression, Scope, Type, Value};
use crate::manifest::{self, Manifest};
use crate::scene::{Scene, Vertex};
use glam::DVec3;
use std::collections::HashSet;

/// Definitions and rubric lines are held as the bits of a u64.
const MAX_DEFINITIONS: usize = 64;

type Checked<T> = Result<T, AssignmentError>;

pub(super) fn assignment(m: Manifest, read: impl Fn(&str) -> Checked<String>) -> Checked<Assignment> {
    let interface = interface(&m)?;
    let constants = constants(&m)?;
    let equation = equation(&interface, &constants, &m.definition)?;
    for output in &interface.outputs {
        let place = format!("output `{}`", output.name);
        let definition = named(&equation, &output.carries, &place)?;
        if equation.definitions[definition].kind() != output.kind {
            return Err(error(place, format!("`{}` is not a {}", output.carries, output.kind.glsl())));
        }
    }
    for definition in &equation.definitions {
        let place = format!("definition `{}`", definition.name);
        definition_uses(&definition.expression, &equation, &place)?;
    }
    let lines = rubric(&m.rubric, &equation)?;
    for constant in &constants {
        known_line(&lines, &constant.line, &format!("constant `{}`", constant.name))?;
    }
    let mut ids = HashSet::new();
    let mut titles = HashSet::new();
    let mut mistakes = Vec::new();
    for entry in m.mistake {
        if !ids.insert(entry.id.clone()) {
            return Err(error(format!("mistake `{}`", entry.id), "stands twice"));
        }
        // Lists name a mistake by its title alone.
        if ![&entry.title.en, &entry.title.ja].into_iter().all(|title| titles.insert(title.clone())) {
            return Err(error(format!("mistake `{}`", entry.id), "another mistake has the same title"));
        }
        mistakes.push(mistakes::mistake(entry, &equation, &lines)?);
    }
    probing(&m.probes, &constants)?;
    let advice = m.advice.into_iter().map(|entry| advice::advice(entry, &interface, &constants, &equation));
    let advice = advice.collect::<Checked<Vec<_>>>()?;
    Ok(Assignment {
        files: files(m.file, read)?,
        scene: scene(&m.scene)?,
        id: m.id,
        title: m.title,
        interface,
        constants,
        equation,
        rubric: m.rubric,
        mistakes,
        advice,
        probing: m.probes,
    })
}

fn files(files: Vec<manifest::File>, read: impl Fn(&str) -> Checked<String>) -> Checked<Vec<HandedIn>> {
    if files.is_empty() {
        return Err(error("file", "nothing is handed in"));
    }
    let handed_in = |file: manifest::File| {
        let fixed = file.fixed.iter().map(|f| Ok((f.stage, read(&f.file)?))).collect::<Checked<_>>()?;
        Ok(HandedIn { starter: read(&file.starter)?, name: file.name, stage: file.stage, fixed })
    };
    files.into_iter().map(handed_in).collect()
}

fn kind(name: &str, place: &str) -> Checked<Type> {
    Type::from_glsl(name).ok_or_else(|| error(place, format!("`{name}` is not a type known here")))
}

fn exactly(wanted: Type, name: &str, place: &str) -> Checked<Type> {
    match kind(name, place)? {
        t if t == wanted => Ok(t),
        _ => Err(error(place, format!("must be a {}", wanted.glsl()))),
    }
}

fn interface(m: &Manifest) -> Checked<Interface> {
    let input = |i: &manifest::Input| {
        Ok(Input {
            name: i.name.clone(),
            kind: exactly(Type::Vec4, &i.r#type, &format!("input `{}`", i.name))?,
            carries: i.carries,
        })
    };
    let uniform = |u: &manifest::Uniform| {
        Ok(Uniform {
            name: u.name.clone(),
            kind: exactly(Type::Mat4, &u.r#type, &format!("uniform `{}`", u.name))?,
            carries: u.carries,
        })
    };
    let output = |o: &manifest::Output| {
        Ok(Output {
            name: o.name.clone(),
            kind: kind(&o.r#type, &format!("output `{}`", o.name))?,
            carries: o.carries.clone(),
        })
    };
    Ok(Interface {
        inputs: m.input.iter().map(input).collect::<Checked<_>>()?,
        uniforms: m.uniform.iter().map(uniform).collect::<Checked<_>>()?,
        outputs: m.output.iter().map(output).collect::<Checked<_>>()?,
    })
}

fn constants(m: &Manifest) -> Checked<Vec<Constant>> {
    let constant = |c: &manifest::Constant| {
        let place = format!("constant `{}`", c.name);
        let kind = kind(&c.r#type, &place)?;
        let value = Value::from_numbers(kind, &c.value)
            .ok_or_else(|| error(&place, format!("a {} has {} numbers", kind.glsl(), kind.numbers())))?;
        Ok(Constant { name: c.name.clone(), kind, value, means: c.means.clone(), line: c.line.clone() })
    };
    m.constant.iter().map(constant).collect()
}

fn declare(scope: &mut Scope, name: &str, kind: Type) -> Checked<()> {
    scope
        .declare(name, kind)
        .map(|_| ())
        .ok_or_else(|| error(format!("`{name}`"), "is taken, means something in GLSL, or is not a name"))
}

fn equation(interface: &Interface, constants: &[Constant], entries: &[manifest::Definition]) -> Checked<Equation> {
    let mut scope = Scope::default();
    for c in constants {
        declare(&mut scope, &c.name, c.kind)?;
    }
    for u in &interface.uniforms {
        declare(&mut scope, &u.name, u.kind)?;
    }
    for i in &interface.inputs {
        declare(&mut scope, &i.name, i.kind)?;
    }
    let mut definitions = Vec::new();
    for d in entries {
        let place = format!("definition `{}`", d.name);
        let expression = Expression::parse(&d.is, &scope).map_err(|e| error(place, e.to_string()))?;
        declare(&mut scope, &d.name, expression.kind())?;
        let symbol = d.symbol.clone();
        definitions.push(Definition { name: d.name.clone(), expression, slide: d.slide, symbol });
    }
    if definitions.len() > MAX_DEFINITIONS {
        let message = format!("more than {MAX_DEFINITIONS} of them");
        return Err(error("definition", message));
    }
    let find = |name: &str| {
        let place = definitions.iter().position(|d| d.name == name);
        let place = place.filter(|i| definitions[*i].kind() == Type::Vec4);
        place.ok_or_else(|| error(format!("definition `{name}`"), "is missing or not a vec4"))
    };
    Ok(Equation {
        colour: find(COLOUR)?,
        position: find(POSITION)?,
        scope,
        constants: constants.iter().map(|c| c.value.clone()).collect(),
        uniforms: interface.uniforms.len(),
        attributes: interface.inputs.len(),
        definitions,
    })
}

fn named(equation: &Equation, name: &str, place: &str) -> Checked<usize> {
    equation.index(name).ok_or_else(|| error(place, format!("there is no definition `{name}`")))
}

fn rubric(lines: &[manifest::RubricLine], equation: &Equation) -> Checked<HashSet<String>> {
    if lines.len() > MAX_DEFINITIONS {
        return Err(error("rubric", "has too many lines"));
    }
    let mut ids = HashSet::new();
    for line in lines {
        let place = format!("rubric line `{}`", line.id);
        named(equation, &line.judges, &place)?;
        if !line.points.is_finite() || line.points <= 0.0 {
            return Err(error(place, "is worth nothing"));
        }
        if !ids.insert(line.id.clone()) {
            return Err(error(place, "stands twice"));
        }
    }
    Ok(ids)
}

fn known_line(lines: &HashSet<String>, line: &str, place: &str) -> Checked<()> {
    if lines.contains(line) { Ok(()) } else { Err(error(place, format!("there is no rubric line `{line}`"))) }
}

/// A search keeps what a definition uses in a few places.
fn definition_uses(expression: &Expression, equation: &Equation, place: &str) -> Checked<()> {
    let slots = expression.slots().iter();
    let used = slots.filter(|slot| equation.definition_in(**slot).is_some());
    if used.count() > MAX_INPUTS {
        let message = format!("uses more than {MAX_INPUTS} definitions");
        return Err(error(place, message));
    }
    Ok(())
}

fn probing(probes: &manifest::Probes, constants: &[Constant]) -> Checked<()> {
    let find = |name: &str, kind: Type| {
        let found = constants.iter().any(|c| c.name == name && c.kind == kind);
        found.then_some(()).ok_or_else(|| error("probes", format!("there is no {} constant `{name}`", kind.glsl())))
    };
    find(&probes.light, Type::Vec4)?;
    find(&probes.shininess, Type::Float)?;
    if probes.groups == 0 || probes.per_group == 0 {
        return Err(error("probes", "there are none"));
    }
    Ok(())
}

fn scene(s: &manifest::Scene) -> Checked<Scene> {
    let sane = s.near > 0.0
        && s.far > s.near
        && s.fovy > 0.0
        && s.fovy < std::f64::consts::PI
        && s.window.iter().all(|n| (1..=8192).contains(n))
        && (1..=10_000).contains(&s.poses);
    if !sane {
        return Err(error("scene", "the camera, the window or the number of poses makes no picture"));
    }
    let vertex = |i: usize| Vertex::new(s.triangle[i].into(), s.normals[i].into());
    let point = |p: [f64; 3]| DVec3::from_array(p);
    Ok(Scene {
        triangle: [vertex(0), vertex(1), vertex(2)],
        eye: point(s.eye),
        target: point(s.target),
        up: point(s.up),
        fovy: s.fovy,
        near: s.near,
        far: s.far,
        turn: s.turn,
        cycle: s.cycle,
        width: s.window[0],
        height: s.window[1],
        background: s.background,
        poses: s.poses,
    })
}

//! How probes are chosen, and what a right answer shows at them.

use super::solution::CheckedSolution;
use super::{CheckResult, listed};
use crate::assignment::{Assignment, Attribute, Constant, Input, Stream, error};
use crate::equation::{Definition, Reads};
use crate::interpreter::Type;
use crate::manifest::{self, RubricItem};
use crate::probes::{Aim, Design, Normal, Probing, Region};
use crate::text::both;
use std::collections::HashSet;
use std::ops::RangeInclusive;

/// The probes whose names are known and whose ranges are ranges.
pub(super) fn probing(
    entry: &manifest::Probes,
    constants: &[Constant],
    solution: &CheckedSolution<'_>,
) -> CheckResult<Probing> {
    if entry.groups == 0 || entry.per_group == 0 {
        return Err(error(
            "probes",
            both(
                "there are none: `groups` and `per_group` are 1 or more",
                "検査点がありません。`groups` と `per_group` は 1 以上にしてください",
            ),
        ));
    }
    if !entry.design.is_empty() && solution.reads() != Reads::Attributes {
        let message = both(
            "designs place vertices by the definitions of a vertex stage, which this solution does not have: remove them",
            "design は頂点シェーダの定義を使って頂点を置きますが、この解答にはその定義がありません。取り除いてください",
        );
        return Err(error("probes", message));
    }
    let aim = (!entry.design.is_empty()).then(|| aim(entry, constants, solution)).transpose()?;
    Ok(Probing { groups: entry.groups, per_group: entry.per_group, aim, takes_backs: false })
}

fn aim(entry: &manifest::Probes, constants: &[Constant], solution: &CheckedSolution<'_>) -> CheckResult<Aim> {
    let place = || "probes".to_owned();
    let is_power = |constant: &Constant| constant.name == entry.power && *constant.value.kind() == Type::FLOAT;
    let power = constants.iter().position(is_power);
    if power.is_none() && (!entry.power.is_empty() || entry.design.iter().any(|design| design.raised.is_some())) {
        return Err(error(
            "probes",
            both(
                format!("there is no float constant `{}`: `raised` needs it as `power`", entry.power),
                format!("float 型の定数 `{}` がありません。`raised` には `power` として必要です", entry.power),
            ),
        ));
    }
    let direction = |name: &str| solution.definition_of(name, &Type::VEC3, &place);
    let (axis, lobe) = (direction(&entry.axis)?, direction(&entry.lobe)?);
    let designs = entry.design.iter().zip(1..).map(|(entry, number)| design(entry, number, solution));
    Ok(Aim { axis, lobe, power, designs: designs.collect::<CheckResult<_>>()? })
}

fn design(entry: &manifest::DesignEntry, number: usize, solution: &CheckedSolution<'_>) -> CheckResult<Design> {
    let place = format!("probes, design {number}");
    let range = |range: manifest::Range, lowest: f64, highest: f64| -> CheckResult<RangeInclusive<f64>> {
        let [from, to] = range;
        let is_range = lowest <= from && from <= to && to <= highest;
        let wrong = || {
            error(
                &place,
                both(
                    format!("[{from}, {to}] is no range within [{lowest}, {highest}]"),
                    format!("[{from}, {to}] は [{lowest}, {highest}] に含まれる範囲ではありません"),
                ),
            )
        };
        is_range.then_some(from..=to).ok_or_else(wrong)
    };
    let normal = match (entry.cosine, entry.raised) {
        (Some(cosine), None) => Normal::Cosine(range(cosine, -1.0, 1.0)?),
        (None, Some(raised)) => Normal::Raised(range(raised, 0.0, 1.0)?),
        _ => {
            return Err(error(
                &place,
                both(
                    "write one of `cosine` and `raised`: how the normal stands",
                    "法線の向きを表す `cosine` と `raised` のどちらか一方を書いてください",
                ),
            ));
        }
    };
    let within = entry.within.iter().map(|(name, values)| {
        let definition = solution.definition_of(name, &Type::FLOAT, &|| place.clone())?;
        Ok((definition, range(*values, f64::MIN, f64::MAX)?))
    });
    Ok(Design {
        angle: range(entry.angle, 0.0, 180.0)?,
        distance: range(entry.distance, 0.0, f64::MAX)?,
        normal,
        within: within.collect::<CheckResult<_>>()?,
    })
}

/// The lobe is what a normal is chosen by: it has to be known before.
pub(super) fn lobe_is_known(assignment: &Assignment) -> CheckResult<()> {
    let Assignment { equation, interface, probing, .. } = assignment;
    let Some(Aim { lobe, .. }) = probing.aim else { return Ok(()) };
    let is_normal = |input: &Input| matches!(input.stream, Stream::Mesh(Attribute::Normal));
    let normals = equation.attributes.iter().zip(&interface.inputs);
    let normals: Vec<usize> = normals.filter(|(_, input)| is_normal(input)).filter_map(|(cell, _)| *cell).collect();
    let uses_normal =
        |(_, definition): &(usize, &Definition)| definition.formula.uses().iter().any(|cell| normals.contains(cell));
    let mut definitions = equation.definitions().iter().enumerate().filter(|(on, _)| equation.depends(lobe, *on));
    match definitions.find(uses_normal) {
        None => Ok(()),
        Some((_, Definition { name, .. })) => Err(error(
            "probes",
            both(
                format!("the lobe depends on the normal by `{name}`: name a direction that does not"),
                format!("ローブが `{name}` を通じて法線に依存しています。法線に依存しない方向を指定してください"),
            ),
        )),
    }
}

/// The regions whose conditions can be computed, and which the rubric knows.
pub(super) fn regions(
    entries: Vec<manifest::RegionEntry>,
    solution: &mut CheckedSolution<'_>,
    rubric: &[RubricItem],
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Vec<Region>> {
    let mut ids = HashSet::new();
    let mut regions = Vec::new();
    for entry in entries {
        let place = || {
            let first = place_at(entry.when.span().start);
            format!("{first}, region `{}`", entry.id)
        };
        if !ids.insert(entry.id.clone()) {
            return Err(error(place(), both("stands twice", "同じものが 2 回あります")));
        }
        let when = solution.condition(entry.when.get_ref(), &place)?;
        regions.push(Region { when, id: entry.id, seen: entry.seen, shows_clamps: entry.shows_clamps });
    }
    for line in rubric {
        if let Some(unknown) = line.alone_in.iter().find(|id| !ids.contains(*id)) {
            let known = listed(regions.iter().map(|region| region.id.as_str()));
            let message = both(
                format!("there is no region `{unknown}`, only {known}"),
                format!("領域 `{unknown}` はありません (あるもの: {known})"),
            );
            return Err(error(format!("rubric `{}`", line.id), message));
        }
    }
    Ok(regions)
}

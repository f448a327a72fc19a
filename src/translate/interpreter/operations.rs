//! The instructions that compute: SPIR-V specification, section 3.32, and `GLSL.std.450`.

use super::value::Value;
use glam::{DMat2, DMat3, DMat4};

/// The result of the instruction `opcode` for these operands; `None` for one that is not known here.
pub(super) fn compute(opcode: u16, operands: &[Value]) -> Option<Value> {
    let [first, rest @ ..] = operands else { return None };
    let second = rest.first();
    Some(match opcode {
        77 => first.parts()?.get(second?.int()? as usize)?.clone(),
        78 => {
            let mut parts = first.parts()?.to_vec();
            *parts.get_mut(rest.get(1)?.int()? as usize)? = second?.clone();
            Value::Composite(parts)
        }
        83 | 113 | 114 | 115 => first.clone(),
        84 => transposed(first)?,
        109 => first.map(&|x| Some(Value::Int(x.float()? as u32)))?,
        110 => first.map(&|x| Some(Value::Int(x.float()? as i32 as u32)))?,
        111 => first.map(&|x| Some(Value::Float(f64::from(x.int()? as i32))))?,
        112 => first.map(&|x| Some(Value::Float(f64::from(x.int()?))))?,
        124 => first.map(&bits)?,
        126 => first.map(&|x| Some(Value::Int(x.int()?.wrapping_neg())))?,
        127 => floats(first, |x| -x)?,
        129 => pairs(first, second?, |a, b| a + b)?,
        131 => pairs(first, second?, |a, b| a - b)?,
        133 => pairs(first, second?, |a, b| a * b)?,
        136 => pairs(first, second?, |a, b| a / b)?,
        140 => pairs(first, second?, |a, b| a % b)?,
        141 => pairs(first, second?, |a, b| a - b * (a / b).floor())?,
        142 | 143 => {
            let factor = second?.float()?;
            floats(first, |x| x * factor)?
        }
        144 => product_of_matrices(&transposed(second?)?, &Value::Composite(vec![first.clone()])).and_then(only)?,
        145 => product_of_matrices(first, &Value::Composite(vec![second?.clone()])).and_then(only)?,
        146 => product_of_matrices(first, second?)?,
        147 => {
            let column = |factor: &Value| -> Option<Value> {
                let factor = factor.float()?;
                floats(first, |x| x * factor)
            };
            Value::Composite(second?.parts()?.iter().map(column).collect::<Option<_>>()?)
        }
        148 => Value::Float(dot(first, second?)?),
        154 => Value::Bool(first.parts()?.iter().any(|part| part.bool() == Some(true))),
        155 => Value::Bool(first.parts()?.iter().all(|part| part.bool() == Some(true))),
        156 => first.map(&|x| Some(Value::Bool(x.float()?.is_nan())))?,
        157 => first.map(&|x| Some(Value::Bool(x.float()?.is_infinite())))?,
        164..=167 => truths(opcode, first, second?)?,
        168 => first.map(&|x| Some(Value::Bool(!x.bool()?)))?,
        169 => selected(first, second?, rest.get(1)?)?,
        180..=191 => comparison(opcode, first, second?)?,
        _ => return integers(opcode, first, second),
    })
}

fn floats(value: &Value, f: impl Fn(f64) -> f64) -> Option<Value> {
    value.map(&|x| Some(Value::Float(f(x.float()?))))
}

fn pairs(a: &Value, b: &Value, f: impl Fn(f64, f64) -> f64) -> Option<Value> {
    a.zip(b, &|a, b| Some(Value::Float(f(a.float()?, b.float()?))))
}

fn only(value: Value) -> Option<Value> {
    if let Value::Composite(parts) = value { parts.into_iter().next() } else { None }
}

fn dot(a: &Value, b: &Value) -> Option<f64> {
    Some(a.floats()?.iter().zip(b.floats()?).map(|(a, b)| a * b).sum())
}

fn length(value: &Value) -> Option<f64> {
    Some(value.floats()?.iter().map(|x| x * x).sum::<f64>().sqrt())
}

fn bits(value: &Value) -> Option<Value> {
    Some(match value {
        Value::Float(x) => Value::Int((*x as f32).to_bits()),
        Value::Int(bits) => Value::Int(*bits),
        _ => return None,
    })
}

fn columns(matrix: &Value) -> Option<Vec<Vec<f64>>> {
    matrix.parts()?.iter().map(Value::floats).collect()
}

fn transposed(matrix: &Value) -> Option<Value> {
    let columns = columns(matrix)?;
    let rows = columns.first()?.len();
    let row = |row: usize| Value::of_floats(&columns.iter().map(|column| column[row]).collect::<Vec<_>>());
    Some(Value::Composite((0..rows).map(row).collect()))
}

fn product_of_matrices(a: &Value, b: &Value) -> Option<Value> {
    let (a, b) = (columns(a)?, columns(b)?);
    let rows = a.first()?.len();
    let column = |factors: &Vec<f64>| {
        let number = |row: usize| a.iter().zip(factors).map(|(column, factor)| column[row] * factor).sum();
        Value::of_floats(&(0..rows).map(number).collect::<Vec<f64>>())
    };
    Some(Value::Composite(b.iter().map(column).collect()))
}

fn truths(opcode: u16, a: &Value, b: &Value) -> Option<Value> {
    a.zip(b, &|a, b| {
        let (a, b) = (a.bool()?, b.bool()?);
        Some(Value::Bool(match opcode {
            164 => a == b,
            165 => a != b,
            166 => a || b,
            _ => a && b,
        }))
    })
}

fn selected(condition: &Value, yes: &Value, no: &Value) -> Option<Value> {
    match condition {
        Value::Bool(truth) => Some(if *truth { yes } else { no }.clone()),
        _ => {
            let parts = condition.parts()?.iter().zip(yes.parts()?).zip(no.parts()?);
            let parts = parts.map(|((truth, yes), no)| Some(if truth.bool()? { yes } else { no }.clone()));
            Some(Value::Composite(parts.collect::<Option<_>>()?))
        }
    }
}

fn comparison(opcode: u16, a: &Value, b: &Value) -> Option<Value> {
    a.zip(b, &|a, b| {
        let (a, b) = (a.float()?, b.float()?);
        let holds = match opcode & !1 {
            180 => a == b,
            182 => a != b,
            184 => a < b,
            186 => a > b,
            188 => a <= b,
            _ => a >= b,
        };
        // The odd ones are also true where either is no number.
        Some(Value::Bool(holds || (opcode & 1 == 1 && (a.is_nan() || b.is_nan()))))
    })
}

fn integers(opcode: u16, first: &Value, second: Option<&Value>) -> Option<Value> {
    if opcode == 200 {
        return first.map(&|x| Some(Value::Int(!x.int()?)));
    }
    first.zip(second?, &|a, b| {
        let (a, b) = (a.int()?, b.int()?);
        let (c, d) = (a as i32, b as i32);
        Some(match opcode {
            128 => Value::Int(a.wrapping_add(b)),
            130 => Value::Int(a.wrapping_sub(b)),
            132 => Value::Int(a.wrapping_mul(b)),
            134 => Value::Int(a.checked_div(b)?),
            135 => Value::Int(c.checked_div(d)? as u32),
            137 => Value::Int(a.checked_rem(b)?),
            138 => Value::Int(c.checked_rem(d)? as u32),
            // Of negative numbers GLSL leaves it open: the sign is the dividend's, as it is when the shader runs.
            139 => Value::Int(c.checked_rem(d)? as u32),
            170 => Value::Bool(a == b),
            171 => Value::Bool(a != b),
            172 => Value::Bool(a > b),
            173 => Value::Bool(c > d),
            174 => Value::Bool(a >= b),
            175 => Value::Bool(c >= d),
            176 => Value::Bool(a < b),
            177 => Value::Bool(c < d),
            178 => Value::Bool(a <= b),
            179 => Value::Bool(c <= d),
            194 => Value::Int(a.checked_shr(b)?),
            195 => Value::Int(c.checked_shr(b)? as u32),
            196 => Value::Int(a.checked_shl(b)?),
            197 => Value::Int(a | b),
            198 => Value::Int(a ^ b),
            199 => Value::Int(a & b),
            _ => return None,
        })
    })
}

/// The result of the function `number` of `GLSL.std.450` for these arguments.
pub(super) fn extended(number: u32, arguments: &[Value]) -> Option<Value> {
    let [first, rest @ ..] = arguments else { return None };
    if let Some(f) = of_one(number) {
        return floats(first, f);
    }
    let second = rest.first();
    let third = rest.get(1);
    Some(match number {
        5 => first.map(&|x| Some(Value::Int((x.int()? as i32).wrapping_abs() as u32)))?,
        7 => first.map(&|x| Some(Value::Int((x.int()? as i32).signum() as u32)))?,
        25 => pairs(first, second?, f64::atan2)?,
        26 => pairs(first, second?, power)?,
        33 => Value::Float(determinant(first)?),
        34 => inverse(first)?,
        37 => pairs(first, second?, f64::min)?,
        40 => pairs(first, second?, f64::max)?,
        38 | 39 | 41 | 42 => first.zip(second?, &|a, b| {
            let (a, b) = (a.int()?, b.int()?);
            Some(Value::Int(match number {
                38 => a.min(b),
                39 => (a as i32).min(b as i32) as u32,
                41 => a.max(b),
                _ => (a as i32).max(b as i32) as u32,
            }))
        })?,
        43 => pairs(&pairs(first, second?, f64::max)?, third?, f64::min)?,
        46 => {
            let whole = pairs(first, &floats(third?, |x| 1.0 - x)?, |a, x| a * x)?;
            pairs(&whole, &pairs(second?, third?, |b, x| b * x)?, |a, b| a + b)?
        }
        48 => pairs(first, second?, |edge, x| if x < edge { 0.0 } else { 1.0 })?,
        49 => {
            let over = pairs(third?, first, |x, from| x - from)?;
            let share = pairs(&over, &pairs(second?, first, |to, from| to - from)?, |over, width| over / width)?;
            floats(&share, |t| {
                let t = t.clamp(0.0, 1.0);
                t * t * (3.0 - 2.0 * t)
            })?
        }
        50 => pairs(&pairs(first, second?, |a, b| a * b)?, third?, |a, b| a + b)?,
        53 => first.zip(second?, &|x, e| Some(Value::Float(x.float()? * f64::from(e.int()? as i32).exp2())))?,
        66 => Value::Float(length(first)?),
        67 => Value::Float(length(&pairs(first, second?, |a, b| a - b)?)?),
        68 => {
            let (a, b) = (first.floats()?, second?.floats()?);
            let [a, b] = [a, b].map(|v| <[f64; 3]>::try_from(v).ok().map(glam::DVec3::from));
            Value::of_floats(&a?.cross(b?).to_array())
        }
        69 => {
            let length = length(first)?;
            floats(first, |x| x / length)?
        }
        70 => {
            if dot(third?, second?)? < 0.0 {
                first.clone()
            } else {
                floats(first, |x| -x)?
            }
        }
        71 => {
            let along = 2.0 * dot(second?, first)?;
            pairs(first, second?, |i, n| i - along * n)?
        }
        72 => {
            let (eta, along) = (third?.float()?, dot(second?, first)?);
            let k = 1.0 - eta * eta * (1.0 - along * along);
            if k < 0.0 {
                floats(first, |_| 0.0)?
            } else {
                pairs(first, second?, |i, n| eta * i - (eta * along + k.sqrt()) * n)?
            }
        }
        _ => return None,
    })
}

/// Functions of one number.
fn of_one(number: u32) -> Option<fn(f64) -> f64> {
    Some(match number {
        1 => f64::round,
        2 => f64::round_ties_even,
        3 => f64::trunc,
        4 => f64::abs,
        6 => |x| if x == 0.0 { 0.0 } else { x.signum() },
        8 => f64::floor,
        9 => f64::ceil,
        10 => |x| x - x.floor(),
        11 => f64::to_radians,
        12 => f64::to_degrees,
        13 => f64::sin,
        14 => f64::cos,
        15 => f64::tan,
        16 => f64::asin,
        17 => f64::acos,
        18 => f64::atan,
        19 => f64::sinh,
        20 => f64::cosh,
        21 => f64::tanh,
        22 => f64::asinh,
        23 => f64::acosh,
        24 => f64::atanh,
        27 => f64::exp,
        28 => f64::ln,
        29 => f64::exp2,
        30 => f64::log2,
        31 => f64::sqrt,
        32 => |x| 1.0 / x.sqrt(),
        _ => return None,
    })
}

/// GLSL leaves the power of a negative base undefined; drivers take the logarithm of the base.
fn power(base: f64, exponent: f64) -> f64 {
    if base < 0.0 { f64::NAN } else { base.powf(exponent) }
}

fn flat(matrix: &Value) -> Option<Vec<f64>> {
    Some(columns(matrix)?.concat())
}

fn determinant(matrix: &Value) -> Option<f64> {
    let numbers = flat(matrix)?;
    Some(match numbers.len() {
        4 => DMat2::from_cols_slice(&numbers).determinant(),
        9 => DMat3::from_cols_slice(&numbers).determinant(),
        16 => DMat4::from_cols_slice(&numbers).determinant(),
        _ => return None,
    })
}

fn inverse(matrix: &Value) -> Option<Value> {
    let numbers = flat(matrix)?;
    Some(match numbers.len() {
        4 => Value::of_columns(&DMat2::from_cols_slice(&numbers).inverse().to_cols_array(), 2),
        9 => Value::of_columns(&DMat3::from_cols_slice(&numbers).inverse().to_cols_array(), 3),
        16 => Value::of_columns(&DMat4::from_cols_slice(&numbers).inverse().to_cols_array(), 4),
        _ => return None,
    })
}

//! What a number without a unit was meant to be.

use serde_json::Value;

use super::schema;
use crate::quantity::Dimension;

/// What to try where a number out of range has no unit: the unit that it was read in, and one that
/// it may have been meant in. `key` is its path in a scene or in a step.
pub(super) fn hint(key: &str, written: &str) -> Option<String> {
    let digits = written.trim_matches(['"', '\'']).replace('_', "");
    digits.parse().ok().filter(|x: &f64| x.is_finite())?;
    let steps = &schema()["properties"]["step"]["items"];
    let quantity = quantity(schema(), key).or_else(|| quantity(steps, key))?;
    let Quantity { dimension, least, most } = quantity;
    let bounded = least.is_some() || most.is_some();
    let (least, most) = (least.unwrap_or(f64::NEG_INFINITY), most.unwrap_or(f64::INFINITY));
    let meant = dimension.meant(&digits, least, most).filter(|_| bounded);
    let meant = meant.map(|text| format!("did you mean \"{text}\"?"));
    if dimension.si.is_empty() {
        return meant;
    }
    let unit = format!("a number without quotes is in {}", dimension.si);
    let example = || format!("write a unit, as in \"{}\"", dimension.example);
    Some(format!("{unit}; {}", meant.unwrap_or_else(example)))
}

/// What the schema says about a key that takes a quantity.
pub(super) struct Quantity {
    pub(super) dimension: &'static Dimension,
    pub(super) least: Option<f64>,
    pub(super) most: Option<f64>,
}

pub(super) fn quantity(root: &'static Value, path: &str) -> Option<Quantity> {
    let key = path.split('.').try_fold(root, inside)?;
    // A list of quantities has their unit.
    let single = |way: &&&Value| way["type"] != "array";
    let unit = |way: &Value| way["x-unit"].as_str().map(str::to_owned);
    let unit = ways(key).iter().filter(single).find_map(|way| unit(way))?;
    let unit = if unit == "a pure number" { "" } else { &unit };
    let bound = |name: &str| key[name].as_f64();
    let (least, most) = (bound("minimum"), bound("maximum"));
    Some(Quantity { dimension: Dimension::of_si(unit)?, least, most })
}

/// The schema of a part of a path such as `plane` or `any[1]`.
fn inside(schema: &'static Value, part: &str) -> Option<&'static Value> {
    let (name, indices) = part.split_once('[').unwrap_or((part, ""));
    let key = ways(schema).into_iter().find_map(|way| way["properties"].get(name))?;
    let item = |list: &'static Value| ways(list).into_iter().find_map(|way| way.get("items"));
    indices.matches(']').try_fold(key, |list, _| item(list))
}

/// A schema, or each of those that it is any of.
pub(super) fn ways(schema: &'static Value) -> Vec<&'static Value> {
    if let Some(name) = schema["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/")) {
        return ways(&self::schema()["$defs"][name]);
    }
    match schema["anyOf"].as_array() {
        Some(any) => any.iter().flat_map(ways).collect(),
        None => vec![schema],
    }
}

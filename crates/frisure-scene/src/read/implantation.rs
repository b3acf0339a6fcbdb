//! Reading `[implantation]` and `[[region]]`.

use frisure_hairstyle::{
    Flow, Implantation, InvalidSpec, Lift, Parting, RegionLength, RegionStyle,
};

use crate::choice::OneOf;
use crate::document::Document;
use crate::error::{Diagnostic, Result, SceneError};
use crate::keywords::{FlowWord, Keyword, PartingPlace, Places};
use crate::kind::{Pair, Points};

/// Reads how hair leaves the scalp; the rest are [numbers](Document::set_fields).
pub(super) fn implantation(document: &Document<'_>, to: &mut Implantation) -> Result<()> {
    to.flow = flow(document, to.flow)?;
    to.partings = partings(document)?;
    if let Some(angle) = document.number("implantation.lift") {
        to.lift = Lift::Uniform(angle);
    }
    if let Some(scale) = document.number("implantation.lift_scale") {
        to.lift = Lift::Regional { scale };
    }
    let whorls = &mut to.whorls;
    whorls.offset = document.get_or::<Pair>("implantation.whorl_offset", whorls.offset)?;
    whorls.turn = document.keyword("implantation.whorl_turn", whorls.turn)?;
    Ok(())
}

fn flow(document: &Document<'_>, preset: Flow) -> Result<Flow> {
    let parting = document.get::<PartingPlace>("implantation.parting")?;
    // A parting without a flow means parted hair.
    let is_parted = parting.is_some() || document.has("implantation.partings");
    let offset = match (&parting, preset) {
        (Some(Parting::Straight { offset } | Parting::Zigzag { offset }), _) => *offset,
        (None, Flow::Parted { offset }) => offset,
        _ => 0.0,
    };
    Ok(match document.get::<OneOf<FlowWord>>("implantation.flow")? {
        Some(FlowWord::Parted) => Flow::Parted { offset },
        None if is_parted => Flow::Parted { offset },
        None => preset,
        Some(_) if parting.is_some() => {
            let hint =
                "write `flow = \"parted\"`, or `partings = [{ at = \"left\" }]` beside this flow";
            let problem = "only parted hair has a parting at the place of the flow";
            return Err(document.error("implantation.parting", problem, hint));
        }
        Some(FlowWord::Whorl) => Flow::Whorl,
        Some(FlowWord::SweptBack) => Flow::SweptBack,
    })
}

/// Most partings: the root of each hair looks at all of them, and so does every point of the map of the flow. Chosen:
/// rows of braids all over a head have twenty.
const MAX_PARTINGS: usize = 32;

/// The partings that are not a straight line at the place of the flow.
fn partings(document: &Document<'_>) -> Result<Vec<Parting>> {
    let zigzag = document.get::<PartingPlace>("implantation.parting")?;
    if let Some(zigzag @ Parting::Zigzag { .. }) = zigzag {
        return Ok(vec![zigzag]);
    }
    let count = document.count_items("implantation.partings");
    let hint = "one parting goes through up to 100 points of a `line`";
    document.check_items("implantation.partings", MAX_PARTINGS, "partings", hint)?;
    (0..count).map(|i| parting(document, &format!("implantation.partings[{i}]"))).collect()
}

fn parting(document: &Document<'_>, table: &str) -> Result<Parting> {
    let (at, line) = (format!("{table}.at"), format!("{table}.line"));
    let through = document.get::<Points>(&line)?.map(Parting::Through);
    let Some(parting) = document.get::<PartingPlace>(&at)?.or(through) else {
        let problem = format!("`{table}` says nothing: a parting has `at` or `line`");
        return Err(document.error(table, problem, ""));
    };
    let written = if document.has(&at) { at } else { line };
    parting.check().map_err(|e| spec_error(&e, &written, document))?;
    Ok(parting)
}

/// Most regions: the root of each hair looks at all of them. A guard on time.
const MAX_REGIONS: usize = 1000;

/// The regions with styles of their own.
pub(super) fn regions(document: &Document<'_>) -> Result<Vec<RegionStyle>> {
    let count = document.count_items("region");
    let hint =
        "one region can have several parts of the scalp, as in `where = [\"top\", \"nape\"]`";
    document.check_items("region", MAX_REGIONS, "regions", hint)?;
    (0..count).map(|i| region(document, &format!("region[{i}]"))).collect()
}

fn region(document: &Document<'_>, table: &str) -> Result<RegionStyle> {
    let path = |key: &str| format!("{table}.{key}");
    let number = |key: &str| document.number(&path(key));
    let Some(places) = document.get::<Places>(&path("where"))? else {
        let hint = "add `where = \"fringe\"`, or another part of the scalp";
        return Err(document.error(table, format!("`{table}` is nowhere"), hint));
    };
    let down_to = document.get::<OneOf<Keyword<_>>>(&path("down_to"))?;
    let style = RegionStyle {
        places,
        length: match down_to {
            Some(Keyword(level)) => Some(RegionLength::DownTo(level)),
            None => number("length").map(RegionLength::Mean),
        },
        comb: document.get::<OneOf<Keyword<_>>>(&path("comb"))?.map(|Keyword(comb)| comb),
        lift: number("lift"),
        curl: number("curl"),
    };
    style.check().map_err(|e| spec_error(&e, &e.field.replace("region", table), document))?;
    Ok(style)
}

/// The error about a value that a hairstyle refuses.
fn spec_error(error: &InvalidSpec, path: &str, document: &Document<'_>) -> SceneError {
    let span = document.span(path);
    let written = document.source.slice(span.clone());
    // A list is long; the error names what is wrong in it.
    let value = if written.starts_with('[') { error.value.as_str() } else { written };
    Diagnostic::outside(error.allowed).key(path).value(value).at(document.source, span)
}

//! The columns of views: one row for each view of a head.

use frisure::scene::batch::{ViewCamera, ViewOutput, Views};
use parquet::data_type::ByteArray;

use super::column::{Column, Values};
use crate::row::StoredView;

/// Width of the film of Blender's cameras (mm): its default.
const FILM: f64 = 36.0;

/// All columns of the views of the head of an index.
pub(super) fn columns(index: usize, views: &Views, stored: &[StoredView]) -> Vec<Column> {
    let rows = || stored.iter().zip(&views.cameras);
    let count = |name: &str, of: fn(usize, &StoredView) -> usize| {
        let values = stored.iter().enumerate().map(|(place, view)| of(place, view));
        let values = values.map(|n| i32::try_from(n).ok()).collect();
        Column { name: name.into(), values: Values::Count(values) }
    };
    let number = |name: &str, of: fn(&StoredView, &ViewCamera) -> f64| {
        let values = rows().map(|(view, camera)| Some(of(view, camera))).collect();
        Column { name: name.into(), values: Values::Number(values) }
    };
    let matrix = |name: &str, of: fn(&StoredView) -> Vec<f64>| {
        let values = stored.iter().map(|view| Some(of(view))).collect();
        Column { name: name.into(), values: Values::Doubles(values) }
    };
    let names = rows().map(|(_, camera)| Some(camera.name.clone())).collect();
    let mut all = vec![
        Column {
            name: "index".into(),
            values: Values::Whole(vec![Some(index as i64); stored.len()]),
        },
        count("view", |place, _| place),
        Column { name: "camera".into(), values: Values::Text(names) },
        count("width", |_, view| view.camera.size[0]),
        count("height", |_, view| view.camera.size[1]),
        number("azimuth", |_, camera| camera.azimuth),
        number("elevation", |_, camera| camera.elevation),
        matrix("intrinsics", |view| view.camera.intrinsics().concat()),
        matrix("rotation", |view| view.camera.rotation().concat()),
        matrix("translation", |view| view.camera.translation().to_vec()),
        matrix("to_world", |view| view.camera.to_world().concat()),
        number("lens", |view, _| view.camera.focal * FILM / view.camera.size[0] as f64),
        number("sensor_width", |_, _| FILM),
        number("hair_width", |view, _| f64::from(view.width)),
    ];
    all.extend(views.outputs.iter().enumerate().map(|(place, output)| {
        let bytes = |view: &StoredView| Some(ByteArray::from(view.outputs[place].clone()));
        let values = Values::Bytes(stored.iter().map(bytes).collect());
        Column { name: output.name().into(), values }
    }));
    all
}

/// Whether an output is compressed already.
pub(super) fn is_png(output: ViewOutput) -> bool {
    matches!(output, ViewOutput::Color | ViewOutput::Mask | ViewOutput::Body)
}

//! Digitised lines in a table of text: one row for each point.

use std::collections::BTreeMap;

use glam::DVec3;
use thiserror::Error;

use crate::pose::{Fibre, Pose, PoseError};

/// Why a table has no lines.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TableError {
    /// A line that is no row of the table.
    #[error("line {line}: {problem}")]
    Malformed {
        /// From 1.
        line: u64,
        /// What is wrong.
        problem: String,
    },
    /// A column that is missing.
    #[error(
        "there is no column `{0}`; the first line has the headings x, y, z, and if wanted fibre, pose, s, gx, gy, gz, state"
    )]
    Column(&'static str),
    /// A length without a unit that is known.
    #[error("the heading `{heading}` has no unit that is known; write `{name} (mm)`, or m, cm, um")]
    Unit {
        /// The heading.
        heading: String,
        /// What it is about.
        name: String,
    },
    /// A cell that is no number.
    #[error("line {line}: `{value}` in the column `{column}` is no finite number")]
    Number {
        /// From 1.
        line: u64,
        /// The heading.
        column: String,
        /// The cell.
        value: String,
    },
    /// A pose that changes its gravity or state from row to row.
    #[error(
        "line {line}: the pose `{pose}` has other numbers in the columns gx, gy, gz, state than before"
    )]
    Changed {
        /// From 1.
        line: u64,
        /// Its name.
        pose: String,
    },
    /// A fibre that cannot be fitted.
    #[error("fibre `{fibre}`, from line {line} on: {problem}")]
    Fibre {
        /// Its name.
        fibre: String,
        /// Its first line, from 1.
        line: u64,
        /// Why.
        problem: PoseError,
    },
}

/// A fibre with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedFibre {
    /// As the table has it; `1` without such a column.
    pub name: String,
    /// Its lines.
    pub fibre: Fibre,
}

/// The columns of a table: their places, and the lengths' factors to metres.
struct Columns {
    position: [(usize, f64); 3],
    arc: Option<(usize, f64)>,
    fibre: Option<usize>,
    pose: Option<usize>,
    gravity: Option<[usize; 3]>,
    state: Option<usize>,
    headings: Vec<String>,
}

/// The points of a pose so far.
struct Rows {
    points: Vec<DVec3>,
    arc: Option<Vec<f64>>,
    gravity: DVec3,
    state: usize,
}

/// The lines of a table: a row for each point, in order from the clamp to the tip.
///
/// The columns `x (mm)`, `y (mm)`, `z (mm)` are positions (or m, cm, um), `s (mm)` the arc length from the clamp if it is known, `fibre` and `pose` names (one each
/// without them), `gx`, `gy`, `gz` the direction of gravity in these axes (its size counts: (0, 0, −1), the default, is 9.81 m/s²; (0, 0, 0) is a fibre without
/// weight), `state` a number from 0 for states of wetness. Cells are separated by commas, semicolons or tabs.
///
/// # Errors
/// [`TableError`], with the line.
pub fn read_table(text: &str, length: Option<f64>) -> Result<Vec<NamedFibre>, TableError> {
    let first = text.lines().find(|line| !line.trim_start().starts_with('#')).unwrap_or_default();
    let delimiter =
        [b'\t', b';'].into_iter().find(|d| first.as_bytes().contains(d)).unwrap_or(b',');
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let headings = reader.headers().map_err(malformed)?.iter().map(str::to_owned).collect();
    let columns = Columns::of(headings)?;
    // In the order of the table, each with its first line.
    let mut order: Vec<(String, u64, Vec<Rows>)> = Vec::new();
    let mut places: BTreeMap<(String, String), (usize, usize)> = BTreeMap::new();
    for record in reader.records() {
        let record = record.map_err(malformed)?;
        let line = record.position().map_or(0, csv::Position::line);
        let name = |column: Option<usize>| column.map_or("1", |c| &record[c]).to_owned();
        let (fibre, pose) = (name(columns.fibre), name(columns.pose));
        let row = columns.row(&record, line)?;
        match places.get(&(fibre.clone(), pose.clone())) {
            Some(&(f, p)) => order[f].2[p].append(row, line, &pose)?,
            None => {
                let f = match order.iter().position(|(known, _, _)| *known == fibre) {
                    Some(f) => f,
                    None => {
                        order.push((fibre.clone(), line, Vec::new()));
                        order.len() - 1
                    }
                };
                order[f].2.push(row);
                places.insert((fibre, pose), (f, order[f].2.len() - 1));
            }
        }
    }
    let fibre = |(name, line, rows): (String, u64, Vec<Rows>)| {
        let poses = rows.into_iter().map(|r| Pose::new(r.points, r.arc, r.gravity, r.state));
        let fibre = poses.collect::<Result<_, _>>().and_then(|poses| Fibre::new(poses, length));
        match fibre {
            Ok(fibre) => Ok(NamedFibre { name, fibre }),
            Err(problem) => Err(TableError::Fibre { fibre: name, line, problem }),
        }
    };
    order.into_iter().map(fibre).collect()
}

fn malformed(error: csv::Error) -> TableError {
    let line = error.position().map_or(1, csv::Position::line);
    let problem = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("the row has {len} cells, and there are {expected_len} headings")
        }
        _ => error.to_string(),
    };
    TableError::Malformed { line, problem }
}

impl Columns {
    fn of(headings: Vec<String>) -> Result<Self, TableError> {
        let name = |heading: &str| {
            heading.split(['(', '_']).next().unwrap_or_default().trim().to_lowercase()
        };
        let find = |wanted: &str| headings.iter().position(|heading| name(heading) == wanted);
        let length = |column: usize| {
            let heading = &headings[column];
            let unit = heading.split(['(', '_']).nth(1).unwrap_or_default();
            let factor = match unit.trim_end_matches(')').trim() {
                "m" => 1.0,
                "cm" => 1e-2,
                "mm" => 1e-3,
                "um" | "µm" | "μm" => 1e-6,
                _ => {
                    let (heading, name) = (heading.clone(), name(heading));
                    return Err(TableError::Unit { heading, name });
                }
            };
            Ok((column, factor))
        };
        let needed =
            |wanted: &'static str| find(wanted).ok_or(TableError::Column(wanted)).and_then(length);
        let gravity = match (find("gx"), find("gy"), find("gz")) {
            (Some(x), Some(y), Some(z)) => Some([x, y, z]),
            (None, None, None) => None,
            (x, y, _) => {
                let missing = if x.is_none() {
                    "gx"
                } else if y.is_none() {
                    "gy"
                } else {
                    "gz"
                };
                return Err(TableError::Column(missing));
            }
        };
        Ok(Self {
            position: [needed("x")?, needed("y")?, needed("z")?],
            arc: find("s").map(length).transpose()?,
            fibre: find("fibre").or(find("fiber")),
            pose: find("pose"),
            gravity,
            state: find("state"),
            headings: headings.clone(),
        })
    }

    fn row(&self, record: &csv::StringRecord, line: u64) -> Result<Rows, TableError> {
        let number = |column: usize| {
            let value = &record[column];
            value.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(|| TableError::Number {
                line,
                column: self.headings[column].clone(),
                value: value.chars().take(60).collect(),
            })
        };
        let length = |(column, factor): (usize, f64)| number(column).map(|x| x * factor);
        let [x, y, z] = self.position;
        let gravity = match self.gravity {
            None => DVec3::NEG_Z,
            Some([x, y, z]) => DVec3::new(number(x)?, number(y)?, number(z)?),
        };
        let state = self.state.map_or(Ok(0.0), number)?;
        if !((0.0..100.0).contains(&state) && state.fract() == 0.0) {
            let column = "state".to_owned();
            return Err(TableError::Number { line, column, value: state.to_string() });
        }
        Ok(Rows {
            points: vec![DVec3::new(length(x)?, length(y)?, length(z)?)],
            arc: self.arc.map(|arc| length(arc).map(|s| vec![s])).transpose()?,
            gravity: gravity * crate::known::STANDARD_GRAVITY,
            state: state as usize,
        })
    }
}

impl Rows {
    fn append(&mut self, row: Self, line: u64, pose: &str) -> Result<(), TableError> {
        if row.gravity != self.gravity || row.state != self.state {
            return Err(TableError::Changed { line, pose: pose.to_owned() });
        }
        self.points.extend(row.points);
        if let (Some(arc), Some(more)) = (&mut self.arc, row.arc) {
            arc.extend(more);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(heading: &str, row: impl Fn(usize) -> String) -> String {
        let rows: Vec<String> = (0..6).map(row).collect();
        format!("# made up\n{heading}\n{}\n", rows.join("\n"))
    }

    #[test]
    fn a_table_has_fibres_with_poses() {
        let both = table("fibre;pose;x (mm);y (mm);z (mm);s (mm);gx;gy;gz", |i| {
            let pose = if i < 3 { "a" } else { "b" };
            format!("7;{pose};{i};0;0;{i};0;0;{}", if i < 3 { -1 } else { 1 })
        });
        let few = read_table(&both, None).unwrap_err();
        assert_eq!(
            few.to_string(),
            "fibre `7`, from line 3 on: a line has 3 points; it must have at least 5"
        );
        let one = read_table(&table("x (cm),y (cm),z (cm)", |i| format!("{i},0,1")), Some(0.07));
        let [fibre] = one.unwrap().try_into().unwrap();
        assert_eq!(fibre.name, "1");
        assert_eq!(fibre.fibre.poses()[0].points()[5], DVec3::new(0.05, 0.0, 0.01));
        assert_eq!(fibre.fibre.length(0), Some(0.07));
    }

    #[test]
    fn errors_have_the_line() {
        let error = |text: &str| read_table(text, None).unwrap_err().to_string();
        assert!(error("x,y,z\n").contains("`x` has no unit that is known; write `x (mm)`"));
        assert!(
            error("x (in),y,z\n").contains("`x (in)` has no unit that is known; write `x (mm)`")
        );
        assert!(error("x (mm),y (mm)\n").contains("no column `z`"));
        let bad =
            table("x (mm),y (mm),z (mm)", |i| format!("{i},0,{}", if i == 2 { "ha" } else { "1" }));
        assert_eq!(error(&bad), "line 5: `ha` in the column `z (mm)` is no finite number");
        let short = error("x (mm),y (mm),z (mm)\n1,2\n");
        assert_eq!(short, "line 2: the row has 2 cells, and there are 3 headings");
        assert!(error("x (mm),y (mm),z (mm),gx\n").contains("no column `gy`"));
    }
}

//! Radiance pictures (Ward 1991, *Real pixels*): three mantissas and an exponent of eight bits each,
//! plain or in runs.

use super::map::{Environment, check_size};

/// Reads a picture, or says what is wrong with it.
pub(super) fn decode(bytes: &[u8], most: usize) -> Result<Environment, String> {
    let mut rest = bytes;
    let exposure = header(&mut rest)?;
    let (width, height) = size(&mut rest)?;
    check_size(width, height, most)?;
    let mut pixels = Vec::new();
    let mut row = vec![[0; 4]; width];
    for y in 0..height {
        let read = scanline(&mut rest, &mut row);
        read.ok_or_else(|| format!("ends or breaks in row {y} of {height}"))?;
        pixels.extend(row.iter().map(|rgbe| light(*rgbe).map(|x| x / exposure)));
    }
    Ok(Environment { width, height, pixels })
}

/// A line without its end, and what follows.
fn line<'a>(rest: &mut &'a [u8]) -> Option<&'a str> {
    /// No line of a header is longer.
    const LONGEST: usize = 4096;
    let end = rest.iter().take(LONGEST).position(|b| *b == b'\n')?;
    let (line, after) = (&rest[..end], &rest[end + 1..]);
    *rest = after;
    Some(std::str::from_utf8(line).unwrap_or("").trim_end_matches('\r'))
}

/// Reads the header, and gives the factor by which the pixels are too bright.
fn header(rest: &mut &[u8]) -> Result<f32, String> {
    if !rest.starts_with(b"#?") {
        return Err("is no Radiance picture: it does not begin with `#?`".into());
    }
    let (mut exposure, mut format) = (1.0, None);
    loop {
        let line = line(rest).ok_or("ends in its header")?;
        let (key, value) = line.split_once('=').unwrap_or((line, ""));
        match (key.trim(), value.trim()) {
            ("", _) => break,
            ("FORMAT", value) => format = Some(value.to_owned()),
            ("EXPOSURE", value) => exposure *= value.parse().unwrap_or(f32::NAN),
            _ => {}
        }
    }
    match format.as_deref() {
        None | Some("32-bit_rle_rgbe") => {}
        Some(other) => return Err(format!("holds {other}; only 32-bit_rle_rgbe is read")),
    }
    let good = exposure.is_finite() && exposure > 0.0;
    if good { Ok(exposure) } else { Err("has an exposure that is no positive number".into()) }
}

/// Width and height, from a line such as `-Y 512 +X 1024`.
fn size(rest: &mut &[u8]) -> Result<(usize, usize), String> {
    let line = line(rest).ok_or("ends before its size")?;
    let words: Vec<&str> = line.split_whitespace().collect();
    let [down, height, across, width] = words[..] else {
        return Err(format!("has `{line}` for a size; it should be as `-Y 512 +X 1024`"));
    };
    let numbers = width.parse().ok().zip(height.parse().ok());
    match numbers {
        Some(size) if (down, across) == ("-Y", "+X") => Ok(size),
        Some(_) => Err(format!("is turned (`{line}`); only rows from the top left are read")),
        None => Err(format!("has `{line}` for a size; it should be as `-Y 512 +X 1024`")),
    }
}

fn take<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
    let (first, after) = rest.split_first_chunk()?;
    *rest = after;
    Some(*first)
}

/// Reads a row; `None` where the bytes end or make no sense.
fn scanline(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Option<()> {
    let [a, b, high, low] = *rest.first_chunk()?;
    let runs = (8..32_768).contains(&row.len()) && (a, b) == (2, 2) && high < 128;
    if !runs {
        return old_scanline(rest, row);
    }
    if usize::from(high) << 8 | usize::from(low) != row.len() {
        return None;
    }
    *rest = &rest[4..];
    for channel in 0..4 {
        let mut x = 0;
        while x < row.len() {
            let [count] = take(rest)?;
            // Above 128 the same value several times, else that many values.
            let (n, same) = match count {
                0 => return None,
                129.. => (usize::from(count - 128), Some(take::<1>(rest)?)),
                _ => (usize::from(count), None),
            };
            for pixel in row.get_mut(x..x + n)? {
                let [value] = same.or_else(|| take(rest))?;
                pixel[channel] = value;
            }
            x += n;
        }
    }
    Some(())
}

/// A row of plain pixels; 1, 1, 1 and a count repeat the last.
fn old_scanline(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Option<()> {
    let (mut x, mut shift) = (0, 0);
    while x < row.len() {
        let pixel: [u8; 4] = take(rest)?;
        let [1, 1, 1, count] = pixel else {
            row[x] = pixel;
            (x, shift) = (x + 1, 0);
            continue;
        };
        if shift > 24 || x == 0 {
            return None;
        }
        let (n, last) = (usize::from(count) << shift, row[x - 1]);
        row.get_mut(x..x + n)?.fill(last);
        (x, shift) = (x + n, shift + 8);
    }
    Some(())
}

/// Light of mantissas and an exponent.
fn light([r, g, b, e]: [u8; 4]) -> [f32; 3] {
    let scale = if e == 0 { 0.0 } else { (f32::from(e) - 136.0).exp2() };
    [r, g, b].map(|m| f32::from(m) * scale)
}

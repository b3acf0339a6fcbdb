//! How two pictures differ.

/// What is compared, in linear light.
#[derive(Clone, Copy, Debug)]
pub struct Difference {
    /// Mean colours of what is not background in either.
    pub means: [[f64; 3]; 2],
    /// Root of the mean square of the difference of blocks' luminances, and the largest one.
    pub blocks: [f64; 2],
    /// Parts of the pixels that are not background.
    pub covered: [f64; 2],
}

/// Compares pictures of sRGB bytes of one size, in blocks of 16 pixels; what is within two steps of `empty`
/// is background.
pub fn compare(a: &[u8], b: &[u8], empty: &[u8], [width, height]: [u32; 2]) -> Difference {
    let (w, h) = (width as usize, height as usize);
    let shown =
        |image: &[u8], i: usize| (0..3).any(|c| image[4 * i + c].abs_diff(empty[4 * i + c]) > 2);
    let (mut means, mut count, mut covered) = ([[0.0; 3]; 2], 0.0, [0.0; 2]);
    let columns = w.div_ceil(16);
    let mut blocks = vec![(0.0, 0.0); columns * h.div_ceil(16)];
    for i in 0..w * h {
        let in_either = shown(a, i) || shown(b, i);
        let block = &mut blocks[i / w / 16 * columns + i % w / 16];
        block.1 += 1.0;
        for (k, image) in [a, b].into_iter().enumerate() {
            let c = [0, 1, 2].map(|c| linear(image[4 * i + c]));
            let luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
            block.0 += if k == 0 { -luminance } else { luminance };
            covered[k] += f64::from(u8::from(shown(image, i)));
            if in_either {
                (0..3).for_each(|j| means[k][j] += c[j]);
            }
        }
        count += f64::from(u8::from(in_either));
    }
    let n = (w * h) as f64;
    let differences = blocks.iter().map(|(sum, pixels)| sum / pixels);
    let square = differences.clone().map(|d| d * d).sum::<f64>() / blocks.len() as f64;
    Difference {
        means: means.map(|m| m.map(|c| c / f64::max(count, 1.0))),
        blocks: [square.sqrt(), differences.fold(0.0, |m, d| m.max(d.abs()))],
        covered: covered.map(|c| c / n),
    }
}

/// Linear value of an sRGB byte.
pub fn linear(byte: u8) -> f64 {
    let c = f64::from(byte) / 255.0;
    if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

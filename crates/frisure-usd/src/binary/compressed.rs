//! Compressed bytes and integers.
//!
//! Integers are kept as differences from the one before: two bits each say whether it is the commonest difference or
//! how many bytes it takes, then those bytes follow; all of it is an LZ4 block.

use std::collections::BTreeMap;

/// The most that an LZ4 block expands, and a little.
const MOST: u64 = 256;

/// Bytes as one LZ4 block.
pub(super) fn pack(bytes: &[u8]) -> Vec<u8> {
    // The first byte is the number of blocks, 0 for one that is not cut.
    let mut packed = vec![0];
    packed.extend(lz4_flex::block::compress(bytes));
    packed
}

/// The `size` bytes that were packed.
pub(super) fn unpack(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let mut bytes = unpack_at_most(packed, size)?;
    if bytes.len() < size {
        return Err(format!("{size} compressed bytes are only {}", bytes.len()));
    }
    bytes.truncate(size);
    Ok(bytes)
}

fn unpack_at_most(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let (&blocks, mut rest) = packed.split_first().ok_or("compressed bytes are missing")?;
    if size as u64 > MOST * packed.len() as u64 {
        return Err(format!("{} compressed bytes cannot be {size}", packed.len()));
    }
    let mut bytes = vec![0; size];
    if blocks == 0 {
        let n = block(rest, &mut bytes)?;
        bytes.truncate(n);
        return Ok(bytes);
    }
    let mut end = 0;
    for _ in 0..blocks {
        let (length, tail) = rest.split_at_checked(4).ok_or("a compressed block is cut short")?;
        let length = u32::from_le_bytes([length[0], length[1], length[2], length[3]]) as usize;
        let (one, tail) = tail.split_at_checked(length).ok_or("a compressed block is cut short")?;
        end += block(one, &mut bytes[end..])?;
        rest = tail;
    }
    bytes.truncate(end);
    Ok(bytes)
}

fn block(packed: &[u8], bytes: &mut [u8]) -> Result<usize, String> {
    lz4_flex::block::decompress_into(packed, bytes)
        .map_err(|e| format!("compressed bytes are damaged: {e}"))
}

/// 32-bit integers, compressed.
pub(super) fn pack_integers(values: &[i32]) -> Vec<u8> {
    let mut before = 0_i32;
    let differences: Vec<i32> = values
        .iter()
        .map(|&x| {
            let difference = x.wrapping_sub(before);
            before = x;
            difference
        })
        .collect();
    let common = commonest(&differences);
    let mut codes = vec![0_u8; differences.len().div_ceil(4)];
    let mut bytes = Vec::new();
    for (i, &difference) in differences.iter().enumerate() {
        let code = if difference == common {
            0
        } else if let Ok(small) = i8::try_from(difference) {
            bytes.extend(small.to_le_bytes());
            1
        } else if let Ok(middle) = i16::try_from(difference) {
            bytes.extend(middle.to_le_bytes());
            2
        } else {
            bytes.extend(difference.to_le_bytes());
            3
        };
        codes[i / 4] |= code << (2 * (i % 4));
    }
    let mut all = common.to_le_bytes().to_vec();
    all.extend(codes);
    all.extend(bytes);
    pack(&all)
}

/// The commonest number, of several the largest; 0 of none.
fn commonest(values: &[i32]) -> i32 {
    let mut counts = BTreeMap::<i32, usize>::new();
    for &x in values {
        *counts.entry(x).or_default() += 1;
    }
    counts.into_iter().max_by_key(|(x, n)| (*n, *x)).map_or(0, |(x, _)| x)
}

/// The `count` integers that were packed, each of 64 bits (`is_wide`) or 32.
pub(super) fn unpack_integers(
    packed: &[u8],
    count: usize,
    is_wide: bool,
) -> Result<Vec<i64>, String> {
    if count == 0 {
        return Ok(Vec::new());
    }
    // At best there are two bits to an integer.
    if count as u64 / 4 > MOST * packed.len() as u64 {
        return Err(format!("{} compressed bytes cannot be {count} integers", packed.len()));
    }
    let width = if is_wide { 8 } else { 4 };
    let first = width + count.div_ceil(4);
    let bytes = unpack_at_most(packed, (first + count * width).min(packed.len() * MOST as usize))?;
    let short = || format!("{count} compressed integers are cut short");
    let (codes, mut rest) = bytes.split_at_checked(first).ok_or_else(short)?;
    let (common, codes) = codes.split_at(width);
    let common = signed(common);
    let mut value = 0_i64;
    let mut integers = Vec::with_capacity(count);
    for i in 0..count {
        let code = codes[i / 4] >> (2 * (i % 4)) & 3;
        let length = if code == 0 { 0 } else { 1_usize << (code - 1) };
        // 1, 2 and 4 bytes; 2, 4 and 8 of wide ones.
        let length = if is_wide { length * 2 } else { length };
        let (difference, tail) = rest.split_at_checked(length).ok_or_else(short)?;
        rest = tail;
        value = value.wrapping_add(if code == 0 { common } else { signed(difference) });
        if !is_wide {
            // It wraps, as in its writer.
            value = i64::from(value as i32);
        }
        integers.push(value);
    }
    Ok(integers)
}

/// A little-endian number of 1 to 8 bytes.
fn signed(bytes: &[u8]) -> i64 {
    let negative = bytes.last().is_some_and(|b| b & 0x80 != 0);
    let mut all = [if negative { 0xff } else { 0 }; 8];
    all[..bytes.len()].copy_from_slice(bytes);
    i64::from_le_bytes(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_come_back() {
        let counts = vec![16; 1000];
        let mixed = vec![0, 1, -1, 127, 128, -129, 40_000, i32::MAX, i32::MIN, 5, 5, 5];
        for values in [vec![], vec![7], counts, mixed] {
            let packed = pack_integers(&values);
            let wide: Vec<i64> = values.iter().map(|&x| i64::from(x)).collect();
            assert_eq!(unpack_integers(&packed, values.len(), false).unwrap(), wide);
        }
        assert!(pack_integers(&vec![16; 100_000]).len() < 200);
    }

    #[test]
    fn counts_that_lie_take_no_memory() {
        let packed = pack_integers(&[1, 2, 3, 1000]);
        for count in [5, 1 << 20, usize::MAX / 16, usize::MAX] {
            assert!(unpack_integers(&packed, count, false).is_err(), "{count}");
        }
        assert!(unpack(&packed, usize::MAX).is_err());
        for n in 0..packed.len() {
            assert!(unpack_integers(&packed[..n], 4, false).is_err(), "{n}");
        }
    }

    #[test]
    fn bytes_in_several_blocks() {
        let mut packed = vec![2];
        for part in [b"strand ", b"guides "] {
            let block = lz4_flex::block::compress(part);
            packed.extend(u32::try_from(block.len()).unwrap().to_le_bytes());
            packed.extend(block);
        }
        assert_eq!(unpack(&packed, 14).unwrap(), b"strand guides ");
    }
}

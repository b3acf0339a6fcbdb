//! An order of the hairs of which each beginning is spread evenly over all of them.

/// Numbers 0 to `count` − 1 so that those of any first part are spread evenly: hairs of a wisp follow each
/// other in a groom, and each wisp keeps its share (the sequence of van der Corput).
pub(super) fn ranks(count: usize) -> Vec<u32> {
    let bits = count.next_power_of_two().trailing_zeros();
    let reversed = |i: u32| if bits == 0 { 0 } else { i.reverse_bits() >> (32 - bits) };
    (0..count.next_power_of_two() as u32).map(reversed).filter(|&i| (i as usize) < count).collect()
}

#[cfg(test)]
mod tests {
    use super::ranks;

    #[test]
    fn each_comes_once_and_a_quarter_is_spread() {
        for count in [0, 1, 2, 7, 1000, 1024] {
            let order = ranks(count);
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.iter().enumerate().all(|(i, &n)| i == n as usize), "{count}");
            assert_eq!(sorted.len(), count);
        }
        let mut quarter = ranks(1000)[..250].to_vec();
        quarter.sort_unstable();
        assert!(quarter.windows(2).all(|pair| pair[1] - pair[0] <= 8));
    }
}

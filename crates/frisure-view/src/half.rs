//! Numbers of 16 bits, as textures hold them.

/// The nearest 16-bit float (IEEE 754 binary16); what is too large becomes the largest, not-a-number 0.
pub(crate) fn half(value: f32) -> u16 {
    if value.is_nan() {
        return 0;
    }
    let bits = value.clamp(-65_504.0, 65_504.0).to_bits();
    let (sign, size) = ((bits >> 16) & 0x8000, bits & 0x7fff_ffff);
    let rest = if size < 0x3880_0000 {
        // Below 2⁻¹⁴: steps of 2⁻²⁴.
        (f32::from_bits(size) * 16_777_216.0 + 0.5) as u32
    } else {
        (size - 0x3800_0000 + 0x0fff + ((size >> 13) & 1)) >> 13
    };
    (sign | rest) as u16
}

/// Four of them.
pub(crate) fn halves(values: [f32; 4]) -> [u16; 4] {
    values.map(half)
}

#[cfg(test)]
mod tests {
    use super::half;

    #[test]
    fn known_numbers() {
        let pairs = [(0.0, 0), (1.0, 0x3c00), (-2.0, 0xc000), (65_504.0, 0x7bff), (1e9, 0x7bff)];
        for (value, bits) in pairs {
            assert_eq!(half(value), bits, "{value}");
        }
        assert_eq!((half(f32::NAN), half(6e-8), half(0.1)), (0, 1, 0x2e66));
    }
}

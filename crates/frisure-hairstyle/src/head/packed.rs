//! The numbers of the files of people, as `heads/make.py` writes them.

use glam::DVec3;

/// Numbers of a file, little-endian. The files are part of the program: they are as long as they should be.
pub(super) struct Reader<'a>(pub(super) &'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (first, rest) = self.0.split_first_chunk().expect("the file is part of the program");
        self.0 = rest;
        *first
    }

    pub(super) fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.take())
    }

    pub(super) fn f32(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }

    /// A table of `rows`: in each column the change from row to row, small ones of either sign as small numbers (2 n, or
    /// −2 n − 1); low bytes of all first, then high ones. So the page of the salon, which is compressed, weighs less.
    pub(super) fn columns<const N: usize>(&mut self, rows: usize) -> Vec<[u16; N]> {
        let (low, rest) = self.0.split_at(N * rows);
        let (high, rest) = rest.split_at(N * rows);
        self.0 = rest;
        let mut table = vec![[0; N]; rows];
        for column in 0..N {
            let mut value = 0_u16;
            for (row, out) in table.iter_mut().enumerate() {
                let at = column * rows + row;
                let code = u16::from_le_bytes([low[at], high[at]]);
                let change = if code & 1 == 0 { code >> 1 } else { !(code >> 1) };
                value = value.wrapping_add(change);
                out[column] = value;
            }
        }
        table
    }

    pub(super) fn point(&mut self) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| f64::from(self.f32())))
    }
}

//! The cache of strands.

use std::sync::Arc;

use frisure::hairstyle::head::Head;
use frisure::hairstyle::{Hairstyle, StrandOptions, strands};
use frisure::progress::{Cancelled, Progress};
use frisure::strands::Strands;

/// The strands that were drawn last, so that another light does not draw them again.
#[derive(Debug, Default)]
pub(crate) struct StrandCache {
    last: Option<(Arc<Hairstyle>, usize, Arc<Strands>)>,
}

impl StrandCache {
    /// Every `stride`-th hair.
    pub(crate) fn strands(
        &mut self,
        hairstyle: &Arc<Hairstyle>,
        head: &Head,
        stride: usize,
        progress: &dyn Progress,
    ) -> Result<Arc<Strands>, Cancelled> {
        if let Some((of, step, strands)) = &self.last
            && Arc::ptr_eq(of, hairstyle)
            && *step == stride
        {
            return Ok(strands.clone());
        }
        let options = StrandOptions { stride, ..StrandOptions::default() };
        let strands = Arc::new(strands(hairstyle, head, options, progress)?.strands);
        self.last = Some((hairstyle.clone(), stride, strands.clone()));
        Ok(strands)
    }
}

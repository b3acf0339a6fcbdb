//! The runner: loads the head of a scene, computes its hairstyle and draws its hairs, and caches all three.

use std::sync::Arc;

use frisure::files::Files;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{DrawnHair, Hairstyle, StrandOptions, strands};
use frisure::progress::Progress;
use frisure::scene::Scene;
use frisure::strands::Strands;

use crate::adoption::AdoptionReport;
use crate::error::Error;
use crate::hairstyles::{HairstyleCache, Input};
use crate::heads::{HeadCache, LoadedHead};
use crate::memory::{self, Work};
use crate::quality::{Quality, points};

/// Most points of drawn hairs in a browser, which has 4 GiB of memory in all. Chosen with room for a copy.
const MOST_POINTS_IN_BROWSER: usize = 32_000_000;

/// Loads scenes and computes their hairstyles and strands; a scene that differs little from an earlier one takes its
/// unchanged parts from the caches.
///
/// A hairstyle of [`Quality::Exact`] depends on the scene alone, to the last bit: it is the result of
/// [`frisure::hairstyle::predict`] and of each step after it. A hairstyle of [`Quality::Coarse`] is an approximation that
/// continues from the last one.
///
/// ```
/// use std::sync::Arc;
///
/// use frisure::scene::Scene;
/// use frisure_engine::{Quality, Runner};
///
/// let text = "[hair]\nlength = '3 cm'\n[wisps]\ncount = 3\nhairs = 30\n[[step]]\nwet = {}\n";
/// let scene = Arc::new(Scene::parse("short", text, "".as_ref())?);
/// let mut runner = Runner::default();
/// let dry = runner.load(&scene, 0, Quality::Exact, &())?;
/// let wet = runner.load(&scene, 1, Quality::Exact, &())?;
/// assert!(wet.metrics().tip_height < dry.metrics().tip_height);
/// # Ok::<(), frisure_engine::Error>(())
/// ```
#[derive(Debug)]
pub struct Runner {
    /// The files that scenes name: of the file system, or provided where there is none.
    pub files: Files,
    heads: Arc<HeadCache>,
    hairstyles: HairstyleCache,
    /// The strands that were drawn last, with their hairstyle and stride.
    strands: Option<(Arc<Hairstyle>, usize, Arc<Strands>)>,
    /// The number of runners that share the memory of the machine.
    runners: usize,
}

impl Default for Runner {
    fn default() -> Self {
        Self {
            files: Files::default(),
            heads: Arc::default(),
            hairstyles: HairstyleCache::default(),
            strands: None,
            runners: 1,
        }
    }
}

/// A scene with its head and its hairstyle.
#[derive(Clone, Debug)]
pub struct LoadedScene {
    /// The scene.
    pub scene: Arc<Scene>,
    /// Its head.
    pub head: Arc<Head>,
    /// What was guessed of the head, for a person.
    pub note: Option<String>,
    /// Its hairstyle.
    pub hairstyle: Arc<Hairstyle>,
    /// How well the groom of another program keeps its shape; none for hair that was predicted.
    pub adoption: Option<AdoptionReport>,
}

impl Runner {
    /// A runner that shares a cache of heads with others.
    #[must_use]
    pub fn new(heads: Arc<HeadCache>) -> Self {
        Self { heads, ..Self::default() }
    }

    /// The runner as one of so many that work at the same time: each has its share of the memory that is free.
    #[must_use]
    pub fn among(self, runners: usize) -> Self {
        Self { runners: runners.max(1), ..self }
    }

    /// Replaces the caches with empty ones of its own; files that were provided stay.
    pub fn clear(&mut self) {
        let (files, runners) = (std::mem::take(&mut self.files), self.runners);
        *self = Self { files, runners, ..Self::default() };
    }

    /// Loads a scene with the hairstyle after `done` of its steps; at most all.
    ///
    /// # Errors
    /// [`Error`], at the key of the scene that has to change, or [`Error::Invalid`] for guides that have no room in memory. The
    /// caches are still valid.
    pub fn load(
        &mut self,
        scene: &Arc<Scene>,
        done: usize,
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<LoadedScene, Error> {
        let spec = scene.hairstyle_spec()?;
        memory::check_among(self.runners, &spec, Work::Guides)?;
        let LoadedHead { head, note } = self.heads.load(scene, &self.files)?;
        let input = Input { scene, spec, head: &head, done, files: &self.files };
        let hairstyle = match quality {
            Quality::Coarse => self.hairstyles.coarse(&input, progress)?,
            Quality::Exact => self.hairstyles.exact(&input, progress)?,
        };
        let adoption = self.hairstyles.adoption(&input);
        Ok(LoadedScene { scene: scene.clone(), head, note, hairstyle, adoption })
    }

    /// Every `stride`-th hair of a scene; the last strands are cached, so that another light does not draw them again.
    ///
    /// # Errors
    /// [`Error::Cancelled`], and [`Error::Invalid`] for more points than there is memory for.
    pub fn strands(
        &mut self,
        loaded: &LoadedScene,
        stride: usize,
        progress: &dyn Progress,
    ) -> Result<Arc<Strands>, Error> {
        let points = points(&loaded.hairstyle);
        if cfg!(target_arch = "wasm32") && stride == 1 && points > MOST_POINTS_IN_BROWSER {
            let problem = format!("{points} points of hair are more than a page has memory for");
            return Err(Error::invalid(problem, "lower `wisps.density` or `wisps.points`"));
        }
        if let Some((of, step, strands)) = &self.strands
            && Arc::ptr_eq(of, &loaded.hairstyle)
            && *step == stride
        {
            return Ok(strands.clone());
        }
        if stride == 1 {
            memory::check_among(self.runners, loaded.hairstyle.spec(), Work::Hairs)?;
        }
        let options = StrandOptions { stride, ..StrandOptions::default() };
        let strands = Arc::new(loaded.draw(options, progress)?.strands);
        self.strands = Some((loaded.hairstyle.clone(), stride, strands.clone()));
        Ok(strands)
    }
}

impl LoadedScene {
    /// Draws the hairs.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub fn draw(
        &self,
        options: StrandOptions<'_>,
        progress: &dyn Progress,
    ) -> Result<DrawnHair, Error> {
        Ok(strands(&self.hairstyle, &self.head, options, progress)?)
    }
}

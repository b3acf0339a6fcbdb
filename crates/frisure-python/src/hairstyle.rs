//! Hairstyles: predicted, styled, drawn, written.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use frisure::formats::groom::{Fit, Format, Groom, write_groom};
use frisure::formats::report;
use frisure::hairstyle::{DrawnHair, StrandOptions, penetration};
use frisure::progress::Progress;
use frisure::scene::Scene;
use frisure::strands::Strands;
use frisure_engine::memory::{self, Work};
use frisure_engine::report::HairstyleReport;
use frisure_engine::{Error, LoadedScene, Quality, Runner};
use pyo3::prelude::*;

use crate::errors::raise;
use crate::scene::SceneText;
use crate::strands::{Part, StrandData};
use crate::work;

/// A hairstyle with the runner that predicted it, which knows the hairstyles before its last steps.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct Prediction {
    pub(crate) hair: Arc<Hair>,
}

/// A hairstyle, and what was computed from it.
pub(crate) struct Hair {
    runner: Arc<Mutex<Runner>>,
    pub(crate) loaded: LoadedScene,
    drawn: Mutex<Option<Arc<DrawnHair>>>,
    groom: Mutex<Option<Arc<Groom>>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The result of a computation that is kept; two at once may both compute it.
fn kept<T>(
    place: &Mutex<Option<Arc<T>>>,
    make: impl FnOnce() -> Result<T, Error>,
) -> Result<Arc<T>, Error> {
    if let Some(known) = lock(place).clone() {
        return Ok(known);
    }
    let made = Arc::new(make()?);
    Ok(lock(place).insert(made).clone())
}

impl Hair {
    fn predicted(
        runner: Arc<Mutex<Runner>>,
        scene: &Arc<Scene>,
        progress: &dyn Progress,
    ) -> Result<Self, Error> {
        memory::check(&scene.hairstyle_spec()?, Work::Guides)?;
        let loaded = {
            let mut runner = lock(&runner);
            // Another prediction with this runner may have taken long.
            progress.check()?;
            runner.load(scene, scene.steps().len(), Quality::Exact, progress)?
        };
        Ok(Self { runner, loaded, drawn: Mutex::default(), groom: Mutex::default() })
    }

    /// The drawn hairs.
    pub(crate) fn drawn(&self, progress: &dyn Progress) -> Result<Arc<DrawnHair>, Error> {
        kept(&self.drawn, || {
            memory::check(self.loaded.hairstyle.spec(), Work::Hairs)?;
            self.loaded.draw(StrandOptions::default(), progress)
        })
    }

    /// The drawn hairs and the guides with all their attributes.
    fn groom(&self, progress: &dyn Progress) -> Result<Arc<Groom>, Error> {
        kept(&self.groom, || {
            let hairs = self.drawn(progress)?.strands.clone();
            Ok(self.loaded.groom(hairs, false))
        })
    }

    /// The report that the command line writes.
    fn report(&self, progress: &dyn Progress) -> Result<HairstyleReport, Error> {
        let drawn = self.drawn(progress)?;
        let mut report = self.loaded.report(Some(&drawn));
        report.hair_penetration = Some(penetration(&drawn.strands, &self.loaded.head));
        report.steps = lock(&self.runner).step_reports(&self.loaded.scene, progress)?;
        Ok(report)
    }

    /// Writes the groom to a file, as the command line does.
    fn save(&self, path: &Path, fibres: bool, progress: &dyn Progress) -> Result<(), Error> {
        let format = Format::of(path).map_err(|e| Error::because(&e, ""))?;
        let groom = match fibres {
            true => Arc::new(self.loaded.groom(self.drawn(progress)?.strands.clone(), true)),
            false => self.groom(progress)?,
        };
        let fit = Fit::default().or_usual(format, None, &groom);
        let fitted = (!fit.is_nothing()).then(|| groom.fitted(fit)).transpose();
        let fitted = fitted.map_err(|e| Error::because(&e, ""))?;
        progress.check()?;
        let written = fitted.as_ref().map_or(&*groom, |fitted| &fitted.groom);
        write_groom(path, written, Default::default()).map_err(|e| Error::failed(&e, ""))
    }
}

#[pymethods]
impl Prediction {
    /// Predicts the hairstyle of a scene after its steps.
    #[staticmethod]
    #[pyo3(signature = (scene, progress))]
    fn of(
        py: Python<'_>,
        scene: &SceneText,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (scene, runner) = (scene.scene.clone(), Arc::default());
        let hair = work::run(py, progress, move |p| Hair::predicted(runner, &scene, p))?;
        Ok(Self { hair: Arc::new(hair) })
    }

    /// The hairstyle of another scene; what is the same in this one is not computed again.
    #[pyo3(signature = (scene, progress))]
    fn follow(
        &self,
        py: Python<'_>,
        scene: &SceneText,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (scene, runner) = (scene.scene.clone(), self.hair.runner.clone());
        let hair = work::run(py, progress, move |p| Hair::predicted(runner, &scene, p))?;
        Ok(Self { hair: Arc::new(hair) })
    }

    /// The drawn hairs.
    #[pyo3(signature = (progress))]
    fn hairs(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<StrandData> {
        let hair = self.hair.clone();
        let groom = work::run(py, progress, move |p| hair.groom(p))?;
        Ok(StrandData { groom, part: Part::Hairs })
    }

    /// The guides; the hairs are not drawn for them.
    fn guides(&self, py: Python<'_>) -> PyResult<StrandData> {
        if let Some(groom) = lock(&self.hair.groom).clone() {
            return Ok(StrandData { groom, part: Part::Guides });
        }
        let hair = self.hair.clone();
        let groom = work::run(py, None, move |_| Ok(hair.loaded.groom(Strands::new(), false)))?;
        Ok(StrandData { groom: Arc::new(groom), part: Part::Guides })
    }

    /// The report as JSON.
    #[pyo3(signature = (progress))]
    fn report(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        let hair = self.hair.clone();
        let report = work::run(py, progress, move |p| hair.report(p))?;
        serde_json::to_string(&report).map_err(|e| raise(py, &Error::failed(&e, "")))
    }

    /// How many guides there are, and how many of them are at a minimum of their energy.
    fn guides_at_rest(&self, py: Python<'_>) -> PyResult<(usize, usize)> {
        let hair = self.hair.clone();
        let settling = work::run(py, None, move |_| Ok(hair.loaded.metrics().settling))?;
        Ok((settling.guides, settling.stable))
    }

    /// Writes the hairs and the guides to a file of a groom.
    #[pyo3(signature = (path, fibres, progress))]
    fn save(
        &self,
        py: Python<'_>,
        path: PathBuf,
        fibres: bool,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let hair = self.hair.clone();
        work::run(py, progress, move |p| hair.save(&path, fibres, p))
    }
    /// Writes the report to a file, as JSON.
    #[pyo3(signature = (path, progress))]
    fn save_report(
        &self,
        py: Python<'_>,
        path: PathBuf,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let hair = self.hair.clone();
        work::run(py, progress, move |p| {
            let report = hair.report(p)?;
            p.check()?;
            report::write(&path, &report).map_err(|e| Error::failed(&e, ""))
        })
    }
}

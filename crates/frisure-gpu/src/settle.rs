//! Hairs to rest on the device, and before the judge.

use std::time::Instant;

use frisure_rod::Rod;
use frisure_rod::batch::{Batch, Batched, Precision, Settle, Settled, Unsettled};
use glam::DVec3;
use rayon::prelude::*;

use crate::part::Measure;
use crate::room::Progress;
use crate::{Device, Error};

/// Relative gradient at rest on the device: what single precision reaches for sure. From there the judge needs one step.
const TOLERANCE: f64 = 1e-5;

/// Most sweeps of a hair on the device: what takes longer drowns in rounding.
const SWEEPS: usize = 60;

/// Hairs that a thread judges at a time.
const CHUNK: usize = 512;

/// Brings hairs to rest on a device.
#[derive(Clone, Copy, Debug)]
pub struct OnDevice<'a> {
    device: &'a Device,
    batch: Batch,
    at_once: usize,
}

/// What it took to bring a batch to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Hairs of the batch.
    pub hairs: usize,
    /// Parts in which they went to the device, one after the other.
    pub parts: usize,
    /// Newton sweeps on the device, of all hairs together.
    pub sweeps: u64,
    /// Hairs that did not come to rest there: the judge took them from their start.
    pub given_up: usize,
    /// Where the time went.
    pub seconds: Seconds,
}

/// Wall-clock time of each stage (s).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seconds {
    /// Dividing hairs into joints, on the processor.
    pub divide: f64,
    /// Room on the device, and hairs to it.
    pub upload: f64,
    /// Sweeps, and telling who has come to rest.
    pub device: f64,
    /// Shapes from the device.
    pub download: f64,
    /// The processor's last steps in double precision.
    pub judge: f64,
}

impl Seconds {
    /// All of it but the judge.
    #[must_use]
    pub fn before_the_judge(&self) -> f64 {
        self.divide + self.upload + self.device + self.download
    }
}

/// What the device says of hairs, in single precision: a start for the judge, not an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Unjudged {
    /// Turns of the joints (rad), those of a hair one after the other. A hair that was given up is as it started.
    pub controls: Vec<DVec3>,
    /// Whether each came to rest, as far as single precision can tell.
    pub settled: Vec<bool>,
    /// Newton sweeps of each.
    pub sweeps: Vec<u32>,
    /// What it took; there is no judge in it.
    pub report: Report,
}

impl<'a> OnDevice<'a> {
    pub(crate) fn new(device: &'a Device, batch: Batch) -> Self {
        Self { device, batch, at_once: usize::MAX }
    }

    /// With no more than so many hairs on the device at once, in whole workgroups of 64: to leave memory to others. As many as
    /// the device has room for if this is not called.
    #[must_use]
    pub fn at_once(self, hairs: usize) -> Self {
        Self { at_once: hairs, ..self }
    }

    /// Brings hairs to rest in their own weight, from their natural shapes: on the device in single precision, then each
    /// on the processor in double precision to the tolerance of the batch, in rayon's threads.
    ///
    /// # Errors
    /// [`Error`] if the device cannot; never for a hair.
    pub fn settle(&self, rods: &[Rod]) -> Result<(Batched, Report), Error> {
        self.settle_from(rods, self.natural(rods)?)
    }

    /// The same, from other shapes: the turn of each joint (rad), those of a hair one after the other.
    ///
    /// # Errors
    /// As [`Self::settle`], and [`Error::Turns`].
    pub fn settle_from(
        &self,
        rods: &[Rod],
        controls: Vec<DVec3>,
    ) -> Result<(Batched, Report), Error> {
        let Unjudged { controls, sweeps, mut report, .. } = self.unjudged_from(rods, controls)?;
        let clock = Instant::now();
        let mut found = self.judged(rods, &controls);
        for (hair, sweeps) in found.hairs.iter_mut().zip(sweeps) {
            hair.iterations += sweeps as usize;
        }
        report.seconds.judge = clock.elapsed().as_secs_f64();
        Ok((found, report))
    }

    /// What the device alone says, from natural shapes.
    ///
    /// # Errors
    /// As [`Self::settle`].
    pub fn unjudged(&self, rods: &[Rod]) -> Result<Unjudged, Error> {
        self.unjudged_from(rods, self.natural(rods)?)
    }

    /// What the device alone says, from other shapes.
    ///
    /// # Errors
    /// As [`Self::settle_from`].
    pub fn unjudged_from(&self, rods: &[Rod], mut controls: Vec<DVec3>) -> Result<Unjudged, Error> {
        let measure = self.measure(rods)?;
        let joints = measure.joints;
        let (given, needed) = (controls.len(), rods.len() * joints);
        if given != needed {
            return Err(Error::Turns { given, needed });
        }
        let mut settled = Vec::with_capacity(rods.len());
        let mut sweeps = Vec::with_capacity(rods.len());
        let mut report = Report { hairs: rods.len(), ..Report::default() };
        if !rods.is_empty() {
            let mut watch = Watch(Instant::now());
            let mut room = self.device.room(measure)?;
            watch.stop(&mut report.seconds.upload);
            let parts = rods.chunks(measure.hairs);
            for (rods, controls) in parts.zip(controls.chunks_mut(measure.hairs * joints)) {
                let seconds = &mut report.seconds;
                room.part.fill(rods, controls);
                watch.stop(&mut seconds.divide);
                let (progress, numbers) = self.device.watched(|| {
                    room.load(self.device, rods.len())?;
                    watch.stop(&mut seconds.upload);
                    let (tolerance, most) = (self.tolerance(), self.most());
                    let progress = room.settle(self.device, rods.len(), tolerance, most)?;
                    watch.stop(&mut seconds.device);
                    Ok((progress, room.controls(self.device)?))
                })?;
                let before = settled.len();
                settled.extend(progress.iter().map(Progress::is_settled));
                room.part.unpack(&numbers, &mut settled[before..], controls);
                sweeps.extend(progress.iter().map(|hair| hair.sweeps));
                watch.stop(&mut seconds.download);
                report.parts += 1;
            }
            self.device.keep(room);
        }
        report.sweeps = sweeps.iter().map(|&n| u64::from(n)).sum();
        report.given_up = settled.iter().filter(|settled| !**settled).count();
        Ok(Unjudged { controls, settled, sweeps, report })
    }

    /// The processor's word on hairs that start near rest, or not.
    fn judged(&self, rods: &[Rod], controls: &[DVec3]) -> Batched {
        let judge = Batch { precision: Precision::Double, ..self.batch };
        let elements = judge.elements;
        let chunks = rods.par_chunks(CHUNK).zip(controls.par_chunks(CHUNK * elements));
        let found: Vec<Batched> =
            chunks.map(|(rods, controls)| judge.settle_from(rods, controls.to_vec())).collect();
        let mut all = Batched {
            elements,
            controls: Vec::with_capacity(controls.len()),
            hairs: Vec::<Settled>::with_capacity(rods.len()),
        };
        for batched in found {
            all.controls.extend(batched.controls);
            all.hairs.extend(batched.hairs);
        }
        all
    }

    fn measure(&self, rods: &[Rod]) -> Result<Measure, Error> {
        let limits = self.device.device.limits();
        let bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        Measure::of(rods, self.batch.elements, bytes, self.at_once)
    }

    fn natural(&self, rods: &[Rod]) -> Result<Vec<DVec3>, Error> {
        let measure = self.measure(rods)?;
        Ok(vec![DVec3::ZERO; rods.len() * measure.joints])
    }

    fn tolerance(&self) -> f32 {
        self.batch.tolerance.max(TOLERANCE) as f32
    }

    fn most(&self) -> u32 {
        self.batch.max_iterations.min(SWEEPS) as u32
    }
}

impl Settle for OnDevice<'_> {
    fn settle(&self, rods: &[Rod]) -> Result<Batched, Unsettled> {
        let (found, _) = self.settle(rods)?;
        Ok(found)
    }

    fn settle_from(&self, rods: &[Rod], controls: Vec<DVec3>) -> Result<Batched, Unsettled> {
        let (found, _) = self.settle_from(rods, controls)?;
        Ok(found)
    }
}

/// Time since it was last looked at.
struct Watch(Instant);

impl Watch {
    fn stop(&mut self, seconds: &mut f64) {
        let now = Instant::now();
        *seconds += now.duration_since(self.0).as_secs_f64();
        self.0 = now;
    }
}

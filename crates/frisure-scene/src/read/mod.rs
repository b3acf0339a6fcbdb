//! Reading: from the text of a scene to a [`Scene`](crate::Scene), with presets filled in and contradictions refused.

mod hair;
mod head;
mod implantation;
mod light;
mod look;
mod scene;
mod section;

//! Does what a scene asks for.
//!
//! A scene is data; this crate carries it out, for every program alike: its head, its hair with
//! every step, and what a picture of it is made with.

mod bytes;
pub mod order;
pub mod picture;

pub mod files {
    pub fn provide(_path: &str, _bytes: Vec<u8>) {}
}
pub trait Watch: Sync {
    fn tell(&self, answer: order::Answer);
    fn cancelled(&self) -> bool;
}
pub struct Stylist;
impl Stylist {
    pub fn new() -> Self {
        Self
    }
    pub fn carry_out(&mut self, order: &order::Order, watch: &dyn Watch) -> order::Answer {
        let steps = if let order::Order::Show { asked, .. } = order
            && asked.name == "again"
        {
            200_000_000u64
        } else {
            100_000
        };
        let mut x = 0.0f64;
        for i in 0..steps {
            x += (i as f64).sin();
            if i % 100_000 == 0 {
                watch.tell(order::Answer::Progress {
                    stage: "working".into(),
                    fraction: i as f32 / steps as f32,
                });
                if watch.cancelled() {
                    return order::Answer::Cancelled;
                }
            }
        }
        if x == 0.5 {
            panic!("never")
        }
        order::Answer::Shown(Box::default())
    }
}

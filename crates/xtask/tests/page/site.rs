//! The page, built and served by the program that people use.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

/// A server of the page. Dropped, it ends.
pub(crate) struct Site {
    server: Child,
    /// Where the page is.
    pub(crate) address: String,
}

/// Builds the page; seconds if nothing changed, minutes the first time.
pub(crate) fn build() {
    let done = xtask().arg("page").status().expect("xtask");
    assert!(done.success(), "the page does not build");
}

/// Serves it with more arguments.
pub(crate) fn serve(more: &[&str]) -> Site {
    let mut server = xtask()
        .args(["page", "--built", "--serve", "0"])
        .args(more)
        .stdout(Stdio::piped())
        .spawn()
        .expect("xtask");
    let mut line = String::new();
    let mut out = BufReader::new(server.stdout.take().expect("a pipe"));
    out.read_line(&mut line).expect("its first line");
    let address =
        line.split_whitespace().find(|word| word.starts_with("http")).expect("an address");
    Site { server, address: address.to_owned() }
}

fn xtask() -> Command {
    Command::new(env!("CARGO_BIN_EXE_xtask"))
}

impl Site {
    /// Ends it.
    pub(crate) fn stop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Drop for Site {
    fn drop(&mut self) {
        self.stop();
    }
}

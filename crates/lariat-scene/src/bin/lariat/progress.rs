//! A progress bar on stderr, if that is a terminal and the run is longer than a second.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

/// Ticks of the bar.
const TICKS: f64 = 1000.0;

pub struct Bar {
    duration: f64,
    start: Instant,
    terminal: bool,
    bar: Option<ProgressBar>,
}

impl Bar {
    pub fn new(duration: f64) -> Self {
        Bar { duration, start: Instant::now(), terminal: stderr().is_terminal(), bar: None }
    }

    pub fn advance(&mut self, time: f64) {
        if !self.terminal || (self.bar.is_none() && self.start.elapsed() < Duration::from_secs(1)) {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::new(TICKS as u64);
            match ProgressStyle::with_template("{wide_bar} {percent}% {msg} (ETA {eta})") {
                Ok(style) => bar.with_style(style).with_elapsed(self.start.elapsed()),
                Err(_) => bar,
            }
        });
        bar.set_position((TICKS * time / self.duration) as u64);
        bar.set_message(format!("{time:.2} of {} s", self.duration));
    }

    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

//! A progress bar on stderr, if that is a terminal and the run is longer than a second. A study
//! that is longer says there, terminal or not, when each of its runs begins.

use indicatif::{ProgressBar, ProgressStyle};
use lariat_ancf::study::Resolution;
use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

/// Ticks of the bar.
const TICKS: f64 = 1000.0;

pub struct Bar {
    duration: f64,
    start: Instant,
    terminal: bool,
    bar: Option<ProgressBar>,
    /// Number and elements of the present run, if there are several.
    run: Option<(u32, usize)>,
}

impl Bar {
    pub fn new(duration: f64) -> Self {
        Bar { duration, start: Instant::now(), terminal: stderr().is_terminal(), bar: None, run: None }
    }

    /// Begins the next run of a study.
    pub fn begin_run(&mut self, resolution: &Resolution) {
        let Resolution { elements, tolerance, max_step, parts, .. } = *resolution;
        let number = self.run.map_or(1, |(number, _)| number + 1);
        self.run = Some((number, elements));
        let elapsed = self.start.elapsed();
        if elapsed < Duration::from_secs(1) {
            return;
        }
        let tolerance = tolerance.map_or(String::new(), |tolerance| format!(", tolerance {tolerance:.1e} m"));
        let steps = max_step.map_or(String::new(), |step| format!(", steps of {step:.1e} s"));
        let parts = if parts > 1 { format!(", host steps in {parts} parts") } else { String::new() };
        let seconds = elapsed.as_secs_f64();
        let line = format!("study, {seconds:.0} s: run {number} with elements = {elements}{tolerance}{steps}{parts}");
        match &self.bar {
            Some(bar) => bar.println(line),
            None => _ = writeln!(stderr(), "{line}"),
        }
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
        let run = self.run.map_or(String::new(), |(number, n)| format!("run {number}, elements = {n}: "));
        bar.set_message(format!("{run}{time:.2} of {} s", self.duration));
    }

    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

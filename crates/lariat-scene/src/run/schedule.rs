//! The times at which a run stops: host times and probe times, merged.
//!
//! The k-th time of an interval is `k every`, rounded once: 7 times 0.01 s is 0.07 s, not 0.07000000000000001 s. Times that
//! differ by less than 1e-9 of the host step count as one.

use crate::scene::Scene;

/// Returns the k-th time of an interval in s. For an interval of one over a whole number, k is divided by that number.
pub fn nominal(k: u64, every: f64) -> f64 {
    let per = (1.0 / every).round();
    if per >= 1.0 && (per * every - 1.0).abs() < 1e-14 { k as f64 / per } else { k as f64 * every }
}

/// A time at which the run stops.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Time in s.
    pub time: f64,
    /// True at a host time.
    pub host: bool,
    /// Probes to sample: position in the scene's list, and number of the sample from 0.
    pub probes: Vec<(usize, u64)>,
}

/// Host and probe times of a scene in order, from 0 to its duration.
#[derive(Clone, Debug)]
pub struct Schedule {
    duration: f64,
    dt: f64,
    /// Number of the next host time; `None` when the last is past.
    host: Option<u64>,
    /// Interval and number of the next sample of each probe; without interval, at host times.
    probes: Vec<(Option<f64>, u64)>,
}

impl Schedule {
    /// Returns the schedule of a scene.
    pub fn new(scene: &Scene) -> Self {
        Schedule {
            duration: scene.duration,
            dt: scene.dt,
            host: Some(0),
            probes: scene.probes.iter().map(|probe| (probe.every, 0)).collect(),
        }
    }

    /// Returns the next time to stop at; `None` when the duration is over.
    pub fn next_event(&mut self) -> Option<Event> {
        let host = self.host?;
        let same = 1e-9 * self.dt.min(self.duration);
        let at_host = nominal(host, self.dt);
        // the last host step is cut to end on the duration
        let last = at_host >= self.duration - same;
        let at_host = if last { self.duration } else { at_host };
        let mut time = at_host;
        for (every, k) in &self.probes {
            let Some(every) = every else { continue };
            let t = nominal(*k, *every);
            if t < time - same {
                time = t;
            }
        }
        let is_host = time >= at_host - same;
        let mut due = Vec::new();
        for (i, (every, k)) in self.probes.iter_mut().enumerate() {
            let is_due = match every {
                Some(every) => nominal(*k, *every) <= time + same,
                None => is_host,
            };
            if is_due {
                due.push((i, *k));
                *k += 1;
            }
        }
        if is_host {
            self.host = if last { None } else { Some(host + 1) };
        }
        Some(Event { time, host: is_host, probes: due })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schedule(duration: f64, dt: f64, probes: &[Option<f64>]) -> Vec<Event> {
        let mut schedule =
            Schedule { duration, dt, host: Some(0), probes: probes.iter().map(|&every| (every, 0)).collect() };
        std::iter::from_fn(move || schedule.next_event()).collect()
    }

    #[test]
    fn probe_times_split_host_steps_and_both_end_at_the_duration() {
        let events = schedule(0.05, 1.0 / 60.0, &[Some(0.01), None]);
        let times: Vec<f64> = events.iter().map(|e| e.time).collect();
        assert_eq!(times, [0.0, 0.01, 1.0 / 60.0, 0.02, 0.03, 2.0 / 60.0, 0.04, 0.05]);
        assert_eq!(events[2], Event { time: 1.0 / 60.0, host: true, probes: vec![(1, 1)] });
        assert_eq!(events.last().unwrap().probes, [(0, 5), (1, 3)]);
    }

    #[test]
    fn a_duration_that_is_not_a_multiple_of_the_host_step_ends_with_a_shorter_step() {
        let events = schedule(0.25, 0.1, &[None, Some(0.2)]);
        assert_eq!(events.iter().map(|e| e.time).collect::<Vec<_>>(), [0.0, 0.1, 0.2, 0.25]);
        assert_eq!(events[3].probes, [(0, 3)]);
    }

    #[test]
    fn times_are_multiples_rounded_once() {
        assert_eq!(nominal(7, 0.01), 0.07);
        assert_eq!(nominal(30, 1.0 / 60.0), 0.5);
        assert_eq!(nominal(3, 2.5), 7.5);
        let events = schedule(2.0, 0.01, &[Some(0.01)]);
        assert_eq!(events.len(), 201);
        assert!(events.iter().all(|e| e.host && e.probes.len() == 1));
    }
}

//! The cable of the file and its parts: arc lengths along all of it.

use crate::scene::Scene;

impl Scene {
    /// Returns the cable of the file of which an entry of [`cables`](Self::cables) is a part: its position there.
    pub fn whole(&self, part: usize) -> usize {
        if part < self.parts.len() {
            return part;
        }
        self.parts.iter().position(|parts| parts.contains(&part)).unwrap_or(part)
    }

    /// Returns the unstretched length of a cable of the file in m, with what is on wheels.
    pub fn whole_length(&self, cable: usize) -> f64 {
        self.parts[cable].iter().map(|&part| self.cables[part].lead + self.cables[part].length).sum()
    }

    /// Returns the part of a cable of the file that has an arc length (m) at t = 0, and the arc length on it. What is on a wheel is at the
    /// end of the part before.
    pub fn part_at(&self, cable: usize, arc_length: f64) -> (usize, f64) {
        let mut from = 0.0;
        let mut found = (cable, arc_length);
        for (k, &part) in self.parts[cable].iter().enumerate() {
            let own = &self.cables[part];
            if k > 0 && arc_length <= from + own.lead {
                return (found.0, found.1.min(self.cables[found.0].length));
            }
            from += own.lead;
            found = (part, arc_length - from);
            if found.1 <= own.length {
                return found;
            }
            from += own.length;
        }
        (found.0, found.1.min(self.cables[found.0].length))
    }

    /// Returns the arc length in m on its cable of the file, at t = 0, of a point of a part.
    pub fn along(&self, part: usize, arc_length: f64) -> f64 {
        let parts = &self.parts[self.whole(part)];
        let before = parts.iter().take_while(|&&other| other != part).map(|&i| &self.cables[i]);
        before.map(|own| own.lead + own.length).sum::<f64>() + self.cables[part].lead + arc_length
    }

    /// Returns the part of a cable of the file that its reel is at.
    pub fn reel_part(&self, cable: usize) -> Option<usize> {
        self.parts[cable].iter().copied().find(|&part| self.cables[part].reel.is_some())
    }
}

//! Equalities: what they hold is an attachment, a junction or a joint.
//!
//! A `connect` holds a point, a `weld` a point with all directions. On a cable a point of a body of MuJoCo is one of its
//! segment, and a weld of a segment is a clamp: at the end for the last one, at the start for the first, else amid it.

use super::bodies::{Frame, Joint, Kind};
use super::cable::{Hold, Names};
use super::tree::Element;
use super::{Importer, Note};
use crate::error::Error;
use nalgebra::{Point3, Vector3};

/// A tie of two points of cables.
pub(super) struct Tie {
    pub cables: [usize; 2],
    pub arcs: [f64; 2],
}

/// What a body or a site of MuJoCo belongs to.
#[derive(Clone, Copy)]
enum Part {
    Frame(usize),
    /// A segment, or a vertex of a flexcomp, of a cable.
    Cable(usize, usize),
}

/// Where an equality holds one of its sides.
#[derive(Clone, Copy)]
enum Side {
    Frame(usize),
    Cable(usize, f64),
}

/// How near the vertex of a cable a point is moved to it, in segments: a shorter element would set the step.
const NEAR: f64 = 0.1;
/// How far from a cable, or from each other, points may be that a model says are one, in m.
const SAME: f64 = 1e-5;

impl Importer {
    pub(super) fn equality(&mut self, element: &Element) -> Result<(), Error> {
        let off = element.word("active", &["true", "false"])? == "false";
        if off || self.options.no_equality {
            self.notes.push(Note::at(element, "is not active: left out"));
            return Ok(());
        }
        let weld = match element.name.as_str() {
            "connect" => false,
            "weld" if element.number("torquescale")? == Some(0.0) => {
                return Err(element.wrong("torquescale = 0: write a connect"));
            }
            "weld" => true,
            _ => return Err(element.wrong("is not read: connect and weld are")),
        };
        let sites = [element.attribute("site1"), element.attribute("site2")];
        let (sides, point) = if let [Some(a), Some(b)] = sites {
            if let Some(key) = ["body1", "body2", "anchor"].into_iter().find(|key| element.has(key)) {
                return Err(element.wrong(format!("{key}: beside two sites")));
            }
            let [(a, p), (b, q)] = [self.site(element, a)?, self.site(element, b)?];
            if (p - q).norm() > SAME {
                return Err(element.wrong(format!(
                    "its sites are {:.3} m apart at the start, and are one at once in a scene: draw them in one place",
                    (p - q).norm()
                )));
            }
            ([a, b], p)
        } else {
            self.of_bodies(element, weld)?
        };
        self.hold(element, sides, point, weld)
    }

    fn of_bodies(&mut self, element: &Element, weld: bool) -> Result<([Side; 2], Vector3<f64>), Error> {
        if let Some(key) = ["site1", "site2"].into_iter().find(|key| element.has(key)) {
            return Err(element.wrong(format!("{key}: needs the other site, too")));
        }
        let Some(first) = element.attribute("body1") else {
            return Err(element.wrong("needs body1, or site1 and site2"));
        };
        let parts = [self.part(element, first)?, self.part(element, element.attribute("body2").unwrap_or("world"))?];
        let pose = element.list("relpose")?.filter(|_| weld);
        if pose.is_some_and(|pose| pose.len() != 7 || pose[3..].iter().any(|x| *x != 0.0)) {
            return Err(element.wrong("relpose: left out it is the pose that is drawn; another is not read"));
        }
        // the anchor of a weld is on its second body, and only balances its torque against its force
        let anchor = element.vector("anchor")?.filter(|_| !weld);
        if !weld && anchor.is_none() {
            return Err(element.wrong("needs an anchor"));
        }
        let cable =
            parts.iter().find_map(|part| if let Part::Cable(cable, k) = part { Some((*cable, *k)) } else { None });
        let point = match (anchor, parts[0]) {
            (Some(anchor), Part::Frame(frame)) => (self.frames[frame].place * Point3::from(anchor)).coords,
            (Some(anchor), Part::Cable(cable, k)) => self.on_segment(element, cable, k, &anchor)?,
            (None, part) => {
                let (cable, k) = match (part, cable) {
                    (Part::Cable(cable, k), _) | (_, Some((cable, k))) => (cable, k),
                    (Part::Frame(frame), None) => {
                        let point = self.frames[frame].place.translation.vector;
                        return Ok((self.sides(element, parts, &point, weld)?, point));
                    }
                };
                self.clamped(cable, k)
            }
        };
        Ok((self.sides(element, parts, &point, weld)?, point))
    }

    /// Returns the point at which a weld of a segment clamps a cable.
    fn clamped(&self, cable: usize, k: usize) -> Vector3<f64> {
        let cable = &self.cables[cable];
        let last = cable.vertices.len() - 2;
        match (&cable.names, k) {
            (Names::Flex(_), k) => cable.vertices[k],
            (_, 0) => cable.vertices[0],
            (_, k) if k == last => cable.vertices[k + 1],
            (_, k) => 0.5 * (cable.vertices[k] + cable.vertices[k + 1]),
        }
    }

    /// Returns a point on the axis of a segment, by its place on its body.
    fn on_segment(
        &self,
        element: &Element,
        cable: usize,
        k: usize,
        anchor: &Vector3<f64>,
    ) -> Result<Vector3<f64>, Error> {
        let cable = &self.cables[cable];
        let from = cable.vertices[k];
        if let Names::Flex(_) = cable.names {
            if anchor.norm() > SAME {
                return Err(
                    element.wrong("anchor: beside the vertex of a flexcomp, which has no directions: write 0 0 0")
                );
            }
            return Ok(from);
        }
        let along = cable.vertices[k + 1] - from;
        if anchor.y.abs().max(anchor.z.abs()) > SAME || anchor.x < -SAME || anchor.x > along.norm() + SAME {
            return Err(element.wrong(format!(
                "anchor: beside its segment, which runs from 0 0 0 to {:?} 0 0: a cable is held on its axis",
                along.norm()
            )));
        }
        Ok(from + along.normalize() * anchor.x)
    }

    fn sides(
        &mut self,
        element: &Element,
        parts: [Part; 2],
        point: &Vector3<f64>,
        weld: bool,
    ) -> Result<[Side; 2], Error> {
        let mut sides = [Side::Frame(0); 2];
        for (side, part) in sides.iter_mut().zip(parts) {
            *side = match part {
                Part::Frame(frame) => Side::Frame(frame),
                Part::Cable(cable, k) => Side::Cable(cable, self.arc(element, cable, k, point, weld)?),
            };
        }
        Ok(sides)
    }

    /// Returns the arc length of a point on a segment of a cable.
    fn arc(
        &mut self,
        element: &Element,
        index: usize,
        k: usize,
        point: &Vector3<f64>,
        weld: bool,
    ) -> Result<f64, Error> {
        let cable = &self.cables[index];
        if let Names::Flex(_) = cable.names {
            let apart = (cable.vertices[k] - point).norm();
            return if apart <= SAME {
                Ok(cable.arcs[k])
            } else {
                Err(element.wrong(format!("holds vertex {k} at {apart:.3} m from it")))
            };
        }
        let along = cable.vertices[k + 1] - cable.vertices[k];
        let share = (point - cable.vertices[k]).dot(&along) / along.norm_squared();
        let apart = (cable.vertices[k] + share * along - point).norm();
        let beyond = (share - 1.0).max(-share) * along.norm();
        if apart > SAME || beyond > SAME {
            return Err(element.wrong(format!("holds its segment {:.3} m beside its axis", apart.max(beyond))));
        }
        let near = share.round();
        let snapped = if (share - near).abs() < NEAR { near } else { share };
        let moved = (share - snapped).abs() * along.norm();
        let arc = cable.arcs[k] + snapped.clamp(0.0, 1.0) * (cable.arcs[k + 1] - cable.arcs[k]);
        if moved > SAME && !weld {
            self.notes.push(Note::at(element, format!("holds the vertex, {moved:.2e} m from its anchor")));
        }
        Ok(arc)
    }

    fn part(&self, element: &Element, name: &str) -> Result<Part, Error> {
        if name == "world" {
            return Ok(Part::Frame(0));
        }
        let named = |frame: &Frame| !name.is_empty() && frame.name == name;
        let frame = self.frames.iter().position(named).map(Part::Frame);
        let cable = || (0..self.cables.len()).find_map(|c| self.cables[c].part(name).map(|k| Part::Cable(c, k)));
        frame.or_else(cable).ok_or_else(|| element.wrong(format!("{name:?}: no body of the model")))
    }

    fn site(&self, element: &Element, name: &str) -> Result<(Side, Vector3<f64>), Error> {
        if let Some((frame, point)) = self.sites.get(name) {
            return Ok((Side::Frame(*frame), *point));
        }
        let cable = (0..self.cables.len()).find_map(|c| self.cables[c].site(name).map(|arc| (c, arc)));
        let Some((index, arc)) = cable else { return Err(element.wrong(format!("{name:?}: no site of the model"))) };
        let vertices = &self.cables[index].vertices;
        let point = if arc == 0.0 { vertices[0] } else { vertices[vertices.len() - 1] };
        Ok((Side::Cable(index, arc), point))
    }

    fn hold(&mut self, element: &Element, sides: [Side; 2], point: Vector3<f64>, weld: bool) -> Result<(), Error> {
        match sides {
            [Side::Cable(a, s), Side::Cable(b, t)] => {
                if weld {
                    return Err(element.wrong("of two cables: a junction of a scene is a ball, as connect is"));
                }
                self.ties.push(Tie { cables: [a, b], arcs: [s, t] });
            }
            [Side::Cable(cable, arc), Side::Frame(frame)] | [Side::Frame(frame), Side::Cable(cable, arc)] => {
                // a vertex of a flexcomp has a place and no directions
                let clamp = weld && matches!(self.cables[cable].names, Names::Composite(_));
                let same = |hold: &Hold| hold.cable == cable && (hold.arc - arc).abs() < SAME;
                if let Some(hold) = self.holds.iter_mut().find(|hold| same(hold)) {
                    if hold.frame != frame {
                        return Err(element.wrong("holds a point that another body holds: join the bodies"));
                    }
                    hold.clamp |= clamp;
                } else {
                    self.holds.push(Hold { cable, arc, frame, clamp });
                }
            }
            [Side::Frame(a), Side::Frame(b)] => {
                let kind = if weld { "fixed" } else { "ball" };
                let moves = |frame: usize| self.frames[frame].kind == Kind::Moving;
                let (a, b) = if moves(a) { (a, b) } else { (b, a) };
                if !moves(a) || a == b {
                    return Err(element.wrong("holds two bodies that do not move"));
                }
                let (body, to) = (self.frames[a].body.clone(), self.frames[b].body.clone());
                self.joints.push(Joint { kind, body, to, at: point, axis: None });
            }
        }
        Ok(())
    }
}

//! What touches what in MuJoCo, and with which friction, by `contype`, `conaffinity`, `condim`, `friction` and `priority`.

use super::tree::Element;
use crate::error::Error;

/// Surface of a geom or of a cable.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surface {
    contype: u32,
    conaffinity: u32,
    slides: bool,
    friction: f64,
    priority: f64,
}

impl Surface {
    /// Reads a geom, or what says the same of a flexcomp; nothing touches if `off`.
    pub fn read(element: Option<&Element>, off: bool) -> Result<Self, Error> {
        let mut surface = Surface { contype: 1, conaffinity: 1, slides: false, friction: 1.0, priority: 0.0 };
        if let Some(element) = element {
            let bits = |key: &str| -> Result<u32, Error> {
                let x = element.number(key)?.unwrap_or(1.0);
                if x.fract() != 0.0 || !(-2_147_483_648.0..4_294_967_296.0).contains(&x) {
                    return Err(element.wrong(format!("{key} = {x}: needs a whole number")));
                }
                Ok(x as i64 as u32)
            };
            (surface.contype, surface.conaffinity) = (bits("contype")?, bits("conaffinity")?);
            surface.slides = element.number("condim")? == Some(1.0);
            surface.friction = element.number("friction")?.unwrap_or(1.0);
            surface.priority = element.number("priority")?.unwrap_or(0.0);
            if surface.friction < 0.0 {
                return Err(element.wrong("friction is negative"));
            }
        }
        if off {
            (surface.contype, surface.conaffinity) = (0, 0);
        }
        Ok(surface)
    }

    pub fn touches(&self, other: &Surface) -> bool {
        self.contype & other.conaffinity != 0 || other.contype & self.conaffinity != 0
    }

    /// Returns the coefficient of friction with itself.
    pub fn friction(&self) -> f64 {
        if self.slides { 0.0 } else { self.friction }
    }

    /// Returns the coefficient of friction between two surfaces.
    pub fn friction_with(&self, other: &Surface) -> f64 {
        if self.priority > other.priority {
            self.friction()
        } else if self.priority < other.priority {
            other.friction()
        } else if self.slides && other.slides {
            0.0
        } else {
            self.friction.max(other.friction)
        }
    }
}

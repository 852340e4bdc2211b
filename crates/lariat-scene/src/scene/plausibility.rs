//! What is probably not meant in a scene: sizes and materials that no cable has, bodies that nothing holds, shapes that are strained as drawn.
//!
//! # Validity
//!
//! A corner of the drawn shape is strained, because the elements beside it are smooth: a node on it turns by half the angle t on each side, and an
//! element of length h stores about EA h (t/6)^4, one with the corner inside three to four times as much. Limits: a strain of 3e-3 on the mean of all of
//! the cable, a third of that at which steel ropes break, and a tenth of the energies that the cable starts with otherwise. No hook is three radii of its body away from it. What the mechanics know by themselves is in
//! `lariat_ancf::warning::sizes`.

use super::attachment::AttachmentScene;
use super::body::{BodyKind, BodyMass, BodyScene, BodyShape};
use super::elements::Fine;
use super::load::LoadScene;
use super::{CableScene, Purpose, Scene};
use crate::warning::Warning;
use lariat_ancf::warning::sizes;
use lariat_ancf::{Cable, Fidelity, Flow, Section, Vector3, Water};
use std::f64::consts::{PI, TAU};

/// Largest axial strain, on the mean of a cable, that its drawn corners may make.
const CORNER_STRAIN: f64 = 3e-3;
/// Largest strain energy of drawn corners over the other energies at the start.
const CORNER_ENERGY: f64 = 0.1;
/// Largest distance of an anchor from the origin of a dynamic body over the radius of its shape.
const ANCHOR: f64 = 3.0;
/// Largest size of a body over the length of a wave that it does not disturb (Faltinsen 1990, ch. 3).
const IN_WAVES: f64 = 0.2;
/// Density in kg/m^3 below which no water is; fuels have 700, liquid gas 430.
const LIGHT_WATER: f64 = 400.0;
/// Largest share of a cable with added mass that is in air.
const IN_AIR: f64 = 0.1;
/// Largest rounding of the position of a dynamic body in m: at 1/60 s velocities are rounded to 6 mm/s then.
const ROUNDING: f64 = 1e-4;
/// Largest force over EA.
const LOAD: f64 = 1.0;

/// Share of the extent of a path by which it may pass the straight way between two host times: forces that follow it are off by as much.
const PASSED: f64 = 0.02;

impl Scene {
    /// Returns warnings about what is probably not meant, as the scene is written.
    pub fn warnings(&self, purpose: Purpose) -> Vec<Warning> {
        let mut warnings: Vec<Warning> =
            self.cables.iter().flat_map(|cable| of_cable(cable, self.gravity.norm())).map(Warning::Cable).collect();
        warnings.extend(self.far_anchors());
        warnings.extend(self.mixed_joints());
        warnings.extend(self.large_loads());
        warnings.extend(self.many_turns());
        warnings.extend(self.large_in_waves());
        warnings.extend(self.light_water());
        if purpose != Purpose::Static {
            warnings.extend(self.falling());
            warnings.extend(self.unfinished_ramps());
            warnings.extend(self.fast_spins());
            warnings.extend(self.coarse_paths());
            warnings.extend(self.far_from_origin());
            warnings.extend(self.added_mass_in_air());
        }
        warnings
    }

    /// Returns a warning for each dynamic body that nothing holds, loads or stops.
    fn falling(&self) -> Vec<Warning> {
        let Some(down) = self.gravity.try_normalize(f64::MIN_POSITIVE) else { return Vec::new() };
        let free_fall = 0.5 * self.gravity.norm() * self.duration * self.duration;
        let (held, cables_held) = self.held();
        let falls = |b: &BodyScene, share: f64| Warning::FallsFreely {
            body: b.name.clone(),
            fall_m: share * free_fall,
            duration_s: self.duration,
        };
        let mut warnings = Vec::new();
        for (i, body) in self.bodies.iter().enumerate() {
            // share of the weight that no load carries; loads may carry a body whose mass its shape gives
            let on_it = || self.body_loads.iter().filter(|load| load.body == i);
            let share = match body.mass {
                Some(BodyMass::Mass(mass)) => {
                    1.0 + on_it().map(|load| load.load.force.dot(&down)).sum::<f64>() / (mass * self.gravity.norm())
                }
                _ => f64::from(u8::from(on_it().next().is_none())),
            };
            // where its horizontal velocity may take it
            let across = body.course.velocity - down * body.course.velocity.dot(&down);
            let reach = radius(body) + across.norm() * self.duration;
            let stops = |(j, other): (usize, &BodyScene)| {
                if j == i || !held[j] || matches!(body.shape, BodyShape::None) {
                    return false;
                }
                if let BodyShape::Plane(normal) = other.shape {
                    return (other.course.rotation * normal).dot(&down) < 0.0;
                }
                let way = other.course.position - body.course.position;
                let fits = (way - down * way.dot(&down)).norm() <= reach + radius(other);
                !matches!(other.shape, BodyShape::None) && fits && way.dot(&down) > -reach - radius(other)
            };
            let catches = |(cable, held): (&CableScene, &bool)| {
                let centre = cable.points.iter().sum::<Vector3<f64>>() / cable.points.len() as f64;
                let way = centre - body.course.position;
                let fits = (way - down * way.dot(&down)).norm() <= reach + cable.length;
                *held && cable.effects.contact.is_some() && fits && way.dot(&down) > -reach - cable.length
            };
            let shape = !matches!(body.shape, BodyShape::None);
            let caught = shape && self.cables.iter().zip(&cables_held).any(catches);
            if !held[i] && body.water.is_none() && share > 1e-6 && !caught && !self.bodies.iter().enumerate().any(stops)
            {
                warnings.push(falls(body, share));
            }
        }
        warnings
    }

    /// Returns a warning for each anchor far outside of the shape of a dynamic body.
    fn far_anchors(&self) -> impl Iterator<Item = Warning> {
        self.attachments.iter().filter_map(|attachment| {
            let (body, distance_m) = (&self.bodies[attachment.body?], attachment.anchor?.norm());
            let radius_m = radius(body);
            let far = body.kind == BodyKind::Dynamic && radius_m > 0.0 && distance_m > ANCHOR * radius_m;
            let (cable, name) = (self.cables[attachment.cable].name.clone(), attachment.name.clone());
            far.then(|| Warning::FarAnchor { attachment: name, cable, body: body.name.clone(), distance_m, radius_m })
        })
    }

    /// Returns a warning for each attachment to a body that moves with others by joints of both kinds.
    fn mixed_joints(&self) -> Vec<Warning> {
        let mixed = |body: usize| {
            let (mut found, mut kinds, mut next) = (vec![body], [false; 2], 0);
            while next < found.len() {
                let at = found[next];
                for joint in self.joints.iter().filter(|joint| joint.body == at || joint.to == Some(at)) {
                    kinds[usize::from(joint.multibody)] = true;
                    for other in [Some(joint.body), joint.to].into_iter().flatten() {
                        if self.bodies[other].kind == BodyKind::Dynamic && !found.contains(&other) {
                            found.push(other);
                        }
                    }
                }
                next += 1;
            }
            kinds == [true; 2]
        };
        let of = |attachment: &AttachmentScene| {
            let (cable, body) = (&self.cables[attachment.cable].name, attachment.body?);
            let (name, cable, of) = (attachment.name.clone(), cable.clone(), self.bodies[body].name.clone());
            mixed(body).then_some(Warning::MixedJoints { attachment: name, cable, body: of })
        };
        self.attachments.iter().filter_map(of).collect()
    }

    /// Returns a warning for each force beyond the axial stiffness of its cable.
    fn large_loads(&self) -> impl Iterator<Item = Warning> {
        self.loads.iter().filter_map(|LoadScene { cable, load, .. }| {
            let cable = &self.cables[*cable];
            let (name, at_m) = (|| cable.name.clone(), load.arc_length);
            let (force_n, axial_stiffness_n) = (load.force.norm(), cable.sections.at(at_m).axial_stiffness);
            let large = force_n > LOAD * axial_stiffness_n;
            large.then(|| Warning::LargeLoad { cable: name(), at_m, force_n, axial_stiffness_n })
        })
    }

    /// Returns the warning about water that is lighter than any liquid.
    fn light_water(&self) -> Option<Warning> {
        let density_kg_m3 = self.water.as_ref().map(|water| water.density)?;
        (density_kg_m3 < LIGHT_WATER).then_some(Warning::LightWater { density_kg_m3 })
    }

    /// Returns a warning for each body in water that is not small beside the wave.
    fn large_in_waves(&self) -> impl Iterator<Item = Warning> {
        let wave = self.water.as_ref().and_then(Water::wave).map(|wave| TAU / wave.number(self.gravity.norm()));
        wave.into_iter().flat_map(|wave_length_m| {
            let in_water = self.bodies.iter().filter(|body| body.water.is_some());
            in_water.filter_map(move |body| {
                let (body, size_m) = (body.name.clone(), 2.0 * radius(body));
                (size_m > IN_WAVES * wave_length_m).then_some(Warning::LargeInWaves { body, size_m, wave_length_m })
            })
        })
    }

    /// Returns a warning for each body that is rotated by more than a turn.
    fn many_turns(&self) -> impl Iterator<Item = Warning> {
        let turned = self.bodies.iter().filter(|body| body.angle > TAU * (1.0 + 1e-6));
        turned.map(|body| Warning::ManyTurns { body: body.name.clone(), angle_rad: body.angle })
    }

    /// Returns a warning for each cable of which more than a tenth starts in air with added mass.
    fn added_mass_in_air(&self) -> impl Iterator<Item = Warning> {
        self.cables.iter().filter_map(|cable| {
            let buoyancy = cable.effects.buoyancy.as_ref()?;
            let surface = buoyancy.surface.as_ref().filter(|_| buoyancy.added_mass > 0.0)?;
            let up = surface.up.try_normalize(0.0)?;
            let [mut above, mut whole] = [0.0; 2];
            for piece in cable.points.windows(2) {
                let [one, other] = [piece[0], piece[1]].map(|point| up.dot(&point) - surface.level);
                let length = (piece[1] - piece[0]).norm();
                let (low, high) = (one.min(other), one.max(other));
                let share = if low >= 0.0 { f64::from(u8::from(high > 0.0)) } else { high.max(0.0) / (high - low) };
                (above, whole) = (above + share * length, whole + length);
            }
            let share = above / whole;
            let area = cable.mean_of(|section| buoyancy.area.or(section.outer_area).unwrap_or(0.0));
            let added_kg = buoyancy.added_mass * buoyancy.fluid_density * area * cable.length;
            (share > IN_AIR).then(|| Warning::AddedMassInAir { cable: cable.name.clone(), share, added_kg })
        })
    }

    /// Returns a warning for each dynamic body of which single precision rounds the positions.
    fn far_from_origin(&self) -> impl Iterator<Item = Warning> {
        let dynamic = self.bodies.iter().filter(|body| body.kind == BodyKind::Dynamic);
        dynamic.filter_map(|body| {
            let (body, distance_m) = (body.name.clone(), body.course.position.amax());
            let rounding_m = distance_m * f64::from(f32::EPSILON);
            (rounding_m > ROUNDING).then_some(Warning::FarFromOrigin { body, distance_m, rounding_m })
        })
    }

    /// Returns a warning for each body that turns by more than half a turn in a host step.
    fn fast_spins(&self) -> impl Iterator<Item = Warning> {
        self.bodies.iter().filter_map(|body| {
            let spin = if body.kind == BodyKind::Fixed { 0.0 } else { body.course.angular_velocity.norm() };
            let (body, turn_rad, dt_s) = (body.name.clone(), spin * self.dt, self.dt);
            (turn_rad > PI).then(|| Warning::FastSpin { body, turn_rad, dt_s, longest_s: 0.5 * PI / spin })
        })
    }

    /// Returns a warning for each path that has rows between host times, where the body is not known to be.
    fn coarse_paths(&self) -> impl Iterator<Item = Warning> {
        self.bodies.iter().filter_map(|body| {
            let rows = &body.course.path.positions;
            let place = |time: f64| body.course.pose(time).0;
            let first = rows.first()?.1;
            let extent = rows.iter().map(|(_, at)| (at - first).norm()).fold(0.0, f64::max);
            let passed = |time: f64| {
                let begin = (time / self.dt).floor() * self.dt;
                let [from, to] = [place(begin), place(begin + self.dt)];
                (place(time) - from - (to - from) * ((time - begin) / self.dt)).norm()
            };
            let within = rows.iter().map(|(time, _)| *time).filter(|time| (0.0..self.duration).contains(time));
            let lost_m = within.map(passed).fold(0.0, f64::max);
            // a curve that passes a chord by so much passes the next shorter ones by the square of their length
            let longest_s = self.dt * (0.5 * PASSED * extent / lost_m).sqrt();
            let (body, dt_s) = (body.name.clone(), self.dt);
            (lost_m > PASSED * extent).then_some(Warning::CoarsePath { body, lost_m, dt_s, longest_s })
        })
    }

    /// Returns a warning about cable `i`, as drawn and in its initial motion, if corners of its points hold much of its energy.
    pub(crate) fn drawn_corner(&self, i: usize, cable: &Cable) -> Option<Warning> {
        let drawn = &self.cables[i];
        let segments: Vec<Vector3<f64>> = drawn.points.windows(2).map(|p| p[1] - p[0]).collect();
        if segments.len() < 2 || drawn.effects.rest_shape.is_some() {
            return None;
        }
        let stiffness = drawn.mean_of(|section| section.axial_stiffness) * drawn.length;
        let stretch = segments.iter().map(Vector3::norm).sum::<f64>() / drawn.length;
        let (slack, stretch) = (stretch < 1.0 - 1e-9, stretch.max(1.0));
        let even = 0.125 * stiffness * (stretch * stretch - 1.0).powi(2);
        let mass = drawn.mass();
        let energy = cable.energy();
        let energy_j = energy.axial - even;
        let other = energy.kinetic + even + mass * self.gravity.norm() * drawn.length;
        if energy_j <= CORNER_ENERGY * other || 2.0 * energy_j <= CORNER_STRAIN * CORNER_STRAIN * stiffness {
            return None;
        }
        let turns = segments.windows(2).map(|s| s[0].angle(&s[1])).enumerate();
        let (before, turn_rad) = turns.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let (cable, speed_m_s) = (drawn.name.clone(), (2.0 * energy_j / mass).sqrt());
        Some(Warning::DrawnCorner { cable, corner: before + 1, turn_rad, slack, energy_j, speed_m_s })
    }

    /// Returns a warning for each load whose ramp the run does not see the half of.
    fn unfinished_ramps(&self) -> impl Iterator<Item = Warning> {
        let cables = self.loads.iter().map(|load| (&self.cables[load.cable].name, load.load.ramp));
        let bodies = self.body_loads.iter().map(|load| (&self.bodies[load.body].name, load.load.ramp));
        let unfinished = cables.chain(bodies).filter(|(_, ramp)| *ramp > 2.0 * self.duration);
        unfinished.map(|(on, ramp_s)| Warning::UnfinishedRamp { on: on.clone(), ramp_s, duration_s: self.duration })
    }

    /// Returns by body, and by cable, whether it is connected to the world, or to anything but weights, through cables and joints.
    fn held(&self) -> (Vec<bool>, Vec<bool>) {
        let mut bodies: Vec<bool> = self.bodies.iter().map(|body| body.kind != BodyKind::Dynamic).collect();
        // loads, a flow and buoyancy may carry a cable; drag in a fluid at rest only delays its fall
        let carried = |(i, cable): (usize, &CableScene)| {
            let effects = &cable.effects;
            let at_rest = effects.drag.as_ref().is_some_and(|drag| drag.flow == Flow::default());
            let idle = |key| ["damping", "rest_shape", "gravity_scale"].contains(&key) || key == "drag" && at_rest;
            let free = effects.present().all(idle);
            !free || self.loads.iter().any(|load| load.cable == i)
        };
        let mut cables: Vec<bool> = self.cables.iter().enumerate().map(carried).collect();
        loop {
            let before = (bodies.clone(), cables.clone());
            for attachment in &self.attachments {
                match attachment.body {
                    None => cables[attachment.cable] = true,
                    Some(body) => join(&mut cables[attachment.cable], &mut bodies[body]),
                }
            }
            for junction in &self.junctions {
                let [(a, _), (b, _)] = junction.points;
                let either = cables[a] || cables[b];
                (cables[a], cables[b]) = (either, either);
            }
            for joint in &self.joints {
                let either = bodies[joint.body] || joint.to.is_none_or(|to| bodies[to]);
                bodies[joint.body] = either;
                if let Some(to) = joint.to {
                    bodies[to] = either;
                }
            }
            if before == (bodies.clone(), cables.clone()) {
                return (bodies, cables);
            }
        }
    }
}

fn join(a: &mut bool, b: &mut bool) {
    (*a, *b) = (*a || *b, *a || *b);
}

/// Returns the radius in m of a sphere about the origin of a body that holds its shape; not for a half space.
fn radius(body: &BodyScene) -> f64 {
    match &body.shape {
        BodyShape::None | BodyShape::Plane(_) => 0.0,
        BodyShape::Cuboid(half) => half.norm(),
        BodyShape::Ball(radius) => *radius,
        BodyShape::Cylinder([half, radius]) => half.hypot(*radius),
        BodyShape::Capsule([half, radius]) => half + radius,
        BodyShape::Mesh(mesh) => mesh.vertices.iter().map(|x| Vector3::from(*x).norm()).fold(0.0, f64::max),
    }
}

/// Returns what the mechanics say about the sizes of a cable.
fn of_cable(cable: &CableScene, gravity: f64) -> impl Iterator<Item = lariat_ancf::Warning> {
    let (name, length) = (&cable.name, cable.length);
    let drawn = cable.points.windows(2).map(|p| (p[1] - p[0]).norm()).sum::<f64>();
    let element = match &cable.fine {
        Fine::At(grading) => grading.finest,
        Fine::Nowhere | Fine::ByStatics => length / cable.elements as f64,
    };
    let of_section = move |(_, section): &(f64, Section)| -> Vec<_> {
        sizes::warnings(name, section, length).chain(sizes::elements(name, section, length, element)).collect()
    };
    let of_effects = sizes::of_effects(name, &cable.effects, cable.sections.first().axial_stiffness);
    let (first, contact) = (cable.sections.first(), cable.effects.contact.as_ref());
    let tolerance = match cable.integrator {
        Fidelity::Custom(own) => sizes::tolerance(name, own.control, length),
        _ => None,
    };
    let others = [
        sizes::strength(name, &cable.breaking.strength, first),
        sizes::contact_radius(name, contact, first, length),
        sizes::gravity(name, gravity),
        tolerance,
        sizes::slack(name, length, drawn),
    ];
    cable.sections.iter().flat_map(of_section).chain(of_effects).chain(others.into_iter().flatten())
}

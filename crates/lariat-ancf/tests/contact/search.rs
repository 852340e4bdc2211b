//! What the search for contacts costs.

use crate::bench::{MASS, steps, up};
use lariat_ancf::contact::{Cuboid, Obstacle};
use lariat_ancf::{Cable, Contact, Section, Vector3};

/// Takes 12 steps, and returns the number of tests per element and step.
fn tests(points: Vec<Vector3<f64>>, (elements, radius): (usize, f64), obstacles: Vec<Obstacle>) -> f64 {
    let mut cable = Cable::builder()
        .points(points)
        .section(Section::from_stiffness(1e5, 1e-2, MASS).unwrap())
        .elements(elements)
        .integrator(steps(240.0))
        .build()
        .unwrap();
    cable.set_contact(Contact::default().with_radius(radius).with_cables()).unwrap();
    cable.set_obstacles(obstacles).unwrap();
    for _ in 0..3 {
        cable.step(1.0 / 60.0).unwrap();
    }
    assert_eq!((cable.contacts().count(), cable.diagnostics().effects.contact), (0, 0));
    cable.diagnostics().search_tests as f64 / (cable.diagnostics().steps * elements as u64) as f64
}

/// A rope that touches nothing costs the same few tests per element at any length, radius and
/// number of elements.
///
/// *Source.* Counts: each pair of neighbours in a binary tree over the elements is one test, and
/// has four pairs below it: at most 5 per element and search; a search in the beginning of a step,
/// and one at its end if it went otherwise than expected. At least one tree is made in 12 steps, of
/// nearly four tests per element.
#[test]
fn a_rope_that_touches_nothing_costs_little() {
    for length in [0.5, 50.0, 5000.0] {
        for (elements, radius) in [(10, 5e-3), (40, 5e-4), (40, 5e-3), (40, 2e-2), (320, 1e-4)] {
            let radius = f64::min(radius, 0.1 * length / elements as f64);
            // in fresh buffers, where no tree is kept
            let line = vec![up() * 0.1, up() * (0.1 + length)];
            let run = std::thread::spawn(move || tests(line, (elements, radius), Vec::new()));
            let found = run.join().unwrap();
            println!("{length} m, {elements} elements, {radius} m: {found:.1}");
            assert!((0.3..10.0).contains(&found), "{length} {elements} {radius}: {found}");
        }
    }
}

/// A coil whose turns do not touch costs no more per element if it has ten times as many turns.
///
/// *Source.* Counts.
#[test]
fn a_coil_that_does_not_touch_costs_what_is_near() {
    let coil = |turns: usize| {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / 12.0;
            Vector3::new(angle.cos(), 0.01 * angle, angle.sin())
        };
        let found = tests((0..=12 * turns).map(at).collect(), (12 * turns, 5e-3), Vec::new());
        println!("{turns} turns: {found:.1}");
        found
    };
    let few = coil(4);
    assert!(few < 60.0 && coil(40) < 1.5 * few, "{few}");
}

/// A long rope that passes a box at the height of its side finds that it is far from it by halves.
///
/// *Source.* Counts: the balls about the elements hold the box, the balls about their parts do not.
#[test]
fn a_rope_beside_a_box_looks_at_no_edges() {
    let block = Cuboid { half_extents: Vector3::new(0.3, 0.3, 0.3) };
    let obstacle = Obstacle::new(1, block, Vector3::new(1.0, 25.0, 0.0), 0.3);
    let found = tests(vec![Vector3::zeros(), up() * 50.0], (10, 5e-3), vec![obstacle]);
    assert!(found < 12.0, "{found}");
}

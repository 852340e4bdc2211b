//! Surfaces of ten ropes for a renderer, and what they cost: `cargo run --release --example rope_mesh [-- --out docs/rope_mesh.svg]`.
//!
//! Ten slack ropes with a lamp at each swing for a second. The example checks that their surfaces follow, measures what drawing them anew takes per
//! frame, and with `--out` writes the triangles as a picture, lit from above, as a renderer would show them.

use bevy_ecs::prelude::*;
use lariat_bevy::rapier::prelude::ColliderBuilder;
use lariat_bevy::{Body, Cables, Rope, RopeMesh, RopeVertices, SpawnRope};
use nalgebra::Vector3;
use std::error::Error;
use std::fmt::Write;
use std::time::Instant;

const ROPES: usize = 10;
const FRAMES: usize = 200;
const RADIUS: f64 = 0.03; // m

/// Spawns a lamp on a rope from a point of the world.
fn lamp(world: &mut World, i: usize) -> Entity {
    let x = 0.4 * i as f64;
    let (from, to) = ([x, 2.0, 0.0], [x + 0.9, 1.2 + 0.05 * i as f64, 0.3]);
    let lamp = Body::dynamic().at(to).with(ColliderBuilder::ball(0.05).mass(0.5));
    let lamp = world.spawn(lamp).id();
    let (rope, _) = world.spawn_rope(from, (lamp, to), Rope::steel(0.008).slack(0.15));
    world.entity_mut(rope).insert(surface(4, true));
    rope
}

/// A tube of a number of rings in each element, coloured or not.
fn surface(rings: usize, coloured: bool) -> RopeMesh {
    let mesh = RopeMesh::new(RADIUS).sides(8).rings(rings);
    if coloured { mesh.coloured_by_tension(0.0, 20.0) } else { mesh }
}

/// Returns the mean time in us in which the surfaces of all ropes are drawn, each frame at other positions.
fn cost(world: &World, ropes: &[Entity], coloured: bool) -> Result<f64, Box<dyn Error>> {
    let cables = world.resource::<Cables>();
    let mut drawn: Vec<(RopeMesh, RopeVertices, [Vec<f64>; 2])> = Vec::new();
    for rope in ropes {
        let now = cables.get(*rope)?.positions().to_vec();
        let moved = now.iter().map(|x| x + 1e-3).collect();
        drawn.push((surface(4, coloured), RopeVertices::default(), [now, moved]));
    }
    let mut start = Instant::now();
    for frame in 0..=FRAMES {
        if frame == 1 {
            // the first makes room
            start = Instant::now();
        }
        for (rope, (mesh, vertices, positions)) in ropes.iter().zip(&mut drawn) {
            if !vertices.draw(mesh, cables.get(*rope)?, &positions[frame % 2]) {
                return Err("a surface stood still".into());
            }
        }
    }
    Ok(1e6 * start.elapsed().as_secs_f64() / FRAMES as f64)
}

/// Returns the triangles that face the viewer, from behind to the front, as SVG.
fn picture<'a>(surfaces: impl Iterator<Item = &'a RopeVertices>) -> String {
    let view = |x: [f32; 3]| (100.0 * (x[0] + 0.2 * x[2]), 100.0 * (2.1 - x[1] + 0.1 * x[2]));
    let mut triangles = Vec::new();
    for surface in surfaces {
        for corners in surface.indices.chunks_exact(3) {
            let corner = |k: usize| surface.positions[corners[k] as usize];
            let [a, b, c] = [0, 1, 2].map(|k| view(corner(k)));
            let faces = (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0) < 0.0;
            let first = corners[0] as usize;
            let [_, up, near] = surface.normals[first];
            let light = 0.45 + 0.35 * up + 0.2 * near;
            let colour = surface.colours.get(first).copied().unwrap_or([1.0; 4]);
            let shade = |x: f32| (255.0 * (x * light).clamp(0.0, 1.0).powf(1.0 / 2.2)) as u8;
            if faces {
                triangles.push((corner(0)[2], [a, b, c], [0, 1, 2].map(|k| shade(colour[k]))));
            }
        }
    }
    triangles.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-100 0 470 115\" stroke-width=\"0.2\">\n".to_string();
    for (_, [a, b, c], [red, green, blue]) in triangles {
        let colour = format!("#{red:02x}{green:02x}{blue:02x}");
        let _ = writeln!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}z\" fill=\"{colour}\" stroke=\"{colour}\"/>",
            a.0, a.1, b.0, b.1, c.0, c.1
        );
    }
    svg + "</svg>\n"
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut world = World::new();
    lariat_bevy::install(&mut world);
    let ropes: Vec<Entity> = (0..ROPES).map(|i| lamp(&mut world, i)).collect();
    for _ in 0..60 {
        lariat_bevy::advance(&mut world, 1.0 / 60.0); // s of the frame
    }
    let mut triangles = 0;
    for rope in &ropes {
        let vertices = world.get::<RopeVertices>(*rope).ok_or("no vertices")?;
        let end = world.resource::<Cables>().get(*rope)?.sample(0.0)?.position;
        let near = vertices.positions.iter().map(|p| (Vector3::from(p.map(f64::from)) - end).norm());
        if near.fold(f64::INFINITY, f64::min) > 1.01 * RADIUS {
            return Err("a surface is not where its rope is".into());
        }
        triangles += vertices.indices.len() / 3;
    }
    let [plain, coloured] = [cost(&world, &ropes, false)?, cost(&world, &ropes, true)?];
    println!(
        "{ROPES} ropes, {triangles} triangles: {plain:.0} us per frame to draw all, {coloured:.0} us with colours"
    );
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, path] = &arguments[..]
        && flag == "--out"
    {
        for rope in &ropes {
            world.entity_mut(*rope).insert(surface(2, true));
        }
        lariat_bevy::advance(&mut world, 1.0 / 60.0);
        std::fs::write(path, picture(ropes.iter().filter_map(|rope| world.get::<RopeVertices>(*rope))))?;
        println!("{path}");
    }
    Ok(())
}

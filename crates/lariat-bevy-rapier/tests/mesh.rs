//! Meshes of ropes, in an app without a window.

use bevy::asset::AssetPlugin;
use bevy::mesh::{Indices, Mesh3d, MeshPlugin, VertexAttributeValues};
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_rapier3d::prelude::*;
use lariat_bevy_rapier::lariat_bevy::{At, Attachment, Bending, Cable, Damping, RopeMesh, RopeVertices};
use lariat_bevy_rapier::{LariatRapierPlugin, RopeMeshPlugin};
use std::time::Duration;

/// A rope that swings has a mesh, whose vertices are those of its surface after each update, in one asset.
///
/// *Source.* `RopeVertices`, whose volume is tested in lariat-bevy.
#[test]
fn the_mesh_of_a_rope_follows_it_in_place() {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, TransformPlugin, AssetPlugin::default(), MeshPlugin))
        .add_plugins(RapierPhysicsPlugin::<NoUserData>::default())
        .add_plugins((LariatRapierPlugin::default(), RopeMeshPlugin))
        .insert_resource(TimestepMode::Fixed { dt: 1.0 / 60.0, substeps: 1 })
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f32(1.0 / 60.0)));
    app.finish();
    app.cleanup();
    let rope = Cable::steel_rope(0.012).between([0.0; 3], [2.0, 0.0, 0.0]);
    let surface = RopeMesh::new(0.006).coloured_by_tension(0.0, 50.0);
    let rope = app.world_mut().spawn((rope, Bending, Damping::critical_fraction(0.5), surface)).id();
    app.world_mut().spawn(Attachment::ball(rope, At::Start).to_world());
    let mut handles = Vec::new();
    for update in 0..60 {
        app.update();
        let world = app.world();
        let Some(mesh) = world.get::<Mesh3d>(rope) else {
            assert!(update < 3, "a mesh after three updates");
            continue;
        };
        let vertices = world.get::<RopeVertices>(rope).unwrap();
        let drawn = world.resource::<Assets<Mesh>>().get(&mesh.0).unwrap();
        let Some(VertexAttributeValues::Float32x3(positions)) = drawn.attribute(Mesh::ATTRIBUTE_POSITION) else {
            panic!("positions")
        };
        let Some(VertexAttributeValues::Float32x4(colours)) = drawn.attribute(Mesh::ATTRIBUTE_COLOR) else {
            panic!("colours")
        };
        assert!(*positions == vertices.positions && *colours == vertices.colours, "update {update}");
        assert!(matches!(drawn.indices(), Some(Indices::U32(indices)) if *indices == vertices.indices));
        handles.push((mesh.0.clone(), positions.iter().map(|p| p[1]).fold(0.0, f32::min)));
    }
    assert!(handles.iter().all(|(handle, _)| *handle == handles[0].0), "one asset");
    let (first, last) = (handles[0].1, handles[handles.len() - 1].1);
    assert!(first > -0.1 && last < -0.5, "from {first} to {last} m");
}

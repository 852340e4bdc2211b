//! Meshes of cables for Bevy's renderer (feature `mesh`).

use crate::LariatSystems;
use bevy::asset::{AssetEventSystems, Assets, RenderAssetUsages};
use bevy::mesh::{Indices, Mesh3d, MeshVertexAttribute, PrimitiveTopology, VertexAttributeValues};
use bevy::prelude::*;
use lariat_bevy::RopeVertices;

/// Gives each cable with a [`RopeMesh`](lariat_bevy::RopeMesh) a [`Mesh3d`], whose vertices follow
/// the cable; what is missing is a material.
///
/// ```no_run
/// # use bevy::prelude::*;
/// # use lariat_bevy_rapier::lariat_bevy::{Cable, RopeMesh};
/// # fn spawn(mut commands: Commands) {
/// let rope = Cable::steel_rope(0.012).between([0.0, 4.0, 0.0], [0.0, 1.0, 0.0]);
/// commands.spawn((rope, RopeMesh::new(0.006).coloured_by_tension(0.0, 2e3)));
/// // and a MeshMaterial3d(materials.add(StandardMaterial::default())), as for any mesh
/// # }
/// ```
///
/// The vertices are in world coordinates: the entity keeps the identity as its transform. The mesh
/// is changed in place, and made anew only where the number of vertices changes.
#[derive(Clone, Copy, Debug, Default)]
pub struct RopeMeshPlugin;

impl Plugin for RopeMeshPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(PostUpdate, update_meshes.after(LariatSystems::AfterStep).before(AssetEventSystems));
    }
}

/// Copies vertices that have changed.
fn update_meshes(
    mut commands: Commands,
    meshes: Option<ResMut<Assets<Mesh>>>,
    ropes: Query<(Entity, &RopeVertices, Option<&Mesh3d>), Changed<RopeVertices>>,
) {
    // without a renderer nothing is drawn
    let Some(mut meshes) = meshes else { return };
    for (entity, vertices, mesh) in &ropes {
        if vertices.positions.is_empty() {
            continue;
        }
        if let Some(mesh) = mesh
            && let Some(mut mesh) = meshes.get_mut(&mesh.0)
        {
            copy(vertices, &mut mesh);
            continue;
        }
        let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
        copy(vertices, &mut mesh);
        commands.entity(entity).try_insert(Mesh3d(meshes.add(mesh)));
    }
}

/// Writes vertices and triangles into a mesh.
fn copy(vertices: &RopeVertices, mesh: &mut Mesh) {
    set(mesh, Mesh::ATTRIBUTE_POSITION, &vertices.positions, |values| match values {
        VertexAttributeValues::Float32x3(values) => Some(values),
        _ => None,
    });
    set(mesh, Mesh::ATTRIBUTE_NORMAL, &vertices.normals, |values| match values {
        VertexAttributeValues::Float32x3(values) => Some(values),
        _ => None,
    });
    set(mesh, Mesh::ATTRIBUTE_UV_0, &vertices.uvs, |values| match values {
        VertexAttributeValues::Float32x2(values) => Some(values),
        _ => None,
    });
    if vertices.colours.is_empty() {
        mesh.remove_attribute(Mesh::ATTRIBUTE_COLOR);
    } else {
        set(mesh, Mesh::ATTRIBUTE_COLOR, &vertices.colours, |values| match values {
            VertexAttributeValues::Float32x4(values) => Some(values),
            _ => None,
        });
    }
    if !matches!(mesh.indices(), Some(Indices::U32(old)) if *old == vertices.indices) {
        mesh.insert_indices(Indices::U32(vertices.indices.clone()));
    }
}

/// Writes an attribute, in place if the mesh has it.
fn set<T: Copy>(
    mesh: &mut Mesh,
    attribute: MeshVertexAttribute,
    new: &[T],
    own: impl Fn(&mut VertexAttributeValues) -> Option<&mut Vec<T>>,
) where
    Vec<T>: Into<VertexAttributeValues>,
{
    match mesh.attribute_mut(attribute).and_then(own) {
        Some(values) => {
            values.clear();
            values.extend_from_slice(new);
        }
        None => mesh.insert_attribute(attribute, new.to_vec()),
    }
}

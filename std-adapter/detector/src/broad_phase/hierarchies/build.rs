//! Builds the hierarchies, and marks which primitives take part.

use super::super::degradation::Degradation;
use super::super::hubs::Hubs;
use super::super::neighbours::Neighbours;
use super::numbers::{EdgeEnds, NOWHERE};
use super::{BoxFit, Hierarchies, State};
use crate::step::{CollisionFilter, Members, Motions};
use std::sync::Arc;

impl Hierarchies {
    pub(super) fn build(&mut self, motions: &dyn Motions) {
        let mapping = BoxFit::default().mapping(motions, &self.extent);
        let middle = |vertex: usize| {
            let motion = motions.motion(vertex);
            let moving = mapping.vertex(motion.start.into(), motion.end.into());
            [0, 1, 2].map(|axis| {
                let middle = 0.5 * moving.start.lower[axis] + 0.5 * moving.end.lower[axis];
                if middle.is_finite() { middle } else { 0.0 }
            })
        };
        let topology = &*self.topology;
        let middles: Vec<[f32; 3]> = (0..topology.vertex_count()).map(middle).collect();
        let middle = |vertex: u32| middles[vertex as usize];
        let (edges, faces) = (topology.edges(), topology.triangles());
        // This marks the vertices that have a triangle.
        self.positions.clear();
        self.positions.resize(topology.vertex_count(), NOWHERE);
        for &vertex in faces.iter().flatten() {
            self.positions[vertex as usize] = 0;
        }
        let positions = &self.positions;
        let used = (0..topology.vertex_count() as u32).filter(|&vertex| positions[vertex as usize] != NOWHERE);
        let hubs = Hubs::new(topology.vertex_count(), faces);
        // All three trees use this memory.
        let mut centres = Vec::with_capacity(edges.len().max(faces.len()));
        self.vertices.build(used, middle, None, &mut centres);
        for (position, &vertex) in (0..).zip(&self.vertices.primitives) {
            self.positions[vertex as usize] = position;
        }
        let hub_of_edge = |edge: u32| hubs.of_primitive(&edges[edge as usize]);
        let hub_of_edge: Option<&dyn Fn(u32) -> u32> = if hubs.is_empty() { None } else { Some(&hub_of_edge) };
        let hub_of_face = |face: u32| hubs.of_primitive(&faces[face as usize]);
        let hub_of_face: Option<&dyn Fn(u32) -> u32> = if hubs.is_empty() { None } else { Some(&hub_of_face) };
        let centre_of_edge = |edge: u32| mean(edges[edge as usize].map(middle));
        let centre_of_face = |face: u32| mean(faces[face as usize].map(middle));
        self.edges
            .build(0..edges.len() as u32, centre_of_edge, hub_of_edge, &mut centres);
        self.faces
            .build(0..faces.len() as u32, centre_of_face, hub_of_face, &mut centres);
        let positions = &self.positions;
        let position = |vertex: u32| positions[vertex as usize];
        self.vertices.connect(|vertex| [position(vertex)]);
        self.edges.connect(|edge| edges[edge as usize].map(position));
        self.faces.connect(|face| faces[face as usize].map(position));
        let edges = self.edges.vertices.iter().zip(&self.edges.primitives);
        self.edge_ends.clear();
        self.edge_ends.extend(edges.map(|(&ends, &edge)| EdgeEnds { ends, edge }));
        self.rows.clear();
        self.boxes.clear();
        self.resting = None;
        self.mark();
        self.note_members();
        self.note_rest();
        self.degradation = Degradation::default();
        self.state = State::Built;
        self.statistics.builds += 1;
    }

    pub(super) fn mark(&mut self) {
        let Some(moving) = &self.moving else {
            self.vertices.mark_all();
            self.edges.mark_all();
            self.faces.mark_all();
            return;
        };
        let vertices = self.vertices.primitives.iter();
        let of_vertices: Vec<bool> = vertices.map(|&vertex| moving[vertex as usize]).collect();
        self.vertices.mark(&of_vertices);
        self.edges.mark(&of_vertices);
        self.faces.mark(&of_vertices);
    }

    pub(super) fn note_members(&mut self) {
        let vertices = &self.vertices.primitives;
        let members = |filter: &Arc<CollisionFilter>| vertices.iter().map(|&v| Members::of_vertex(filter, v)).collect();
        let members: Vec<_> = self.filter.as_ref().map_or_else(Vec::new, members);
        self.vertices.note_members(&members);
        self.edges.note_members(&members);
        self.faces.note_members(&members);
    }

    pub(super) fn note_rest(&mut self) {
        let vertices = &self.vertices.primitives;
        let at_rest = |neighbours: &Arc<Neighbours>| vertices.iter().map(|&v| neighbours.at_rest(v)).collect();
        let at_rest: Vec<_> = self.neighbours.as_ref().map_or_else(Vec::new, at_rest);
        self.vertices.note_rest(&at_rest);
        self.edges.note_rest(&at_rest);
        self.faces.note_rest(&at_rest);
    }
}

fn mean<const N: usize>(positions: [[f32; 3]; N]) -> [f32; 3] {
    [0, 1, 2].map(|axis| {
        let sum: f32 = positions.iter().map(|position| position[axis] / N as f32).sum();
        sum
    })
}

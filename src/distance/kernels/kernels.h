#pragma once

// distance/kernels: what is computed of two triangles, two points or two round solids.
//
// What goes in: corners of triangles in one frame (LocalFrames: both bodies relative to a point between them,
// so that rounding is relative to the geometry at hand), or a body and a pose.
// What comes out: distances with the points that they are taken between, each with a stated error bound
// (doc/numerics.md), and decisions without error where two triangles meet.
//
//   triangle_distance   two triangles: least distance and witness points; triangle_crossing: do they meet,
//   exactly surface_walk        the nearest point of a surface to a point, by walking from triangle to
//   triangle witness_refinement  from a pair of triangles down to the nearest pair around it
//   minimum_candidate a pair of triangles that may hold a local minimum, and on which of its features
//   minima_scene        both bodies at one pose in one frame, with the rounding that distances in it carry
//   pair_table          a hash table of pairs of triangles round_*             spheres, capsules and
//   cylinders against each other: closed forms, else a search
//
// Nothing here keeps anything from pose to pose, and nothing knows what a niche is.

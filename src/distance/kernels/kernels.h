#pragma once

// distance/kernels computes with two triangles, two points or two round solids.
//
// It takes corners of triangles in one frame (PairFrame: both bodies relative to a point between them, so
// that rounding is relative to the geometry at hand), or a body and a pose. It gives distances with the
// points that they are measured between, each with a stated error bound (doc/numerics.md), and decides
// without error whether two triangles meet.
//
// - triangle_distance measures two triangles; triangle_crossing decides whether they meet.
// - surface_walk finds the nearest point of a surface by walking from triangle to triangle.
// - witness_refinement goes from a pair of triangles down to the nearest pair around it (adjacent_triangles).
// - minimum_candidate is a pair of triangles that may hold a local minimum, and on which of its features.
// - pair_frame holds both bodies at one pose in one frame, with the rounding that distances in it carry.
// - pair_motion says how far points of one body have moved as seen from the other between two poses.
// - round_kernels, round_pair_distance and cylinder_pair_search measure spheres, capsules and cylinders.
//
// It keeps nothing from pose to pose and does not know what a niche is.

#pragma once

// distance/minima: every local minimum of the distance between two surfaces.
//
// The segment between two points that are nearest to each other nearby lies in the normal cones of the
// features (vertex, edge, face) that the points stand on. Trees of cones (mesh/trees/normal_cone_tree) tell
// which pairs of features can do so; those are computed, all others are excluded with a bound that allows for
// the error of every input (doc/numerics.md, "Cone tests").
//
// What goes in: MinimaScene, a cutoff. What comes out: MinimumCandidate, a pair of triangles and of features
// that holds a local minimum. Several may stand for one minimum; which of them are niches, distance/niches
// decides.
//
//   minima_candidates  from the roots of both trees, for a single pose
//   minima_tracker         for the next pose: each excluded pair stays excluded for a known motion, so that
//   only
//                      those whose time has come are compared again (cone_motion, cone_slices, cone_sweep)
//   feature_pairs      two features: where their least distance is, and whether it is a local minimum
//   feature_slacks, minimum_slacks   for what motion that answer stays as it is
//
// What is kept: the list of pairs with the motion that each stands for, and the minima that are alive.

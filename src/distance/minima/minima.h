#pragma once

// distance/minima finds every local minimum of the distance between two surfaces.
//
// The segment between two points that are nearest to each other nearby lies in the normal cones of the
// features (vertex, edge, face) that the points stand on. Trees of cones (mesh/trees/normal_cone_tree) show
// which pairs of features can do so; those are computed, all others are excluded with a bound that allows for
// the error of every input (doc/numerics.md, "Cone tests").
//
// It takes a PairFrame and a cutoff, and gives each MinimumCandidate: a pair of triangles and of features
// that holds a local minimum. Several may stand for one minimum; distance/niches decides which are niches.
//
// - minima_candidates looks from the roots of both trees, for a single pose.
// - minima_tracker looks at the next pose: each excluded pair stays excluded for a known motion, so that only
//   those whose time has come are compared again (moved_distances, slack_offers, cone_slices, cone_sweep).
// - feature_pairs finds where the least distance of two features is and whether it is a local minimum.
// - feature_slacks and minimum_slacks find for what motion that answer stays as it is.
//
// It keeps the list of pairs, each with the motion that it stays excluded for, and the minima that are alive.

#pragma once

// distance/bound proves the distance of two bodies and keeps from pose to pose where the next proof begins.
//
// It takes two bodies with their trees of boxes (mesh/trees), a pose, and a guess of the nearest triangles.
// It gives a bracket that holds in spite of all rounding: a lower bound, and a distance with the two points
// that reach it. Without a limit of time or a tolerance both ends agree up to rounding.
//
// - certificate has the entry, certifyDistance(), and counts what it cost.
// - branch_and_bound opens pairs of boxes until none can hold a nearer pair of triangles.
// - open_pairs holds the pairs of boxes that are still to be opened.
// - tree_pair_bounds bounds how near what boxes of both trees hold may come at one pose (proof_frame).
// - box_pair_bounds bounds how near two boxes may come, by separating axes, with their error.
// - nearest_triangles keeps the nearest pair of triangles measured so far.
// - bound_cache keeps the pairs of boxes where the last search ended.
// - leaf_pair asks the last directions that parted two triangles first.
// - round_certificate does the same for an exact round solid and a mesh, or two round solids.
// - closest_point finds the point of a whole surface that is nearest to a given point.
// - solid_overlap decides whether one closed body has swallowed a part of the other.
//
// It keeps excluded pairs of boxes with bounds that hold until the bodies have come nearer by them; what has
// run out is proven anew.

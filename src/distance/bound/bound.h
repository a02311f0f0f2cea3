#pragma once

// distance/bound: the proven distance of two bodies, and what of its proof is kept from pose to pose.
//
// What goes in: two bodies with their trees of boxes (mesh/trees), a pose, a guess of the nearest triangles.
// What comes out: a bracket that holds in spite of all rounding: a lower bound, and a distance with witnesses
// that is reached. Without a limit of time or a tolerance both ends agree to rounding.
//
//   certificate       the entry: prove(), with what it cost
//   branch_and_bound  opens pairs of boxes until none can hold a nearer pair of triangles
//   box_pair_bounds   how near two boxes may come: separating axes, with their error
//   bound_cache       the pairs of boxes where the last search ended; the next pose begins there
//   leaf_pair         the last directions that parted two triangles, asked first
//   round_certificate the same for an exact round solid and a mesh, or two round solids
//   solid_overlap     has one closed body swallowed a part of the other?
//
// What is kept is only where to begin. Every pose is proven anew.

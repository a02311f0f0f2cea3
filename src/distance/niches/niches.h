#pragma once

// distance/niches decides which local minima are niches and describes each.
//
// A minimum is a niche when every path from it to a place at least as near rises to the level that
// niche_rule.h gives; no other file knows this level. Paths go from one pair of facets, one of each body, to
// a neighbouring pair.
//
// It takes the candidates of distance/minima and a request (cutoff, least prominence, count, hidden or not).
// It gives LocalMinima: the niches with distance, prominence, kind, extent and visibility.
//
// - local_minima has the entry, findLocalMinima(); candidate_collector brings the candidates together.
// - convex_pair tells where nearly convex bodies have one niche, so that nothing is looked for.
// - convex_shell_pairs brings the candidates of unions of convex solids, from the closest points of each two.
// - niche_decider decides each candidate by the cheapest proof that holds: a path down that stays low
//   (bounded_path), two whole components that are far apart (distant_components), the boundary of a basin
//   that is still high enough (basin_boundary), else a search of the basin (basin_search). Its stages are
//   decision_entry, decision_stage, decision_paths and decision_basins; facet_pair_levels and
//   facet_pair_neighbours give the graph that they go through.
// - decision_cache keeps what proved a decision for the next pose.
// - The same search of the basin, up to a higher level, measures the prominences of the listed niches where a
//   request asks for them.
// - niche_describer tells kind, extent (niche_extent, planar_set), outward or through material
//   (shell_material), hidden or visible (niche_properties).
// - meeting_pairs finds where the surfaces meet; overlap_parts joins, by overlap_sets and overlap_lines, what
//   one connected part of the overlap holds: a niche at distance 0. facet_line tells where lines meet facets.
//
// It keeps evidence and never a result: where the evidence no longer proves a decision, it decides anew.

#pragma once

// distance/niches: which local minima are niches, and what is said of each.
//
// A minimum is a niche when every way from it to a nearer place climbs higher than the least prominence times
// its distance. A facet pair is a pair of facets, one of each body; ways go from facet pair to neighbouring
// facet pair.
//
// What goes in: the candidates of distance/minima, a request (cutoff, least prominence, count, what is
// listed). What comes out: LocalMinima, the list with distance, prominence, kind, extent and visibility of
// each niche.
//
//   local_minima     the entry: findLocalMinima()
//   niche_decider  decides each candidate; the cheapest proof first: a path down that stays low
//   (bounded_path),
//                    two whole pieces that are far apart (distant_components), the border of a region that is
//                    still high enough (basin_boundary), else a flood from the candidate (basin_search)
//   decision_cache   what proved a decision, looked at again in the next pose
//   minima_flood     prominences as figures, where they are asked for
//   niche_describer  kind, extent, outward or through material, hidden or visible
//   meeting_pairs    where the surfaces meet: niches of distance 0
//
// What is kept is evidence and never a result: what no longer proves its decision is decided anew.

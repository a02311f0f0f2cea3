#pragma once

// distance/niches: which local minima are niches, and what is said of each.
//
// A minimum is a niche when every way from it to a nearer place climbs higher than the least prominence times
// its distance. A cell is a pair of facets, one of each body; ways go from cell to neighbouring cell.
//
// What goes in: the candidates of distance/minima, a request (cutoff, least prominence, count, what is
// listed). What comes out: LocalMinima, the list with distance, prominence, kind, extent and visibility of
// each niche.
//
//   local_minima     the entry: findLocalMinima()
//   minima_verdicts  decides each candidate; the cheapest proof first: a path down that stays low
//   (level_path),
//                    two whole pieces that are far apart (far_pieces), the border of a region that is still
//                    high enough (cell_border), else a flood from the candidate (cell_flood)
//   verdict_memory   what proved a decision, looked at again in the next pose
//   minima_flood     prominences as figures, where they are asked for
//   niche_describer  kind, extent, outward or through material, hidden or visible
//   meeting_pairs    where the surfaces meet: niches of distance 0
//
// What is kept is evidence and never a result: what no longer proves its decision is decided anew.

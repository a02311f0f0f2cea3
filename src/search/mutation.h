#pragma once

#include "base/constants.h"
#include "base/random_engine.h"
#include "concave_distance/search/trial_point.h"
#include "pair_metric.h"
#include "pair_objective.h"

namespace concave_distance {

NodeIndex randomNode(const NodeGraph& graph, RandomEngine& engine);

/// Moves a node on a shortest path towards a random node of the whole body by a uniformly random length
/// within `radius`, metres; a node drawn on another shell is taken itself.
NodeIndex moveGene(NodeIndex node, double radius, const MeshMetric& metric, RandomEngine& engine);

/// Random move (Carretero, sec. 3.2.2.b, 3.3.2.c) of gene A, gene B or both, with equal chances. The result's
/// distance is not computed. @param radius of moveGene(); infinite: up to the whole path
TrialPoint mutate(const TrialPoint& point, PairMetric& metric, RandomEngine& engine,
                  double radius = kInfinity);

/// A uniformly random node pair, its distance not computed.
TrialPoint randomTrialPoint(const PairObjective& objective, RandomEngine& engine);

}  // namespace concave_distance

#include "distance_queries.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include "base/run_together.h"
#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "ros/messages/conversions.h"
#include "scene/solver_threads.h"

namespace concave_distance {
namespace {

QueryContext withJoints(QueryContext context, const std::shared_ptr<const ServedScene>& served) {
  context.joints = [served] { return jointsOf(*served); };
  return context;
}

}  // namespace

DistanceQueries::DistanceQueries(ServiceQueues& queues, SceneStore& keeper, QueryContext context,
                                 const NodeLimits& limits, std::uint32_t threads)
    : node_(queues.heavy()),
      gate_(queues.gate()),
      keeper_(keeper),
      context_(std::move(context)),
      limits_(limits),
      threads_(static_cast<std::size_t>(solverThreads(threads))),
      get_distance_(node_.advertiseService("get_distance", &DistanceQueries::getDistance, this)),
      get_distances_(node_.advertiseService("get_distances", &DistanceQueries::getDistances, this)) {}

QueryContext DistanceQueries::currentContext(std::chrono::steady_clock::time_point arrival,
                                             std::size_t queries) {
  QueryContext context = context_;
  context.stop = &gate_.stopped();
  context.largest_niche_count = static_cast<std::uint32_t>(limits_.largest_niche_count / queries);
  context.deadline = arrival + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                   std::chrono::duration<double>(limits_.query_seconds));
  return context;
}

bool DistanceQueries::getDistance(GetDistance::Request& request, GetDistance::Response& response) {
  const auto arrival = std::chrono::steady_clock::now();
  try {
    const RequestGate::Place place = gate_.enter();
    answerOne(request.query, currentContext(arrival, 1), response);
  } catch (const Error& refusal) {
    PairHeading heading;
    heading.body_a = request.query.body_a;
    heading.body_b = request.query.body_b;
    heading.reference_frame = context_.reference_frame;
    PairStatus status;
    status.code = PairStatus::INVALID_REQUEST;
    status.message = response.message = shortText(refusal.what());
    response.result = emptyNiches(heading, status);
  }
  return true;
}

void DistanceQueries::answerOne(const DistanceQuery& query, const QueryContext& context,
                                GetDistance::Response& response) {
  const auto served = keeper_.served();
  QueryAnswer answered = answerQuery(query, *served->scene, withJoints(context, served), ros::Time::now());
  response.result = std::move(answered.result);
  response.contacts = std::move(answered.contacts);
  response.success = static_cast<std::uint8_t>(isAnswered(response.result));
  response.message = response.result.nearest.status.message;
  const std::string waiting = keeper_.waitingFor();
  if (response.success == 0 && !waiting.empty()) {
    response.message += "; the scene is not loaded yet: " + waiting;
  }
}

bool DistanceQueries::getDistances(GetDistances::Request& request, GetDistances::Response& response) {
  const auto arrival = std::chrono::steady_clock::now();
  try {
    if (request.queries.empty()) {
      throw Error("queries", "the list is empty", "name at least one pair; list_bodies has their names");
    }
    if (request.queries.size() > limits_.largest_query_count) {
      throw Error("queries", std::to_string(request.queries.size()) + " in one call",
                  "split them into several calls; ~limits/largest_query_count is " +
                      std::to_string(limits_.largest_query_count));
    }
    const RequestGate::Place place = gate_.enter();
    answerAll(request.queries, currentContext(arrival, request.queries.size()), response);
  } catch (const Error& refusal) {
    response.message = refusal.what();
  }
  return true;
}

// On its own threads, not TBB's: a TBB worker busy with a long query would be missing in the cycle.
void DistanceQueries::answerAll(const std::vector<DistanceQuery>& queries, const QueryContext& context,
                                GetDistances::Response& response) {
  const auto served = keeper_.served();
  const QueryContext of_scene = withJoints(context, served);
  const ros::Time now = ros::Time::now();
  response.results.resize(queries.size());
  response.contacts.resize(queries.size());
  std::atomic<std::size_t> next{0};
  const auto answer_some = [&] {
    for (std::size_t index = next++; index < queries.size(); index = next++) {
      QueryAnswer answered = answerQuery(queries[index], *served->scene, of_scene, now);
      response.results[index] = std::move(answered.result);
      response.contacts[index] = std::move(answered.contacts);
    }
  };
  runWithHelpers(std::min(threads_, queries.size()) - 1, answer_some);
  std::size_t failed = 0;
  for (const PairNiches& result : response.results) {
    if (isAnswered(result)) {
      continue;
    }
    if (++failed == 1) {
      response.message =
          result.nearest.body_a + " and " + result.nearest.body_b + ": " + result.nearest.status.message;
    }
  }
  if (failed > 0) {
    response.message = std::to_string(failed) + " of " + std::to_string(response.results.size()) +
                       " queries have no distance; the first: " + response.message;
  }
  response.success = static_cast<std::uint8_t>(failed == 0);
}

}  // namespace concave_distance

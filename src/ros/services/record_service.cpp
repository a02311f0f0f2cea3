#include "record_service.h"

#include <ros/console.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "kinematics/wording.h"
#include "loading/record_answers.h"
#include "loading/scene_files.h"
#include "respond.h"

namespace concave_distance {
namespace {

using detail::counted;

constexpr std::chrono::milliseconds kWaitForCycle{1000};  // for the whole answer of one
constexpr int kMostNames = 10'000;

std::size_t requireBody(const Scene& scene, const std::string& field, const std::string& name) {
  const std::optional<std::size_t> body = scene.findBody(name);
  if (!body) throw Error(field, "there is no body '" + name + "'", "list_bodies has their names");
  return *body;
}

/// A folder that is not there yet.
std::string freeFolder(const std::string& save_folder, const std::string& name) {
  for (int number = 1; number < kMostNames; ++number) {
    std::string place = detail::placeBelow(save_folder, name + "_" + std::to_string(number), "folder");
    std::error_code ignored;
    if (!std::filesystem::exists(std::filesystem::symlink_status(place, ignored))) return place;
  }
  throw Error("folder", "there are " + std::to_string(kMostNames) + " recordings of these bodies",
              "name another folder, or move them elsewhere");
}

std::vector<std::string> remarksOn(const RecordPair::Request& request, const PairRecording& recording,
                                   const detail::RecordAnswers& answers, std::uint32_t length) {
  std::vector<std::string> remarks;
  const std::size_t count = recording.cycles.size();
  if (count < request.poses) {
    remarks.push_back(counted(count, "pose") + " of " + std::to_string(request.poses) +
                      (request.poses > length
                           ? ": the node keeps " + std::to_string(length) + " (~expert/record_length)"
                           : ": the pair has had no more since it came near"));
  }
  std::uint64_t missed = recording.missed_after;
  for (std::size_t i = 1; i < count; ++i) missed += recording.cycles[i].missed_before;
  if (missed > 0)
    remarks.push_back(counted(missed, "cycle") + " had no pose: transforms were missing or old");
  if (answers.count < count) {
    remarks.push_back("a replay is compared with the first " + std::to_string(answers.count) +
                      " poses: the others took more than ~limits/query_seconds, or 64 MB");
  }
  if (!recording.last_answer)
    remarks.emplace_back("no cycle has come for a second: live_answer.csv is missing");
  return remarks;
}

}  // namespace

RecordService::RecordService(ServiceQueues& queues, SceneStore& keeper, PairRecorder& recorder,
                             std::string save_folder, const NodeLimits& limits)
    : heavy_(queues.heavy()),
      gate_(queues.gate()),
      keeper_(keeper),
      recorder_(recorder),
      save_folder_(std::move(save_folder)),
      limit_seconds_(limits.query_seconds),
      record_pair_(heavy_.advertiseService("record_pair", &RecordService::recordPair, this)) {}

bool RecordService::recordPair(RecordPair::Request& request, RecordPair::Response& response) {
  return respond(response, [&] {
    const std::unique_lock<std::mutex> only(running_, std::try_to_lock);
    if (!only)
      throw Error("SERVICE BUSY", "another recording is being written", "call again when it is done");
    const RequestGate::Place place = gate_.enter();
    requireScene(keeper_);
    using Clock = WorkLimit::Clock;
    const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                     std::chrono::duration<double>(limit_seconds_));
    write(request, end, response);
  });
}

PairRecording RecordService::takeCycles(const RecordPair::Request& request) const {
  const std::shared_ptr<const ServedScene> served = keeper_.served();
  const Scene& scene = *served->scene;
  const std::size_t a = requireBody(scene, "body_a", request.body_a);
  const std::size_t b = requireBody(scene, "body_b", request.body_b);
  if (a == b) throw Error("body_b", "it is body_a, too", "name two bodies");
  if (recorder_.length() == 0)
    throw Error("~expert/record_length", "it is 0: no poses are kept", "start the node with another value");
  const std::optional<ScenePair> pair = pairOf(scene, a, b);
  const std::string where = "pair " + (pair ? pair->name : request.body_a + "/" + request.body_b);
  if (!pair || !pair->enabled)
    throw Error(where, "it is not watched", "set_pair_enabled switches it on; then it needs some cycles");
  const std::size_t most = request.poses == 0 ? std::numeric_limits<std::size_t>::max() : request.poses;
  std::optional<PairRecording> recording =
      recorder_.take(scene.bodies[a].serial, scene.bodies[b].serial, most, kWaitForCycle);
  if (!recording) {
    throw Error(where, "it is not tracked: too far apart for its cutoff, or new in the scene",
                "ask while it is near, or name the pair in the scene file");
  }
  if (!recording->has_room) {
    throw Error(where, "the memory for poses was used up by other pairs before it came",
                "start the node with a smaller ~expert/record_length");
  }
  if (recording->cycles.empty() && recording->missed_after > 0) {
    throw Error(where, "its poses were not known in the last " + counted(recording->missed_after, "cycle"),
                "/diagnostics and the log name the transforms that are missing or old");
  }
  if (recording->cycles.empty()) {
    throw Error(
        where, "it has had no answer yet",
        "subscribe to distances or niches of the node, let the bodies be within the cutoff, ask again");
  }
  return std::move(*recording);
}

void RecordService::write(const RecordPair::Request& request, WorkLimit::Clock::time_point end,
                          RecordPair::Response& response) {
  // Before the work: a name that is taken shows at once.
  std::string folder;
  if (!request.folder.empty()) folder = detail::placeBelow(save_folder_, request.folder, "folder");
  if (!folder.empty()) detail::requireAbsent(folder);
  const PairRecording recording = takeCycles(request);
  const detail::PairRecord record = detail::recordOf(recording);
  if (folder.empty()) folder = freeFolder(save_folder_, detail::folderNameOf(recording));
  detail::requireRecordable(record);
  detail::RecordAnswers answers;
  // On this thread alone: others would be missing in the cycle.
  tbb::task_arena(1).execute([&] { answers = detail::answersTo(record, end, &gate_.stopped()); });
  if (gate_.stopped()) throw Error("record_pair", "the node is shutting down", "call another time");
  response.files = detail::writeFolder(folder, detail::savedRecord(recording, record, answers));
  response.folder = folder;
  response.poses = static_cast<std::uint32_t>(record.poses.size());
  response.answered = static_cast<std::uint32_t>(answers.count);
  response.newest.fromNSec(static_cast<std::uint64_t>(recording.epoch));
  response.newest += ros::Duration(record.poses.back().time);
  response.message = joinedText(remarksOn(request, recording, answers, recorder_.length()), "; ");
  ROS_INFO_STREAM("Recorded pair " << record.pair->name << " in " << folder);
}

}  // namespace concave_distance

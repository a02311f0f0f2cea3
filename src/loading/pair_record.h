#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "saved_scene.h"
#include "scene/pair_recorder.h"

namespace concave_distance::detail {

/// Holds what the answers of a pair follow from: replayPair() gives the same ones again.
struct PairRecord {
  std::shared_ptr<const ScenePair> pair;  ///< name and settings
  std::shared_ptr<const SceneBody> body_a;
  std::shared_ptr<const SceneBody> body_b;
  std::vector<TimedPose> poses;
  bool with_niches = false;
};

/// Holds answers.csv and niches.csv of a recording.
struct RecordAnswers {
  std::string answers;
  std::string niches;     ///< empty: not asked for
  std::size_t count = 0;  ///< of poses answered
};

/// The files of a recording, in a folder of its own.
inline constexpr const char* kRecordFile = "record.yaml";
inline constexpr const char* kRecordPoses = "poses.csv";
inline constexpr const char* kRecordAnswers = "answers.csv";
inline constexpr const char* kRecordNiches = "niches.csv";
inline constexpr const char* kRecordMeshes[2] = {"a.obj", "b.obj"};
inline constexpr std::size_t kMostRecordPoses = 100'000;

PairRecord recordOf(const PairRecording& recording);

/// Lets no mesh pass whose file may have more bytes. @throws Error naming the body
void requireRecordable(const PairRecord& record, std::size_t most_bytes = 256'000'000);

/// Writes a recording: the meshes as repaired, poses, settings, versions, the answers of a pair that began
/// anew with the first pose, and what the node had answered (`live...`).
std::vector<SavedFile> savedRecord(const PairRecording& recording, const PairRecord& record,
                                   const RecordAnswers& answers);

/// Returns a name for the folder of a pair's recording: letters, digits and _ of the bodies' names.
std::string folderNameOf(const PairRecording& recording);

}  // namespace concave_distance::detail

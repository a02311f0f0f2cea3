#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pair_record.h"

namespace concave_distance::detail {

/// A recording as its folder has it.
struct LoadedRecord {
  PairRecord record;
  RecordAnswers answers;
  std::vector<std::pair<std::string, std::string>> versions;  ///< of the node that wrote it
};

/// Reads the folder of a recording. Meshes are taken as they stand there, without a repair.
/// @throws Error naming file and place for a file that is missing, cut, too large or not of a recording, and
/// for values that no node can have had
LoadedRecord loadRecord(const std::string& folder);

}  // namespace concave_distance::detail

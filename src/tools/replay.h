#pragma once

#include <iosfwd>
#include <string>

namespace concave_distance::tools {

/// The status of a replay whose answers are not those that were recorded.
inline constexpr int kOtherAnswers = 3;

/// Answers the poses of a recording and says on `out` whether the answers are those of the recording, to the
/// last bit, and where they first differ. @param answers_path, niches_path files for the answers; empty: none
/// @return 0 or kOtherAnswers @throws Error for a damaged recording
int replayRecord(const std::string& folder, const std::string& answers_path, const std::string& niches_path,
                 std::ostream& out);

}  // namespace concave_distance::tools

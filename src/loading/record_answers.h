#pragma once

#include <atomic>
#include <string>

#include "concave_distance/base/work_limit.h"
#include "pair_record.h"

namespace concave_distance::detail {

/// Answers the poses of a recording, as replayPair().
/// @param end, stop as there: what has been answered by then counts
RecordAnswers answersTo(const PairRecord& record, WorkLimit::Clock::time_point end,
                        const std::atomic<bool>* stop = nullptr);

/// Says how a table differs from a recorded one.
struct TableDifference {
  std::size_t rows = 0;        ///< recorded
  std::size_t other_rows = 0;  ///< of these the ones that are not the same, and those that are no more or new
  std::string first;           ///< file, line, column, both values; empty: all are the same
  double largest = 0.0;        ///< of two numbers of one cell
  std::string largest_where;   ///< file, line and column of these
};

struct RecordDifference {
  TableDifference answers;
  TableDifference niches;
  bool isNone() const { return answers.other_rows + niches.other_rows == 0; }
};

/// Checks that the tables of a recording are whole. @param folder of the recording, for messages
/// @throws Error for one that is cut or holds what no recording has: file, line, column, value
void requireWhole(const std::string& folder, const RecordAnswers& recorded);

/// Compares the tables cell by cell as texts of 17 digits: equal texts are equal bits. The lines of one pose
/// are compared in their order; columns that only one of the versions has are not. @throws Error as
/// requireWhole()
RecordDifference compareAnswers(const std::string& folder, const RecordAnswers& recorded,
                                const RecordAnswers& now);

}  // namespace concave_distance::detail

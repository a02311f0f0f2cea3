#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/csv_writer.h"
#include "loading/answer_lines.h"

namespace concave_distance::tools {

/// Writes out.csv, 17 digits, a line per query.
class AnswerWriter : public CsvFile {
 public:
  /// @param with_margins the lines end with the signed distance
  /// @throws Error when the file cannot be written
  explicit AnswerWriter(const std::string& path, bool with_margins = false);
  void write(std::size_t index, const QueryAnswer& answer);

 private:
  bool with_margins_;
};

/// Writes niches.csv, 17 digits, a line per niche.
class NicheWriter : public CsvFile {
 public:
  /// The parameters are those of AnswerWriter.
  explicit NicheWriter(const std::string& path, bool with_margins = false);
  /// The parameters are those of writeNiche().
  void write(std::size_t index, std::uint64_t number, const TrackedNiche& niche, bool described);

 private:
  bool with_margins_;
};

}  // namespace concave_distance::tools

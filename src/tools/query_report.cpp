#include "query_report.h"

namespace concave_distance::tools {

AnswerWriter::AnswerWriter(const std::string& path, bool with_margins)
    : CsvFile(path, answerColumns(with_margins)), with_margins_(with_margins) {}

void AnswerWriter::write(std::size_t index, const QueryAnswer& answer) {
  writeAnswer(index, answer, with_margins_, cells());
}

NicheWriter::NicheWriter(const std::string& path, bool with_margins)
    : CsvFile(path, nicheColumns(with_margins)), with_margins_(with_margins) {}

void NicheWriter::write(std::size_t index, std::uint64_t number, const TrackedNiche& niche, bool described) {
  writeNiche(index, number, niche, described, with_margins_, cells());
}

}  // namespace concave_distance::tools

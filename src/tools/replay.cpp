#include "replay.h"

#include <filesystem>
#include <ostream>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/output_file.h"
#include "base/versions.h"
#include "concave_distance/scene/scene_tracker.h"
#include "kinematics/wording.h"
#include "loading/pair_record_reader.h"
#include "loading/record_answers.h"

namespace concave_distance::tools {
namespace {

using detail::counted;
using Versions = std::vector<std::pair<std::string, std::string>>;

std::string textOf(const Versions& versions) {
  std::vector<std::string> parts;
  for (const auto& [part, version] : versions) parts.push_back(std::string(part).append(" ").append(version));
  return joinedText(parts, ", ");
}

void printTable(const char* what, const detail::TableDifference& table, std::ostream& out) {
  if (table.other_rows == 0) return;
  out << table.first << '\n' << table.other_rows << " " << what << " are not as recorded, of " << table.rows;
  if (table.largest > 0.0) {
    out << "; the largest difference is " << numberText(table.largest, 3) << " (" << table.largest_where
        << ")";
  }
  out << '\n';
}

void requireOtherFiles(const std::string& folder, const std::vector<NamedPath>& outputs) {
  std::vector<NamedPath> inputs;
  for (const char* file : {detail::kRecordFile, detail::kRecordPoses, detail::kRecordAnswers,
                           detail::kRecordNiches, detail::kRecordMeshes[0], detail::kRecordMeshes[1]})
    inputs.push_back({"--replay", (std::filesystem::path(folder) / file).string()});
  requireDistinctFiles(inputs, outputs);
}

void write(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  OutputFile file(path);
  file.stream() << text;
  file.finish();
}

}  // namespace

int replayRecord(const std::string& folder, const std::string& answers_path, const std::string& niches_path,
                 std::ostream& out) {
  requireOtherFiles(folder, {{"--output", answers_path}, {"--niches-output", niches_path}});
  detail::LoadedRecord loaded = detail::loadRecord(folder);
  detail::PairRecord& record = loaded.record;
  out << "pair " << record.pair->name << ": " << counted(record.poses.size(), "pose") << ", "
      << loaded.answers.count << " of them answered in the recording\n"
      << "recorded with " << textOf(loaded.versions) << '\n';
  if (loaded.versions != buildVersions())
    out << "replayed with " << textOf(buildVersions()) << ": last digits may differ\n";
  record.poses.resize(loaded.answers.count);
  const detail::RecordAnswers now = detail::answersTo(record, kNoCycleEnd);
  write(answers_path, now.answers);
  write(niches_path, now.niches);
  const detail::RecordDifference difference = detail::compareAnswers(folder, loaded.answers, now);
  if (difference.isNone()) {
    out << "every distance, point and list is the recorded one, bit for bit\n";
    return 0;
  }
  printTable("answers", difference.answers, out);
  printTable("niches", difference.niches, out);
  return kOtherAnswers;
}

}  // namespace concave_distance::tools

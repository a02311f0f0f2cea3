#include "pair_record.h"

#include <algorithm>

#include "answer_lines.h"
#include "base/ascii.h"
#include "base/number_text.h"
#include "base/versions.h"
#include "concave_distance/base/error.h"
#include "concave_distance/search/prepare_search.h"
#include "mesh/import/obj_text.h"
#include "query_poses.h"
#include "saved_settings.h"

namespace concave_distance::detail {
namespace {

constexpr std::size_t kBytesOfVertex = 80;  // at most, of a line
constexpr std::size_t kBytesOfTriangle = 36;
constexpr const char* kRecordMark =
    "# A pair of bodies, written by record_pair of concave_distance. Replay: distance_query --replay FOLDER";

std::string savedShape(const RoundShape& shape) {
  YamlItems items;
  items.add("kind", shape.kind == RoundKind::Sphere    ? "sphere"
                    : shape.kind == RoundKind::Capsule ? "capsule"
                                                       : "cylinder");
  items.add("radius", yamlNumber(shape.radius));
  items.add("half_length", yamlNumber(shape.half_length));
  items.add("chord_error", yamlNumber(shape.chord_error));
  items.add("pose", yamlPose(shape.body_from_shape));
  return items.flow();
}

// Without room for its matrices the search draws other trial points.
std::string savedGrid(const BodyMesh& mesh) {
  const BodyMeshOptions& options = mesh.options();
  const SearchPreparation search = searchPreparationOf(mesh.asSolved());
  const bool does_without = search.is_complete && !search.has_matrices;
  YamlItems items;
  items.add("max_edge_length", options.max_edge_length ? yamlNumber(*options.max_edge_length) : "auto");
  items.add("search_node_limit", std::to_string(options.search_node_limit));
  items.add("largest_node_count", std::to_string(options.largest_node_count));
  items.add("matrix_node_limit", std::to_string(does_without ? 0 : options.matrix_node_limit));
  return items.flow();
}

std::string savedBody(const SceneBody& body) {
  YamlItems items;
  items.add("name", yamlText(body.name));
  items.add("vertices", std::to_string(body.mesh->surface().vertexCount()));
  items.add("triangles", std::to_string(body.mesh->surface().triangleCount()));
  items.add("margin", yamlNumber(body.margin));
  items.add("grid", savedGrid(*body.mesh));
  if (body.mesh->shape() != nullptr) items.add("shape", savedShape(*body.mesh->shape()));
  items.add("material", savedMaterial(body.material));
  return items.block("  ", "  ");
}

std::string savedFacts(const PairRecording& recording, const PairRecord& record,
                       const RecordAnswers& answers) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  const std::string fraction = std::to_string(kNanoseconds + recording.epoch % kNanoseconds);
  YamlItems versions;
  for (const auto& [part, version] : buildVersions()) versions.add(yamlText(part), yamlText(version));
  YamlItems settings;
  addSettings(record.pair->settings, {}, settings);
  YamlItems items;
  items.add("format", "1");
  items.add("versions", versions.flow());
  items.add("pair", yamlText(record.pair->name));
  items.add("poses", std::to_string(record.poses.size()));
  items.add("answered", std::to_string(answers.count));
  items.add("with_niches", record.with_niches ? "true" : "false");
  // Seconds since 1970 that t counts from.
  items.add("epoch", yamlText(std::to_string(recording.epoch / kNanoseconds) + "." + fraction.substr(1)));
  return std::string(kRecordMark) + "\n" + items.block("", "") + "a:\n" + savedBody(*record.body_a) + "b:\n" +
         savedBody(*record.body_b) + "settings:\n" + settings.block("  ", "  ");
}

std::string liveText(const PairRecording& recording) {
  TextStream text;
  text << "index,distance,lower_bound,niche_count,status,put_off,missed_before\n";
  CsvWriter line(text);
  for (std::size_t i = 0; i < recording.cycles.size(); ++i) {
    const RecordedCycle& cycle = recording.cycles[i];
    line << i << cycle.distance << cycle.lower_bound;
    if (cycle.with_niches) {
      line << cycle.niche_count;
    } else {
      line.skipCells(1);
    }
    line << (cycle.state == PairState::BeyondCutoff ? kBeyondCutoff : toString(cycle.status))
         << (cycle.put_off ? 1 : 0) << cycle.missed_before;
    line.endLine();
  }
  return text.str();
}

void addLastAnswer(const PairRecording& recording, std::vector<SavedFile>& files) {
  if (!recording.last_answer || recording.cycles.empty()) return;
  const PairSolution& answer = *recording.last_answer;
  const RecordedCycle& cycle = recording.cycles.back();
  const std::size_t index = recording.cycles.size() - 1;
  const TrackerParameters tracker =
      withMargins(recording.pair->settings.tracker, *recording.body_a, *recording.body_b);
  const bool has_margins = tracker.margin() > 0.0;
  TextStream text;
  text << answerColumns(has_margins) << '\n';
  CsvWriter line(text);
  QueryAnswer said = answerOf(answer, cycle.with_niches);
  said.time_us = 1e6 * answer.solve_seconds;
  writeAnswer(index, said, has_margins, line);
  files.push_back({"live_answer.csv", text.str()});
  if (!cycle.with_niches) return;
  TextStream niches;
  niches << nicheColumns(has_margins) << '\n';
  CsvWriter niche_line(niches);
  for (const TrackedNiche& niche : answer.niches) {
    writeNiche(index, niche.id, niche, tracker.accuracy != AccuracyLevel::Nodes, has_margins, niche_line);
  }
  files.push_back({"live_niches.csv", niches.str()});
}

void requireSize(const SceneBody& body, std::size_t most_bytes) {
  const SurfaceMesh& surface = body.mesh->surface();
  const std::size_t bytes =
      kBytesOfVertex * surface.vertexCount() + kBytesOfTriangle * surface.triangleCount();
  if (bytes <= most_bytes) return;
  throw Error("body '" + body.name + "'",
              "its mesh of " + std::to_string(surface.triangleCount()) + " triangles is too large to record",
              "simplify it (mesh_tool simplify); the limit is about " +
                  std::to_string(most_bytes / (kBytesOfVertex / 2 + kBytesOfTriangle)) + " triangles");
}

}  // namespace

void requireRecordable(const PairRecord& record, std::size_t most_bytes) {
  requireSize(*record.body_a, most_bytes);
  requireSize(*record.body_b, most_bytes);
}

PairRecord recordOf(const PairRecording& recording) {
  PairRecord record{recording.pair, recording.body_a, recording.body_b, {}, false};
  for (const RecordedCycle& cycle : recording.cycles) {
    record.poses.push_back({cycle.time, cycle.pose()});
    record.with_niches = record.with_niches || cycle.with_niches;
  }
  return record;
}

std::vector<SavedFile> savedRecord(const PairRecording& recording, const PairRecord& record,
                                   const RecordAnswers& answers) {
  std::vector<SavedFile> files = {{kRecordFile, savedFacts(recording, record, answers)},
                                  {kRecordPoses, matrixPosesText(record.poses)},
                                  {kRecordAnswers, answers.answers}};
  if (record.with_niches) files.push_back({kRecordNiches, answers.niches});
  files.push_back({kRecordMeshes[0], objText(record.body_a->mesh->surface())});
  files.push_back({kRecordMeshes[1], objText(record.body_b->mesh->surface())});
  files.push_back({"live.csv", liveText(recording)});
  addLastAnswer(recording, files);
  return files;
}

std::string folderNameOf(const PairRecording& recording) {
  constexpr std::size_t kLongest = 100;
  std::string name = "record_" + recording.body_a->name + "_" + recording.body_b->name;
  const auto is_odd = [](char c) { return !isLetterOrDigit(c) && c != '_'; };
  std::replace_if(name.begin(), name.end(), is_odd, '_');
  return name.substr(0, kLongest);
}

}  // namespace concave_distance::detail

#include "trial_files.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/csv_writer.h"
#include "concave_distance/base/error.h"

namespace concave_distance::evaluation {
namespace {

std::string runsHeader() {
  std::string header = "row,algorithm,scene,run,distance,best_iteration,exact,region,niches";
  for (const char* column : {"members", "niche_distance"}) {
    for (std::size_t i = 1; i <= TrialRecord::kNicheCount; ++i) {
      header += std::string(",") + column + "_" + std::to_string(i);
    }
  }
  return header +
         ",best_convergence,population_convergence,below_second,feasible,evaluations,descents,descent_steps,"
         "flops,microseconds,recall,precision,archive_recall,nearest,wrong_instants,worst_excess,most_niches,"
         "proof_finds,basin,standing";
}
constexpr const char* kCurvesHeader =
    "row,scene,first_run,runs,iteration,best_distance_sum,mean_square_sum,niches_sum,acceptance_sum";

constexpr const char* kPointsHeader = "row,scene,run,individual,distance,ax,ay,az,bx,by,bz";

/// A last line without an end was cut off by a crash or a full disk: nothing says that its last cell is
/// whole, and what is appended would go on in it. It is dropped, after the header has said whose file it is.
/// Returns whether anything is left. @throws Error
bool keepWholeLines(const std::string& path, const std::string& header) {
  std::uintmax_t size = 0;
  std::uintmax_t kept = 0;  // up to the last end of a line
  {
    std::ifstream file(path, std::ios::binary);
    for (std::string line; std::getline(file, line);) {
      const bool is_whole = !file.eof();
      if (size == 0 && (is_whole ? line != header : header.compare(0, line.size(), line) != 0)) {
        throw Error(path, "has another header than this program writes",
                    "move the file away or name another folder");
      }
      size += line.size() + (is_whole ? 1 : 0);
      if (is_whole) kept = size;
    }
  }
  if (kept != size) {
    std::error_code failure;
    std::filesystem::resize_file(path, kept, failure);
    if (failure) {
      throw Error(path, "its last line is cut off and cannot be removed: " + failure.message(),
                  "name a folder that can be written with --output");
    }
  }
  return kept > 0;
}

/// Opens a file to append to; writes its header when it is new. @throws Error
std::ofstream openToAppend(const std::string& path, const std::string& header) {
  const bool is_new = !std::filesystem::exists(path) || !keepWholeLines(path, header);
  std::ofstream file(path, std::ios::app);
  if (!file) throw Error(path, "cannot be written", "name a folder that can be written with --output");
  if (is_new) file << header << '\n' << std::flush;
  return file;
}

// An incomplete last line is dropped by the next call, which appends to the file.
void requireWritten(const std::ostream& stream, const std::string& file) {
  if (stream) return;
  throw Error(file, "not everything could be written", "free space on the device and start again");
}

}  // namespace

TrialFiles::TrialFiles(const Experiment& experiment, const std::string& folder) : experiment_(experiment) {
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/" + experiment.name + ".csv";
  runs_ = openToAppend(path, runsHeader());
  readDone(path);
  if (experiment.curves)
    curves_ = openToAppend(folder + "/" + experiment.name + "_curves.csv", kCurvesHeader);
  if (experiment.points || experiment.population_points)
    points_ = openToAppend(folder + "/" + experiment.name + "_points.csv", kPointsHeader);
}

void TrialFiles::readDone(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const auto commas = std::count(line.begin(), line.end(), ',');
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string row;
    std::string algorithm;
    std::string scene;
    std::string run;
    std::getline(cells, row, ',');
    std::getline(cells, algorithm, ',');
    std::getline(cells, scene, ',');
    std::getline(cells, run, ',');
    if (std::count(line.begin(), line.end(), ',') != commas || run.empty() ||
        run.find_first_not_of("0123456789") != std::string::npos) {
      throw Error(path, "has a line that is no whole run: " + line, "remove the line, its run is done again");
    }
    done_.emplace(row, scene, static_cast<std::uint32_t>(std::stoul(run)));
  }
}

bool TrialFiles::contains(const WorkUnit& unit) const {
  for (std::uint32_t run = unit.first_run; run < unit.first_run + unit.run_count; ++run) {
    if (done_.count({experiment_.rows[unit.row].name, experiment_.scenes[unit.scene].name, run}) == 0) {
      return false;
    }
  }
  return true;
}

void TrialFiles::append(const WorkUnit& unit, const std::vector<TrialRecord>& records,
                        const std::vector<CurvePoint>& curve) {
  const ExperimentRow& row = experiment_.rows[unit.row];
  const std::string& scene = experiment_.scenes[unit.scene].name;
  const std::uint32_t stride = curveStride(row.method);
  CsvWriter curve_cells(curves_);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    curve_cells << row.name << scene << unit.first_run << unit.run_count << i * stride
                << curve[i].best_distance << curve[i].mean_square << curve[i].niches << curve[i].acceptance;
    curve_cells.endLine();
  }
  requireWritten(curves_.flush(), experiment_.name + "_curves.csv");
  if (points_.is_open()) appendPoints(unit, records);
  std::ostringstream lines;
  CsvWriter cells(lines);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const TrialRecord& r = records[i];
    const auto run = static_cast<std::uint32_t>(unit.first_run + i);
    // Of a unit that was cut off in the middle some runs are there already.
    if (!done_.emplace(row.name, scene, run).second) continue;
    cells << row.name << nameOf(row.method) << scene << run << r.distance << r.best_iteration << r.exact
          << r.region << r.niches;
    for (const std::uint32_t members : r.members) cells << members;
    for (const double distance : r.niche_distances) cells << distance;
    cells << r.best_convergence << r.population_convergence << r.below_second << r.feasible
          << r.cost.evaluations << r.cost.descents << r.cost.descent_steps << r.flops << r.microseconds
          << r.recall << r.precision << r.archive_recall << r.nearest << r.wrong_instants << r.worst_excess
          << r.most_niches << r.proof_finds << r.basin << r.standing;
    cells.endLine();
  }
  requireWritten(runs_ << lines.str() << std::flush, experiment_.name + ".csv");
}

void TrialFiles::appendPoints(const WorkUnit& unit, const std::vector<TrialRecord>& records) {
  CsvWriter cells(points_);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const TrialRecord& r = records[i];
    // The lines of a population differ at least in the number: joined files keep each line once.
    std::size_t number = 0;
    const auto write = [&](const IndividualPoints& pair) {
      cells << experiment_.rows[unit.row].name << experiment_.scenes[unit.scene].name << unit.first_run + i
            << number++ << pair.distance << pair.point_a << pair.point_b;
      cells.endLine();
    };
    if (experiment_.points) write({r.distance, r.point_a, r.point_b});
    std::for_each(r.population.begin(), r.population.end(), write);
  }
  requireWritten(points_.flush(), experiment_.name + "_points.csv");
}

}  // namespace concave_distance::evaluation

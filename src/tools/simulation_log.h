#pragma once

#include <string>

#include "base/output_file.h"
#include "concave_distance/simulation/simulation.h"

namespace concave_distance::tools {

/// A CSV file of 17 digits; an empty cell was not computed.
class CsvFile {
 public:
  /// @throws Error when the file cannot be written
  CsvFile(const std::string& path, const std::string& header);
  CsvFile& operator<<(double value);
  CsvFile& operator<<(std::uint64_t value);
  CsvFile& operator<<(const std::string& text);
  CsvFile& operator<<(const Eigen::Vector3d& vector);
  void endLine();
  /// @throws Error when something could not be written
  void complete() { file_.complete(); }
  void finish() { file_.finish(); }

 private:
  void separate();
  OutputFile file_;
  bool line_begun_ = false;
};

/// One line a time: energies, bodies that move (pose of the frame, velocity of the centre of mass), pairs.
class TrajectoryLog {
 public:
  TrajectoryLog(const std::string& path, const Simulation& simulation);
  void write(const Simulation& simulation);
  void complete() { file_.complete(); }
  void finish() { file_.finish(); }

 private:
  CsvFile file_;
};

/// One line a region of overlap; world frame.
class ContactLog {
 public:
  explicit ContactLog(const std::string& path);
  void write(const Simulation& simulation);
  void complete() { file_.complete(); }
  void finish() { file_.finish(); }

 private:
  CsvFile file_;
};

/// One line a niche; world frame.
class NicheLog {
 public:
  explicit NicheLog(const std::string& path);
  void write(const Simulation& simulation);
  void complete() { file_.complete(); }
  void finish() { file_.finish(); }

 private:
  CsvFile file_;
};

}  // namespace concave_distance::tools

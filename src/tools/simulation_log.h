#pragma once

#include <string>

#include "base/csv_writer.h"
#include "concave_distance/simulation/simulation.h"

namespace concave_distance::tools {

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

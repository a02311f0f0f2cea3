#pragma once

#include <string>

#include "base/csv_writer.h"
#include "concave_distance/simulation/simulation.h"

namespace concave_distance::tools {

/// One line a time: energies, bodies that move (pose of the frame, velocity of the centre of mass), pairs.
class TrajectoryLog : public CsvFile {
 public:
  TrajectoryLog(const std::string& path, const Simulation& simulation);
  void write(const Simulation& simulation);
};

/// One line a region of overlap; world frame.
class ContactLog : public CsvFile {
 public:
  explicit ContactLog(const std::string& path);
  void write(const Simulation& simulation);
};

/// One line a niche; world frame.
class NicheLog : public CsvFile {
 public:
  explicit NicheLog(const std::string& path);
  void write(const Simulation& simulation);
};

}  // namespace concave_distance::tools

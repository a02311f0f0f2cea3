#pragma once

#include <memory>
#include <string>

#include "bag_replay.h"
#include "base/csv_writer.h"

namespace concave_distance {

/// Writes the answers of a replay: a line for each, and one for each niche. What was not computed is an empty
/// cell; points and vectors are in the reference frame.
class BagReport {
 public:
  static constexpr const char* kColumns =
      "time,stamp,pair,body_a,body_b,status,distance,lower_bound,ax,ay,az,bx,by,bz,nx,ny,nz,closing_speed,"
      "signed_distance,niche_count,niche,warning,triangle_a,triangle_b,message";
  static constexpr const char* kNicheColumns =
      "time,stamp,pair,niche,distance,ax,ay,az,bx,by,bz,nx,ny,nz,closing_speed,kind,extent,outward,visible,"
      "prominence,origin,signed_distance";

  /// @param niches_path empty: niches are not written @throws Error when a file cannot be written
  BagReport(const std::string& path, const std::string& niches_path);

  void write(const BagAnswer& answer);
  /// @throws Error when something could not be written so far
  void check();
  /// Both files are complete then, or missing. @throws Error as check()
  void finish();

 private:
  void writeNiches(const BagAnswer& answer);

  CsvFile answers_;
  std::unique_ptr<CsvFile> niches_;
};

}  // namespace concave_distance

#include "friction_sites.h"

#include <algorithm>
#include <cmath>

#include "base/triangle_measures.h"
#include "patch_cells.h"

namespace concave_distance {
namespace {

// The longest edge, in cells, of a part whose pressure is added to one cell.
constexpr double kLongestEdge = 1.5;
// No triangle is cut finer than this share of its longest edge: a line of contact has cells as
// wide as itself.
constexpr double kShortestShare = 0.25;

}  // namespace

void FrictionSites::gather(const OverlapSample* first_sample, const OverlapSample* last_sample,
                           const std::vector<double>& forces, double cell_size) {
  shares_.clear();
  sites_.clear();
  if (first_sample == last_sample) return;
  origin_ = first_sample->point_in_a;
  cell_size_ = cell_size;
  for (const OverlapSample* sample = first_sample; sample != last_sample;) {
    const double* force = forces.data() + (sample - first_sample);
    const bool is_triangle = last_sample - sample >= 3 && isTriangle(sample);
    const int count = is_triangle ? 3 : 1;
    double longest = 0.0;
    Triangle triangle;
    if (is_triangle) {
      triangle = triangleOf(sample, force);
      longest = std::sqrt(squaredEdge(triangle.corners, longestEdge(triangle.corners)));
    }
    if (longest > kLongestEdge * cell_size) {
      spread(triangle, sample->push_in_a, std::max(kLongestEdge * cell_size, kShortestShare * longest));
    } else {
      for (int k = 0; k < count; ++k) addPoint(sample[k].point_in_a, sample[k].push_in_a, force[k]);
    }
    sample += count;
  }
  shares_.forEach([this](const Share& sum) { addSite(sum); });
}

// A whole triangle is sampled at the middles of its edges; the triangle between these has a quarter
// of its area.
bool FrictionSites::isTriangle(const OverlapSample* sample) {
  for (int k = 1; k < 3; ++k) {
    if (sample[k].area != sample->area || sample[k].push_in_a != sample->push_in_a) return false;
  }
  const Eigen::Vector3d to_second = sample[1].point_in_a - sample[0].point_in_a;
  const Eigen::Vector3d to_third = sample[2].point_in_a - sample[0].point_in_a;
  const double area = 2.0 * to_second.cross(to_third).norm();
  const double stands_for = 6.0 * std::abs(sample->area);  // both surfaces count half
  return std::abs(area - stands_for) <= 1e-6 * stands_for;
}

FrictionSites::Triangle FrictionSites::triangleOf(const OverlapSample* sample, const double* forces) {
  Triangle triangle;
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t before = (k + 2) % 3;
    const std::size_t opposite = (k + 1) % 3;
    triangle.corners[k] = sample[k].point_in_a + sample[before].point_in_a - sample[opposite].point_in_a;
    triangle.forces[k] = 3.0 * (forces[k] + forces[before] - forces[opposite]);
    sum += forces[k];
  }
  // No corner pulls where the pressure is not quite linear.
  double kept = 0.0;
  for (double& force : triangle.forces) {
    if (force * sum < 0.0) force = 0.0;
    kept += force / 3.0;
  }
  for (double& force : triangle.forces) force *= kept != 0.0 ? sum / kept : 0.0;
  return triangle;
}

// Halves across the longest edge, metres.
void FrictionSites::spread(const Triangle& triangle, const Eigen::Vector3d& push, double longest_edge) {
  parts_.assign(1, triangle);
  while (!parts_.empty()) {
    const Triangle part = parts_.back();
    parts_.pop_back();
    const std::size_t k = longestEdge(part.corners);
    if (!(squaredEdge(part.corners, k) > longest_edge * longest_edge)) {
      addPart(part, push);
      continue;
    }
    const std::size_t next = (k + 1) % 3;
    const Eigen::Vector3d middle = 0.5 * (part.corners[k] + part.corners[next]);
    const double force = 0.5 * (part.forces[k] + part.forces[next]);
    for (const std::size_t replaced : {k, next}) {
      Triangle half = part;
      half.corners[replaced] = middle;
      half.forces[replaced] = force;
      for (double& all : half.forces) all *= 0.5;
      parts_.push_back(half);
    }
  }
}

// With a linear pressure the corner k counts (sum + force k) / (4 sum); its own width as under
// a constant one.
void FrictionSites::addPart(const Triangle& part, const Eigen::Vector3d& push) {
  const double sum = part.forces[0] + part.forces[1] + part.forces[2];
  if (sum == 0.0) return;
  const Eigen::Vector3d middle = (part.corners[0] + part.corners[1] + part.corners[2]) / 3.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    centre += 0.25 * (1.0 + part.forces[k] / sum) * part.corners[k];
    const Eigen::Vector3d arm = part.corners[k] - middle;
    own += arm * arm.transpose() / 12.0;
  }
  const double force = sum / 3.0;
  const Eigen::Vector3d place = centre - origin_;
  shares_.add({cellOf(centre, push, cell_size_), force, force * push, force * place,
               force * (place * place.transpose() + own)});
}

void FrictionSites::addPoint(const Eigen::Vector3d& point, const Eigen::Vector3d& push, double force) {
  if (force == 0.0) return;
  const Eigen::Vector3d place = point - origin_;
  shares_.add({cellOf(point, push, cell_size_), force, force * push, force * place,
               force * place * place.transpose()});
}

void FrictionSites::addSite(const Share& sum) {
  const double length = sum.push.norm();
  if (!(sum.force > 0.0 && length > 0.0)) return;
  const Eigen::Vector3d normal = sum.push / length;
  const Eigen::Vector3d centre = sum.place / sum.force;
  const Eigen::Matrix3d squares = sum.squares / sum.force - centre * centre.transpose();
  const double in_plane = squares.trace() - normal.dot(squares * normal);
  sites_.push_back({sum.cell, origin_ + centre, normal, sum.force, std::sqrt(std::max(0.0, 0.5 * in_plane))});
}

}  // namespace concave_distance

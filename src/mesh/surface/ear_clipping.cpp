#include "ear_clipping.h"

#include <algorithm>
#include <optional>
#include <queue>
#include <utility>

#include "plane_geometry.h"

namespace concave_distance::detail {
namespace {

using Ear = std::array<std::uint32_t, 3>;

class EarClipping {
 public:
  EarClipping(const std::vector<Eigen::Vector2d>& polygon, double least_height,
              const std::function<bool(std::uint32_t, std::uint32_t)>& allows_diagonal)
      : polygon_(polygon), least_height_(least_height), allows_diagonal_(allows_diagonal) {
    const auto count = static_cast<std::uint32_t>(polygon.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      before_.push_back((i + count - 1) % count);
      after_.push_back((i + 1) % count);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      shapes_.push_back(shapeOf(i));
      if (shapes_[i] <= 0.0) dents_.push_back(i);
      candidates_.emplace(shapes_[i], i);
    }
  }

  std::vector<Ear> run() {
    std::vector<Ear> ears;
    const std::size_t wanted = polygon_.size() - 2;
    while (ears.size() < wanted) {
      const std::optional<std::uint32_t> corner = bestEar(wanted - ears.size() > 1);
      if (!corner) return {};
      ears.push_back(earAt(*corner));
      clip(*corner);
    }
    return ears;
  }

 private:
  using Candidate = std::pair<double, std::uint32_t>;  ///< shape and corner

  Ear earAt(std::uint32_t i) const { return {before_[i], i, after_[i]}; }

  PlaneTriangle placeOf(const Ear& t) const { return {polygon_[t[0]], polygon_[t[1]], polygon_[t[2]]}; }

  /// Height over longest edge of the triangle at a corner; 0 where it is too flat or turned.
  double shapeOf(std::uint32_t i) const {
    const auto [a, b, c] = placeOf(earAt(i));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double height = cross(b - a, c - a) / longest;
    return height > least_height_ ? height / longest : 0.0;
  }

  /// @param has_diagonal not of the last triangle
  bool isEar(std::uint32_t i, bool has_diagonal) const {
    const Ear ear = earAt(i);
    const PlaneTriangle place = placeOf(ear);
    // Where any corner lies in the triangle, one that is not convex does.
    const bool is_empty = std::none_of(dents_.begin(), dents_.end(), [&](std::uint32_t dent) {
      return shapes_[dent] <= 0.0 && std::find(ear.begin(), ear.end(), dent) == ear.end() &&
             leastHeight(place, polygon_[dent]).value > -least_height_;
    });
    return is_empty && (!has_diagonal || allows_diagonal_(ear[0], ear[2]));
  }

  /// The best shaped; those that are no ears now are asked again when there is no other.
  std::optional<std::uint32_t> bestEar(bool has_diagonal) {
    bool asked_again = false;
    while (true) {
      while (!candidates_.empty()) {
        const Candidate best = candidates_.top();
        candidates_.pop();
        if (best.first <= 0.0 || best.first != shapes_[best.second]) continue;
        if (isEar(best.second, has_diagonal)) return best.second;
        refused_.push_back(best);
      }
      if (asked_again) return {};
      asked_again = true;
      for (const Candidate& candidate : refused_) candidates_.push(candidate);
      refused_.clear();
    }
  }

  void clip(std::uint32_t i) {
    shapes_[i] = kClipped;
    after_[before_[i]] = after_[i];
    before_[after_[i]] = before_[i];
    for (const std::uint32_t neighbour : {before_[i], after_[i]}) {
      shapes_[neighbour] = shapeOf(neighbour);
      candidates_.emplace(shapes_[neighbour], neighbour);
    }
  }

  static constexpr double kClipped = 2.0;  ///< the shape of no triangle

  const std::vector<Eigen::Vector2d>& polygon_;
  double least_height_;
  const std::function<bool(std::uint32_t, std::uint32_t)>& allows_diagonal_;
  std::vector<std::uint32_t> before_;
  std::vector<std::uint32_t> after_;
  std::vector<double> shapes_;        ///< of the triangles at the corners
  std::vector<std::uint32_t> dents_;  ///< corners that were not convex at first; none becomes one
  std::priority_queue<Candidate> candidates_;
  std::vector<Candidate> refused_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> clipEars(
    const std::vector<Eigen::Vector2d>& polygon, double least_height,
    const std::function<bool(std::uint32_t, std::uint32_t)>& allows_diagonal) {
  if (polygon.size() < 3) return {};
  return EarClipping(polygon, least_height, allows_diagonal).run();
}

}  // namespace concave_distance::detail

#include "benchmark/support/fcl_clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "benchmark/support/sampled_clearance.h"

namespace concave_distance::benchmark {
namespace {

constexpr std::size_t kFirstStride = 32;
constexpr double kFar = 1e6;  // m, beyond all distances
// Longer pieces, m of path, are halved without FCL: 10 to 500 mm tried, this was the fastest.
constexpr double kLongestAsked = 0.02;

/// A pair during a piece of the motion. Its values at the ends are lower bounds; FCL's where `is_exact`.
struct Piece {
  double bound = 0.0;
  double path = 0.0;
  std::size_t pair = 0;
  double from = 0.0;
  double to = 0.0;
  double at_from = 0.0;
  double at_to = 0.0;
  bool from_is_exact = false;
  bool to_is_exact = false;

  bool operator<(const Piece& other) const { return bound > other.bound; }  // the least comes first
};

class FclBisection {
 public:
  FclBisection(const MotionStage& stage, const Motion& motion, double tolerance)
      : stage_(stage), motion_(motion), tolerance_(tolerance) {}

  ClearanceBracket run(std::size_t most) {
    begin();
    while (!queue_.empty() && bracket_.upper > 0.0) {
      const Piece piece = queue_.top();
      if (piece.bound >= bracket_.upper - tolerance_) break;
      if (bracket_.distances >= most) {
        bracket_.is_whole = false;
        break;
      }
      queue_.pop();
      open(piece);
    }
    if (!queue_.empty()) least_done_ = std::min(least_done_, queue_.top().bound);
    bracket_.lower = std::min(least_done_, bracket_.upper);
    return bracket_;
  }

 private:
  /// The waypoints give the first distance that the others are compared with.
  void begin() {
    bracket_.upper = kFar;
    for (const double time : motion_.times) {
      placeAt(time);
      const double least = stage_.leastAt(poses_, bracket_.upper, nullptr, &bracket_.distances);
      if (least < bracket_.upper) bracket_.time = time;
      bracket_.upper = least;
    }
    for (std::size_t s = 0; s < motion_.segmentCount(); ++s) {
      for (std::size_t pair = 0; pair < stage_.pairs().size(); ++pair) {
        Piece piece;
        piece.pair = pair;
        piece.from = motion_.times[s];
        piece.to = motion_.times[s + 1];
        add(piece);
      }
    }
  }

  /// Puts a piece in the queue unless its bound is high enough.
  void wait(const Piece& piece) {
    if (piece.bound < bracket_.upper - tolerance_) {
      queue_.push(piece);
    } else {
      least_done_ = std::min(least_done_, piece.bound);
    }
  }

  void placeAt(double time) {
    if (time == placed_) return;
    stage_.place(motion_.at(time), poses_);
    placed_ = time;
  }

  double boxesAt(std::size_t pair, double time) {
    placeAt(time);
    return stage_.boundAt(pair, poses_, std::numeric_limits<double>::infinity());
  }

  double exactAt(std::size_t pair, double time, double seed) {
    placeAt(time);
    ++bracket_.distances;
    const double distance = stage_.distanceAt(pair, poses_, seed);
    if (distance < bracket_.upper) {
      bracket_.upper = distance;
      bracket_.time = time;
    }
    return distance;
  }

  /// Bounds a piece and lets it wait. The bound from its middle alone comes first: it is often enough.
  void add(Piece piece) {
    const double middle = 0.5 * (piece.from + piece.to);
    placeAt(middle);
    piece.path = stage_.pathBound(piece.pair, poses_, motion_.at(piece.to) - motion_.at(piece.from));
    piece.bound =
        std::max({0.0, piece.bound, boxesAt(piece.pair, middle) - 0.5 * piece.path, boundOf(piece)});
    wait(piece);
  }

  static double boundOf(const Piece& piece) { return 0.5 * (piece.at_from + piece.at_to - piece.path); }

  /// Asks FCL at an end that it was not asked at; else halves the piece. What FCL is asked for ends where it
  /// is enough for the piece's bound.
  void open(Piece piece) {
    const double enough = 2.0 * bracket_.upper + piece.path;
    if (piece.path > kLongestAsked) {
      halve(piece);
      return;
    }
    if (!piece.from_is_exact) {
      piece.at_from = exactAt(piece.pair, piece.from, 0.5 * enough);
      piece.from_is_exact = true;
    } else if (!piece.to_is_exact) {
      piece.at_to = exactAt(piece.pair, piece.to, enough - piece.at_from);
      piece.to_is_exact = true;
    } else {
      halve(piece);
      return;
    }
    piece.bound = std::max(piece.bound, boundOf(piece));
    wait(piece);
  }

  void halve(const Piece& piece) {
    const double middle = 0.5 * (piece.from + piece.to);
    Piece first = piece;
    Piece second = piece;
    first.to = second.from = middle;
    if (piece.to_is_exact) {
      first.at_to = second.at_from = exactAt(piece.pair, middle, bracket_.upper + 0.5 * piece.path);
    } else {
      first.at_to = second.at_from = 0.0;
      first.to_is_exact = second.from_is_exact = false;
    }
    add(first);
    add(second);
  }

  const MotionStage& stage_;
  const Motion& motion_;
  double tolerance_;
  ClearanceBracket bracket_;
  std::priority_queue<Piece> queue_;
  double least_done_ = kFar;  ///< bound of the pieces that are in the queue no more
  MotionStage::Poses poses_;
  double placed_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

ClearanceBracket clearanceByFixedSteps(const MotionStage& stage, const Motion& motion, double tolerance,
                                       std::size_t most) {
  ClearanceBracket bracket;
  bracket.upper = kFar;
  const std::vector<double> times = sampleTimes(stage, motion, 2.0 * tolerance);
  MotionStage::Poses poses;
  const auto visit = [&](double time) {
    stage.place(motion.at(time), poses);
    const double least = stage.leastAt(poses, bracket.upper, nullptr, &bracket.distances);
    if (least < bracket.upper) bracket.time = time;
    bracket.upper = least;
  };
  const auto visitAll = [&](bool are_first) {
    for (std::size_t i = 0; i < times.size() && bracket.upper > 0.0; ++i) {
      if ((i % kFirstStride == 0) != are_first) continue;
      if (bracket.distances >= most) {
        bracket.is_whole = false;
        return;
      }
      visit(times[i]);
    }
  };
  visitAll(true);
  visitAll(false);
  bracket.lower = std::max(0.0, bracket.upper - tolerance);
  return bracket;
}

ClearanceBracket clearanceByBisection(const MotionStage& stage, const Motion& motion, double tolerance,
                                      std::size_t most) {
  return FclBisection(stage, motion, tolerance).run(most);
}

}  // namespace concave_distance::benchmark

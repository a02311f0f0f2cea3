#include "round_section.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/triangle_measures.h"
#include "mesh/surface/round_geometry.h"
#include "round_lines.h"
#include "round_volume.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

// Triangles up to these shares of the distance from the core take 3 and 6 points.
constexpr double kSmall = 0.05;
constexpr double kMedium = 0.3;
// Parts of a section are cut about the core where that is nearer than this share of their length.
constexpr double kNearCore = 0.8;
constexpr int kMostRings = 6;
constexpr double kWidestArc = kPi / 3.0;
// An arc this much of its chord away from that counts as straight where the part is only to be drawn.
constexpr double kStraight = 0.01;
// A core farther than this share of the radius needs no rings about it.
constexpr double kFarCore = 0.3;
constexpr double kShortestAxis = 1e-14;
// Over lengths across the core of less than this share of the distance from it the depth is so nearly
// quadratic that three points leave a millionth.
constexpr double kBendsLittle = 0.4;
// A border that goes this share beyond its chord, as seen from the centre, is integrated along that with
// three points, and no wider than this angle.
constexpr double kBeyondChord = 0.05;
constexpr double kWidestChord = 0.95 * kPi;
// Three points on an arc of a circle up to this many radians, and five up to kWidestArc, leave 1e-10.
constexpr double kShortTurn = 0.3;

/// Radians by which an arc turns about the middle of its circle. By rounding alone it may come out below 0;
/// an arc of more than a half has its middle for the centre of the section, or as good as that.
double turnAbout(const Vector3d& middle, const RoundOutline::Arc& arc, const Vector3d& normal,
                 const Vector3d& centre) {
  const Vector3d from = arc.start - middle;
  const Vector3d to = arc.end - middle;
  const double turn = std::atan2(from.cross(to).dot(normal), from.dot(to));
  if (turn > 0.0) return turn;
  const bool beyond_half =
      arc.to - arc.from > 0.5 * kPi && (centre - middle).squaredNorm() < 0.25 * from.squaredNorm();
  return beyond_half ? turn + 2.0 * kPi : 0.0;
}

}  // namespace

void RoundSection::integrate(const RoundShape& shape, const TrianglePoints& triangle,
                             const LowestPoint& lowest, bool sparse, std::vector<RoundSample>& samples,
                             std::vector<TrianglePoints>& fan, RoundVolume& volume) {
  shape_ = &shape;
  triangle_ = triangle;
  samples_ = &samples;
  fan_ = &fan;
  volume_ = &volume;
  centre_ = lowest.point;
  core_ = std::max(1e-3 * shape.radius, (lowest.point - corePoint(shape, lowest.point)).norm());
  normal_ = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double twice_area = normal_.norm();
  if (!(twice_area > 0.0)) return;
  normal_ /= twice_area;
  const bool inside = std::all_of(triangle.begin(), triangle.end(), [&](const Vector3d& corner) {
    return signedDistance(shape, corner) <= 0.0;
  });
  if (inside) return addInside(sparse);
  if (hasSide(shape) && core_ > kFarCore * shape.radius) moveCentre();
  outline_.find(shape, triangle, normal_, centre_);
  for (const RoundOutline::Straight& straight : outline_.straights()) {
    volume.addTriangle({centre_, straight.from, straight.to});
    addStraight(straight);
  }
  for (const RoundOutline::Arc& arc : outline_.arcs()) {
    volume.addSector(outline_, arc);
    addArc(arc);
  }
}

/// Where the depth hardly changes its deepest point may be at the border: to the middle of the
/// plane's section, which is symmetrical about the axis as seen on the plane, or as far towards it as
/// the triangle goes.
void RoundSection::moveCentre() {
  const Vector3d foot = normal_.dot(centre_) * normal_;
  const Vector3d axis = Vector3d::UnitZ() - normal_.z() * normal_;
  const Vector3d along = axis.norm() > kShortestAxis ? Vector3d(axis.normalized()) : normal_.unitOrthogonal();
  const double reach = 2.0 * reachOf(*shape_);
  const LowestPoint lowest = lowestOnSegment(*shape_, foot - reach * along, foot + reach * along);
  if (lowest.value >= 0.0) return;
  const double ahead = wayOut(*shape_, lowest.point, along, reach);
  const double behind = wayOut(*shape_, lowest.point, -along, reach);
  const Vector3d middle = lowest.point + 0.5 * (ahead - behind) * along;
  const Vector3d nearest = pointTriangleDistance(middle, triangle_).point;
  if (signedDistance(*shape_, nearest) < 0.0) centre_ = nearest;
}

void RoundSection::addInside(bool sparse) {
  const Vector3d& a = triangle_[0];
  const Vector3d& b = triangle_[1];
  const Vector3d& c = triangle_[2];
  const double area = triangleArea(a, b, c);
  fan_->push_back(triangle_);
  volume_->addTriangle(triangle_);
  if (sparse) return add((a + b + c) / 3.0, area);
  const double size =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  const double room = shape_->radius + signedDistance(*shape_, centre_);
  const bool bends =
      hasFlatEnds(*shape_) && std::any_of(triangle_.begin(), triangle_.end(), [&](const Vector3d& corner) {
        return outwardDirection(*shape_, corner).dot(outwardDirection(*shape_, centre_)) < 0.5;
      });
  if (size > kMedium * room || bends) {
    fan_->pop_back();
    for (std::size_t k = 0; k < 3; ++k) addStraight({triangle_[k], triangle_[(k + 1) % 3]});
  } else if (size > kSmall * room) {
    for (const TrianglePoint& p : kTriangleSix)
      add(p.u * a + p.v * b + (1.0 - p.u - p.v) * c, p.weight * area);
  } else {
    for (std::size_t k = 0; k < 3; ++k) add(0.5 * (triangle_[k] + triangle_[(k + 1) % 3]), area / 3.0);
  }
}

void RoundSection::addStraight(const RoundOutline::Straight& piece) {
  const Vector3d along = piece.to - piece.from;
  const double twice_area = (piece.from - centre_).cross(along).dot(normal_);
  if (!(twice_area > 0.0)) return;
  fan_->push_back({centre_, piece.from, piece.to});
  const double length = along.norm();
  const double nearest = (centre_ - piece.from).dot(along) / (length * length);
  const double width = std::max(core_, twice_area / length) / length;
  LineCuts cuts = kinksOf(*shape_, piece.from, piece.to);
  double ring = width;
  for (int k = 0; k < kMostRings && core_ < kNearCore * length; ++k, ring *= 3.0) {
    cuts.add(nearest - ring);
    cuts.add(nearest + ring);
  }
  double from = 0.0;
  for (const double to : cuts.sorted()) {
    const Vector3d start = piece.from + from * along;
    const Vector3d end = piece.from + to * along;
    for (const GaussPoint& at : bendsLittle(start, end) ? GaussRule(kGaussThree) : GaussRule(kGaussFive))
      addRay(piece.from + (from + at.at * (to - from)) * along, at.weight * (to - from) * twice_area);
    from = to;
    if (to == 1.0) break;
  }
}

/// Returns whether the depth is as good as quadratic between two points.
bool RoundSection::bendsLittle(const Vector3d& from, const Vector3d& to) const {
  const Vector3d way = to - from;
  const double across = hasFlatEnds(*shape_) ? way.head<2>().norm() : way.norm();
  return across <= kBendsLittle * core_;
}

/// Integrates an arc of a ball by the angle about the circle's middle, of which the integrals are
/// trigonometric polynomials. So they are the same however edges cut the circle.
void RoundSection::addCircleArc(const RoundOutline::Arc& arc) {
  const Vector3d middle = normal_.dot(centre_) * normal_;
  const double turn = turnAbout(middle, arc, normal_, centre_);
  const auto parts = std::max(1, static_cast<int>(std::ceil(turn / kWidestArc - 1e-9)));
  const GaussRule rule = turn <= kShortTurn ? GaussRule(kGaussThree) : GaussRule(kGaussFive);
  const Vector3d out = arc.start - middle;
  const Vector3d side = normal_.cross(out);
  const auto at = [&](double angle) {
    return Vector3d(middle + std::cos(angle) * out + std::sin(angle) * side);
  };
  const double width = turn / parts;
  Vector3d start = arc.start;
  for (int part = 0; part < parts; ++part) {
    std::size_t count = 0;
    for (const GaussPoint& gauss : rule) {
      const Vector3d point = at((part + gauss.at) * width);
      const Vector3d tangent = normal_.cross(point - middle);
      arc_points_[count++] = point;
      addRay(point, gauss.weight * width * (point - centre_).cross(tangent).dot(normal_));
    }
    const Vector3d end = part + 1 == parts ? arc.end : at((part + 1) * width);
    addToFan(start, count, end);
    start = end;
  }
}

/// Integrates an arc in parts along their chords: exact where the border is straight, as that of a cylinder
/// on its side.
void RoundSection::addArc(const RoundOutline::Arc& arc) {
  if (!hasSide(*shape_)) return addCircleArc(arc);
  const double width = arc.to - arc.from;
  if (width < kWidestChord && isNearlyStraight(arc.start, arc.end))
    return addArcPart(GaussRule(kGaussThree), arc.start, arc.end);
  const auto parts = std::max(1, static_cast<int>(std::ceil(width / kWidestArc - 1e-9)));
  Vector3d start = arc.start;
  for (int part = 1; part <= parts; ++part) {
    const Vector3d end = part == parts ? arc.end : outline_.border(arc.from + part * width / parts);
    addArcPart(GaussRule(kGaussFive), start, end);
    start = end;
  }
}

bool RoundSection::isNearlyStraight(const Vector3d& start, const Vector3d& end) const {
  const Vector3d middle = 0.5 * (start + end) - centre_;
  const double length = middle.norm();
  return length > 0.0 && bendsLittle(start, end) &&
         (outline_.towards(middle / length) - centre_).norm() <= (1.0 + kBeyondChord) * length;
}

void RoundSection::addArcPart(const GaussRule& rule, const Vector3d& start, const Vector3d& end) {
  const double twice_area = (start - centre_).cross(end - centre_).dot(normal_);
  std::size_t count = 0;
  for (const GaussPoint& at : rule) {
    const Vector3d chord = start + at.at * (end - start) - centre_;
    const double length = chord.norm();
    Vector3d& point = arc_points_[count++];
    point = length > 0.0 ? outline_.towards(chord / length) : centre_;
    if (length > 0.0)
      addRay(point, at.weight * twice_area * (point - centre_).squaredNorm() / (length * length));
  }
  addToFan(start, count, end);
}

/// One triangle where the border is straight.
void RoundSection::addToFan(const Vector3d& start, std::size_t count, const Vector3d& end) {
  const double sagitta = (arc_points_[count / 2] - 0.5 * (start + end)).norm();
  if (sagitta <= kStraight * (end - start).norm()) {
    fan_->push_back({centre_, start, end});
    return;
  }
  Vector3d before = start;
  for (std::size_t i = 0; i < count; ++i) {
    fan_->push_back({centre_, before, arc_points_[i]});
    before = arc_points_[i];
  }
  fan_->push_back({centre_, before, end});
}

/// Integrates in rings around the core where that is near, for the fields of RoundVolume, and cut
/// at the kinks.
/// @param weight of the whole ray: twice the area that it stands for
void RoundSection::addRay(const Vector3d& end, double weight) {
  LineCuts kinks = kinksOf(*shape_, centre_, end);
  const double length = (end - centre_).norm();
  double ring = core_;
  for (int k = 0; k < kMostRings && ring < kNearCore * length; ++k, ring *= 3.0) kinks.add(ring / length);
  const GaussRule rule = bendsLittle(centre_, end) ? GaussRule(kGaussThree) : GaussRule(kGaussFour);
  double from = 0.0;
  for (const double to : kinks.sorted()) {
    for (const GaussPoint& at : rule) {
      const double share = from + at.at * (to - from);
      add(centre_ + share * (end - centre_), weight * share * at.weight * (to - from));
    }
    from = to;
    if (to == 1.0) break;
  }
}

void RoundSection::add(const Vector3d& point, double area) {
  if (!(area > 0.0)) return;
  samples_->push_back({point, normal_, outwardDirection(*shape_, point), area,
                       std::max(0.0, -signedDistance(*shape_, point))});
}

}  // namespace concave_distance::detail

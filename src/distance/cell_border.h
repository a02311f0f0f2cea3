#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "cell_neighbours.h"
#include "concave_distance/base/work_limit.h"

namespace concave_distance::detail {

/// What parts a set of triangle pairs from one beyond it.
struct BorderElement {
  SharedElement shared;
  TriangleIndex beyond;  ///< of the body that has the edge; with `shared.other` the pair beyond

  TrianglePair pairBeyond() const {
    return shared.side == Side::A ? TrianglePair{beyond, shared.other} : TrianglePair{shared.other, beyond};
  }
};

/// What encloses a set of triangle pairs: elements over which the distance is at least a level. At another
/// pose the distance over an element has changed by no more than one point has moved and the turn times a
/// lever; where that is not enough it is measured anew, and from then on the gap along the direction of the
/// closest points is what counts, which the motion across it leaves as it is. No history: what holds is seen
/// at the pose itself.
class CellBorder {
 public:
  /// An empty one around a point of each body, own axes in the scene's centre.
  void begin(const Eigen::Vector3d& centre_a, const Eigen::Vector3d& centre_b);

  /// @param level metres, of the distance over the element at this pose. False without memory.
  bool add(const MinimaScene& scene, const BorderElement& element, double level, WorkLimit& limit);

  /// Looks for elements over which the distance is below `level` (metres): they leave the border.
  const std::vector<BorderElement>& takeCrossed(const MinimaScene& scene, double level);

  std::size_t size() const;
  std::uint32_t measured() const { return measured_; }  ///< elements, by the last takeCrossed()
  std::size_t memoryBytes() const;

 private:
  /// Elements measured at one pose, seen from the axes of one body while the other one moves; in single
  /// precision. The moving body's part of each lies within the lever of its centre.
  struct Batch {
    Side fixed_in = Side::A;
    bool directed = false;
    Eigen::Matrix3d rotation;  ///< of the scene's frames, at the pose
    Eigen::Vector3d offset;
    float longest = 0.0F;  ///< lever
    std::vector<float> gap;
    std::array<std::vector<float>, 3> direction;  ///< fixed body's axes; of directed ones
    std::vector<float> lever;
    std::vector<BorderElement> elements;
  };
  struct Levers;

  Batch& batchAt(const MinimaScene& scene, Side fixed_in, bool directed);
  /// False without memory.
  bool addDirected(const MinimaScene& scene, const BorderElement& element,
                   const TrianglePairDistance& closest, WorkLimit& limit);
  void look(const MinimaScene& scene, Batch& batch, double level);

  std::array<Eigen::Vector3d, 2> centres_;
  std::vector<Batch> batches_;
  std::uint32_t used_ = 0;  ///< batches
  struct Measured {
    BorderElement element;
    TrianglePairDistance closest;
  };
  std::vector<Measured> anew_;
  std::vector<BorderElement> crossed_;
  std::uint32_t measured_ = 0;
};

}  // namespace concave_distance::detail

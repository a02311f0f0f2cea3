#include "niche_basis.h"

namespace concave_distance {

std::unique_ptr<NicheBasis> NicheBasis::ofCores(const std::shared_ptr<const BodyMesh>& a,
                                                const std::shared_ptr<const BodyMesh>& b) {
  const RoundCore& of_a = a->core();
  const RoundCore& of_b = b->core();
  if (of_a.mesh == nullptr && of_b.mesh == nullptr) return nullptr;
  auto basis = std::make_unique<NicheBasis>(of_a.mesh != nullptr ? of_a.mesh : a,
                                            of_b.mesh != nullptr ? of_b.mesh : b);
  if (of_a.mesh != nullptr) basis->a_from_body = a->shape()->body_from_shape.inverse(Eigen::Isometry);
  if (of_b.mesh != nullptr) basis->body_from_b = b->shape()->body_from_shape;
  basis->margin_a = of_a.radius;
  basis->margin_b = of_b.radius;
  basis->thickness = of_a.thickness + of_b.thickness;
  return basis;
}

}  // namespace concave_distance

// Any bytes as a mesh file: they are read, or refused by an Error that names the file; what is read can be
// repaired and queried. In this process, though importMesh() has one of its own for it. The first byte
// chooses the format.
#include <array>

#include "concave_distance/base/error.h"
#include "concave_distance/interference/interference.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "distance/bound/certificate.h"
#include "fuzz/fuzz_input.h"
#include "mesh/import/import_worker/read_mesh.h"

namespace {

using namespace concave_distance;

constexpr std::size_t kMostTriangles = 60;
constexpr std::uint64_t kMostTrianglesRead = 1'000'000;

void query(const std::shared_ptr<const BodyMesh>& body) {
  CertificateWorkspace workspace;
  const DistanceCertificate found =
      certifyDistance(*body, *body, Eigen::Isometry3d(Eigen::Translation3d(2.0 * body->diameter(), 0, 0)),
                      nullptr, 0, CertificateRequest(), workspace);
  // Whatever the triangles do: regions end, and say where they are.
  InterferenceWorkspace interference;
  Interference regions;
  for (const double displacement : {0.0, 0.25}) {
    findInterference(*body, *body,
                     Eigen::Isometry3d(Eigen::Translation3d(displacement * body->diameter(), 0, 0)),
                     interference, regions);
    for (const InterferenceRegion& region : regions.regions) {
      if (!region.normal_in_a.allFinite() || !region.centroid_in_a.allFinite()) test::broken("region");
    }
  }
  // Two equal bodies twice their diameter apart: somewhere between one diameter and two.
  const double diameter = body->diameter();
  if (!(found.distance >= 0.99 * diameter && found.distance <= 2.01 * diameter)) test::broken("distance");
  if (!(found.lower_bound <= found.distance)) test::broken("lower_bound <= distance");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  constexpr std::array<const char*, 4> kFormats = {".stl", ".obj", ".ply", ".dae"};
  const std::string content = test::textOf(data + 1, size - 1);
  const std::string path = "fuzz";
  try {
    RepairedMesh repaired = repairMesh(detail::readMesh(content, path, kFormats[data[0] % kFormats.size()],
                                                        Eigen::Vector3d::Ones(), kMostTrianglesRead),
                                       {}, path);
    if (repaired.mesh.triangleCount() > kMostTriangles) return 0;
    BodyMeshOptions options;
    options.max_edge_length = 0.5 * repaired.mesh.diameter();
    query(std::make_shared<const BodyMesh>("fuzz", std::move(repaired.mesh), options));
  } catch (const Error& error) {
    if (error.where().empty() || error.remedy().empty()) test::broken("an Error says where and what to do");
  }
  return 0;
}

#include "benchmark/support/accuracy_pairs.h"

#include "benchmark/support/shapes.h"

namespace concave_distance::benchmark {
namespace {

BenchmarkPair makeRings() {
  const SurfaceMesh surface = makeBumpyRing(100000);
  BenchmarkPair pair;
  pair.name = "rings_100k";
  pair.a = std::make_shared<const BodyMesh>("a", surface, BodyMeshOptions());
  pair.b = std::make_shared<const BodyMesh>("b", surface, BodyMeshOptions());
  pair.fcl_a = pair.fcl_b = makeFclModel(surface);
  pair.motion = ringPassingBy;
  return pair;
}

}  // namespace

std::vector<std::string> accuracyPairs() {
  return {"notched_boxes",  "grooved_cylinder", "battery_insertion",
          "kr5_bicep_palm", "wam1_wam6",        "rings_100k"};
}

BenchmarkPair loadAccuracyPair(const std::string& name, std::optional<double> max_edge_length) {
  return name == "rings_100k" ? makeRings() : loadBenchmarkPair(name, max_edge_length);
}

}  // namespace concave_distance::benchmark

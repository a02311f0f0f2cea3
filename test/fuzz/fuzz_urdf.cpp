// Any text as a robot description: a scene, perhaps with problems, or an Error.
#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace concave_distance;
  try {
    SceneLoadOptions options;
    // The fuzzer looks for faults in the text, so bodies are made ready, which takes far longer, for few
    // inputs.
    options.geometry = size % 8 == 0 ? GeometrySource::Collision : GeometrySource::Visual;
    options.metric_memory_limit = 0;
    const Scene scene = loadRobotScene(test::textOf(data, size), "fuzz", options);
    for (const ScenePair& pair : allPairs(scene)) {
      if (pair.body_a >= scene.bodies.size() || pair.body_b >= scene.bodies.size())
        test::broken("pairs of bodies");
    }
  } catch (const Error& error) {
    if (error.remedy().empty()) test::broken("an Error says what to do");
  }
  return 0;
}

// Any text as a scene file: a scene, perhaps with problems, or an Error.
#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace concave_distance;
  try {
    SceneLoadOptions options;
    options.metric_memory_limit = 0;  // what is looked for is in the text
    options.descriptions["robot_description"] =
        "<robot name='r'><link name='a'><collision><geometry><box size='1 1 "
        "1'/></geometry></collision></link></robot>";
    const Scene scene = loadSceneText(test::textOf(data, size), "fuzz", test::fuzzFolder().path(), options);
    for (const ScenePair& pair : allPairs(scene)) {
      if (pair.body_a >= scene.bodies.size() || pair.body_b >= scene.bodies.size())
        test::broken("pairs of bodies");
      pair.settings.tracker.validate("fuzz");
    }
  } catch (const Error& error) {
    if (error.remedy().empty()) test::broken("an Error says what to do");
  }
  return 0;
}

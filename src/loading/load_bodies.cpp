#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "build_bodies.h"
#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "scene/body_pool.h"
#include "scene_parts.h"

namespace concave_distance {

std::vector<LoadedBody> loadBodies(const std::vector<BodyDescription>& descriptions,
                                   const std::string& base_folder, const PackageLocator& package_locator,
                                   const std::shared_ptr<BodyPool>& pool, const SceneLimits& limits) {
  std::vector<detail::BodySource> sources;
  for (const BodyDescription& description : descriptions) {
    sources.push_back(detail::sourceOf(description, base_folder));
  }
  std::vector<detail::BuiltBody> built = detail::buildBodies(
      std::move(sources), {package_locator,
                           {},
                           pool ? pool : std::make_shared<BodyPool>(kDefaultMetricMemoryLimit),
                           limits,
                           nullptr});
  std::vector<LoadedBody> loaded(built.size());
  for (std::size_t i = 0; i < built.size(); ++i) {
    loaded[i].body = std::move(built[i].body);
    if (loaded[i].body) continue;
    const std::string where = "body '" + descriptions[i].name + "'";
    std::string& problem = built[i].problem;
    if (problem.rfind(where + ": ", 0) == 0) problem.erase(0, where.size() + 2);  // `where` has it
    loaded[i].problem.emplace(where, problem, "it is not added");
  }
  return loaded;
}

SceneBody loadBody(const BodyDescription& description, const std::string& base_folder,
                   const PackageLocator& package_locator, const std::shared_ptr<BodyPool>& pool,
                   const SceneLimits& limits) {
  LoadedBody loaded =
      std::move(loadBodies({description}, base_folder, package_locator, pool, limits).front());
  if (loaded.problem) throw Error(*loaded.problem);
  return std::move(*loaded.body);
}

}  // namespace concave_distance

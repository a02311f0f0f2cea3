#pragma once

#include <exception>
#include <string>

#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "ros/topics/scene_store.h"

namespace concave_distance {

/// Runs a request; an exception becomes the response's message.
template <typename Response, typename Act>
bool respond(Response& response, Act&& act) {
  try {
    act();
    response.success = 1;
  } catch (const std::exception& problem) {
    response.success = 0;
    response.message = shortText(problem.what());
  }
  return true;
}

/// @throws Error while the scene is not loaded: it would replace what is edited now
inline void requireScene(SceneStore& keeper) {
  const std::string waiting = keeper.waitingFor();
  if (!waiting.empty()) throw Error("scene", "it is not loaded yet: " + waiting, "ask again later");
}

}  // namespace concave_distance

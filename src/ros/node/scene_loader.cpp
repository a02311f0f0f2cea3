#include "scene_loader.h"

#include <exception>
#include <utility>

#include "base/number_text.h"

namespace concave_distance {

SceneLoader::~SceneLoader() {
  if (thread_.joinable()) {
    progress_->stop = true;
    thread_.join();
  }
}

void SceneLoader::start(const NodeParameters& parameters, SceneRequest request) {
  progress_ = std::make_shared<LoadProgress>();
  outcome_ = Outcome();
  done_ = false;
  start_ = ros::WallTime::now();
  thread_ = std::thread([this, parameters, request = std::move(request)] {
    try {
      outcome_.scene = loadScene(parameters, request, *progress_);
    } catch (const Error& error) {
      outcome_.error = error;
    } catch (const std::exception& exception) {  // memory, for one
      outcome_.error =
          Error("scene", exception.what(), "free memory, or report this as an error of the package");
    }
    done_ = true;
  });
}

double SceneLoader::seconds() const {
  return (ros::WallTime::now() - start_).toSec();
}

std::string SceneLoader::progress() const {
  return "prepared " + std::to_string(progress_->prepared()) + " of " + std::to_string(progress_->bodies()) +
         " bodies, " + fixedText(seconds(), 1) + " s";
}

std::optional<SceneLoader::Outcome> SceneLoader::take() {
  if (!thread_.joinable() || !done_) {
    return std::nullopt;
  }
  thread_.join();
  return std::exchange(outcome_, Outcome());
}

}  // namespace concave_distance

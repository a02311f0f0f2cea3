#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <exception>
#include <memory>

#include "guard_server.h"

namespace concave_distance {

/// The guard inside a nodelet manager: beside the distance nodelet it gets the rows without a copy.
class VelocityGuardNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      server_ = std::make_unique<GuardServer>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& problem) {
      NODELET_FATAL_STREAM(problem.what());
    }
  }

  std::unique_ptr<GuardServer> server_;
};

}  // namespace concave_distance

PLUGINLIB_EXPORT_CLASS(concave_distance::VelocityGuardNodelet, nodelet::Nodelet)

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <exception>
#include <memory>

#include "concave_distance/base/error.h"
#include "distance_server.h"

namespace concave_distance {

/// The node inside a nodelet manager: subscribers in the same process get their messages without a copy.
class DistanceNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      server_ = std::make_unique<DistanceServer>(getMTNodeHandle(), getMTPrivateNodeHandle(), getName(),
                                                 [this](const Error& problem) {
                                                   // The manager holds other nodelets: this one goes on
                                                   // without a scene and says why.
                                                   NODELET_FATAL_STREAM(problem.what());
                                                 });
    } catch (const std::exception& problem) {
      NODELET_FATAL_STREAM(problem.what());
    }
  }

  std::unique_ptr<DistanceServer> server_;
};

}  // namespace concave_distance

PLUGINLIB_EXPORT_CLASS(concave_distance::DistanceNodelet, nodelet::Nodelet)

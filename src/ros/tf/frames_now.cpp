#include "frames_now.h"

#include <map>
#include <optional>
#include <utility>

#include "tf_poses.h"

namespace concave_distance {

detail::FramesNow framesNow(std::shared_ptr<const tf2::BufferCore> buffer,
                            const std::string& reference_frame) {
  using Known = std::map<std::pair<std::string, std::string>, std::optional<detail::FrameRelation>>;
  const auto known = std::make_shared<Known>();
  const auto relation = [buffer = std::move(buffer), known](const std::string& target,
                                                            const std::string& source) {
    const auto [place, is_new] = known->try_emplace({target, source});
    if (is_new) {
      const FrameTransform transform = lookUpFrame(*buffer, target, source, ros::Time(0));
      if (transform.status == TransformStatus::Ok) {
        place->second = {transform.target_from_source, transform.stamp.isZero()};
      }
    }
    return place->second;
  };
  return {reference_frame, relation};
}

}  // namespace concave_distance

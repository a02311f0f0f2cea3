#include "cloud_age.h"

#include <cmath>

#include "base/number_text.h"
#include "ros/seconds_text.h"
#include "ros/time_difference.h"

namespace concave_distance {

std::optional<FrameTransform> whyUnusable(const std::string& name, const CloudState& cloud, ros::Time now) {
  const CloudSettings& settings = *cloud.settings;
  FrameTransform place;
  if (!cloud.stamp) {
    place.message = "cloud '" + name + "': nothing has come on '" + settings.topic +
                    "' yet that could be used (diagnostics, clouds, says why)";
    return place;
  }
  ros::Time stamp;
  stamp.fromNSec(static_cast<std::uint64_t>(*cloud.stamp));
  const double age = secondsBetween(stamp, now);
  if (std::abs(age) <= settings.stale_after) return std::nullopt;
  TextStream message;
  message << "cloud '" << name << "' on '" << settings.topic << "' is " << secondsText(std::abs(age))
          << (age > 0.0 ? " s old" : " s ahead of the clock") << "; its stale_after is "
          << settings.stale_after << " s";
  place.status = TransformStatus::Stale;
  place.message = message.str();
  place.stamp = stamp;
  return place;
}

}  // namespace concave_distance

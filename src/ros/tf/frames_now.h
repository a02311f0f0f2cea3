#pragma once

#include <tf2/buffer_core.h>

#include <memory>
#include <string>

#include "scene/frames_now.h"

namespace concave_distance {

/// Returns what tf knows of frames: each pair of frames at its newest common time, asked once.
detail::FramesNow framesNow(std::shared_ptr<const tf2::BufferCore> buffer,
                            const std::string& reference_frame);

}  // namespace concave_distance

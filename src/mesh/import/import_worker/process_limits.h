#pragma once

#include <cstddef>

namespace concave_distance::detail {

/// Closes all descriptors above `last` that the parent left open by mistake.
void closeDescriptorsAbove(int last);

/// Limits this process permanently: address space, processor time, no core file, no written file, no opened
/// file, no new process. When memory is short, the system ends this process first.
void limitProcess(std::size_t memory, double seconds);

}  // namespace concave_distance::detail

#pragma once

#include <cstddef>

namespace concave_distance::detail {

/// Closes what the parent left open by mistake: sockets, files, everything above `last`.
void closeDescriptorsAbove(int last);

/// Limits this process for good: address space, processor time, no core file, nothing written to files, no
/// file opened, no process started. When the system is short of memory it ends this process first.
void limitProcess(std::size_t memory, double seconds);

}  // namespace concave_distance::detail

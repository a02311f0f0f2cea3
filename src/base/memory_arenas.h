#pragma once

namespace concave_distance {

/// Lets the allocator have one pool of memory for each core. glibc would have eight, and what requests of
/// every size leave behind in each is not given back. To be called before the first thread is started.
void limitMemoryArenas();

}  // namespace concave_distance

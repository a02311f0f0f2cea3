#include "helping_threads.h"

namespace concave_distance {

thread_local HelpingThreads* HelpingThreads::current_ = nullptr;

}  // namespace concave_distance

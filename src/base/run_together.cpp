#include "run_together.h"

#include <tbb/parallel_for.h>

#include <cstddef>
#include <exception>
#include <vector>

namespace concave_distance {

void runTogether(std::initializer_list<std::function<void()>> stages) {
  std::vector<std::exception_ptr> thrown(stages.size());
  tbb::parallel_for(std::size_t{0}, stages.size(), [&](std::size_t i) {
    try {
      stages.begin()[i]();
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

}  // namespace concave_distance

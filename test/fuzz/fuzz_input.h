#pragma once

#include <stdlib.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "support/temporary_folder.h"

namespace concave_distance::test {

/// What libFuzzer hands over, as text.
inline std::string textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// One folder for the whole run; files in it are written anew for each input.
inline const TemporaryFolder& fuzzFolder() {
  static const TemporaryFolder folder;
  return folder;
}

/// A broken promise: libFuzzer keeps the input and says where it is.
[[noreturn]] inline void broken(const char* promise) {
  std::fprintf(stderr, "broken promise: %s\n", promise);
  abort();
}

}  // namespace concave_distance::test

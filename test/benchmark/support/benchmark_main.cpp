#include "benchmark/support/benchmark_main.h"

#include <iostream>

#include "concave_distance/base/error.h"

int main(int argc, char** argv) {
  try {
    return concave_distance::benchmark::benchmarkMain(argc, argv);
  } catch (const concave_distance::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}

#pragma once

namespace concave_distance::benchmark {

/// What a benchmark program does; an Error that it throws is printed and ends the program with 1.
int benchmarkMain(int argc, char** argv);

}  // namespace concave_distance::benchmark

#pragma once

#include <atomic>
#include <cstddef>

/// Of the program since its start, counted by the operator new of count_allocations.cpp: link
/// concave_distance_count_allocations.
extern std::atomic<std::size_t> allocations;
extern std::atomic<std::size_t> allocated_bytes;  ///< at present
extern std::atomic<std::size_t> most_allocated_bytes;

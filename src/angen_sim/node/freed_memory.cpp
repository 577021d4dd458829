#include "node/freed_memory.h"

#include <malloc.h>

namespace angen::node {
namespace {

constexpr int kReturned = 128 << 10;    // bytes, malloc's own limits at the start
constexpr int kLargestKept = 32 << 20;  // bytes, the most that malloc takes
constexpr int kKeptInAll = 64 << 20;    // bytes

}  // namespace

void use_one_heap() { mallopt(M_ARENA_MAX, 1); }

// Once set, malloc does not raise the limits with freed blocks.
void keep_freed_memory(bool keep) {
  mallopt(M_MMAP_THRESHOLD, keep ? kLargestKept : kReturned);
  mallopt(M_TRIM_THRESHOLD, keep ? kKeptInAll : kReturned);
  if (!keep) malloc_trim(0);
}

}  // namespace angen::node

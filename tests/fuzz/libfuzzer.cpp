#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.h"

// libFuzzer's entry points; ANGEN_FUZZ_TARGET names the target.
namespace {

const angen::fuzz::Target& chosen() {
  const char* name = std::getenv("ANGEN_FUZZ_TARGET");
  for (const angen::fuzz::Target& target : angen::fuzz::targets()) {
    if (name != nullptr && target.name == name) return target;
  }
  std::fputs("ANGEN_FUZZ_TARGET names no target; there are:\n", stderr);
  for (const angen::fuzz::Target& target : angen::fuzz::targets()) {
    std::fprintf(stderr, "%s\n", target.name.c_str());
  }
  std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const angen::fuzz::Target& target = chosen();
  target.run({reinterpret_cast<const char*>(data), size});
  return 0;
}

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.h"

// libFuzzer's entry points; ANGEN_FUZZ_TARGET names the target.
namespace {

const angen::fuzz::Target& named() {
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

const angen::fuzz::Target& chosen() {
  static const angen::fuzz::Target& target = named();
  return target;
}

}  // namespace

/// Objects that a target loads once take no input's time.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  chosen().run("");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen().run({reinterpret_cast<const char*>(data), size});
  return 0;
}

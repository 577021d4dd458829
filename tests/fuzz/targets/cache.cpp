#include <cereal/types/map.hpp>
#include <cereal/types/string.hpp>

#include "assets/bounded_input.h"
#include "document/sources.h"
#include "fuzz/targets.h"
#include "sdf/pack.h"

namespace angen::fuzz {
namespace {

void sources(const std::string& bytes) {
  load::BoundedInput archive(bytes);
  load::Sources read;
  archive(read);
}

void packed_world(const std::string& bytes) {
  const desc::World read = load::unpack(bytes);
  const std::string packed = load::pack(read);
  require(load::pack(load::unpack(packed)) == packed, "a packed world unpacks the same");
}

}  // namespace

// The parts of a cache file whose hash is right.
void cache(const std::string& input) {
  const Split given = split(input);
  try {
    given.choice % 2 == 0 ? sources(given.rest) : packed_world(given.rest);
  } catch (const std::exception&) {
    return;  // the world's file is read then
  }
}

}  // namespace angen::fuzz

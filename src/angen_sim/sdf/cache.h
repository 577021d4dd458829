#pragma once

#include <optional>
#include <string>

#include "desc/world.h"
#include "document/sources.h"
#include "sdf/load.h"

namespace angen::load {

/// The described world of one file as an earlier load left it in $XDG_CACHE_HOME/angen, or in
/// ~/.cache/angen; none where ANGEN_NO_CACHE is set. A cache that
/// cannot be read is not an error: it has no world.
class Cache {
 public:
  /// The cache of the world file `world` if models are searched in `paths`.
  Cache(const std::string& world, const SearchPaths& paths);

  /// The world, if loading it again would give the same: the program and all files that were read
  /// are unchanged. A damaged file returns none.
  std::optional<desc::World> recall() const;

  /// Leaves a world that was read from `sources` for the next recall().
  void keep(const desc::World& world, const Sources& sources) const;

  /// The cache file; empty where there is no cache.
  const std::string& file() const { return file_; }

 private:
  std::string key_;  // the search paths of a load, and the program's version
  std::string file_;
};

}  // namespace angen::load

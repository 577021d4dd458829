#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace angen::load {

/// What one load has searched in the file system, and what it found there: enough to know later
/// whether it would find the same again.
class Sources {
 public:
  /// Whether anything stands at `path`.
  bool exists(const std::string& path);
  bool is_folder(const std::string& path);
  /// read_file().
  std::string read(const std::string& path);
  /// The contents of this file are about to be read by somebody else.
  void will_be_read(const std::string& path);

  /// Whether all of it is still so; reads every file again.
  bool unchanged() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(seen_);
  }

 private:
  enum class Kind : std::uint8_t { kNothing, kFolder, kOther, kRead };
  struct Seen {
    Kind kind = Kind::kNothing;
    std::uint64_t hash = 0;  // of the contents of one that was read
    template <class Archive>
    void serialize(Archive& archive) {
      archive(kind, hash);
    }
  };

  static Seen inspect(const std::string& path);
  Kind note(const std::string& path);

  std::map<std::string, Seen> seen_;  // by absolute path
};

}  // namespace angen::load

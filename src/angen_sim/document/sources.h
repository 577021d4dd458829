#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace angen::load {

/// The paths that one load searched and the files that it read: enough to decide later whether
/// another load would find the same.
class Sources {
 public:
  /// True if a file or folder exists at `path`.
  bool exists(const std::string& path);
  bool is_folder(const std::string& path);
  /// read_file().
  std::string read(const std::string& path);
  /// Notes that other code is about to read this file.
  void will_be_read(const std::string& path);

  /// True if nothing of it has changed; reads every file again.
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

#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"

/// Readers of bytes from outside, each as a function of one input. libFuzzer calls it with
/// inputs of its own (libfuzzer.cpp), the unit test with those of corpus/ (corpus_test.cpp).
namespace angen::fuzz {

/// A target returns whether it accepts or rejects its input. A crash, an exception that is not
/// Error, and a broken promise (see require) are findings.
struct Target {
  std::string name;  // also of its folder in corpus/
  void (*run)(const std::string& input);
};

void xml(const std::string& input);
void world(const std::string& input);
void urdf(const std::string& input);
void mesh(const std::string& input);
void png(const std::string& input);
void jpeg(const std::string& input);
void params(const std::string& input);
void command(const std::string& input);
void service(const std::string& input);
void sim(const std::string& input);
void replay(const std::string& input);

inline const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"xml", xml},         {"world", world}, {"urdf", urdf},     {"mesh", mesh},
      {"png", png},         {"jpeg", jpeg},   {"params", params}, {"command", command},
      {"service", service}, {"sim", sim},     {"replay", replay}};
  return all;
}

/// Ends the process where a promise of the code under test is broken.
void require(bool kept, const char* promise);

/// Calls `work`, for which a Rejection is an answer.
template <class Rejection = Error, class F>
void answered(F&& work) {
  try {
    work();
  } catch (const Rejection&) {
    return;
  }
}

/// A file in memory for readers that take a path; its content is replaced by each write.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& ending);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  void write(const std::string& bytes) const;
  const std::string& path() const { return path_; }

 private:
  std::string folder_;
  std::string path_;
};

/// The first byte of an input, which chooses among variants, and the rest.
struct Split {
  unsigned choice = 0;
  std::string rest;
};
Split split(const std::string& input);

}  // namespace angen::fuzz

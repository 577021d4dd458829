#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnostics.h"

/// The lines of a log: each is a JSON object that ends with a checksum of itself and of all lines
/// before it, so that a line that was damaged, lost or moved is found.
namespace angen::record {

/// A value of a line.
using LineValue = std::variant<bool, std::uint64_t, double, std::string, std::vector<double>,
                               std::vector<std::string>>;

class LineWriter {
 public:
  LineWriter();
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  LineWriter& add(const char* key, const LineValue& value);
  /// The line, with its end; `sum` is that of the line before, and becomes this one's.
  std::string done(std::uint64_t& sum);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A line of a log; each method throws Error with the line, and names the mistake in it.
class LineReader {
 public:
  /// `byte` is where the line begins in its file.
  LineReader(const std::string& line, const Source& at, std::uint64_t byte);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// Compares the checksum; `sum` is that of the line before, and becomes this one's.
  void check(std::uint64_t& sum) const;
  bool has(const char* key) const;
  /// T is one of the types of LineValue; a whole number is a double, too.
  template <class T>
  T get(const char* key) const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::record

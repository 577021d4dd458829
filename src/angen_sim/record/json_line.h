#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnostics.h"

/// The lines of a log: each is a JSON object that ends with a checksum of itself and of all lines
/// before it, so that a line that was damaged, lost or moved is found.
namespace angen::record {

class LineWriter {
 public:
  LineWriter();
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  LineWriter& text(const char* key, const std::string& value);
  LineWriter& flag(const char* key, bool value);
  LineWriter& whole(const char* key, std::uint64_t value);
  LineWriter& number(const char* key, double value);
  LineWriter& numbers(const char* key, const std::vector<double>& values);
  LineWriter& texts(const char* key, const std::vector<std::string>& values);

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
  std::string text(const char* key) const;
  bool flag(const char* key) const;
  std::uint64_t whole(const char* key) const;
  double number(const char* key) const;
  std::vector<double> numbers(const char* key) const;
  std::vector<std::string> texts(const char* key) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::record

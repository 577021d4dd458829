#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace angen {

/// A place in a user's file; line 0 means the whole file.
struct Source {
  std::string file;
  int line = 0;
  int element = 0;  // the number of an element of the file, from 1; 0 is not known
};

struct Diagnostic {
  enum class Severity { kWarning, kError };
  Severity severity = Severity::kError;
  Source source;
  std::string message;  // the error, and the correct form

  std::string text() const;  // "file:line: message", or only the message without a file
};

/// One or more errors in a user's input. what() has one line for each.
class Error : public std::runtime_error {
 public:
  explicit Error(std::string message);
  Error(Source source, std::string message);
  explicit Error(std::vector<Diagnostic> diagnostics);

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// "a, b, c" for "known names are …"; at most `limit`, then how many more.
std::string join_names(const std::vector<std::string>& names, std::size_t limit = 40);

}  // namespace angen

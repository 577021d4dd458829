#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/element.h"
#include "core/text.h"

namespace angen {

/// New values for parameters of a plug-in, as `angen save` writes them into its <plugin>.
class SavedParams {
 public:
  void number(const std::string& name, double value) { row(name, {value}); }
  void flag(const std::string& name, bool value) { add(name, value ? "true" : "false"); }
  /// One of any number of <name>, as Params::rows() reads them.
  void row(const std::string& name, const std::vector<double>& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : " ") + number_text(value);
    add(name, text);
  }
  void text(const std::string& name, std::string value) { add(name, std::move(value)); }
  /// No longer given, whatever the plug-in was loaded with.
  void unset(const std::string& name) { names_.insert(name); }

  bool operator==(const SavedParams& other) const {
    return names_ == other.names_ && values_ == other.values_;
  }

  /// Adds those of another device that shares the plug-in's element.
  void add(const SavedParams& other) {
    names_.insert(other.names_.begin(), other.names_.end());
    values_.insert(values_.end(), other.values_.begin(), other.values_.end());
  }

  /// Replaces the values of these names in the plug-in's element.
  void write_to(Element& plugin) const;

 private:
  void add(const std::string& name, std::string text) {
    names_.insert(name);
    values_.emplace_back(name, std::move(text));
  }

  std::set<std::string> names_;
  std::vector<std::pair<std::string, std::string>> values_;
};

}  // namespace angen

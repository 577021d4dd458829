#include "core/names.h"

#include "core/text.h"

namespace angen {

namespace {

bool is_reserved(const std::string& name) {
  return name == "world" || (name.size() >= 4 && name.compare(0, 2, "__") == 0 &&
                             name.compare(name.size() - 2, 2, "__") == 0);
}

// ASCII's, and the ones of ISO 8859-1 (U+0080 to U+009F), which are C2 80 to C2 9F in UTF-8.
bool holds_control_character(const std::string& name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto byte = static_cast<unsigned char>(name[i]);
    if (byte < 0x20 || byte == 0x7F) return true;
    if (byte == 0xC2 && i + 1 < name.size() && static_cast<unsigned char>(name[i + 1]) < 0xA0) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string label_problem(const std::string& label) {
  const std::string named = "the name '" + printable(label) + "' ";
  if (!valid_utf8(label)) return named + "is not UTF-8";
  if (label.size() > kMaxNameBytes) {
    return named + "has " + std::to_string(label.size()) + " bytes; give one of at most " +
           std::to_string(kMaxNameBytes);
  }
  if (holds_control_character(label)) return named + "contains a control character; leave it out";
  return "";
}

std::string name_problem(const std::string& name) {
  if (name.empty()) return "the name is empty; give one, such as kitchen_pir";
  const std::string named = "the name '" + printable(name) + "' ";
  if (std::string problem = label_problem(name); !problem.empty()) return problem;
  if (name.find("::") != std::string::npos) {
    return named + "contains '::', which joins the names of nested models; leave it out";
  }
  if (name.find('/') != std::string::npos) {
    return named + "contains '/', which separates the parts of a topic; leave it out";
  }
  if (name.front() == ' ' || name.back() == ' ') {
    return named + "begins or ends with a blank; leave it out";
  }
  if (is_reserved(name)) return named + "is reserved; choose another";
  return "";
}

void check_name(const std::string& name, const std::string& what, const Source& at) {
  const std::string problem = name_problem(name);
  if (!problem.empty()) throw Error(at, (what.empty() ? "" : what + ": ") + problem);
}

std::string local_name(const std::string& model, const std::string& name) {
  const std::string prefix = model + "::";
  return name.rfind(prefix, 0) == 0 ? name.substr(prefix.size()) : name;
}

}  // namespace angen

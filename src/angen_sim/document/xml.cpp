#include "document/xml.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/files.h"
#include "core/lists.h"
#include "core/nearest.h"
#include "core/text.h"
#include "core/typography.h"

namespace angen::load {

namespace {

// Counts the bytes from the start that are characters that XML 1.0 allows.
std::size_t allowed_prefix(const std::string& text) {
  std::size_t end = valid_utf8_prefix(text);
  for (const char* noncharacter : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {  // U+FFFE, U+FFFF
    end = std::min(end, text.find(noncharacter));
  }
  const auto bad = std::find_if(text.begin(), text.begin() + static_cast<long>(end), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
  });
  return static_cast<std::size_t>(bad - text.begin());
}

// The fix for a missing file: one whose name differs by a typing error.
std::string file_like(const std::filesystem::path& missing) {
  constexpr std::size_t kTypingError = 2;
  constexpr int kMaxFiles = 1000;
  const std::filesystem::path folder = missing.parent_path();
  std::error_code failed;
  std::filesystem::directory_iterator files(folder.empty() ? "." : folder, failed);
  std::vector<std::string> names;
  for (int k = 0; !failed && k < kMaxFiles && files != std::filesystem::end(files); ++k) {
    names.push_back(files->path().filename().string());
    files.increment(failed);
  }
  const std::string name = missing.filename().string();
  const std::vector<std::string> nearest = nearest_names(name, names, 1);
  const std::size_t errors = nearest.empty() || name.empty() ? 0 : edits(name, nearest[0]);
  const bool like = errors > 0 && errors <= kTypingError;
  return like ? "did you mean " + (folder / nearest[0]).string() + "?" : "give a file that exists";
}

// tinyxml2 makes any bytes of a reference such as &#xD800; or &#1;.
std::string checked(const char* text, const Source& at) {
  if (allowed_prefix(text) == std::char_traits<char>::length(text)) return text;
  throw Error(at, "a reference to a character that XML does not allow; leave it out");
}

// A declaration of the prefix of Angen's names, which programs that write XML may choose.
bool declares_own(const tinyxml2::XMLAttribute& a) {
  const std::string uri = a.Value();
  return std::string(a.Name()).rfind("xmlns:", 0) == 0 && (uri == "angen" || uri == "urn:angen");
}

// `prefix` is that of Angen's names around it.
Element convert(const tinyxml2::XMLElement& from, std::string prefix, const std::string& file,
                int& number) {
  for (auto* a = from.FirstAttribute(); a != nullptr; a = a->Next()) {
    if (declares_own(*a)) prefix = std::string(a->Name()).substr(6) + ":";
  }
  const auto own = [&](const std::string& name) {
    return name.rfind(prefix, 0) == 0 ? "angen:" + name.substr(prefix.size()) : name;
  };
  Element to;
  to.name = own(from.Name());
  to.source = {file, from.GetLineNum(), ++number};
  for (auto* a = from.FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string value = checked(a->Value(), to.source);
    const std::string name = declares_own(*a) ? "xmlns:angen" : own(a->Name());
    to.attributes.emplace_back(name, name == "name" ? value : plain_numbers(value));
  }
  std::string text;
  for (auto* node = from.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (auto* child = node->ToElement()) {
      to.children.push_back(convert(*child, prefix, file, number));
    } else if (auto* piece = node->ToText()) {
      text += checked(piece->Value(), to.source);
    }
  }
  to.text = to.name == "name" ? trimmed(text) : trimmed(plain_numbers(text));
  return to;
}

// tinyxml2's own message repeats the line; the meaning of its error is more useful.
std::string reason(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "the file is empty; it needs an <sdf> element";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "the element opened here is not closed; close each <x> with </x>";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "this is not well-formed XML: an attribute is malformed or given twice, or the file "
             "is "
             "cut off; write each attribute once, as name=\"value\"";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested more than 100 deep";
    default: {
      const std::string name = document.ErrorName();
      return "this is not well-formed XML (" + name.substr(name.find("XML_") == 0 ? 4 : 0) +
             "); is the file cut off?";
    }
  }
}

int line_at(const std::string& text, std::size_t offset) {
  return 1 +
         static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(offset), '\n'));
}

// The end of a comment, CDATA or declaration that begins at `at`; `at` otherwise.
std::size_t after_aside(const std::string& text, std::size_t at) {
  static const std::pair<const char*, const char*> asides[] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
  for (const auto& [begin, end] : asides) {
    if (text.compare(at, std::char_traits<char>::length(begin), begin) != 0) continue;
    const std::size_t found = text.find(end, at);
    return found == std::string::npos ? text.size() : found + 1;
  }
  return at;
}

// The end of the tag that begins before `at`; counts its attributes.
std::size_t after_tag(const std::string& text, std::size_t at, std::size_t& attributes) {
  char quote = '\0';
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      break;
    } else if (c == '=') {
      ++attributes;
    }
  }
  return at;
}

// A tag up to its '>', with each value in quotes.
void append_quoted(const std::string& tag, std::string& out) {
  for (std::size_t at = 0; at < tag.size();) {
    const char c = tag[at];
    out += c;
    ++at;
    if (c == '"' || c == '\'') {
      const std::size_t end = std::min(tag.find(c, at), tag.size() - 1) + 1;
      out.append(tag, at, end - at);
      at = std::max(at, end);
    } else if (c == '=' && at < tag.size() && std::isalnum(static_cast<unsigned char>(tag[at]))) {
      const std::size_t end = std::min(tag.find_first_of(" \t\r\n/", at), tag.size());
      out += '"' + tag.substr(at, end - at) + '"';
      at = end;
    }
  }
}

// Only a file can be longer than kMaxTextBytes: its elements are bounded with its bytes.
constexpr std::size_t kMaxElementsOfLong = 4 * kMaxElements;

// Before the parser: it takes memory for all nodes, and compares each attribute of an element with
// all others.
void check_counts(const std::string& text, const std::string& file) {
  std::size_t elements = 0, asides = 0, all_attributes = 0;
  const std::size_t most = text.size() > kMaxTextBytes ? kMaxElementsOfLong : kMaxElements;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    const std::size_t after = after_aside(text, at);
    std::size_t attributes = 0;
    const std::size_t begin = at;
    if (after > at) {
      ++asides;
      at = after;
    } else if (text.compare(at, 2, "</") != 0) {
      ++elements;
      at = after_tag(text, at + 1, attributes);
    } else {
      ++at;
    }
    all_attributes += attributes;
    if (attributes > kMaxAttributes) {
      throw Error({file, line_at(text, begin)}, "an element with more than " +
                                                    std::to_string(kMaxAttributes) +
                                                    " attributes; give it elements instead");
    }
    if (elements > most || asides > most || all_attributes > 2 * most) {
      throw Error({file, line_at(text, begin)}, "more than " + std::to_string(most) +
                                                    " elements or comments, or twice as many "
                                                    "attributes; split the file into models");
    }
  }
}

}  // namespace

std::string with_quotes(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t tag = text.find('<', at);
    const std::size_t after = tag == std::string::npos ? text.size() : after_aside(text, tag);
    out.append(text, at, (after > tag ? after : tag) - at);
    at = after;
    if (tag == std::string::npos || after > tag) continue;
    std::size_t attributes = 0;
    at = after_tag(text, tag + 1, attributes);
    append_quoted(text.substr(tag, at - tag), out);
  }
  return out;
}

std::string without_late_declaration(const std::string& text) {
  std::string out = text;
  bool first = true;
  for (std::size_t at = out.find('<'); at != std::string::npos; at = out.find('<', at)) {
    const std::size_t after = after_aside(out, at);
    if (after == at) break;
    if (!first && out.compare(at, 5, "<?xml") == 0) {
      const auto end = out.begin() + static_cast<std::ptrdiff_t>(std::min(after + 1, out.size()));
      std::replace_if(
          out.begin() + static_cast<std::ptrdiff_t>(at), end, [](char c) { return c != '\n'; },
          ' ');
    }
    first = false;
    at = after;
  }
  return out;
}

Element parse_xml(const std::string& text, const std::string& file) {
  if (text.size() > kMaxFileBytes)
    throw Error({file, 0}, "larger than 64 MB, the limit for a file");
  const std::size_t bad = allowed_prefix(text);
  if (bad < text.size()) {
    const bool is_utf8 = valid_utf8_prefix(text) > bad && text[bad] != '\0';
    throw Error({file, line_at(text, bad)},
                is_utf8 ? "a control character, which XML does not allow; leave it out"
                        : "a byte that is not UTF-8; save the file as UTF-8");
  }
  check_counts(text, file);
  tinyxml2::XMLDocument document;
  const std::string given = without_late_declaration(text);
  document.Parse(given.data(), given.size());
  if (document.ErrorID() == tinyxml2::XML_ERROR_PARSING_ATTRIBUTE) {
    const std::string quoted = with_quotes(given);
    if (quoted != given) document.Parse(quoted.data(), quoted.size());
  }
  if (document.Error()) {
    const std::string plain = straightened(given);  // curly quotes around values
    if (plain != given) document.Parse(plain.data(), plain.size());
  }
  if (document.Error()) {
    throw Error({file, std::max(1, document.ErrorLineNum())}, reason(document));
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  if (root == nullptr) throw Error({file, 1}, "no element in it; it needs an <sdf> element");
  if (root->NextSiblingElement() != nullptr) {
    throw Error({file, root->NextSiblingElement()->GetLineNum()},
                "a second root element; put all into one <sdf>");
  }
  int number = 0;
  return convert(*root, "angen:", file, number);
}

void check_text_size(const std::string& text) {
  if (text.size() <= kMaxTextBytes) return;
  throw Error("a text of " + std::to_string(text.size() >> 20U) +
              " MB; a text may have 4 MB: write it into a file, and give its path");
}

std::string read_file(const std::string& path) {
  std::error_code failed;
  if (std::filesystem::is_directory(path, failed)) {
    throw Error({path, 0}, "is a folder; give an SDF file");
  }
  if (std::filesystem::exists(path, failed) && !is_plain_file(path)) {
    throw Error({path, 0}, "is not a regular file; give an SDF file");
  }
  std::ifstream stream(path, std::ios::binary);
  const auto size = std::filesystem::file_size(path, failed);
  if (!stream || failed) throw Error({path, 0}, "cannot be read; " + file_like(path));
  if (size > kMaxFileBytes) throw Error({path, 0}, "larger than 64 MB, the limit for a file");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::size_t count_elements(const Element& element) {
  std::size_t count = 1;
  for (const Element& child : element.children) count += count_elements(child);
  return count;
}

void check_model_size(std::size_t elements, const Source& source) {
  if (elements <= kMaxModelElements) return;
  throw Error(source, "more than " + std::to_string(kMaxModelElements) +
                          " elements in one model; split it into several");
}

Element* find_child(Element& element, const std::string& name) {
  for (Element& child : element.children) {
    if (child.name == name) return &child;
  }
  return nullptr;
}

void set_child(Element& element, const std::string& name, const std::string& text) {
  Element* child = find_child(element, name);
  if (child == nullptr) {
    child = &*element.children.insert(element.children.begin(), {name, "", {}, {}, element.source});
  }
  child->text = text;
  child->attributes.clear();
}

void set_attribute(Element& element, const std::string& name, const std::string& value) {
  for (auto& [key, old] : element.attributes) {
    if (key == name) {
      old = value;
      return;
    }
  }
  element.attributes.emplace_back(name, value);
}

void remove_children(Element& element, const std::string& name) {
  auto& all = element.children;
  erase_if(all, [&](const Element& e) { return e.name == name; });
}

void set_source(Element& element, const Source& source) {
  element.source = source;
  for (Element& child : element.children) set_source(child, source);
}

std::string name_of(const Element& element) { return element.attribute_text("name"); }

std::string tag_of(const Element& element) {
  const std::string name = printable(name_of(element));
  return name.empty() ? "<" + element.name + ">" : "<" + element.name + " name=\"" + name + "\">";
}

}  // namespace angen::load

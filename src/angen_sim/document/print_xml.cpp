#include "document/xml.h"

namespace angen::load {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      // A line break inside a value must not shift the table of lines.
      case '\n':
        out += "&#10;";
        break;
      case '\r':
        out += "&#13;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

void print(const Element& element, int indent, std::string& out, std::vector<Source>* lines) {
  const std::string margin(static_cast<std::size_t>(indent) * 2, ' ');
  const auto end_line = [&] {
    out += '\n';
    if (lines != nullptr) lines->push_back(element.source);
  };
  out += margin + "<" + element.name;
  for (const auto& [key, value] : element.attributes) {
    out += " " + key + "=\"" + escaped(value) + "\"";
  }
  if (element.children.empty()) {
    out += element.text.empty() ? "/>" : ">" + escaped(element.text) + "</" + element.name + ">";
    end_line();
    return;
  }
  out += ">" + escaped(element.text);
  end_line();
  for (const Element& child : element.children) print(child, indent + 1, out, lines);
  out += margin + "</" + element.name + ">";
  end_line();
}

// Without margins: each element begins in its line of `file`.
void print_in_place(const Element& element, const std::string& file, int& line, std::string& out) {
  for (; element.source.file == file && line < element.source.line; ++line) out += '\n';
  out += "<" + element.name;
  for (const auto& [key, value] : element.attributes) {
    out += " " + key + "=\"" + escaped(value) + "\"";
  }
  out += ">" + escaped(element.text);
  for (const Element& child : element.children) print_in_place(child, file, line, out);
  out += "</" + element.name + ">";
}

}  // namespace

std::string print_xml(const Element& element, int indent, std::vector<Source>* lines) {
  std::string out;
  print(element, indent, out, lines);
  return out;
}

std::string print_xml_in_place(const Element& element) {
  std::string out;
  int line = 1;
  print_in_place(element, element.source.file, line, out);
  return out;
}

}  // namespace angen::load

#pragma once

#include <string>
#include <vector>

#include "core/element.h"

/// Text to Element trees with the line of each element, and back.
namespace angen::load {

constexpr std::size_t kMaxFileBytes = 64U << 20U;
constexpr std::size_t kMaxTextBytes = 4U << 20U;  // bytes of a text that a client sends
constexpr std::size_t kMaxElements = 100'000;
constexpr std::size_t kMaxModelElements = 10'000;
constexpr std::size_t kMaxAttributes = 100;  // attributes of one element

/// The root element of a document; `file` names it in messages. Throws Error for text that is
/// not well-formed, not UTF-8, or too large.
Element parse_xml(const std::string& text, const std::string& file);

/// Throws Error for a text of more than kMaxTextBytes.
void check_text_size(const std::string& text);

/// A whole file; throws Error when it cannot be read or is larger than kMaxFileBytes.
std::string read_file(const std::string& path);

/// One element a line, indented. `lines` gets the source of each printed line, from line 1.
std::string print_xml(const Element& element, int indent = 0, std::vector<Source>* lines = nullptr);

/// Each element in its own line, where that is known: messages about the text name the same lines.
std::string print_xml_in_place(const Element& element);

/// TinyXML, which Gazebo has, takes an XML declaration anywhere before the root: one after a
/// comment is blanked.
std::string without_late_declaration(const std::string& text);

/// TinyXML takes values without quotes, such as name=blade: each is put into quotes.
std::string with_quotes(const std::string& text);

std::size_t count_elements(const Element& element);
/// Throws Error at `source` for a model of more than kMaxModelElements.
void check_model_size(std::size_t elements, const Source& source);

Element* find_child(Element& element, const std::string& name);
/// Sets a child's text, adding the child in front when there is none.
void set_child(Element& element, const std::string& name, const std::string& text);
void set_attribute(Element& element, const std::string& name, const std::string& value);
void remove_children(Element& element, const std::string& name);
/// Sets that of the element and of all below it.
void set_source(Element& element, const Source& source);
/// The attribute `name`, or "".
std::string name_of(const Element& element);
/// `<link name="a">`, as it is called in messages.
std::string tag_of(const Element& element);

}  // namespace angen::load

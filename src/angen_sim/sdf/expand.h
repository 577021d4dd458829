#pragma once

#include <string>
#include <vector>

#include "core/element.h"
#include "document/session.h"

/// Documents as trees of SDF 1.9 with their includes written out, each element knowing its file.
namespace angen::load {

/// The <sdf> element of a text, upgraded to SDF 1.9 (URDF converted). `file` stands for it in
/// messages and, when it exists, is where relative addresses start.
Element read_document(const std::string& text, const std::string& file, Session& session);

/// What an <include> stands for: the included <model>, <actor> or <light> with the include's name,
/// pose, static and plug-ins, and with the includes inside it written out.
Element expand_include(const Element& include, Session& session);

/// Replaces typographic characters (a minus sign of a PDF) in texts and attributes that are numbers
/// otherwise, with a warning each; true where there were any.
bool replace_typographic_characters(Element& element, Session& session);

/// Whether an <include> in a <model> stands for the parts of the model and not for a nested one.
bool is_merge(const Element& include);

/// Replaces every <include> inside a <model> by the model it stands for, or by its parts where it
/// says merge="true".
void expand_model(Element& model, Session& session);

}  // namespace angen::load

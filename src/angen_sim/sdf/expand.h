#pragma once

#include "core/element.h"
#include "document/session.h"

/// Documents as trees of SDF 1.9 with their includes written out, each element knowing its file.
namespace angen::load {

/// The <sdf> element of a document, upgraded to SDF 1.9 (URDF converted). Relative addresses start
/// at its file, if that exists.
Element read_document(Element root, Session& session);

/// The <model>, <actor> or <light> that an <include> names, with the include's name,
/// pose, static and plug-ins, and with the includes inside it written out.
Element expand_include(const Element& include, Session& session);

/// True if an <include> in a <model> adds the parts of the model, not a nested model.
bool is_merge(const Element& include);

/// Replaces every <include> inside a <model> by the model that it names, or by that model's parts
/// if it has merge="true".
void expand_model(Element& model, Session& session);

}  // namespace angen::load

#pragma once

#include <optional>
#include <string>

#include "core/element.h"
#include "document/session.h"

/// Files of model:// and file:// addresses.
namespace angen::load {

/// The file or folder that `uri` names, absolute. `from` is the document that contains it: its
/// folder is searched last for file:// and for addresses without a scheme, and for model://NAME/…
/// where it is called NAME.
std::optional<std::string> find_uri(const std::string& uri, const std::string& from,
                                    Session& session);

/// The places that find_uri searched, for a message.
std::string searched_places(const std::string& uri, const std::string& from, Session& session);

/// find_uri, or an Error at `at` that says what `what` ("mesh", "model") is missing and where it
/// was searched, and the form of an address.
std::string need_uri(const std::string& uri, const std::string& what, const Source& at,
                     Session& session);

/// The SDF file of a model: of a folder, the one with the highest version in its model.config (at
/// most 1.9), or its model.sdf where it has no model.config; a file is itself.
std::string model_file(const std::string& path, const Source& at, Session& session);

/// The file that another one, such as a mesh, names: beside it, or where models have their
/// textures.
/// "" with a warning where there is none, or none that `at` may name.
std::string find_beside(const std::string& name, const std::string& what, const std::string& file,
                        const Source& at, Session& session);

/// Makes the addresses that only hold beside their document (relative ones) absolute, so that they
/// stay right in any file that the element is written to.
void make_uris_absolute(Element& element, Session& session);

/// An SDF version such as "1.6" as 106; -1 when it is none.
int version_number(const std::string& text);

}  // namespace angen::load

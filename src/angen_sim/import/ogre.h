#pragma once

#include <optional>
#include <string>

#include "document/session.h"

/// Ogre's material scripts, as far as they give a color and a picture.
namespace angen::load {

struct OgreMaterial {
  std::optional<Eigen::Vector4f> diffuse;
  std::string texture;  // name of the picture, "" for none
  std::string file;     // that defines it
};

/// The material called `name` in the script that `uri` names, or in one of that folder.
std::optional<OgreMaterial> ogre_material(const Element& uri, const std::string& name,
                                          Session& session);
/// The material called `name` in a script's text.
std::optional<OgreMaterial> ogre_material(const std::string& text, const std::string& name);

/// The picture's file: in a folder that the <script> names, or beside its material; "" with a
/// warning where there is none.
std::string ogre_texture(const Element& script, const OgreMaterial& material, Session& session);

}  // namespace angen::load

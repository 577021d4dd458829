#include "sdf/surface.h"

#include <algorithm>

#include "assets/mesh.h"
#include "core/text.h"
#include "document/search.h"

namespace angen::load {

namespace {

std::shared_ptr<const Texture> texture_in(const std::string& path, const Source& at,
                                          Session& session) {
  try {
    std::shared_ptr<const Texture> texture = read_texture(path);
    if (session.counted_files.insert(path).second) {
      session.bytes += static_cast<double>(texture->bytes.size());
    }
    return texture;
  } catch (const Error& error) {
    session.warn(at, error.diagnostics().front().message + "; its material's color is shown");
    return nullptr;
  }
}

double area_of(const TriangleMesh& mesh, std::size_t first, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    const auto& t = mesh.triangles[i];
    const Eigen::Vector3f& a = mesh.vertices[t[0]];
    sum += static_cast<double>((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm());
  }
  return sum;
}

// The mean of all parts, weighted by their areas.
Eigen::Vector3f mean_color(const TriangleMesh& mesh, const desc::Material& material) {
  const std::vector<MeshPart>& parts = material.look->parts;
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t end = i + 1 < parts.size() ? parts[i + 1].first : mesh.triangles.size();
    const double share = area_of(mesh, parts[i].first, end);
    const Eigen::Vector3f color = material.textures[i] ? material.textures[i]->mean()
                                                       : Eigen::Vector3f(parts[i].color.head<3>());
    sum += share * color.cast<double>();
    area += share;
  }
  return area > 0.0 ? Eigen::Vector3f((sum / area).cast<float>())
                    : Eigen::Vector3f(material.diffuse.head<3>());
}

}  // namespace

void paint(const PlacedShape& mesh, const Source& at, Session& session, desc::Material& material) {
  if (!mesh.look || mesh.look->parts.empty() || !mesh.shape.mesh) return;
  material.look = mesh.look;
  bool any = false;
  for (const MeshPart& part : mesh.look->parts) {
    material.textures.emplace_back();
    if (part.texture.empty()) continue;
    const std::string path = find_beside(part.texture, "texture", mesh.file, at, session);
    if (path.empty()) continue;
    material.textures.back() = texture_in(path, at, session);
    any = any || material.textures.back();
  }
  if (any) material.diffuse.head<3>() = mean_color(*mesh.shape.mesh, material);
}

bool paint_by_script(const Reader& reader, Session& session, desc::Material& material) {
  reader.note({"uri"});
  const Element& script = reader.element();
  const Element* name = reader.child("name");
  for (const Element& uri : script.children) {
    if (uri.name != "uri" || uri.text.empty() || name == nullptr) continue;
    const auto file = find_uri(uri.text, uri.source.file, session);
    if (!file) continue;  // Gazebo's own, as a rule
    const auto found = gazebo_dialect(script).ogre_material(*file, uri, script, session);
    if (!found) continue;
    if (found->diffuse) material.diffuse = *found->diffuse;
    if (found->texture.empty()) return true;
    if (auto texture = texture_in(found->texture, name->source, session)) {
      material.diffuse.head<3>() = texture->mean();
      material.textures = {std::move(texture)};
    }
    return true;
  }
  return false;
}

}  // namespace angen::load

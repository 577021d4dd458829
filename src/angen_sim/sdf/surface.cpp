#include <algorithm>
#include <map>

#include "assets/mesh.h"
#include "document/search.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

// Diffuse colors by the names that Gazebo's own material script defines.
const std::map<std::string, Eigen::Vector4f>& scripts() {
  using Color = Eigen::Vector4f;
  static const std::map<std::string, Color> table = {
      {"Gazebo/Black", {0.0F, 0.0F, 0.0F, 1.0F}},
      {"Gazebo/FlatBlack", {0.1F, 0.1F, 0.1F, 1.0F}},
      {"Gazebo/DarkGrey", {0.18F, 0.18F, 0.18F, 1.0F}},
      {"Gazebo/DarkGray", {0.18F, 0.18F, 0.18F, 1.0F}},
      {"Gazebo/Grey", {0.7F, 0.7F, 0.7F, 1.0F}},
      {"Gazebo/Gray", {0.7F, 0.7F, 0.7F, 1.0F}},
      {"Gazebo/LightGrey", {0.85F, 0.85F, 0.85F, 1.0F}},
      {"Gazebo/White", {1.0F, 1.0F, 1.0F, 1.0F}},
      {"Gazebo/Residential", {0.95F, 0.93F, 0.88F, 1.0F}},
      {"Gazebo/Red", {1.0F, 0.0F, 0.0F, 1.0F}},
      {"Gazebo/RedBright", {0.87F, 0.26F, 0.07F, 1.0F}},
      {"Gazebo/RedTransparent", {1.0F, 0.0F, 0.0F, 0.5F}},
      {"Gazebo/Green", {0.0F, 1.0F, 0.0F, 1.0F}},
      {"Gazebo/GreenTransparent", {0.0F, 1.0F, 0.0F, 0.5F}},
      {"Gazebo/DarkGreen", {0.0F, 0.35F, 0.0F, 1.0F}},
      {"Gazebo/Blue", {0.0F, 0.0F, 1.0F, 1.0F}},
      {"Gazebo/BlueTransparent", {0.0F, 0.0F, 1.0F, 0.5F}},
      {"Gazebo/BlueLaser", {0.0F, 0.0F, 1.0F, 0.4F}},
      {"Gazebo/SkyBlue", {0.13F, 0.44F, 0.70F, 1.0F}},
      {"Gazebo/Yellow", {1.0F, 1.0F, 0.0F, 1.0F}},
      {"Gazebo/YellowTransparent", {1.0F, 1.0F, 0.0F, 0.5F}},
      {"Gazebo/DarkYellow", {0.7F, 0.7F, 0.0F, 1.0F}},
      {"Gazebo/Purple", {1.0F, 0.0F, 1.0F, 1.0F}},
      {"Gazebo/DarkMagenta", {0.5F, 0.0F, 0.5F, 1.0F}},
      {"Gazebo/Turquoise", {0.0F, 1.0F, 1.0F, 1.0F}},
      {"Gazebo/Orange", {1.0F, 0.51F, 0.06F, 1.0F}},
      {"Gazebo/DarkOrange", {0.67F, 0.32F, 0.0F, 1.0F}},
      {"Gazebo/OrangeTransparent", {1.0F, 0.44F, 0.0F, 0.4F}},
      {"Gazebo/Indigo", {0.33F, 0.0F, 0.5F, 1.0F}},
      {"Gazebo/Brown", {0.45F, 0.28F, 0.15F, 1.0F}},
      {"Gazebo/Gold", {0.8F, 0.65F, 0.2F, 1.0F}},
      {"Gazebo/Chrome", {0.75F, 0.75F, 0.78F, 1.0F}},
      {"Gazebo/Aluminum", {0.78F, 0.79F, 0.8F, 1.0F}},
      {"Gazebo/Wood", {0.65F, 0.46F, 0.28F, 1.0F}},
      {"Gazebo/WoodFloor", {0.60F, 0.42F, 0.25F, 1.0F}},
      {"Gazebo/WoodPallet", {0.70F, 0.55F, 0.36F, 1.0F}},
      {"Gazebo/WoodTile", {0.58F, 0.40F, 0.24F, 1.0F}},
      {"Gazebo/CeilingTiled", {0.9F, 0.9F, 0.88F, 1.0F}},
      {"Gazebo/PaintedWall", {0.85F, 0.82F, 0.74F, 1.0F}},
      {"Gazebo/Bricks", {0.55F, 0.27F, 0.2F, 1.0F}},
      {"Gazebo/Road", {0.3F, 0.3F, 0.3F, 1.0F}},
      {"Gazebo/Pedestrian", {0.6F, 0.6F, 0.58F, 1.0F}},
      {"Gazebo/Grass", {0.25F, 0.45F, 0.18F, 1.0F}},
      {"Gazebo/Carpet", {0.5F, 0.42F, 0.42F, 1.0F}},
      {"Gazebo/Glass", {0.8F, 0.9F, 0.95F, 0.3F}},
  };
  return table;
}

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

/// The texture that an Ogre material script gives a <script>'s name; false if it has no such
/// material.
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

}  // namespace

desc::Material material_of(const Reader& visual, Session& session) {
  desc::Material material;
  const Reader given = visual.block("material");
  const std::optional<Eigen::Vector4f> diffuse = given.color("diffuse");
  const std::optional<Eigen::Vector4f> ambient = given.color("ambient");
  given.unused().color("specular");
  const Reader script = given.block("script");
  const Element* name = script.child("name");
  const bool scripted = script && paint_by_script(script, session, material);
  if (!material.textures.empty()) {
    // SDF's colors would only shade it.
  } else if (diffuse || ambient) {
    material.diffuse = diffuse ? *diffuse : *ambient;
  } else if (name != nullptr && !scripted) {
    const auto found = scripts().find(name->text);
    if (found != scripts().end()) {
      material.diffuse = found->second;
    } else {
      session.warn(name->source, "unknown material '" + name->text +
                                     "', shown gray; give <diffuse> or a name such as "
                                     "Gazebo/White, Gazebo/Wood");
    }
  }
  if (const auto emissive = given.color("emissive")) material.emissive = *emissive;
  const double transparency = visual.number("transparency", 0.0, Range::not_negative());
  material.diffuse.w() *= static_cast<float>(1.0 - std::min(1.0, transparency));
  return material;
}

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

}  // namespace angen::load

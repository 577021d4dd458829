#include <array>
#include <memory>
#include <utility>

#include "assets/ies.h"
#include "document/search.h"
#include "document/xml.h"
#include "sdf/describe.h"
#include "sdf/reader.h"

namespace angen::load {

namespace {

using Type = desc::Light::Type;

/// The color of a black body, r g b, the largest 1: B. Kim et al., Design of advanced color
/// temperature control system for HDTV applications, J. Korean Phys. Soc. 41 (2002).
Eigen::Vector3f black_body_color(double kelvin) {
  const double t = 1e3 / kelvin;
  const double x = kelvin < 4000.0 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                   : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  const double y =
      kelvin < 2222.0   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
      : kelvin < 4000.0 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                        : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  const Vec3 xyz(x / y, 1.0, (1.0 - x - y) / y);
  Eigen::Matrix3d to_rgb;  // IEC 61966-2-1
  to_rgb << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  const Vec3 rgb = (to_rgb * xyz).cwiseMax(0.0);
  return (rgb / rgb.maxCoeff()).cast<float>();
}

void read_color(const Reader& element, desc::Light& light) {
  if (const auto diffuse = element.color("diffuse")) light.diffuse = diffuse->head<3>();
  const Element* temperature = element.child("angen:color_temperature");
  if (temperature == nullptr) return;
  const double kelvin = element.number("angen:color_temperature", 0.0, Range::positive());
  if (!(kelvin >= 1667.0 && kelvin <= 25000.0)) {
    throw Error(temperature->source, "<angen:color_temperature> is not from 1667 to 25000 K");
  }
  light.diffuse = black_body_color(kelvin);
}

/// Angen's own: SDF knows no lights with an area.
void read_area(const Reader& element, desc::Light& light) {
  constexpr std::array<std::pair<const char*, std::size_t>, 4> kAreas{
      {{"angen:rectangle", 2}, {"angen:disc", 1}, {"angen:tube", 2}, {"angen:sphere", 1}}};
  const Element* first = nullptr;
  for (const auto& [name, count] : kAreas) {
    const Element* area = element.child(name);
    if (area == nullptr) continue;
    if (first != nullptr) {
      throw Error(area->source, "this light has a <" + first->name + "> too; give one of them");
    }
    first = area;
    const std::vector<double> v = element.numbers(name, count, Range::positive(limits::kLength));
    light.radius = v.back();
    if (area->name == "angen:sphere") continue;
    light.type = count == 1 ? Type::kDisc : Type::kTube;
    light.length = count == 1 ? 0.0 : v[0];
    if (area->name != "angen:rectangle") continue;
    light.type = Type::kRectangle;
    light.width = v[0];
    light.height = v[1];
    light.length = light.radius = 0.0;
  }
}

/// The intensity by direction.
void read_distribution(const Reader& element, desc::Light& light, Session& session) {
  if (const Reader spot = element.block("spot")) {
    const Range angle = Range::not_negative(limits::kAngle);
    light.inner_angle = spot.number("inner_angle", 0.0, angle);
    light.outer_angle = spot.number("outer_angle", 0.0, angle);
    spot.unused().number("falloff", Range::not_negative());
  }
  const bool plain = light.type == Type::kPoint || light.type == Type::kSpot;
  const Element* half = element.child("angen:half_angle");
  const Element* ies = element.child("angen:ies");
  for (const Element* given : {half, ies}) {
    if (given == nullptr || plain) continue;
    throw Error(given->source, "<" + given->name + "> is for lights of type point and spot");
  }
  if (half != nullptr) {
    light.type = Type::kSpot;
    light.half_angle = element.number("angen:half_angle", 0.0, Range::positive(limits::kAngle));
    if (light.half_angle < 0.01 || light.half_angle > 1.55) {
      throw Error(half->source, "<angen:half_angle> is not from 0.01 to 1.55 rad");
    }
  }
  if (ies == nullptr) return;
  const Element& uri = Reader(*ies, session).need("uri");
  const std::string file = need_uri(uri.text, "IES file", uri.source, session);
  light.photometry = std::make_shared<const Photometry>(photometry_of(read_file(file), file));
}

}  // namespace

desc::Light light_of(const Element& element, const Pose& pose, Session& session) {
  desc::Light light;
  light.name = name_of(element);
  light.pose = pose;
  light.source = element.source;
  const Reader reader(element, session);
  const std::string* type = reader.attribute("type");
  if (type != nullptr && *type == "spot") light.type = Type::kSpot;
  if (type != nullptr && *type == "directional") light.type = Type::kDirectional;
  read_color(reader, light);
  light.intensity =
      reader.number("intensity", light.intensity, Range::not_negative(limits::kIntensity));
  light.cast_shadows = reader.flag("cast_shadows", light.cast_shadows);
  light.level = reader.number("angen:level", Range::not_negative({"%", 100.0, 0.0}));
  reader.unused().color("specular");
  const Reader attenuation = reader.block("attenuation");
  light.range = attenuation.number("range", light.range, Range::positive());
  for (const char* factor : {"constant", "linear", "quadratic"}) {
    attenuation.unused().number(factor, Range::not_negative());
  }
  if (const Element* direction = reader.child("direction")) {
    const Vec3 given = reader.direction("direction", {});
    if (given.norm() < 1e-9) {
      throw Error(direction->source, "the <direction> of this light has length 0; give 0 0 -1");
    }
    light.direction = given.normalized();
  }
  read_area(reader, light);
  read_distribution(reader, light, session);
  return light;
}

}  // namespace angen::load

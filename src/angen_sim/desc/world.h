#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/anatomy.h"
#include "core/element.h"
#include "core/photometry.h"
#include "core/pose.h"
#include "core/shape.h"
#include "core/time.h"
#include "desc/home.h"

/// Plain values that describe a world as its files say it, before anything moves. SI units and
/// radians.
namespace angen {

struct MeshLook;
struct Texture;

}  // namespace angen

namespace angen::desc {

struct Material {
  Eigen::Vector4f diffuse{0.7F, 0.7F, 0.7F, 1.0F};  // r g b a, 0..1; r g b also serve as albedo
  Eigen::Vector4f emissive{0.0F, 0.0F, 0.0F, 1.0F};
  std::shared_ptr<const MeshLook> look;  // look of the mesh's file, if SDF has none
  // One for each part of the look, or null; without a look one for all, if there is any.
  std::vector<std::shared_ptr<const Texture>> textures;
};

struct Friction {
  double mu = 1.0;
  double mu2 = 1.0;
  Vec3 direction1 = Vec3::Zero();  // in the collision's frame; zero = chosen by the engine
  double slip1 = 0.0;
  double slip2 = 0.0;
};

struct Collision {
  std::string name;
  Pose pose;  // in the link's frame
  Shape shape;
  Friction friction;
  double restitution = 0.0;
  std::optional<double> stiffness;  // N/m
  std::optional<double> damping;    // N s/m
  std::optional<double> min_depth;  // m, by which it may sink in before contacts push it out
  Source source;
};

struct Visual {
  std::string name;
  Pose pose;  // in the link's frame
  Shape shape;
  Material material;
  std::optional<double> temperature;  // K, of its surface; that of the air if not given
};

struct Inertial {
  double mass = 1.0;                                     // kg
  Pose pose;                                             // center of mass in the link's frame
  Eigen::Matrix3d moment = Eigen::Matrix3d::Identity();  // kg m^2 about the center, in pose's axes
};

struct Light {
  enum class Type { kPoint, kSpot, kDirectional, kRectangle, kDisc, kTube };
  std::string name;
  Type type = Type::kPoint;
  Pose pose;                                  // in the link's frame, or the world's
  Eigen::Vector3f diffuse{1.0F, 1.0F, 1.0F};  // chromaticity
  double intensity = 1.0;                     // factor on its nominal flux
  double range = 10.0;                        // m, SDF's attenuation range
  Vec3 direction = -Vec3::UnitZ();            // in its own frame, all but point
  double inner_angle = 0.0;                   // rad, spot
  double outer_angle = 0.0;
  double width = 0.0;       // m, rectangle: along its own x axis (y, where it shines along x)
  double height = 0.0;      // m, rectangle: across
  double length = 0.0;      // m, tube: along its own x axis (y, where it shines along x)
  double radius = 0.0;      // m, disc, tube, and the sphere of a point or spot; 0 = default
  double half_angle = 0.0;  // rad, spot: angle to half the axial intensity; 0 = use the cones
  std::shared_ptr<const Photometry> photometry;  // a point's or spot's; null for none
  bool cast_shadows = true;
  std::optional<double> level;  // percent at the start, of a lamp without a plug-in
  Source source;
};

/// Whether they shine alike under one name, wherever they are described.
inline bool operator==(const Light& a, const Light& b) {
  const auto numbers = [](const Light& light) {
    return std::tie(light.name, light.type, light.intensity, light.range, light.inner_angle,
                    light.outer_angle, light.width, light.height, light.length, light.radius,
                    light.half_angle, light.photometry, light.cast_shadows);
  };
  return numbers(a) == numbers(b) && a.pose == b.pose && a.diffuse == b.diffuse &&
         a.direction == b.direction;
}

struct Sensor {
  std::string name;
  std::string type;          // SDF's: ray, camera, contact, …
  Pose pose;                 // in the link's frame
  double update_rate = 0.0;  // Hz; 0 = the plug-in's default
  bool visualize = false;
  std::string plugin;  // file name of its library, e.g. libpir_controller.so
  Element plugin_element;
  Element element;  // the whole <sensor>
  Source source;
};

struct Link {
  std::string name;
  Pose pose;  // in the model's frame
  Inertial inertial;
  bool gravity = true;
  bool kinematic = false;
  Anatomy anatomy;                   // declared by a plug-in when the model is made
  std::optional<bool> self_collide;  // if it differs from its model's
  std::vector<Collision> collisions;
  std::vector<Visual> visuals;
  std::vector<Sensor> sensors;
  std::vector<Light> lights;
  Source source;
};

/// URDF's <safety_controller>: limits of the joint's drive, tighter near its soft limits.
struct JointSafety {
  double soft_lower = -1e16;  // rad or m
  double soft_upper = 1e16;
  double k_position = 0.0;  // 1/s, bound of the speed per distance to a soft limit; 0 = none
  double k_velocity = 0.0;  // N m s/rad or N s/m, bound of the effort per speed left; 0 = none
};

struct JointAxis {
  Vec3 xyz = Vec3::UnitZ();  // unit, in the model's frame at position 0
  double lower = -1e16;      // rad or m
  double upper = 1e16;
  double effort = -1.0;           // N m or N, negative = no limit
  double velocity = -1.0;         // rad/s or m/s, negative = no limit
  double damping = 0.0;           // N m s/rad or N s/m
  double friction = 0.0;          // N m or N
  double spring_stiffness = 0.0;  // N m/rad or N/m
  double spring_reference = 0.0;  // rad or m, where the spring is slack
  double initial_position = 0.0;
  std::optional<JointSafety> safety;
};

struct Joint {
  enum class Type { kFixed, kRevolute, kPrismatic, kBall, kUniversal, kScrew };
  static constexpr const char* kTypes[] = {"fixed", "revolute",  "prismatic",
                                           "ball",  "universal", "screw"};  // names in SDF
  std::string name;
  Type type = Type::kFixed;
  std::string parent;           // link name, or "world"
  std::string child;            // link name
  Vec3 anchor = Vec3::Zero();   // in the model's frame
  std::vector<JointAxis> axes;  // 0, 1 or 2
  double lead = 0.0;            // m/rad along the axis of a screw; positive: right-handed
  double longest_step = 0.0;    // s, of the plug-in that leads it, as that declares
  Source source;

  const char* type_name() const { return kTypes[static_cast<std::size_t>(type)]; }
};

struct Plugin {
  std::string name;
  std::string filename;
  Element element;
  Source source;
  bool is_repeatable = false;  // a model may have several of this library, each of its own name
};

/// What holds for a model that was not written for Angen. A world's holds for each of its models,
/// also for spawned ones.
struct Customs {
  bool sets_aside = false;        // a wrong plug-in or parameter is left out, with a warning
  bool first_holds = false;       // the first of two equal parameters holds, without an error
  bool lights_are_lamps = false;  // each light without a plug-in is a lamp
  bool keeps_frames = false;      // the frames of its sensors are those in its text
  double parting_speed = std::numeric_limits<double>::infinity();  // m/s, out of other shapes
};

struct Model {
  std::string name;
  Pose pose;    // in the world
  Pose placed;  // in the model: the frame that the <pose> of its text places
  bool is_static = false;
  bool allow_auto_disable = true;
  bool self_collide = false;
  Customs customs;
  bool is_actor = false;  // an <actor>: its own pose is where its trajectory's coordinates begin
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Plugin> plugins;
  HomeParts home;            // in the model's frame
  std::string xml;           // its text (an <include>, <model> or <actor>), for `save`
  std::string expanded_xml;  // if xml has includes: the same, with them expanded
  std::vector<Diagnostic>
      warnings;  // warnings of a model that was loaded alone; else the world has them
  std::vector<Diagnostic> ignored;  // like the warnings
  Source source;
};

struct Physics {
  Nanoseconds step = 1'000'000;   // ns
  double real_time_factor = 1.0;  // 0 = as fast as possible
  int iterations = 50;
  double erp = 0.2;
  double cfm = 0.0;
  double contact_max_correcting_vel = 1.0;  // m/s; at SDF's 100, deeply overlapping bodies fly away
  double contact_surface_layer = 0.001;     // m
};

struct Scene {
  Eigen::Vector4f ambient{0.4F, 0.4F, 0.4F, 1.0F};
  Eigen::Vector4f background{0.7F, 0.7F, 0.7F, 1.0F};
  bool shadows = true;
};

struct World {
  std::string name = "default";
  Vec3 gravity{0.0, 0.0, -9.81};  // m/s^2
  Physics physics;
  Scene scene;
  double ambient_temperature = 295.15;  // K, of the air and of surfaces without a temperature
  Customs customs;
  std::vector<Light> lights;
  std::vector<Model> models;
  std::vector<Plugin> plugins;
  HomeParts home;
  HomeSite site;
  std::vector<Diagnostic> warnings;
  std::vector<Diagnostic> ignored;  // elements and attributes that nothing reads
  std::string xml;                  // the world's own text without models, for `save`
};

}  // namespace angen::desc

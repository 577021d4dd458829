#include <map>
#include <set>
#include <vector>

#include "core/nearest.h"
#include "core/text.h"
#include "sdf/reader.h"

namespace angen::load {

namespace {

// The children that SDF 1.9 has for an element of a name, wherever it is: of those elements whose
// contents Angen or its plug-ins use.
constexpr const char* kChildren = R"(
actor: animation joint link plugin pose script skin
angular_velocity: x y z
attenuation: constant linear quadratic range
axis2: dynamics limit xyz
axis: dynamics limit xyz
blend: fade_dist min_height
bounce: restitution_coefficient threshold
box: size
camera: box_type clip depth_camera distortion horizontal_fov image lens noise pose save
  segmentation_type visibility_mask
capsule: length radius
clip: far near
collision: geometry laser_retro max_contacts pose surface
constraints: cfm contact_max_correcting_vel contact_surface_layer erp split_impulse
  split_impulse_penetration_threshold
contact: bullet category_bitmask collide_bitmask collide_without_contact
  collide_without_contact_bitmask collision dissipation dynamic_friction elastic_modulus ode
  override_impact_capture_velocity override_stiction_transition_velocity plastic_coef_restitution
  plastic_impact_velocity poissons_ratio static_friction stiffness topic viscous_friction
cylinder: length radius
distortion: center k1 k2 k3 p1 p2
dynamics: damping friction spring_reference spring_stiffness
ellipsoid: radii
frame: pose
friction: bullet ode torsional
geometry: box capsule cylinder ellipsoid empty heightmap image mesh plane polyline sphere
gps: position_sensing velocity_sensing
heightmap: blend pos sampling size texture uri use_terrain_paging
horizontal: max_angle min_angle noise resolution samples
image: format granularity height scale threshold uri width
imu: angular_velocity enable_orientation linear_acceleration orientation_reference_frame
inertia: ixx ixy ixz iyy iyz izz
inertial: auto_inertia_params density fluid_added_mass inertia mass pose
joint: angle axis axis2 child gearbox_ratio gearbox_reference_body parent physics pose sensor
  thread_pitch
lidar: noise range scan
light: attenuation cast_shadows diffuse direction intensity pose specular spot
limit: cfm dissipation effort erp lower stiffness upper velocity
linear_acceleration: x y z
link: acceleration audio_sink audio_source battery collision enable_wind gravity inertial
  kinematic light must_be_base_link particle_emitter pose projector self_collide sensor velocity
  velocity_decay visual wrench
logical_camera: aspect_ratio far horizontal_fov near
magnetometer: x y z
material: ambient diffuse double_sided emissive lighting pbr render_order script shader specular
mesh: scale submesh uri
model: allow_auto_disable enable_wind frame gripper include joint link model plugin pose scale
  self_collide static
navsat: position_sensing velocity_sensing
noise: bias_mean bias_stddev dynamic_bias_correlation_time dynamic_bias_stddev mean precision
  stddev type
ode: bounce cfm cfm_damping constraints erp fdir1 fudge_factor implicit_spring_damper kd kp limit
  max_force max_vel min_depth mu mu2 slip slip1 slip2 soft_cfm soft_erp solver suspension velocity
orientation_reference_frame: custom_rpy grav_dir_x localization
physics: bullet dart max_contacts max_step_size ode provide_feedback real_time_factor
  real_time_update_rate simbody
plane: normal size
polyline: height point
position_sensing: horizontal vertical
range: max min resolution
ray: noise range scan
scan: horizontal vertical
scene: ambient background fog grid origin_visual shadows sky
script: auto_start delay_start loop name trajectory uri
sensor: air_pressure altimeter always_on camera contact enable_metrics force_torque gps imu lidar
  logical_camera magnetometer navsat plugin pose ray rfid rfidtag sonar topic transceiver
  update_rate visualize
solver: friction_model island_threads iters min_step_size precon_iters solver_type sor
  thread_position_correction type use_dynamic_moi_rescaling
sphere: radius
spherical_coordinates: elevation heading_deg latitude_deg longitude_deg surface_model
  world_frame_orientation
spot: falloff inner_angle outer_angle
state: deletions insertions iterations joint light model real_time sim_time wall_time
submesh: center name
surface: bounce contact friction soft_contact
texture: diffuse normal size
trajectory: waypoint
velocity_sensing: horizontal vertical
vertical: max_angle min_angle noise resolution samples
visual: cast_shadows geometry laser_retro material meta plugin pose transparency visibility_flags
waypoint: pose time
wind: linear_velocity
world: actor atmosphere audio frame gravity gui include light magnetic_field model physics plugin
  population road scene spherical_coordinates state wind
x: noise
y: noise
z: noise
)";

using Names = std::set<std::string>;

std::map<std::string, Names> read_children() {
  std::map<std::string, Names> children;
  Names* names = nullptr;
  for (const std::string& word : words_in(kChildren)) {
    if (word.back() == ':') {
      names = &children[word.substr(0, word.size() - 1)];
    } else {
      names->insert(word);
    }
  }
  return children;
}

// Null if SDF has the child, or if Angen uses nothing of the parent.
const Names* without(const std::string& child, const std::string& parent) {
  static const std::map<std::string, Names> children = read_children();
  const auto found = children.find(parent);
  return found == children.end() || found->second.count(child) != 0 ? nullptr : &found->second;
}

std::size_t most_edits(const std::string& name) { return name.size() < 5 ? 1 : 2; }

}  // namespace

std::string meant_element(const std::string& name, const std::string& parent) {
  const Names* known = without(name, parent);
  if (known == nullptr) return "";
  const std::vector<std::string> nearest = nearest_names(name, {known->begin(), known->end()}, 1);
  return !nearest.empty() && edits(name, nearest.front()) <= most_edits(name) ? nearest.front()
                                                                              : "";
}

std::string unknown_element(const std::string& name, const std::string& parent) {
  const bool of_others = name.find(':') != std::string::npos;
  if (of_others || without(name, parent) == nullptr) return "";
  const std::string meant = meant_element(name, parent);
  return "<" + name + "> in <" + parent + "> is not known; " +
         (meant.empty() ? "leave it out" : "did you mean <" + meant + ">?");
}

}  // namespace angen::load

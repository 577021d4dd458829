#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

// A text has no folder: a trusted caller may name files that are in none of the paths.
SearchPaths anywhere() {
  SearchPaths paths;
  paths.allow_any = true;
  return paths;
}

std::vector<ModelState> states_of(const desc::World& world) {
  std::vector<ModelState> states;
  for (const desc::Model& model : world.models) {
    ModelState state{&model, model.pose, {}, {}};
    for (const desc::Joint& joint : model.joints) {
      std::vector<double> positions;
      for (const desc::JointAxis& axis : joint.axes) positions.push_back(axis.initial_position);
      state.joint_positions.emplace_back(joint.name, positions);
    }
    states.push_back(state);
  }
  return states;
}

void expect_same(const Element& a, const Element& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.text, b.text);
  EXPECT_EQ(a.attributes, b.attributes);
  ASSERT_EQ(a.children.size(), b.children.size());
  for (std::size_t i = 0; i < a.children.size(); ++i) expect_same(a.children[i], b.children[i]);
}

void expect_same(const Shape& a, const Shape& b) {
  EXPECT_EQ(a.type, b.type);
  expect_near(a.size, b.size);
  EXPECT_DOUBLE_EQ(a.radius, b.radius);
  EXPECT_DOUBLE_EQ(a.length, b.length);
  EXPECT_EQ(a.mesh_file, b.mesh_file);
}

void expect_same(const desc::Link& a, const desc::Link& b) {
  EXPECT_EQ(a.name, b.name);
  expect_near(a.pose, b.pose);
  EXPECT_DOUBLE_EQ(a.inertial.mass, b.inertial.mass);
  ASSERT_EQ(a.collisions.size(), b.collisions.size());
  for (std::size_t i = 0; i < a.collisions.size(); ++i) {
    EXPECT_EQ(a.collisions[i].name, b.collisions[i].name);
    expect_near(a.collisions[i].pose, b.collisions[i].pose);
    expect_same(a.collisions[i].shape, b.collisions[i].shape);
    EXPECT_DOUBLE_EQ(a.collisions[i].friction.mu, b.collisions[i].friction.mu);
  }
  ASSERT_EQ(a.visuals.size(), b.visuals.size());
  for (std::size_t i = 0; i < a.visuals.size(); ++i) {
    expect_same(a.visuals[i].shape, b.visuals[i].shape);
    EXPECT_EQ(a.visuals[i].material.diffuse, b.visuals[i].material.diffuse);
  }
  ASSERT_EQ(a.sensors.size(), b.sensors.size());
  for (std::size_t i = 0; i < a.sensors.size(); ++i) {
    EXPECT_EQ(a.sensors[i].name, b.sensors[i].name);
    expect_near(a.sensors[i].pose, b.sensors[i].pose);
    EXPECT_EQ(a.sensors[i].plugin, b.sensors[i].plugin);
    expect_same(a.sensors[i].plugin_element, b.sensors[i].plugin_element);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
}

void expect_same(const desc::Model& a, const desc::Model& b) {
  EXPECT_EQ(a.name, b.name);
  expect_near(a.pose, b.pose);
  EXPECT_EQ(a.is_static, b.is_static);
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t i = 0; i < a.links.size(); ++i) expect_same(a.links[i], b.links[i]);
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    EXPECT_EQ(a.joints[i].type, b.joints[i].type);
    EXPECT_EQ(a.joints[i].parent, b.joints[i].parent);
    expect_near(a.joints[i].anchor, b.joints[i].anchor);
    ASSERT_EQ(a.joints[i].axes.size(), b.joints[i].axes.size());
    for (std::size_t k = 0; k < a.joints[i].axes.size(); ++k) {
      expect_near(a.joints[i].axes[k].xyz, b.joints[i].axes[k].xyz);
      EXPECT_DOUBLE_EQ(a.joints[i].axes[k].initial_position, b.joints[i].axes[k].initial_position);
    }
  }
  ASSERT_EQ(a.plugins.size(), b.plugins.size());
  for (std::size_t i = 0; i < a.plugins.size(); ++i) {
    EXPECT_EQ(a.plugins[i].filename, b.plugins[i].filename);
    expect_same(a.plugins[i].element, b.plugins[i].element);
  }
}

void expect_same(const desc::World& a, const desc::World& b) {
  EXPECT_EQ(a.name, b.name);
  expect_near(a.gravity, b.gravity);
  EXPECT_EQ(a.physics.step, b.physics.step);
  EXPECT_EQ(a.scene.ambient, b.scene.ambient);
  EXPECT_EQ(a.lights.size(), b.lights.size());
  EXPECT_EQ(a.plugins.size(), b.plugins.size());
  ASSERT_EQ(a.models.size(), b.models.size());
  for (std::size_t i = 0; i < a.models.size(); ++i) expect_same(a.models[i], b.models[i]);
}

const char* const kSavedDoor =
    "<model name='d'><link name='a'/><link name='b'><pose>0 0 0 0 0 0.5</pose></link>"
    "<joint name='hinge' type='revolute'><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>"
    "<limit><lower>-1.57</lower><upper>0.001</upper></limit></axis></joint></model>";

TEST(Save, RoundTripKeepsTheWorld) {
  const Folder folder;
  folder.model("door", sdf(kSavedDoor, "1.4"));
  folder.model("sun", sdf("<light name='sun' type='directional'/>"));
  const std::string text = in_world(
      "<physics type='ode'><max_step_size>0.002</max_step_size></physics><gravity>0 0 -5</gravity>"
      "<include><uri>model://sun</uri></include><light name='own' type='point'/>"
      "<plugin name='p' filename='libp.so'><k>a &lt; b</k></plugin>" +
          std::string(kSavedDoor) +
          "<include><uri>model://door</uri><name>d2</name><pose>1 2 3 0.1 0.2 0.3</pose></include>"
          "<actor name='person'><script><trajectory id='0' type='walk'><waypoint><time>0</time>"
          "<pose>1 0 0 0 0 0</pose></waypoint></trajectory></script></actor>",
      "1.5");
  const desc::World first = read(text, folder.paths());
  const desc::World second = read(save(first, states_of(first)), folder.paths());
  expect_same(first, second);
  EXPECT_EQ(save(first, states_of(first)), save(second, states_of(second)));
}

TEST(Save, KeepsWhereThingsAreNow) {
  const desc::World first = read(in_world(kSavedDoor));
  std::vector<ModelState> states = states_of(first);
  states[0].pose = {{4.0, 5.0, 6.0}, from_rpy(0.1, -0.2, 3.0)};
  states[0].joint_positions = {{"hinge", {-0.75}}};
  const desc::World second = read(save(first, states));
  expect_near(second.models[0].pose, states[0].pose);
  EXPECT_DOUBLE_EQ(second.models[0].joints[0].axes[0].initial_position, -0.75);
}

TEST(Save, JointPressedIntoItsStopIsSavedAtIt) {
  const desc::World first = read(in_world(kSavedDoor));
  std::vector<ModelState> states = states_of(first);
  states[0].joint_positions = {{"hinge", {0.02}}};
  const desc::World second = read(save(first, states));
  EXPECT_DOUBLE_EQ(second.models[0].joints[0].axes[0].initial_position, 0.001);
}

TEST(Save, DeletedAndSpawnedModels) {
  const Folder folder;
  const std::string file = folder.write("x/door.sdf", sdf(kSavedDoor, "1.4"));
  const desc::World first = read(in_world("<model name='m'><link name='l'/></model>"));
  const Pose pose{{0.0, 0.0, 8.0}, Quat::Identity()};
  const desc::Model by_path = model(file, "by_path", pose, {});
  const desc::Model by_text = model(sdf(kSavedDoor, "1.4"), "by_text", pose, {});
  const desc::World second =
      read(save(first, {{&by_path, pose, {}, {}}, {&by_text, pose, {}, {}}}), anywhere());
  ASSERT_EQ(second.models.size(), 2U);
  expect_same(second.models[0], by_path);
  expect_same(second.models[1], by_text);
}

TEST(Save, UrdfBecomesSdf) {
  const desc::World first = read(in_world(""));
  const desc::Model robot = model(
      "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' "
      "ixy='0' ixz='0' iyz='0'/></inertial></link><link name='b'><inertial><mass value='2'/>"
      "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
      "<joint name='j' type='continuous'><parent link='a'/><child link='b'/>"
      "<origin xyz='0 0 1' rpy='0 0 1'/><axis xyz='1 0 0'/></joint></robot>",
      "bot", {}, {});
  const desc::World second = read(save(first, {{&robot, {}, {}, {}}}));
  ASSERT_EQ(second.models.size(), 1U);
  expect_same(second.models[0], robot);
}

TEST(Save, AttachedSensorsStay) {
  const Folder folder;
  folder.model("inner", sdf("<model name='i'><link name='l'/></model>"));
  folder.model("part", sdf("<model name='m'><link name='l'>" + box() +
                           "</link><include><uri>model://inner</uri></include></model>"));
  const desc::World first =
      read(in_world("<include><uri>model://part</uri><name>n</name></include>"), folder.paths());
  std::vector<ModelState> states = states_of(first);
  const Pose pose{{0.0, 1.0, 2.0}, from_rpy(0.0, 0.5, 0.0)};
  const desc::Sensor pir = sensor(
      "<sensor name='s' type='ray'><plugin name='p' filename='libpir_controller.so'/></sensor>",
      "p1", pose);
  states[0].attached = {{"l", pir}, {"i::l", pir}};
  const desc::World second = read(save(first, states), folder.paths());
  ASSERT_EQ(second.models[0].links.size(), 2U);
  for (const desc::Link& link : second.models[0].links) {
    ASSERT_EQ(link.sensors.size(), 1U);
    EXPECT_EQ(link.sensors[0].name, "p1");
    expect_near(link.sensors[0].pose, pose);
    EXPECT_EQ(link.sensors[0].plugin, "libpir_controller.so");
  }
}

TEST(Save, RelativeFilesStayFoundElsewhere) {
  const Folder folder;
  folder.write("meshes/s.stl",
               "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
               "endloop\nendfacet\nendsolid s\n");
  const std::string file =
      folder.write("a.world", in_link("<visual name='v'><geometry><mesh><uri>file://meshes/s.stl"
                                      "</uri></mesh></geometry></visual>"));
  const desc::World first = world(file);
  const desc::World second = read(save(first, states_of(first)), anywhere());
  expect_same(first, second);
}

}  // namespace
}  // namespace angen::load

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

/// A broken world, the line of its error, and a part of that.
struct Broken {
  const char* name;
  std::string text;
  int line;
  const char* says;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

const std::string kModel = "<model name='m'><link name='l'/></model>";
const std::string kNothing = "<collision name='c'><geometry><empty/></geometry></collision>";

std::string in_collision(const std::string& geometry) {
  return in_link("<collision name='c'><geometry>" + geometry + "</geometry></collision>");
}
std::string in_joint(const std::string& type, const std::string& inside) {
  return in_model(two_links() + "\n<joint name='j' type='" + type + "'>" + inside + "</joint>");
}
const std::string kEnds = "<parent>a</parent><child>b</child>";

const Broken kBroken[] = {
    {"empty", "", 1, "empty"},
    {"not_sdf", "<html>\n</html>", 1, "it must begin with <sdf>"},
    {"no_version", "<sdf>\n</sdf>", 1, "no version"},
    {"old_version", "<sdf version='1.1'/>", 1, "versions 1.0 and 1.2 to 1.9"},
    {"future_version", "<sdf version='1.99'/>", 1, "versions 1.0 and 1.2 to 1.9"},
    {"no_world", sdf("\n"), 1, "no <world>"},
    {"two_worlds", sdf("\n<world name='a'/>\n<world name='b'/>"), 3, "second <world>"},
    {"truncated", "<sdf version='1.6'>\n<world name='w'>\n<model name='m'>\n<link na", 4,
     "cut off"},
    {"unclosed", sdf("\n<world name='w'>\n<model name='m'>\n</world>"), 3, "not closed"},
    {"two_roots", "<sdf version='1.6'/>\n<sdf version='1.6'/>", 2, "second root"},
    {"double_attribute", sdf("\n<world name='a' name='b'/>"), 2, "given twice"},
    {"not_utf8", sdf("\n<world name='\xff'/>"), 2, "UTF-8"},
    {"nameless_world", sdf("\n<world/>"), 2, "no name"},
    {"twin_models", in_world("\n" + kModel + "\n" + kModel), 3,
     "a model named 'm' exists already, at line 2"},
    {"twin_links", in_model("\n<link name='l'/>\n<link name='l'/>"), 3,
     "the name 'l' is given twice"},
    {"link_and_joint",
     in_model("\n<link name='l'/><link name='k'/>\n<joint name='l' type='fixed'><parent>l</parent>"
              "<child>k</child></joint>"),
     3, "the name 'l' is given twice"},
    {"twin_collisions", in_link("\n" + kNothing + "\n" + kNothing), 3,
     "the name 'c' is given twice"},
    {"no_links", in_world("\n<model name='m'/>"), 2, "no <link>"},
    {"reserved_name", in_world("\n<model name='__m__'><link name='l'/></model>"), 2, "reserved"},
    {"colons_in_name", in_model("\n<link name='a::b'/>"), 2, "'::'"},
    {"bad_pose", in_link("\n<pose>0 0 x 0 0 0</pose>"), 2, "'x', which is not a number"},
    {"short_pose", in_link("\n<pose>0 0 0 0</pose>"), 2, "contains 4 numbers; give 6"},
    {"infinite_pose", in_link("\n<pose>inf 0 0 0 0 0</pose>"), 2, "not finite"},
    {"bad_step", in_world("<physics type='ode'>\n<max_step_size>fast</max_step_size></physics>"), 2,
     "'fast', which is not a number"},
    {"zero_step", in_world("<physics type='ode'>\n<max_step_size>0</max_step_size></physics>"), 2,
     "greater than 0"},
    {"bad_flag", in_model("\n<static>maybe</static><link name='l'/>"), 2, "give true or false"},
    {"negative_box", in_collision("<box>\n<size>1 -1 1</size></box>"), 2,
     "<size> is -1; it must be greater than 0"},
    {"no_size", in_collision("\n<box/>"), 2, "<box> has no <size>"},
    {"unknown_shape",
     in_link("<visual name='c'><geometry>\n<ellipsoid><radii>1 1 1</radii></ellipsoid></geometry>"
             "</visual>"),
     2, "unknown shape <ellipsoid>; known shapes are box"},
    {"no_geometry", in_link("\n<visual name='c'/>"), 2, "no <geometry>"},
    {"no_mass", in_link("<inertial>\n<mass>0</mass></inertial>"), 2, "the mass is 0 kg"},
    {"impossible_inertia",
     in_link("<inertial><mass>1</mass>\n<inertia><ixx>1</ixx><iyy>1</iyy><izz>9</izz></inertia>"
             "</inertial>"),
     2, "must not exceed the sum"},
    {"unknown_link", in_joint("fixed", "<parent>a</parent>\n<child>c</child>"), 3,
     "unknown link 'c'; known are a, b, j"},
    {"unknown_joint_type", in_joint("spiral", kEnds), 2,
     "unknown joint type 'spiral'; known are ball, continuous, fixed"},
    {"joined_to_itself", in_joint("fixed", "<parent>a</parent><child>a</child>"), 2,
     "joins 'a' to itself"},
    {"zero_prismatic_axis", in_joint("prismatic", kEnds + "\n<axis><xyz>0 0 0</xyz></axis>"), 3,
     "has length 0"},
    {"limits_swapped",
     in_joint("revolute", kEnds + "<axis><xyz>0 0 1</xyz>\n<limit><lower>1</lower><upper>-1"
                                  "</upper></limit></axis>"),
     3, "lower exceeds upper"},
    {"pose_relative_to_nothing",
     in_model("\n<link name='a'><pose relative_to='zz'>0 0 0 0 0 0</pose></link>", "1.7"), 2, "zz"},
    {"plugin_without_file", in_world("\n<plugin name='p'/>"), 2, "no filename"},
    {"sensor_without_type", in_link("\n<sensor name='s'/>"), 2, "no type"},
    {"light_without_type", in_world("\n<light name='l'/>"), 2, "<light name=\"l\"> has no type"},
    {"physics_without_type", in_world("\n<physics/>"), 2, "<physics> has no type"},
    {"misspelled_where_plugins_read",
     in_link("<sensor name='s' type='imu'><imu><angular_velocity>\n<x><nois/></x>"
             "</angular_velocity></imu></sensor>"),
     2, "did you mean <noise>?"},
    {"unknown_light", in_world("\n<light name='l' type='laser'/>"), 2,
     "unknown light type 'laser'"},
    {"light_of_no_color",
     in_world("<light name='l' type='point'>\n<diffuse>x 1 1</diffuse></light>"), 2,
     "<diffuse> contains 'x', which is not a number"},
    {"include_without_uri", in_world("\n<include/>"), 2, "no <uri>"},
    {"unknown_scheme", in_world("<include>\n<uri>http://x/y</uri></include>"), 2,
     "unknown uri 'http://x/y'"},
    {"missing_model", in_world("<include>\n<uri>model://nowhere</uri></include>"), 2,
     "model 'model://nowhere' is not found; searched: "},
    {"missing_mesh",
     in_link("<visual name='v'><geometry><mesh>\n<uri>model://m/meshes/x.dae</uri></mesh>"
             "</geometry></visual>"),
     2, "mesh 'model://m/meshes/x.dae' is not found; searched: "},
    {"state_of_nobody", in_world(kModel + "<state>\n<model name='n'/></state>"), 2,
     "unknown model 'n'; known are m"},
    {"state_of_no_joint",
     in_world(kModel + "<state><model name='m'>\n<joint name='j'><angle axis='0'>1</angle></joint>"
                       "</model></state>"),
     2, "unknown joint 'j' of model 'm'"},
    {"colder_than_cold",
     in_link("<visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry><plugin "
             "name='p' filename='gz-sim-thermal-system'>\n<temperature>-3</temperature></plugin>"
             "</visual>"),
     2, "<temperature> is -3 K; it must be greater than 0"},
    {"a_cold_world",
     in_world("<atmosphere type='adiabatic'>\n<temperature>0</temperature></atmosphere>"), 2,
     "it must be greater than 0"},
    {"waypoints_back_in_time",
     in_world("<actor name='a'><script><trajectory id='0' type='walk'><waypoint><time>2</time>"
              "<pose>0 0 0 0 0 0</pose></waypoint>\n<waypoint><time>1</time><pose>0 0 0 0 0 0"
              "</pose></waypoint></trajectory></script></actor>"),
     2, "is not after the one before"},
};

class BrokenWorld : public testing::TestWithParam<Broken> {};

TEST_P(BrokenWorld, IsAnErrorWithItsPlace) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::string message = error_of(GetParam().text);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(message.find("w.world:" + std::to_string(GetParam().line) + ": "), 0U) << message;
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(All, BrokenWorld, testing::ValuesIn(kBroken),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(BrokenName, IsRejectedWhereverItStands) {
  const Folder folder;
  folder.model("part", sdf("<model name='p'><link name='l'/></model>"));
  const std::string include = "<include><uri>model://part</uri>";
  for (const std::string& text :
       {in_world("<model name='a/b'><link name='l'/></model>"), in_model("<link name='a/b'/>"),
        in_link("<sensor name='a/b' type='ray'/>"), in_link("<visual name=' v'/>"),
        in_world("<light name='a/b' type='point'/>"), in_world("<actor name='a/b'/>"),
        in_world(include + "<name>a/b</name></include>"),
        in_model("<link name='l'/>" + include + "<name>a/b</name></include>"),
        in_world(include + "<name>" + std::string(256, 'n') + "</name></include>")}) {
    const std::string message = error_of(text, folder.paths());
    EXPECT_EQ(message.find("w.world:1: "), 0U) << message;
    EXPECT_NE(message.find(": the name '"), std::string::npos) << message;
  }
}

TEST(BrokenMesh, DamagedFileIsNamedWhereItIsUsed) {
  const Folder folder;
  folder.write("part/x.stl", "solid nothing");
  const std::string message =
      error_of(in_link("<visual name='v'><geometry><mesh>\n<uri>model://part/x.stl</uri></mesh>"
                       "</geometry></visual>"),
               folder.paths());
  EXPECT_EQ(message.find("w.world:2: mesh "), 0U) << message;
}

}  // namespace
}  // namespace angen::load

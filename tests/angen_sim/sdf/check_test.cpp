#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

/// A broken world and its expected error; the place is part of the text.
struct Broken {
  const char* name;
  const char* text;
  const char* place;
  const char* says;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

const Broken kBroken[] = {
    {"empty", "", "w.world:1: ", "empty"},
    {"not_sdf", "<html>\n</html>", "w.world:1: ", "it must begin with <sdf>"},
    {"no_version", "<sdf>\n</sdf>", "w.world:1: ", "no version"},
    {"old_version", "<sdf version='1.1'/>", "w.world:1: ", "versions 1.0 and 1.2 to 1.9"},
    {"future_version", "<sdf version='1.99'/>", "w.world:1: ", "versions 1.0 and 1.2 to 1.9"},
    {"no_world", "<sdf version='1.6'>\n</sdf>", "w.world:1: ", "no <world>"},
    {"two_worlds", "<sdf version='1.6'>\n<world name='a'/>\n<world name='b'/></sdf>",
     "w.world:3: ", "second <world>"},
    {"truncated", "<sdf version='1.6'>\n<world name='w'>\n<model name='m'>\n<link na",
     "w.world:4: ", "cut off"},
    {"unclosed", "<sdf version='1.6'>\n<world name='w'>\n<model name='m'>\n</world></sdf>",
     "w.world:3: ", "not closed"},
    {"two_roots", "<sdf version='1.6'/>\n<sdf version='1.6'/>", "w.world:2: ", "second root"},
    {"double_attribute", "<sdf version='1.6'>\n<world name='a' name='b'/></sdf>",
     "w.world:2: ", "given twice"},
    {"not_utf8", "<sdf version='1.6'>\n<world name='\xff'/></sdf>", "w.world:2: ", "UTF-8"},
    {"nameless_world", "<sdf version='1.6'>\n<world/></sdf>", "w.world:2: ", "no name"},
    {"twin_models",
     "<sdf version='1.6'><world name='w'>\n<model name='m'><link name='l'/></model>\n"
     "<model name='m'><link name='l'/></model></world></sdf>",
     "w.world:3: ", "a model named 'm' exists already, at line 2"},
    {"twin_links",
     "<sdf version='1.6'><world name='w'><model name='m'>\n<link name='l'/>\n<link name='l'/>"
     "</model></world></sdf>",
     "w.world:3: ", "the name 'l' is given twice"},
    {"link_and_joint",
     "<sdf version='1.6'><world name='w'><model name='m'>\n<link name='l'/><link name='k'/>\n"
     "<joint name='l' "
     "type='fixed'><parent>l</parent><child>k</child></joint></model></world></sdf>",
     "w.world:3: ", "the name 'l' is given twice"},
    {"twin_collisions",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n"
     "<collision name='c'><geometry><empty/></geometry></collision>\n"
     "<collision name='c'><geometry><empty/></geometry></collision></link></model></world></sdf>",
     "w.world:3: ", "the name 'c' is given twice"},
    {"no_links", "<sdf version='1.6'><world name='w'>\n<model name='m'/></world></sdf>",
     "w.world:2: ", "no <link>"},
    {"reserved_name",
     "<sdf version='1.6'><world name='w'>\n<model name='__m__'><link name='l'/></model>"
     "</world></sdf>",
     "w.world:2: ", "reserved"},
    {"colons_in_name",
     "<sdf version='1.6'><world name='w'><model name='m'>\n<link "
     "name='a::b'/></model></world></sdf>",
     "w.world:2: ", "'::'"},
    {"bad_pose",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n<pose>0 0 x 0 0 0</pose>"
     "</link></model></world></sdf>",
     "w.world:2: ", "'x', which is not a number"},
    {"short_pose",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n<pose>0 0 0 0</pose>"
     "</link></model></world></sdf>",
     "w.world:2: ", "contains 4 numbers; give 6"},
    {"infinite_pose",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n"
     "<pose>inf 0 0 0 0 0</pose></link></model></world></sdf>",
     "w.world:2: ", "not finite"},
    {"bad_step",
     "<sdf version='1.6'><world name='w'><physics type='ode'>\n<max_step_size>fast</max_step_size>"
     "</physics></world></sdf>",
     "w.world:2: ", "'fast', which is not a number"},
    {"zero_step",
     "<sdf version='1.6'><world name='w'><physics type='ode'>\n<max_step_size>0</max_step_size>"
     "</physics></world></sdf>",
     "w.world:2: ", "greater than 0"},
    {"bad_flag",
     "<sdf version='1.6'><world name='w'><model name='m'>\n<static>maybe</static><link name='l'/>"
     "</model></world></sdf>",
     "w.world:2: ", "give true or false"},
    {"negative_box",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><collision name='c'>"
     "<geometry><box>\n<size>1 -1 "
     "1</size></box></geometry></collision></link></model></world></sdf>",
     "w.world:2: ", "<size> is -1; it must be greater than 0"},
    {"no_size",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><collision name='c'>"
     "<geometry>\n<box/></geometry></collision></link></model></world></sdf>",
     "w.world:2: ", "<box> has no <size>"},
    {"unknown_shape",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><visual name='c'>"
     "<geometry>\n<ellipsoid><radii>1 1 1</radii></ellipsoid></geometry></visual></link></model>"
     "</world></sdf>",
     "w.world:2: ", "unknown shape <ellipsoid>; known shapes are box"},
    {"no_geometry",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n<visual name='c'/>"
     "</link></model></world></sdf>",
     "w.world:2: ", "no <geometry>"},
    {"no_mass",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><inertial>\n<mass>0</mass>"
     "</inertial></link></model></world></sdf>",
     "w.world:2: ", "the mass is 0 kg"},
    {"impossible_inertia",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><inertial><mass>1</mass>\n"
     "<inertia><ixx>1</ixx><iyy>1</iyy><izz>9</izz></inertia></inertial></link></model></world>"
     "</sdf>",
     "w.world:2: ", "must not exceed the sum"},
    {"unknown_link",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>"
     "<joint name='j' type='fixed'>\n<parent>a</parent>\n<child>c</child></joint></model></world>"
     "</sdf>",
     "w.world:3: ", "unknown link 'c'; known are a, b, j"},
    {"unknown_joint_type",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>\n"
     "<joint name='j' type='spiral'><parent>a</parent><child>b</child></joint></model></world>"
     "</sdf>",
     "w.world:2: ", "unknown joint type 'spiral'; known are ball, continuous, fixed"},
    {"joined_to_itself",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>\n"
     "<joint name='j' "
     "type='fixed'><parent>a</parent><child>a</child></joint></model></world></sdf>",
     "w.world:2: ", "joins 'a' to itself"},
    {"zero_prismatic_axis",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>"
     "<joint name='j' type='prismatic'><parent>a</parent><child>b</child>\n<axis><xyz>0 0 0</xyz>"
     "</axis></joint></model></world></sdf>",
     "w.world:2: ", "has length 0"},
    {"limits_swapped",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>"
     "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>\n"
     "<limit><lower>1</lower><upper>-1</upper></limit></axis></joint></model></world></sdf>",
     "w.world:2: ", "lower exceeds upper"},
    {"pose_relative_to_nothing",
     "<sdf version='1.7'><world name='w'><model name='m'>\n<link name='a'>"
     "<pose relative_to='zz'>0 0 0 0 0 0</pose></link></model></world></sdf>",
     "w.world:2: ", "zz"},
    {"plugin_without_file", "<sdf version='1.6'><world name='w'>\n<plugin name='p'/></world></sdf>",
     "w.world:2: ", "no filename"},
    {"sensor_without_type",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n<sensor name='s'/></link>"
     "</model></world></sdf>",
     "w.world:2: ", "no type"},
    {"light_without_type", "<sdf version='1.6'><world name='w'>\n<light name='l'/></world></sdf>",
     "w.world:2: ", "<light name=\"l\"> has no type"},
    {"physics_without_type", "<sdf version='1.6'><world name='w'>\n<physics/></world></sdf>",
     "w.world:2: ", "<physics> has no type"},
    {"misspelled_where_plugins_read",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><sensor name='s' "
     "type='imu'>"
     "<imu><angular_velocity>\n<x><nois/></x></angular_velocity></imu></sensor></link></model>"
     "</world></sdf>",
     "w.world:2: ", "did you mean <noise>?"},
    {"unknown_light",
     "<sdf version='1.6'><world name='w'>\n<light name='l' type='laser'/></world></sdf>",
     "w.world:2: ", "unknown light type 'laser'"},
    {"light_of_no_color",
     "<sdf version='1.6'><world name='w'><light name='l' type='point'>\n<diffuse>x 1 1</diffuse>"
     "</light></world></sdf>",
     "w.world:2: ", "<diffuse> contains 'x', which is not a number"},
    {"include_without_uri", "<sdf version='1.6'><world name='w'>\n<include/></world></sdf>",
     "w.world:2: ", "no <uri>"},
    {"unknown_scheme",
     "<sdf version='1.6'><world name='w'><include>\n<uri>http://x/y</uri></include></world></sdf>",
     "w.world:2: ", "unknown uri 'http://x/y'"},
    {"missing_model",
     "<sdf version='1.6'><world name='w'><include>\n<uri>model://nowhere</uri></include></world>"
     "</sdf>",
     "w.world:2: ", "model 'model://nowhere' is not found; searched: "},
    {"missing_mesh",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><visual name='v'><geometry>"
     "<mesh>\n<uri>model://m/meshes/x.dae</uri></mesh></geometry></visual></link></model></world>"
     "</sdf>",
     "w.world:2: ", "mesh 'model://m/meshes/x.dae' is not found; searched: "},
    {"state_of_nobody",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'/></model><state>\n"
     "<model name='n'/></state></world></sdf>",
     "w.world:2: ", "unknown model 'n'; known are m"},
    {"state_of_no_joint",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'/></model><state>"
     "<model name='m'>\n<joint name='j'><angle axis='0'>1</angle></joint></model></state></world>"
     "</sdf>",
     "w.world:2: ", "unknown joint 'j' of model 'm'"},
    {"colder_than_cold",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><visual name='v'><geometry>"
     "<sphere><radius>1</radius></sphere></geometry><plugin name='p' "
     "filename='gz-sim-thermal-system'>\n<temperature>-3</temperature></plugin></visual></link>"
     "</model></world></sdf>",
     "w.world:2: ", "<temperature> is -3 K; it must be greater than 0"},
    {"a_cold_world",
     "<sdf version='1.6'><world name='w'><atmosphere "
     "type='adiabatic'>\n<temperature>0</temperature>"
     "</atmosphere></world></sdf>",
     "w.world:2: ", "it must be greater than 0"},
    {"waypoints_back_in_time",
     "<sdf version='1.6'><world name='w'><actor name='a'><script><trajectory id='0' type='walk'>"
     "<waypoint><time>2</time><pose>0 0 0 0 0 0</pose></waypoint>\n<waypoint><time>1</time>"
     "<pose>0 0 0 0 0 0</pose></waypoint></trajectory></script></actor></world></sdf>",
     "w.world:2: ", "is not after the one before"},
};

class BrokenWorld : public testing::TestWithParam<Broken> {};

TEST_P(BrokenWorld, IsAnErrorWithItsPlace) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::string message = error_of(GetParam().text);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(message.find(GetParam().place), 0U) << message;
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

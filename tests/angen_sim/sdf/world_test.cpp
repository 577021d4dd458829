#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

TEST(World, DefaultsAreThoseOfSdf) {
  const desc::World w = read(in_world(""));
  EXPECT_EQ(w.name, "w");
  EXPECT_EQ(w.physics.step, 1'000'000);
  EXPECT_DOUBLE_EQ(w.physics.real_time_factor, 1.0);
  EXPECT_EQ(w.physics.iterations, 50);
  expect_near(w.gravity, {0.0, 0.0, -9.81});
  EXPECT_TRUE(w.models.empty());
  EXPECT_TRUE(w.warnings.empty());
}

TEST(World, ReadsPhysics) {
  const desc::Physics p =
      read(in_world("<physics type='ode'><max_step_size>0.004</max_step_size>"
                    "<real_time_factor>2</real_time_factor><ode><solver><iters>70</iters></solver>"
                    "<constraints><cfm>0.001</cfm><erp>0.3</erp>"
                    "<contact_max_correcting_vel>5</contact_max_correcting_vel>"
                    "<contact_surface_layer>0.002</contact_surface_layer></constraints></ode>"
                    "</physics>"))
          .physics;
  EXPECT_EQ(p.step, 4'000'000);
  EXPECT_DOUBLE_EQ(p.real_time_factor, 2.0);
  EXPECT_EQ(p.iterations, 70);
  EXPECT_DOUBLE_EQ(p.cfm, 0.001);
  EXPECT_DOUBLE_EQ(p.erp, 0.3);
  EXPECT_DOUBLE_EQ(p.contact_max_correcting_vel, 5.0);
  EXPECT_DOUBLE_EQ(p.contact_surface_layer, 0.002);
}

TEST(World, UpdateRateZeroIsAsFastAsPossible) {
  const desc::World w = read(
      in_world("<physics type='ode'><real_time_update_rate>0</real_time_update_rate></physics>"));
  EXPECT_DOUBLE_EQ(w.physics.real_time_factor, 0.0);
}

TEST(World, DefaultPhysicsIsChosen) {
  const desc::World w = read(
      in_world("<physics name='a' type='ode'><max_step_size>0.01</max_step_size></physics>"
               "<physics name='b' type='ode' default='true'><max_step_size>0.02</max_step_size>"
               "</physics>"));
  EXPECT_EQ(w.physics.step, 20'000'000);
}

TEST(World, GravityStoodInPhysicsUntil15) {
  const desc::World w =
      read(in_world("<physics type='ode'><gravity>0 0 -1.6</gravity></physics>", "1.4"));
  expect_near(w.gravity, {0.0, 0.0, -1.6});
}

TEST(World, TheAirHasTheAtmospheresTemperature) {
  EXPECT_DOUBLE_EQ(read(in_world("")).ambient_temperature, 295.15);
  const char* cold = "<atmosphere type='adiabatic'><temperature>281</temperature></atmosphere>";
  EXPECT_DOUBLE_EQ(read(in_world(cold)).ambient_temperature, 281.0);
}

TEST(World, ReadsScene) {
  const desc::Scene s = read(in_world("<scene><ambient>0.1 0.2 0.3 1</ambient><background>0 0 1 1"
                                      "</background><shadows>false</shadows></scene>"))
                            .scene;
  EXPECT_FLOAT_EQ(s.ambient.y(), 0.2F);
  EXPECT_FLOAT_EQ(s.background.z(), 1.0F);
  EXPECT_FALSE(s.shadows);
}

TEST(World, ReadsLights) {
  const desc::World w = read(in_world(
      "<light name='sun' type='directional'><pose>1 2 3 0 0 0</pose><direction>0 3 -4"
      "</direction><diffuse>1 0.5 0.25 1</diffuse><cast_shadows>false</cast_shadows></light>"
      "<light name='spot' type='spot'><spot><inner_angle>0.2</inner_angle><outer_angle>0.4"
      "</outer_angle><falloff>1</falloff></spot><attenuation><range>7</range>"
      "</attenuation></light>"));
  ASSERT_EQ(w.lights.size(), 2U);
  EXPECT_EQ(w.lights[0].type, desc::Light::Type::kDirectional);
  expect_near(w.lights[0].pose.position, {1.0, 2.0, 3.0});
  expect_near(w.lights[0].direction, {0.0, 0.6, -0.8});
  EXPECT_FLOAT_EQ(w.lights[0].diffuse.z(), 0.25F);
  EXPECT_FALSE(w.lights[0].cast_shadows);
  EXPECT_DOUBLE_EQ(w.lights[1].outer_angle, 0.4);
  EXPECT_DOUBLE_EQ(w.lights[1].range, 7.0);
}

TEST(World, ReadsLightsWithAnArea) {
  const desc::World w = read(
      in_world("<light name='panel' type='point'><angen:rectangle>1.2 0.6</angen:rectangle></light>"
               "<light name='spot' type='spot'><angen:disc>0.3</angen:disc></light>"));
  ASSERT_EQ(w.lights.size(), 2U);
  EXPECT_EQ(w.lights[0].type, desc::Light::Type::kRectangle);
  EXPECT_DOUBLE_EQ(w.lights[0].width, 1.2);
  EXPECT_DOUBLE_EQ(w.lights[0].height, 0.6);
  EXPECT_EQ(w.lights[1].type, desc::Light::Type::kDisc);
  EXPECT_DOUBLE_EQ(w.lights[1].radius, 0.3);
}

TEST(World, PluginKeepsItsChildrenWithLines) {
  const desc::World w =
      read(in_world("\n<plugin name='p' filename='libp.so'>\n<a>1 2</a>\n"
                    "<b x='y'><c> z </c></b></plugin>"));
  ASSERT_EQ(w.plugins.size(), 1U);
  EXPECT_EQ(w.plugins[0].filename, "libp.so");
  EXPECT_EQ(w.plugins[0].source.line, 2);
  EXPECT_EQ(w.plugins[0].element.child("a")->text, "1 2");
  EXPECT_EQ(w.plugins[0].element.child("a")->source.line, 3);
  EXPECT_EQ(w.plugins[0].element.child("a")->source.file, "w.world");
  EXPECT_EQ(*w.plugins[0].element.child("b")->attribute("x"), "y");
  EXPECT_EQ(w.plugins[0].element.child("b")->child("c")->text, "z");
}

TEST(World, UnknownElementIsAWarningWithItsLine) {
  const desc::World w = read(in_link("\n<wings>2</wings>"));
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_EQ(w.warnings[0].source.line, 2);
  EXPECT_NE(w.warnings[0].message.find("wings"), std::string::npos);
}

TEST(Include, GivesNamePoseStaticAndPlugins) {
  const Folder folder;
  const std::string file =
      folder.model("part", sdf("<model name='m'><pose>9 9 9 0 0 0</pose><link name='l'>" + box() +
                               "</link><plugin name='own' filename='libown.so'/></model>"));
  const desc::World w =
      read(in_world("\n<include><uri>model://part</uri><name>n</name><pose>1 2 3 0 0 1</pose>"
                    "<static>true</static><plugin name='p' filename='libp.so'><k>5</k></plugin>"
                    "</include>"),
           folder.paths());
  ASSERT_EQ(w.models.size(), 1U);
  const desc::Model& m = w.models[0];
  EXPECT_EQ(m.name, "n");
  expect_near(m.pose, Pose{{1.0, 2.0, 3.0}, from_rpy(0.0, 0.0, 1.0)});
  EXPECT_TRUE(m.is_static);
  EXPECT_EQ(m.source.line, 2);
  EXPECT_EQ(m.links[0].source.file, file);
  ASSERT_EQ(m.plugins.size(), 2U);
  EXPECT_EQ(m.plugins[0].filename, "libown.so");
  EXPECT_EQ(m.plugins[1].filename, "libp.so");
  EXPECT_EQ(m.plugins[1].element.child("k")->text, "5");
}

TEST(Include, KeepsNameAndPoseOfTheFile) {
  const Folder folder;
  folder.model("part", sdf("<model name='m'><pose>1 0 0 0 0 0</pose><link name='l'/></model>"));
  const desc::World w =
      read(in_world("<include><uri>model://part</uri></include>"), folder.paths());
  EXPECT_EQ(w.models.at(0).name, "m");
  expect_near(w.models[0].pose.position, {1.0, 0.0, 0.0});
}

TEST(Include, TheSameFileTwiceGivesEqualModels) {
  const Folder folder;
  folder.model("part", sdf("<model name='m'><link name='l'>" + box() + "</link></model>"));
  const desc::World w = read(in_world("<include><uri>model://part</uri><name>a</name></include>"
                                      "<include><uri>model://part</uri><name>b</name><static>1"
                                      "</static></include>"
                                      "<include><uri>model://part</uri><name>c</name>"
                                      "<plugin name='p' filename='libp.so'/></include>"),
                             folder.paths());
  ASSERT_EQ(w.models.size(), 3U);
  EXPECT_FALSE(w.models[0].is_static);
  EXPECT_TRUE(w.models[1].is_static);
  EXPECT_TRUE(w.models[0].plugins.empty());
  EXPECT_EQ(w.models[2].plugins.size(), 1U);
  EXPECT_EQ(w.models[2].links[0].collisions.size(), 1U);
}

TEST(Include, HighestVersionOfModelConfigIsTaken) {
  const Folder folder;
  folder.write("part/model.config",
               "<model><sdf version='1.4'>old.sdf</sdf><sdf version='1.9'>new.sdf</sdf>"
               "<sdf version='1.6'>mid.sdf</sdf></model>");
  folder.write("part/new.sdf", sdf("<model name='new'><link name='l'/></model>", "1.9"));
  const desc::World w =
      read(in_world("<include><uri>model://part</uri></include>"), folder.paths());
  EXPECT_EQ(w.models.at(0).name, "new");
}

TEST(Include, FirstFolderOfTheSearchPathWins) {
  const Folder first;
  const Folder second;
  first.model("part", sdf("<model name='first'><link name='l'/></model>"));
  second.model("part", sdf("<model name='second'><link name='l'/></model>"));
  const SearchPaths paths{{first.path(), second.path()}, {}};
  EXPECT_EQ(read(in_world("<include><uri>model://part</uri></include>"), paths).models[0].name,
            "first");
}

TEST(Include, FileUriOnTheResourcePath) {
  const Folder folder;
  folder.write("things/t.sdf", sdf("<model name='t'><link name='l'/></model>"));
  const SearchPaths paths{{}, {folder.path()}};
  EXPECT_EQ(
      read(in_world("<include><uri>file://things/t.sdf</uri></include>"), paths).models[0].name,
      "t");
}

TEST(Include, LightBecomesALightOfTheWorld) {
  const Folder folder;
  folder.model("sun", sdf("<light name='sun' type='directional'><direction>0 0 -1</direction>"
                          "</light>"));
  const desc::World w = read(in_world("<include><uri>model://sun</uri></include>"), folder.paths());
  EXPECT_TRUE(w.models.empty());
  ASSERT_EQ(w.lights.size(), 1U);
  EXPECT_EQ(w.lights[0].name, "sun");
}

TEST(Include, EachFileKeepsItsOwnVersion) {
  const Folder folder;
  // One text: until 1.4 the axis is the model's, from 1.5 the link's.
  const std::string model =
      "<model name='m'><link name='a'/><link name='b'><pose>0 0 0 0 0 1.5707963267948966</pose>"
      "</link><joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>1 0 0"
      "</xyz></axis></joint></model>";
  folder.model("old", sdf(model, "1.4"));
  folder.model("new", sdf(model, "1.6"));
  const desc::World w = read(in_world("<include><uri>model://old</uri><name>old</name></include>"
                                      "<include><uri>model://new</uri><name>new</name></include>"),
                             folder.paths());
  expect_near(w.models[0].joints[0].axes[0].xyz, {1.0, 0.0, 0.0});
  expect_near(w.models[1].joints[0].axes[0].xyz, {0.0, 1.0, 0.0});
}

TEST(State, GivesPosesAndJointPositions) {
  const desc::World w = read(
      in_world("<model name='m'><link name='a'/><link name='b'/><joint name='j' type='revolute'>"
               "<parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz><limit><lower>-1.57</lower>"
               "<upper>0.001</upper></limit></axis></joint></model>"
               "<state world_name='w'><sim_time>0 0</sim_time><model name='m'>"
               "<pose>1 2 3 0 0 0</pose><joint name='j'><angle axis='0'>-1.57</angle></joint>"
               "</model></state>"));
  expect_near(w.models[0].pose.position, {1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(w.models[0].joints[0].axes[0].initial_position, -1.57);
}

TEST(State, PositionOutsideTheLimitsIsAnError) {
  const std::string message = error_of(
      in_world("<model name='m'><link name='a'/><link name='b'/><joint name='j' type='revolute'>"
               "<parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz><limit><lower>-1.57</lower>"
               "<upper>0.001</upper></limit></axis></joint></model>"
               "<state world_name='w'><model name='m'><joint name='j'>\n<angle axis='0'>3</angle>"
               "</joint></model></state>"));
  EXPECT_EQ(message.find("w.world:2: "), 0U) << message;
  EXPECT_NE(message.find("outside its limits"), std::string::npos) << message;
}

TEST(Actor, BecomesAPersonWithWaypointsOfTheWorld) {
  const desc::World w = read(in_world(
      "<actor name='person'><pose>10 0 0 0 0 1.5707963267948966</pose><skin><filename>x.dae"
      "</filename></skin><script><loop>true</loop><delay_start>2</delay_start>"
      "<trajectory id='0' type='walk'><waypoint><time>0</time><pose>1 0 0 0 0 0</pose></waypoint>"
      "<waypoint><time>3.5</time><pose>1 2 0 0 0 0.5</pose></waypoint></trajectory></script>"
      "<plugin name='p' filename='libperson_controller.so'><mass>80</mass></plugin></actor>"));
  EXPECT_TRUE(w.warnings.empty());
  ASSERT_EQ(w.models.size(), 1U);
  const desc::Model& m = w.models[0];
  expect_near(m.pose, Pose{{10.0, 1.0, 0.0}, from_rpy(0.0, 0.0, M_PI / 2)});
  ASSERT_EQ(m.links.size(), 1U);
  EXPECT_EQ(m.links[0].name, "body");
  EXPECT_TRUE(m.is_actor);
  EXPECT_DOUBLE_EQ(m.links[0].inertial.mass, 80.0);
  ASSERT_EQ(m.plugins.size(), 1U);
  EXPECT_EQ(m.plugins[0].filename, "libperson_controller.so");
  std::vector<std::string> rows;
  for (const Element& e : m.plugins[0].element.children) {
    if (e.name == "waypoint") rows.push_back(e.text);
  }
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].substr(0, 5), "0 10 ");
  EXPECT_EQ(rows[1].substr(0, 6), "3.5 8 ");
  EXPECT_EQ(m.plugins[0].element.child("loop")->text, "true");
  EXPECT_EQ(m.plugins[0].element.child("delay_start")->text, "2");
}

TEST(Actor, StandsOnItsFeetAndIsHalfAMetreWide) {
  const desc::Model m = read(in_world("<actor name='p'/>")).models.at(0);
  const desc::Collision& c = m.links[0].collisions.at(0);
  EXPECT_EQ(c.shape.type, Shape::Type::kCapsule);
  EXPECT_DOUBLE_EQ(2.0 * c.shape.radius, 0.5);
  EXPECT_DOUBLE_EQ(c.pose.position.z() - c.shape.length / 2 - c.shape.radius, 0.0);
  EXPECT_DOUBLE_EQ(c.shape.length + 2 * c.shape.radius, 1.75);
  EXPECT_DOUBLE_EQ(m.links[0].inertial.mass, 70.0);
}

TEST(Physics, OfAnotherEngineIsOdes) {
  const std::string world = "<physics type='bullet'><max_step_size>0.002</max_step_size></physics>";
  const desc::World w = read(in_world(world));
  EXPECT_EQ(w.physics.step, 2'000'000);
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_NE(w.warnings[0].text().find("w.world:1: <physics type=\"bullet\">: ODE is used"),
            std::string::npos)
      << w.warnings[0].text();
  EXPECT_TRUE(read(in_world("<physics type='ode'/>")).warnings.empty());
}

TEST(Include, WithMergeStandsForTheParts) {
  const Folder folder;
  folder.model("inner", sdf("<model name='inner'><static>true</static><link name='a'/>"
                            "<link name='b'><pose>1 0 0 0 0 0</pose></link><joint name='j' "
                            "type='fixed'><parent>a</parent><child>b</child></joint>"
                            "<plugin name='p' filename='libp.so'/></model>"));
  folder.model("outer", sdf("<model name='outer'><include merge='true'><uri>model://inner</uri>"
                            "</include><link name='c'/></model>"));
  const desc::Model m =
      read(in_world("<include><uri>model://outer</uri></include>"), folder.paths()).models.at(0);
  EXPECT_EQ(m.name, "outer");
  EXPECT_FALSE(m.is_static);
  ASSERT_EQ(m.links.size(), 3U);
  EXPECT_EQ(m.links[1].name, "b");
  expect_near(m.links[1].pose.position, {1.0, 0.0, 0.0});
  EXPECT_EQ(m.joints.at(0).name, "j");
  EXPECT_EQ(m.plugins.at(0).filename, "libp.so");
}

TEST(Include, WithMergeHasItsPlace) {
  const Folder folder;
  folder.model("inner",
               sdf("<model name='inner'><pose>1 0 0 0 0 0</pose><link name='a'/></model>"));
  const std::string include = "<include merge='true'><uri>model://inner</uri></include>";
  EXPECT_NE(error_of(in_world(include), folder.paths()).find("merge outside of a <model>"),
            std::string::npos);
  EXPECT_NE(error_of(in_model(include), folder.paths()).find("<pose> of a model that is included"),
            std::string::npos);
}

}  // namespace
}  // namespace angen::load

#include <thread>

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

using Type = Shape::Type;

desc::Collision read_shape(const std::string& shape) {
  return read(in_link("<collision name='c'><pose>1 0 0 0 0 0</pose><geometry>" + shape +
                      "</geometry></collision>"))
      .models[0]
      .links[0]
      .collisions.at(0);
}

TEST(Geometry, EveryShape) {
  EXPECT_EQ(read_shape("<empty/>").shape.type, Type::kEmpty);
  const Shape box = read_shape("<box><size>1 2 3</size></box>").shape;
  EXPECT_EQ(box.type, Type::kBox);
  expect_near(box.size, {1.0, 2.0, 3.0});
  const Shape sphere = read_shape("<sphere><radius>0.5</radius></sphere>").shape;
  EXPECT_EQ(sphere.type, Type::kSphere);
  EXPECT_DOUBLE_EQ(sphere.radius, 0.5);
  const Shape cylinder =
      read_shape("<cylinder><radius>0.5</radius><length>2</length></cylinder>").shape;
  EXPECT_EQ(cylinder.type, Type::kCylinder);
  EXPECT_DOUBLE_EQ(cylinder.length, 2.0);
  const Shape capsule =
      read_shape("<capsule><radius>0.5</radius><length>2</length></capsule>").shape;
  EXPECT_EQ(capsule.type, Type::kCapsule);
  EXPECT_DOUBLE_EQ(capsule.length, 2.0);
}

TEST(Geometry, PlaneTurnsItsPose) {
  const desc::Collision c = read_shape("<plane><normal>1 0 0</normal><size>4 5</size></plane>");
  EXPECT_EQ(c.shape.type, Type::kPlane);
  expect_near(c.pose.rotation * Vec3::UnitZ(), {1.0, 0.0, 0.0});
  expect_near(c.pose.position, {1.0, 0.0, 0.0});
}

TEST(Link, ReadsSurfaceInertialAndFlags) {
  const desc::Link l =
      read_model(
          "<link name='l'><pose>1 2 3 0 0 0</pose><gravity>false</gravity>"
          "<kinematic>true</kinematic><inertial><pose>0 0 1 0 0 0</pose><mass>4</mass>"
          "<inertia><ixx>1</ixx><ixy>0.1</ixy><ixz>0</ixz><iyy>2</iyy><iyz>0</iyz><izz>2.5"
          "</izz></inertia></inertial><collision name='c'><geometry><empty/></geometry>"
          "<surface><friction><ode><mu>0.4</mu><mu2>0.3</mu2><fdir1>0 2 0</fdir1><slip1>0.1"
          "</slip1></ode></friction><bounce><restitution_coefficient>0.5"
          "</restitution_coefficient></bounce><contact><ode><kp>1e5</kp><kd>10</kd></ode>"
          "</contact></surface></collision></link>")
          .links.at(0);
  expect_near(l.pose.position, {1.0, 2.0, 3.0});
  EXPECT_FALSE(l.gravity);
  EXPECT_TRUE(l.kinematic);
  EXPECT_DOUBLE_EQ(l.inertial.mass, 4.0);
  expect_near(l.inertial.pose.position, {0.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(l.inertial.moment(0, 1), 0.1);
  EXPECT_DOUBLE_EQ(l.inertial.moment(2, 2), 2.5);
  const desc::Collision& c = l.collisions.at(0);
  EXPECT_DOUBLE_EQ(c.friction.mu, 0.4);
  EXPECT_DOUBLE_EQ(c.friction.mu2, 0.3);
  expect_near(c.friction.direction1, {0.0, 1.0, 0.0});
  EXPECT_DOUBLE_EQ(c.friction.slip1, 0.1);
  EXPECT_DOUBLE_EQ(c.restitution, 0.5);
  EXPECT_DOUBLE_EQ(c.stiffness.value(), 1e5);
  EXPECT_DOUBLE_EQ(c.damping.value(), 10.0);
}

TEST(Collision, ANumberThatTheSolverCannotUseIsReplacedWithAWarning) {
  const desc::World world = read(in_link(
      "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface>"
      "<bounce><restitution_coefficient>1.5</restitution_coefficient></bounce></surface>"
      "</collision>"));
  EXPECT_EQ(world.models[0].links[0].collisions[0].restitution, 1.0);
  ASSERT_EQ(world.warnings.size(), 1U);
  EXPECT_NE(world.warnings[0].text().find("it is taken as 1, the most"), std::string::npos);
}

TEST(Link, PoseRelativeToAnotherLink) {
  const desc::Model m = read_model(
      "<link name='a'><pose>0 0 1 0 0 1.5707963267948966</pose></link>"
      "<link name='b'><pose relative_to='a'>1 0 0 0 0 0</pose></link>",
      "1.7");
  expect_near(m.links[1].pose.position, {0.0, 1.0, 1.0});
}

TEST(Inertia, ImpossibleIsAWarningWhereNothingMoves) {
  const desc::World w = read(
      in_model("<static>true</static><link name='l'><inertial>\n<mass>0</mass></inertial></link>"));
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_EQ(w.warnings[0].text().find("w.world:2: "), 0U) << w.warnings[0].text();
  EXPECT_GT(w.models[0].links[0].inertial.mass, 0.0);
}

TEST(Inertia, MassThatIsNoNumberIsAnErrorEvenThere) {
  error_of(in_model("<static>1</static><link name='l'><inertial><mass>x</mass></inertial></link>"));
}

TEST(Material, NamesAndColors) {
  const auto color = [](const std::string& material) {
    return read(in_link("<visual name='v'><geometry><empty/></geometry><material>" + material +
                        "</material></visual>"))
        .models[0]
        .links[0]
        .visuals[0]
        .material.diffuse;
  };
  const std::string script = "<script><uri>file://media/materials/scripts/gazebo.material</uri>";
  EXPECT_EQ(color(script + "<name>Gazebo/White</name></script>"),
            Eigen::Vector4f(1.0F, 1.0F, 1.0F, 1.0F));
  const Eigen::Vector4f wood = color(script + "<name>Gazebo/Wood</name></script>");
  EXPECT_GT(wood.x(), wood.z());
  EXPECT_EQ(color("<diffuse>0.1 0.2 0.3 0.4</diffuse>"), Eigen::Vector4f(0.1F, 0.2F, 0.3F, 0.4F));
}

TEST(Material, UnknownNameIsAWarning) {
  const desc::World w =
      read(in_link("<visual name='v'><geometry><empty/></geometry><material>"
                   "<script>\n<name>My/Own</name></script></material></visual>"));
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_EQ(w.warnings[0].source.line, 2);
}

TEST(Light, StandsInALink) {
  const desc::Link l =
      read(in_link("<light name='lamp' type='point'><pose>0 0 2 0 0 0</pose><diffuse>1 1 0.5 1"
                   "</diffuse></light>"))
          .models[0]
          .links[0];
  ASSERT_EQ(l.lights.size(), 1U);
  expect_near(l.lights[0].pose.position, {0.0, 0.0, 2.0});
  EXPECT_EQ(l.lights[0].type, desc::Light::Type::kPoint);
}

const char* const kPir =
    "<sensor name='pir' type='ray'><pose>0 0 1 0 0.5 0</pose><update_rate>10</update_rate>"
    "<visualize>true</visualize>\n<ray><scan><horizontal><samples>5</samples><min_angle>-1"
    "</min_angle><max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>6</max>"
    "</range></ray>\n<plugin name='p' filename='libpir_controller.so'><threshold>0.2</threshold>"
    "</plugin></sensor>";

TEST(Sensor, KeepsItsElementAndPlugin) {
  const desc::World w = read(in_link(kPir));
  EXPECT_TRUE(w.warnings.empty());
  const desc::Sensor s = w.models[0].links[0].sensors.at(0);
  EXPECT_EQ(s.name, "pir");
  EXPECT_EQ(s.type, "ray");
  expect_near(s.pose, Pose{{0.0, 0.0, 1.0}, from_rpy(0.0, 0.5, 0.0)});
  EXPECT_DOUBLE_EQ(s.update_rate, 10.0);
  EXPECT_TRUE(s.visualize);
  EXPECT_EQ(s.plugin, "libpir_controller.so");
  EXPECT_EQ(s.plugin_element.child("threshold")->text, "0.2");
  EXPECT_EQ(s.plugin_element.source.line, 3);
  const Element* max = s.element.child("ray")->child("range")->child("max");
  EXPECT_EQ(max->text, "6");
  EXPECT_EQ(max->source.line, 2);
}

TEST(Sensor, WithoutPluginIsAWarning) {
  const desc::World w = read(in_link("\n<sensor name='s' type='imu'/>"));
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_EQ(w.warnings[0].source.line, 2);
  EXPECT_EQ(w.models[0].links[0].sensors.size(), 1U);
}

TEST(Sensor, AloneForALink) {
  EXPECT_TRUE(is_sensor(kPir));
  EXPECT_TRUE(is_sensor(sdf(kPir)));
  EXPECT_FALSE(is_sensor("<model name='m'/>"));
  EXPECT_FALSE(is_sensor("model://pir"));
  EXPECT_FALSE(is_sensor("<sensor"));
  const Pose pose{{1.0, 2.0, 3.0}, Quat::Identity()};
  const desc::Sensor s = sensor(kPir, "p1", pose);
  EXPECT_EQ(s.name, "p1");
  expect_near(s.pose, pose);
  EXPECT_EQ(sensor(sdf(kPir), "", pose).name, "pir");
}

TEST(Sensor, AloneIsCheckedToo) {
  EXPECT_THROW(sensor("<sensor name='s' type='ray'><update_rate>x</update_rate></sensor>", "", {}),
               Error);
  EXPECT_THROW(sensor(kPir, "a::b", {}), Error);
  EXPECT_THROW(sensor(kPir, "\xff", {}), Error);
  EXPECT_THROW(sensor("<model name='m'/>", "", {}), Error);
}

TEST(Nested, ModelsBecomeLinksWithLongerNames) {
  const Folder folder;
  folder.model("part", sdf("<model name='p'><link name='l'><pose>1 0 0 0 0 0</pose></link>"
                           "<link name='k'/><joint name='j' type='revolute'><parent>l</parent>"
                           "<child>k</child><axis><xyz>1 0 0</xyz></axis></joint>"
                           "<plugin name='q' filename='libq.so'/></model>"));
  const desc::World w = read(
      in_model("<link name='base'/><include><uri>model://part</uri><name>arm</name>"
               "<pose>0 0 1 0 0 1.5707963267948966</pose></include><joint name='hold' type='fixed'>"
               "<parent>base</parent><child>arm::l</child></joint>"),
      folder.paths());
  const desc::Model& m = w.models.at(0);
  ASSERT_EQ(m.links.size(), 3U);
  EXPECT_EQ(m.links[1].name, "arm::l");
  expect_near(m.links[1].pose.position, {0.0, 1.0, 1.0});
  ASSERT_EQ(m.joints.size(), 2U);
  EXPECT_EQ(m.joints[0].name, "arm::j");
  EXPECT_EQ(m.joints[0].parent, "arm::l");
  expect_near(m.joints[0].axes[0].xyz, {0.0, 1.0, 0.0});
  EXPECT_EQ(m.joints[1].child, "arm::l");
  EXPECT_EQ(m.plugins.size(), 1U);
}

TEST(Model, FromEveryKindOfText) {
  const Folder folder;
  const std::string file = folder.model("part", sdf("<model name='m'><link name='l'/></model>"));
  const Pose pose{{1.0, 2.0, 3.0}, from_rpy(0.0, 0.0, 0.5)};
  for (const std::string& what : {sdf("<model name='m'><link name='l'/></model>"),
                                  std::string("<model name='m'><link name='l'/></model>"),
                                  std::string("  <include><uri>model://part</uri></include>"),
                                  sdf("<include><uri>model://part</uri></include>"),
                                  std::string("model://part"), file, folder.path() + "/part"}) {
    const desc::Model own = model(what, "", pose, folder.paths());
    EXPECT_EQ(own.name, "m") << what;
    const desc::Model m = model(what, "n", pose, folder.paths());
    EXPECT_EQ(m.name, "n") << what;
    expect_near(m.pose, pose);
    EXPECT_EQ(m.links.size(), 1U) << what;
  }
}

TEST(Model, ActorStartsAtItsFirstWaypoint) {
  const desc::Model m = model(
      "<actor name='a'><script><trajectory id='0' type='walk'><waypoint><time>0</time>"
      "<pose>1 0 0 0 0 0</pose></waypoint></trajectory></script></actor>",
      "b", {{0.0, 0.0, 4.0}, Quat::Identity()}, {});
  EXPECT_EQ(m.name, "b");
  expect_near(m.pose.position, {1.0, 0.0, 4.0});
}

TEST(Model, AVisualHasTheTemperatureOfItsThermalPlugin) {
  const desc::Model m = model(
      "<model name='m'><link name='l'><visual name='hot'><geometry><sphere><radius>1</radius>"
      "</sphere></geometry><plugin name='gz::sim::systems::Thermal' "
      "filename='gz-sim-thermal-system'><temperature>307</temperature></plugin></visual>"
      "<visual name='as_the_air'><geometry><sphere><radius>1</radius></sphere></geometry></visual>"
      "</link></model>",
      "", {}, {});
  EXPECT_EQ(m.links[0].visuals.at(0).temperature, 307.0);
  EXPECT_EQ(m.links[0].visuals.at(1).temperature, std::nullopt);
}

TEST(Model, AnActorIsAsWarmAsItsSkinAndClothesTogether) {
  const auto warmth = [](const std::string& plugin) {
    return model("<actor name='a'><plugin name='p' filename='libperson_controller.so'>" + plugin +
                     "</plugin></actor>",
                 "", {}, {})
        .links.at(0)
        .visuals.at(0)
        .temperature.value_or(0.0);
  };
  EXPECT_NEAR(warmth(""), 300.0, 0.05);  // 12 % at 307 K, 88 % at 299 K
  EXPECT_NEAR(warmth("<skin_temperature>290</skin_temperature>"
                     "<clothing_temperature>290</clothing_temperature>"),
              290.0, 1e-9);
  EXPECT_THROW(warmth("<skin_temperature>0</skin_temperature>"), Error);
}

TEST(Model, UrdfRobot) {
  const desc::Model m = model(
      "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' "
      "ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry><box size='1 2 3'/></geometry>"
      "</collision></link><link name='b'><inertial><mass value='2'/><inertia ixx='1' iyy='1' "
      "izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='j' type='revolute'>"
      "<parent link='a'/><child link='b'/><origin xyz='0 0 1' rpy='0 0 1.5707963267948966'/>"
      "<axis xyz='1 0 0'/><limit lower='-1' upper='2' effort='5' velocity='3'/></joint></robot>",
      "", {}, {});
  EXPECT_EQ(m.name, "r");
  ASSERT_EQ(m.links.size(), 2U);
  expect_near(m.links[1].pose.position, {0.0, 0.0, 1.0}, 1e-6);
  ASSERT_EQ(m.joints.size(), 1U);
  EXPECT_EQ(m.joints[0].type, desc::Joint::Type::kRevolute);
  expect_near(m.joints[0].axes.at(0).xyz, {0.0, 1.0, 0.0}, 1e-6);
  EXPECT_DOUBLE_EQ(m.joints[0].axes[0].upper, 2.0);
  EXPECT_DOUBLE_EQ(m.links[1].inertial.mass, 2.0);
}

TEST(Model, BrokenUrdfIsAnErrorWithItsLine) {
  testing::internal::CaptureStderr();
  try {
    model(
        "<robot name='r'><link name='a'/>\n<joint name='j' type='fixed'><parent link='a'/>"
        "<child link='zz'/></joint></robot>",
        "", {}, {});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics()[0].source.line, 2);
    EXPECT_NE(std::string(error.what()).find("unknown link 'zz'"), std::string::npos);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Model, ReadByTwoThreadsAtOnce) {
  const std::string text = sdf("<model name='m'>" + two_links() + "</model>");
  std::size_t links = 0;
  std::thread other([&] {
    for (int i = 0; i < 5; ++i) links += model(text, "a", {}, {}).links.size();
  });
  std::size_t own = 0;
  for (int i = 0; i < 5; ++i) own += model(text, "b", {}, {}).links.size();
  other.join();
  EXPECT_EQ(own, 10U);
  EXPECT_EQ(links, 10U);
}

TEST(Model, BadNamesAndPoses) {
  const std::string text = "<model name='m'><link name='l'/></model>";
  EXPECT_THROW(model(text, "a::b", {}, {}), Error);
  EXPECT_THROW(model(text, "\xc3", {}, {}), Error);
  EXPECT_THROW(model("<model><link name='l'/></model>", "", {}, {}), Error);
  EXPECT_THROW(model(text, "m", {{NAN, 0.0, 0.0}, Quat::Identity()}, {}), Error);
  EXPECT_THROW(model("", "m", {}, {}), Error);
  EXPECT_THROW(model("no_such_file.sdf", "m", {}, {}), Error);
  EXPECT_THROW(model(in_world(""), "m", {}, {}), Error);
  EXPECT_THROW(model("<light name='l' type='point'/>", "m", {}, {}), Error);
}

TEST(Model, KeepsItsOwnWarnings) {
  const desc::Model m =
      model("<model name='m'>" + joint("revolute", "<axis><xyz>0 0 0</xyz></axis>") + "</model>",
            "", {}, {});
  EXPECT_EQ(m.warnings.size(), 1U);
}

desc::Model with_nested(const std::string& outer, const std::string& one, const std::string& two) {
  const auto nested = [](const std::string& name, const std::string& inside) {
    return "<model name='" + name + "'>" + inside + "<link name='l'/></model>";
  };
  return read(in_model(outer + nested("one", one) + nested("two", two))).models.at(0);
}

TEST(Static, IsAModelOfStaticModels) {
  const std::string yes = "<static>true</static>", no = "<static>false</static>";
  EXPECT_TRUE(with_nested(no, yes, yes).is_static);
  EXPECT_TRUE(with_nested(yes, no, no).is_static);
  EXPECT_TRUE(with_nested("", "<model name='deep'>" + yes + "<link name='d'/></model>" + yes, yes)
                  .is_static);
  EXPECT_FALSE(with_nested("", yes, "").is_static);
  EXPECT_FALSE(with_nested("<link name='own'/>", yes, yes).is_static);
}

TEST(Static, IsAPartOfAModelThatMoves) {
  const desc::Model model = with_nested("", "<static>true</static>", "");
  EXPECT_TRUE(model.links.at(0).kinematic);
  EXPECT_FALSE(model.links.at(1).kinematic);
}

}  // namespace
}  // namespace angen::load

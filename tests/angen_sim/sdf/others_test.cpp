#include <algorithm>

#include "angen_sim/sdf/texts.h"
#include "core/limits.h"

// Elements that Gazebo reads and SDF 1.9 or Angen lacks: served, or left out with one warning.
namespace angen::load {
namespace {

constexpr bool kGazebo = true;

desc::World read_loosely(const std::string& text) {
  SearchPaths paths;
  paths.default_dialect = DefaultDialect::kGazebo;
  return read(text, paths);
}

std::string warnings_of(const desc::World& world) {
  std::string all;
  for (const Diagnostic& each : world.warnings) all += each.text() + "\n";
  return all;
}

std::string surface(const std::string& mu) {
  return "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry><surface><friction>"
         "<ode><mu>" +
         mu + "</mu><mu2>" + mu + "</mu2></ode></friction></surface></collision>";
}

TEST(Others, FrictionMayBeUnlimited) {
  for (const char* mu : {"-1", "inf", "Inf", "1e14"}) {
    const desc::World world = read_loosely(in_link(surface(mu)));
    EXPECT_GE(world.models[0].links[0].collisions[0].friction.mu, 1e9) << mu;
    EXPECT_GE(world.models[0].links[0].collisions[0].friction.mu2, 1e9) << mu;
  }
}

TEST(Others, Sdf12And13HaveTheirStepInTheSolver) {
  for (const char* version : {"1.2", "1.3"}) {
    const std::string root = version == std::string("1.2") ? "gazebo" : "sdf";
    const desc::World world = read_loosely(
        "<" + root + " version='" + version +
        "'><world name='w'><physics type='ode'><gravity>0 0 -9</gravity><update_rate>0"
        "</update_rate><ode><solver><type>quick</type><dt>0.004</dt><iters>10</iters></solver>"
        "</ode></physics><model name='m'><link name='l'>" +
        box() + "</link></model></world></" + root + ">");
    EXPECT_EQ(world.physics.step, from_seconds(0.004));
    EXPECT_EQ(world.physics.real_time_factor, 0.0);
    EXPECT_EQ(world.gravity.z(), -9.0);
  }
}

TEST(Others, ASecondShapeIsLeftOut) {
  const desc::World world =
      read_loosely(in_link("<collision name='c'><geometry><sphere><radius>1</radius></sphere>\n"
                           "<box><size>1 1 1</size></box></geometry></collision>"));
  EXPECT_EQ(world.models[0].links[0].collisions[0].shape.type, Shape::Type::kSphere);
  EXPECT_NE(warnings_of(world).find("w.world:2: a second shape"), std::string::npos);
}

TEST(Others, APartWithAnotherShapeOrNoneHasNone) {
  for (const char* geometry :
       {"<geometry><ellipsoid><radii>1 2 3</radii></ellipsoid></geometry>", "<geometry/>"}) {
    const std::string text = in_link("<collision name='c'>\n" + std::string(geometry) +
                                     "</collision><visual name='v'>" + geometry + "</visual>");
    const desc::World world = read_loosely(text);
    ASSERT_EQ(world.models.at(0).links[0].collisions.size(), 1U) << geometry;
    EXPECT_EQ(world.models[0].links[0].collisions[0].shape.type, Shape::Type::kEmpty) << geometry;
    EXPECT_NE(warnings_of(world).find("w.world:"), std::string::npos) << geometry;
    EXPECT_THROW(read(text), Error) << geometry;
  }
}

TEST(Others, ASlashInANameIsAnUnderscore) {
  const desc::World world = read_loosely(in_model(
      "<link name='a/b'/><link name='c'/><joint name='j/k' type='fixed'>"
      "<parent>a/b</parent><child>c</child></joint>"
      "<plugin name='p' filename='libgazebo_ros_p3d.so'><bodyName>a/b</bodyName></plugin>"));
  const desc::Model& model = world.models[0];
  EXPECT_EQ(model.links[0].name, "a_b");
  EXPECT_EQ(model.joints[0].name, "j_k");
  EXPECT_EQ(model.joints[0].parent, "a_b");
  EXPECT_EQ(model.plugins[0].element.child_text("bodyName"), "a_b");
}

TEST(Others, ASlashInAModelsNameIsAnUnderscore) {
  const std::string text =
      "<sdf version='1.6'><world name='w'><model name='robot/one'><link name='l'/><plugin name='p' "
      "filename='libgazebo_ros_p3d.so'><topicName>robot/one</topicName></plugin></model></world>"
      "</sdf>";
  const desc::World world = read_loosely(text);
  EXPECT_EQ(world.models.at(0).name, "robot_one");
  EXPECT_EQ(world.models[0].plugins[0].element.child_text("topicName"), "robot/one");
  EXPECT_THROW(read(text), Error);
}

TEST(Others, AJointOfTwoCrossedAxesIsUniversal) {
  const desc::World world = read_loosely(
      in_model(two_links() +
               "<joint name='j' type='revolute2'><parent>a</parent><child>b</child><axis><xyz>0 0 1"
               "</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>"));
  EXPECT_EQ(world.models[0].joints[0].type, desc::Joint::Type::kUniversal);
  EXPECT_EQ(warnings_of(world), "");
}

TEST(Others, JointsThatWeLackAreLeftOutAndCounted) {
  std::string joints;
  for (int i = 0; i < 6; ++i) {
    joints += "\n<joint name='j" + std::to_string(i) +
              "' type='gearbox'><parent>a</parent><child>b</child></joint>";
  }
  const desc::World world = read_loosely(in_model(two_links() + joints));
  EXPECT_TRUE(world.models[0].joints.empty());
  ASSERT_EQ(world.warnings.size(), 1U) << warnings_of(world);
  EXPECT_NE(warnings_of(world).find("w.world:2: unknown joint type 'gearbox'"), std::string::npos);
  EXPECT_NE(warnings_of(world).find("(and 5 more like it, up to line 7)"), std::string::npos);
}

// A joint of ODE has them until somebody sets others; gazebo_models' demo_joint_types has such a
// universal joint.
TEST(Others, AJointWithoutAnAxisHasThoseOfOde) {
  const auto joint = [](const std::string& type) {
    return in_model(two_links() + "\n<joint name='j' type='" + type +
                    "'><parent>a</parent><child>b</child></joint>");
  };
  const desc::World world = read_loosely(joint("universal"));
  ASSERT_EQ(world.models[0].joints[0].axes.size(), 2U);
  EXPECT_EQ(world.models[0].joints[0].axes[0].xyz, Vec3::UnitX());
  EXPECT_EQ(world.models[0].joints[0].axes[1].xyz, Vec3::UnitY());
  EXPECT_NE(warnings_of(world).find("w.world:2: <joint name=\"j\"> is universal and has no <axis>"),
            std::string::npos)
      << warnings_of(world);
  const desc::World hinge = read_loosely(joint("revolute"));
  ASSERT_EQ(hinge.models[0].joints[0].axes.size(), 1U);
  EXPECT_EQ(hinge.models[0].joints[0].axes[0].xyz, Vec3::UnitX());
  EXPECT_THROW(read(joint("universal")), Error);
}

// SDF 1.2 lists a piston; Gazebo reports it and goes on.
TEST(Others, AJointThatCannotBeMadeIsLeftOut) {
  const std::pair<const char*, const char*> cases[] = {
      {"type='piston'><parent>a</parent><child>b</child>", "unknown joint type 'piston'"},
      {"type='fixed'><parent>a</parent><child>a</child>",
       "<joint name=\"j\"> joins 'a' to itself; name two links; <joint name=\"j\"> is left out"},
      {"type='fixed'><parent>a</parent><child>handle::link</child>",
       "<joint name=\"j\"> names an unknown link 'handle::link'; known are a, b, j, k; "
       "<joint name=\"j\"> is left out"}};
  for (const auto& [joint, says] : cases) {
    const std::string text = in_model(
        two_links() + "\n<joint name='j' " + joint +
        "</joint>\n<joint name='k' type='fixed'><parent>a</parent><child>b</child></joint>");
    const desc::World world = read_loosely(text);
    ASSERT_EQ(world.models.at(0).joints.size(), 1U) << says;
    EXPECT_EQ(world.models[0].joints[0].name, "k");
    EXPECT_NE(warnings_of(world).find("w.world:2: " + std::string(says)), std::string::npos)
        << warnings_of(world);
    EXPECT_THROW(read(text), Error) << says;
  }
}

TEST(Others, AJointThatIsCalledWorldHasAnotherName) {
  const desc::World world = read_loosely(
      in_model(two_links() +
               "<joint name='world' type='fixed'><parent>world</parent><child>a</child></joint>"));
  ASSERT_EQ(world.models[0].joints.size(), 1U);
  EXPECT_EQ(world.models[0].joints[0].name, "world_joint");
  EXPECT_EQ(world.models[0].joints[0].parent, "world");
  EXPECT_NE(warnings_of(world).find("it is 'world_joint' here"), std::string::npos);
}

std::string polyline(const std::string& points, const std::string& height = "2") {
  std::string text = "<polyline><height>" + height + "</height>";
  for (std::size_t at = 0; at < points.size();) {
    const std::size_t end = std::min(points.find(',', at), points.size());
    text += "<point>" + points.substr(at, end - at) + "</point>";
    at = end + 1;
  }
  return text + "</polyline>";
}

// The volume that the triangles enclose, by the divergence theorem: positive if all face outward.
double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]].cast<double>();
    sum += a.dot(mesh.vertices[t[1]].cast<double>().cross(mesh.vertices[t[2]].cast<double>())) / 6;
  }
  return sum;
}

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f a = mesh.vertices[t[0]];
    sum += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).cast<double>().norm();
  }
  return sum;
}

TEST(Others, APolylineIsAPrismWithHoles) {
  // An L of 2 x 2 m less 1 x 1 m; clockwise and counterclockwise; with a hole of 0.5 x 0.5 m.
  struct Case {
    std::string outlines;
    double base, around;  // m^2, m
  };
  for (const Case& each : {Case{polyline("0 0,2 0,2 1,1 1,1 2,0 2"), 3.0, 8.0},
                           Case{polyline("0 2,1 2,1 1,2 1,2 0,0 0,0 2"), 3.0, 8.0},
                           Case{polyline("0 0,1 3,-1 1"), 2.0, 0.0},
                           Case{polyline("-1 -1,1 -1,1 1,-1 1") +
                                    polyline("-0.25 -0.25,0.25 -0.25,0.25 0.25,-0.25 0.25"),
                                3.75, 10.0}}) {
    const desc::World world = read_loosely(
        in_link("<collision name='c'><geometry>" + each.outlines + "</geometry></collision>"));
    const Shape& shape = world.models[0].links[0].collisions[0].shape;
    ASSERT_EQ(shape.type, Shape::Type::kMesh);
    EXPECT_NEAR(volume(*shape.mesh), 2.0 * each.base, 1e-5);
    if (each.around > 0.0) {
      EXPECT_NEAR(area(*shape.mesh), 2.0 * each.base + 2.0 * each.around, 1e-5);
    }
  }
}

TEST(Others, APolylineThatCrossesItselfIsNone) {
  const desc::World world = read_loosely(in_link(
      "<collision name='c'><geometry>" + polyline("0 0,1 1,1 0,0 1") + "</geometry></collision>"));
  EXPECT_TRUE(world.models[0].links[0].collisions.empty());
  EXPECT_NE(warnings_of(world).find("crosses itself"), std::string::npos) << warnings_of(world);
}

TEST(Others, AShapeAfterAPolylineIsLeftOut) {
  const desc::World world = read_loosely(
      in_link("<collision name='c'><geometry>" + polyline("0 0,1 0,0 1") + polyline("5 5,6 5,5 6") +
              "\n<box><size>1 1 1</size></box></geometry></collision>"));
  EXPECT_EQ(world.models[0].links[0].collisions[0].shape.type, Shape::Type::kMesh);
  EXPECT_NE(warnings_of(world).find("w.world:2: a second shape"), std::string::npos);
}

TEST(Others, ASensorWithoutGravityTakesNoneFromItsRobot) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
      "</inertial>";
  const std::string urdf =
      "<robot name='r'><link name='base'>" + inertial + "</link><link name='laser'>" + inertial +
      "</link><joint name='j' type='fixed'><parent link='base'/><child link='laser'/></joint>";
  const auto gravity = [&](const std::string& link) {
    const std::string off =
        "<gazebo reference='" + link + "'><turnGravityOff>true</turnGravityOff></gazebo></robot>";
    return load::model(urdf + off, "r", {}, {}, kGazebo).links[0].gravity;
  };
  EXPECT_TRUE(gravity("laser"));
  EXPECT_FALSE(gravity("base"));
}

TEST(Others, PartsOfAUrdfKeepTheirLines) {
  const std::string urdf =
      "<robot name='r'>\n<link name='base'>\n<inertial><mass value='1'/><inertia ixx='1' iyy='1' "
      "izz='1' ixy='0' ixz='0' iyz='0'/></inertial>\n<collision>\n<geometry>\n<box size='1 1 1'/>"
      "</geometry></collision></link>\n<link name='arm'>\n<collision>\n<geometry><sphere radius="
      "'1'/></geometry></collision></link>\n<joint name='j' type='fixed'><parent link='base'/>"
      "<child link='arm'/></joint></robot>";
  const desc::Model model = load::model(urdf, "r", {}, {}, kGazebo);
  ASSERT_EQ(model.links[0].collisions.size(), 2U);
  EXPECT_EQ(model.links[0].source.line, 2);
  EXPECT_EQ(model.links[0].collisions[0].source.line, 4);
  EXPECT_EQ(model.links[0].collisions[1].source.line, 8);
}

}  // namespace
}  // namespace angen::load

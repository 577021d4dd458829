#include "document/dialect.h"

#include <gtest/gtest.h>

#include "angen_sim/sdf/texts.h"
#include "document/xml.h"

namespace angen::load {
namespace {

const std::string kBadInertia =
    "<static>true</static><link name='l'><inertial><mass>1</mass><inertia><ixx>nan</ixx>"
    "</inertia></inertial></link>";

SearchPaths with(DefaultDialect default_dialect) {
  SearchPaths paths;
  paths.default_dialect = default_dialect;
  return paths;
}

bool warns(const std::vector<Diagnostic>& warnings, const std::string& words) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const Diagnostic& each) {
    return each.text().find(words) != std::string::npos;
  });
}

TEST(Tolerance, AnInertiaThatIsNotFiniteIsAnErrorOrAWarningWithItsLine) {
  const std::string text = in_model(kBadInertia);
  EXPECT_NE(error_of(text).find("<ixx> is not finite"), std::string::npos);
  const desc::World world = read(text, with(DefaultDialect::kGazebo));
  EXPECT_TRUE(world.customs.sets_aside);
  EXPECT_TRUE(warns(world.warnings, "w.world:1: <ixx> is not finite"));
}

TEST(Tolerance, AShapeWithoutThicknessIsAnErrorOrThin) {
  const std::string text = in_model(
      "<static>true</static><link name='l'><collision name='c'><geometry><box><size>0.3 0.2 0"
      "</size></box></geometry></collision></link>");
  EXPECT_NE(error_of(text).find("<size> is 0; it must be greater than 0"), std::string::npos);
  const desc::World world = read(text, with(DefaultDialect::kGazebo));
  EXPECT_EQ(world.models.at(0).links.at(0).collisions.at(0).shape.size, Vec3(0.3, 0.2, 1e-4));
  EXPECT_TRUE(warns(world.warnings, "it is taken as 0.1 mm"));
}

// As of a model whose only <include> is not there.
TEST(Tolerance, AModelWithoutLinksIsLeftOut) {
  const std::string text = in_world(
      "<model name='a'><include><uri>model://nowhere</uri></include></model>"
      "<model name='b'><link name='l'/></model>");
  EXPECT_THROW(read(text, with(DefaultDialect::kOwn)), Error);
  const desc::World world = read(text, with(DefaultDialect::kGazebo));
  ASSERT_EQ(world.models.size(), 1U);
  EXPECT_EQ(world.models[0].name, "b");
  EXPECT_TRUE(warns(world.warnings, "<model name=\"a\"> has no <link>"));
}

TEST(Tolerance, WhatWasThrownOutOfAWorldStandsAtItsEnd) {
  const std::string text = in_world(
      "<model name='a'><static>1</static><pose>3 0 -7.5e+08 0 0 1</pose>"
      "<link name='l'/></model>");
  EXPECT_THROW(read(text, with(DefaultDialect::kOwn)), Error);
  const desc::World world = read(text, with(DefaultDialect::kGazebo));
  EXPECT_EQ(world.models.at(0).pose.position, Vec3(3.0, 0.0, -1e6));
  EXPECT_NEAR(to_rpy(world.models.at(0).pose.rotation).z(), 1.0, 1e-9);
}

TEST(Tolerance, NamesOfOldFilesMayHoldColons) {
  const std::string model =
      "<model name='m'><link name='one::link'/><link name='two'/><joint name='j::k' "
      "type='revolute'><parent>one::link</parent><child>two</child><axis><xyz>0 0 1</xyz></axis>"
      "</joint></model>";
  EXPECT_THROW(read(in_world(model), with(DefaultDialect::kOwn)), Error);
  const desc::World world = read(in_world(model), with(DefaultDialect::kGazebo));
  EXPECT_EQ(world.models.at(0).links.at(0).name, "one_link");
  EXPECT_EQ(world.models.at(0).joints.at(0).parent, "one_link");
  EXPECT_EQ(world.models.at(0).joints.at(0).name, "j_k");
  EXPECT_TRUE(warns(world.warnings, "it is 'one_link' here"));
}

TEST(Tolerance, PartsOfOldFilesMayHaveOneName) {
  const std::string model =
      "<model name='m'><link name='a'><collision name='c'><geometry><box><size>1 1 1</size></box>"
      "</geometry></collision><collision name='c'><geometry><sphere><radius>1</radius></sphere>"
      "</geometry></collision></link><link name='a'/><link name='a_1'/><joint name='a' "
      "type='revolute'><parent>a</parent><child>a_1</child><axis><xyz>0 0 1</xyz></axis></joint>"
      "</model>";
  EXPECT_THROW(read(in_world(model), with(DefaultDialect::kOwn)), Error);
  const desc::World world = read(in_world(model), with(DefaultDialect::kGazebo));
  const desc::Model& made = world.models.at(0);
  ASSERT_EQ(made.links.size(), 3U);
  EXPECT_EQ(made.links[0].name, "a");
  EXPECT_EQ(made.links[1].name, "a_2");
  EXPECT_EQ(made.links[2].name, "a_1");
  EXPECT_EQ(made.links[0].collisions.at(1).name, "c_1");
  EXPECT_EQ(made.joints.at(0).name, "a_joint");
  EXPECT_EQ(made.joints.at(0).parent, "a");
  EXPECT_TRUE(warns(world.warnings, "it is 'a_2' here"));
}

TEST(Tolerance, PartsOfNewFilesMayNotHaveOneName) {
  const std::string twins = "<link name='a'/><link name='a'/>";
  const auto links = [&](const std::string& version) {
    return read(in_model(twins, version), with(DefaultDialect::kGazebo)).models.at(0).links.size();
  };
  EXPECT_EQ(links("1.6"), 2U);
  EXPECT_EQ(links("1.7"), 1U);
}

TEST(Tolerance, OfTwoModelsOfOneNameTheFirstStays) {
  const std::string text = in_world(
      "<model name='m'><link name='first'/></model><model name='m'><link name='second'/></model>");
  EXPECT_THROW(read(text, with(DefaultDialect::kOwn)), Error);
  const desc::World world = read(text, with(DefaultDialect::kGazebo));
  ASSERT_EQ(world.models.size(), 1U);
  EXPECT_EQ(world.models[0].links.at(0).name, "first");
  EXPECT_TRUE(warns(world.warnings, "a model named 'm' exists already"));
}

TEST(Tolerance, AMeshThatCannotBeReadOrIsHugeIsLeftOut) {
  const Folder folder;
  const std::string broken = folder.write("broken.stl", "solid nothing");
  const std::string stl =
      folder.write("one.stl",
                   "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                   "vertex 0 1 0\nendloop\nendfacet\nendsolid one\n");
  const auto with_mesh = [](const std::string& file, const std::string& scale) {
    return in_model("<link name='l'><visual name='v'><geometry><mesh><uri>" + file +
                    "</uri><scale>" + scale + "</scale></mesh></geometry></visual></link>");
  };
  for (const std::string& text : {with_mesh(broken, "1 1 1"), with_mesh(stl, "1e6 1e6 1")}) {
    SearchPaths paths = with(DefaultDialect::kGazebo);
    paths.allow_any = true;
    const desc::World world = read(text, paths);
    EXPECT_EQ(world.models.at(0).links.at(0).visuals.at(0).shape.type, Shape::Type::kEmpty);
    EXPECT_FALSE(world.warnings.empty());
    paths.default_dialect = DefaultDialect::kOwn;
    EXPECT_THROW(read(text, paths), Error);
  }
}

TEST(Tolerance, AWorldWithoutOwnPluginsIsTolerant) {
  EXPECT_TRUE(read(in_world(""), with(DefaultDialect::kAuto)).customs.sets_aside);
  const std::string gazebo = in_world(
      "<plugin name='p' filename='libgazebo_ros_laser.so'/><plugin name='q' "
      "filename='libnosuch.so'/>");
  EXPECT_TRUE(read(gazebo, with(DefaultDialect::kAuto)).customs.sets_aside);
  EXPECT_FALSE(read(gazebo, with(DefaultDialect::kOwn)).customs.sets_aside);
}

TEST(Tolerance, WhatAWorldSaysOfItselfHolds) {
  const std::string marked = "<sdf version='1.6'><world name='w' angen:strict='false'>" +
                             std::string("<model name='m'>") + kBadInertia +
                             "</model></world></sdf>";
  const desc::World world = read(marked);
  EXPECT_TRUE(world.customs.sets_aside);
  EXPECT_TRUE(world.ignored.empty());
  const std::string wrong = "<sdf version='1.6'><world name='w' angen:strict='no'/></sdf>";
  EXPECT_NE(error_of(wrong).find("give true or false"), std::string::npos);
}

TEST(Tolerance, ASavedWorldIsTolerantAgain) {
  const std::string unknown = "<plugin name='p' filename='libnosuch.so'/>";
  for (const DefaultDialect first : {DefaultDialect::kAuto, DefaultDialect::kGazebo}) {
    const std::string saved = save(read(in_world(unknown), with(first)), {});
    EXPECT_TRUE(read(saved, with(DefaultDialect::kOwn)).customs.sets_aside);
  }
  const std::string of_0_2 = "<sdf version='1.6'><world name='w' angen:strict='guessed'/></sdf>";
  EXPECT_TRUE(read(of_0_2, with(DefaultDialect::kOwn)).customs.sets_aside);
}

TEST(Tolerance, AMissingModelOrMeshIsLeftOut) {
  const std::string text = in_world(
      "<include><uri>model://nowhere</uri></include><model name='m'><link name='l'>"
      "<visual name='v'><geometry><mesh><uri>model://nowhere/a.dae</uri></mesh>"
      "</geometry></visual></link></model>");
  const desc::World world = read(text, with(DefaultDialect::kGazebo));
  ASSERT_EQ(world.models.size(), 1U);
  EXPECT_EQ(world.models[0].links[0].visuals[0].shape.type, Shape::Type::kEmpty);
  EXPECT_EQ(world.warnings.size(), 2U);
  EXPECT_NE(error_of(text).find("model 'model://nowhere' is not found"), std::string::npos);
}

TEST(Tolerance, AnInertiaThatNoBodyHasBecomesTheNearest) {
  const desc::World world =
      read(in_link("<inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>1</izz>"
                   "</inertia></inertial>"),
           with(DefaultDialect::kGazebo));
  const Eigen::Matrix3d moment = world.models[0].links[0].inertial.moment;
  EXPECT_NEAR(moment(0, 0), 0.5, 1e-12);
  EXPECT_NEAR(moment(1, 1), 0.5, 1e-12);
  EXPECT_NEAR(moment(2, 2), 1.0, 1e-12);
}

TEST(Tolerance, ASpawnedModelKeepsItInItsText) {
  const std::string text = "<sdf version='1.6'><model name='m'>" + kBadInertia +
                           "<plugin name='p' filename='libnosuch.so'/></model></sdf>";
  const desc::Model model = load::model(text, "m", {}, with(DefaultDialect::kAuto), true);
  EXPECT_TRUE(model.customs.sets_aside);
  const desc::World again = read(world_around(model));
  EXPECT_TRUE(again.models.at(0).customs.sets_aside);
  EXPECT_FALSE(
      load::model("<model name='m'><link name='l'/></model>", "", {}, with(DefaultDialect::kAuto))
          .customs.sets_aside);
  EXPECT_THROW(load::model(text, "m", {}, with(DefaultDialect::kOwn), true), Error);
}

TEST(Tolerance, AStateOfWhatIsNotThereIsPassedOver) {
  const std::string text = in_world(
      "<model name='m'><link name='l'/></model><state world_name='w'>"
      "<model name='misplaced'><pose>1 0 0 0 0 0</pose></model>"
      "<model name='m'><pose>2 0 0 0 0 0</pose></model></state>");
  EXPECT_EQ(read(text, with(DefaultDialect::kGazebo)).models[0].pose.position.x(), 2.0);
  EXPECT_NE(error_of(text).find("unknown model 'misplaced'"), std::string::npos);
}

TEST(Tolerance, AnyMomentOfInertiaThatIsNotANumberIsAnError) {
  for (const std::string moment : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
    const std::string error = error_of(
        in_link("<inertial><inertia><" + moment + ">x</" + moment + "></inertia></inertial>"));
    EXPECT_NE(error.find("<" + moment + ">"), std::string::npos) << error;
  }
}

TEST(Tolerance, MinDepthOfASurfaceIsRead) {
  const desc::World world =
      read(in_link("<collision name='c'><geometry><box><size>1 1 1</size></box></geometry>"
                   "<surface><contact><ode><min_depth>0.001</min_depth></ode></contact>"
                   "</surface></collision>"));
  EXPECT_EQ(world.models[0].links[0].collisions[0].min_depth, 0.001);
  EXPECT_TRUE(world.ignored.empty());
}

}  // namespace
}  // namespace angen::load

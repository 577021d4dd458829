#include <gtest/gtest.h>

#include <random>

#include "angen_sim/sdf/texts.h"
#include "core/limits.h"

namespace angen::load {
namespace {

SearchPaths tolerant() {
  SearchPaths paths;
  paths.default_dialect = DefaultDialect::kGazebo;
  return paths;
}

std::vector<std::string> texts_of(const std::vector<Diagnostic>& warnings) {
  std::vector<std::string> texts;
  for (const Diagnostic& each : warnings) texts.push_back(each.text());
  return texts;
}

const std::string kBox = "<geometry><box><size>1 1 1</size></box></geometry>";
// libsdformat drops links of a URDF without one.
const std::string kInertial =
    "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
    "</inertial>";
const std::string kGood =
    "<model name='good'><link name='l'><collision name='c'>" + kBox + "</collision></link></model>";

struct Case {
  std::string model;  // on one line of the world, beside a good one
  std::string warning;
  std::size_t models;  // that are left
};

// A message is of the file's line, names the element, and comes once.
TEST(SetAside, TheSmallestElementIsLeftOutAndNamedOnce) {
  const std::string joint =
      "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent><child>b"
      "</child><axis><xyz>0 0 1</xyz><limit><lower>x</lower></limit></axis></joint>";
  const std::vector<Case> cases = {
      {"<link name='l'><inertial><mass>heavy</mass></inertial></link>",
       "<mass> contains 'heavy', which is not a number; give one number; <mass> is left out", 2},
      {"<static>1</static><link name='l'><collision name='c'><geometry><box><size>1 "
       "2</size></box></geometry>"
       "</collision></link>",
       "<size> contains 2 numbers; give 3 numbers; <collision name=\"c\"> is left out", 2},
      {"<link name='l'><pose>0 0 z 0 0 0</pose></link>",
       "<pose> contains 'z', which is not a number; give 6 numbers; <pose> is left out", 2},
      {joint, "<lower> contains 'x', which is not a number; give one number; <lower> is left out",
       2},
      {"<link name='l'/><link name=''/>",
       "<link>: the name is empty; give one, such as kitchen_pir; <link> is left out", 2},
      {"<link name='l'><pose relative_to='nowhere'>1 0 0 0 0 0</pose></link>",
       "<link name=\"l\"> refers to an unknown frame 'nowhere'; known are l; <pose> is left out",
       2},
      {"", "<model name=\"m\"> has no <link>; give it one; <model name=\"m\"> is left out", 1}};
  for (const Case& each : cases) {
    const std::string text =
        in_world("\n" + kGood + "\n<model name='m'>" + each.model + "</model>", "1.7");
    EXPECT_THROW(read(text), Error) << each.model;
    const desc::World world = read(text, tolerant());
    EXPECT_EQ(world.models.size(), each.models) << each.model;
    EXPECT_EQ(world.models.at(0).name, "good");
    EXPECT_EQ(texts_of(world.warnings), std::vector<std::string>{"w.world:3: " + each.warning});
  }
}

TEST(SetAside, TheRestOfOneLongLineStays) {
  const std::string part = "<collision name='c'><geometry><sphere><radius>";
  std::string models;
  for (int i = 0; i < 5; ++i) {
    models += "<model name='m" + std::to_string(i) + "'><link name='l'>" + part +
              (i == 3 ? "no" : "1") + "</radius></sphere></geometry></collision></link></model>";
  }
  const desc::World world = read(in_world(models), tolerant());
  ASSERT_EQ(world.models.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(world.models[i].links.at(0).collisions.size(), i == 3 ? 0U : 1U) << i;
  }
}

TEST(SetAside, WrongSettingsAndLightsAreLeftOut) {
  const desc::World world =
      read(in_world("<physics type='ode'><max_step_size>fast</max_step_size></physics>\n<light "
                    "name='a' type='point'/>\n<light name='b' type='laser'/>" +
                    kGood),
           tolerant());
  EXPECT_EQ(world.models.size(), 1U);
  ASSERT_EQ(world.lights.size(), 1U);
  EXPECT_EQ(world.lights[0].name, "a");
  EXPECT_EQ(world.warnings.size(), 2U);
}

TEST(SetAside, AModelWithoutAnyShapeLeftDoesNotFall) {
  const auto with_mesh = [](const std::string& name) {
    return "\n<model name='" + name + "'><link name='l'><collision name='c'><geometry><mesh><uri>" +
           "model://nowhere/" + name + ".dae</uri></mesh></geometry></collision></link></model>";
  };
  const desc::World world = read(in_world(kGood + with_mesh("a") + with_mesh("b")), tolerant());
  ASSERT_EQ(world.models.size(), 3U);
  EXPECT_TRUE(world.models[0].links.at(0).gravity);
  const std::vector<std::string> texts = texts_of(world.warnings);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_FALSE(world.models[i].links.at(0).gravity);
    const std::string at = "w.world:" + std::to_string(i + 1) + ": ";
    const std::string mesh = "mesh 'model://nowhere/" + world.models[i].name + ".dae'";
    EXPECT_TRUE(std::any_of(texts.begin(), texts.end(),
                            [&](const std::string& text) { return text.find(at + mesh) == 0; }));
    EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
      return text.find(at) == 0 && text.find("it has no gravity here") != std::string::npos;
    }));
  }
}

TEST(SetAside, MissingNumbersOfAPoseAre0) {
  const std::string text = in_world(
      kGood +
          "\n<model name='five'><static>1</static><link name='l'><pose>1 2 3 0 0</pose></link>"
          "</model>",
      "1.6");
  EXPECT_EQ(error_of(text).find("w.world:2: <pose> contains 5 numbers; give 6 numbers"), 0U);
  const desc::World world = read(text, tolerant());
  EXPECT_EQ(world.models.at(1).links.at(0).pose.position, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(texts_of(world.warnings),
            std::vector<std::string>{"w.world:2: <pose> contains 5 numbers; give 6 numbers; those "
                                     "that are missing are taken as 0"});
}

TEST(SetAside, ColorsOf255AreDividedByIt) {
  const desc::World world =
      read(in_link("<visual name='v'>" + kBox +
                   "<material>\n<diffuse>255 127.5 0 1</diffuse></material></visual>"),
           tolerant());
  const Eigen::Vector4f diffuse = world.models.at(0).links.at(0).visuals.at(0).material.diffuse;
  EXPECT_NEAR(diffuse.x(), 1.0, 1e-6);
  EXPECT_NEAR(diffuse.y(), 0.5, 1e-6);
  EXPECT_NEAR(diffuse.w(), 1.0, 1e-6);
  ASSERT_EQ(world.warnings.size(), 1U);
  EXPECT_EQ(world.warnings[0].text().find("w.world:2: <diffuse> has a part of 255; "), 0U);
}

TEST(SetAside, ReservedNamesOfPartsAreChanged) {
  const desc::World world = read(
      in_model("<link name='__default__'/><link name='b'/><joint name='j' type='fixed'><parent>"
               "__default__</parent><child>b</child></joint>"),
      tolerant());
  EXPECT_EQ(world.models.at(0).links.at(0).name, "default");
  EXPECT_EQ(world.models.at(0).joints.at(0).parent, "default");
  ASSERT_EQ(world.warnings.size(), 1U);
  EXPECT_NE(world.warnings[0].text().find("it is 'default' here"), std::string::npos);
}

TEST(SetAside, AJointMayBeCalledAsALink) {
  const std::string robot =
      "<robot name='r'><link name='body'>" + kInertial + "</link><link name='neck'>" + kInertial +
      "</link><joint name='neck' type='revolute'><parent link='body'/><child link='neck'/><origin "
      "xyz='0 0 .2'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='5' velocity='2'/>"
      "</joint></robot>";
  const desc::Model model = load::model(robot, "r", {}, {});
  ASSERT_EQ(model.links.size(), 2U);
  ASSERT_EQ(model.joints.size(), 1U);
  EXPECT_EQ(model.joints[0].name, "neck");
  EXPECT_EQ(model.joints[0].child, "neck");
  EXPECT_NEAR(model.joints[0].anchor.z(), 0.2, 1e-12);
  EXPECT_EQ(read(world_around(model)).models.at(0).joints.size(), 1U) << "a saved world loads";
}

TEST(SetAside, PluginsOfOneNameAllStay) {
  const auto plugin = [](const std::string& topic) {
    return "<gazebo><plugin name='p' filename='libgazebo_ros_p3d.so'><topicName>" + topic +
           "</topicName><bodyName>b</bodyName></plugin></gazebo>\n";
  };
  const desc::Model model =
      load::model("<robot name='r'><link name='b'>" + kInertial + "</link>\n" + plugin("one") +
                      plugin("two") + plugin("three") + "</robot>",
                  "r", {}, {});
  ASSERT_EQ(model.plugins.size(), 3U);
  const std::vector<std::string> topics = {"one", "two", "three"};
  const std::vector<std::string> names = {"p", "p_2", "p_3"};  // for their sensors
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(model.plugins[i].name, names[i]);
    EXPECT_EQ(*model.plugins[i].element.attribute("name"), "p");
    EXPECT_EQ(model.plugins[i].element.child_text("topicName"), topics[i]);
    EXPECT_EQ(model.plugins[i].source.line, static_cast<int>(i) + 2);
  }
}

TEST(SetAside, WrongPartsOfARobotAreLeftOut) {
  const std::string robot = "<robot name='r'><link name='b'>" + kInertial +
                            "\n<visual><geometry><mesh filename='a.dae'/><mesh scale=''/>"
                            "</geometry></visual></link></robot>";
  EXPECT_THROW(load::model(robot, "r", {}, {}), Error);
  const desc::Model model = load::model(robot, "r", {}, tolerant(), true);
  ASSERT_EQ(model.links.size(), 1U);
  ASSERT_FALSE(model.warnings.empty());
  EXPECT_EQ(model.warnings[0].text().find("(text):2: <mesh scale> contains ''"), 0U)
      << model.warnings[0].text();
}

TEST(SetAside, ATextMayBeginWithAByteOrderMark) {
  EXPECT_EQ(load::model("\xEF\xBB\xBF<sdf version='1.6'><model name='m'><link name='l'/></model>"
                        "</sdf>",
                        "", {}, {})
                .name,
            "m");
}

TEST(SetAside, APointerOfGitLfsIsNoMesh) {
  const Folder folder;
  const std::string file = folder.write(
      "m.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:12\nsize 12345\n");
  SearchPaths paths = tolerant();
  paths.allow_any = true;
  const desc::World world = read(in_link("<visual name='v'><geometry><mesh>\n<uri>" + file +
                                         "</uri></mesh></geometry>"
                                         "</visual>"),
                                 paths);
  ASSERT_EQ(world.warnings.size(), 1U);
  EXPECT_EQ(world.warnings[0].text().find("w.world:2: mesh " + file + " is a pointer of Git LFS"),
            0U);
}

TEST(SetAside, MoreElementsThanTheLimitAreAnErrorOfTheWorld) {
  std::string model = "<sdf version='1.6'><model name='m'>";
  for (int i = 0; i < 21'000; ++i) model += "<link name='l" + std::to_string(i) + "'/>";
  const Folder folder;
  folder.model("large", model + "</model></sdf>");
  SearchPaths paths = folder.paths();
  paths.default_dialect = DefaultDialect::kGazebo;
  EXPECT_THROW(read(in_world("<include><uri>model://large</uri></include>"), paths), Error);
}

// Words of a world, each at some time made wrong: a number cut, a name doubled, a value emptied.
TEST(SetAside, AnyOneWrongWordCostsNoWorld) {
  const std::string text = in_world(
      "<physics type='ode'><max_step_size>0.001</max_step_size></physics>"
      "<light name='sun' type='directional'><direction>0 0 -1</direction><diffuse>1 1 1 1</diffuse>"
      "</light><model name='a'><pose>0 0 1 0 0 0</pose><link name='body'><inertial><mass>2</mass>"
      "<inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial><collision name='c'>"
      "<geometry><box><size>1 1 1</size></box></geometry><surface><friction><ode><mu>0.5</mu></ode>"
      "</friction></surface></collision><visual name='v'><geometry><cylinder><radius>0.5</radius>"
      "<length>1</length></cylinder></geometry><material><diffuse>1 0 0 1</diffuse></material>"
      "</visual></link><link name='arm'><pose>0 0 1 0 0 0</pose></link><joint name='j' "
      "type='revolute'><parent>body</parent><child>arm</child><axis><xyz>0 0 1</xyz><limit><lower>"
      "-1</lower><upper>1</upper></limit></axis></joint><frame name='f' attached_to='arm'/></model>"
      "<model name='b'><static>true</static><link name='body'><sensor name='s' type='ray'>"
      "<update_rate>5</update_rate></sensor></link></model>",
      "1.7");
  std::mt19937 random(7);
  int with_warning = 0;
  for (int i = 0; i < 600; ++i) {
    std::string wrong = text;
    const auto ends = [](char c) { return c == '>' || c == '\'' || c == ' ' || c == '<'; };
    std::size_t begin = random() % text.size();
    while (begin > 0 && !ends(text[begin - 1])) --begin;
    std::size_t end = begin;
    while (end < text.size() && !ends(text[end])) ++end;
    const std::string word = text.substr(begin, end - begin);
    if (word.empty() || begin < text.find("<physics")) continue;
    if (word.find_first_of("=/") != std::string::npos || text[begin - 1] == '<') continue;
    if (i % 3 == 0) wrong.erase(begin, end - begin);
    if (i % 3 == 1) wrong.erase((begin + end) / 2, 1);
    if (i % 3 == 2) wrong.insert(end, word);
    try {
      with_warning += read(wrong, tolerant()).warnings.empty() ? 0 : 1;
    } catch (const Error& error) {
      ADD_FAILURE() << error.what() << "\n" << wrong;
    }
  }
  EXPECT_GT(with_warning, 50);
}

}  // namespace
}  // namespace angen::load

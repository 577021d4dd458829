#include "sdf/frames.h"

#include <chrono>
#include <cmath>

#include "angen_sim/sdf/texts.h"
#include "document/xml.h"
#include "sdf/load.h"

namespace angen::load {
namespace {

Element model(const std::string& inside, const std::string& attributes = "") {
  return parse_xml("<model name='m' " + attributes + ">" + inside + "</model>", "m.sdf");
}

std::string message_of_frame(const std::string& inside, const std::string& frame) {
  const Element root = model(inside);
  Frames frames(root);
  try {
    frames.pose(frame);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Frames, AreRelativeToTheModelOrToWhatTheySay) {
  const Element root = model(
      "<link name='a'><pose>1 0 0 0 0 1.5707963267948966</pose></link>"
      "<link name='b'><pose relative_to='a'>1 0 0 0 0 0</pose></link>"
      "<frame name='f' attached_to='b'><pose>0 0 1 0 0 0</pose></frame>"
      "<frame name='g'><pose>0 0 2 0 0 0</pose></frame>"
      "<joint name='j' type='revolute'><parent>a</parent><child>b</child><pose>0 1 0 0 0 0</pose>"
      "</joint>"
      "<link name='c'><pose relative_to='j'>0 0 0.5 0 0 0</pose></link>"
      "<link name='d'><pose relative_to='__model__'>4 0 0 0 0 0</pose></link>");
  Frames frames(root);
  expect_near(frames.pose("a").position, {1.0, 0.0, 0.0});
  expect_near(frames.pose("b").position, {1.0, 1.0, 0.0});
  expect_near(frames.pose("f").position, {1.0, 1.0, 1.0});
  expect_near(frames.pose("g").position, {0.0, 0.0, 2.0});
  expect_near(frames.pose("j").position, {0.0, 1.0, 0.0});  // 0 1 0 of b, which is turned
  expect_near(frames.pose("c").position, {0.0, 1.0, 0.5});
  expect_near(frames.pose("d").position, {4.0, 0.0, 0.0});
  EXPECT_EQ(frames.link_of("f", "", root), "b");
  EXPECT_EQ(frames.link_of("g", "", root), "a") << "the canonical link is the first";
  EXPECT_EQ(frames.link_of("j", "", root), "b");
  EXPECT_EQ(frames.link_of("__model__", "", root), "a");
  EXPECT_EQ(frames.link_of("world", "", root), "world");
}

TEST(Frames, OfNestedModels) {
  const Element root = model(
      "<link name='a'/><model name='n'><pose>1 0 0 0 0 0</pose>"
      "<link name='a'><pose>0 1 0 0 0 0</pose></link>"
      "<link name='b'><pose relative_to='a'>0 0 1 0 0 0</pose></link></model>"
      "<model name='o' placement_frame='p'><pose relative_to='n::b'>0 0 0 0 0 0</pose>"
      "<link name='l'/><frame name='p'><pose>5 0 0 0 0 0</pose></frame></model>"
      "<frame name='f' attached_to='n::b'/><frame name='g' attached_to='n'/>",
      "canonical_link='n::b'");
  Frames frames(root);
  expect_near(frames.pose("n::a").position, {1.0, 1.0, 0.0});
  expect_near(frames.pose("n::b").position, {1.0, 1.0, 1.0});
  expect_near(frames.pose("f").position, {1.0, 1.0, 1.0});
  expect_near(frames.pose("o::p").position, {1.0, 1.0, 1.0});
  expect_near(frames.pose("o::l").position, {-4.0, 1.0, 1.0});
  EXPECT_EQ(frames.link_of("f", "", root), "n::b");
  EXPECT_EQ(frames.link_of("g", "", root), "n::a");
  EXPECT_EQ(frames.link_of("a", "n::", root), "n::a");
  EXPECT_EQ(frames.link_of("__model__", "n::", root), "n::a");
  EXPECT_EQ(frames.link_of("__model__", "", root), "n::b");
}

TEST(Frames, OfPartsOfALink) {
  const Element root = model(
      "<link name='a'><pose>1 0 0 0 0 0</pose><sensor name='s'><pose>0 0 1 0 0 0</pose></sensor>"
      "<light name='l'><pose relative_to='b'>0 0 1 0 0 0</pose></light></link>"
      "<link name='b'><pose>4 0 0 0 0 0</pose></link>");
  Frames frames(root);
  const Element& link = root.children[0];
  expect_near(frames.part_pose(link.children[1], "a", "").position, {0.0, 0.0, 1.0});
  expect_near(frames.part_pose(link.children[2], "a", "").position, {3.0, 0.0, 1.0});
}

TEST(Frames, ThatDoNotExistOrAreRelativeToThemselvesAreErrors) {
  const std::string unknown =
      message_of_frame("<link name='a'>\n<pose relative_to='zz'>0 0 0 0 0 0</pose></link>", "a");
  EXPECT_EQ(unknown, "m.sdf:2: <link name=\"a\"> refers to an unknown frame 'zz'; known are a");
  const std::string cycle = message_of_frame(
      "<link name='a'><pose relative_to='b'>0 0 0 0 0 0</pose></link>\n"
      "<link name='b'><pose relative_to='a'>0 0 0 0 0 0</pose></link>",
      "a");
  EXPECT_NE(cycle.find("relative to itself"), std::string::npos) << cycle;
  const Element root =
      model("<link name='l'/><frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>");
  Frames frames(root);
  EXPECT_THROW(frames.link_of("f", "", root), Error);
}

// A chain of 20,000 links, each relative to the one before: neither the stack nor time of a square.
TEST(Frames, OfALongChain) {
  std::string inside = "<link name='l0'/>";
  for (int i = 1; i < 20000; ++i) {
    inside += "<link name='l" + std::to_string(i) + "'><pose relative_to='l" +
              std::to_string(i - 1) + "'>1 0 0 0 0 0</pose></link>";
  }
  const Element root = model(inside);
  Frames frames(root);
  expect_near(frames.pose("l19999").position, {19999.0, 0.0, 0.0}, 1e-6);
}

TEST(Frames, OfAModelThatIsPlacedByAFrameOfItsOwn) {
  const desc::World world = world_from_text(
      "<sdf version='1.9'><world name='w'><model name='m' placement_frame='f'>"
      "<pose>1 2 3 0 0 1.5707963267948966</pose><link name='l'/>"
      "<frame name='f'><pose>5 0 0 0 0 0</pose></frame></model>"
      "<model name='n'><pose relative_to='m'>1 0 0 0 0 0</pose><link name='l'/></model>"
      "</world></sdf>",
      "w", {});
  expect_near(world.models.at(0).pose.position, {1.0, -3.0, 3.0});
  expect_near(world.models.at(1).pose.position, {1.0, -2.0, 3.0});
}

TEST(Frames, OneOfItsOwnPlacesAModelWhereverItsPoseIsGiven) {
  Folder folder;
  const auto text = [](const std::string& pose) {
    return "<sdf version='1.9'><model name='m' placement_frame='f'>" + pose +
           "<static>true</static><link name='l'/>"
           "<frame name='f'><pose>5 0 0 0 0 0</pose></frame></model></sdf>";
  };
  const std::string file = folder.write("m.sdf", text(""));
  const Vec3 placed(-4.0, 2.0, 3.0);
  const Pose pose{{1.0, 2.0, 3.0}, Quat::Identity()};
  expect_near(load::model(text("<pose>9 9 9 0 0 0</pose>"), "n", pose, {}).pose.position, placed);
  const std::string in_file =
      folder.write("w.world",
                   "<sdf version='1.9'><world name='w'>"
                   "<include><uri>" +
                       file +
                       "</uri><name>i</name><pose>1 2 3 0 0 0</pose></include>"
                       "<include><uri>" +
                       file +
                       "</uri><name>j</name><pose>1 2 3 0 0 0</pose>"
                       "<placement_frame>l</placement_frame></include></world></sdf>");
  desc::World world = load::world(in_file, true);
  SearchPaths anywhere;
  anywhere.allow_any = true;
  for (int saves = 0; saves < 3; ++saves) {
    expect_near(world.models.at(0).pose.position, placed);
    expect_near(world.models.at(1).pose.position, pose.position);
    std::vector<ModelState> states;
    for (const desc::Model& each : world.models) states.push_back({&each, each.pose, {}, {}});
    world = world_from_text(save(world, states), "saved", anywhere);
  }
}

}  // namespace
}  // namespace angen::load

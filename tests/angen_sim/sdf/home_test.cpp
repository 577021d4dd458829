#include "sdf/home.h"

#include "angen_sim/sdf/texts.h"
#include "core/text.h"

namespace angen::load {
namespace {

constexpr char kSquare[] = "<angen:polygon>0 0 4 0 4 3 0 3</angen:polygon>";

std::string room(const std::string& inside, const std::string& name = "hall") {
  return "<angen:room name='" + name + "'>" + inside + "</angen:room>";
}

std::string in_bed(const std::string& inside) { return in_model("<link name='l'/>" + inside); }

std::string problem_of(const std::string& text) {
  try {
    read(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Home, IsReadFromAWorld) {
  const desc::World world = read(in_world(
      "<angen:home><angen:entrance>front</angen:entrance><angen:north>0.5</angen:north>"
      "<angen:latitude>-33.9</angen:latitude><angen:start>2024-02-29T23:59:59</angen:start>"
      "</angen:home><angen:storey name='Ground' number='0'><angen:elevation>0</angen:elevation>"
      "<angen:height>2.7</angen:height></angen:storey>" +
      room("<angen:use>hall</angen:use><angen:polygon>0 3 4 3 4 0 0 0</angen:polygon>"
           "<angen:hole>1 1 2 1 2 2</angen:hole><angen:floor>0.1</angen:floor>"
           "<angen:ceiling>2.6</angen:ceiling>") +
      "<angen:opening name='arch'><angen:pose>1 2 0 1.5</angen:pose><angen:width>0.9</angen:width>"
      "</angen:opening>"));
  EXPECT_EQ(world.site.entrance, "front");
  EXPECT_EQ(world.site.north, 0.5);
  EXPECT_EQ(world.site.latitude, -33.9);
  EXPECT_EQ(world.site.start, "2024-02-29T23:59:59");
  ASSERT_EQ(world.home.storeys.size(), 1U);
  EXPECT_EQ(world.home.storeys[0].height, 2.7);
  ASSERT_EQ(world.home.rooms.size(), 1U);
  EXPECT_GT(signed_area(world.home.rooms[0].outline), 0.0);  // also if it was given clockwise
  EXPECT_EQ(world.home.rooms[0].holes.size(), 1U);
  EXPECT_EQ(world.home.rooms[0].floor, 0.1);
  EXPECT_EQ(world.home.rooms[0].ceiling, 2.6);
  ASSERT_EQ(world.home.openings.size(), 1U);
  EXPECT_EQ(world.home.openings[0].height, 2.1);
  EXPECT_TRUE(world.ignored.empty());
}

TEST(Home, IsReadFromANestedModel) {
  const desc::World world =
      read(in_model("<link name='l'/><model name='part'><pose>1 2 3 0 0 1.5707963267948966</pose>"
                    "<link name='l'/>" +
                    room(kSquare) + "<angen:thing>bed</angen:thing>" +
                    "<angen:place posture='lie'>1 0 0.5 0</angen:place></model>"));
  const desc::HomeParts& home = world.models.at(0).home;
  ASSERT_EQ(home.rooms.size(), 1U);
  EXPECT_NEAR(home.rooms[0].outline[1].x(), 1.0, 1e-9);
  EXPECT_NEAR(home.rooms[0].outline[1].y(), 6.0, 1e-9);
  EXPECT_NEAR(home.rooms[0].floor, 3.0, 1e-9);
  EXPECT_EQ(home.thing, "bed");
  ASSERT_EQ(home.places.size(), 1U);
  EXPECT_NEAR(home.places[0].pose.position.y(), 3.0, 1e-9);
  EXPECT_NEAR(home.places[0].pose.yaw, M_PI_2, 1e-9);
}

TEST(Home, OfAnIncludeReplacesThatOfItsModel) {
  const Folder folder;
  folder.model("seat", sdf("<model name='seat'><link name='l'/><angen:thing>chair</angen:thing>"
                           "<angen:place posture='sit'>0 0 0.4 0</angen:place></model>"));
  const std::string include =
      "<include><uri>model://seat</uri><angen:thing>sofa</angen:thing></include>";
  const desc::World world = world_from_text(in_world(include), "w.world", folder.paths());
  EXPECT_EQ(world.models.at(0).home.thing, "sofa");
  EXPECT_EQ(world.models.at(0).home.places.size(), 1U);
  EXPECT_TRUE(world.warnings.empty());
}

struct Wrong {
  std::string text;
  std::string says;
};

TEST(Home, SaysWhatIsWrongAndWhere) {
  const auto polygon = [](const std::string& corners) {
    return in_world(room("<angen:polygon>" + corners + "</angen:polygon>"));
  };
  const auto site = [](const std::string& inside) {
    return in_world("<angen:home>" + inside + "</angen:home>");
  };
  const Wrong all[] = {
      {polygon("0 0 1 0"), "three corners"},
      {polygon("0 0 1 0 1"), "three corners"},
      {polygon("0 0 1 0 1 nan"), "m; it must be"},
      {polygon("0 0 1 0 1 inf"), "m; it must be"},
      {polygon("0 0 1 0 1 1e9"), "m; it must be"},
      {polygon("0 0 1 0 here 1"), "'here'"},
      {polygon("0 0 2 2 2 0 0 2"), "crosses itself: its edge (0, 0) to (2, 2)"},
      {polygon("0 0 1 0 2 0"), "crosses itself"},
      {polygon("0 0 0.05 0 0.05 0.05"), "area of"},
      {in_world(room("")), "has no <angen:polygon>"},
      {in_world(room(kSquare, "")), "has no name"},
      {in_world(room(kSquare) + room(kSquare)), "is given twice"},
      {in_world(room(std::string(kSquare) + "<angen:use>dungeon</angen:use>")),
       "'dungeon'; known are kitchen"},
      {in_world(room(std::string(kSquare) + "<angen:hole>3 1 5 1 5 2</angen:hole>")), "outside"},
      {in_world(room(std::string(kSquare) + "<angen:ceiling>0</angen:ceiling>")), "greater than 0"},
      {in_world(room(std::string(kSquare) + "<angen:floor>nan</angen:floor>")), "<angen:floor>"},
      {in_world("<angen:storey name='x'><angen:elevation>0</angen:elevation></angen:storey>"),
       "number=\"0\""},
      {in_world("<angen:storey number='0'/>"), "has no <angen:elevation>"},
      {in_world("<angen:opening name='o'><angen:width>1</angen:width></angen:opening>"),
       "has no <angen:pose>"},
      {in_world("<angen:opening name='o'><angen:pose>1 2 3</angen:pose></angen:opening>"),
       "numbers"},
      {in_bed("<angen:thing>throne</angen:thing>"), "'throne'; known are bed"},
      {in_bed("<angen:place posture='fly'>0 0 0 0</angen:place>"), "'fly'; known are stand"},
      {in_bed("<angen:place>0 0 0 0</angen:place>"), "has no posture"},
      {in_bed("<angen:place posture='sit'>0 0 0</angen:place>"), "numbers"},
      {in_bed("<angen:place posture='sit'>0 0 nan 0</angen:place>"), "<angen:place>"},
      {in_bed("<angen:home/>"), "write it in the <world>"},
      {in_world("<angen:thing>bed</angen:thing>"), "write it in a <model>"},
      {site("<angen:latitude>91</angen:latitude>"), "at most 90 deg"},
      {site("<angen:north>north</angen:north>"), "<angen:north>"},
      {site("<angen:start>7:00</angen:start>"), "2026-03-21T07:00:00"},
      {site("<angen:start>2025-02-29T07:00:00</angen:start>"), "not a date"},
      {site("<angen:start>2025-02-28T24:00:00</angen:start>"), "not a date"},
      {in_world("<angen:home/><angen:home/>"), "a second <angen:home>"},
  };
  for (const Wrong& wrong : all) {
    const std::string problem = problem_of(wrong.text);
    EXPECT_NE(problem.find(wrong.says), std::string::npos) << wrong.text << "\n" << problem;
    EXPECT_NE(problem.find(":1: "), std::string::npos) << problem;  // the line
  }
}

TEST(Home, NamesAreKeptOrAnErrorWithALine) {
  const auto storey = [](const std::string& name) {
    return "<angen:storey name='" + name +
           "' number='0'><angen:elevation>0</angen:elevation></angen:storey>";
  };
  const auto opening = [](const std::string& name) {
    return "<angen:opening name='" + name +
           "'><angen:pose>1 2 0 1.5</angen:pose><angen:width>0.9</angen:width></angen:opening>";
  };
  const auto hall = [](const std::string& name) { return room(kSquare, name); };
  for (const std::string name : {"a/b", "Küche", "厨房", "a::b", "two words", "$x$"}) {
    const desc::World world =
        read(in_world(hall(name) + storey(name) + opening(name) + "<angen:home><angen:entrance>" +
                      name + "</angen:entrance></angen:home>"));
    EXPECT_EQ(world.home.rooms.at(0).name, name);
    EXPECT_EQ(world.home.storeys.at(0).name, name);
    EXPECT_EQ(world.home.openings.at(0).name, name);
    EXPECT_EQ(world.site.entrance, name);
    EXPECT_EQ(read(save(world, {})).home.rooms.at(0).name, name);
  }
  EXPECT_EQ(read(in_world(storey(""))).home.storeys.at(0).name, "");  // "Floor 0"
  const std::string long_name(10'000, 'a');
  const std::pair<std::string, std::string> wrong[] = {{"  ", "begins or ends with a blank"},
                                                       {" hall", "begins or ends with a blank"},
                                                       {"a&#10;b", "contains a control character"},
                                                       {long_name, "has 10000 bytes"}};
  for (const auto& [name, says] : wrong) {
    for (const std::string& part :
         {hall(name), storey(name), opening(name),
          "<angen:home><angen:entrance>" + name + "</angen:entrance></angen:home>"}) {
      if (part.find("entrance") != std::string::npos && name.front() == ' ') continue;  // trimmed
      const std::string problem = problem_of(in_world(part));
      EXPECT_NE(problem.find(says), std::string::npos) << part.substr(0, 99) << "\n" << problem;
      EXPECT_NE(problem.find(":1: "), std::string::npos) << problem.substr(0, 99);
      EXPECT_LT(problem.size(), 1000U);
    }
  }
  for (const std::string& part : {opening("o") + opening("o"), storey("s") + storey("s")}) {
    EXPECT_NE(problem_of(in_world(part)).find("is given twice"), std::string::npos);
  }
}

TEST(Home, IsKeptBySave) {
  const std::string text =
      in_world("<angen:home><angen:entrance>front</angen:entrance></angen:home>" + room(kSquare) +
               "<model name='m'><link name='l'/><angen:thing>bed</angen:thing>"
               "<angen:place posture='lie'>1 0 0.5 0</angen:place></model>");
  const desc::World world = read(text);
  const desc::World again = read(save(world, {{&world.models[0], world.models[0].pose, {}}}));
  EXPECT_EQ(again.site.entrance, "front");
  EXPECT_EQ(again.home.rooms.at(0).outline, world.home.rooms.at(0).outline);
  EXPECT_EQ(again.models.at(0).home.thing, "bed");
  EXPECT_EQ(again.models.at(0).home.places.at(0).pose.position, Vec3(1.0, 0.0, 0.5));
}

}  // namespace
}  // namespace angen::load

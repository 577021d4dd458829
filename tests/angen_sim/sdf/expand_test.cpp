#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

TEST(Expand, WithTwoNamesIsRejected) {
  const Folder folder;
  folder.model("part", sdf("<model name='p'><link name='l'/></model>"));
  for (const std::string twice : {"name", "uri", "pose", "static"}) {
    const std::string value = twice == "pose" ? "0 0 0 0 0 0" : "0";
    std::string text = "<include><uri>model://part</uri>";
    if (twice != "uri") text += "<" + twice + ">" + value + "</" + twice + ">";
    text += "\n<" + twice + ">" + value + "</" + twice + "></include>";
    const std::string message = error_of(in_world(text), folder.paths());
    EXPECT_EQ(message.find("w.world:2: a second <" + twice + "> in one <include>"), 0U) << message;
    EXPECT_THROW(model(text, "asked", {}, folder.paths()), Error) << "a spawned model";
  }
}

const char* const kInclude = "<include><uri>model://part</uri></include>";

TEST(Expand, NamesTheIncludedFile) {
  const Folder folder;
  const std::string file = folder.model(
      "part", sdf("<model name='m'><link name='l'><inertial>\n<mass>-2</mass></inertial></link>"
                  "</model>"));
  const std::string message = error_of(in_world(kInclude), folder.paths());
  EXPECT_EQ(message.find(file + ":2: "), 0U) << message;
  EXPECT_NE(message.find("the mass is -2 kg"), std::string::npos) << message;
}

TEST(Expand, TruncatedFileIsNamed) {
  const Folder folder;
  const std::string file = folder.model("part", "<sdf version='1.6'>\n<model name='m'>\n<link");
  const std::string message = error_of(in_world(kInclude), folder.paths());
  EXPECT_EQ(message.find(file + ":3: "), 0U) << message;
}

TEST(Expand, CycleEndsWithItsPlace) {
  const Folder folder;
  const std::string other = folder.model(
      "other", sdf("<model name='o'><link name='l'/>\n<include><uri>model://part</uri></include>"
                   "</model>"));
  folder.model("part",
               sdf("<model name='m'><link name='l'/><include><uri>model://other</uri></include>"
                   "</model>"));
  const std::string message = error_of(in_world(kInclude), folder.paths());
  EXPECT_EQ(message.find(other + ":2: "), 0U) << message;
  EXPECT_NE(message.find("cycle of includes"), std::string::npos) << message;
}

TEST(Expand, DepthIsBounded) {
  const Folder folder;
  for (int i = 0; i < 20; ++i) {
    folder.model("part" + (i == 0 ? "" : std::to_string(i)),
                 sdf("<model name='m" + std::to_string(i) +
                     "'><link name='l'/><include><uri>"
                     "model://part" +
                     std::to_string(i + 1) + "</uri></include></model>"));
  }
  EXPECT_NE(error_of(in_world(kInclude), folder.paths()).find("more than 16 deep"),
            std::string::npos);
}

TEST(Expand, DoublingIsBounded) {
  const Folder folder;
  std::string filler;
  for (int i = 0; i < 100; ++i) filler += "<frame name='f" + std::to_string(i) + "'/>";
  for (int i = 0; i < 14; ++i) {
    const std::string next = "model://part" + std::to_string(i + 1);
    folder.model(
        "part" + (i == 0 ? "" : std::to_string(i)),
        sdf("<model name='m'><link name='l'/>" + filler + "<include><name>a</name><uri>" + next +
            "</uri></include><include><name>b</name><uri>" + next + "</uri></include></model>"));
  }
  folder.model("part14", sdf("<model name='m'><link name='l'/>" + filler + "</model>"));
  EXPECT_NE(error_of(in_world(kInclude), folder.paths()).find("more than 20000 elements"),
            std::string::npos);
}

TEST(Expand, FileWithoutAModel) {
  const Folder folder;
  const std::string file = folder.model("part", sdf("<world name='w'/>"));
  EXPECT_EQ(error_of(in_world(kInclude), folder.paths()).find(file + ":1: "), 0U);
}

TEST(Expand, ConfigThatNamesNoFile) {
  const Folder folder;
  const std::string file =
      folder.write("part/model.config", "<model>\n<sdf version='1.6'>nothing.sdf</sdf></model>");
  const std::string message = error_of(in_world(kInclude), folder.paths());
  EXPECT_EQ(message.find(file + ":2: "), 0U) << message;
}

}  // namespace
}  // namespace angen::load

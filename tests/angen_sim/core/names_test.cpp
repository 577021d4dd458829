#include "core/names.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(Name, MayBeAnyPlainText) {
  for (const char* name : {"p1", "Küche 2", "机器人", "a.b", "a:b", "cafe table", "_", "World"}) {
    EXPECT_EQ(name_problem(name), "");
    EXPECT_NO_THROW(check_name(name));
  }
  EXPECT_EQ(name_problem(std::string(kMaxNameBytes, 'n')), "");
}

TEST(Name, OfAnotherFormSaysWhatIsWrong) {
  const std::pair<std::string, const char*> wrong[] = {
      {"", "is empty"},
      {"a\xff", "'a?' is not UTF-8"},
      {std::string(kMaxNameBytes + 1, 'n'), "has 256 bytes"},
      {"a::b", "'::'"},
      {"a/b", "'/'"},
      {"a\nb", "'a?b' contains a control character"},
      {"a\x7f", "control character"},
      {"a\xc2\x85", "control character"},
      {std::string("a\0b", 3), "control character"},
      {" a", "blank"},
      {"a ", "blank"},
      {" ", "blank"},
      {"world", "reserved"},
      {"__model__", "reserved"}};
  for (const auto& [name, part] : wrong) {
    EXPECT_NE(name_problem(name).find(part), std::string::npos) << name_problem(name);
  }
}

TEST(Label, HasTheRuleWithoutWhatSeparatesTopics) {
  for (const char* label : {"", "gz::sim::systems::Physics", "a/b", "world", " a"}) {
    EXPECT_EQ(label_problem(label), "");
  }
  for (const std::string& label :
       {std::string(kMaxNameBytes + 1, 'n'), std::string("a\xff"), std::string("a\nb")}) {
    EXPECT_NE(label_problem(label), "");
  }
}

TEST(Name, IsRejectedWithWhatBearsItAndItsPlace) {
  try {
    check_name("a/b", "<link>", {"a.world", 3});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).rfind("a.world:3: <link>: the name 'a/b' contains '/'", 0),
              0U)
        << error.what();
  }
}

}  // namespace
}  // namespace angen

#include "plugin/saved_params.h"

#include <gtest/gtest.h>

#include "plugin/params.h"

namespace angen {
namespace {

Element child(const std::string& name, const std::string& text) {
  Element element;
  element.name = name;
  element.text = text;
  return element;
}

TEST(SavedParams, TakeThePlaceOfWhatThePluginHad) {
  Element plugin;
  plugin.source = {"w.world", 7};
  plugin.children = {child("level", "1"), child("row", "1 2"), child("row", "3 4"),
                     child("other", "x"), child("old", "y")};
  SavedParams saved;
  saved.number("level", 0.25);
  saved.row("row", {5.0, 6.5});
  saved.flag("on", true);
  saved.unset("old");
  saved.write_to(plugin);
  Params params(plugin);
  EXPECT_EQ(params.number("level", 0.0, "", ""), 0.25);
  EXPECT_EQ(params.rows("row", 2, "", ""), (std::vector<std::vector<double>>{{5.0, 6.5}}));
  EXPECT_TRUE(params.flag("on", false, ""));
  EXPECT_EQ(params.text("other", "", ""), "x");
  EXPECT_FALSE(params.has("old"));
  EXPECT_EQ(plugin.children.back().source.line, 7);
}

TEST(SavedParams, DifferWhereAnyDoes) {
  SavedParams a, b;
  EXPECT_TRUE(a == b);
  a.number("level", 0.1);
  EXPECT_FALSE(a == b);
  b.number("level", 0.1);
  EXPECT_TRUE(a == b);
  b.unset("old");
  EXPECT_FALSE(a == b);
}

}  // namespace
}  // namespace angen

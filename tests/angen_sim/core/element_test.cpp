#include "core/element.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(Element, FindsChildrenAndAttributes) {
  Element e;
  e.attributes = {{"k", "v"}};
  e.children.resize(1);
  e.children[0].name = "c";
  EXPECT_EQ(e.child("c"), &e.children[0]);
  EXPECT_EQ(e.child("d"), nullptr);
  EXPECT_EQ(*e.attribute("k"), "v");
  EXPECT_EQ(e.attribute("x"), nullptr);
}

}  // namespace
}  // namespace angen

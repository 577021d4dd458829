#include "ros/wire.h"

#include <gtest/gtest.h>
#include <ros/names.h>

#include <set>
#include <string>
#include <vector>

namespace angen::node {
namespace {

TEST(Wire, TopicsAreGraphNames) {
  EXPECT_EQ(topic_of("pir", "kitchen0"), "/angen/pir/kitchen0");
  EXPECT_EQ(topic_of("pir", "my pir-1"), "/angen/pir/my_x20pir_x2d1");
  EXPECT_EQ(topic_of("pir", "p", "/scan"), "/scan");
  EXPECT_EQ(topic_of("pir", "p", "scan"), "scan");
  EXPECT_EQ(graph_name("1st"), "a1st");
  EXPECT_EQ(graph_name("/a//b/"), "/a/b");
}

TEST(Wire, DifferentNamesHaveDifferentTopics) {
  const std::vector<std::string> names = {"a_b",  "a.b",      "a b",       "a-b",        "a_x2eb",
                                          "a_xb", "a_x2Eb",   "a_x5fx2eb", "a__x2eb",    "A_b",
                                          "ä",    "_xc3_xa4", "_x2",       "a_x2e_x2eb", "a_x2e.b"};
  std::set<std::string> topics;
  for (const std::string& name : names) {
    const std::string topic = topic_of("pir", name);
    EXPECT_TRUE(topics.insert(topic).second) << name << " as " << topic;
    std::string error;
    EXPECT_TRUE(ros::names::validate(topic, error)) << error;
  }
}

}  // namespace
}  // namespace angen::node

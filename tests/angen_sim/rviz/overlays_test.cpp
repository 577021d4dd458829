#include "rviz/overlays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "angen_sim/sim/household.h"

namespace angen::node {
namespace {

/// The display of rviz after the arrays that it got.
class Screen {
 public:
  void take(const Overlays::Array& array) {
    using visualization_msgs::Marker;
    for (const Marker& marker : array.markers) {
      const std::pair<std::string, int> key{marker.ns, marker.id};
      if (marker.action == Marker::DELETE) {
        EXPECT_EQ(shown_.erase(key), 1U) << marker.ns << " " << marker.id;
      } else {
        shown_[key] = marker;
      }
    }
  }

  /// All but numbers, and ends of rays, which are drawn again only where they differ by some cm.
  std::vector<std::string> content() const {
    std::vector<std::string> all;
    for (const auto& [key, marker] : shown_) {
      std::ostringstream text;
      text << key.first << "|" << marker.type << "|" << marker.text << "|" << marker.color.r << "|"
           << marker.pose << marker.scale;
      all.push_back(text.str());
    }
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  std::map<std::pair<std::string, int>, visualization_msgs::Marker> shown_;
};

/// Overlays that follow a simulation, and what rviz shows of them.
class Followed {
 public:
  explicit Followed(sim::Simulation& simulation) : simulation_(simulation) { follow(); }

  void follow() {
    const std::shared_ptr<const sim::Snapshot> snapshot = simulation_.tick();
    Overlays::Array array;
    if (snapshot->structure != structure_) {
      const Changes changes = changes_between(structure_.get(), *snapshot->structure);
      overlays_.on_structure(*snapshot->structure, changes, array);
      structure_ = snapshot->structure;
      for (auto& marker : array.markers) marker.action = visualization_msgs::Marker::DELETE;
    }
    overlays_.append(*snapshot, false, array);
    screen_.take(array);
  }

  std::vector<std::string> content() const { return screen_.content(); }

 private:
  sim::Simulation& simulation_;
  std::shared_ptr<const sim::Structure> structure_;
  std::int32_t next_id_ = 0;
  Readings readings_;
  Overlays overlays_{next_id_, readings_};
  Screen screen_;
};

/// The markers of new overlays.
std::vector<std::string> markers_of_new(const sim::Snapshot& snapshot) {
  std::int32_t next_id = 0;
  Readings readings;
  Overlays overlays(next_id, readings);
  Overlays::Array array;
  overlays.on_structure(*snapshot.structure, changes_between(nullptr, *snapshot.structure), array);
  overlays.append(snapshot, true, array);
  Screen screen;
  screen.take(array);
  return screen.content();
}

/// A room of 4 m by 3 m, and links enough for a building.
std::string house(const std::string& name, const std::string& pose) {
  std::string text = "<model name='" + name + "'><static>true</static><pose>" + pose + "</pose>";
  for (int i = 0; i < 11; ++i) text += "<link name='wall_" + std::to_string(i) + "'/>";
  return text +
         "<link name='floor_hall'><visual name='v'><geometry><box><size>4 3 0.1</size></box>"
         "</geometry></visual></link></model>";
}

sim::Spawn spawn(const std::string& xml, const std::string& name, const Vec3& at) {
  return {load::model(xml, name, Pose{at, Quat::Identity()}, {})};
}

std::string pir(const std::string& name) {
  return sim::body(name, "<box><size>0.1 0.1 0.1</size></box>", "0 0 1 0 0 0", true,
                   sim::ray_sensor("eye", sim::kPir, 10, 0.01));
}

TEST(Overlays, ThatFollowChangesShowWhatNewOnesShow) {
  sim::Simulation simulation(load::world_from_text(sim::text_of_household(), "text", {}), 3,
                             std::make_shared<Catalog>());
  Followed followed(simulation);
  const auto check = [&](const std::string& after) {
    for (int i = 0; i < 300; ++i) followed.follow();
    EXPECT_EQ(followed.content(), markers_of_new(*simulation.snapshot())) << after;
  };
  const auto change = [&](sim::Action action, const std::string& what) {
    auto answer = simulation.post(std::move(action));
    followed.follow();
    const sim::Outcome outcome = answer.get();
    ASSERT_TRUE(outcome.ok) << what << ": " << outcome.message;
    check(what);
  };
  check("the start");
  EXPECT_GT(followed.content().size(), 5U);
  change(spawn(pir("a"), "a", {1, 1, 1}), "a sensor");
  change(spawn(pir("b"), "b", {-1, 1, 1}), "another");
  change(spawn(house("h", "0 0 0 0 0 0"), "h", {0, 0, 0}), "a room");
  change(sim::ToDevice{"lamp", "all", {"On", {}, "", 0.0}}, "light");
  change(spawn(sim::kLamp, "lamp1", {0.5, 0, 2.5}), "a lamp");
  change(sim::Delete{"a"}, "without the first");
  change(spawn(pir("a"), "a", {2, 1, 5}), "the first again, on another floor");
  change(sim::Delete{"hall_lamp"}, "without the lit lamp");
  change(sim::Delete{"h"}, "without the room");
  change(sim::Delete{"hall_door"}, "without the door");
  change(sim::Reset{true}, "a reset");
}

TEST(Overlays, OneThatStaysIsNotSentAgain) {
  sim::Simulation simulation(load::world_from_text(sim::text_of_household(), "text", {}), 3,
                             std::make_shared<Catalog>());
  const auto before = simulation.tick();
  std::int32_t next_id = 0;
  Readings readings;
  Overlays overlays(next_id, readings);
  Overlays::Array array;
  overlays.on_structure(*before->structure, changes_between(nullptr, *before->structure), array);
  overlays.append(*before, true, array);
  array.markers.clear();
  simulation.post(spawn(sim::kLamp, "lamp1", {0.5, 0, 2.5}));
  const auto after = simulation.tick();
  overlays.on_structure(*after->structure,
                        changes_between(before->structure.get(), *after->structure), array);
  EXPECT_TRUE(array.markers.empty());
  overlays.append(*after, false, array);
  const auto sent = [&](const std::string& ns) {
    return std::count_if(array.markers.begin(), array.markers.end(),
                         [&](const auto& marker) { return marker.ns.rfind(ns, 0) == 0; });
  };
  EXPECT_EQ(sent("lights"), 1);
  EXPECT_EQ(sent("labels 0"), 1);  // not those of who walks
  EXPECT_EQ(sent("door labels"), 0);
}

}  // namespace
}  // namespace angen::node

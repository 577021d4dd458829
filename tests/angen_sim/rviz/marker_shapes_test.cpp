// Rays as rviz draws them are those that the sensor casts.
#include <gtest/gtest.h>

#include <set>

#include "angen_sim/sim/room.h"
#include "rviz/overlays.h"

namespace angen::node {
namespace {

const std::string kLidar = "libgazebo_ros_laser.so";

/// A world with one sensor at 0 0 1 and a wall 3 m in front of it.
std::string facing_a_wall(const std::string& library, const std::string& ray,
                          const std::string& parameters) {
  return "<sdf version='1.6'><world name='w'>" +
         sim::body("wall", "<box><size>0.2 40 40</size></box>", "3.1 0 0 0 0 0", true) +
         sim::body("eye", "<box><size>0.01 0.01 0.01</size></box>", "-0.1 0 1 0 0 0", true,
                   "<sensor name='s' type='ray'><pose>0.1 0 0 0 0 0</pose><update_rate>10"
                   "</update_rate>" +
                       ray + "<plugin name='p' filename='" + library + "'>" + parameters +
                       "</plugin></sensor>") +
         "</world></sdf>";
}

/// A sensor's rays as rviz has them.
class Drawn {
 public:
  explicit Drawn(const std::string& world)
      : simulation_(load::world_from_text(world, "text", {}), 3, std::make_shared<Catalog>()) {
    const auto snapshot = simulation_.tick();
    overlays_.on_structure(*snapshot->structure, changes_between(nullptr, *snapshot->structure),
                           array_);
    overlays_.append(*snapshot, true, array_);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) overlays_.append(*simulation_.tick(), false, array_);
  }
  /// Ends of the rays, in the sensor's frame.
  std::vector<Vec3> ends() const {
    std::vector<Vec3> ends;
    for (const visualization_msgs::Marker& marker : array_.markers) {
      if (marker.type != visualization_msgs::Marker::LINE_LIST) continue;
      ends.clear();  // the last one holds
      for (std::size_t i = 1; i < marker.points.size(); i += 2) {
        ends.emplace_back(marker.points[i].x, marker.points[i].y, marker.points[i].z);
      }
    }
    return ends;
  }
  const sim::SensorEntry& sensor() const { return simulation_.snapshot()->structure->sensors[0]; }

 private:
  sim::Simulation simulation_;
  std::int32_t next_id_ = 0;
  Readings readings_;
  Overlays overlays_{next_id_, readings_};
  Overlays::Array array_;
};

TEST(Rays, APirWithoutRayHasItsDefaults) {
  Drawn drawn(facing_a_wall(sim::kPir, "", ""));
  EXPECT_EQ(drawn.ends().size(), 16U);
  drawn.run(200);
  for (const Vec3& end : drawn.ends()) EXPECT_NEAR(end.x(), 3.0, 1e-5);
}

TEST(Rays, APirMayHaveThemInItsPlugin) {
  const Drawn drawn(facing_a_wall(
      sim::kPir, "",
      "<ray><scan><horizontal><samples>3</samples><min_angle>-0.3</min_angle><max_angle>0.3"
      "</max_angle></horizontal></scan><range><max>2</max></range></ray>"));
  const std::vector<Vec3> ends = drawn.ends();
  ASSERT_EQ(ends.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const double yaw = -0.3 + 0.3 * i;
    EXPECT_LT((ends[i] - Vec3(2 * std::cos(yaw), 2 * std::sin(yaw), 0)).norm(), 1e-5);
  }
}

TEST(Rays, ThoseOfANoddingPirNod) {
  Drawn drawn(facing_a_wall(sim::kPir, "", sim::kNodding));
  std::set<int> heights;  // cm, at which the outermost ray hits the wall
  for (int scan = 0; scan < 12; ++scan) {
    drawn.run(100);
    const std::vector<Vec3> ends = drawn.ends();
    ASSERT_EQ(ends.size(), 16U);
    for (const Vec3& end : ends) EXPECT_NEAR(end.x(), 3.0, 1e-4) << "scan " << scan;
    heights.insert(static_cast<int>(std::lround(100 * ends[0].z())));
  }
  EXPECT_EQ(heights, (std::set<int>{-93, 0, 93}));  // level, up 0.3 rad, level, down
}

TEST(Rays, APyroelectricPirShowsARowAcrossItsZones) {
  const Drawn drawn(facing_a_wall(sim::kPir, "", "<model>pyroelectric</model>"));
  const std::vector<Vec3> ends = drawn.ends();
  ASSERT_EQ(ends.size(), 13U);
  for (const Vec3& end : ends) EXPECT_NEAR(end.norm(), 20.0, 1e-4);
}

TEST(Rays, ALidarSaysItsRays) {
  const Drawn with_defaults(facing_a_wall(kLidar, "", ""));
  ASSERT_NE(with_defaults.sensor().rays, nullptr);
  EXPECT_EQ(with_defaults.sensor().rays->size(), 360U);
  EXPECT_EQ(with_defaults.sensor().rays->max, 10.0);
  const Drawn drawn(facing_a_wall(kLidar, "<ray><range><max>4</max></range></ray>", ""));
  EXPECT_EQ(drawn.sensor().rays->max, 4.0);
  EXPECT_TRUE(drawn.ends().empty());  // rviz has a display for laser scans
}

}  // namespace
}  // namespace angen::node

#include "node/scene_message.h"

#include <gtest/gtest.h>

#include "angen_sim/sim/household.h"
#include "sdf/load.h"
#include "sim/simulation.h"

namespace angen::node {
namespace {

using angen_msgs::Scene;
using angen_msgs::SceneShape;

std::string visual(const std::string& name, const std::string& geometry, const std::string& pose) {
  return "<visual name='" + name + "'><pose>" + pose + "</pose><geometry>" + geometry +
         "</geometry><material><diffuse>0.1 0.2 0.3 0.5</diffuse></material></visual>";
}

const std::string kThing =
    "<model name='thing'><static>true</static><pose>1 2 3 0 0 1.5</pose><link name='part'>"
    "<pose>0.5 0 0 0 0 0</pose>" +
    visual("box", "<box><size>1 2 3</size></box>", "0 0 1 0 0 0") +
    visual("ball", "<sphere><radius>0.5</radius></sphere>", "0 0 0 0 0 0") +
    visual("pill", "<capsule><radius>0.25</radius><length>2</length></capsule>", "0 0 0 0 0 0") +
    "</link></model>";

std::string world() {
  std::string text = sim::text_of_household();
  const std::string end = "</world></sdf>";
  return text.replace(text.find(end), end.size(), kThing + end);
}

class SceneOfHousehold : public testing::Test {
 protected:
  SceneOfHousehold()
      : simulation_(load::world_from_text(world(), "text", {}), 3, std::make_shared<Catalog>()) {}

  Scene scene() {
    const std::shared_ptr<const sim::Snapshot> snapshot = simulation_.tick();
    return scene_message(*snapshot->structure, snapshot->link_poses);
  }

  static std::uint32_t link_of(const Scene& scene, const std::string& model,
                               const std::string& name) {
    for (std::uint32_t i = 0; i < scene.links.size(); ++i) {
      if (scene.links[i].model == model && scene.links[i].name == name) return i;
    }
    ADD_FAILURE() << model << " " << name;
    return 0;
  }

  sim::Simulation simulation_;
};

TEST_F(SceneOfHousehold, ShapesHaveTheSizesOfTheDescription) {
  const Scene all = scene();
  const std::uint32_t part = link_of(all, "thing", "part");
  std::vector<SceneShape> shapes;
  for (const SceneShape& shape : all.shapes) {
    if (shape.link == part) shapes.push_back(shape);
  }
  ASSERT_EQ(shapes.size(), 5U);  // a capsule is a cylinder and two spheres
  EXPECT_EQ(shapes[0].type, SceneShape::BOX);
  EXPECT_DOUBLE_EQ(shapes[0].size.y, 2.0);
  EXPECT_DOUBLE_EQ(shapes[0].pose.position.z, 1.0);
  EXPECT_FLOAT_EQ(shapes[0].color.b, 0.3F);
  EXPECT_FLOAT_EQ(shapes[0].color.a, 0.5F);
  EXPECT_EQ(shapes[1].type, SceneShape::SPHERE);
  EXPECT_DOUBLE_EQ(shapes[1].size.x, 1.0);
  EXPECT_EQ(shapes[2].type, SceneShape::CYLINDER);
  EXPECT_DOUBLE_EQ(shapes[2].size.z, 2.0);
  EXPECT_DOUBLE_EQ(shapes[4].pose.position.z, 1.0);
  EXPECT_FALSE(all.links[part].moves);
  EXPECT_NEAR(all.links[part].pose.position.x, 1.0 + 0.5 * std::cos(1.5), 1e-9);
  EXPECT_NEAR(all.links[part].pose.position.y, 2.0 + 0.5 * std::sin(1.5), 1e-9);
}

TEST_F(SceneOfHousehold, LinksAreAsInTheStructure) {
  const Scene all = scene();
  EXPECT_EQ(all.links.size(), simulation_.snapshot()->structure->links.size());
  EXPECT_TRUE(all.links[link_of(all, "hall_door", "leaf")].moves);
  EXPECT_EQ(all.links[link_of(all, "hall_door", "leaf")].group, "doors 0");
}

TEST_F(SceneOfHousehold, LampsAndSensorsAreOnTheirLinks) {
  const Scene all = scene();
  bool lamp = false;
  for (const angen_msgs::SceneLight& light : all.lights) {
    if (light.model != "hall_lamp") continue;
    lamp = true;
    EXPECT_EQ(all.links[static_cast<std::size_t>(light.link)].model, "hall_lamp");
    EXPECT_FALSE(light.directional);
  }
  EXPECT_TRUE(lamp);
  for (const angen_msgs::SceneSensor& sensor : all.sensors) {
    EXPECT_LT(sensor.link, all.links.size());
    EXPECT_GT(sensor.range, 0.0) << sensor.name;
  }
}

TEST_F(SceneOfHousehold, AMeshIsSentOnceForAllItsShapes) {
  TriangleMesh cube;
  cube.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  cube.triangles = {{0, 1, 2}};
  const auto shared = std::make_shared<const TriangleMesh>(cube);
  sim::Structure structure;
  auto made = std::make_shared<desc::Model>();
  made->name = "m";
  made->links.resize(1);
  for (int i = 0; i < 2; ++i) {
    desc::Visual visual;
    visual.shape.type = Shape::Type::kMesh;
    visual.shape.mesh = shared;
    made->links[0].visuals.push_back(visual);
  }
  structure.models = {made};
  sim::LinkEntry link;
  structure.links.push_back(link);
  sim::SharedArray<Pose> poses;
  poses.push_back(Pose{});
  const Scene all = scene_message(structure, poses);
  ASSERT_EQ(all.shapes.size(), 2U);
  ASSERT_EQ(all.meshes.size(), 1U);
  EXPECT_EQ(all.meshes[0].vertices.size(), 9U);
  EXPECT_EQ(all.meshes[0].triangles, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(all.shapes[1].mesh, 0U);
}

}  // namespace
}  // namespace angen::node

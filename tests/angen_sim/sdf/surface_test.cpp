#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "angen_sim/assets/pngs.h"
#include "core/texture.h"
#include "sdf/describe.h"

namespace angen::load {
namespace {

namespace fs = std::filesystem;

// Two triangles of one material each; the second one is three times as large.
const char* const kObj =
    "mtllib part.mtl\no near\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 0 0\nv 6 0 0\nv 3 1 0\n"
    "vt 0 0\nvt 1 0\nvt 0 1\nusemtl painted\nf 1/1 2/2 3/3\no far\nusemtl plain\nf 4/1 5/2 6/3\n";

class Painted : public testing::Test {
 protected:
  Painted() {
    folder_.write("part/meshes/part.obj", kObj);
    write_materials("map_Kd picture.png");
    write_picture("part/meshes/picture.png");
  }
  void write_materials(const std::string& map) {
    folder_.write("part/meshes/part.mtl",
                  "newmtl painted\nKd 0.5 0.5 0.5\n" + map + "\nnewmtl plain\nKd 0 0.5 1\n");
  }
  // Red above black.
  void write_picture(const std::string& name) {
    const fs::path path = folder_.path() + "/" + name;
    fs::create_directories(path.parent_path());
    fs::rename(png(folder_, 1, 2, {255, 0, 0, 0, 0, 0}, {8, PNG_COLOR_TYPE_RGB}), path);
  }
  desc::Visual visual(const std::string& geometry, const std::string& material = "") {
    desc::World world = read(
        in_link("<visual name='v'><geometry>" + geometry + "</geometry>" + material + "</visual>"),
        folder_.paths());
    warnings_.clear();
    for (const Diagnostic& warning : world.warnings) warnings_ += warning.text() + "\n";
    return world.models[0].links[0].visuals[0];
  }
  desc::Visual part(const std::string& more = "", const std::string& material = "") {
    return visual("<mesh><uri>model://part/meshes/part.obj</uri>" + more + "</mesh>", material);
  }
  void expect_untextured(const desc::Visual& visual, const std::string& warning) {
    ASSERT_EQ(visual.material.textures.size(), 2U);
    EXPECT_EQ(visual.material.textures[0], nullptr);
    EXPECT_NE(warnings_.find(warning), std::string::npos) << warnings_;
  }

  Folder folder_;
  std::string warnings_;
};

TEST_F(Painted, AMeshHasTheColorsAndTexturesOfItsFile) {
  const desc::Visual painted = part();
  EXPECT_EQ(warnings_, "");
  const MeshLook& look = *painted.material.look;
  ASSERT_EQ(look.parts.size(), 2U);
  EXPECT_EQ(look.parts[1].first, 1U);
  EXPECT_TRUE(look.parts[1].color.isApprox(Eigen::Vector4f(0.0F, 0.5F, 1.0F, 1.0F)));
  ASSERT_EQ(painted.material.textures.size(), 2U);
  EXPECT_EQ(painted.material.textures[1], nullptr);
  EXPECT_EQ(painted.material.textures[0]->height, 2U);
  EXPECT_EQ(painted.material.textures[0]->bytes[0], 255);
  ASSERT_EQ(look.corners.size(), 2U);
  EXPECT_EQ(look.corners[0], (std::array<float, 6>{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(painted.shape.mesh->vertices.size(), 6U);
}

TEST_F(Painted, LightIsReflectedByTheMeanOfItsParts) {
  const Eigen::Vector4f color = part().material.diffuse;
  EXPECT_NEAR(color[0], 0.25 * 0.5, 1e-6);  // a quarter of the area, half of that red
  EXPECT_NEAR(color[1], 0.75 * 0.5, 1e-6);
  EXPECT_NEAR(color[2], 0.75, 1e-6);
  write_materials("");
  EXPECT_EQ(part().material.diffuse, desc::Material{}.diffuse) << "without textures as before";
}

TEST_F(Painted, AMaterialOfTheVisualHolds) {
  const desc::Visual painted = part("", "<material><diffuse>0 1 0 1</diffuse></material>");
  EXPECT_EQ(painted.material.look, nullptr);
  EXPECT_TRUE(painted.material.textures.empty());
  EXPECT_TRUE(painted.material.diffuse.isApprox(Eigen::Vector4f(0, 1, 0, 1)));
}

TEST_F(Painted, TexturesAreFoundWhereModelsHaveThem) {
  fs::remove(folder_.path() + "/part/meshes/picture.png");
  write_picture("part/materials/textures/picture.png");
  EXPECT_NE(part().material.textures[0], nullptr);
  write_materials("map_Kd C:\\work\\picture.png");
  EXPECT_NE(part().material.textures[0], nullptr);
}

TEST_F(Painted, WhatIsMissingBrokenOrElsewhereIsAWarning) {
  const std::string picture = folder_.path() + "/part/meshes/picture.png";
  std::ofstream(picture) << "\x89PNG and no more";
  expect_untextured(part(), "texture " + picture + " is damaged");
  std::ofstream(picture) << "GIF89a";
  expect_untextured(part(), "is of an unknown kind; known are PNG and JPEG");
  fs::remove(picture);
  expect_untextured(part(), "texture 'picture.png' of ");
  ASSERT_EQ(mkfifo(picture.c_str(), 0600), 0);  // whoever opened it would wait for a writer
  expect_untextured(part(), "texture 'picture.png' of ");
  fs::remove(picture);
  const Folder elsewhere;
  const std::string outside = png(elsewhere, 1, 1, {255, 0, 0}, {8, PNG_COLOR_TYPE_RGB});
  write_materials("map_Kd " + outside);
  expect_untextured(part(), "it is outside of the allowed folders");
  fs::create_symlink(outside, picture);
  write_materials("map_Kd picture.png");
  expect_untextured(part(), "it is outside of the allowed folders");
}

TEST_F(Painted, MaterialsElsewhereAreNotRead) {
  const Folder elsewhere;
  elsewhere.write("out.mtl", "newmtl plain\nKd 1 0 0\n");
  fs::remove(folder_.path() + "/part/meshes/part.mtl");
  fs::create_symlink(elsewhere.path() + "/out.mtl", folder_.path() + "/part/meshes/part.mtl");
  const desc::Visual painted = part();
  EXPECT_NE(warnings_.find("materials "), std::string::npos) << warnings_;
  EXPECT_NE(painted.material.look->parts[1].color[0], 1.0F);
}

TEST_F(Painted, LargePicturesAreAveraged) {
  std::vector<unsigned> stripes;
  for (int i = 0; i < 1024 * 2; ++i) stripes.insert(stripes.end(), 3, i % 2 == 0 ? 0 : 255);
  fs::rename(png(folder_, 1024, 2, stripes, {8, PNG_COLOR_TYPE_RGB}),
             folder_.path() + "/part/meshes/picture.png");
  const desc::Visual painted = part();
  const Texture& texture = *painted.material.textures[0];
  EXPECT_EQ(texture.width, 512U);
  EXPECT_EQ(texture.height, 2U);
  EXPECT_EQ(texture.bytes[100], 188);  // half of the light
}

TEST_F(Painted, ASubmeshIsAPartOfTheMesh) {
  const desc::Visual far = part("<submesh><name>far</name></submesh>");
  ASSERT_EQ(far.shape.mesh->triangles.size(), 1U);
  EXPECT_EQ(far.shape.mesh->vertices[0].x(), 3.0F);
  EXPECT_EQ(far.shape.mesh_file, "") << "a viewer would show all of it";
  const desc::Visual middle = part("<submesh><name>far</name><center>true</center></submesh>");
  EXPECT_EQ(middle.shape.mesh->vertices[0].x(), -1.5F);
  EXPECT_EQ(middle.shape.mesh->vertices[2].y(), 0.5F);
  const std::string none = error_of(
      in_link("<collision name='c'><geometry><mesh><uri>model://part/meshes/part.obj</uri><submesh>"
              "<name>middle</name></submesh></mesh></geometry></collision>"),
      folder_.paths());
  EXPECT_NE(none.find("has no submesh 'middle'; it has "), std::string::npos) << none;
  EXPECT_NE(none.find("far"), std::string::npos) << none;
}

TEST_F(Painted, AnOgreScriptPaintsAnyShape) {
  folder_.write("part/materials/scripts/part.material",
                "// material Part/Box\nmaterial Part/Other\n{\n}\nmaterial \"Part/Box\" {\n"
                "  technique { pass {\n diffuse 0 1 0 1\n texture_unit {\n texture picture.png\n"
                "} } }\n}\nmaterial Part/Green\n{\n technique\n {\n pass\n {\n diffuse 0 1 0\n"
                " }\n }\n}\n");
  write_picture("part/materials/textures/picture.png");
  const auto box = [&](const std::string& name, const std::string& more = "") {
    return visual("<box><size>1 1 1</size></box>",
                  "<material><script><uri>model://part/materials/scripts</uri>"
                  "<uri>model://part/materials/textures</uri><name>" +
                      name + "</name></script>" + more + "</material>");
  };
  const desc::Visual painted = box("Part/Box", "<ambient>1 1 1 1</ambient>");
  EXPECT_EQ(warnings_, "");
  ASSERT_EQ(painted.material.textures.size(), 1U);
  EXPECT_TRUE(painted.material.diffuse.isApprox(Eigen::Vector4f(0.5F, 0, 0, 1)));
  EXPECT_TRUE(box("Part/Green").material.diffuse.isApprox(Eigen::Vector4f(0, 1, 0, 1)));
  EXPECT_EQ(warnings_, "");
  box("Part/Blue");
  EXPECT_NE(warnings_.find("unknown material 'Part/Blue'"), std::string::npos) << warnings_;
}

}  // namespace
}  // namespace angen::load

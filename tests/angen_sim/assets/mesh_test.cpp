#include "assets/mesh.h"

#include "angen_sim/sdf/texts.h"
#include "sdf/geometry.h"

namespace angen::load {
namespace {

// A right triangle in the file's own x-y plane, with its third corner one unit up z.
std::string triangle_collada(const std::string& up, const std::string& meter) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit name='u' meter='" +
         meter + "'/><up_axis>" + up +
         "</up_axis></asset><library_geometries><geometry id='g' name='g'><mesh><source id='p'>"
         "<float_array id='pa' count='9'>0 0 0 1 0 0 0 2 3</float_array><technique_common>"
         "<accessor source='#pa' count='3' stride='3'><param name='X' type='float'/>"
         "<param name='Y' type='float'/><param name='Z' "
         "type='float'/></accessor></technique_common>"
         "</source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
         "<triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p>"
         "</triangles></mesh></geometry></library_geometries><library_visual_scenes>"
         "<visual_scene id='s'><node id='n'><instance_geometry url='#g'/></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

// Gives the triangle the material 'm'.
void bind_material(std::string& text) {
  text.insert(text.find(" count='1'><input"), " material='M'");
  text.replace(text.find("<instance_geometry url='#g'/>"), 29,
               "<instance_geometry url='#g'><bind_material><technique_common>"
               "<instance_material symbol='M' target='#m'/></technique_common></bind_material>"
               "</instance_geometry>");
}

const char* const kStl =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 3\nendloop\n"
    "endfacet\nendsolid s\n";

Eigen::Vector3f corner(const TriangleMesh& mesh, int index) {
  return mesh.vertices.at(mesh.triangles.at(0)[static_cast<std::size_t>(index)]);
}

// As in Gazebo 11, whose ColladaLoader reads no <up_axis>.
TEST(Mesh, ColladaUpAxisTurnsNothing) {
  const Folder folder;
  for (const std::string up : {"X_UP", "Y_UP", "Z_UP", ""}) {
    const auto mesh =
        read_mesh({folder.write(up + "u.dae", triangle_collada(up, "1")), Vec3::Ones()}, {})
            .triangles;
    EXPECT_LT((corner(*mesh, 2) - Eigen::Vector3f(0, 2, 3)).norm(), 1e-5) << up;
  }
}

TEST(Mesh, ColladaUnitIsApplied) {
  const Folder folder;
  const auto mesh =
      read_mesh({folder.write("i.dae", triangle_collada("Z_UP", "0.01")), Vec3::Ones()}, {})
          .triangles;
  EXPECT_LT((corner(*mesh, 2) - Eigen::Vector3f(0, 0.02F, 0.03F)).norm(), 1e-6);
}

TEST(Mesh, ColladaMayHaveBlanksBeforeAColor) {
  const Folder folder;
  std::string text = triangle_collada("Z_UP", "1");
  text.insert(
      text.find("<library_geometries>"),
      "<library_effects><effect id='e'><profile_COMMON><technique sid='t'><lambert><diffuse>"
      "<color sid='d'>\r\n \t0.25 0.5 0.75 1</color></diffuse></lambert></technique>"
      "</profile_COMMON></effect></library_effects><library_materials><material id='m'>"
      "<instance_effect url='#e'/></material></library_materials>");
  bind_material(text);
  const ReadMesh mesh = read_mesh({folder.write("c.dae", text), Vec3::Ones()}, {});
  EXPECT_LT((corner(*mesh.triangles, 2) - Eigen::Vector3f(0, 2, 3)).norm(), 1e-5);
  EXPECT_EQ(mesh.look->parts.at(0).color, Eigen::Vector4f(0.25F, 0.5F, 0.75F, 1.0F));
}

// As in Gazebo, where such a part has no texture.
TEST(Mesh, ColladaMayHaveAnImageWithoutAFile) {
  const Folder folder;
  for (const std::string image :
       {"<image id='tray_png'><!--<init_from>tray.png</init_from>--></image>",
        "<image name='tray' id='tray_png'/>"}) {
    std::string text = triangle_collada("Z_UP", "1");
    text.insert(text.find("<library_geometries>"),
                "<library_images>" + image +
                    "</library_images><library_effects><effect id='e'><profile_COMMON>"
                    "<newparam sid='f'><surface type='2D'><init_from>tray_png</init_from></surface>"
                    "</newparam><newparam sid='r'><sampler2D><source>f</source></sampler2D>"
                    "</newparam><technique sid='t'><lambert><diffuse><texture texture='r' "
                    "texcoord='u'/></diffuse></lambert></technique></profile_COMMON></effect>"
                    "</library_effects><library_materials><material id='m'><instance_effect "
                    "url='#e'/></material></library_materials>");
    bind_material(text);
    const ReadMesh mesh = read_mesh({folder.write("i.dae", text), Vec3::Ones()}, {});
    EXPECT_LT((corner(*mesh.triangles, 2) - Eigen::Vector3f(0, 2, 3)).norm(), 1e-5) << image;
  }
}

// As Gazebo names submeshes: by the node's name, or by that of a node around it.
TEST(Mesh, ColladaSubmeshesHaveTheNamesOfNodes) {
  const Folder folder;
  for (const std::string opening :
       {"<node id='node-part' name='part'>", "<node id='n' name='part'><node id='inner'>"}) {
    std::string text = triangle_collada("Z_UP", "1");
    text.replace(text.find("<node id='n'>"), 13, opening);
    if (opening.find("inner") != std::string::npos) text.insert(text.find("</node>"), "</node>");
    const std::string file = folder.write("part.dae", text);
    EXPECT_EQ(read_mesh({file, Vec3::Ones(), "part"}, {}).triangles->triangles.size(), 1U);
    EXPECT_THROW(read_mesh({file, Vec3::Ones(), "other"}, {}), Error);
  }
}

TEST(Mesh, StlIsScaled) {
  const Folder folder;
  const auto mesh = read_mesh({folder.write("s.stl", kStl), {1.0, 2.0, 3.0}}, {}).triangles;
  EXPECT_LT((corner(*mesh, 2) - Eigen::Vector3f(0, 4, 9)).norm(), 1e-5);
}

TEST(Mesh, MirroringKeepsTheOutside) {
  const Folder folder;
  const auto mesh = read_mesh({folder.write("s.stl", kStl), {-1.0, 1.0, 1.0}}, {}).triangles;
  const auto normal =
      (corner(*mesh, 1) - corner(*mesh, 0)).cross(corner(*mesh, 2) - corner(*mesh, 0));
  EXPECT_GT(normal.z(), 0.0F);
}

TEST(Mesh, IsSharedWhileTheFileStays) {
  const Folder folder;
  const std::string file = folder.write("s.stl", kStl);
  const auto first = read_mesh({file, Vec3::Ones()}, {}).triangles;
  EXPECT_EQ(first, read_mesh({file, Vec3::Ones()}, {}).triangles);
  EXPECT_NE(first, read_mesh({file, {2.0, 2.0, 2.0}}, {}).triangles);
}

TEST(Mesh, BesideItsModelAndOnTheResourcePath) {
  const Folder folder;
  folder.write("part/meshes/s.stl", kStl);
  const auto shape = [&](const std::string& uri, const SearchPaths& paths) {
    return read(in_link("<visual name='v'><geometry><mesh><uri>" + uri +
                        "</uri><scale>1 1 2</scale></mesh></geometry></visual>"),
                paths)
        .models[0]
        .links[0]
        .visuals[0]
        .shape;
  };
  const Shape by_model = shape("model://part/meshes/s.stl", folder.paths());
  EXPECT_EQ(by_model.type, Shape::Type::kMesh);
  EXPECT_EQ(by_model.mesh_file, folder.path() + "/part/meshes/s.stl");
  expect_near(by_model.mesh_scale, {1.0, 1.0, 2.0});
  EXPECT_EQ(by_model.mesh->triangles.size(), 1U);
  EXPECT_EQ(shape("file://meshes/s.stl", {{}, {folder.path() + "/part"}}).mesh, by_model.mesh);
  folder.model("other", sdf("<model name='o'><link name='l'><visual name='v'><geometry><mesh><uri>"
                            "meshes/s.stl</uri></mesh></geometry></visual></link></model>"));
  folder.write("other/meshes/s.stl", kStl);
  const desc::World w =
      read(in_world("<include><uri>model://other</uri></include>"), folder.paths());
  EXPECT_EQ(w.models[0].links[0].visuals[0].shape.mesh_file, folder.path() + "/other/meshes/s.stl");
}

TEST(Mesh, NoTrianglesOrUnknownKindIsAnError) {
  const Folder folder;
  EXPECT_THROW(read_mesh({folder.write("x.blend", "x"), Vec3::Ones()}, {}).triangles, Error);
  EXPECT_THROW(read_mesh({folder.write("x.stl", ""), Vec3::Ones()}, {}).triangles, Error);
  EXPECT_THROW(read_mesh({folder.write("x.dae", "<COLLADA"), Vec3::Ones()}, {}).triangles, Error);
}

}  // namespace
}  // namespace angen::load

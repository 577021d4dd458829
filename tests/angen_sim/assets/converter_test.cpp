// Damaged and hostile meshes: each is an error of the file that names it, and the process
// continues.
#include "assets/converter.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include "angen_sim/assets/pngs.h"
#include "assets/mesh.h"
#include "document/xml.h"
#include "sdf/geometry.h"

namespace angen::load {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // then memory has no limit
#else
constexpr bool kSanitized = false;
#endif

class HostileMesh : public testing::Test {
 protected:
  /// The error of a world with this mesh.
  std::string complaint(const std::string& name, const std::string& text) {
    folder_.write("part/" + name, text);
    return error_of(in_link("\n<visual name='v'><geometry><mesh><uri>model://part/" + name +
                            "</uri></mesh></geometry></visual>"),
                    folder_.paths());
  }

  Folder folder_;
};

void expect_error(const std::string& error, const std::string& words) {
  EXPECT_EQ(error.find("w.world:2: mesh "), 0U) << error;
  EXPECT_NE(error.find(words), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

std::string collada(const std::string& nodes, const std::string& scene,
                    const std::string& count = "9", const std::string& images = "") {
  return "<?xml version='1.0'?>\n<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit name='m' meter='1'/><up_axis>Z_UP</up_axis></asset>" +
         images +
         "<library_geometries><geometry id='g' name='g'><mesh><source id='p'>"
         "<float_array id='pa' count='" +
         count +
         "'>0 0 0 1 0 0 0 2 3</float_array><technique_common>"
         "<accessor source='#pa' count='3' stride='3'><param name='X' type='float'/>"
         "<param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
         "</technique_common></source><vertices id='v'><input semantic='POSITION' source='#p'/>"
         "</vertices><triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
         "<p>0 1 2</p></triangles></mesh></geometry></library_geometries>\n<library_nodes>" +
         nodes + "</library_nodes>\n<library_visual_scenes><visual_scene id='s'>" + scene +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene>"
         "</COLLADA>";
}

std::string node(const std::string& id, const std::string& inside) {
  return "<node id='" + id + "' name='" + id + "'>" + inside + "</node>";
}
std::string instance(const std::string& id) { return "<instance_node url='#" + id + "'/>"; }

const char* const kShape = "<instance_geometry url='#g'/>";

TEST_F(HostileMesh, ACycleOfNodesByTheirIdsOrNames) {
  expect_error(complaint("self.dae", collada("", node("a", kShape + instance("a")))),
               "the node 'a' instances itself");
  const std::string nodes =
      node("a", instance("b")) + node("b", instance("c")) + node("c", kShape + instance("a"));
  expect_error(complaint("cycle.dae", collada(nodes, node("n", instance("a")))),
               "instances itself");
  const std::string inner =
      "<node name='loop'>" + std::string(kShape) + instance("loop") + "</node>";
  expect_error(complaint("name.dae", collada(inner, node("n", instance("loop")))),
               "instances itself");
}

// 30 levels of two: 2^30 shapes from 4 kB.
TEST_F(HostileMesh, DoublingInstances) {
  std::string nodes = node("n0", kShape);
  for (int i = 1; i <= 30; ++i) {
    const std::string below = "n" + std::to_string(i - 1);
    nodes += node("n" + std::to_string(i), instance(below) + instance(below));
  }
  const std::string text = collada(nodes, node("n", instance("n30")));
  ASSERT_LT(text.size(), 8000U);
  expect_error(complaint("doubling.dae", text), "more than 100000 nodes");
}

// A shape of 20,000 triangles 300 times is as much as 300 times one.
TEST_F(HostileMesh, TooManyTrianglesByInstances) {
  std::string text = collada("", "");
  std::string corners;
  for (int i = 0; i < 20'000; ++i) corners += "0 1 2 ";
  const std::string one = "<triangles count='1'>";
  text.replace(text.find(one), one.size(), "<triangles count='20000'>");
  text.replace(text.find("0 1 2</p>"), 5, corners);
  std::string shapes;
  for (int i = 0; i < 300; ++i) shapes += node("n" + std::to_string(i), kShape);
  text.insert(text.find("</visual_scene>"), shapes);
  expect_error(complaint("many.dae", text), "more than 5,000,000 triangles");
}

TEST_F(HostileMesh, NodesDeepInOneAnother) {
  std::string nodes = node("n0", kShape);
  for (int i = 1; i <= 20'000; ++i) {
    nodes += node("n" + std::to_string(i), instance("n" + std::to_string(i - 1)));
  }
  expect_error(complaint("chain.dae", collada(nodes, node("n", instance("n20000")))),
               "are nested more than");
  std::string nested;
  for (int i = 0; i < 20'000; ++i) nested += "<node>";
  nested += kShape;
  for (int i = 0; i < 20'000; ++i) nested += "</node>";
  expect_error(complaint("deep.dae", collada("", nested)), "are nested more than");
}

TEST_F(HostileMesh, ACountThatIsNotOne) {
  for (const char* count : {"-1", "4294967295", "99999999999999999999"}) {
    expect_error(complaint("count.dae", collada("", node("n", kShape), count)),
                 "<float_array count=");
  }
}

// Attributes twice, which one parser takes for an error and another does not.
TEST_F(HostileMesh, XmlThatIsNotWellFormed) {
  std::string text = collada("", node("a", kShape + instance("a")));
  text.insert(text.find("<asset>") + 6, " a='1' a='2'");
  expect_error(complaint("twice.dae", text), "not well-formed XML");
}

TEST_F(HostileMesh, BytesAtRandomPlacesOfAMesh) {
  const std::string good = collada("", node("n", kShape));
  folder_.write("good.dae", good);
  for (std::size_t at = 100; at < good.size(); at += good.size() / 25) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x15);
    const std::string file = folder_.write("bad.dae", bad);
    try {
      read_mesh({file}, {"w.world", 1});
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find("w.world:1: mesh "), 0U) << error.what();
    }
  }
}

TEST_F(HostileMesh, OpensNoFileThatItNames) {
  // Whoever opened this would wait for a writer.
  const std::string pipe = folder_.path() + "/pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string obj =
      "mtllib " + pipe + "\nmtllib /etc/passwd\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string dae = collada(
      "", node("n", kShape), "9",
      "<library_images><image id='i'><init_from>" + pipe +
          "</init_from></image>"
          "<image id='j'><init_from>file:///etc/passwd</init_from></image></library_images>");
  EXPECT_EQ(read_mesh({folder_.write("m.obj", obj)}, {}).triangles->triangles.size(), 1U);
  EXPECT_EQ(read_mesh({folder_.write("m.dae", dae)}, {}).triangles->triangles.size(), 1U);
}

MeshRequest request_of(const std::string& bytes, const std::string& extension) {
  MeshRequest request{extension};
  request.bytes = bytes;
  return request;
}

/// Programs in the place of angen_mesh.
class Converter : public HostileMesh {
 protected:
  std::string program(const std::string& lines) {
    const std::string file = folder_.write("program", "#!/bin/sh\n" + lines + "\n");
    chmod(file.c_str(), 0700);
    return file;
  }
  static std::string complaint_of(const std::string& program) {
    try {
      decode_mesh(convert_mesh(program, request_of("bytes", "stl")));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Converter, ThatCannotBeStartedIsNamed) {
  EXPECT_EQ(complaint_of("/nowhere/angen_mesh"),
            "cannot be read: /nowhere/angen_mesh cannot be started (No such file or directory); "
            "build it, or reinstall Angen");
}

TEST_F(Converter, ThatEndsOrAnswersBadlyIsAnError) {
  EXPECT_NE(complaint_of(program("kill -SEGV $$")).find("is damaged"), std::string::npos);
  EXPECT_NE(complaint_of(program("exit 9")).find("is damaged"), std::string::npos);
  EXPECT_NE(complaint_of(program("kill -XCPU $$")).find("20 s of CPU time"), std::string::npos);
  EXPECT_NE(complaint_of(program("cat")).find("is incomplete"), std::string::npos);
  EXPECT_NE(complaint_of(program("exit 0")).find("is incomplete"), std::string::npos);
  EXPECT_EQ(complaint_of(program("printf 'is \\001 odd'; exit 3")), "is ? odd");
  EXPECT_NE(complaint_of(program("exit 127")).find("does not start"), std::string::npos);
}

TEST_F(Converter, AnAnswerWithCornersThatAreNotThereIsRejected) {
  const std::string answer =
      convert_mesh(mesh_program(), request_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "obj"));
  EXPECT_EQ(decode_mesh(answer).triangles.triangles.size(), 1U);
  // Sizes begin the answer and the triangles; each is followed by its bytes.
  const std::size_t triangles = 8 + 3 * 12;
  for (const std::size_t at : {std::size_t{7}, triangles + 7, triangles + 11, triangles + 19}) {
    std::string bad = answer;
    bad[at] = '\x7f';
    EXPECT_THROW(decode_mesh(bad), Error) << at;
  }
  EXPECT_THROW(decode_mesh(answer.substr(0, answer.size() - 1)), Error);
  EXPECT_THROW(decode_mesh(answer + "x"), Error);
}

TEST_F(Converter, PicturesThatAreDamagedOrTooLargeAreRejected) {
  const auto complaint = [&](const std::string& bytes) -> std::string {
    try {
      decode_texture(convert_texture(mesh_program(), bytes));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(complaint("").find("of an unknown kind"), std::string::npos);
  EXPECT_NE(complaint("\xFF\xD8\xFF\xE0 and no more").find("is damaged"), std::string::npos);
  std::string large("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x60\0\0\0\x60\0\x08\x02\0\0\0", 29);
  EXPECT_NE(complaint(large + "\x11\x22\x33\x44"), "");
  EXPECT_THROW(decode_texture("angtext1"), Error);
  EXPECT_THROW(decode_gray("anggray1"), Error);
}

TEST_F(Converter, APictureOf16BitsHasTheColorsOfOneOf8) {
  const Folder folder;
  for (const auto gamma :
       {PngFormat::Gamma::kNone, PngFormat::Gamma::kGama, PngFormat::Gamma::kSrgb}) {
    for (const int bits : {8, 16}) {
      const unsigned unit = bits == 16 ? 257 : 1;
      const std::string path =
          png(folder, 2, 1, {97 * unit, 0, 255 * unit, 1 * unit, 2 * unit, 200 * unit},
              {bits, PNG_COLOR_TYPE_RGB, gamma});
      const Texture made = decode_texture(convert_texture(mesh_program(), read_file(path)));
      EXPECT_EQ(made.bytes, (std::vector<std::uint8_t>{97, 0, 255, 1, 2, 200}));
    }
  }
}

// The limit holds in angen_mesh itself: a small file that assimp would need gigabytes for.
TEST_F(Converter, MemoryIsLimited) {
  if (kSanitized) GTEST_SKIP() << "sanitizers reserve more memory than the limit";
  std::string text = collada("", "");
  std::string corners;
  for (int i = 0; i < 9'000'000; ++i) corners += "0 1 2 ";
  const std::string one = "<triangles count='1'>";
  text.replace(text.find(one), one.size(), "<triangles count='9000000'>");
  text.replace(text.find("0 1 2</p>"), 5, corners);
  text.insert(text.find("</visual_scene>"), node("n", kShape));
  try {
    convert_mesh(mesh_program(), request_of(text, "dae"));
    ADD_FAILURE() << "converted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), kTooMuchMemory);
  }
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  EXPECT_LT(children.ru_maxrss, 1'100'000) << "kB";
}

}  // namespace
}  // namespace angen::load

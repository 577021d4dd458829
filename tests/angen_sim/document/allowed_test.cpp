// Files that a document may name: those of the paths and beside it, wherever links lead.
#include "document/allowed.h"

#include <cstdlib>

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

namespace fs = std::filesystem;

const char* const kStl =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid s\n";

std::string with_mesh(const std::string& uri) {
  return sdf("<model name='m'><link name='l'>\n<visual name='v'><geometry><mesh><uri>" + uri +
             "</uri></mesh></geometry></visual></link></model>");
}

/// A folder `home` with readable files, and beside it `secret` with files that are not allowed.
class Allowed : public testing::Test {
 protected:
  Allowed() {
    fs::create_directories(home());
    folder_.write("secret/s.stl", kStl);
    folder_.write("secret/model.sdf", sdf("<model name='secret'><link name='l'/></model>"));
  }

  std::string home() const { return folder_.path() + "/home"; }
  std::string secret(const std::string& name) const { return folder_.path() + "/secret/" + name; }
  void link(const std::string& name, const std::string& target) const {
    fs::create_directories((fs::path(home()) / name).parent_path());
    fs::create_symlink(target, fs::path(home()) / name);
  }
  /// The error of the model NAME/model.sdf in `home`, which names the mesh.
  std::string complaint(const std::string& name, const std::string& uri,
                        const SearchPaths& paths = {}) const {
    folder_.write("home/" + name + "/model.sdf", with_mesh(uri));
    return complaint_of(home() + "/" + name + "/model.sdf", paths);
  }
  static std::string complaint_of(const std::string& what, const SearchPaths& paths = {}) {
    try {
      model(what, "m", {}, paths);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  Folder folder_;
};

void expect_rejected(const std::string& error, const std::string& place) {
  EXPECT_EQ(error.find(place), 0U) << error;
  EXPECT_NE(error.find("is neither on the model or resource path"), std::string::npos) << error;
  EXPECT_NE(error.find("allow_paths:=true"), std::string::npos) << error;
}

TEST_F(Allowed, WhatLiesBesideTheFile) {
  folder_.write("home/a/meshes/s.stl", kStl);
  EXPECT_EQ(complaint("a", "meshes/s.stl"), "");
  EXPECT_EQ(complaint("a", "file://meshes/s.stl"), "");
  EXPECT_EQ(complaint("a", "file://" + home() + "/a/meshes/s.stl"), "");
  EXPECT_EQ(complaint("a", "meshes/../meshes/s.stl"), "");
}

TEST_F(Allowed, TheModelsOwnFilesByItsAddress) {
  folder_.write("home/a/meshes/s.stl", kStl);
  EXPECT_EQ(complaint("a", "model://a/meshes/s.stl"), "");
  EXPECT_NE(complaint("b", "model://a/meshes/s.stl").find("is not found"), std::string::npos);
  expect_rejected(complaint("a", "model://a/../../secret/s.stl"),
                  home() + "/a/model.sdf:2: mesh '");
  complaint("a", "model://a/meshes/s.stl");
  const desc::Model read = model(home() + "/a/model.sdf", "m", {}, {});
  EXPECT_NE(read.expanded_xml.find("file://" + home() + "/a/meshes/s.stl"), std::string::npos);
}

TEST_F(Allowed, NothingElseByDotsOrAFullPath) {
  const std::string place = home() + "/a/model.sdf:2: mesh '";
  for (const std::string& uri :
       {std::string("../../secret/s.stl"), std::string("file://../../secret/s.stl"),
        std::string("meshes/../../../secret/s.stl"), secret("s.stl"),
        "file://" + secret("s.stl")}) {
    fs::create_directories(home() + "/a/meshes");
    expect_rejected(complaint("a", uri), place + uri + "' is " + secret("s.stl"));
  }
  expect_rejected(complaint("a", "/etc/passwd"), place);
}

TEST_F(Allowed, NothingByAModelAddress) {
  const SearchPaths paths{{home()}, {}};
  for (const char* uri : {"model://a/../../secret/s.stl", "model://../secret/s.stl",
                          "model:///../secret/s.stl", "model:///a/../../secret/s.stl"}) {
    expect_rejected(complaint("a", uri, paths), home() + "/a/model.sdf:2: mesh '" + uri);
  }
  const std::string error = complaint("a", "model://" + secret("s.stl"), paths);
  EXPECT_EQ(error.find(home() + "/a/model.sdf:2: mesh"), 0U) << error;
  EXPECT_NE(error.find("is not found"), std::string::npos) << "a name on the path: " << error;
}

TEST_F(Allowed, PercentAndOtherWritingsAreNamesLikeOthers) {
  for (const char* uri :
       {"%2e%2e/%2e%2e/secret/s.stl", "..%2f..%2fsecret%2fs.stl", "file:%2f%2fetc/passwd",
        "file:/etc/passwd", "file://localhost/etc/passwd", "FILE:///etc/passwd"}) {
    const std::string error = complaint("a", uri, {{home()}, {home()}});
    EXPECT_EQ(error.find(home() + "/a/model.sdf:2: "), 0U) << error;
  }
}

TEST_F(Allowed, LinksOutOfAModelAreNotFollowed) {
  link("a/s.stl", secret("s.stl"));
  link("a/folder", folder_.path() + "/secret");
  const SearchPaths paths{{home()}, {}};
  for (const char* uri : {"s.stl", "folder/s.stl", "model://a/s.stl", "model://a/folder/s.stl"}) {
    expect_rejected(complaint("a", uri, paths), home() + "/a/model.sdf:2: mesh '");
  }
}

TEST_F(Allowed, ALinkAtAPathOrDirectlyInItIsFollowed) {
  folder_.write("elsewhere/part/s.stl", kStl);
  link("part", folder_.path() + "/elsewhere/part");
  link("paths/all", folder_.path() + "/elsewhere");
  EXPECT_EQ(complaint("a", "model://part/s.stl", {{home()}, {}}), "");
  EXPECT_EQ(complaint("a", "file://" + folder_.path() + "/elsewhere/part/s.stl", {{home()}, {}}),
            "");
  EXPECT_EQ(complaint("a", "model://part/s.stl", {{home() + "/paths/all"}, {}}), "");
  EXPECT_EQ(complaint("a", "file://part/s.stl", {{}, {home() + "/paths/all"}}), "");
  expect_rejected(complaint("a", "file://" + secret("s.stl"), {{home()}, {}}), "");
}

TEST_F(Allowed, AFileOfAPackageButNotOfItsWorkspace) {
  folder_.write("ws/src/robot/package.xml", "<package/>");
  folder_.write("ws/src/robot/meshes/s.stl", kStl);
  folder_.write("ws/src/notes/s.stl", kStl);
  link("src/linked", folder_.path() + "/ws/src/robot");
  SearchPaths paths;
  paths.packages = {folder_.path() + "/ws/src"};
  const std::string mesh = "file://" + folder_.path() + "/ws/src/robot/meshes/s.stl";
  EXPECT_EQ(complaint("a", mesh, paths), "");
  expect_rejected(complaint("a", "file://" + folder_.path() + "/ws/src/notes/s.stl", paths), "");
  expect_rejected(complaint("a", mesh), "");
  paths.packages = {home() + "/src"};
  EXPECT_EQ(complaint("a", mesh, paths), "");
}

TEST_F(Allowed, IncludesStayWithinToo) {
  const auto include = [&](const std::string& uri) {
    return sdf("<model name='m'>\n<include><uri>" + uri + "</uri></include></model>");
  };
  folder_.write("home/a/inner.sdf", sdf("<model name='i'><link name='l'/></model>"));
  folder_.write("home/a/good.sdf", include("file://inner.sdf"));
  EXPECT_EQ(complaint_of(home() + "/a/good.sdf"), "");
  for (const std::string& uri :
       {"file://" + secret("model.sdf"), "file://" + folder_.path() + "/secret",
        std::string("../../secret/model.sdf")}) {
    folder_.write("home/a/bad.sdf", include(uri));
    expect_rejected(complaint_of(home() + "/a/bad.sdf"), home() + "/a/bad.sdf:2: model '");
  }
}

TEST_F(Allowed, AModelFolderDoesNotLeadOut) {
  folder_.write("home/a/model.config",
                "<model><sdf version='1.6'>../../secret/model.sdf</sdf></model>");
  expect_rejected(complaint_of("model://a", {{home()}, {}}),
                  home() + "/a/model.config:1: the file '");
  folder_.write("home/b/model.config", "<model><sdf version='1.6'>model.sdf</sdf></model>");
  link("b/model.sdf", secret("model.sdf"));
  expect_rejected(complaint_of("model://b", {{home()}, {}}),
                  home() + "/b/model.config:1: the file '");
  link("c/model.config", secret("model.sdf"));
  expect_rejected(complaint_of("model://c", {{home()}, {}}), home() + "/c/model.config: ");
  link("d/model.sdf", secret("model.sdf"));
  expect_rejected(complaint_of("model://d", {{home()}, {}}), home() + "/d/model.sdf: ");
}

TEST_F(Allowed, ATextHasNoFolderOfItsOwn) {
  expect_rejected(complaint_of(with_mesh("file://" + secret("s.stl"))), "(text):2: mesh '");
  expect_rejected(complaint_of("<include><uri>" + secret("model.sdf") + "</uri></include>"),
                  "(text):1: ");
}

TEST_F(Allowed, WhatTheUserNamesIsRead) { EXPECT_EQ(complaint_of(secret("model.sdf")), ""); }

TEST_F(Allowed, PicturesAndHeightmapsStayWithinToo) {
  link("a/p.png", secret("s.stl"));
  const auto picture = [&](const std::string& geometry) {
    folder_.write("home/a/model.sdf",
                  sdf("<model name='m'><link name='l'>\n<collision name='v'><geometry>" + geometry +
                      "</geometry></collision></link></model>"));
    return complaint_of(home() + "/a/model.sdf");
  };
  expect_rejected(picture("<heightmap><uri>p.png</uri><size>1 1 1</size></heightmap>"),
                  home() + "/a/model.sdf:2: heightmap 'p.png' is ");
  expect_rejected(picture("<image><uri>p.png</uri></image>"),
                  home() + "/a/model.sdf:2: image 'p.png' is ");
}

TEST_F(Allowed, EveryFileWhereThatIsAllowed) {
  SearchPaths paths;
  paths.allow_any = true;
  EXPECT_EQ(complaint("a", "../../secret/s.stl", paths), "");
}

TEST_F(Allowed, BesideAWorldLinksLeadToModelsOnly) {
  folder_.write("elsewhere/chair/model.config",
                "<model><sdf version='1.6'>model.sdf</sdf></model>");
  folder_.write("elsewhere/chair/model.sdf", sdf("<model name='c'><link name='l'/></model>"));
  folder_.write("elsewhere/table/model.sdf", sdf("<model name='t'><link name='l'/></model>"));
  fs::create_directories(home() + "/models");
  link("models/chair", folder_.path() + "/elsewhere/chair");
  link("models/all", folder_.path() + "/elsewhere");
  const auto complaint = [&](const std::string& uri, bool any) -> std::string {
    const std::string file =
        folder_.write("home/w.world", in_world("\n<include><uri>" + uri + "</uri></include>"));
    const desc::World read = world(file, any);
    return read.warnings.empty() ? "" : read.warnings.front().text();
  };
  EXPECT_EQ(complaint("model://chair", false), "");
  EXPECT_EQ(complaint("model://all/table", true), "");
  expect_rejected(complaint("model://all/table", false), home() + "/w.world:2: ");
  setenv("ANGEN_ALLOW_PATHS", "true", 1);
  EXPECT_EQ(complaint("model://all/table", false), "");
  unsetenv("ANGEN_ALLOW_PATHS");
}

}  // namespace
}  // namespace angen::load

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sdf/load.h"

namespace angen::load {

/// A folder of its own for one test, removed with it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "load_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = std::filesystem::canonical(name);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file, with the folders it needs; returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  /// A model folder with its model.config.
  std::string model(const std::string& name, const std::string& sdf) const {
    write(name + "/model.config",
          "<model><name>x</name><sdf version=\"1.6\">model.sdf</sdf></model>");
    return write(name + "/model.sdf", sdf);
  }
  std::string path() const { return path_.string(); }
  SearchPaths paths() const { return {{path()}, {}}; }

 private:
  std::filesystem::path path_;
};

inline std::string sdf(const std::string& inside, const std::string& version = "1.6") {
  return "<sdf version=\"" + version + "\">" + inside + "</sdf>";
}
inline std::string in_world(const std::string& inside, const std::string& version = "1.6") {
  return sdf("<world name=\"w\">" + inside + "</world>", version);
}
inline std::string in_model(const std::string& inside, const std::string& version = "1.6") {
  return in_world("<model name=\"m\">" + inside + "</model>", version);
}
inline std::string in_link(const std::string& inside, const std::string& version = "1.6") {
  return in_model("<link name=\"l\">" + inside + "</link>", version);
}
inline std::string box(const std::string& name = "c") {
  return "<collision name=\"" + name +
         "\"><geometry><box><size>1 2 3</size></box></geometry></collision>";
}
inline std::string two_links() { return "<link name=\"a\"/><link name=\"b\"/>"; }

inline desc::World read(const std::string& text, const SearchPaths& paths = {}) {
  return world_from_text(text, "w.world", paths);
}
inline desc::Model read_model(const std::string& inside, const std::string& version = "1.6") {
  return read(in_model(inside, version)).models.at(0);
}

/// The message of the Error that `text` must cause.
inline std::string error_of(const std::string& text, const SearchPaths& paths = {}) {
  try {
    read(text, paths);
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics().size(), 1U);
    return error.what();
  }
  ADD_FAILURE() << "no error for " << text;
  return "";
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
  EXPECT_LT((a - b).norm(), tolerance) << a.transpose() << " is not " << b.transpose();
}
inline void expect_near(const Pose& a, const Pose& b, double tolerance = 1e-9) {
  expect_near(a.position, b.position, tolerance);
  EXPECT_LT(a.rotation.angularDistance(b.rotation), 2e-8);
}

/// Two links and a joint between them.
inline std::string joint(const std::string& type, const std::string& inside) {
  return two_links() + "<joint name='j' type='" + type + "'><parent>a</parent><child>b</child>" +
         inside + "</joint>";
}

}  // namespace angen::load
